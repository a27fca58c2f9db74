"""Triangles that rasterizers trip over, many at a time, and the pixels they cover in whole numbers."""

import numpy as np

from core.coverage.fills import cover
from core.coverage.pixel_runs import make_raster
from tests.core.drawing import edges_of, runs_of
from tests.core.meshes import fan
from tests.core.strategies import clip_of_window

LIMIT = 2**16
"""Pixels: corners farther away are not snapped."""
SUBPIXELS = 256
SIZES = [(1, 1), (1, 4096), (4096, 1), (3, 257), (100, 63), (61, 97), (128, 128)]


def grid(generator: np.random.Generator, count: int, size: tuple[int, int]) -> np.ndarray:
    """Return window triangles (count, 3, 2) on pixel centres, half pixels, or any 1/256, in and around the window."""
    steps = generator.choice([1, 2, 2, 16, 256], (count, 1, 1))
    low, high = -4, np.array(size) + 4
    return np.round(generator.uniform(low, high, (count, 3, 2)) * steps) / steps


def slivers(generator: np.random.Generator, count: int, size: tuple[int, int]) -> np.ndarray:
    """Return long triangles that are a few 1/256 pixel wide, in all directions, some of them through centres."""
    start, end = (np.round(generator.uniform(-3, np.array(size) + 3, (count, 2)) * 2) / 2 for _ in range(2))
    middle = start + generator.random((count, 1)) * (end - start)
    middle = (np.round(middle * SUBPIXELS) + generator.integers(-2, 3, (count, 2))) / SUBPIXELS
    return np.stack([start, middle, end], axis=1)


def level_slivers(generator: np.random.Generator, count: int, size: tuple[int, int]) -> np.ndarray:
    """Return triangles with a side that rises, or leans, by 1/256 pixel over a long way."""
    x = generator.integers(1 - LIMIT, LIMIT, (count, 3)).astype(float)
    y = (generator.integers(0, size[1] + 1, (count, 1)) + 0.5) + generator.integers(
        -1, 2, (count, 3)
    ) / SUBPIXELS
    corners = np.stack([x, y], axis=2)
    leans = generator.random(count) < 0.5
    corners[leans] = corners[leans][:, :, ::-1]
    return corners


def fans(generator: np.random.Generator, count: int, size: tuple[int, int]) -> np.ndarray:
    """Return fans whose hubs and rims lie on pixel centres, edges and corners."""
    triangles = [np.empty((0, 3, 2))]
    while sum(len(part) for part in triangles) < count:
        hub = np.round(generator.uniform(0, np.array(size)) * 2) / 2
        around = generator.integers(3, 24)
        angle = np.sort(generator.uniform(0, 2 * np.pi, around))
        radius = generator.choice([1.0, 8.0, 200.0])
        rim = np.round((hub + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)) * 2) / 2
        triangles.append(fan(hub, rim))
    return np.concatenate(triangles)[:count]


def huge(generator: np.random.Generator, count: int, size: tuple[int, int]) -> np.ndarray:
    """Return triangles nearly as large as can be snapped."""
    reach = LIMIT * SUBPIXELS - 1
    corners = generator.integers(-reach, reach + 1, (count, 3, 2)) / SUBPIXELS
    is_farthest = generator.random(corners.shape) < 0.3
    corners[is_farthest] = generator.choice([-reach, reach], int(is_farthest.sum())) / SUBPIXELS
    through = generator.random(count) < 0.5
    corners[through, 0] = np.round(generator.uniform(0, np.array(size), (int(through.sum()), 2)) * 2) / 2
    return corners


def tiny(generator: np.random.Generator, count: int, size: tuple[int, int]) -> np.ndarray:
    """Return triangles of a few 1/256 pixel around pixel centres."""
    center = generator.integers(0, np.array(size), (count, 1, 2)) + 0.5
    return center + generator.integers(-3, 4, (count, 3, 2)) / SUBPIXELS


PROJECTED = {
    "grid": grid,
    "slivers": slivers,
    "level slivers": level_slivers,
    "fans": fans,
    "huge": huge,
    "tiny": tiny,
}
"""Families of window triangles whose corners can all be snapped."""


def projected(
    generator: np.random.Generator, count: int, size: tuple[int, int], family: str | None = None
) -> np.ndarray:
    """Return window triangles (count, 3, 2) of one family, or of all of them, shuffled; both facings."""
    names = [family] if family else list(PROJECTED)
    share = -(-count // len(names))
    corners = np.concatenate([PROJECTED[name](generator, share, size) for name in names])[:count]
    turned = generator.random(len(corners)) < 0.5
    corners[turned] = corners[turned][:, ::-1]
    return corners[generator.permutation(len(corners))]


def mixed(generator: np.random.Generator, count: int, size: tuple[int, int]) -> np.ndarray:
    """Return clip positions (count, 3, 4) with every kind of w: behind the eye, 0, next to 0, and beyond the limit."""
    w = generator.choice([-2.0, -1.0, -1e-9, 0.0, 1e-9, 0.25, 1.0, 1.0, 1.5, 2.0], (count, 3))
    clip = clip_of_window(
        projected(generator, count, size), size, w, generator.uniform(-1.2, 1.2, (count, 3))
    )
    at_eye = w == 0
    clip[at_eye, :3] = generator.integers(-8, 9, (int(at_eye.sum()), 3)) / 8
    beyond = generator.random(count) < 0.2
    clip[beyond, 0, 0] *= 1e6
    return clip


def drawn(clip, size, fill: str, *, region=None, pixel_center: str = "half", **rules: str) -> np.ndarray:
    """Return what a fill draws, (F, 3) sorted rows of primitive, row and column, as often as it draws them."""
    edges, raster = edges_of(clip, size, **rules), make_raster(size, pixel_center, region)
    parts = [
        np.stack([fragments.primitive, fragments.row, fragments.column])
        for fragments, _ in cover(edges, runs_of(edges, raster, fill), raster)
    ]
    found = np.concatenate([np.empty((3, 0), np.int64), *parts], axis=1)
    return found[:, np.lexsort(found[::-1])].T


def in_whole_numbers(
    corners: np.ndarray, size: tuple[int, int], rule: str = "shared-edge", doubled_center: int = 1
) -> np.ndarray:
    """Return what snapped window triangles (T, 3, 2) cover, as `drawn`, from edge functions in int64."""
    points = np.rint(corners * SUBPIXELS).astype(np.int64)
    x = SUBPIXELS * np.arange(size[0]) + SUBPIXELS // 2 * doubled_center
    y = (SUBPIXELS * np.arange(size[1]) + SUBPIXELS // 2 * doubled_center)[:, None]
    found = []
    for number, triangle in enumerate(points):
        first, second, third = triangle
        turn = np.sign(_double_area(first, second, third))
        covered = np.full((size[1], size[0]), turn != 0)
        for start, end in ((first, second), (second, third), (third, first)):
            a, b = turn * (start[1] - end[1]), turn * (end[0] - start[0])
            value = a * (x - start[0]) + b * (y - start[1])
            owns_tie = {"inclusive": True, "exclusive": False}.get(rule, a > 0 or (a == 0 and b > 0))
            covered &= (value > 0) | ((value == 0) & owns_tie)
        row, column = np.nonzero(covered)
        found.append(np.stack([np.full(len(row), number), row, column], axis=1))
    return np.concatenate(found)


def _double_area(first: np.ndarray, second: np.ndarray, third: np.ndarray) -> int:
    (x0, y0), (x1, y1), (x2, y2) = first.tolist(), second.tolist(), third.tolist()
    return (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
