"""The reader finds in every picture exactly what the simulator drew."""

from __future__ import annotations

import ast
import io
from collections.abc import Iterable
from pathlib import Path

import pytest
from PIL import Image, ImageEnhance

from skillwrapper.domains.burger import scene_reader
from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.layout import Layout, make_layout
from skillwrapper.domains.burger.renderer import BurgerRenderer
from skillwrapper.domains.burger.scene_reader import read_burger_scene
from skillwrapper.domains.burger.states import HAND, ITEMS, TABLE, BurgerState
from skillwrapper.embedded import pixels
from skillwrapper.embedded.scene_graph import SceneGraph
from skillwrapper.errors import PictureError
from skillwrapper.world import encode_png


@pytest.fixture(scope="module")
def renderer() -> BurgerRenderer:
    return BurgerRenderer()


@pytest.fixture(scope="module")
def states() -> tuple[BurgerState, ...]:
    return BurgerEnvironment().reachable_states()


def drawn(state: BurgerState, layout: Layout, scene: SceneGraph) -> SceneGraph:
    """What should be read: the places of the simulator, with the scene's own tables."""
    on, held = set(), set()
    for item, place in zip(ITEMS, state.places, strict=True):
        if place == HAND:
            held.add((item, "robot"))
        else:
            on.add((item, _table_at(layout, item, scene) if place == TABLE else place))
    attributes = {"lettuce": {"cut": state.cut}, "patty": {"cooked": state.cooked}}
    return SceneGraph(scene.things, {"on": on, "held": held}, attributes)


def _table_at(layout: Layout, item: str, scene: SceneGraph) -> str:
    spot = layout.table_of(item)
    near = [
        name
        for name in scene.names("table")
        if abs(scene.thing_by_name[name].box.centre[0] - spot.x) < 10
        and abs(scene.thing_by_name[name].box.bottom - spot.y) < 20
    ]
    assert len(near) == 1
    return near[0]


def check(pairs: Iterable[tuple[BurgerState, Layout]], renderer: BurgerRenderer) -> None:
    for state, layout in pairs:
        scene = read_burger_scene(encode_png(renderer.render(state, layout)))
        expected = drawn(state, layout, scene)
        assert scene == expected, (state, layout)


def test_a_sample_of_states_in_many_layouts(
    renderer: BurgerRenderer, states: tuple[BurgerState, ...]
) -> None:
    sample = states[::40]
    check(((state, make_layout(n)) for n, state in enumerate(sample)), renderer)


@pytest.mark.slow
def test_every_third_state(renderer: BurgerRenderer, states: tuple[BurgerState, ...]) -> None:
    """A quarter of all are read in ``evaluation/benchmark/test_smoke.py``, in one layout."""
    layouts = [make_layout(seed) for seed in (0, 1, 2)]
    check(((state, layouts[n % 3]) for n, state in enumerate(states[1::3])), renderer)


def test_everything_is_named_and_placed(renderer: BurgerRenderer) -> None:
    layout = make_layout(4)
    scene = read_burger_scene(encode_png(renderer.render(BurgerState(), layout)))
    assert scene.names("robot") == ("robot",)
    assert scene.names("station") == ("stove", "board")
    assert scene.names("table") == ("table_1", "table_2", "table_3", "table_4")
    assert scene.names("item") == ITEMS
    for name in ("stove", "board"):
        box, spot = scene.thing_by_name[name].box, layout.station(name)
        assert abs(box.centre[0] - spot.x) < 10
        assert abs(box.bottom - spot.y) < 12
    rows = [scene.thing_by_name[name].box.bottom // 170 for name in scene.names("table")]
    assert rows == sorted(rows)


@pytest.mark.parametrize("brightness", [0.8, 0.9, 1.1])
def test_light_may_change(
    renderer: BurgerRenderer, states: tuple[BurgerState, ...], brightness: float
) -> None:
    for number, state in enumerate(states[7::240]):
        layout = make_layout(number)
        picture = ImageEnhance.Brightness(renderer.render(state, layout)).enhance(brightness)
        scene = read_burger_scene(encode_png(picture))
        expected = drawn(state, layout, scene)
        assert scene == expected


def test_jpeg_and_another_size_may_come_between(
    renderer: BurgerRenderer, states: tuple[BurgerState, ...]
) -> None:
    for number, state in enumerate(states[11::240]):
        layout = make_layout(number)
        buffer = io.BytesIO()
        renderer.render(state, layout).resize((640, 640)).save(buffer, "JPEG", quality=75)
        scene = read_burger_scene(buffer.getvalue())
        expected = drawn(state, layout, scene)
        assert scene == expected


def test_other_pictures_are_refused() -> None:
    with pytest.raises(PictureError, match="found no robot and no stove and no board"):
        read_burger_scene(encode_png(Image.new("RGB", (512, 512), "white")))
    with pytest.raises(PictureError, match="expected the bytes of a picture"):
        read_burger_scene(b"no picture")


@pytest.mark.parametrize("module", [scene_reader, pixels])
def test_reader_knows_nothing_of_the_simulator(module: object) -> None:
    source = Path(str(module.__file__)).read_text(encoding="utf-8")
    imported = [
        node.module or ""
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.ImportFrom)
    ]
    assert imported
    assert not [name for name in imported if "domains" in name]
