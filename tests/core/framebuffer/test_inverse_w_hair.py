"""depth=inverse-w: a pixel that snapping gives to a steep triangle may lie where its 1/w is below 0: it wins over everything.

nearness_key of a negative float32 is above 2^31, its shift by 32 overflows int64 to a negative key: nearest of all.
run_depth_tests rejects the same fragment (-0.37 > 0 is false): the picture and the trace disagree.
Proposal: clamp 1/w to [1/max w, 1/min w] of the corners where all w > 0, as depth is clamped (else test 1/w > 0).
"""
import numpy as np

from core import Settings, draw_triangles
from tests.core.strategies import clip_of_window


def test_a_hair_of_negative_inverse_w_is_not_the_nearest() -> None:
    size = (2, 2)
    far_and_steep = clip_of_window([[(0.5015, 0.2), (0.5055, 0.5), (0.5015, 0.9)]], size, [[1000.0, 1.0, 1000.0]])
    near = clip_of_window([[(0, 0), (2, 0), (0, 2)]], size, 2.0)
    frame = draw_triangles(np.concatenate([near, far_and_steep]), *size, settings=Settings(depth="inverse-w"))
    assert frame.primitive[0, 0] == 0
    assert frame.depth[0, 0] == 0.5
    assert (frame.depth >= 0).all()
