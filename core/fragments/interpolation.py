"""Attribute interpolation: weights of the corners at a pixel (perspective, affine, flat), and planes over the window.

All of them come from the adjugate of the 3x3 (x, y, w) matrix of the corners *before* snapping: row k of the inverse
gives alpha_k/w as a linear function of the pixel, and their sum is 1/w. A covered pixel of a snapped triangle may so
have a weight slightly below 0: coverage was decided on the snapped corners.

References
----------
M. Zwicker, *Computergrafik*, lecture "Perspective correct interpolation", Bern 2016.
M. Olano, T. Greer, *Triangle scan conversion using 2D homogeneous coordinates*, 1997.
"""

from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, Integers
from core.methods import method, table

DETERMINANT_ERROR = 2.0**-50
"""Rounding error of a determinant, as a part of the sum of the sizes of its terms."""

BLOCK = 8192
"""Fragments mixed at once, so that their numbers stay in the processor's cache."""


@dataclass(frozen=True, eq=False)
class Planes:
    """Linear functions over the window of P primitives."""

    a: Floats
    """(P, 3) float64, change per column of det * alpha_k/w."""
    b: Floats
    """(P, 3) float64, change per row."""
    c: Floats
    """(P, 3) float64, value at the window's origin."""
    determinant: Floats
    """(P,) float64, of the (x, y, w) matrix."""
    w: Floats
    """(P, 3) float64, w of the corners."""


def set_up_planes(homogeneous: Floats) -> Planes:
    """Return the adjugate of every (x, y, w) matrix, (P, 3, 3) float64.

    Notes
    -----
    A triangle seen edge-on (a determinant within its own rounding error) has no inverse, but snapping may still
    give it pixels: there it takes the mean of its corners.
    """
    x, y, w = (homogeneous[..., k] for k in range(3))
    following, last = [1, 2, 0], [2, 0, 1]
    a = y[:, following] * w[:, last] - w[:, following] * y[:, last]
    b = w[:, following] * x[:, last] - x[:, following] * w[:, last]
    c = x[:, following] * y[:, last] - y[:, following] * x[:, last]
    determinant = x[:, 0] * a[:, 0] + y[:, 0] * b[:, 0] + w[:, 0] * c[:, 0]
    size = (
        np.abs(x[:, 0]) * (np.abs(y[:, 1] * w[:, 2]) + np.abs(w[:, 1] * y[:, 2]))
        + np.abs(y[:, 0]) * (np.abs(w[:, 1] * x[:, 2]) + np.abs(x[:, 1] * w[:, 2]))
        + np.abs(w[:, 0]) * (np.abs(x[:, 1] * y[:, 2]) + np.abs(y[:, 1] * x[:, 2]))
    )
    edge_on = np.flatnonzero(np.abs(determinant) <= DETERMINANT_ERROR * size)
    if len(edge_on):
        with np.errstate(divide="ignore"):
            a[edge_on], b[edge_on], c[edge_on] = 0, 0, 1 / (3 * w[edge_on])
        determinant[edge_on] = 1
    return Planes(a, b, c, determinant, w)


def value_plane(planes: Planes, values: Floats) -> tuple[Floats, Floats, Floats]:
    """Return a, b, c (P,) of value/w over the window, for values (P, 3) at the corners.

    Notes
    -----
    With values 1, 1, 1 this is 1/w; with the homogeneous depth (z + w)/2 it is the window depth, since
    depth is divided by w just once.
    """
    v0, v1, v2 = values[:, 0], values[:, 1], values[:, 2]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return (
            (planes.a[:, 0] * v0 + planes.a[:, 1] * v1 + planes.a[:, 2] * v2) / planes.determinant,
            (planes.b[:, 0] * v0 + planes.b[:, 1] * v1 + planes.b[:, 2] * v2) / planes.determinant,
            (planes.c[:, 0] * v0 + planes.c[:, 1] * v1 + planes.c[:, 2] * v2) / planes.determinant,
        )


def plane_value(plane: tuple[Floats, Floats, Floats], primitive: Integers, x: Floats, y: Floats) -> Floats:
    """Evaluate planes (P,) at pixel centres: (F,) float64."""
    a, b, c = plane
    return a.take(primitive) * x + (b.take(primitive) * y + c.take(primitive))


def numerators(planes: Planes, primitive: Integers, x: Floats, y: Floats) -> tuple[Floats, Floats, Floats]:
    """Return det * alpha_k/w of the three corners at pixel centres, each (F,) float64."""
    first, second, third = (
        plane_value((planes.a[:, k], planes.b[:, k], planes.c[:, k]), primitive, x, y) for k in range(3)
    )
    return first, second, third


@method(
    "interpolation",
    "perspective",
    "Perspective-correct",
    source="Zwicker 2016, Perspective correct interpolation; Olano and Greer 1997",
    exact_for="every triangle",
)
def perspective(planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int) -> Floats:
    """Return weights (F, 3): alpha/w, beta/w, gamma/w over their sum 1/w."""
    n0, n1, n2 = numerators(planes, primitive, x, y)
    total = n0 + n1 + n2
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return np.stack([n0 / total, n1 / total, n2 / total], axis=1)


@method(
    "interpolation",
    "affine",
    "Affine (screen-linear)",
    source="Jubair, Barycentric interpolation; Zwicker 2016, Observation",
    exact_for="triangles of one w",
    breaks_where="w differs between corners: the error grows to (sqrt r - 1)/(sqrt r + 1) of the edge",
    needs=("positive-w",),
)
def affine(planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int) -> Floats:
    """Return weights (F, 3) that are linear in the window: alpha_k/w times w_k."""
    w = planes.w
    n0, n1, n2 = numerators(planes, primitive, x, y)
    n0, n1, n2 = n0 * w[primitive, 0], n1 * w[primitive, 1], n2 * w[primitive, 2]
    total = n0 + n1 + n2
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return np.stack([n0 / total, n1 / total, n2 / total], axis=1)


@method(
    "interpolation",
    "flat",
    "Flat (one corner's value)",
    source="OpenGL 4.6, 13.4 Flatshading",
    exact_for="values of one corner",
)
def flat(planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int) -> Floats:
    """Return weights (F, 3): 1 for the provoking corner, 0 for the others."""
    weights = np.zeros((len(primitive), 3))
    weights[:, provoking] = 1
    return weights


@method("provoking", "last", "Last corner", source="OpenGL 4.6, 13.4", exact_for="OpenGL's default")
def last_corner() -> int:
    """Return the corner whose value a flat triangle takes."""
    return 2


@method("provoking", "first", "First corner", source="OpenGL 4.6, 13.4; Vulkan's default", exact_for="Vulkan")
def first_corner() -> int:
    """Return the corner whose value a flat triangle takes."""
    return 0


def interpolate(
    planes: Planes,
    varyings: Floats,
    primitive: Integers,
    x: Floats,
    y: Floats,
    interpolation: str,
    provoking: str,
) -> tuple[Floats, Floats]:
    """Return weights (F, 3) and values (F, K) of varyings (P, 3, K) at pixel centres."""
    corner = table.get("provoking", provoking).function()
    weights = table.get("interpolation", interpolation).function(planes, primitive, x, y, corner)
    return weights, mix(weights, varyings, primitive)


def mix(weights: Floats, varyings: Floats, primitive: Integers) -> Floats:
    """Return (F, K): the corners' values (P, 3, K) in the proportion of weights (F, 3); NaN where 1/w is 0."""
    mixed = np.empty((len(primitive), varyings.shape[2]))
    corners = [np.ascontiguousarray(varyings[:, k]) for k in range(3)]
    for start in range(0, len(primitive), BLOCK):
        part = slice(start, start + BLOCK)
        w0, w1, w2 = (weights[part, k, None] for k in range(3))
        v0, v1, v2 = (values.take(primitive[part], axis=0) for values in corners)
        with np.errstate(invalid="ignore", over="ignore"):
            mixed[part] = w0 * v0 + w1 * v1 + w2 * v2
    return mixed


def interpolate_at(
    a: Floats, b: Floats, c: Floats, x: float, y: float, values: Floats
) -> tuple[list[float], float, float]:
    """Listing of perspective-correct interpolation of one value: adjugate (3,) each, corner values (3,)."""
    n = [a[k] * x + (b[k] * y + c[k]) for k in range(3)]  #: numerators
    total = n[0] + n[1] + n[2]  #: total
    weights = [n[k] / total for k in range(3)]  #: weights
    value = weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]  #: value
    return weights, total, value


def interpolate_affine_at(
    a: Floats, b: Floats, c: Floats, w: Floats, x: float, y: float, values: Floats
) -> tuple[list[float], float, float]:
    """Listing of affine interpolation of one value: adjugate (3,) each, w (3,), corner values (3,)."""
    n = [(a[k] * x + (b[k] * y + c[k])) * w[k] for k in range(3)]  #: numerators
    total = n[0] + n[1] + n[2]  #: total
    weights = [n[k] / total for k in range(3)]  #: weights
    value = weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]  #: value
    return weights, total, value


def take_provoking_value(provoking: int, values: Floats) -> tuple[list[float], float]:
    """Listing of flat interpolation."""
    weights = [1.0 if k == provoking else 0.0 for k in range(3)]  #: weights
    return weights, values[provoking]  #: value
