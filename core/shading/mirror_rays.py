"""Reflections by rays: the exact referee of environment maps, as far as float64 goes.

One ray leaves each point of a mirror along R. What it meets first is lit as seen from there; that in turn mirrors
nothing, so the ray is followed once.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np

from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import Either, Operation
from core.shading.environment import AFTER, BEFORE, Mirrored, Surroundings, reflect
from core.shading.lighting import Planes, Vector, dot, inner, planes

PAIRS = 1 << 18
"""Rays times triangles that are looked at together."""


@dataclass(frozen=True, eq=False)
class MirrorRays(Mirrored):
    """F rays along R."""

    met: Integers
    """(F,) int64, the triangle that a ray meets first; -1: none."""
    distance: Floats
    """(F,) float64, how far away; NaN: it meets nothing."""


def meet(
    origin: Vector, r: Vector, first: Vector, second: Vector, third: Vector
) -> tuple[float, float, float]:
    """Return how far along r a triangle's plane is met, and the weights of its second and third corner there."""
    to_second = [second[k] - first[k] for k in range(3)]
    to_third = [third[k] - first[k] for k in range(3)]
    away = [origin[k] - first[k] for k in range(3)]
    p, q = cross(r, to_third), cross(away, to_second)
    volume = inner(to_second, p)
    if volume == 0:
        return inf, -1.0, -1.0
    return inner(to_third, q) / volume, inner(away, p) / volume, inner(r, q) / volume


def cross(a: Vector, b: Vector) -> list[float]:
    """Return the cross product of two vectors."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def ray_color(
    position: Sequence[float],
    normal: Sequence[float],
    to_eye: Sequence[float],
    triangles: Sequence[Sequence[Sequence[float]]],
    least: float,
    shade: Callable[[int, list[float], Sequence[float]], Sequence[float]],
    background: Sequence[float],
    own: Sequence[float],
    mirror: float,
) -> tuple[float, ...]:
    """Return the colour of a fragment of a mirror from which one ray is cast (listing of `mirror_rays`)."""
    incoming = [-to_eye[0], -to_eye[1], -to_eye[2]]
    n_dot_i = inner(normal, incoming)  #: cosine
    r = [incoming[k] - 2 * n_dot_i * normal[k] for k in range(3)]  #: reflect
    met, nearest, weights = -1, inf, [0.0, 0.0, 0.0]  #: free
    for number, (first, second, third) in enumerate(triangles):
        distance, beta, gamma = meet(position, r, first, second, third)
        if beta >= 0 and gamma >= 0 and beta + gamma <= 1 and least < distance < nearest:
            met, nearest, weights = number, distance, [1 - beta - gamma, beta, gamma]  #: ray
    seen = background if met < 0 else shade(met, weights, position)  #: look-up
    red, green, blue = (own[k] + mirror * seen[k] for k in range(3))  #: mirror
    return red, green, blue, own[3]


@method(
    "environment",
    "rays",
    "Rays from the mirror",
    source="Whitted 1980, An improved illumination model for shaded display",
    exact_for="reflections that are followed once, up to rounding: nothing is sampled",
    breaks_where="every pixel of a mirror asks every triangle: large scenes are refused. What is mirrored casts no "
    "shadow and mirrors nothing itself; near the outline of a curved mirror of few triangles, the ray of "
    "an interpolated normal may run into the mirror",
    needs=("world-boxes", "few-rays"),
    listing=ray_color,
    operations={
        "mirror": (
            *BEFORE,
            Operation("ray", Either("met", "ray", "free"), {"met": "met", "met_distance": "nearest"}),
            Operation("look-up", "look-up", {"seen": "seen"}),
            *AFTER,
        )
    },
    traits="rays",
)
def mirror_rays(position: Floats, normal: Floats, to_eye: Floats, around: Surroundings) -> MirrorRays:
    """Find what rays from points (F, 3) in world space meet along R; arguments as `core.shading.environment.cube`."""
    n_dot_i, direction = reflect(normal, to_eye)
    met, distance, weights = nearest_met(position, direction, around.triangles, around.least)
    color = np.broadcast_to(around.background, (len(met), 3)).copy()
    hit = np.flatnonzero(met >= 0)
    color[hit] = around.shade(met[hit], weights[hit], position[hit])
    return MirrorRays(n_dot_i, direction, color, met, np.where(met < 0, np.nan, distance))


def nearest_met(
    origin: Floats, direction: Floats, triangles: Floats, least: float
) -> tuple[Integers, Floats, Floats]:
    """Return what rays from ``origin`` (F, 3) along ``direction`` (F, 3) meet first, farther away than ``least``.

    Returns
    -------
    triangle : (F,) int64, the first of those at one distance; -1: none
    distance : (F,) float64 in lengths of ``direction``; infinite: none
    weights : (F, 3) float64 of its corners
    """
    count = len(origin)
    triangle, distance, weights = np.full(count, -1), np.full(count, inf), np.zeros((count, 3))
    part = max(PAIRS // max(count, 1), 1)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for start in range(0, len(triangles), part):
            some = triangles[start : start + part]
            there, second, third, is_met = _meet_all(planes(origin), planes(direction), some)
            there = np.where(is_met & (there > least), there, inf)
            first = there.argmin(axis=0)
            rows = np.arange(count)
            nearer = np.flatnonzero(there[first, rows] < distance)
            chosen = first[nearer], nearer
            triangle[nearer], distance[nearer] = start + first[nearer], there[chosen]
            beta, gamma = second[chosen], third[chosen]
            weights[nearer] = np.stack([1 - beta - gamma, beta, gamma], axis=1)
    return triangle, distance, weights


def _meet_all(origin: Planes, direction: Planes, triangles: Floats) -> tuple[Floats, Floats, Floats, Flags]:
    """Return `meet` of triangles (Q, 3, 3) and F rays, (Q, F) each, and whether they are met."""
    first, second, third = (triangles[:, k].T[:, :, None] for k in range(3))
    to_second, to_third = _vector(second - first), _vector(third - first)
    away = _vector([origin[k] - first[k] for k in range(3)])
    p, q = _cross(direction, to_third), _cross(away, to_second)
    volume = dot(to_second, p)
    beta, gamma = dot(away, p) / volume, dot(direction, q) / volume
    is_met = (volume != 0) & (beta >= 0) & (gamma >= 0) & (beta + gamma <= 1)
    return dot(to_third, q) / volume, beta, gamma, is_met


def _vector(components: Any) -> Planes:
    x, y, z = components
    return x, y, z


def _cross(a: Planes, b: Planes) -> Planes:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
