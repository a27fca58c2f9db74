"""Barycentric coordinates three ways: by two equations, by areas, by distances from the edges.

All three give the affine weights of the corners from their places in the window. They differ in what they compute, and
so in their rounding errors: `core.interpolation.interpolation` has the same weights from the adjugate of (x, y, w),
which needs no place in the window. Corners that lie on one line have no such weights; each counts a third there.

References
----------
M. I. Jubair, *Computer Graphics*, chapter 8 part C, "Barycentric Interpolation"; F. Pellacini, "triangle barycentric
coordinates".
P. Shirley, S. Marschner, *Fundamentals of Computer Graphics*, 3rd edition, 2009, section 2.7.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from core.interpolation.interpolation import Planes
from core.methods import method
from core.records.arrays import Floats, Integers
from core.records.listing import Operation

NO_AREA = "no-area"
"""Kind of row of a triangle whose corners lie on one line."""
_EVERY_THIRD = {NO_AREA: (Operation("weights", "no-area", ("weights",)),)}
_WEIGHTS = Operation("weights", "weights", ("weights",), ("inverse_w",))

Numbers = dict[str, Floats]
"""What a way computes of F fragments by name; ``weights`` is (F, 3)."""


def _with_weights(numbers: Numbers, weights: list[Floats], has_none: np.ndarray) -> Numbers:
    """Add the weights of F fragments, a third each where ``has_none`` (F,) bool."""
    numbers["weights"] = np.where(has_none, 1 / 3, np.stack(weights)).T
    numbers["has_area"] = ~has_none
    return numbers


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def solve_equations(corner: Floats, x: Floats, y: Floats) -> Numbers:
    """Solve p1 l1 + p2 l2 = p and q1 l1 + q2 l2 = q by elimination, the larger coefficient of l1 first.

    Parameters
    ----------
    corner : (3, 2, F) float64
        Places of the corners in the window.
    x, y : (F,) float64
        Pixel centres.
    """
    (x0, y0), (x1, y1), (x2, y2) = corner
    system = np.stack([[x1 - x0, x2 - x0, x - x0], [y1 - y0, y2 - y0, y - y0]])
    is_swapped = np.abs(system[1, 0]) > np.abs(system[0, 0])
    (p1, p2, p), (q1, q2, q) = np.where(is_swapped, system[::-1], system)
    f = q1 / p1
    e2, e = q2 - f * p2, q - f * p
    second = e / e2
    first = (p - p2 * second) / p1
    numbers = {
        "system": system.transpose(2, 0, 1),
        "is_swapped": is_swapped,
        "chosen": np.stack([p1, p2, p], axis=1),
        "other": np.stack([q1, q2, q], axis=1),
        "factor": f,
        "reduced": np.stack([e2, e], axis=1),
        "weight_2": second,
        "weight_1": first,
    }
    return _with_weights(numbers, [1 - first - second, first, second], (p1 == 0) | (e2 == 0))


def solve_equations_at(corners: Floats, x: float, y: float, values: Floats) -> tuple[list[float], float]:
    """Listing of weights by elimination: corners in the window (3, 2), corner values (3,)."""
    (x0, y0), (x1, y1), (x2, y2) = corners
    in_x, in_y = (x1 - x0, x2 - x0, x - x0), (y1 - y0, y2 - y0, y - y0)  #: system
    (p1, p2, p), (q1, q2, q) = (in_y, in_x) if abs(in_y[0]) > abs(in_x[0]) else (in_x, in_y)  #: pivot
    f = q1 / p1 if p1 != 0 else 0.0  #: factor
    e2, e = q2 - f * p2, q - f * p  #: eliminate
    if p1 == 0 or e2 == 0:
        weights = [1 / 3, 1 / 3, 1 / 3]  #: no-area
    else:
        weight2 = e / e2  #: last
        weight1 = (p - p2 * weight2) / p1  #: first
        weights = [1 - weight1 - weight2, weight1, weight2]  #: weights
    value = weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]  #: value
    return weights, value


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def divide_areas(corner: Floats, x: Floats, y: Floats) -> Numbers:
    """Divide the areas between a pixel and two corners by that of the triangle, for corners (3, 2, F)."""
    (x0, y0), (x1, y1), (x2, y2) = corner
    whole = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    parts = [
        (x1 - x) * (y2 - y) - (x2 - x) * (y1 - y),
        (x2 - x) * (y0 - y) - (x0 - x) * (y2 - y),
        (x0 - x) * (y1 - y) - (x1 - x) * (y0 - y),
    ]
    numbers = {"whole_area": whole, "areas": np.stack(parts, axis=1)}
    return _with_weights(numbers, [part / whole for part in parts], whole == 0)


def doubled_area(a: Sequence[float], b: Sequence[float], c: Sequence[float]) -> float:
    """Return twice the signed area of a triangle."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])


def divide_areas_at(corners: Floats, x: float, y: float, values: Floats) -> tuple[list[float], float]:
    """Listing of weights by areas, all of them doubled: corners in the window (3, 2), corner values (3,)."""
    p0, p1, p2 = corners
    p = x, y
    area = doubled_area(p0, p1, p2)  #: whole
    areas = [doubled_area(p, p1, p2), doubled_area(p, p2, p0), doubled_area(p, p0, p1)]  #: areas
    if area == 0:
        weights = [1 / 3, 1 / 3, 1 / 3]  #: no-area
    else:
        weights = [areas[k] / area for k in range(3)]  #: weights
    value = weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]  #: value
    return weights, value


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def divide_distances(corner: Floats, x: Floats, y: Floats) -> Numbers:
    """Divide the line function of each edge by its value at the opposite corner, for corners (3, 2, F)."""
    lines, at_pixel, at_corner = [], [], []
    for k in range(3):
        (xi, yi), (xj, yj), (xk, yk) = corner[k - 2], corner[k - 1], corner[k]
        a, b, c = yi - yj, xj - xi, xi * yj - xj * yi
        lines.append([a, b, c])
        at_pixel.append(a * x + b * y + c)
        at_corner.append(a * xk + b * yk + c)
    numbers = {
        **{f"line_{name}": np.stack([line[at] for line in lines], axis=1) for at, name in enumerate("abc")},
        "at_pixel": np.stack(at_pixel, axis=1),
        "at_corner": np.stack(at_corner, axis=1),
    }
    has_none = (numbers["at_corner"] == 0).any(axis=1)
    return _with_weights(numbers, [at_pixel[k] / at_corner[k] for k in range(3)], has_none)


def divide_distances_at(corners: Floats, x: float, y: float, values: Floats) -> tuple[list[float], float]:
    """Listing of weights by distances: corners in the window (3, 2), corner values (3,)."""
    at_pixel, at_corner = [], []
    for k in range(3):
        xi, yi = corners[k - 2]
        xj, yj = corners[k - 1]
        xk, yk = corners[k]
        a, b, c = yi - yj, xj - xi, xi * yj - xj * yi  #: lines
        at_pixel.append(a * x + b * y + c)  #: functions
        at_corner.append(a * xk + b * yk + c)  #: opposite
    if 0 in at_corner:
        weights = [1 / 3, 1 / 3, 1 / 3]  #: no-area
    else:
        weights = [at_pixel[k] / at_corner[k] for k in range(3)]  #: weights
    value = weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]  #: value
    return weights, value


WAYS: Mapping[str, Callable[[Floats, Floats, Floats], Numbers]] = {
    "affine-equations": solve_equations,
    "affine-areas": divide_areas,
    "affine-distances": divide_distances,
}
"""Method of interpolation to what it computes, the weights among it."""


def numbers_at(way: str, planes: Planes, primitive: Integers, x: Floats, y: Floats) -> Numbers:
    """Return what a way computes of primitives (F,) at pixel centres x, y (F,)."""
    return WAYS[way](planes.window.take(primitive, axis=2), x, y)


@method(
    "interpolation",
    "affine-equations",
    "Affine, by two equations",
    source="Jubair, Barycentric Interpolation (1/4); Pellacini, Triangle barycentric coordinates",
    exact_for="triangles with the same w at all corners; the weights add up to 1 by construction",
    breaks_where="corners with different w, as affine; slivers: the elimination loses the digits that both rows "
    "have in common",
    needs=("positive-w",),
    listing=solve_equations_at,
    operations={
        "affine-equations": (
            Operation("system", "system", {"system": "in_x in_y"}),
            Operation("pivot", "pivot", {"chosen": "p1 p2 p", "other": "q1 q2 q"}, ("is_swapped",)),
            Operation("factor", "factor", {"factor": "f"}),
            Operation("eliminate", "eliminate", {"reduced": "e2 e"}),
            Operation("last", "last", {"weight_2": "weight2"}),
            Operation("first", "first", {"weight_1": "weight1"}),
            _WEIGHTS,
        ),
        **_EVERY_THIRD,
    },
    traits="affine",
)
def affine_by_equations(
    planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int, interval: int
) -> Floats:
    """Return weights (F, 3) that solve p = l0 a + l1 b + l2 c with l0 + l1 + l2 = 1."""
    return numbers_at("affine-equations", planes, primitive, x, y)["weights"]


@method(
    "interpolation",
    "affine-areas",
    "Affine, by areas",
    source="Jubair, Barycentric Interpolation (4/4)",
    exact_for="triangles with the same w at all corners",
    breaks_where="corners with different w, as affine; slivers: the areas lose digits, and the weights add up to 1 "
    "only to rounding",
    needs=("positive-w",),
    listing=divide_areas_at,
    operations={
        "affine-areas": (
            Operation("whole", "whole", {"whole_area": "area"}),
            Operation("areas", "areas", ("areas",)),
            _WEIGHTS,
        ),
        **_EVERY_THIRD,
    },
    traits="affine",
)
def affine_by_areas(
    planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int, interval: int
) -> Floats:
    """Return weights (F, 3): the areas opposite to the corners over the whole area."""
    return numbers_at("affine-areas", planes, primitive, x, y)["weights"]


@method(
    "interpolation",
    "affine-distances",
    "Affine, by distances",
    source="Jubair, Barycentric Interpolation (2/4)",
    exact_for="triangles with the same w at all corners",
    breaks_where="corners with different w, as affine; far from the window's origin the constant of a line function "
    "loses digits",
    needs=("positive-w",),
    listing=divide_distances_at,
    operations={
        "affine-distances": (
            Operation("lines", "lines", {"line_a": "a", "line_b": "b", "line_c": "c"}),
            Operation("functions", "functions", ("at_pixel",)),
            Operation("opposite", "opposite", ("at_corner",)),
            _WEIGHTS,
        ),
        **_EVERY_THIRD,
    },
    traits="affine",
)
def affine_by_distances(
    planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int, interval: int
) -> Floats:
    """Return weights (F, 3): f_ab(x, y) / f_ab(x_c, y_c), the distance from an edge over that of the corner."""
    return numbers_at("affine-distances", planes, primitive, x, y)["weights"]
