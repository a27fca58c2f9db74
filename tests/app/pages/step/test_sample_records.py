"""Which triangle has which sample after a step."""

import numpy as np
import pytest

from app.pages.step.grid_records import sample_dots
from app.session.moment import Cursor, Step
from core import Settings, render, trace
from lessons.scenes import make_scene

SAMPLED = [
    Settings(antialiasing="msaa-4"),
    Settings(antialiasing="msaa-4", fill="bounding-box", visibility="last-drawn"),
    Settings(antialiasing="ssaa-n", samples_across=3),
]
REGION = (3, 2, 14, 9)


@pytest.mark.parametrize("settings", SAMPLED, ids=str)
def test_samples_fill_from_the_first_row_of_the_raster_to_the_last_of_depth(settings: Settings) -> None:
    scene = make_scene("intersecting")
    traced = trace(scene, settings, region=REGION)
    samples = render(scene, settings).samples
    wanted = samples.primitive[:, 2:11, 3:17]
    for stage, hidden in (("depth", False), ("blend", False), ("resolve", False)):
        of_stage = traced.stage(stage)
        dots = sample_dots(Step(traced, Cursor(stage, of_stage.steps.count), hidden))
        assert np.array_equal(dots.shown, wanted)
        assert np.array_equal(dots.position, samples.position)
    for stage in ("transform", "edges", "bin", "raster", "depth"):
        start = sample_dots(Step(traced, Cursor(stage)))
        assert (start.shown == -1).all()
    raster = traced.stage("raster")
    counts = []
    for position in range(0, raster.steps.count + 1, max(raster.steps.count // 40, 1)):
        dots = sample_dots(Step(traced, Cursor("raster", position)))
        counts.append(int((dots.shown >= 0).sum()))
    assert (np.diff(counts) >= 0).all()
    end, shaded = (
        sample_dots(Step(traced, Cursor(name, traced.stage(name).steps.count)))
        for name in ("raster", "shade")
    )
    assert np.array_equal(end.shown, shaded.shown)
    assert np.array_equal(end.shown >= 0, wanted >= 0)


def test_one_sample_has_no_dots_and_a_prediction_tells_nothing() -> None:
    scene = make_scene("intersecting")
    for antialiasing in ("none", "area"):
        traced = trace(scene, Settings(antialiasing=antialiasing), region=REGION)
        assert sample_dots(Step(traced, Cursor("raster", 5))) is None
    traced = trace(scene, Settings(antialiasing="msaa-4"), region=REGION)
    dots = sample_dots(
        Step(traced, Cursor("resolve", traced.stage("resolve").steps.count), is_predicting=True)
    )
    assert (dots.shown == -1).all()
