"""Families of random cases for the comparison with OpenGL, on the grid, off it and clipped, from a seed.

Corners lie anywhere, not on the 1/256-pixel grid. OpenGL computes window positions in float32 and snaps the corners
that clipping makes, so its edges lie elsewhere than the core's, by a step's diagonal at most: see
`app.opengl_check.compare`.

OpenGL leaves three things to an implementation, and most cases keep clear of them, so that a picture has only
one right answer. Window positions are computed in float32: corners stand near the middle of a step of the
1/256-pixel grid, never where a rounding error would snap them to the next one. Triangles that reach out of
the window may be clipped there and snapped again: the clip planes are moved out (``guard``), except in the
families that are about clipping and those of `app.opengl_check.families`. Values are evaluated in
float32: see `app.opengl_check.compare`.
"""

from collections.abc import Callable

import numpy as np

from app.opengl_check.cases import (
    STEP,
    Case,
    clip_positions,
    fan,
    gradual_values,
    grid_corners,
    grid_mesh,
    icosphere,
    perspective_matrix,
    random_rotation,
    settle,
    torus,
    turned,
)
from core.records.arrays import Floats, Singles
from core.scene import Texture

# Families of random cases off the grid, and that OpenGL clips: through the eye, at infinity, beyond near
# and far.


def _any_size(rng: np.random.Generator, limit: int) -> tuple[int, int]:
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
    size = _any_size(rng, limit)
    count = int(rng.integers(1, 6))
    window = rng.uniform(0.01, 0.99, (count, 3, 2)) * size
    depth, w = rng.uniform(0.1, 0.9, (count, 3)), np.exp(rng.uniform(-1, 1, (count, 3)))
    return _case("off-grid", rng, clip_positions(window, depth, w, size), size)


def one_ended(rng: np.random.Generator, limit: int) -> Case:
    """A triangle with a corner behind the eye that projects to within 0.01 to 1,000 pixels of another one."""
    size = _any_size(rng, limit)
    window = np.empty((1, 3, 2))
    window[:, 0] = rng.uniform(0.05, 0.95, (1, 2)) * size
    window[:, 1] = window[:, 0] + _away(rng, (1,), 0.01, 1000)
    window[:, 2] = window[:, 0] + _away(rng, (1,), 1, 1000)
    w = np.exp(rng.uniform(-1, 1, (1, 3))) * [1, -1, rng.choice([1, 1, -1])]
    clip = clip_positions(window, rng.uniform(0.3, 0.7, (1, 3)), w, size)
    return _case("one-ended", rng, clip[:, rng.permutation(3)], size)


def ground(rng: np.random.Generator, limit: int) -> Case:
    """A floor, a wall or a ceiling of up to 72 triangles around the eye, as far as the far plane and behind the eye."""
    size = _any_size(rng, limit)
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
    size = _any_size(rng, limit)
    clip = rng.normal(size=(int(rng.integers(1, 5)), 3, 4)) * [1, 1, 0.5, 1]
    return _case("any-w", rng, clip, size)


def zero_w(rng: np.random.Generator, limit: int) -> Case:
    """A triangle with one or two corners at infinity, w = 0."""
    size = _any_size(rng, limit)
    clip = rng.normal(size=(1, 3, 4)) * [1, 1, 0.5, 1]
    clip[..., 3] = np.abs(clip[..., 3]) + 0.2
    clip[0, : rng.integers(1, 3), 3] = 0
    return _case("zero-w", rng, clip[:, rng.permutation(3)], size)


def guard_band(rng: np.random.Generator, limit: int) -> Case:
    """A triangle in front of the eye that reaches from the window to up to 100,000 pixels outside."""
    size = _any_size(rng, limit)
    window = rng.uniform(0, 1, (1, 1, 2)) * size + _away(rng, (1, 3), 1, 100_000)
    depth, w = rng.uniform(0.1, 0.9, (1, 3)), np.exp(rng.uniform(-1, 1, (1, 3)))
    return _case("guard-band", rng, clip_positions(window, depth, w, size), size)


def depth_planes(rng: np.random.Generator, limit: int) -> Case:
    """Triangles in front of the eye that reach beyond the near plane, the far plane or both."""
    size = _any_size(rng, limit)
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


# Families of random cases for the comparison with OpenGL, made afresh from a seed.


def _size(rng: np.random.Generator, limit: int, even: bool = False) -> tuple[int, int]:
    """Return width and height up to ``limit``: any numbers, or even ones, or powers of two."""
    if rng.random() < 0.25:
        width, height = 2 ** rng.integers(3, int(np.log2(limit)) + 1, 2)
    else:
        width, height = rng.integers(max(8, limit // 3), limit + 1, 2) & (-2 if even else -1)
    return int(width), int(height)


def _weights(rng: np.random.Generator, shape: tuple[int, ...]) -> Floats:
    """Return clip w: all 1, or from 0.4 to 5."""
    return np.ones(shape) if rng.random() < 0.4 else np.exp(rng.uniform(np.log(0.4), np.log(5), shape))


def _big_triangle(rng: np.random.Generator, size: tuple[int, int]) -> Floats:
    """Return three corners (3, 2) that cover at least a thirtieth of the window."""
    while True:
        corners = grid_corners(rng, size, 3)
        (ax, ay), (bx, by) = corners[1] - corners[0], corners[2] - corners[0]
        if abs(ax * by - ay * bx) > size[0] * size[1] / 15:
            return corners


def _single(rng: np.random.Generator, limit: int) -> Case:
    size = _size(rng, limit)
    corners = _big_triangle(rng, size)[None]
    clip = clip_positions(corners, rng.uniform(0.05, 0.95, (1, 3)), _weights(rng, (1, 3)), size)
    return Case("single", clip, gradual_values(rng, (1, 3, 3)), size)


def _culling(rng: np.random.Generator, limit: int) -> Case:
    size = _size(rng, limit)
    corners = np.stack([_big_triangle(rng, size) for _ in range(5)])
    clip = clip_positions(corners, rng.uniform(0.05, 0.95, (5, 3)), _weights(rng, (5, 3)), size)
    return Case(
        "culling", clip, gradual_values(rng, (5, 3, 3)), size, cull=str(rng.choice(["back", "front"]))
    )


def _flat(rng: np.random.Generator, limit: int) -> Case:
    size = _size(rng, limit)
    corners = np.stack([_big_triangle(rng, size) for _ in range(3)])
    clip = clip_positions(corners, rng.uniform(0.05, 0.95, (3, 3)), _weights(rng, (3, 3)), size)
    return Case(
        "flat",
        clip,
        gradual_values(rng, (3, 3, 3)),
        size,
        interpolation="flat",
        provoking=str(rng.choice(["first", "last"])),
    )


def _noperspective(rng: np.random.Generator, limit: int) -> Case:
    size = _size(rng, limit)
    w = np.exp(rng.uniform(np.log(0.4), np.log(5), (1, 3)))
    clip = clip_positions(_big_triangle(rng, size)[None], rng.uniform(0.05, 0.95, (1, 3)), w, size)
    return Case("noperspective", clip, gradual_values(rng, (1, 3, 3)), size, interpolation="affine")


def _shared(rng: np.random.Generator, limit: int) -> Case:
    """A fan or a grid in which every edge inside belongs to two triangles, with any windings."""
    size = _size(rng, limit, even=True)
    points, triangles = (fan if rng.random() < 0.3 else grid_mesh)(rng, size)
    clip = clip_positions(points, rng.uniform(0.1, 0.9, len(points)), _weights(rng, (len(points),)), size)
    triangles = turned(rng, triangles)
    return Case("shared", clip[triangles], gradual_values(rng, (len(points), 3))[triangles], size, guard=2)


def _sliver(rng: np.random.Generator, limit: int) -> Case:
    """A long triangle 2/256 to 1.5 pixels wide: upright, level, diagonal through centres, or any way."""
    size = _size(rng, limit)
    directions = np.array([[0, 1], [1, 0], [1, 1], [1, -1], rng.normal(size=2)])
    along = directions[rng.integers(5)]
    along = along / np.abs(along).max()
    across = np.array([-along[1], along[0]])
    length = np.floor(rng.uniform(0.4, 0.8) * min(size))
    first = np.floor(np.array(size) / 2 - along * length / 2) + 0.5
    width = np.exp(rng.uniform(np.log(2 * STEP), np.log(1.5)))
    share = rng.random()
    corners = np.stack([first, first + along * length, first + along * length * share + across * width])
    corners = np.rint(corners / STEP) * STEP
    order = rng.permutation(3)
    clip = clip_positions(corners[order][None], rng.uniform(0.3, 0.7, (1, 3)), _weights(rng, (1, 3)), size)
    return Case("sliver", clip, gradual_values(rng, (1, 3, 3)), size)


def _subpixel(rng: np.random.Generator, limit: int) -> Case:
    """Triangles smaller than a pixel, most without a pixel centre; each of one colour and one depth."""
    size = _size(rng, limit, even=True)
    count = 200
    middle = rng.uniform(0, 1, (count, 1, 2)) * size
    corners = np.rint((middle + rng.normal(0, 0.4, (count, 3, 2))) / STEP) * STEP
    clip = clip_positions(corners, rng.uniform(0.1, 0.9, (count, 1)), 1, size)
    return Case("subpixel", clip, gradual_values(rng, (count, 3, 3)), size, interpolation="flat", guard=2)


def _offscreen(rng: np.random.Generator, limit: int) -> Case:
    """Triangles that reach far out of the window, up to the guard band; nothing is clipped in x and y."""
    width, height = (int(n) for n in 2 ** rng.integers(4, int(np.log2(limit)) + 1, 2))
    guard = int(2 ** rng.integers(1, int(np.log2(4096 / max(width, height))) + 1))
    reach = rng.uniform(1, guard) * 0.99
    ndc = rng.uniform(-reach, reach, (rng.integers(1, 4), 3, 2))
    corners = np.rint((ndc + 1) * (width, height) / 2 / STEP) * STEP
    w = 2.0 ** rng.integers(-1, 3, corners.shape[:2])
    clip = clip_positions(corners, rng.uniform(0.1, 0.9, w.shape), w, (width, height))
    return Case("offscreen", clip, gradual_values(rng, (*w.shape, 3)), (width, height), guard=guard)


def _clipped(rng: np.random.Generator, limit: int) -> Case:
    """Triangles that reach out of the window and are clipped at its sides."""
    size = _size(rng, limit)
    count = int(rng.integers(1, 3))
    corners = np.rint(rng.uniform(-1, 2, (count, 3, 2)) * size / STEP) * STEP
    clip = clip_positions(corners, rng.uniform(0.1, 0.9, (count, 3)), _weights(rng, (count, 3)), size)
    return Case("clipped", clip, gradual_values(rng, (count, 3, 3)), size)


def _near(rng: np.random.Generator, limit: int) -> Case:
    """Triangles through the near, eye and far plane, a plane to the horizon, points at infinity, w = 0."""
    size = _size(rng, limit)
    matrix = perspective_matrix(rng.uniform(0.6, 1.4), size[0] / size[1], 0.5, 20)
    kind = rng.integers(5)
    points = np.concatenate(
        [rng.uniform(-3, 3, (3, 2)), rng.uniform(-9, -1, (3, 1)), np.ones((3, 1))], axis=1
    )
    if kind < 3:
        behind = rng.permutation(3)[: rng.integers(1, 3)]
        points[behind, 2] = rng.uniform((-0.5, 0.0, 0.0)[kind], (0.0, 3.0, 0.0)[kind], len(behind))
        points[rng.integers(3), 2] -= rng.choice([0, 25])
        triangles = points[None]
    elif kind == 3:
        x, y, near, far = rng.uniform(2, 6), rng.choice([-1.0, 1.0]), rng.uniform(0, 6), rng.uniform(10, 60)
        corners = np.array([[-x, y, near, 1], [x, y, near, 1], [x, y, -far, 1], [-x, y, -far, 1]])
        triangles = (corners @ random_rotation(rng).T)[[[0, 1, 2], [0, 2, 3]]]
    else:
        points[2] = [*rng.normal(size=2), rng.normal() - 0.5, 0]
        triangles = points[None]
    clip = (triangles @ matrix.T).astype(np.float32)
    return Case("near", clip, gradual_values(rng, (len(clip), 3, 3)), size)


def _textured(rng: np.random.Generator, limit: int, texture_filter: str) -> Case:
    """A square of two triangles, turned in space, with a texture that it shows up to nine times."""
    size = _size(rng, limit, even=True)
    matrix = perspective_matrix(0.9, size[0] / size[1], 0.5, 20)
    side = rng.uniform(0.8, 1.7)
    square = np.array([[-side, -side, 0, 1], [side, -side, 0, 1], [side, side, 0, 1], [-side, side, 0, 1]])
    camera = square @ random_rotation(rng).T + [0, 0, -3, 0]
    clip = settle((camera @ matrix.T).astype(np.float32), size)
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * rng.choice([1, 1.5, 3]) - rng.choice([0, 0.25])
    columns, rows = [(16, 16), (8, 8), (13, 7), (5, 3)][rng.integers(4)]
    texels = rng.integers(0, 256, (rows, columns, int(rng.choice([3, 4]))))
    corners = np.array([[0, 1, 2], [0, 2, 3]])
    return Case(
        texture_filter,
        clip[corners],
        uv[corners].astype(np.float32),
        size,
        texture=Texture((texels / 256).astype(np.float32)),
        depth_test=True,
        texture_filter=texture_filter,
        wrap=str(rng.choice(["clamp", "repeat"])),
        guard=8,
    )


def _nearest(rng: np.random.Generator, limit: int) -> Case:
    return _textured(rng, limit, "nearest")


def _bilinear(rng: np.random.Generator, limit: int) -> Case:
    return _textured(rng, limit, "bilinear")


def _depth(rng: np.random.Generator, limit: int) -> Case:
    """Triangles that cut each other, or that lie at exactly the same depth: the first drawn stays."""
    size = _size(rng, limit)
    count = int(rng.integers(3, 20))
    corners = np.stack([_big_triangle(rng, size) for _ in range(count)])
    depth, w = rng.uniform(0.05, 0.95, (count, 3)), _weights(rng, (count, 3))
    if rng.random() < 0.5:
        depth, w = np.repeat(rng.integers(1, 4, (count, 1)) / 4, 3, axis=1), np.ones((count, 3))
    clip = clip_positions(corners, depth, w, size)
    twice = rng.integers(0, count, count // 3)
    clip = np.concatenate([clip, clip[twice]])
    return Case("depth", clip, gradual_values(rng, (len(clip), 3, 3)), size, depth_test=True)


def _mesh(rng: np.random.Generator, limit: int) -> Case:
    """A closed mesh of 320 triangles in perspective, its normals as colours."""
    size = _size(rng, limit, even=True)
    points, normals, triangles = icosphere(2) if rng.random() < 0.5 else torus(20, 8)
    rotation = random_rotation(rng)[:3, :3]
    camera = np.concatenate([points @ rotation.T + [0, 0, -3], np.ones((len(points), 1))], axis=1)
    matrix = perspective_matrix(0.9, size[0] / size[1], 0.5, 20)
    clip = settle((camera @ matrix.T).astype(np.float32), size)
    colors = ((normals @ rotation.T + 1) / 2).astype(np.float32)
    cull = str(rng.choice(["none", "back", "front"]))
    return Case("mesh", clip[triangles], colors[triangles], size, cull=cull, depth_test=True, guard=4)


def _octants(rng: np.random.Generator, limit: int) -> Case:
    """Lines between pixels inside all octants, an odd number of steps each, so that no pixel is a tie.

    All are shifted along themselves by 2/256 pixel: a start or end exactly on a pixel's centre is drawn by
    some implementations and lost by others, as the rounding of the window position has it. In a raster of up
    to 96 pixels the shift, and where an implementation puts the shifted end, make no other pixel nearer.
    """
    size = _size(rng, min(limit, 96))
    reach = (min(size) // 2 - 2) // 2 * 2 + 1
    major = rng.integers(0, (reach + 1) // 2, 8) * 2 + 1
    minor = (rng.random(8) * major).astype(int)
    octant = np.arange(8)
    is_steep = octant[:, None] >= 4
    signs = np.stack([1 - octant % 2 * 2, 1 - octant // 2 % 2 * 2], axis=1)
    offset = np.where(is_steep, np.stack([minor, major], 1), np.stack([major, minor], 1)) * signs
    start = np.array(size) // 2 + rng.integers(-1, 2, (8, 2))
    shift = np.where(is_steep, [0, 2], [2, 0]) * signs * rng.choice([-1, 1]) * STEP
    ends = np.stack([start, start + offset], axis=1) + 0.5 + shift[:, None]
    return _line_case(rng, "octants", ends, size)


def _line_ends(rng: np.random.Generator, limit: int) -> Case:
    """Lines with ends anywhere in the window: long, short, shorter than a pixel, and closed loops."""
    size = _size(rng, limit)
    count = int(rng.integers(3, 12))
    start = rng.uniform(0.05, 0.95, (count, 2)) * size
    kind = rng.integers(3)
    if kind == 0:
        end = rng.uniform(0.05, 0.95, (count, 2)) * size
    elif kind == 1:
        end = np.clip(start + rng.normal(0, 1, (count, 2)), 0.1, np.array(size) - 0.1)
    else:
        end = np.roll(start, -1, axis=0)
    return _line_case(rng, "line-ends", _off_ties(np.stack([start, end], axis=1)), size)


def _off_ties(window: Floats) -> Floats:
    """Move window positions off the middles and borders of pixels, each by another amount below 1/64 pixel.

    So no end lies on the border of a diamond, nor where float32 and the 1/256-pixel grid may put it on either
    side of a pixel's middle.
    """
    whole = np.floor(window * 2) / 2
    return whole + 3.3 * STEP + (window - whole) * (1 - 13 * STEP)


def _line_case(rng: np.random.Generator, family: str, segments: Floats, size: tuple[int, int]) -> Case:
    shape = segments.shape[:2]
    is_long = np.abs(segments[:, 1] - segments[:, 0]).max(axis=1) > 4
    w = np.where(is_long[:, None], rng.uniform(0.7, 1.4, shape), 1.0)
    clip = clip_positions(segments, rng.uniform(0.1, 0.9, shape), w, size)
    return Case(family, clip, gradual_values(rng, (*shape, 3)), size)


FAMILIES: dict[str, Callable[[np.random.Generator, int], Case]] = {
    "single": _single,
    "culling": _culling,
    "flat": _flat,
    "noperspective": _noperspective,
    "shared": _shared,
    "sliver": _sliver,
    "subpixel": _subpixel,
    "offscreen": _offscreen,
    "clipped": _clipped,
    "near": _near,
    "nearest": _nearest,
    "bilinear": _bilinear,
    "depth": _depth,
    "mesh": _mesh,
    "octants": _octants,
    "line-ends": _line_ends,
    **CLIPPED_FAMILIES,
}
"""The families by name; each makes one case from a random generator and the largest raster side."""


def make_case(family: str, seed: int, number: int, limit: int = 96) -> Case:
    """Make one case.

    Parameters
    ----------
    family : str
        One of `FAMILIES`.
    seed, number : int
        Which case: the same three give the same case.
    limit : int
        Largest width and height in pixels, at least 16.

    Raises
    ------
    ValueError
        If there is no such family; the message lists those that there are.
    """
    if family not in FAMILIES:
        raise ValueError(f"family must be one of {', '.join(FAMILIES)}, got {family}")
    rng = np.random.default_rng([seed, list(FAMILIES).index(family), number])
    return FAMILIES[family](rng, limit)
