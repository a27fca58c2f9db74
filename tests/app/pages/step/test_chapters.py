"""The chapters of the run: counts that fit together, and why a stage is there."""

from itertools import pairwise

import numpy as np
import pytest

from app.views.stage_views import COMPUTED, chapters_of, traced_counts
from core import STAGES, ClipScene, Settings, trace
from lessons.scenes import make_scene
from tests.covering import in_turns
from widgets.timeline.chapters import Chapter, ChapterState


def chapters_by_stage(name: str, is_predicting: bool = False, **settings: str) -> dict[str, Chapter]:
    run = trace(make_scene(name), Settings(**settings))
    found = chapters_of(run, current="raster", is_predicting=is_predicting)
    return dict(zip(STAGES, found, strict=True))


@pytest.mark.parametrize("fill", ["spans", "bounding-box", "scanline"])
def test_what_comes_out_of_a_stage_goes_into_the_next(fill: str) -> None:
    chapters = chapters_by_stage("intersecting", fill=fill)
    through = {
        stage: [part.split()[0] for part in chapter.counts.split(" → ")]
        for stage, chapter in chapters.items()
    }
    order = ("bin", "raster", "interpolate", "shade", "depth", "blend")
    for stage, following in pairwise(order):
        assert through[stage][1] == through[following][0] != "0"
    assert (chapters["raster"].reason == COMPUTED) == (fill != "bounding-box")
    assert "seen in the end" in chapters["shade"].reason


@pytest.mark.parametrize(("name", "is_behind"), [("near-plane", True), ("single-triangle", False)])
def test_a_part_behind_the_eye_is_named_where_nothing_is_clipped(name: str, is_behind: bool) -> None:
    assert ("behind the eye" in chapters_by_stage(name)["clip"].reason) == is_behind


@in_turns(
    antialiasing=["none", "msaa-4", "ssaa-4", "area"],
    more=[{}, {"polygon_mode": "wireframe"}, {"visibility": "painters"}],
)
def test_the_rail_counts_the_rows(antialiasing: str, more: dict[str, str]) -> None:
    """Triangles hide each other: what is shaded before the depth test is counted, too."""
    run = trace(make_scene("intersecting"), Settings(antialiasing=antialiasing, **more))
    counts = traced_counts(run)
    for stage in ("interpolate", "shade", "depth", "blend"):
        # The painter's sort has rows of no pixel before them.
        assert counts[stage][0] == np.count_nonzero(run.stage(stage).pixel[:, 0] >= 0), stage
    assert counts["raster"][1] == counts["depth"][0] == run.stage("raster").marks["covered"].sum()
    assert counts["depth"][1] == counts["blend"][0]


@pytest.mark.parametrize(
    ("antialiasing", "counted"),
    [
        ("none", "pixels fragments fragments fragments pixels"),
        ("msaa-4", "samples samples fragments samples samples"),
        ("ssaa-4", "samples samples samples samples samples"),
        ("area", "pixels fragments fragments fragments pieces"),
    ],
)
def test_the_rail_names_what_it_counts(antialiasing: str, counted: str) -> None:
    chapters = chapters_by_stage("single-triangle", antialiasing=antialiasing)
    given = [chapters[stage].counts.split()[-1] for stage in ("bin", "raster", "shade", "depth")]
    taken = chapters["resolve"].counts.split(" → ")[0].split()
    assert [*given, (taken[1:] or ["pixels"])[0]] == counted.split()
    assert chapters["resolve"].counts.endswith(" pixels")


@pytest.mark.parametrize("mode", ["fill", "wireframe"])
def test_a_triangle_in_focus_is_counted_alone(mode: str) -> None:
    run = trace(make_scene("torus"), Settings(polygon_mode=mode), triangle=1161, region=(246, 251, 24, 16))
    counts = traced_counts(run)
    assert counts["transform"] == counts["edges"] == (1, 1)
    for stage, following in pairwise(("bin", "raster", "interpolate", "shade", "depth", "blend")):
        assert counts[stage][1] == counts[following][0] > 0
    assert counts["shade"][1] == run.stage("shade").steps.row_count


def test_an_empty_picture_computes_nothing() -> None:
    away = ClipScene([[[4, 4, 0, 1], [5, 4, 0, 1], [4, 5, 0, 1]]], size=(8, 8))
    chapter = chapters_of(trace(away), current="raster", is_predicting=False)[STAGES.index("raster")]
    assert chapter.counts == "0 pixels → 0 fragments"
    assert chapter.reason == ""


def test_one_is_not_written_in_the_plural() -> None:
    chapters = chapters_by_stage("single-triangle")
    assert chapters["cull"].counts == "1 → 1 triangle"
    assert chapters["bin"].counts == "1 triangle → 816 pixels"
    assert chapters_by_stage("single-triangle", is_predicting=True)["cull"].counts == "? → ? triangles"


def test_the_present_stage_and_those_that_nobody_chose() -> None:
    chapters = chapters_by_stage("single-triangle")
    assert chapters["raster"].state is ChapterState.CURRENT
    assert chapters["clip"].state is ChapterState.SKIPPED
    assert not chapters["clip"].is_inserted
    states = [chapter.state for stage, chapter in chapters.items() if stage != "clip"]
    assert states == [ChapterState.DONE] * 4 + [ChapterState.CURRENT] + [ChapterState.AHEAD] * 5


def test_a_prediction_is_not_told() -> None:
    chapters = chapters_by_stage("single-triangle", is_predicting=True)
    assert not any(sign.isdigit() for chapter in chapters.values() for sign in chapter.counts)
    assert chapters["raster"].short_counts == "? px → ? frag"
