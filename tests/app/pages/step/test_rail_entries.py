"""The entries of the pipeline rail: counts that fit together, and why a stage is there."""

from itertools import pairwise

import pytest

from app.pages.step.rail_entries import COMPUTED, rail_entries, traced_counts
from core import STAGES, ClipScene, Settings, trace
from lessons.scenes import make_scene
from widgets.timeline.pipeline_rail import StageEntry, StageState


def entries_of(name: str, is_predicting: bool = False, **settings: str) -> dict[str, StageEntry]:
    run = trace(make_scene(name), Settings(**settings))
    found = rail_entries(run, current="raster", is_predicting=is_predicting)
    return dict(zip(STAGES, found, strict=True))


@pytest.mark.parametrize("fill", ["spans", "bounding-box", "scanline"])
def test_what_comes_out_of_a_stage_goes_into_the_next(fill: str) -> None:
    entries = entries_of("intersecting", fill=fill)
    through = {stage: entry.counts.split(" → ") for stage, entry in entries.items()}
    order = ("bin", "raster", "interpolate", "shade", "depth", "blend")
    for stage, following in pairwise(order):
        assert through[stage][1] == through[following][0] != "0"
    assert (entries["raster"].reason == COMPUTED) == (fill != "bounding-box")
    assert "seen in the end" in entries["shade"].reason


def test_several_samples_are_counted_as_the_picture_counts_them() -> None:
    run = trace(make_scene("intersecting"), Settings(antialiasing="msaa-4"))
    counts = run.source.picture.statistics
    assert traced_counts(run)["shade"] == (counts["shade"].incoming, counts["shade"].outgoing)


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
    entry = rail_entries(trace(away), current="raster", is_predicting=False)[STAGES.index("raster")]
    assert entry.counts == "0 → 0"
    assert entry.reason == ""


def test_the_present_stage_and_those_that_nobody_chose() -> None:
    entries = entries_of("single-triangle")
    assert entries["raster"].state is StageState.CURRENT
    assert entries["clip"].state is StageState.SKIPPED
    assert not entries["clip"].is_inserted
    assert sum(entry.share or 0 for entry in entries.values()) == pytest.approx(1)


def test_a_prediction_is_not_told() -> None:
    entries = entries_of("single-triangle", is_predicting=True)
    assert {entry.counts for entry in entries.values()} == {"? → ?"}
