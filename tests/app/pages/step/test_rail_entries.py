"""The entries of the pipeline rail: counts that fit together, and why a stage is there."""

import pytest

from app.pages.step.rail_entries import COMPUTED, rail_entries
from core import STAGES, Settings, render
from core.records.frame import StageCount
from lessons.scenes import make_scene
from widgets.timeline.pipeline_rail import StageEntry, StageState


def entries_of(counts: dict[str, StageCount], is_predicting: bool = False) -> dict[str, StageEntry]:
    found = rail_entries(
        counts,
        current="raster",
        whole_seconds=sum(count.seconds for count in counts.values()),
        measured="the traced picture",
        coverage="snapped",
        is_predicting=is_predicting,
    )
    return dict(zip(STAGES, found, strict=True))


@pytest.mark.parametrize("fill", ["spans", "bounding-box", "scanline"])
def test_pixels_come_out_of_pixels(fill: str) -> None:
    counts = render(make_scene("intersecting"), Settings(fill=fill)).statistics
    entries = entries_of(counts)
    incoming, outgoing = entries["raster"].counts.split(" → ")
    assert incoming == entries["bin"].counts.split(" → ")[1] != "0"
    assert outgoing == entries["depth"].counts.split(" → ")[0]
    assert (entries["raster"].reason == COMPUTED) == (counts["raster"].incoming == 0)
    assert (fill == "spans") <= (entries["raster"].reason == COMPUTED)


def test_an_empty_picture_computes_nothing() -> None:
    entries = entries_of({stage: StageCount() for stage in STAGES})
    assert entries["raster"].counts == "0 → 0"
    assert entries["raster"].reason == ""
    assert entries["raster"].share == 0


def test_the_present_stage_and_those_that_nobody_chose() -> None:
    entries = entries_of(render(make_scene("single-triangle"), Settings()).statistics)
    assert entries["raster"].state is StageState.CURRENT
    assert entries["clip"].state is StageState.SKIPPED
    assert not entries["clip"].is_inserted


def test_a_prediction_is_not_told() -> None:
    entries = entries_of(render(make_scene("single-triangle"), Settings()).statistics, is_predicting=True)
    assert {entry.counts for entry in entries.values()} == {"? → ?"}
