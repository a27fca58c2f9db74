"""Line clipping measured: what is left of segments, and of those parallel to a border, without length, at corners."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import partial

import numpy as np

from core.lines.drawing import draw_lines
from core.lines.line_clipping import CUT, ClippedLines, OutcodeRows, clip_lines
from core.lines.measured import Ends, clipped_ends
from core.records.arrays import Flags, Floats, cached_property
from core.scene import ClipScene
from core.settings import Settings
from core.study.experiment import SEGMENTS, Case, Experiment, first_edge, scene_of_segment
from core.study.family import Assignment, StudyFamily, Task
from core.study.frame_task import per_million, scalar_pictures
from core.study.record import (
    Axis,
    ErrorMeasure,
    Judgement,
    Opening,
    Outcome,
    Pictures,
    Verdict,
    WorkKind,
    judged,
)
from core.study.workloads import on_grid, outline_scene

# Study of line clipping: what is left of segments in a rectangle, against rational arithmetic.


SIZE = (64, 48)
WINDOW = (0.0, 0.0, 64.0, 48.0)
GRID_STEPS = 4.0
"""Steps of the grid of ties in one pixel."""
PROMISED = 4.0
"""Units in the last place that the ends of a clipped segment may be off."""

LARGEST = ErrorMeasure("largest-ulp", "Largest error of an end", "ulp")
MEAN = ErrorMeasure("mean-ulp", "Mean error of the ends", "ulp")
DECISIONS = ErrorMeasure("decisions", "Segments wrongly kept or dropped", "per million")

COUNTS = Axis("count", "Segments", "", (3, 10, 30, 100, 300, 1000, 3000), default=300, is_cost=True)
WORKS = (
    WorkKind("around", "Random segments in and around the window", "line", (COUNTS,)),
    WorkKind("corners", "Segments past the corners of the window", "line", (COUNTS,)),
    WorkKind("ties", "Segments on a grid: along borders, through corners, of no length", "line", (COUNTS,)),
)


def random_segments(work: str, count: int, seed: int) -> Floats:
    """Return segments (L, 2, 2) float64 in and around `WINDOW`."""
    generator = np.random.default_rng(seed)
    size = np.array(SIZE)
    ends = generator.uniform(-0.5 * size, 1.5 * size, (count, 2, 2))
    if work == "corners":
        # The second end lies on the far side of a corner, as far from it as the first.
        corner = size * generator.integers(0, 2, (count, 2))
        ends[:, 1] = 2 * corner - ends[:, 0]
    elif work == "ties":
        step = size / GRID_STEPS
        ends = np.rint(generator.uniform(-1, GRID_STEPS + 1, (count, 2, 2))) * step
    return ends


class LineClippingTask(Task):
    """Segments that every method clips to the same rectangle."""

    def __init__(self, assignment: Assignment) -> None:
        self.unit_count = int(assignment.dials["count"])
        self.segments = random_segments(assignment.work, self.unit_count, assignment.seed)

    def start(self, settings: Settings) -> Callable[[], ClippedLines]:
        """Prepare one clipping of all segments."""
        return partial(clip_lines, self.segments, WINDOW, settings.line_clipping)

    @cached_property
    def reference(self) -> tuple[Floats, Flags]:
        """The ends (L, 2, 2) float64 nearest to the exact ones, NaN for none, and (L,) bool where something is left."""
        ends = np.full(self.segments.shape, np.nan)
        for number, segment in enumerate(self.segments):
            left = clipped_ends(segment, WINDOW)
            if left is not None:
                ends[number] = [[float(value) for value in end] for end in left]
        return ends, ~np.isnan(ends[:, 0, 0])

    def counts(self, settings: Settings, made: ClippedLines) -> dict[str, int]:
        """Return segments that are left, and how often an edge was looked at and a crossing divided for.

        Notes
        -----
        An outcode looks at the four edges, and every pass of Cohen-Sutherland finds that of both ends.
        """
        rows, tested, crossings = made.rows, 0, 0
        if isinstance(rows, OutcodeRows):
            tested, crossings = 8 * len(rows.segment), int(np.count_nonzero(rows.case == CUT))
        elif rows is not None:
            tested = int(np.count_nonzero(rows.edge >= 0))
            crossings = int(np.count_nonzero((rows.edge >= 0) & ~np.isnan(rows.t)))
        kept = int(np.count_nonzero(made.is_kept))
        return {
            "segments kept": kept,
            "edges tested": tested,
            "crossings found": crossings,
            "bytes": made.segments.nbytes,
        }

    def judge(self, settings: Settings, made: ClippedLines) -> Judgement:
        """Compare with the exact ends and decisions."""
        _, is_left = self.reference
        error = self._ulps(made)
        decisions = int(np.count_nonzero(made.is_kept != is_left))
        errors: dict[str, float | str] = dict.fromkeys(
            (LARGEST.name, MEAN.name), "No segment is left in the window."
        )
        if len(error):
            errors = {LARGEST.name: float(error.max()), MEAN.name: float(error.mean())}
        errors[DECISIONS.name] = per_million(decisions, len(is_left))
        return judged(errors, tolerance=PROMISED)

    def _ulps(self, made: ClippedLines) -> Floats:
        """Return the error (K,) of the worse end of rightly kept segments, in ulp of their largest coordinate."""
        ends, is_left = self.reference
        both = made.is_kept & is_left
        largest = np.maximum(np.abs(self.segments[both]).max(axis=(1, 2), initial=0), max(WINDOW))
        error: Floats = np.abs(made.segments[both] - ends[both]).max(axis=(1, 2), initial=0) / np.spacing(
            largest
        )
        return error

    def pictures(self, settings: Settings, made: ClippedLines) -> Pictures:
        """Return how often every pixel is drawn."""
        ends, is_left = self.reference
        return scalar_pictures(_drawn(made.segments[made.is_kept]), _drawn(ends[is_left]))

    def opening(self, settings: Settings, made: ClippedLines) -> Opening | None:
        """Return the segment with the worst end or a wrong decision, as the first edge of a triangle's outline."""
        _, is_left = self.reference
        wrong = np.flatnonzero(made.is_kept != is_left)
        both = np.flatnonzero(made.is_kept & is_left)
        if not len(wrong) and not len(both):
            return None
        worst = int(wrong[0]) if len(wrong) else int(both[np.argmax(self._ulps(made))])
        outlined = replace(settings, polygon_mode="wireframe", cull="none", clipping="homogeneous")
        return Opening(outline_scene(self.segments[worst], SIZE), outlined, "raster")


def _drawn(segments: Floats) -> Floats:
    """Return how often segments (K, 2, 2) draw every pixel of the window and as much around it, (2H, 2W) float64."""
    width, height = 2 * SIZE[0], 2 * SIZE[1]
    column, row = draw_lines(segments + np.array(SIZE) / 2, width, height, last_pixel=True).pixels.T
    sums = np.bincount(row * width + column, minlength=width * height)
    return sums.reshape(height, width).astype(np.float64)


LINE_CLIPPING = StudyFamily(
    "line_clipping", "Line clipping", ("line_clipping",), WORKS, (LARGEST, MEAN, DECISIONS), LineClippingTask
)


# Line clippers on segments that are parallel to a border, have no length, or pass a corner: all within a
# few ulp.


SIDE = 64
ULP = 2.0**-46
"""Unit in the last place of coordinates at the right and upper border; exact in clip space too."""
CLIPPERS = (
    "line_clipping=cyrus-beck-lecture",
    "line_clipping=cohen-sutherland",
    "line_clipping=liang-barsky",
    "line_clipping=cyrus-beck",
    "line_clipping=exact",
)
WIREFRAME = Settings(polygon_mode="wireframe", coverage="exact")
"""Outlines of triangles however thin: snapped, those of a few ulp would be culled."""


class ClippedSegmentCase(Case):
    """One segment and the raster's border; wrong is a segment that is lost or kept, or ends in the wrong place."""

    scene: ClipScene

    def __init__(self, scene: ClipScene) -> None:
        super().__init__(scene)
        self.segment = first_edge(scene)

    def start(self, settings: Settings) -> Callable[[], ClippedLines]:
        """Prepare the clipping to the raster."""
        return partial(clip_lines, self.segment[None], (0, 0, *self.scene.size), settings.line_clipping)

    def judge(self, settings: Settings, made: ClippedLines) -> Judgement:
        """Compare with rational arithmetic; it is about no pixel, but about the ends."""
        return Judgement(judge_clip(self.segment, made, self.scene.size))

    def test_body(self, settings: Settings) -> str:
        """Return the statements of a test: what is left of the segment."""
        segment, window = self.segment, (0, 0, *self.scene.size)
        wanted = clipped_ends(segment, (0.0, 0.0, *self.scene.size))
        call = f'clip_lines([segment], {window}, "{settings.line_clipping}")'
        clipping = f"segment = {segment.tolist()}\nclipped = {call}"
        if wanted is None:
            return f"{clipping}\nassert not clipped.is_kept[0]"
        tolerance = PROMISED * float(np.spacing(np.abs(segment).max()))
        return (
            f"{clipping}\nassert clipped.is_kept[0]\nwanted = {_ends(wanted)}\n"
            f"np.testing.assert_allclose(clipped.segments[0], wanted, rtol=0, atol={tolerance})"
        )

    def opening(self, settings: Settings, made: ClippedLines) -> Opening | None:
        """Return the segment as an edge of an outlined triangle; ``None`` for a segment without length."""
        has_length = bool((self.segment[0] != self.segment[1]).any())
        return super().opening(settings, made) if has_length else None


def judge_clip(segment: Floats, clipped: ClippedLines, size: tuple[int, int] = (SIDE, SIDE)) -> Verdict:
    """Compare what is left of a segment (2, 2) in the raster with rational arithmetic; severity is in ulp."""
    wanted = clipped_ends(segment, (0.0, 0.0, float(size[0]), float(size[1])))
    if wanted is None:
        if not clipped.is_kept[0]:
            return Verdict(Outcome.RIGHT, 0.0, "the segment lies outside, and is dropped")
        kept = stretch_text(clipped.segments[0].tolist())
        return Verdict(Outcome.DOUBLE_HIT, 1.0, f"the segment is kept {kept}, but lies outside")
    if not clipped.is_kept[0]:
        inside = stretch_text(_ends(wanted))
        return Verdict(Outcome.HOLE, 1.0, f"the segment is dropped, but lies inside {inside}")
    found = clipped.segments[0]
    if not np.isfinite(found).all():
        return Verdict(Outcome.NOT_A_NUMBER, np.nan, f"the segment is kept {stretch_text(found.tolist())}")
    error = ulps_off(found, wanted, float(np.spacing(np.abs(segment).max())))
    remark = f"the ends are {error:.3g} ulp off"
    return Verdict(Outcome.RIGHT if error <= PROMISED else Outcome.WRONG_PICTURE, error, remark)


def ulps_off(found: Floats, wanted: Ends, ulp: float) -> float:
    """Return the largest distance along an axis between ends (2, 2) and the right ones, in ``ulp``."""
    return max(
        float(abs(Fraction(float(value)) - right)) / ulp
        for end, right_end in zip(found, wanted, strict=True)
        for value, right in zip(end, right_end, strict=True)
    )


def _ends(ends: Ends) -> list[list[float]]:
    """Return exact ends rounded to float64."""
    return [[float(value) for value in end] for end in ends]


def stretch_text(ends: list[list[float]]) -> str:
    """Return in words where a stretch begins and ends: ``from (-9, 64) to (80, 64)``; ``at (64, 64)`` if it is short.

    Notes
    -----
    Four digits are read, ulps are not: ends that read the same are written as one place.
    """
    first, second = ("(" + ", ".join(f"{value:.4g}" for value in end) + ")" for end in ends)
    return f"at {first}" if first == second else f"from {first} to {second}"


def along_the_border(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a long segment at the upper border; both ends are given by how many ulp they lie above it."""
    first, second = place
    ends = np.array([[-9.0, SIDE + first * ULP], [80.0, SIDE + second * ULP]])
    return scene_of_segment(ends, (SIDE, SIDE))


def beside_the_corner(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a segment of a few ulp, or a point, that begins 2 ulp right of the right border and 2 below the top."""
    start = np.array([SIDE + 2 * ULP, SIDE - 2 * ULP])
    return scene_of_segment(np.array([start, start + np.array(place) * ULP]), (SIDE, SIDE))


def past_the_corner(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a falling segment that passes the upper right corner ``offset`` ulp above it, ends to a whole ulp."""
    offset, slope = place
    corner = np.array([SIDE, SIDE + offset * ULP])
    ends = [corner + 24.1 * np.array([-1.0, slope]), corner + 16.7 * np.array([1.0, -slope])]
    return scene_of_segment(on_grid(np.array(ends), round(1 / ULP)), (SIDE, SIDE))


CLIPPED_SEGMENTS = ClippedSegmentCase, WIREFRAME, SEGMENTS
STEPS = tuple(map(float, range(-6, 7)))
PARALLEL = Experiment(
    "parallel-segments",
    "Segments along a border",
    "A segment lies along the upper border, its ends a few ulp above or below. Which part of it is kept?",
    (
        Axis("first", "First end above the border", "ulp", STEPS),
        Axis("second", "Second end above the border", "ulp", STEPS),
    ),
    CLIPPERS,
    "Cyrus-Beck as printed keeps segments that are parallel to a border and outside it. The other methods "
    "drop them.",
    along_the_border,
    *CLIPPED_SEGMENTS,
)
SHORT = Experiment(
    "zero-length-segments",
    "Segments of zero length, or of a few ulp",
    "A segment of zero length, or of a few ulp, begins just right of the window. Is it dropped where it lies "
    "outside?",
    (Axis("across", "Reach to the right", "ulp", STEPS), Axis("up", "Reach upwards", "ulp", STEPS)),
    CLIPPERS,
    "Cyrus-Beck as printed keeps vertical segments outside, however short. All methods drop a point outside, "
    "and keep segments that reach the inside.",
    beside_the_corner,
    *CLIPPED_SEGMENTS,
)
CORNER = Experiment(
    "segments-past-a-corner",
    "Segments past a corner",
    "A segment passes the corner of the window within a few ulp. Does it touch the window?",
    (
        Axis("offset", "Above the corner", "ulp", STEPS),
        Axis("slope", "Fall of the segment", "", tuple((np.arange(4, 68, 5) / 32).tolist())),
    ),
    CLIPPERS,
    "Every clipper that rounds its crossings errs within a few ulp of a corner. Exact signs never err.",
    past_the_corner,
    *CLIPPED_SEGMENTS,
)
EXPERIMENTS = (PARALLEL, SHORT, CORNER)
