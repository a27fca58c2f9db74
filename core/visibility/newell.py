"""Newell's five tests: whether one triangle may be drawn before another, from the cheapest test to the dearest.

They are sufficient: one that holds allows the order; where none holds, the other order is tried, and then a cut.

References
----------
M. Newell, R. Newell, T. Sancha, *A solution to the hidden surface problem*, ACM Annual Conference 1972.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from core.records.arrays import Flags, Floats
from core.visibility.bsp import distances, planes_of

LEVEL = 1e-9
"""Difference of z/w that counts as 0 where two triangles overlap."""
TESTS = ("x", "y", "behind", "before", "overlap")
"""P and Q do not overlap in x, or in y; P lies behind the plane of Q; Q lies before the plane of P; no overlap."""


@dataclass(frozen=True, eq=False)
class PairTests:
    """The tests of P, which is drawn first, and Q."""

    first: int
    second: int
    holds: Flags
    """(5,) bool, of `TESTS`."""
    reversed_holds: Flags
    """(5,) bool, the same for Q drawn first."""

    nearer: str
    """Which is nearer where the two overlap in the window: ``P``, ``Q``, ``both`` in different places, ``neither``
    where they do not overlap or are level there, ``unknown`` where one reaches behind the eye."""

    @property
    def verdict(self) -> str:
        """Which order is right: ``either``, ``right`` for P first, ``wrong`` for Q first, ``cut`` for none."""
        by_overlap = {"neither": "either", "Q": "right", "P": "wrong", "both": "cut"}
        if self.nearer in by_overlap:
            return by_overlap[self.nearer]
        if self.holds.any() or self.reversed_holds.any():
            return "right" if self.holds.any() else "wrong"
        return "cut"


def examine_pairs(clip: Floats, order: list[int]) -> list[PairTests]:
    """Return the tests of all pairs of triangles (T, 3, 4) in clip space, each in its ``order`` of drawing."""
    plane, has_plane = planes_of(clip)
    eye = np.sign(-plane[:, 2]) * has_plane
    found = []
    for first, second in combinations(order, 2):
        d = {(p, q): distances(clip[p], plane[q]) * eye[q] for p, q in ((first, second), (second, first))}
        apart = _are_apart(clip[first], clip[second])
        holds, other = (
            np.array(
                [
                    *apart[:2],
                    eye[q] != 0 and bool((d[p, q] <= 0).all()),
                    eye[p] != 0 and bool((d[q, p] >= 0).all()),
                    apart[2],
                ]
            )
            for p, q in ((first, second), (second, first))
        )
        nearer = _nearer(clip[[first, second]], plane[[first, second]], apart[2])
        found.append(PairTests(first, second, holds, other, nearer))
    return found


def _are_apart(first: Floats, second: Floats) -> tuple[bool, bool, bool]:
    """Return whether two triangles (3, 4) do not overlap in x, in y, in the window; none is sure behind the eye."""
    if min(first[:, 3].min(), second[:, 3].min()) <= 0:
        return False, False, False
    one, other = (corners[:, :2] / corners[:, 3:] for corners in (first, second))
    in_x, in_y = (
        (one[:, k].max() <= other[:, k].min()) | (other[:, k].max() <= one[:, k].min()) for k in (0, 1)
    )
    sides = np.concatenate([np.roll(corners, -1, axis=0) - corners for corners in (one, other)])
    normals = np.stack([-sides[:, 1], sides[:, 0]], axis=1)
    along, across = one @ normals.T, other @ normals.T
    is_free = (along.max(axis=0) <= across.min(axis=0)) | (across.max(axis=0) <= along.min(axis=0))
    return bool(in_x), bool(in_y), bool(in_x or in_y or is_free.any())


def _nearer(clip: Floats, plane: Floats, is_apart: bool) -> str:
    """Return what ``PairTests.nearer`` says of two triangles (2, 3, 4) in the planes (2, 4)."""
    if is_apart or (plane[:, 2] == 0).any():
        return "neither"
    if (clip[..., 3] <= 0).any():
        return "unknown"
    one, other = clip[..., :2] / clip[..., 3:]
    side = other[1:] - other[:1]
    turn = np.sign(side[0, 0] * side[1, 1] - side[0, 1] * side[1, 0])
    overlap = list(one)
    for k in range(3):
        start, along = other[k], other[(k + 1) % 3] - other[k]
        overlap = _left_of(overlap, start, along * turn)
    if not overlap:
        return "neither"
    x, y = np.array(overlap).T
    z = [-(a * x + b * y + d) / c for a, b, c, d in plane]
    apart = z[1] - z[0]
    apart[np.abs(apart) <= LEVEL] = 0
    if not apart.any():
        return "neither"
    return "P" if apart.min() >= 0 else "Q" if apart.max() <= 0 else "both"


def _left_of(polygon: list[Floats], start: Floats, along: Floats) -> list[Floats]:
    """Return what of a convex polygon lies on the left of a line."""
    away = [along[0] * (y - start[1]) - along[1] * (x - start[0]) for x, y in polygon]
    found = []
    for k, (here, d) in enumerate(zip(polygon, away, strict=True)):
        before = away[k - 1]
        if min(d, before) < 0 < max(d, before):
            found.append(polygon[k - 1] + before / (before - d) * (here - polygon[k - 1]))
        if d >= 0:
            found.append(here)
    return found


def find_cycle(pairs: list[PairTests]) -> list[int]:
    """Return triangles of which each must be drawn before the next, and the last before the first; empty: none."""
    before: dict[int, list[int]] = {}
    for pair in pairs:
        if pair.verdict == "right":
            before.setdefault(pair.first, []).append(pair.second)
        elif pair.verdict == "wrong":
            before.setdefault(pair.second, []).append(pair.first)
    shortest: list[int] = []
    for start in before:
        # Breadth first: the shortest way back to the start.
        paths, seen = [[start]], {start}
        while paths:
            path = paths.pop(0)
            following = before.get(path[-1], [])
            if start in following and (not shortest or len(path) < len(shortest)):
                shortest = path
            paths += [[*path, one] for one in following if one not in seen]
            seen |= set(following)
    return shortest
