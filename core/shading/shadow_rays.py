"""Shadows by rays to the light: the exact referee of shadow maps, as far as float64 goes.

All rays to a light from far away are parallel. In the space of its map they run along the depth, so a triangle stands
before a point where it covers the point's column and row at a smaller depth: a shadow map whose texels are points.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import RETURN, Either, Operation
from core.shading.shadows import Lamp, in_light_space

OWN_SURFACE = 1e-9
"""Nearer than this, in depth, a triangle is the surface that the point lies on."""
PAIRS = 1 << 20
"""Points times triangles that are looked at together."""


@dataclass(frozen=True, eq=False)
class RayHits:
    """F rays towards the light."""

    place: Floats
    """(F, 3) float64: column and row in the space of the map, and depth from the light."""
    blocker: Integers
    """(F,) int64, the triangle that the ray meets first, the one nearest to the point; -1: none."""
    blocker_depth: Floats
    """(F,) float64, depth from the light where it meets it, NaN: nowhere."""
    share: Floats
    """(F,) float64, 1 where it meets none, else 0."""


def ray_share(
    position: Sequence[float],
    to_map: Sequence[Sequence[float]],
    triangles: Sequence[Sequence[Sequence[float]]],
) -> float:
    """Return 1 for a point from which no triangle hides the light, else 0 (listing of `shadow_rays`)."""
    x, y, z = position
    u, v, depth = [a * x + b * y + c * z + d for a, b, c, d in to_map]  #: light-space
    blocker, nearest = -1, float("-inf")  #: free
    for number, ((ax, ay, az), (bx, by, bz), (cx, cy, cz)) in enumerate(triangles):
        alpha = (bx - u) * (cy - v) - (by - v) * (cx - u)
        beta = (cx - u) * (ay - v) - (cy - v) * (ax - u)
        gamma = (ax - u) * (by - v) - (ay - v) * (bx - u)
        area = alpha + beta + gamma
        if area != 0 and alpha * area >= 0 and beta * area >= 0 and gamma * area >= 0:
            there = (alpha * az + beta * bz + gamma * cz) / area
            if nearest < there < depth - 1e-9:
                blocker, nearest = number, there  #: ray
    return 1.0 if blocker < 0 else 0.0  #: share


@method(
    "shadow",
    "rays",
    "Rays to the light",
    source="Appel 1968, Some techniques for shading machine renderings of solids; Whitted 1980",
    exact_for="shadows with sharp borders, up to rounding: nothing is sampled",
    breaks_where="every pixel asks every triangle: large scenes are refused",
    needs=("world-boxes", "few-rays"),
    listing=ray_share,
    operations={
        "shadow": (
            Operation("light-space", "light-space", {"lamp_u": "u", "lamp_v": "v", "lamp_depth": "depth"}),
            Operation(
                "shadow-ray",
                Either("blocker", "ray", "free"),
                {"blocker": "blocker", "blocker_depth": "nearest"},
            ),
            Operation("share", "share", {"light_share": RETURN}),
        )
    },
    traits="rays",
)
def shadow_rays(position: Floats, lamp: Lamp) -> RayHits:
    """Find what stands between points (F, 3) in world space and the light."""
    assert lamp.triangles is not None
    place = np.stack(in_light_space(position, lamp.to_map), axis=1)
    blocker, nearest = np.full(len(place), -1), np.full(len(place), -np.inf)
    for point, triangle in _near_pairs(place, lamp.triangles):
        covers, there = _depth_above(place[point], lamp.triangles[triangle])
        hides = covers & (there < place[point, 2] - OWN_SURFACE)
        # The last of the pairs sorted by depth is the nearest; of equals the triangle with the lower number.
        point, triangle, there = point[hides], triangle[hides], there[hides]
        order = np.lexsort((-triangle, there))
        point, triangle, there = point[order], triangle[order], there[order]
        is_nearer = there > nearest[point]
        point, triangle, there = point[is_nearer], triangle[is_nearer], there[is_nearer]
        blocker[point], nearest[point] = triangle, there
    depth = np.where(blocker < 0, np.nan, nearest)
    return RayHits(place, blocker, depth, (blocker < 0).astype(np.float64))


def _near_pairs(place: Floats, triangles: Floats) -> Iterator[tuple[Integers, Integers]]:
    """Yield points (Q,) and triangles (Q,) whose boxes across the light meet; triangles in rising parts."""
    low, high = triangles[..., :2].min(axis=1), triangles[..., :2].max(axis=1)
    part = max(PAIRS // max(len(place), 1), 1)
    for first in range(0, len(triangles), part):
        chosen = slice(first, first + part)
        at = place[:, None, :2]
        meets = ((at >= low[chosen]) & (at <= high[chosen])).all(axis=2)
        point, triangle = np.nonzero(meets)
        yield point, triangle + first


def _depth_above(place: Floats, triangles: Floats) -> tuple[Flags, Floats]:
    """Return whether triangles (Q, 3, 3) cover places (Q, 3), and their depth (Q,) there."""
    u, v, _ = place.T
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (triangles[:, corner].T for corner in range(3))
    alpha = (bx - u) * (cy - v) - (by - v) * (cx - u)
    beta = (cx - u) * (ay - v) - (cy - v) * (ax - u)
    gamma = (ax - u) * (by - v) - (ay - v) * (bx - u)
    area = alpha + beta + gamma
    covers = (area != 0) & (alpha * area >= 0) & (beta * area >= 0) & (gamma * area >= 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        there = (alpha * az + beta * bz + gamma * cz) / area
    return covers, there
