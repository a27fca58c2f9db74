"""Mistakes in clipping lines to a rectangle."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from core import Settings
from core.geometry.line_clipping.cohen_sutherland import FIRST_EDGE, outcode
from core.geometry.line_clipping.edge_walk import clipped_lines, points_at, walk_edges
from core.geometry.line_clipping.liang_barsky import liang_barsky, on_borders
from core.geometry.line_clipping.records import ClippedLines, ClipWindow
from core.records.arrays import Floats
from lessons.mistakes.twin import Case, Twin, clipped_ends
from lessons.small_scenes import Point, segment_scene

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
