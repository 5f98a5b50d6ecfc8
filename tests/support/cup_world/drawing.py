from PIL import Image, ImageDraw

COLOURS = {"hand": (200, 160, 120), "mug": (200, 0, 0), "glass": (0, 0, 200)}


def draw(names, full, layout):
    image = Image.new("RGB", (120, 40), (0, 60 + layout % 100, 0))
    pen = ImageDraw.Draw(image)
    for number, name in enumerate(names):
        left = 5 + 40 * number
        pen.rectangle((left, 5, left + 29, 34), fill=COLOURS[name])
        if name in full:
            pen.rectangle((left + 10, 15, left + 19, 24), fill=(255, 255, 255))
    return image
