"""What is said of a line's pale pixel on a ray, and of a depth outside of its triangle."""

from collections.abc import Iterator

import numpy as np

from core import ClipScene, Settings, trace
from core.explain.steps import sentence
from core.trace import StageTrace
from tests.core.strategies import clip_of_window


def sentences(found: StageTrace, row: int) -> Iterator[str]:
    """Yield what is said of the operations of a row."""
    start, end = found.steps.starts[row : row + 2]
    for position in range(start + 1, end + 1):
        column, line = found.pixel[row].tolist()
        yield sentence(found.explain(position), int(found.triangle[row]), (column, line))


def test_a_pale_pixel_hides_nothing_from_the_ray():
    corners = [[(-9.0, 5.7), (40.0, 5.7), (15.0, 40.0)], [(-9.0, 6.2), (40.0, 6.2), (15.0, -40.0)]]
    scene = ClipScene(clip_of_window(corners, (9, 12), 1.0, np.array([[0.5], [-0.5]])), None, (9, 12))
    settings = Settings(polygon_mode="wireframe", line="wu", visibility="ray-casting")
    found = trace(scene, settings).stage("depth")
    pale = found.columns["passes"] & ~found.columns["writes"]
    alone, behind = (np.flatnonzero(pale & (found.columns["nearest"] == nearest))[0] for nearest in (-1, 0))
    end = "stays the nearest on the ray, as the line covers less than half of this pixel"
    assert f": nothing {end}" in list(sentences(found, alone))[-1]
    assert f": triangle 0 {end}" in list(sentences(found, behind))[-1]


def test_a_depth_outside_of_the_triangle_is_limited():
    clip = clip_of_window([[[5.5, 3.5], [4.5, 5.75], [5, 4.5]]], (6, 6), 1.0, [0.6, 0.6, -0.5])
    settings = Settings(fill="scanline-lecture", depth="fixed-38")
    found = trace(ClipScene(clip, None, (6, 6)), settings).stage("depth")
    row = int(np.argmin(found.columns["stored"]))
    assert found.columns["stored"][row] == -(2**20)
    said = next(sentences(found, row))
    assert "its integer plane is at −82,463,372,083 of 2³⁸" in said
    assert "limited to −2²⁰ … 2³⁸ + 2²⁰, which gives −1,048,576" in said
