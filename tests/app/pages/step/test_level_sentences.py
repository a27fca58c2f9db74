"""What decides is said at every level: of a row before what it does, of a larger step behind its counts."""

import re

import pytest

from app.pages.step.steps_ahead import sentence_at
from app.session.cursor import Cursor
from app.session.moment import Step
from core import Settings, trace
from core.records.steps import Level
from core.scene import AnyScene
from lessons.scenes import make_scene
from lessons.slides.scenes import clipped


def said(scene: AnyScene, stage: str, level: Level, settings: Settings | None = None) -> list[str]:
    """Return the sentences of all steps of a level."""
    traced = trace(scene, settings or Settings())
    positions = traced.stage(stage).steps.boundaries(level).tolist()[1:]
    return [sentence_at(Step(traced, Cursor(stage, position, level))) for position in positions]


@pytest.mark.parametrize("level", Level)
def test_what_the_printed_algorithm_gets_wrong(level: Level) -> None:
    found = said(clipped(2, 8, 6, 8)(), "raster", level, Settings(line_clipping="cyrus-beck-lecture"))
    wrong = "the top border is ignored, because it is parallel to the segment, and the segment is kept; "
    assert any(
        f"{wrong}it lies outside this border, so the right algorithm drops it." in text for text in found
    )


@pytest.mark.parametrize("level", Level)
def test_a_vertex_behind_the_eye_is_mirrored(level: Level) -> None:
    found = said(make_scene("near-plane"), "transform", level)
    assert any(
        "as w is below 0 it lies behind the eye, and the division mirrors it" in text for text in found
    )


def test_a_row_says_what_decided_and_what_it_did() -> None:
    pixels = said(make_scene("segment"), "raster", Level.PIXEL)
    assert pixels[2].startswith("D is 4, above 0, so y steps. Pixel (3, 2) is drawn: ")
    (first, *_) = said(make_scene("intersecting"), "depth", Level.PIXEL)
    assert " so it is nearer. The depth buffer now holds " in first
    assert first.count("Pixel (") == 1
    pixels = said(make_scene("single-triangle"), "interpolate", Level.PIXEL)
    assert re.fullmatch(
        r"Pixel \(8, 6\) of triangle 0: corners 0, 1 and 2 have weights .*, their parts of the sum\. "
        r"Its colour is \(.*\), the weighted sum of the corners' values\.",
        pixels[0],
    )


def test_a_pixel_of_a_span_names_its_columns() -> None:
    found = said(make_scene("single-triangle"), "raster", Level.PIXEL, Settings(fill="scanline"))
    assert any("a test of its own: it is in the span of row 6, columns 8 to 10." in text for text in found)
