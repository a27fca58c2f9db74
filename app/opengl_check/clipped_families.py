"""Families of random cases off the grid, and that OpenGL clips: through the eye, at infinity, beyond near and far.

Corners lie anywhere, not on the 1/256-pixel grid. OpenGL computes window positions in float32 and snaps the corners
that clipping makes, so its edges lie elsewhere than the core's, by a step's diagonal at most: see
`app.opengl_check.judge`.
"""

from collections.abc import Callable

import numpy as np

from app.opengl_check.case import Case, clip_positions
from app.opengl_check.shapes import gradual_values, perspective_matrix, random_rotation
from core.records.arrays import Floats, Singles


def _size(rng: np.random.Generator, limit: int) -> tuple[int, int]:
    width, height = rng.integers(max(8, limit // 3), limit + 1, 2)
    return int(width), int(height)


def _away(rng: np.random.Generator, shape: tuple[int, ...], nearest: float, farthest: float) -> Floats:
    """Return offsets (*shape, 2) in any direction, their lengths between two of any magnitude."""
    angle = rng.uniform(0, 2 * np.pi, shape)
    length = np.exp(rng.uniform(np.log(nearest), np.log(farthest), shape))
    offsets: Floats = length[..., None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return offsets


def _case(family: str, rng: np.random.Generator, clip: Floats | Singles, size: tuple[int, int]) -> Case:
    values = gradual_values(rng, (len(clip), 3, 3))
    return Case(family, np.asarray(clip, np.float32), values, size, interpolation="flat")


def off_grid(rng: np.random.Generator, limit: int) -> Case:
    """Triangles in the window, in front of the eye, with corners anywhere: nothing is clipped."""
    size = _size(rng, limit)
    count = int(rng.integers(1, 6))
    window = rng.uniform(0.01, 0.99, (count, 3, 2)) * size
    depth, w = rng.uniform(0.1, 0.9, (count, 3)), np.exp(rng.uniform(-1, 1, (count, 3)))
    return _case("off-grid", rng, clip_positions(window, depth, w, size), size)


def one_ended(rng: np.random.Generator, limit: int) -> Case:
    """A triangle with a corner behind the eye that projects to within 0.01 to 1,000 pixels of another one."""
    size = _size(rng, limit)
    window = np.empty((1, 3, 2))
    window[:, 0] = rng.uniform(0.05, 0.95, (1, 2)) * size
    window[:, 1] = window[:, 0] + _away(rng, (1,), 0.01, 1000)
    window[:, 2] = window[:, 0] + _away(rng, (1,), 1, 1000)
    w = np.exp(rng.uniform(-1, 1, (1, 3))) * [1, -1, rng.choice([1, 1, -1])]
    clip = clip_positions(window, rng.uniform(0.3, 0.7, (1, 3)), w, size)
    return _case("one-ended", rng, clip[:, rng.permutation(3)], size)


def ground(rng: np.random.Generator, limit: int) -> Case:
    """A floor, a wall or a ceiling of up to 72 triangles around the eye, as far as the far plane and behind the eye."""
    size = _size(rng, limit)
    cells = int(rng.integers(1, 7))
    along, across = (np.sort(rng.uniform(-25, 25, cells + 1)) for _ in range(2))
    along[0], along[-1] = -rng.uniform(5, 60), rng.uniform(0.5, 20)
    place = np.stack([*np.meshgrid(across, along), np.zeros((cells + 1, cells + 1))], axis=-1)
    place[..., 2] = rng.choice([-1, 1]) * np.exp(rng.uniform(-3, 1.5))
    points = np.concatenate([place[..., [0, 2, 1]], np.ones((cells + 1, cells + 1, 1))], axis=-1)
    if rng.random() < 0.5:
        points = points @ random_rotation(rng).T
    clip = points @ perspective_matrix(rng.uniform(0.6, 1.4), size[0] / size[1], 0.1, 40).T
    a, b, c, d = clip[:-1, :-1], clip[:-1, 1:], clip[1:, 1:], clip[1:, :-1]
    triangles = np.stack([np.stack([a, b, c], axis=-2), np.stack([a, c, d], axis=-2)])
    return _case("ground", rng, triangles.reshape(-1, 3, 4), size)


def any_w(rng: np.random.Generator, limit: int) -> Case:
    """Triangles with corners anywhere in clip space, of any sign of w."""
    size = _size(rng, limit)
    clip = rng.normal(size=(int(rng.integers(1, 5)), 3, 4)) * [1, 1, 0.5, 1]
    return _case("any-w", rng, clip, size)


def zero_w(rng: np.random.Generator, limit: int) -> Case:
    """A triangle with one or two corners at infinity, w = 0."""
    size = _size(rng, limit)
    clip = rng.normal(size=(1, 3, 4)) * [1, 1, 0.5, 1]
    clip[..., 3] = np.abs(clip[..., 3]) + 0.2
    clip[0, : rng.integers(1, 3), 3] = 0
    return _case("zero-w", rng, clip[:, rng.permutation(3)], size)


def guard_band(rng: np.random.Generator, limit: int) -> Case:
    """A triangle in front of the eye that reaches from the window to up to 100,000 pixels outside."""
    size = _size(rng, limit)
    window = rng.uniform(0, 1, (1, 1, 2)) * size + _away(rng, (1, 3), 1, 100_000)
    depth, w = rng.uniform(0.1, 0.9, (1, 3)), np.exp(rng.uniform(-1, 1, (1, 3)))
    return _case("guard-band", rng, clip_positions(window, depth, w, size), size)


def depth_planes(rng: np.random.Generator, limit: int) -> Case:
    """Triangles in front of the eye that reach beyond the near plane, the far plane or both."""
    size = _size(rng, limit)
    count = int(rng.integers(1, 4))
    window = rng.uniform(-0.3, 1.3, (count, 3, 2)) * size
    depth, w = rng.uniform(-1, 2, (count, 3)), np.exp(rng.uniform(-1, 1, (count, 3)))
    return _case("depth-planes", rng, clip_positions(window, depth, w, size), size)


CLIPPED_FAMILIES: dict[str, Callable[[np.random.Generator, int], Case]] = {
    "off-grid": off_grid,
    "one-ended": one_ended,
    "ground": ground,
    "any-w": any_w,
    "zero-w": zero_w,
    "guard-band": guard_band,
    "depth-planes": depth_planes,
}
"""The families by name; each makes one case from a random generator and the largest raster side."""
