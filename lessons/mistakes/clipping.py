"""Mistakes in clipping lines and polygons, in culling and in binning: faulty runs, and wrong formulas."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np

from core import Settings
from core.antialiasing.pixel_pieces import Polygon, cut_polygon, polygon_area
from core.coverage.binning import block_verdict
from core.culling.culling import plane_distances
from core.lines.cohen_sutherland import FIRST_EDGE, outcode
from core.lines.line_clipping import ClippedLines, ClipWindow, clipped_lines, points_at, walk_edges
from core.lines.parametric_clipping import liang_barsky, on_borders
from core.records.arrays import Floats
from lessons.mistakes.transforms import Vector, dot
from lessons.mistakes.twin import Case, Twin, clipped_ends, wrong_rule
from lessons.small_scenes import Point, segment_scene

# Mistakes in clipping lines to a rectangle.


Clipper = Callable[[Floats, ClipWindow], ClippedLines]
SIZE = (8, 6)


def walked(
    change: Callable[[Floats, Floats], tuple[Floats, Floats]], segments: Floats, window: ClipWindow
) -> ClippedLines:
    """Clip as Liang-Barsky does, with p and q (4, L) of every edge changed before."""
    rows = liang_barsky_rows(segments, window)
    walk = walk_edges(*change(*rows), stops_early=False)
    return clipped_lines(segments, window, walk, on_borders(points_at(segments, walk), walk.cut_by, window))


def liang_barsky_rows(segments: Floats, window: ClipWindow) -> tuple[Floats, Floats]:
    """Return p and q (4, L) of segments (L, 2, 2) at the left, right, bottom and top edge."""
    along, start = segments[:, 1] - segments[:, 0], segments[:, 0]
    p = window.normals @ along.T
    q = np.stack(
        [normal @ (point - start).T for normal, point in zip(window.normals, window.points, strict=True)]
    )
    return p, q


def parallel_kept(p: Floats, q: Floats) -> tuple[Floats, Floats]:
    """Forget to look at q where p = 0."""
    return p, np.where(p == 0, np.maximum(q, 0), q)


def inward(p: Floats, q: Floats) -> tuple[Floats, Floats]:
    """Turn the normals round."""
    return -p, -q


def sides_exchanged(segments: Floats, window: ClipWindow) -> ClippedLines:
    """Take entries for exits; p, q and t are right."""
    p, q = liang_barsky_rows(segments, window)
    walk = replace(walk_edges(-p, -q, stops_early=False), along=p, room=q)
    return clipped_lines(segments, window, walk, on_borders(points_at(segments, walk), walk.cut_by, window))


def top_and_bottom(p: Floats, q: Floats) -> tuple[Floats, Floats]:
    """Exchange the q of the bottom and the top edge."""
    return p, q[[0, 1, 3, 2]]


def ends_clamped(segments: Floats, window: ClipWindow) -> ClippedLines:
    """Move ends that are outside to the nearest point of the window."""
    left, bottom, right, top = window.borders
    return _changed(segments, window, np.clip(segments, (left, bottom), (right, top)))


def crossings_rounded(segments: Floats, window: ClipWindow) -> ClippedLines:
    """Round new ends to whole numbers, half up."""
    right = liang_barsky(segments, window)
    is_cut = (right.cut_by >= 0)[..., None]
    return _changed(segments, window, np.where(is_cut, np.floor(right.segments + 0.5), right.segments))


def cut_once(segments: Floats, window: ClipWindow) -> ClippedLines:
    """Move each end once, to the first edge that its outcode names, and forget to look again."""
    p, q = liang_barsky_rows(segments, window)
    ends = segments.copy()
    for end in range(2):
        edge = FIRST_EDGE[outcode(segments[:, end], window)]
        for index in np.flatnonzero(edge >= 0):
            t = q[edge[index], index] / p[edge[index], index]
            ends[index, end] = segments[index, 0] + t * (segments[index, 1] - segments[index, 0])
    return _changed(segments, window, ends)


def _changed(segments: Floats, window: ClipWindow, ends: Floats) -> ClippedLines:
    """Return the record of a clipper that leaves other ``ends`` of the segments that are to be kept."""
    right = liang_barsky(segments, window)
    kept = np.where(right.is_kept[:, None, None], ends, np.nan)
    return ClippedLines(kept, right.is_kept, right.cut_by, window, lambda: right.rows)


def with_clipper(clipper: Clipper) -> Callable[[Settings], Settings]:
    """Return what replaces the line clipping of settings."""
    return lambda settings: settings.replaced(line_clipping=clipper)


def segment(start: Point, end: Point) -> Case:
    """Return one segment in the window 0..8 x 0..6, of which the ends are compared."""
    return Case(segment_scene([(start, end)], SIZE), Settings(line_clipping="liang-barsky"), clipped_ends)


ACROSS = segment((-1, -2), (9, 7))
"""Enters through the left and the bottom edge, leaves through the right and the top edge."""

TWINS = (
    Twin(
        "parallel-kept",
        "The edge that the segment is parallel to was ignored: where p = 0, q < 0 rejects the segment.",
        segment((2, 8), (6, 8)),
        ACROSS,
        change_settings=with_clipper(partial(walked, parallel_kept)),
    ),
    Twin(
        "normals-inward",
        "The normals point inward, but the signs are those of outward ones: entering and leaving are exchanged.",
        segment((2, 1), (6, 5)),
        segment((-3, 1), (-1, 5)),
        change_settings=with_clipper(partial(walked, inward)),
    ),
    Twin(
        "entries-and-exits",
        "PE and PL are exchanged: p < 0 enters, p > 0 leaves.",
        segment((2, 1), (6, 5)),
        segment((-3, 1), (-1, 5)),
        change_settings=with_clipper(sides_exchanged),
    ),
    Twin(
        "top-and-bottom",
        "The q of the bottom and the top edge are exchanged: q = y0 - bottom, and q = top - y0.",
        ACROSS,
        segment((1, 3), (7, 3)),
        change_settings=with_clipper(partial(walked, top_and_bottom)),
    ),
    Twin(
        "ends-clamped",
        "Ends outside were moved to the nearest border, which turns the line. They belong on the line.",
        ACROSS,
        segment((-2, 3), (9, 3)),
        change_settings=with_clipper(ends_clamped),
    ),
    Twin(
        "crossings-rounded",
        "The crossings were rounded to whole numbers, which turns the line. They keep their fractions.",
        ACROSS,
        segment((-4, 1), (4, 5)),
        change_settings=with_clipper(crossings_rounded),
    ),
    Twin(
        "cut-once",
        "The outcode was not computed again after the first cut, so the new end is still outside.",
        ACROSS,
        segment((-4, 1), (4, 5)),
        change_settings=with_clipper(cut_once),
    ),
)


# Mistakes in clipping polygons, in culling and in binning, as wrong formulas.


Edge = tuple[float, float, float, bool]
"""a, b and c of an edge function, and whether the edge owns the centres on it."""
Face = tuple[Vector, Vector]
"""Outward normal and a point of a face."""


def planes_outside(clip: Vector) -> frozenset[int]:
    """Return the planes of the view volume that a clip position lies outside of."""
    distances = plane_distances(np.array(clip, float))
    return frozenset(np.flatnonzero(distances < 0).tolist())


def at_crossing(near: Any, far: Any, t: Any) -> Vector:
    """Return an attribute at t on the way from one end to another."""
    return (near + t * (far - near),)


def triangles_after_clipping(inside: int) -> Vector:
    """Return how many triangles one plane leaves of a triangle of which so many vertices are inside."""
    return (Fraction((0, 1, 2, 1)[inside]),)


def new_corners(corners: Sequence[Vector], border: int) -> tuple[Vector, Vector]:
    """Return where the two sides at corner 0 cross x = ``border``: to corner 1, and from corner 2."""
    return cut_at(corners[0], corners[1], border), cut_at(corners[0], corners[2], border)


def cut_at(start: Vector, end: Vector, border: int) -> Vector:
    """Return where a side crosses x = ``border``."""
    t = Fraction(border - start[0], end[0] - start[0])
    return tuple(a + t * (b - a) for a, b in zip(start, end, strict=True))


def area_in_window(polygon: Polygon, window: Polygon) -> Vector:
    """Return the area that Sutherland-Hodgman leaves of a polygon in a convex, counter-clockwise window."""
    for (x0, y0), (x1, y1) in pairwise([*window, window[0]]):
        a, b = y0 - y1, x1 - x0
        polygon = cut_polygon(polygon, a, b, -(a * x0 + b * y0))
    return (polygon_area(polygon) if polygon else 0.0,)


def culled_faces(faces: Sequence[Face], eye: Vector) -> frozenset[int]:
    """Return the faces that face away from the eye: N . (point - eye) > 0."""
    rays = [tuple(p - e for p, e in zip(point, eye, strict=True)) for _, point in faces]
    return frozenset(
        k for k, ((normal, _), ray) in enumerate(zip(faces, rays, strict=True)) if dot(normal, ray) > 0
    )


def rejected_blocks(edges: Sequence[Edge], blocks: int, size: int) -> frozenset[tuple[int, int]]:
    """Return the blocks of size x size pixels, out of blocks x blocks, that one edge has wholly outside."""
    last = size - 0.5
    return frozenset(
        (i, j)
        for j in range(blocks)
        for i in range(blocks)
        if block_verdict(list(edges), i * size + 0.5, j * size + 0.5, i * size + last, j * size + last)
        == "outside"
    )


def owned_edges(corners: Sequence[Vector]) -> frozenset[int]:
    """Return the edges of a counter-clockwise triangle that own their centres: left ones, level bottom ones."""
    edges = enumerate(zip(corners, [*corners[1:], corners[0]], strict=True))
    return frozenset(k for k, ((x0, y0), (x1, y1)) in edges if y0 > y1 or (y0 == y1 and x1 > x0))


def doubled_area(width: int, height: int) -> Vector:
    """Return twice the area of a right triangle in units of 1/256 x 1/256 pixel."""
    return (Fraction(256 * width * 256 * height),)


SQUARE: Polygon = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
SLANTED: list[Edge] = [(1.0, 1.0, -8.0, True)]


@wrong_rule(planes_outside, shows=((1, 1, Fraction(-14, 3), -2),), hides=((1, 3, 1, 2),))
def planes_after_divide(clip: Vector) -> frozenset[int]:
    """The planes were tested after the divide. Compare x, y and z with -w and w while w still has its sign."""
    return planes_outside((*(c / clip[3] for c in clip[:3]), 1))


@wrong_rule(
    at_crossing,
    shows=(Fraction(0), Fraction(1), Fraction(1, 2)),
    hides=(Fraction(1), Fraction(1), Fraction(1, 2)),
)
def attribute_copied(near: Any, far: Any, t: Any) -> Vector:
    """The new vertex has the attribute of the end that was cut off. Interpolate it with t, as the position."""
    return (far,)


@wrong_rule(triangles_after_clipping, shows=(2,), hides=(1,))
def quad_as_triangle(inside: int) -> Vector:
    """Two vertices inside leave a quad, which is two triangles."""
    return (Fraction(min(inside, 1)),)


@wrong_rule(new_corners, shows=(((2, 2), (12, 2), (12, 8)), 8), hides=(((2, 2), (12, 2), (8, 8)), 8))
def clipped_in_place(corners: Sequence[Vector], border: int) -> tuple[Vector, Vector]:
    """The first new corner replaced the vertex that the second one starts from.

    Keep the old vertices until all crossings are found.
    """
    (x, _), end = corners[0], corners[2]
    moved = cut_at(corners[0], corners[1], border)
    t = Fraction(border - x, end[0] - x)
    return moved, tuple(a + t * (b - a) for a, b in zip(moved, end, strict=True))


@wrong_rule(
    area_in_window,
    shows=([(1.0, 1.0), (3.0, 1.0), (2.0, 3.0)], SQUARE),
    hides=([(5.0, 5.0), (7.0, 5.0), (6.0, 7.0)], SQUARE),
)
def window_clockwise(polygon: Polygon, window: Polygon) -> Vector:
    """The window was followed clockwise, so its outside was kept. Inside is on the left of counter-clockwise edges."""
    return area_in_window(polygon, window[::-1])


@wrong_rule(
    culled_faces,
    shows=([((1, 0, Fraction(-1, 4)), (-9, 0, -10))], (0, 0, 0)),
    hides=([((0, 0, -1), (0, 0, -10))], (0, 0, 0)),
)
def view_direction_fixed(faces: Sequence[Face], eye: Vector) -> frozenset[int]:
    """Normals were compared with one view direction. With perspective it is that from the eye to the face."""
    return frozenset(k for k, (normal, _) in enumerate(faces) if normal[2] < 0)


@wrong_rule(rejected_blocks, shows=(SLANTED, 3, 4), hides=([(-1.0, -1.0, 8.0, True)], 3, 4))
def block_by_one_corner(edges: Sequence[Edge], blocks: int, size: int) -> frozenset[tuple[int, int]]:
    """Blocks were rejected by their lower left pixel. The pixel where E is largest decides."""
    return frozenset(
        (i, j)
        for j in range(blocks)
        for i in range(blocks)
        if any(a * (i * size + 0.5) + b * (j * size + 0.5) + c < 0 for a, b, c, _ in edges)
    )


@wrong_rule(owned_edges, shows=(((1, 1), (9, 5), (3, 9)),), hides=(((1, 1), (9, 1), (8, 5)),))
def leftmost_vertex(corners: Sequence[Vector]) -> frozenset[int]:
    """The edges at the leftmost vertex were taken for left edges. An edge is left if the inside is on its right."""
    leftmost = min(range(len(corners)), key=lambda k: corners[k][0])
    return frozenset({leftmost, (leftmost - 1) % len(corners)})


@wrong_rule(doubled_area, shows=(200, 200), hides=(20, 20))
def product_overflows(width: int, height: int) -> Vector:
    """The product does not fit into 32 bits with a sign: from 2^31 on it turns over."""
    return (Fraction(int(np.array(256 * width * 256 * height, np.int64).astype(np.int32))),)
