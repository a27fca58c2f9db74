"""Each pixel exactly once at a hub on a pixel centre whose rim lies behind the eye.

Edges with one snapped end pass through it exactly; rounded, each would get a sign of its own there.
"""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.core.drawing import cover_each
from tests.core.meshes import fan
from tests.core.strategies import clip_of_window


@given(st.integers(0, 2**32 - 1), st.integers(4, 9))
def test_fan_around_a_pixel_centre_with_its_rim_behind_the_eye(seed: int, count: int) -> None:
    # The rim is behind the eye: seen from the hub its corners lie opposite to where they project to.
    generator = np.random.default_rng(seed)
    size = (16, 16)
    hub = clip_of_window([[generator.integers(2, 14, 2) + 0.5]], size, generator.uniform(0.1, 3))[0, 0]
    angle = (np.arange(count) + generator.uniform(-0.3, 0.3, count)) * 2 * np.pi / count
    w = generator.uniform(-2, -0.1, count)
    reach = generator.uniform(0.5, 5, count)
    rim = np.stack([np.cos(angle) * reach, np.sin(angle) * reach, np.zeros(count), w], axis=1)
    rim[:, :2] += (w / hub[3])[:, None] * hub[:2]
    assert (cover_each(fan(hub, rim), size).sum(axis=0) == 1).all()


def test_minimal() -> None:
    # Hub at the centre (1.5, 1.5) with w = 0.1 (a power of two would be exact), four rim corners at w = -0.7.
    hub = [-0.025, -0.025, 0.0, 0.1]
    rim = np.array(
        [
            [1.175, 0.27499999999999997],
            [0.07499999999999996, 1.175],
            [-0.8250000000000001, 0.07499999999999996],
            [0.27499999999999997, -0.8250000000000001],
        ]
    )
    rim = np.concatenate([rim, np.zeros((4, 1)), np.full((4, 1), -0.7)], axis=1)
    assert (cover_each(fan(hub, rim), (4, 4)).sum(axis=0) == 1).all()
