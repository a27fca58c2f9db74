"""Triangles with edges that have one end behind the eye, at infinity or too far away to be snapped."""

import numpy as np

from tests.core.strategies import clip_of_window

FAR = 2.0**17
"""Pixels: corners farther away than half of this are not snapped."""


def one_ended_triangles(
    seed: int, count: int, size: tuple[int, int], gaps=(0.01, 1000.0), sizes=(0.0001, 1000.0)
) -> np.ndarray:
    """Return (T, 3, 4) triangles with one or two corners behind the eye, at w = 0 or far away, of any angle and size.

    A gap is the distance in pixels from the first corner to where a corner behind the eye projects to.
    """
    source = np.random.default_rng(seed)

    def spread(low: float, high: float) -> np.ndarray:
        angle = source.uniform(0, 2 * np.pi, count)
        reach = np.exp(source.uniform(np.log(low), np.log(high), count))
        return reach[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)

    window = np.empty((count, 3, 2))
    window[:, 0] = source.uniform(-0.2, 1.2, (count, 2)) * size
    window[:, 1] = window[:, 0] + spread(*gaps)
    window[:, 2] = window[:, 0] + spread(*sizes)
    w = np.exp(source.uniform(-3, 3, (count, 3)))
    w[:, 1] *= -1
    clip = clip_of_window(window, size, w)
    kind = source.integers(0, 8, count)
    direction = np.concatenate([spread(0.1, 10), np.zeros((count, 2))], axis=1)
    clip[kind == 0, 1] = direction[kind == 0]  # At infinity: w = 0.
    far = clip_of_window(window[:, 0] + spread(FAR, 1e9), size)
    clip[kind == 1, 1] = far[kind == 1]
    behind = clip_of_window(window[:, 0] + spread(*gaps), size, -np.exp(source.uniform(-3, 3, count)))
    clip[kind == 2, 2] = behind[kind == 2]
    turned = source.permuted(np.tile(np.arange(3), (count, 1)), axis=1)
    return np.take_along_axis(clip, turned[:, :, None], axis=1)
