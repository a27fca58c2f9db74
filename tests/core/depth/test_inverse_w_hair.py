"""A pixel that snapping gives to a steep triangle may lie where its 1/w is below 0: it must not win."""

import numpy as np

from core import Settings, draw_triangles
from tests.core.strategies import clip_of_window


def test_a_hair_of_negative_inverse_w_is_not_the_nearest() -> None:
    size = (2, 2)
    far_and_steep = clip_of_window(
        [[(0.5015, 0.2), (0.5055, 0.5), (0.5015, 0.9)]], size, [[1000.0, 1.0, 1000.0]]
    )
    near = clip_of_window([[(0, 0), (2, 0), (0, 2)]], size, 2.0)
    frame = draw_triangles(np.concatenate([near, far_and_steep]), *size, settings=Settings(depth="inverse-w"))
    assert frame.primitive[0, 0] == 0
    assert frame.depth[0, 0] == 0.5
    assert (frame.depth >= 0).all()
