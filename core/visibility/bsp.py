"""Painter's algorithm with cuts: a tree of the triangles' own planes, walked from back to front.

Every node of a binary space partitioning tree holds the plane of one triangle. What lies before the plane stands in its
one half, what lies behind it in the other, and what crosses it is cut in two. Nothing of the half without the eye can
hide anything of the half with it, so this half is drawn first, then the node, then the half with the eye. The tree
knows no camera: another eye walks the same tree in another order.

All is done in clip space, before anything is divided by w, so that corners behind the eye need no care. A plane is four
numbers there, the cofactors of three corners, and the eye is the position (0, 0, -1, 0), for perspective and
orthographic cameras alike: every ray of the picture goes along z.

References
----------
H. Fuchs, Z. Kedem, B. Naylor, *On visible surface generation by a priori tree structures*, SIGGRAPH 1980.
M. Newell, R. Newell, T. Sancha, *A solution to the hidden surface problem*, 1972 (cutting).
M. Zwicker, *Computergrafik*, lecture "Visibility", Bern 2016: "may need to split triangles if they intersect".
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from core.methods import method
from core.numeric.watched import report
from core.records.arrays import Flags, Floats, Integers, cached_property, read_only
from core.records.primitives import DrawingOrder, Pieces

TOLERANCE = 1e-12
"""Distance that counts as 0, as a part of the sizes of its four products: no triangle cuts its neighbour at an edge."""
LARGEST_TREE = 20_000
"""Pieces that a tree may have; nearly as many as the square of triangles that cross at random."""
MOST_TESTS = 4_000_000
"""Pieces that may be tested against planes, all nodes together; half the square of the faces of a convex body."""
ON, FRONT, BACK, CUT = range(4)
"""Where a piece lies: in the plane, before it (or partly in it), behind it, on both sides."""


@dataclass(frozen=True, eq=False)
class BspTree:
    """A tree of M nodes over T triangles, and how it was built; node 0 is the root, front halves come first.

    Of the A pieces the first T are the whole triangles; what was cut stays in the list and in no node.
    """

    clip: Floats
    """(A, 3, 4) float64, clip space."""
    shares: Floats
    """(A, 3, 3) float64, shares of the triangle's corners in those of the piece."""
    triangle: Integers
    """(A,) int64."""
    number: Integers
    """(A,) int64, see ``Pieces``."""
    node: Integers
    """(A,) int64, the node that holds each piece; -1: it was cut, or has no plane."""
    root: Integers
    """(M,) int64, the piece that gives each node its plane."""
    plane: Floats
    """(M, 4) float64, positive before it; see `plane_of`."""
    parent: Integers
    """(M,) int64, -1 of node 0."""
    halves: Integers
    """(M, 2) int64, the nodes of the front and the back half, -1: nothing is there."""
    flat: Integers
    """(B,) int64, the triangles without area, which have no plane: they cover no pixel and are drawn first."""
    tested_at: Integers
    """(R,) int64, the node of every test, not falling."""
    tested: Integers
    """(R,) int64, the piece that was tested."""
    side: Integers
    """(R,) int64, ``ON``, ``FRONT``, ``BACK`` or ``CUT``."""
    made: Integers
    """(R, 2) int64, how many pieces a cut has made before and behind the plane, 0 where nothing was cut."""
    first_made: Integers
    """(R,) int64, the first of them, those before it; -1: none."""

    @cached_property
    def depth(self) -> Integers:
        """(M,) int64, how many nodes stand above each."""
        depth = np.zeros(len(self.root), np.int64)
        for node, parent in enumerate(self.parent.tolist()):
            if parent >= 0:
                depth[node] = depth[parent] + 1
        return depth

    @property
    def eye_in_front(self) -> Flags:
        """(M,) bool, the eye lies before each plane; where it lies in the plane either half may come first."""
        return np.asarray(-self.plane[:, 2] > 0)

    @cached_property
    def walk(self) -> Integers:
        """(M,) int64, the nodes from back to front, as the eye sees them."""
        in_front, halves, found = self.eye_in_front.tolist(), self.halves.tolist(), []
        waiting = [(0, False)] if in_front else []
        while waiting:
            node, is_opened = waiting.pop()
            if is_opened:
                found.append(node)
                continue
            front, back = halves[node]
            near, far = (front, back) if in_front[node] else (back, front)
            waiting += [(one, one == node) for one in (near, node, far) if one >= 0]
        return np.array(found, np.int64)

    @cached_property
    def drawn(self) -> Integers:
        """(Q,) int64, the pieces from the first drawn to the last; of one plane, the first triangle comes last."""
        place = np.empty(len(self.root), np.int64)
        place[self.walk] = np.arange(len(self.root))
        held = np.flatnonzero(self.node >= 0)
        in_node = np.lexsort((-self.triangle[held], place[self.node[held]]))
        return np.concatenate([self.flat, held[in_node]])


def plane_of(first: Sequence[Any], second: Sequence[Any], third: Sequence[Any]) -> tuple[Any, Any, Any, Any]:
    """Listing of the plane of three corners (x, y, z, w): ``a x + b y + c z + d w`` is 0 on it, positive before it.

    Components may be numbers or arrays (T,).
    """
    x, y, z, w = first
    x1, y1, z1, w1 = (end - start for start, end in zip(first, second, strict=True))
    x2, y2, z2, w2 = (end - start for start, end in zip(first, third, strict=True))
    xy, xz, xw = x1 * y2 - y1 * x2, x1 * z2 - z1 * x2, x1 * w2 - w1 * x2
    yz, yw, zw = y1 * z2 - z1 * y2, y1 * w2 - w1 * y2, z1 * w2 - w1 * z2
    a, b = y * zw - z * yw + w * yz, z * xw - x * zw - w * xz
    c, d = x * yw - y * xw + w * xy, y * xz - x * yz - z * xy  #: plane
    return a, b, c, d


def distance_of(corner: Sequence[float], plane: Sequence[float]) -> float:
    """Listing of how far a corner lies from a plane, positive before it; what rounding may have made counts as 0."""
    x, y, z, w = (coordinate * number for coordinate, number in zip(corner, plane, strict=True))
    size = abs(x) + abs(y) + abs(z) + abs(w)
    return 0.0 if abs(x + y + z + w) <= TOLERANCE * size else x + y + z + w  #: distance


def side_of(d: Sequence[float]) -> str:
    """Listing of where a piece lies, by the distances of its corners."""
    if d[0] == d[1] == d[2] == 0:
        return "on"  #: on
    if min(d) >= 0:
        return "front"  #: front
    if max(d) <= 0:
        return "back"  #: back
    return "cut"  #: cut


def cut_piece(corners: Sequence[Any], d: Sequence[float]) -> tuple[list[Any], list[Any]]:
    """Listing of one cut: the corners of the polygons before and behind the plane, each a fan of pieces.

    A new corner is computed from the end before the plane, so that two triangles of one edge get the same.
    """
    front, back = [], []
    for k in range(3):
        here, there = corners[k], corners[k - 2]
        d_here, d_there = d[k], d[k - 2]
        if d_here >= 0:
            front.append(here)
        if d_here <= 0:
            back.append(here)
        if min(d_here, d_there) < 0 < max(d_here, d_there):
            if d_here < 0:
                here, there, d_here, d_there = there, here, d_there, d_here
            t = d_here / (d_here - d_there)  #: t
            corner = here + t * (there - here)  #: corner
            front.append(corner)
            back.append(corner)
    return front, back


def eye_side(plane: Sequence[float]) -> str:
    """Listing of the side of the eye, the position (0, 0, -1, 0)."""
    distance = -plane[2]  #: eye
    return "front" if distance > 0 else "back"  #: side


def planes_of(clip: Floats) -> tuple[Floats, Flags]:
    """Return the planes (T, 4) of triangles (T, 3, 4), and whether each has one: all four numbers 0 is none."""
    corners = [tuple(clip[:, k].T) for k in range(3)]
    plane = np.stack(plane_of(*corners), axis=-1)
    first, *edges = clip[:, 0], *(clip[:, k] - clip[:, 0] for k in (1, 2))
    size = [np.sqrt((part**2).sum(axis=1)) for part in (first, *edges)]
    return plane, np.abs(plane).max(axis=1, initial=0) > TOLERANCE * size[0] * size[1] * size[2]


def distances(clip: Floats, plane: Floats) -> Floats:
    """Return the distances (..., 3) of the corners of pieces (..., 3, 4) from planes (..., 4)."""
    x, y, z, w = (clip[..., k] * plane[..., None, k] for k in range(4))
    distance = x + y + z + w
    size = np.abs(x) + np.abs(y) + np.abs(z) + np.abs(w)
    return np.where(np.abs(distance) <= TOLERANCE * size, 0.0, distance)


def sides(d: Floats) -> Integers:
    """Return where pieces lie by the distances (R, 3) of their corners: (R,) int64."""
    low, high = d.min(axis=1), d.max(axis=1)
    return np.where(low >= 0, np.where(high > 0, FRONT, ON), np.where(high <= 0, BACK, CUT))


class _Builder:
    """The pieces and the tests of a tree that is being built."""

    def __init__(self, clip: Floats) -> None:
        count = len(clip)
        self.count = count
        self.corners = np.concatenate([clip, np.tile(np.eye(3), (count, 1, 1))], axis=2)
        self.plane, self.has_plane = planes_of(clip)
        self.triangle, self.number = np.arange(count), np.zeros(count, np.int64)
        self.pieces_of = np.zeros(count, np.int64)
        self.held = 0
        self.tests = 0

    def add(self, corners: list[Floats], triangle: int) -> Integers:
        """Add pieces (3, 7) of a triangle and return their numbers (n,)."""
        first, end = self.count, self.count + len(corners)
        if end > len(self.triangle):
            room = max(len(self.triangle), 64)
            self.corners = np.concatenate([self.corners, np.empty((room, 3, 7))])
            self.triangle = np.concatenate([self.triangle, np.empty(room, np.int64)])
            self.number = np.concatenate([self.number, np.empty(room, np.int64)])
        for place, piece in enumerate(corners, start=first):
            self.corners[place] = piece
            self.pieces_of[triangle] += 1
            self.number[place] = self.pieces_of[triangle]
        self.triangle[first:end] = triangle
        self.count = end
        return np.arange(first, end)

    def cut(self, piece: int, d: Floats) -> tuple[Integers, Integers]:
        """Cut a piece by the distances (3,) of its corners; return the pieces before and behind the plane."""
        front, back = cut_piece(self.corners[piece], d.tolist())
        triangle = int(self.triangle[piece])
        return self.add(_fan(front), triangle), self.add(_fan(back), triangle)


def _fan(corners: list[Floats]) -> list[Floats]:
    """Return a polygon as triangles that share its first corner."""
    return [np.stack([corners[0], corners[k], corners[k + 1]]) for k in range(1, len(corners) - 1)]


def build_tree(clip: Floats) -> BspTree:
    """Build the tree of triangles (T, 3, 4) in clip space; the last few are kept.

    Raises ValueError for a tree that would have more than `LARGEST_TREE` pieces or take more than `MOST_TESTS`.
    """
    found = _kept_tree(np.ascontiguousarray(clip, np.float64).tobytes())
    if isinstance(found, str):
        raise ValueError(found)
    return found


@lru_cache(maxsize=4)
def _kept_tree(positions: bytes) -> BspTree | str:
    clip = np.frombuffer(positions).reshape(-1, 3, 4)
    if len(clip) > LARGEST_TREE:
        return _refusal(len(clip))
    builder = _Builder(clip)
    whole = np.flatnonzero(builder.has_plane)
    held_by: dict[int, int] = {}
    root: list[int] = []
    halves: list[list[int]] = []
    plane, parent, rows = [], [], []
    waiting = [(whole, -1, 0)] if len(whole) else []
    while waiting:
        pieces, above, half = waiting.pop()
        node = len(root)
        if above >= 0:
            halves[above][half] = node
        first, others = int(pieces[0]), pieces[1:]
        own = builder.plane[builder.triangle[first]]
        root.append(first)
        plane.append(own)
        parent.append(above)
        halves.append([-1, -1])
        held_by[first] = node

        # Every other piece: three distances, a side, and a cut where it crosses.
        d = distances(builder.corners[others][..., :4], own)
        side = sides(d)
        held_by |= dict.fromkeys(others[side == ON].tolist(), node)
        parts: tuple[list[Integers], list[Integers]] = ([], [])
        made, first_made = np.zeros((len(others), 2), np.int64), np.full(len(others), -1)
        for which in np.flatnonzero(side == CUT).tolist():
            first_made[which] = builder.count
            for k, new in enumerate(builder.cut(int(others[which]), d[which])):
                parts[k].append(new)
                made[which, k] = len(new)
        rows.append((np.full(len(others), node), others, side, made, first_made))
        builder.tests += len(others)
        kept = [np.concatenate([others[side == where], *parts[k]]) for k, where in enumerate((FRONT, BACK))]
        waiting += [(kept[k], node, k) for k in (1, 0) if len(kept[k])]
        in_tree = len(held_by) + sum(len(each) for each, _, _ in waiting)
        report(len(held_by) / in_tree)
        if in_tree > LARGEST_TREE or builder.tests > MOST_TESTS:
            return _refusal(len(clip))

    count = builder.count
    held = np.full(count, -1)
    held[list(held_by)] = list(held_by.values())
    none = np.empty(0, np.int64)
    tests = [np.concatenate(part) for part in zip(*rows, strict=True)] if rows else [none] * 5
    arrays = (
        builder.corners[:count, :, :4],
        builder.corners[:count, :, 4:],
        builder.triangle[:count],
        builder.number[:count],
        held,
        np.array(root, np.int64),
        np.reshape(plane, (len(root), 4)).astype(float),
        np.array(parent, np.int64),
        np.reshape(halves, (len(root), 2)).astype(np.int64),
        np.flatnonzero(~builder.has_plane),
        *(tests[k] for k in range(3)),
        tests[3].reshape(-1, 2),
        tests[4],
    )
    return BspTree(*(read_only(values) for values in arrays))


def _refusal(count: int) -> str:
    return (
        f"visibility bsp draws at most {LARGEST_TREE:,} pieces: the tree of these {count:,} triangles needs more, or "
        f"more than {MOST_TESTS:,} tests. Choose visibility z-buffer, or a scene with fewer triangles."
    )


@method(
    "visibility",
    "bsp",
    "Painter's algorithm with a BSP tree",
    source="Fuchs, Kedem and Naylor 1980; Zwicker 2016, Visibility (splitting)",
    exact_for="opaque triangles in any position, as far as from the edges of the pieces as corners are snapped",
    breaks_where="new corners are snapped to 1/256 pixel: a centre so near an edge or a cut may show the neighbour",
    needs=("triangles",),
)
def bsp(clip: Floats) -> DrawingOrder:
    """Cut the triangles (T, 3, 4) by each other's planes and draw the pieces from back to front.

    Raises ValueError for too many pieces or tests, see `build_tree`.
    """
    tree = build_tree(clip[:])
    drawn = tree.drawn
    order = tree.triangle[drawn]
    is_cut = len(tree.clip) > len(clip)
    pieces = Pieces(tree.clip[drawn], tree.shares[drawn], tree.number[drawn]) if is_cut else None
    return DrawingOrder(order, False, pieces=pieces, own_rows="core.visibility.traced_order.with_tree")
