"""Tasks are done when all that they name holds, and quoted numbers hold in the digits that are written."""

from dataclasses import replace

import pytest

from core import Settings, trace
from core.edits.edit import Edit, original
from core.scene import AnyScene
from core.setting_texts import settings_from_texts
from lessons.course.quoted import CALLED, Situation, is_right
from lessons.course.record import UntilPart
from lessons.course.tasks import is_done
from lessons.lectures.scenes import ALL_SCENES
from lessons.scene_edits import move_corner, set_value
from lessons.small_scenes import triangle_scene
from tests.lessons.course.lesson_texts import GOOD

SQUARE = triangle_scene(
    [[(0.5, 0.5), (4.5, 0.5), (4.5, 4.5)], [(0.5, 0.5), (4.5, 4.5), (0.5, 4.5)]],
    (6, 6),
    attributes=[[[0.0], [1.0], [1.0]], [[0.0], [1.0], [0.0]]],
)
BOX = {"fill": "bounding-box"}


def at(
    scene: AnyScene = SQUARE,
    chosen: dict[str, str] = BOX,
    stage: str = "raster",
    position: int = 0,
    pixel: tuple[int, int] | None = None,
) -> Situation:
    return Situation(trace(scene, settings_from_texts(chosen)), stage, position, pixel)


def moved(x: float, y: float) -> AnyScene:
    return move_corner(SQUARE, 0, 2, (x, y), (6, 6))


DOUBLED = Edit("fill", "bounding-box", original("fill", "bounding-box").source.replace("and owns_tie[k]", ""))
YELLOW = ALL_SCENES["lmu-minimal-shaders"].make()
END = trace(SQUARE, Settings(fill="bounding-box")).stage("raster").steps.count
FLOOR = replace(ALL_SCENES["textured-floor"].make(), size=(16, 12))
ROLLED = set_value(FLOOR, "camera/up/x", 0.3, (16, 12))


@pytest.mark.parametrize(
    ("until", "yes", "no"),
    [
        ({"some": "tie"}, at(), at(moved(4.6, 4.4), {**BOX, "fill_rule": "shared-edge"}, "edges")),
        ({"some": ["covered", "E0 == 0"]}, at(), at(stage="edges")),
        ({"none": ["depth-failed", "E0 > 99"]}, at(), at(stage="edges")),
        ({"count": ["covered", 16]}, at(), at(chosen={**BOX, "fill_rule": "exclusive"})),
        ({"least": ["covered", 16]}, at(), at(chosen={**BOX, "fill_rule": "exclusive"})),
        ({"most": ["covered", 6]}, at(chosen={**BOX, "fill_rule": "exclusive"}), at()),
        ({"here": "covered"}, at(position=4), at()),
        ({"settings": {"fill_rule": "inclusive"}}, at(chosen={"fill_rule": "inclusive"}), at()),
        ({"pixels": 16}, at(), at(chosen={"fill_rule": "inclusive"})),
        ({"tested": 50}, at(), at(chosen={"fill": "brute-force"})),
        ({"decisions": 50}, at(), at(chosen={"fill": "brute-force"})),
        ({"same": {"interpolation": "affine"}}, at(), at(FLOOR)),
        ({"holds": "edited(twice) == 5"}, replace(at(), edits=(DOUBLED,)), at()),
        ({"holds": "differs() == 9"}, replace(at(), edits=(DOUBLED,)), replace(at(), other=at().settings)),
        (
            {"holds": ["edited(count(covered)) == 30", "count(covered) == 16"]},
            replace(at(), edits=(DOUBLED,)),
            at(),
        ),
        (
            {"holds": "apart(shading=unlit) == 255"},
            at(YELLOW, {}),
            at(replace(YELLOW, program=None), {"shading": "unlit"}),
        ),
        ({"stage": "depth"}, at(stage="depth"), at()),
        ({"pixel": [2, 3]}, at(pixel=(2, 3)), at(pixel=(3, 2))),
        ({"holds": ["drawn == 16", "twice == 0"]}, at(), at(chosen={"fill_rule": "inclusive"})),
        ({"fails": {"weak": {"fill_rule": "inclusive"}, "robust": {}, "by": "twice"}}, at(), at(FLOOR)),
        ({"fails": {"weak": {"interpolation": "affine"}, "robust": {}}}, at(FLOOR), at()),
        (
            {"fails": {"weak": {"fill_rule": "exclusive"}, "robust": {}, "by": "nothing"}},
            at(triangle_scene([[(0.5, 0.5), (1.4, 0.5), (0.5, 1.4)]], (2, 2))),
            at(),
        ),
        ({"stage": "raster", "keeps": ["scene"]}, at(), at(moved(4, 4))),
        ({"stage": "raster", "keeps": ["size"]}, at(moved(4, 4)), at(replace(SQUARE, size=(5, 6)))),
        ({"stage": "raster", "keeps": ["settings"]}, at(moved(4, 4)), at(chosen={"fill": "spans"})),
        ({"stage": "raster", "keeps": ["fill"]}, at(chosen={**BOX, "depth": "z-16"}), at(chosen={})),
        ({"stage": "raster", "keeps": ["window"]}, at(moved(6, 6)), at(moved(6.5, 6))),
    ],
    ids=lambda value: str(value) if isinstance(value, dict) else "",
)
def test_a_task_is_done_when_it_holds(until: dict[str, object], yes: Situation, no: Situation) -> None:
    part, start = UntilPart.model_validate(until), at()
    assert is_done(part, yes, start)
    assert not is_done(part, no, start)


def test_the_camera_is_kept() -> None:
    part = UntilPart(stage="raster", keeps=["camera"])
    assert is_done(part, at(FLOOR, {"interpolation": "affine"}), at(FLOOR))
    assert not is_done(part, at(ROLLED), at(FLOOR))


def test_a_task_on_a_table_of_depths_asks_for_methods_by_name() -> None:
    table = at(ALL_SCENES["depth-table"].make(), {}, "depth")
    assert is_done(UntilPart(stage="depth", keeps=["depth", "settings"]), table, table)


RIGHT = [
    "drawn == 16 and twice == 0 and tested == 50 and colors == 5 and colors(interpolation=affine) == 5",
    "drawn(2, 2) == 1 and drawn(2, 2, fill_rule=inclusive) == 2",
    "drawn(fill_rule='inclusive') == 25 and twice(fill_rule=inclusive) == 5",
    "seen(0) == 10 and seen(1) == 6 and owner(1, 0) == 0 and owner(5, 5) == -1",
    "differs(interpolation=affine) == 0 and differs(fill_rule=exclusive) == 10",
    "unlike(fill_rule=exclusive) == 10",
    "decisions(fill=blocks, block_size=1) == 50 and tested(fill=brute-force) == 72",
    "rows == 50 and rows('edges') == 14",
    "u(1, 0) == 0.25 and attribute(1, 0, 0) == 0.25 and linear(1, 0, 3) == 1 and shown(5, 5, 0) == 0",
    "stored(1, 0) == 0.5 and stored(5, 5) == 1",
    "buffer('overdraw', 2, 2) == 1",
    "E0 == 0 and column == 4 and kind == 'test' and not covered",
    "value('E0', 'column == 1 and row == 0') == 12 and value('weights', 'covered', 1) == 0",
    "place(0, 1, 'x') == 4.5 and place(0, 1, 'w') == 1",
    "count(covered) == 16 and some(tie) and count(tie, fill_rule=inclusive) > 0 and not some(E0 == 99.5)",
    "count(weights[0] == 0.75) > 0 and count(abs(E0) < 1) > 0",
    "floor(2.7) == 2 and round(2.7) == 3 and sqrt(16) == 4 and log2(8) == 3 and power(0.9, 40) == 0.015",
    "edited(drawn) == 16 and edited(edited(E0)) == 0 and apart(interpolation=affine) == 0",
    "12 - 3 * 2.5 - 4 * 0.5 == 2.5",
]


@pytest.mark.parametrize("text", RIGHT)
def test_quoted_numbers_hold(text: str) -> None:
    assert is_right(text, at(position=END))


def test_every_function_is_tried() -> None:
    tried = " ".join(RIGHT) + GOOD
    assert [name for name in CALLED if f"{name}(" not in tried and name not in ("near", "v")] == []


@pytest.mark.parametrize(
    ("text", "is_so"),
    [
        ("near(0.4274, 0.427)", True),
        ("0.4274 == 0.427", True),
        ("0.4276 == 0.427", False),
        ("0.427 == 0.4274", False),
        ("2.4 == 2", False),
        ("2.04 == 2.0", True),
        ("-0.2717 == -0.27", True),
        ("1 - 2 / 3 == 0.33", True),
    ],
)
def test_a_number_holds_in_the_digits_that_are_written(text: str, is_so: bool) -> None:
    assert is_right(text, at()) == is_so


@pytest.mark.parametrize(
    "text",
    [
        *("drawn", "open('x') == 1", "drawn(1) == 1", "drawn(9, 9) == 1", "().__class__ == 1"),
        *(
            "value('E0') == 1",
            "differs == 0",
            "count(1, 2) == 1",
            "some(open('x'))",
            "E0 == 1",
            "kind == 'none'",
        ),
        "drawn(fill=none) == 1",
    ],
)
def test_nothing_else_is_read_or_run(text: str) -> None:
    with pytest.raises(ValueError, match=r"^[^\n]+$"):
        is_right(text, at())
