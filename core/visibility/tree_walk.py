"""The rays of a picture walk a tree of boxes together, each at its own node: what each one visits and meets."""

import numpy as np

from core.records.arrays import Floats, Integers
from core.visibility.ray_casting import RayPlanes, RayTests, compare_hits
from core.visibility.rays_in_tree import BEHIND, MISSED, OPENED, TreeRays, TreeWalk, Visits, slabs


def _hidden_in(rays: TreeRays, hits: "_Hits", ray: Integers, visits: Visits | None) -> Integers:
    """Return the box (F,) that hides each fragment which was not compared; -1: none, or visits are not kept."""
    found = np.full(len(ray), -1)
    if visits is None:
        return found
    tree = rays.tree
    place = np.full(int(tree.items.max(initial=-1)) + 1, -1)
    place[tree.items[::-1]] = np.arange(len(tree.items))[::-1]
    starts = np.searchsorted(visits.ray, np.arange(int(ray.max(initial=-1)) + 2))
    for fragment in np.flatnonzero(hits.time < 0).tolist():
        of_ray = slice(starts[ray[fragment]], starts[ray[fragment] + 1])
        closed = visits.node[of_ray][visits.verdict[of_ray] != OPENED]
        at = place[hits.triangle[fragment]]
        holds = (tree.first.take(closed) <= at) & (at < tree.first.take(closed) + tree.count.take(closed))
        found[fragment] = closed[holds][0] if holds.any() else -1
    return found


class _Hits:
    """F fragments as rays find them: by pixel and triangle; and the nearest of every ray so far."""

    def __init__(self, pixel: Integers, triangle: Integers, rays: Integers, initial: Integers) -> None:
        self.triangle = triangle
        self.stride = int(triangle.max(initial=0)) + 1
        key = np.searchsorted(rays, pixel) * self.stride + triangle
        self.order = np.argsort(key, kind="stable")
        self.key = key[self.order]
        self.nearest, self.fragment = initial.copy(), np.full(len(rays), -1)
        count = len(pixel)
        self.before, self.how, self.sign = (np.full(count, value) for value in (-1, 0, -1))
        self.passes, self.time, self.rank = np.zeros(count, bool), np.full(count, -1), np.full(count, -1)
        self.previous, self.tied_by = np.full(count, -1), np.full(count, -1)

    def find(self, ray: Integers, triangle: Integers) -> Integers:
        """Return the fragments (U,) of triangles (U,) at rays (U,), -1 where they do not cover the pixel."""
        key = ray * self.stride + triangle
        place = np.minimum(np.searchsorted(self.key, key), max(len(self.key) - 1, 0))
        is_there = (triangle < self.stride) & (self.key.take(place) == key)
        return np.where(is_there, self.order.take(place), -1)

    def compare(
        self, planes: RayPlanes, ray: Integers, hit: Integers, m: Floats, n: Floats, time: int, rank: int
    ) -> None:
        """Compare fragments (U,) with the nearest of their rays; of two equally near ones that drawn first stays."""
        new, old = self.triangle.take(hit), self.nearest.take(ray)
        sign, how = compare_hits(planes, new, old, m.take(ray), n.take(ray))
        wins = (sign > 0) | ((sign == 0) & (new < old))
        self.before[hit], self.how[hit], self.sign[hit], self.passes[hit] = old, how, sign, wins
        self.time[hit], self.rank[hit], self.previous[hit] = time, rank, self.fragment.take(ray)
        replaced, by = self.fragment.take(ray)[wins & (sign == 0)], hit[wins & (sign == 0)]
        self.tied_by[replaced[replaced >= 0]] = by[replaced >= 0]
        self.nearest[ray[wins]], self.fragment[ray[wins]] = new[wins], hit[wins]


def walk_rays(
    rays: TreeRays,
    planes: RayPlanes,
    pixel: Integers,
    triangle: Integers,
    of_ray: tuple[Integers, Floats, Floats],
    initial: Integers,
    keeps_visits: bool,
) -> tuple[RayTests, TreeWalk]:
    """Send a ray through the tree for each of U pixels, and compare the F fragments that it finds.

    Parameters
    ----------
    pixel, triangle : (F,) int64
        Of the fragments, in drawing order.
    of_ray : (U,) int64 and twice (U,) float64
        The pixels, rising, and m and n of their rays.
    initial : (U,) int64
        The nearest triangle before all, -1: none.
    keeps_visits : bool
        Whether every visit of a box is listed.

    Returns
    -------
    tests : RayTests
        Of every fragment, against the nearest by the time that it was compared; one that the tree hides fails.
    walk : TreeWalk
    """
    tree, (pixels, m, n) = rays.tree, of_ray
    x, y = m / planes.size[0], n / planes.size[1]
    origin, direction = rays.rays(x, y)
    hits = _Hits(pixel, triangle, pixels, initial)
    node, box_count, asked_count = np.zeros((3, len(pixels)), np.int64)
    kept: list[tuple[Integers, ...]] = []
    time, active = 0, np.arange(len(pixels) if len(tree) else 0)
    while len(active):
        at = node.take(active)
        way = origin.take(active, axis=1), direction.take(active, axis=1)
        near, far = slabs(*way, rays.lower.take(at, axis=0).T, rays.upper.take(at, axis=0).T)
        enter = np.maximum(near.max(axis=0), rays.least)
        is_met = enter <= far.min(axis=0)
        nearest = hits.nearest.take(active)
        value, error = planes.values(np.maximum(nearest, 0), m.take(active), n.take(active))
        is_behind = is_met & (nearest >= 0) & (value - error > rays.nearness(enter, at))
        verdict = np.where(is_met, np.where(is_behind, BEHIND, OPENED), MISSED)
        if keeps_visits:
            kept.append((active, at, verdict, np.full(len(active), time), nearest))
        box_count[active] += 1
        opened = np.flatnonzero((verdict == OPENED) & tree.is_leaf.take(at))
        counts = tree.count.take(at[opened])
        for rank in range(int(counts.max(initial=0))):
            here = opened[counts > rank]
            ray, own = active[here], tree.items.take(tree.first.take(at[here]) + rank)
            asked_count[ray] += 1
            found = hits.find(ray, own) if len(pixel) else np.full(len(ray), -1)
            new = (found >= 0) & (hits.time.take(found) < 0) if len(pixel) else found >= 0
            if new.any():
                hits.compare(planes, ray[new], found[new], m, n, time, rank)
        node[active] = np.where(verdict == OPENED, at + 1, tree.subtree_end.take(at))
        active = active[node.take(active) < len(tree)]
        time += 1
    tests = RayTests(hits.before, hits.passes, hits.how, hits.sign)
    visits = None
    if keeps_visits:
        columns = (
            [np.concatenate(column) for column in zip(*kept, strict=True)]
            if kept
            else [np.empty(0, np.int64)] * 5
        )
        order = np.lexsort((columns[3], columns[0]))
        visits = Visits(*(column[order] for column in columns))
    ray = np.searchsorted(pixels, pixel)
    winner = hits.nearest.take(ray)
    wins = np.zeros(len(pixel), bool)
    wins[hits.fragment[hits.fragment >= 0]] = True
    ties = (
        ((hits.sign == 0) & (hits.before == winner) & ~wins) | ((hits.tied_by >= 0) & wins.take(hits.tied_by))
        if len(pixel)
        else wins
    )
    walk = TreeWalk(
        rays,
        x,
        y,
        pixels,
        wins,
        winner,
        ties,
        hits.time,
        hits.rank,
        hits.previous,
        box_count,
        asked_count,
        visits,
        _hidden_in(rays, hits, ray, visits),
    )
    return tests, walk
