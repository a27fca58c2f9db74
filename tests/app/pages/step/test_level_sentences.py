"""What decides is said at every level: of a row before what it does, of a larger step behind its counts."""

import re
from collections.abc import Callable, Iterator
from functools import partial
from itertools import islice

import pytest

from app.pages.step.inspector_presenter import sentence_at
from app.session.moment import Cursor, Step
from core import Settings, trace
from core.explain.steps import row_sentence
from core.records.steps import Level
from core.scene import AnyScene
from lessons.lectures.catalogue import printed_listing
from lessons.lectures.scenes import ALL_SCENES, clipped
from lessons.scenes import make_scene, scene_names


def said(scene: AnyScene, stage: str, level: Level, settings: Settings | None = None) -> Iterator[str]:
    """Say all steps of a level, one after the other."""
    traced = trace(scene, settings or Settings())
    positions = traced.stage(stage).steps.boundaries(level).tolist()[1:]
    for position in positions:
        yield sentence_at(Step(traced, Cursor(stage, position, level)))


WRONG: dict[str, tuple[Callable[[], AnyScene], str, Settings, str]] = {
    "a printed clipper": (
        clipped(2, 8, 6, 8),
        "raster",
        Settings(line_clipping="cyrus-beck-lecture"),
        "the top border is ignored, because it is parallel to the segment, and the segment is kept; "
        "it lies outside this border, so the right algorithm drops it.",
    ),
    "a vertex behind the eye": (
        partial(make_scene, "near-plane"),
        "transform",
        Settings(),
        "as w is below 0 it lies behind the eye, and the division mirrors it",
    ),
    "a printed scanline": (
        ALL_SCENES["lmu-scanline-triangle"].make,
        "raster",
        Settings(fill="scanline-lecture"),
        "the sides are rounded and both ends drawn, column 2: 1 pixel; the right algorithm draws nothing",
    ),
    "a printed line": (
        ALL_SCENES["pellacini-line"].make,
        "raster",
        printed_listing("pellacini-bresenham").settings(Settings()),
        "; the right method (Midpoint) draws (1, 0) instead.",
    ),
    "the camera's axis": (
        ALL_SCENES["jubair-backfaces"].make,
        "cull",
        Settings(cull="back-axis"),
        "so it counts as a back; twice its signed area, 20.65, says the other side.",
    ),
}
"""Scene, stage and settings to what is said there."""


@pytest.mark.parametrize("level", Level)
@pytest.mark.parametrize("what", WRONG)
def test_what_goes_wrong_is_said_at_every_level(what: str, level: Level) -> None:
    make, stage, settings, wanted = WRONG[what]
    assert any(wanted in text for text in said(make(), stage, level, settings))


def test_where_the_right_side_is_seen_no_other_is_named() -> None:
    right = said(ALL_SCENES["jubair-backfaces"].make(), "cull", Level.PIXEL, Settings(cull="back-normal"))
    assert not any("says the other side" in text for text in right)


def test_a_row_says_what_decided_and_what_it_did() -> None:
    *_, third = islice(said(make_scene("segment"), "raster", Level.PIXEL), 3)
    assert third.startswith("D is 4, above 0, so y steps. Pixel (3, 2) is drawn: ")
    first = next(said(make_scene("intersecting"), "depth", Level.PIXEL))
    assert " so it is nearer. The depth buffer now holds " in first
    assert first.count("Pixel (") == 1
    assert re.fullmatch(
        r"Pixel \(8, 6\) of triangle 0: corners 0, 1 and 2 have weights .*, their parts of the sum "
        r"after the division by w \(in the window .*\)\. "
        r"Its colour is \(.*\), the weighted sum of the corners' values\.",
        next(said(make_scene("single-triangle"), "interpolate", Level.PIXEL)),
    )


def test_a_pixel_of_a_span_names_its_columns() -> None:
    found = said(make_scene("single-triangle"), "raster", Level.PIXEL, Settings(fill="scanline"))
    assert any("a test of its own: it is in the span of row 6, columns 8 to 10." in text for text in found)


@pytest.mark.slow
def test_a_listing_as_printed_is_told_wrong_just_where_its_picture_is() -> None:
    for name in ("lmu-scanline-triangle", "shared-edge", "single-triangle", "triangle-strip"):
        scene = make_scene(name) if name in scene_names() else ALL_SCENES[name].make()
        settings = Settings(fill="scanline-lecture")
        stage = trace(scene, settings).stage("raster")
        right = trace(scene, Settings(fill="scanline")).stage("raster")
        mine, wanted = (
            {
                (int(t), int(y), int(x))
                for t, (x, y), is_covered in zip(
                    each.triangle, each.pixel, each.marks["covered"], strict=True
                )
                if is_covered
            }
            for each in (stage, right)
        )
        wrong = {place[:2] for place in mine ^ wanted}
        told = set()
        for row in range(stage.steps.row_count):
            if stage.kind_of(row) != "accept":
                text = row_sentence(stage, int(stage.steps.starts[row + 1]))
                place = (int(stage.triangle[row]), int(stage.columns["row"][row]))
                told |= {place} if re.search(r"; the right algorithm draws (column|nothing)", text) else set()
        drawn = {(int(t), int(y)) for t, y in zip(stage.triangle, stage.columns["row"], strict=True)}
        assert told == wrong & drawn
    for name, scene_name in (("lmu-final", "lmu-line"), ("pellacini-midpoint", "pellacini-line")):
        settings = printed_listing(name).settings(Settings())
        found = said(ALL_SCENES[scene_name].make(), "raster", Level.PIXEL, settings)
        assert not any("the right method" in text for text in found)
