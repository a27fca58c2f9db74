"""Every sample has a history, which ends in what the picture has at that sample."""

import numpy as np
import pytest

from core import Settings, render
from core.pixel_history import why
from core.trace.source import TraceSource
from tests.core.trace.trace_cases import SCENES, name_of
from tests.covering import in_turn, is_everything

CHOICES = [
    {"antialiasing": "msaa-4"},
    {"antialiasing": "msaa-4", "blend": "over", "pixel_center": "integer"},
    {"antialiasing": "msaa-4", "polygon_mode": "wireframe"},
    {"antialiasing": "msaa-4", "texture_filter": "trilinear", "depth": "z-24"},
    {"antialiasing": "msaa-4", "visibility": "ray-casting", "fill": "hierarchy"},
    {"antialiasing": "ssaa-4", "blend": "over"},
    {"antialiasing": "ssaa-n", "samples_across": 3, "pixel_center": "integer", "cull": "back"},
]


@pytest.mark.parametrize(
    ("name", "choice"), in_turn(["clip", "lit", "textured-clip", "intersecting"], CHOICES), ids=name_of
)
def test_the_history_of_a_sample_ends_in_the_picture(name, choice):
    scene, settings = SCENES[name], Settings(**choice)
    samples, source = render(scene, settings).samples, TraceSource(scene, settings)
    generator = np.random.default_rng(2)
    width, height = scene.size
    for _ in range(12 if is_everything() else 4):
        column, row = int(generator.integers(width)), int(generator.integers(height))
        for sample in range(len(samples.position)):
            history = why(source, column, row, sample=sample)
            at = sample, row, column
            assert (history.column, history.row, history.sample) == (column, row, sample)
            assert history.final.triangle == samples.primitive[at]
            assert history.final.color.tobytes() == samples.color[at].tobytes()
            assert samples.depth.dtype.type(history.final.depth) == samples.depth[at]
            assert history.cover_count == samples.cover_count[at]


def test_a_sample_that_is_not_there_is_refused():
    scene = SCENES["clip"]
    with pytest.raises(ValueError, match="sample must be 0 to 3, got 4"):
        why(TraceSource(scene, Settings(antialiasing="msaa-4")), 1, 1, sample=4)
    with pytest.raises(ValueError, match="with several samples, got none"):
        why(TraceSource(scene, Settings()), 1, 1, sample=0)


def test_an_edge_between_two_samples_splits_their_histories():
    scene = SCENES["single-triangle"]
    settings = Settings(antialiasing="msaa-4")
    shown, source = render(scene, settings).samples.primitive, TraceSource(scene, settings)
    row, column = np.argwhere((shown >= 0).sum(axis=0) == 2)[0]
    keys = [why(source, int(column), int(row), sample=k).verdict.key for k in range(4)]
    assert sorted(keys) == ["all-missed", "all-missed", "seen", "seen"]
