"""Edge functions by additions, whose sums drift over thousands of pixels."""

import numpy as np

from core.scene import ClipScene
from core.study.accuracy.workloads import on_lattice
from core.study.stability.coverage.covered_pixels import CoverageExperiment, on_its_lattice
from core.study.stability.coverage.number_formats import powers, scene_of_window
from core.study.stability.record import Axis, ExperimentInfo

LENGTHS = powers(4, 13)


def long_triangle(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a flat triangle across a raster of ``length`` x 8 pixels; its long side climbs ``rise`` pixels."""
    length, rise = place
    window = np.array([[-1.0, 0.3], [length + 1.0, 0.3 + rise], [length / 3, 9.0]])
    return scene_of_window(on_lattice(window, 1 << 16)[None], (int(length), 8))


INCREMENTAL = CoverageExperiment(
    ExperimentInfo(
        "incremental-drift",
        "Edge functions by additions",
        "A flat triangle is filled by adding a from pixel to pixel: how long until the sums have drifted?",
        (
            Axis("length", "Width of the triangle", "pixels", LENGTHS, True),
            Axis("rise", "Rise of its long side", "pixels", (0.7, 1.3, 1.9, 2.6, 3.3, 4.1, 5.3, 6.7)),
        ),
        (
            "coverage=float16 fill=incremental",
            "coverage=float32 fill=incremental",
            "coverage=float32",
            "coverage=float64 fill=incremental",
            "coverage=snapped fill=incremental",
            "coverage=int64 fill=incremental",
            "coverage=float64",
        ),
        "Sums in float16 drift from the start, and in float32 within a few thousand pixels, where "
        "evaluating every pixel in float32 is still right; float64 and whole numbers do not drift.",
    ),
    long_triangle,
    on_its_lattice,
)
EXPERIMENTS = (INCREMENTAL,)
