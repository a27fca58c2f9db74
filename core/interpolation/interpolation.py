"""Attribute interpolation: weights of the corners at a pixel, with perspective and without; rules of an edited text.

All of them come from the adjugate of the 3x3 (x, y, w) matrix of the corners *before* snapping: row k of the inverse
gives alpha_k/w as a linear function of the pixel, and their sum is 1/w. A covered pixel of a snapped triangle may so
have a weight slightly below 0: coverage was decided on the snapped corners.

References
----------
M. Zwicker, *Computergrafik*, lecture "Perspective correct interpolation", Bern 2016.
M. Olano, T. Greer, *Triangle scan conversion using 2D homogeneous coordinates*, 1997.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from core.interpolation.mixing import BLOCK, LocalNumbers, Mixer
from core.methods import method, table
from core.records.arrays import Floats, Integers, cached_property
from core.records.listing import Operation
from core.records.primitives import CornerValues, own_corners

# A rule of interpolation that finds values by itself, beside those that find weights.


class ValuePlaces(NamedTuple):
    """What a rule of the family ``interpolation`` takes: F fragments, and how they are interpolated."""

    planes: "Planes"
    primitive: Integers
    """(F,) int64."""
    x: Floats
    """(F,) float64, pixel centres."""
    y: Floats
    provoking: int
    interval: int


class ValueRule(ABC):
    """A rule that finds values by itself, not only the weights with which they are mixed: an edited listing."""

    @abstractmethod
    def __call__(
        self, planes: "Planes", primitive: Integers, x: Floats, y: Floats, provoking: int, interval: int
    ) -> Floats:
        """Return weights (F, 3)."""

    @abstractmethod
    def weights_and_values(self, at: ValuePlaces, corners: Floats) -> tuple[Floats, Floats]:
        """Return weights (3, F) and the values (F,) between those of the corners, (3, F)."""


# Attribute interpolation: weights of the corners at a pixel (perspective, affine, flat), and planes over
# the window.


DETERMINANT_ERROR = 2.0**-50
"""Rounding error of a determinant, as a part of the sum of the sizes of its terms."""

CORRECTION_INTERVAL = 16
"""Columns between corrections, as Quake has them."""

_SUMMED = (
    Operation("numerators", "numerators", {"numerators": "n"}),
    Operation("total", "total", ("total",), ("inverse_w",)),
    Operation("weights", "weights", ("weights",)),
)

FEW_PRIMITIVES = 1024
"""So many primitives fit the processor's nearest cache without being picked out."""


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
    homogeneous: Floats
    """(Q, 3, 3) float64, x, y and w of the corners of these and other primitives."""
    number: Integers | None = None
    """(P,) int64, which of ``homogeneous`` these are; ``None``: all."""

    @cached_property
    def window(self) -> Floats:
        """(3, 2, P) float64 pixels, places of the corners in the window; not finite where w is 0."""
        corners = self.homogeneous if self.number is None else self.homogeneous.take(self.number, axis=0)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            return (corners[..., :2] / corners[..., 2:]).transpose(1, 2, 0)


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def window_weights(weights: Floats, w: Floats) -> Floats:
    """Return (3,) weights in the window, of those with perspective and the corners' w; not finite: they have no sum."""
    parts = np.multiply(weights, w)
    return np.asarray(parts / parts.sum())


def set_up_planes(homogeneous: Floats) -> Planes:
    """Return the adjugate of every (x, y, w) matrix, (P, 3, 3) float64.

    Notes
    -----
    A triangle seen edge-on (a determinant within its own rounding error) has no inverse, but snapping may still
    give it pixels: there it takes the mean of its corners, or of those that lie in front of the eye.
    """
    x, y, w = homogeneous.transpose(2, 0, 1)
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
        a[edge_on], b[edge_on], c[edge_on] = 0, 0, _mean_of_corners(w[edge_on])
        determinant[edge_on] = 1
    return Planes(a, b, c, determinant, w, homogeneous)


def _mean_of_corners(w: Floats) -> Floats:
    """Return alpha_k / w (Q, 3) with the same alpha for all corners, or for those with w > 0 if there are any."""
    in_front = w > 0
    chosen = in_front | ~in_front.any(axis=1, keepdims=True)
    with np.errstate(divide="ignore"):
        return np.where(chosen, 1 / (chosen.sum(axis=1, keepdims=True) * w), 0.0)


def value_plane(planes: Planes, values: Floats) -> tuple[Floats, Floats, Floats]:
    """Return a, b, c (P,) of value/w over the window, for values (P, 3) at the corners.

    Notes
    -----
    With values 1, 1, 1 this is 1/w; with the homogeneous depth (z + w)/2 it is the window depth, since
    depth is divided by w just once.
    """
    v0, v1, v2 = values.T
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
    first, second, third = _numerator_rows(planes, primitive, x, y)
    return first, second, third


def _numerator_rows(planes: Planes, primitive: Integers, x: Floats, y: Floats) -> Floats:
    """Return the three `numerators` as (3, F)."""
    parts = np.empty((3, len(primitive)))
    term = np.empty(len(primitive))
    for corner, part in enumerate(parts):
        planes.b[:, corner].take(primitive, out=part, mode="clip")
        part *= y
        part += planes.c[:, corner].take(primitive, out=term, mode="clip")
        planes.a[:, corner].take(primitive, out=term, mode="clip")
        term *= x
        part += term
    return parts


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def _over_their_sum(parts: Floats) -> Floats:
    """Turn ``parts`` (3, F) into their shares in the sum of the three, a view (F, 3) of the same memory."""
    total = parts[0] + parts[1]
    total += parts[2]
    parts /= total
    return parts.T


def weights_at(a: Floats, b: Floats, c: Floats, x: float, y: float) -> list[float]:
    """Return the perspective-correct weights of one place: adjugate (3,) each."""
    n = [a[k] * x + (b[k] * y + c[k]) for k in range(3)]
    return [n[k] / (n[0] + n[1] + n[2]) for k in range(3)]


def interpolate_at(
    a: Floats, b: Floats, c: Floats, x: float, y: float, values: Floats
) -> tuple[list[float], float, float]:
    """Listing of perspective-correct interpolation of one value: adjugate (3,) each, corner values (3,)."""
    n = [a[k] * x + (b[k] * y + c[k]) for k in range(3)]  #: numerators
    total = n[0] + n[1] + n[2]  #: total
    weights = [n[k] / total for k in range(3)]  #: weights
    value = weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]  #: value
    return weights, total, value


@method(
    "interpolation",
    "perspective",
    "Perspective-correct",
    source="Zwicker 2016, Perspective correct interpolation; Olano and Greer 1997",
    exact_for="every triangle",
    listing=interpolate_at,
    operations={"perspective": _SUMMED},
    traits="perspective",
)
def perspective(
    planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int, interval: int
) -> Floats:
    """Return weights (F, 3): alpha/w, beta/w, gamma/w over their sum 1/w."""
    return _over_their_sum(_numerator_rows(planes, primitive, x, y))


def interpolate_affine_at(
    a: Floats, b: Floats, c: Floats, w: Floats, x: float, y: float, values: Floats
) -> tuple[list[float], float, float]:
    """Listing of affine interpolation of one value: adjugate (3,) each, w (3,), corner values (3,)."""
    n = [(a[k] * x + (b[k] * y + c[k])) * w[k] for k in range(3)]  #: numerators
    total = n[0] + n[1] + n[2]  #: total
    weights = [n[k] / total for k in range(3)]  #: weights
    value = weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]  #: value
    return weights, total, value


@method(
    "interpolation",
    "affine",
    "Affine (screen-linear)",
    source="Jubair, Barycentric interpolation; Zwicker 2016, Observation",
    exact_for="triangles with the same w at all corners",
    breaks_where="corners with different w: for a ratio r, the error grows to (sqrt r - 1)/(sqrt r + 1) of the "
    "edge",
    needs=("positive-w",),
    listing=interpolate_affine_at,
    operations={"affine": _SUMMED},
    traits="affine",
)
def affine(
    planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int, interval: int
) -> Floats:
    """Return weights (F, 3) that are linear in the window: alpha_k/w times w_k."""
    parts = _numerator_rows(planes, primitive, x, y)
    for corner, part in enumerate(parts):
        part *= planes.w[:, corner].take(primitive)
    return _over_their_sum(parts)


def take_provoking_value(provoking: int, values: Floats) -> tuple[list[float], float]:
    """Listing of flat interpolation."""
    weights = [1.0 if k == provoking else 0.0 for k in range(len(values))]  #: weights
    value = values[provoking]  #: value
    return weights, value


@method(
    "interpolation",
    "flat",
    "Flat (one corner's value)",
    source="OpenGL 4.6, 13.4 Flatshading",
    exact_for="attributes that are constant over a triangle",
    takes=("provoking",),
    listing=take_provoking_value,
    operations={"flat": (Operation("weights", "weights", ("weights",)),)},
    traits="flat",
)
def flat(planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int, interval: int) -> Floats:
    """Return weights (F, 3): 1 for the provoking corner, 0 for the others."""
    weights = np.zeros((3, len(primitive)))
    weights[provoking] = 1
    return weights.T


@method("provoking", "last", "Last", source="OpenGL 4.6, 13.4", exact_for="OpenGL's default")
def last_corner() -> int:
    """Return the corner whose value a flat triangle takes."""
    return 2


@method(
    "provoking", "first", "First", source="OpenGL 4.6, 13.4; Vulkan's default", exact_for="Vulkan's default"
)
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
    interval: int = CORRECTION_INTERVAL,
) -> tuple[Floats, Floats]:
    """Return weights (F, 3) and values (F, K) of varyings (P, 3, K) at pixel centres, views of rows.

    A picture, which needs only the values, has them sooner from an `Interpolator`.
    """
    rule = table.get("interpolation", interpolation).function
    corner = table.get("provoking", provoking).function()
    return Interpolator(planes, varyings, rule, corner, interval).weighted(primitive, x, y)


class Interpolator:
    """Interpolates the values at the corners of P primitives, a block of fragments at a time.

    Parameters
    ----------
    planes : Planes
        Of the P primitives.
    varyings : CornerValues or (P, 3, K) float64 array
        Values at their corners; with rows that corners share less is looked at.
    rule : callable
        The function of a method of the family ``interpolation``.
    provoking : int
        The corner whose value a flat triangle takes.
    interval : int
        Columns between corrections, for interpolation that is corrected.

    Notes
    -----
    To make one costs a look at all primitives: keep it for the fragments of a picture.
    """

    def __init__(
        self,
        planes: Planes,
        varyings: CornerValues | Floats,
        rule: Callable[..., Floats],
        provoking: int,
        interval: int = CORRECTION_INTERVAL,
    ) -> None:
        values = varyings if isinstance(varyings, CornerValues) else _each_its_own(varyings)
        self.value_count = values.rows.shape[1]
        self._plane_rows = [np.ascontiguousarray(part.T) for part in (planes.a, planes.b, planes.c, planes.w)]
        self._planes = planes
        self._mixer = Mixer(values)
        count = values.index.shape[1]
        self._numbers = LocalNumbers(count)
        self._all = self._tables_of(np.arange(count)) if count <= FEW_PRIMITIVES else None
        self._rule, self._provoking, self._interval = rule, provoking, interval

    def values(self, primitive: Integers, x: Floats, y: Floats, out: Floats | None = None) -> Floats:
        """Return the values of fragments, bit for bit those of `interpolate`.

        Parameters
        ----------
        primitive : (F,) int64 array
        x, y : (F,) float64 arrays
            Pixel centres in the window.
        out : (K, F) float64 array, optional
            Memory for the values, a row each.

        Returns
        -------
        (F, K) float64 array
            A view of (K, F) rows; NaN where 1/w is 0.
        """
        rows = np.empty((self.value_count, len(primitive))) if out is None else out
        self._write(primitive, x, y, rows)
        return rows.T

    def weighted(self, primitive: Integers, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Return the weights of the corners (F, 3) and the values (F, K) of fragments, views of rows; see `values`."""
        weights, rows = np.empty((3, len(primitive))), np.empty((self.value_count, len(primitive)))
        self._write(primitive, x, y, rows, weights)
        return weights.T, rows.T

    def _write(
        self, primitive: Integers, x: Floats, y: Floats, values: Floats, weights: Floats | None = None
    ) -> None:
        for start in range(0, len(primitive), BLOCK):
            part = slice(start, start + BLOCK)
            planes, tables, local = self._close_at_hand(primitive[part])
            if isinstance(self._rule, ValueRule):
                at = ValuePlaces(planes, local, x[part], y[part], self._provoking, self._interval)
                shares = self._write_found(self._rule, at, tables, values[:, part])
                if weights is not None:
                    weights[:, part] = shares
                continue
            shares = self._rule(planes, local, x[part], y[part], self._provoking, self._interval).T
            self._mixer.write_mixed(tables, shares, local, values[:, part])
            if weights is not None:
                weights[:, part] = shares

    def _write_found(self, rule: ValueRule, at: ValuePlaces, tables: Floats, values: Floats) -> Floats:
        """Write the values (K, F) that a rule finds by itself; return its weights (3, F)."""
        shares = None
        for places, corners in self._mixer.at_corners(tables, at.primitive):
            shares, found = rule.weights_and_values(at, corners)
            for place in places:
                values[place] = found
        return rule(*at).T if shares is None else shares

    def _close_at_hand(self, primitive: Integers) -> tuple[Planes, Floats, Integers]:
        """Return the tables of the primitives of a block, and which of them each fragment (B,) belongs to."""
        if self._all is not None:
            return *self._all, primitive
        shown, local = self._numbers.number(primitive)
        return *self._tables_of(shown), local

    def _tables_of(self, primitives: Integers) -> tuple[Planes, Floats]:
        """Return the planes and values of primitives (U,), copied together."""
        a, b, c, w = [rows.take(primitives, axis=1).T for rows in self._plane_rows]
        determinant, homogeneous = self._planes.determinant.take(primitives), self._planes.homogeneous
        return Planes(a, b, c, determinant, w, homogeneous, primitives), self._mixer.tables(primitives)


def _each_its_own(varyings: Floats) -> CornerValues:
    """Return varyings (P, 3, K) as corners that share no row."""
    count, _, width = varyings.shape
    return CornerValues(varyings.reshape(3 * count, width), {}, own_corners(np.arange(count)))
