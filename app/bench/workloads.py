"""The workloads by name."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.bench.meshes import lit_sphere, textured_floor, textured_knot
from app.bench.random_triangles import DARKEST, large_triangle, random_triangles
from app.bench.records import ColdStart, Lines, WindowTriangles, Work

FLAT = ((255, 40, 20),) * 3
RAINBOW = ((255, 40, 20), (20, 250, 60), (30, 80, 240))


@dataclass(frozen=True)
class Workload:
    """One picture to be drawn."""

    name: str
    title: str
    make: Callable[[], Work]


def small_triangles() -> WindowTriangles:
    """Return workload B: 2,000 triangles of 100 pixels each in 512 x 512."""
    return random_triangles(42, 2000, (512, 512), 100.0)


def random_lines() -> Lines:
    """Return 1,000 lines between random pixels of 1024 x 1024."""
    rng = np.random.default_rng(46)
    ends = rng.integers(0, 1024, (1000, 4))
    return Lines(ends, rng.integers(DARKEST, 256, (1000, 3)).astype(np.uint8), (1024, 1024))


WORKLOADS = (
    Workload("A1", "one large triangle, flat", lambda: large_triangle(FLAT)),
    Workload("A2", "one large triangle, depth and Gouraud", lambda: large_triangle(RAINBOW)),
    Workload("B", "2,000 triangles of 100 pixels", small_triangles),
    Workload("C", "20,000 triangles of 16 pixels", lambda: random_triangles(43, 20000, (512, 512), 16.0)),
    Workload("D", "81,920-triangle sphere, whole pipeline", lit_sphere),
    Workload("E", "textured floor, clipped, bilinear", textured_floor),
    Workload("F", "1,000 lines", random_lines),
    Workload("G", "200,000-triangle knot, texture and Phong", textured_knot),
    Workload("H", "10,000 blended triangles", lambda: random_triangles(44, 10000, (512, 512), 100.0, True)),
    Workload("I", "first picture from a cold start", lambda: ColdStart(small_triangles())),
)
"""All workloads, in the order in which they are run."""
