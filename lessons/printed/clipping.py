"""Line clippers as printed: Jubair's Cyrus-Beck, and LMU's Liang-Barsky with its names t_min and t_max."""

from functools import partial

import numpy as np

from core import clip_lines
from core.geometry.line_clipping.cyrus_beck import cyrus_beck_listing
from lessons.printed.records import PrintedListing, SlideNumber

CYRUS_BECK_SLIDE, LIANG_BARSKY_SLIDE = "Cyrus-Beck Algorithm (1/1)", "Liang-Barsky Algorithm"
WINDOW = (0.0, 0.0, 8.0, 6.0)
"""Left, bottom, right, top of the window of the examples."""
PARALLEL_OUTSIDE = (2.0, 8.0, 6.0, 8.0)
"""A segment above the window, parallel to its top edge."""
GRID = tuple(
    (float(x0), float(y0), float(x1), float(y1))
    for x0 in range(-3, 12, 2)
    for y0 in range(-2, 10, 3)
    for x1 in range(-2, 12, 3)
    for y1 in range(-3, 10, 2)
)
"""1,120 segments around and in the window."""


def liang_barsky_lecture(
    segment: tuple[float, float, float, float], window: tuple[float, float, float, float]
) -> tuple[float, float] | None:
    """Return t_max and t_min as LMU names them, ``None`` where the segment is outside.

    Read with step 3 in mind: t_min is the smallest t of an exit, t_max the largest of an entry.
    """
    x0, y0, x1, y1 = segment
    x_min, y_min, x_max, y_max = window
    p = (-(x1 - x0), x1 - x0, -(y1 - y0), y1 - y0)
    q = (x0 - x_min, x_max - x0, y0 - y_min, y_max - y0)
    t_min, t_max = 1.0, 0.0
    for p_i, q_i in zip(p, q, strict=True):
        if p_i == 0:
            if q_i < 0:
                return None
        elif p_i > 0:
            t_min = min(q_i / p_i, t_min)
        else:
            t_max = max(t_max, q_i / p_i)
    return (t_max, t_min) if t_max <= t_min else None


def liang_barsky_every_edge(
    segment: tuple[float, float, float, float], window: tuple[float, float, float, float]
) -> tuple[float, float] | None:
    """Return t_max and t_min where step 5 is read to the letter: every t_i counts for both."""
    x0, y0, x1, y1 = segment
    x_min, y_min, x_max, y_max = window
    p = (-(x1 - x0), x1 - x0, -(y1 - y0), y1 - y0)
    q = (x0 - x_min, x_max - x0, y0 - y_min, y_max - y0)
    if any(p_i == 0 and q_i < 0 for p_i, q_i in zip(p, q, strict=True)):
        return None
    t = [q_i / p_i for p_i, q_i in zip(p, q, strict=True) if p_i != 0]
    t_min, t_max = min((*t, 1.0)), max((0.0, *t))
    return (t_max, t_min) if t_max <= t_min else None


def parameters_as_named(segment: tuple[float, float, float, float]) -> tuple[float, float] | None:
    """Return the smaller and the larger t of what is left, found by the method ``liang-barsky``."""
    clipped = clip_lines(np.reshape(segment, (1, 2, 2)), WINDOW, "liang-barsky")
    if not clipped.is_kept[0]:
        return None
    start, along = np.array(segment[:2]), np.subtract(segment[2:], segment[:2])
    k = int(np.argmax(np.abs(along)))
    ends = clipped.segments[0]
    first, second = ((float(end[k]) - start[k]) / along[k] for end in ends)
    return float(first), float(second)


def unlike_liang_barsky(to_the_letter: bool) -> int:
    """Count the segments of ``GRID`` of which a reading keeps something where the method does not, or the reverse."""
    reading = liang_barsky_every_edge if to_the_letter else liang_barsky_lecture
    kept = clip_lines(np.reshape(GRID, (-1, 2, 2)), WINDOW, "liang-barsky").is_kept
    return sum(
        (reading(segment, WINDOW) is None) == bool(is_kept)
        for segment, is_kept in zip(GRID, kept, strict=True)
    )


def is_kept(segment: tuple[float, float, float, float], method: str) -> bool:
    """Return whether a method keeps something of a segment in the window."""
    return bool(clip_lines(np.reshape(segment, (1, 2, 2)), WINDOW, method).is_kept[0])


CYRUS_BECK = PrintedListing(
    "jubair-cyrus-beck",
    "Cyrus-Beck",
    "Jubair",
    CYRUS_BECK_SLIDE,
    """\
precalculate N_i and select a P_E_i for each edge;
for each line segment to be clipped
  if P_1 = P_0 then
    line is degenerate so clip as a point;
  else
    begin
      t_E = 0; t_L = 1;
      for each clip edge
        if Ni . D != 0 then {Ignore edges parallel to line}
          begin
            calculate t; {of line intersect clip edge}
            use sign of N_i . D to categorize as PE or PL;
            if PE then t_E = max(t_E, t);
            if PL then t_L = min(t_L, t)
          end
      if t_E > t_L then
        return nil
      else
        return P(t_E) and P(t_L) as true clip intersections
    end {else}""",
    "line_clipping",
    "cyrus-beck",
    {"as printed": partial(cyrus_beck_listing, ignores_parallel=True)},
    numbers=(
        SlideNumber(
            "Jubair",
            CYRUS_BECK_SLIDE,
            "(2, 8)-(6, 8), parallel and outside of 8 x 6: something is kept",
            True,
            partial(is_kept, PARALLEL_OUTSIDE, "cyrus-beck"),
            right=False,
        ),
        SlideNumber(
            "Jubair",
            CYRUS_BECK_SLIDE,
            "the same by the listing as printed",
            True,
            partial(is_kept, PARALLEL_OUTSIDE, "cyrus-beck-lecture"),
            is_counted=True,
        ),
    ),
    registered="cyrus-beck-lecture",
)

LIANG_BARSKY = PrintedListing(
    "lmu-liang-barsky",
    "Liang-Barsky, t_min and t_max",
    "LMU",
    LIANG_BARSKY_SLIDE,
    """\
1. Parallel to viewport edge => p_i = 0
2. iq_i < 0 => outside
3. p_i < 0 => outside to inside, p_i > 0 inside to outside
4. t_i = q_i/p_i are intersection points (with boundaries or boundary extensions)
5. t_min = min(t_i, 1), t_max = max(0, t_i). Line intersect with viewport if and only if t_max <= t_min""",
    "line_clipping",
    "liang-barsky",
    {
        "exits for t_min, entries for t_max": liang_barsky_lecture,
        "every t_i for both": liang_barsky_every_edge,
    },
    "iq_i is read as q_i, of an edge with p_i = 0. Step 5 does not say which t_i: run with both.",
    numbers=(
        SlideNumber(
            "LMU",
            LIANG_BARSKY_SLIDE,
            "(-2, 1)-(6, 5): t_min, t_max as named; ours: smaller, larger t",
            (1.0, 0.25),
            partial(parameters_as_named, (-2.0, 1.0, 6.0, 5.0)),
            right=(0.25, 1.0),
        ),
        SlideNumber(
            "LMU",
            LIANG_BARSKY_SLIDE,
            "exits and entries apart: segments of 1,120 judged otherwise",
            0,
            partial(unlike_liang_barsky, False),
            is_counted=True,
        ),
        SlideNumber(
            "LMU",
            LIANG_BARSKY_SLIDE,
            "every t_i for both: segments of 1,120 judged otherwise",
            828,
            partial(unlike_liang_barsky, True),
            is_counted=True,
        ),
    ),
)
