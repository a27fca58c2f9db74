"""Primitives assembled from vertices: which vertices each segment or triangle of a strip, fan, quad or polygon has.

References
----------
OpenGL 4.6, 10.1, primitive types: the order of a strip's vertices, so that all its triangles are wound alike.
G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82, 1975.
"""

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from core.clipping.rings import sides_that_meet, turn
from core.records.arrays import Integers, checked
from core.scene import CORNER_COUNTS, ClipScene

Point = tuple[Fraction, Fraction]


def groups(count: int, size: int) -> Integers:
    """Return primitives (count / size, size) of vertices of their own: the first ``size``, the next, and so on."""
    if count < size or count % size:
        raise ValueError(f"the number of vertices must be a multiple of {size}, got {count}")
    return np.arange(count).reshape(-1, size)


def line_strip(count: int) -> Integers:
    """Return the segments (count - 1, 2) of a strip: each begins where the one before ends."""
    _need(count, 2, "line strip")
    return np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)


def line_loop(count: int) -> Integers:
    """Return the segments (count, 2) of a closed strip."""
    _need(count, 3, "line loop")
    return np.stack([np.arange(count), np.roll(np.arange(count), -1)], axis=1)


def triangle_strip(count: int) -> Integers:
    """Return the triangles (count - 2, 3) of a strip: each has the last two vertices and the next, wound as the first.

    Examples
    --------
    >>> triangle_strip(5).tolist()
    [[0, 1, 2], [2, 1, 3], [2, 3, 4]]
    """
    _need(count, 3, "triangle strip")
    first = np.arange(count - 2)
    is_odd = first % 2
    return np.stack([first + is_odd, first + 1 - is_odd, first + 2], axis=1)


def triangle_fan(count: int) -> Integers:
    """Return the triangles (count - 2, 3) of a fan around vertex 0."""
    _need(count, 3, "triangle fan")
    second = np.arange(1, count - 1)
    return np.stack([np.zeros_like(second), second, second + 1], axis=1)


def quads(count: int) -> Integers:
    """Return the triangles (count / 2, 3) of quads of four vertices each: 0 1 2 and 0 2 3 of the first."""
    return groups(count, 4)[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)


def polygon(corners: ArrayLike) -> Integers:
    """Return triangles (V - 2, 3) that fill a polygon, convex or not, cut off one ear after the other.

    Parameters
    ----------
    corners : (V, 2) array_like of float
        In either direction; the triangles are wound as the polygon is.

    Raises
    ------
    ValueError
        If it has fewer than three corners, crosses or touches itself, or has no area.

    Notes
    -----
    All tests are exact. A corner between two sides of one line gives a triangle without area.
    """
    points = [(Fraction(x), Fraction(y)) for x, y in checked("corners", corners, ("V", 2)).tolist()]
    _need(len(points), 3, "polygon")
    _check_simple(points)
    area = sum(turn(points[0], a, b) for a, b in pairwise(points))
    sign = 1 if area > 0 else -1
    left, found = list(range(len(points))), []
    while len(left) > 2:
        place = _find_ear(points, left, sign)
        found.append([left[place - 1], left[place], left[(place + 1) % len(left)]])
        del left[place]
    return np.array(found)


def _find_ear(points: list[Point], left: list[int], sign: int) -> int:
    """Return the place of a corner whose triangle contains no other, or of one between two sides of one line."""
    flat = -1
    for place, corner in enumerate(left):
        before, after = left[place - 1], left[(place + 1) % len(left)]
        triangle = [points[before], points[corner], points[after]]
        bend = sign * turn(points[before], points[corner], points[after])
        if bend == 0:
            flat = place
        others = (points[k] for k in left if k not in (before, corner, after))
        if bend > 0 and not any(_contains(triangle, other, sign) for other in others):
            return place
    return flat


def _contains(triangle: list[Point], point: Point, sign: int) -> bool:
    """Return whether a point lies in a triangle or on its border."""
    a, b, c = triangle
    return all(sign * turn(p, q, point) >= 0 for p, q in ((a, b), (b, c), (c, a)))


def _check_simple(points: list[Point]) -> None:
    """Refuse a polygon whose sides have more in common than the corner between two neighbours."""
    if any(point == points[k - 1] for k, point in enumerate(points)):
        raise ValueError("a polygon must have no two equal corners in turn")
    meeting = sides_that_meet([points])
    if meeting is not None:
        (_, k), (_, m) = meeting
        raise ValueError(f"a polygon must not cross or touch itself, but side {k} meets side {m}")


def _need(count: int, least: int, name: str) -> None:
    if count < least:
        raise ValueError(f"a {name} needs at least {least} vertices, got {count}")


_INDICES: Mapping[str, tuple[str, Callable[[int], Integers]]] = {
    **{kind: (kind, partial(groups, size=size)) for kind, size in CORNER_COUNTS.items() if size},
    "line-strip": ("segments", line_strip),
    "line-loop": ("segments", line_loop),
    "triangle-strip": ("triangles", triangle_strip),
    "triangle-fan": ("triangles", triangle_fan),
    "quads": ("triangles", quads),
}
ASSEMBLIES = (*_INDICES, "polygon")
"""What `assemble` makes."""


def assemble(name: str, clip: ArrayLike, attributes: ArrayLike | None = None, **more: Any) -> ClipScene:
    """Return the scene of primitives that share vertices given once.

    Parameters
    ----------
    name : str
        One of `ASSEMBLIES`.
    clip : (V, 4) array_like of float
        Clip-space x, y, z, w of every vertex.
    attributes : (V, K) array_like of float, optional
    **more
        Further arguments of `ClipScene`.

    Raises
    ------
    ValueError
        For another name, too few vertices, or a polygon that is not simple or has a corner at w <= 0.

    Examples
    --------
    >>> corners = [[0, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 1], [1, 1, 0, 1]]
    >>> assemble("triangle-strip", corners).shared.tolist()
    [[0, 1, 2], [2, 1, 3]]
    """
    vertices = checked("clip", clip, ("V", 4))
    if name == "polygon":
        if not (vertices[:, 3] > 0).all():
            raise ValueError("a polygon needs all w above 0: other corners have no place in the window")
        kind, index = "triangles", polygon(vertices[:, :2] / vertices[:, 3:])
    elif name in _INDICES:
        kind, index_of = _INDICES[name]
        index = index_of(len(vertices))
    else:
        raise ValueError(f"name must be one of {', '.join(ASSEMBLIES)}, got {name}")
    values = None
    if attributes is not None:
        values = checked("attributes", attributes, ("V", "K"))
        if len(values) != len(vertices):
            raise ValueError(f"attributes must be ({len(vertices)}, K), got {values.shape}")
        values = values[index]
    return ClipScene(vertices[index], values, kind=kind, shared=index, **more)
