import io

from drawing import COLOURS
from PIL import Image

from skillwrapper.embedded import Box, SceneGraph, Thing
from skillwrapper.errors import PictureError


def read_cups(png):
    image = Image.open(io.BytesIO(png)).convert("RGB")
    if image.size != (120, 40):
        raise PictureError("no picture of cups")
    names = {colour: name for name, colour in COLOURS.items()}
    things, attributes = [], {}
    for left in (5, 45, 85):
        name = names.get(image.getpixel((left + 2, 7)))
        if name is None:
            continue
        things.append(Thing(name, "hand" if name == "hand" else "cup", Box(left, 5, left + 30, 35)))
        if name != "hand":
            attributes[name] = {"full": image.getpixel((left + 15, 20)) == (255, 255, 255)}
    return SceneGraph(tuple(things), {"on": set()}, attributes)
