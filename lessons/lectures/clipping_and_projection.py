"""Clippers and a projection as printed: Jubair's Cyrus-Beck, LMU's Liang-Barsky and perspective projection."""

from functools import partial
from math import pi, tan

import numpy as np

from core import clip_lines
from core.lines.parametric_clipping import cyrus_beck_listing
from core.records.arrays import Floats
from core.scene import Camera
from core.transform.matrices import projection
from lessons.lectures.printed import PrintedListing, SlideNumber

# Line clippers as printed: Jubair's Cyrus-Beck, and LMU's Liang-Barsky with its names t_min and t_max.


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


# LMU's perspective projection: w is negative in front of the eye, and near lies at +1.


SLIDE = "Task 1 d) Z-fighting: Case 2 - Close to far plane"
ANGLE, ASPECT, NEAR, FAR = pi / 3, 4 / 3, -1.0, -10.0
"""Opening angle, width over height, and the planes as z, negative as on the slide."""


def printed_projection(theta: float, aspect: float, n: float, f: float) -> Floats:
    """Return the (4, 4) matrix of the slide, 0 > n > f; ``theta`` in radians, ``aspect`` is its lambda."""
    return np.array(
        [
            [-1 / (aspect * tan(theta / 2)), 0, 0, 0],
            [0, -1 / tan(theta / 2), 0, 0],
            [0, 0, (n + f) / (n - f), 2 * n * f / (f - n)],
            [0, 0, 1, 0],
        ]
    )


def divided(matrix: Floats, point: tuple[float, float, float]) -> tuple[float, float, float]:
    """Return x/w, y/w and z/w of a transformed point."""
    x, y, z, w = (matrix @ np.array([*point, 1.0])).tolist()
    return x / w, y / w, z / w


def as_printed(point: tuple[float, float, float]) -> tuple[float, float, float]:
    """Return a point of camera space by the slide's matrix, divided."""
    return divided(printed_projection(ANGLE, ASPECT, NEAR, FAR), point)


def ours(point: tuple[float, float, float]) -> tuple[float, float, float]:
    """Return the same point by the program's matrix, divided."""
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]), field_of_view=ANGLE, near=-NEAR, far=-FAR)
    return divided(projection(camera, ASPECT), point)


def printed_w(z: float) -> float:
    """Return the w of a point at z by the slide's matrix."""
    return float((printed_projection(ANGLE, ASPECT, NEAR, FAR) @ [0.0, 0.0, z, 1.0])[3])


def depth_of(z: float) -> float:
    """Return the program's z/w of a point at z."""
    return ours((0.0, 0.0, z))[2]


def printed_depth_of(z: float) -> float:
    """Return the slide's z_perp of a point at z."""
    return as_printed((0.0, 0.0, z))[2]


def places_differ() -> float:
    """Return by how much x/w and y/w of the two matrices differ at most, at three points."""
    points = ((0.3, -0.2, -1.5), (1.0, 2.0, -4.0), (-3.0, 0.5, -9.0))
    return max(float(np.abs(np.subtract(as_printed(p)[:2], ours(p)[:2])).max()) for p in points)


def _row(what: str, number: float, compute: partial[float], right: float | None = None) -> SlideNumber:
    return SlideNumber("LMU", SLIDE, what, number, compute, right)


PROJECTION = PrintedListing(
    "lmu-projection",
    "Perspective projection matrix",
    "LMU",
    SLIDE,
    """\
T_persp = [ -1/(lambda tan(theta/2))          0            0           0
                     0               -1/tan(theta/2)       0           0
                     0                        0       (n+f)/(n-f)  2nf/(f-n)
                     0                        0            1           0 ]
z_perp = 2nf/(f-n) 1/z + (n+f)/(n-f) in [-1, 1], 0 > n >= z >= f""",
    "",
    "",
    {"as printed": printed_projection},
    "The step before last has (n+f)/(n-f) z + 2nf/(f-n) 1/z; the z is too much, as the last line shows.",
    numbers=(
        _row("z_perp at the near plane, n = -1, f = -10", 1.0, partial(printed_depth_of, NEAR)),
        _row("z_perp at the far plane", -1.0, partial(printed_depth_of, FAR)),
        _row("near at +1; ours has it at", 1.0, partial(depth_of, NEAR), -1.0),
        _row("far at -1; ours has it at", -1.0, partial(depth_of, FAR), 1.0),
        _row("w of a point in front of the eye, z = -4", -4.0, partial(printed_w, -4.0)),
        _row("x/w and y/w: largest difference from ours", 0.0, partial(places_differ)),
    ),
)
