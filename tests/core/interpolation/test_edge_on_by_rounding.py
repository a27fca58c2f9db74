"""Three corners on a line: the determinant is 0 but for rounding, and snapping may still open the triangle."""

import numpy as np
import pytest

from core import Settings, draw_triangles
from tests.core.strategies import clip_of_window


@pytest.mark.parametrize(
    "points",
    [[(9.599, 6.908), (10.235, 3.092), (9.359, 8.348)], [(4.714, 3.155), (1.354, -2.605), (7.507, 7.943)]],
)
def test_a_triangle_on_a_line_that_snapping_opens_has_the_values_of_its_corners(points) -> None:
    clip = clip_of_window([points], (16, 16))
    frame = draw_triangles(
        clip, 16, 16, attributes=[[[0.0], [0.5], [1.0]]], settings=Settings(visibility="last-drawn")
    )
    seen = frame.attributes[frame.primitive == 0]
    assert len(seen)
    assert (np.abs(seen - 0.5) <= 0.5 + 1e-6).all()
