"""Culling of objects: a box outside one plane of the view volume drops all that is in it, triangles and inner boxes.

A box has one corner farthest along a plane's normal (p) and one farthest against it (n). Where p is outside, the whole
box is; where n is inside, so is the box, and what lies in it need not ask this plane again.

A box outside no single plane may still be outside of all six together: it is kept, and its triangles decide.

References
----------
U. Assarsson, T. Moeller, *Optimized view frustum culling algorithms for bounding boxes*, 2000.
LMU, *Computer Graphics 1*, "Culling": "View frustum culling: do not render objects outside view frustum".
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from core.culling.culling import PLANE_COEFFICIENTS, PLANES
from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.box_tree import BoxTree

if TYPE_CHECKING:
    from core.culling.occlusion import Occlusion

ROUNDING = 2.0**-45
"""Bound of the rounding in two matrices and a distance, as a share of the sizes of all terms: 256 roundings."""
OUTSIDE, INSIDE, CROSSING = range(3)
"""Where a box lies against a plane."""


@dataclass(frozen=True, eq=False)
class ViewPlanes:
    """The planes of the view volume in world space, inwards positive."""

    coefficients: Floats
    """(6, 4) float64, rows of P C^-1 put together: the distance of (x, y, z, 1) is the sum of the products."""
    sizes: Floats
    """(6, 4) float64, the same of the sizes of all terms: what rounding goes by."""

    def slack(self, lower: Floats, upper: Floats) -> Floats:
        """Return (N, 6): by how much the distance of a point in boxes (N, 3) may be rounded."""
        farthest = np.maximum(np.abs(lower), np.abs(upper))
        return ROUNDING * (farthest @ self.sizes[:, :3].T + self.sizes[:, 3]) + 1e-300


def view_planes(projection: Floats, view: Floats) -> ViewPlanes:
    """Return the six planes of P (4, 4) and C^-1 (4, 4), in the order of `core.culling.culling.PLANES`."""
    sizes = np.abs(PLANE_COEFFICIENTS) @ (np.abs(projection) @ np.abs(view))
    return ViewPlanes(PLANE_COEFFICIENTS @ (projection @ view), sizes)


@dataclass(frozen=True, eq=False)
class BoxSides:
    """Where N boxes lie against every plane."""

    far: Floats
    """(N, 6) float64, distance of the corner farthest along the plane's normal."""
    near: Floats
    """(N, 6) float64, distance of the corner farthest against it."""
    slack: Floats
    """(N, 6) float64, what these may be off by."""
    side: Integers
    """(N, 6) int64, ``OUTSIDE``, ``INSIDE`` or ``CROSSING``."""


def corner_distances(lower: Floats, upper: Floats, planes: ViewPlanes) -> tuple[Floats, Floats]:
    """Return the distances (N, 6) of the corners of boxes (N, 3) farthest along and against every plane's normal."""
    along = [np.zeros((len(lower), len(PLANES))) for _ in range(2)]
    for axis in range(3):
        change = planes.coefficients[:, axis]
        one, other = lower[:, axis, None] * change, upper[:, axis, None] * change
        along = [along[0] + np.maximum(one, other), along[1] + np.minimum(one, other)]
    return along[0] + planes.coefficients[:, 3], along[1] + planes.coefficients[:, 3]


@method("object_culling", "none", "No object", source="LMU 2020, Culling", exact_for="every scene")
def cull_no_object(lower: Floats, upper: Floats, planes: ViewPlanes) -> BoxSides:
    """Ask no box."""
    none = np.zeros((len(lower), len(PLANES)))
    return BoxSides(none, none, none, np.full(none.shape, CROSSING))


def box_against_planes(
    lower: Sequence[float],
    upper: Sequence[float],
    planes: Sequence[Sequence[float]],
    slack: Sequence[float],
    open_planes: Sequence[int],
) -> tuple[str, list[int]]:
    """Listing of one box: which planes it lies outside of or crosses, of those that the boxes around it cross."""
    crossed = []
    for k in open_planes:
        *normal, d = planes[k]
        p = [high if n > 0 else low for n, low, high in zip(normal, lower, upper, strict=True)]  #: p
        far = normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] + d  #: far
        if far < -slack[k]:  #: outside
            return "outside", []  #: dropped
        q = [low if n > 0 else high for n, low, high in zip(normal, lower, upper, strict=True)]  #: n
        near = normal[0] * q[0] + normal[1] * q[1] + normal[2] * q[2] + d  #: near
        if near < 0:  #: crosses
            crossed.append(k)
    if crossed:  #: verdict
        return "crossing", crossed
    return "inside", []


@method(
    "object_culling",
    "frustum",
    "Frustum, by boxes",
    source="Assarsson and Moeller 2000; LMU 2020, View frustum culling",
    exact_for="every scene: what is dropped has no pixel in the picture",
    breaks_where="a box beside a corner of the view volume may be outside no single plane: kept, though not seen",
    needs=("world-boxes",),
    takes=("hierarchy",),
    listing=box_against_planes,
)
def frustum(lower: Floats, upper: Floats, planes: ViewPlanes) -> BoxSides:
    """Ask boxes (N, 3) by two corners for every plane; outside only beyond all rounding."""
    far, near = corner_distances(lower, upper, planes)
    slack = planes.slack(lower, upper)
    side = np.where(far < -slack, OUTSIDE, np.where(near < 0, CROSSING, INSIDE))
    return BoxSides(far, near, slack, side)


BoxRule = Callable[[Floats, Floats, ViewPlanes], BoxSides]
"""A method of the family ``object_culling``."""


@dataclass(frozen=True, eq=False)
class ObjectCulling:
    """What culling of objects did: a walk through a tree of boxes, plane by plane."""

    tree: BoxTree
    planes: ViewPlanes
    sides: BoxSides
    """Of all N nodes, asked or not."""
    visited: Integers
    """(V,) int64, the nodes that were asked, in order."""
    verdict: Integers
    """(V,) int64, ``OUTSIDE``, ``INSIDE`` (taken whole) or ``CROSSING``."""
    visit: Integers
    """(Q,) int64, the place in ``visited`` of every test of a box by a plane."""
    plane: Integers
    """(Q,) int64, the plane."""
    dropped_by: Integers
    """(T,) int64, the plane that all boxes of an object lie outside of, -1: it is not dropped."""
    dropped_in: Integers
    """(T,) int64, the node that it is dropped with, the first of several; -1: it is not."""
    is_hidden: Flags
    """(T,) bool, all boxes of an object are hidden behind occluders."""
    occlusion: "Occlusion | None" = None
    """What compared boxes with occluders; ``None``: none was."""

    @property
    def is_dropped(self) -> Flags:
        """(T,) bool."""
        return np.asarray((self.dropped_by >= 0) | self.is_hidden)

    @property
    def kept_leaves(self) -> Integers:
        """(L,) int64, the leaves with objects that lie outside of no plane, nor does what they lie in."""
        is_kept = self.tree.is_leaf & (self.tree.count > 0)
        for node in self.visited[self.verdict == OUTSIDE].tolist():
            is_kept[node : self.tree.subtree_end[node]] = False
        return np.flatnonzero(is_kept)

    def hiding(self, occlusion: "Occlusion") -> "ObjectCulling":
        """Return the same, which also drops objects all leaves of which are hidden."""
        hidden = occlusion.boxes.node[occlusion.tests.is_hidden]
        items = np.concatenate([*map(self.tree.items_of, hidden.tolist()), np.empty(0, np.int64)])
        count = len(self.is_hidden)
        is_hidden = np.bincount(items, minlength=count) == np.bincount(self.tree.items, minlength=count)
        is_hidden &= np.isin(np.arange(count), items)
        dropped_in = self.dropped_in.copy()
        first = np.full(count, -1)
        first[items[::-1]] = np.repeat(hidden, self.tree.count[hidden])[::-1]
        dropped_in[is_hidden] = first[is_hidden]
        return replace(self, is_hidden=is_hidden, dropped_in=dropped_in, occlusion=occlusion)

    @property
    def one_by_one_count(self) -> int:
        """How many tests by a plane the leaves alone would take, each asked until a plane drops it."""
        leaf = self.sides.side[self.tree.is_leaf]
        is_out = leaf == OUTSIDE
        return int(np.where(is_out.any(axis=1), is_out.argmax(axis=1) + 1, leaf.shape[1]).sum())


def cull_objects(
    tree: BoxTree, rule: BoxRule, planes: ViewPlanes, object_count: int, plane_count: int = len(PLANES)
) -> ObjectCulling:
    """Walk a tree of boxes over T objects, and drop what lies outside of a plane.

    Parameters
    ----------
    plane_count : int
        How many of ``PLANES`` are asked.

    Notes
    -----
    An object in several leaves is dropped only where one and the same plane has all of them outside.
    """
    sides = rule(tree.lower, tree.upper, planes)
    side, ends = sides.side.tolist(), tree.subtree_end.tolist()
    left = [tuple(range(plane_count))] * len(tree)
    visited, verdicts, visits, asked = list[int](), list[int](), list[int](), list[int]()
    node = 0
    while node < len(ends):
        crossed, verdict = [], INSIDE
        for plane in left[node]:
            visits.append(len(visited))
            asked.append(plane)
            if side[node][plane] == OUTSIDE:
                verdict = OUTSIDE
                break
            if side[node][plane] == CROSSING:
                crossed.append(plane)
                verdict = CROSSING
        visited.append(node)
        verdicts.append(verdict)
        if verdict == CROSSING:
            for child in tree.children(node):
                left[child] = tuple(crossed)
            node += 1
        else:
            node = ends[node]
    nodes, of_nodes, visit, planes_asked = (
        np.array(numbers, np.int64) for numbers in (visited, verdicts, visits, asked)
    )
    dropped = _dropped(tree, nodes, of_nodes, visit, planes_asked, object_count)
    none = np.zeros(object_count, bool)
    return ObjectCulling(tree, planes, sides, nodes, of_nodes, visit, planes_asked, *dropped, none)


def _dropped(
    tree: BoxTree, visited: Integers, verdict: Integers, visit: Integers, plane: Integers, object_count: int
) -> tuple[Integers, Integers]:
    """Return the plane that all leaves of every object (T,) are outside of, and the first node that was; -1: none."""
    out = np.flatnonzero(verdict == OUTSIDE)
    last = np.searchsorted(visit, out, "right") - 1
    nodes, by = visited[out], plane[last]
    items = np.concatenate([*(tree.items_of(node) for node in nodes.tolist()), np.empty(0, np.int64)])
    counts = tree.count[nodes]
    listed = np.bincount(tree.items, minlength=object_count)
    of_plane = np.repeat(by, counts)
    dropped_by = np.full(object_count, -1)
    for k in range(len(PLANES)):
        times = np.bincount(items[of_plane == k], minlength=object_count)
        dropped_by[(times == listed) & (listed > 0)] = k
    dropped_in = np.full(object_count, -1)
    dropped_in[items[::-1]] = np.repeat(nodes, counts)[::-1]
    return dropped_by, np.where(dropped_by >= 0, dropped_in, -1)
