"""Study of line clipping: what is left of segments in a rectangle, against rational arithmetic."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from core.geometry.line_clipping.clipping import clip_lines
from core.geometry.line_clipping.records import CUT, ClippedLines, OutcodeRows
from core.raster.lines.drawing import draw_lines
from core.records.arrays import Flags, Floats
from core.records.cached import cached_property
from core.settings import Settings
from core.study.accuracy.family import Assignment, StudyFamily, Task
from core.study.accuracy.frame_task import per_million, scalar_pictures
from core.study.accuracy.record import Axis, ErrorMeasure, Judgement, Opening, Pictures, WorkKind, judged
from core.study.accuracy.workloads import outline_scene
from core.study.exact.lines import clipped_ends

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
