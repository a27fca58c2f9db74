"""Study of lines: how far the pixels lie from the ideal line, and how well they fill its area."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from core.raster.lines.drawing import draw_lines
from core.raster.lines.records import LinePixels
from core.records.arrays import Floats, Integers
from core.records.cached import cached_property
from core.settings import Settings
from core.study.accuracy.counted_listings import count_line_operations
from core.study.accuracy.family import Assignment, StudyFamily, Task
from core.study.accuracy.frame_task import per_million, scalar_pictures
from core.study.accuracy.record import Axis, ErrorMeasure, Judgement, Opening, Pictures, WorkKind, judged
from core.study.accuracy.workloads import outline_scene, random_lines
from core.study.exact.lines import distance_from_line, line_areas

COUNT = 100
COUNTED_LINES = 8
"""Lines whose operations are counted one by one; the others are like them."""
SLACK = 1e-9
"""Half a pixel and this is still half a pixel: what one division rounds."""

MEAN = ErrorMeasure("mean-distance", "Mean distance from the ideal line", "pixels")
LARGEST = ErrorMeasure("largest-distance", "Largest distance from the ideal line", "pixels")
NOT_NEAREST = ErrorMeasure("not-nearest", "Steps that do not take the nearest pixel", "per million")
AREA = ErrorMeasure("area", "Mean error of the covered area", "pixels")

LENGTHS = Axis(
    "length",
    "Length of the lines",
    "pixels",
    (4, 8, 16, 32, 64, 128, 256, 512, 1000),
    default=64,
    is_cost=True,
)
WORKS = (
    WorkKind("any-ends", "Random lines, ends anywhere", "line", (LENGTHS,)),
    WorkKind("pixel-ends", "Random lines between pixel centres", "line", (LENGTHS,)),
)


class LineTask(Task):
    """Segments that every method draws."""

    def __init__(self, assignment: Assignment) -> None:
        length = assignment.dials["length"]
        side = 256 if length < 250 else 1024
        self.size = (side, side)
        self.unit_count = COUNT
        is_on_centers = assignment.work == "pixel-ends"
        self.segments = random_lines(self.size, COUNT, length, assignment.seed, is_on_centers)

    def start(self, settings: Settings) -> Callable[[], LinePixels]:
        """Prepare one drawing of all lines."""
        return partial(
            draw_lines, self.segments, *self.size, settings.line, pixel_center=settings.pixel_center
        )

    @cached_property
    def _areas(self) -> tuple[Integers, Integers, Integers, Floats]:
        return line_areas(self.segments, self.size)

    @cached_property
    def reference(self) -> Floats:
        """(H, W) float64, the area of the ideal lines in every pixel, added up."""
        _, column, row, area = self._areas
        return self._sums(column, row, area)

    def _sums(self, column: Integers, row: Integers, values: Floats) -> Floats:
        width, height = self.size
        sums = np.bincount(row * width + column, values, width * height)
        return sums.reshape(height, width).astype(np.float64)

    def counts(self, settings: Settings, made: LinePixels) -> dict[str, int]:
        """Return pixels, and the arithmetic of the method's listing by kind."""
        counts = {"pixels drawn": len(made.pixels), "bytes": made.pixels.nbytes + made.intensities.nbytes}
        chosen = self.segments[:: COUNT // COUNTED_LINES]
        operations = count_line_operations(chosen, self.size, settings)
        scale = COUNT / len(chosen)
        return counts | {name: round(scale * number) for name, number in operations.items()}

    def judge(self, settings: Settings, made: LinePixels) -> Judgement:
        """Compare with the ideal line and with its area."""
        if not len(made.pixels):
            reason = "The method draws no pixel of these lines."
            return judged(dict.fromkeys((MEAN.name, LARGEST.name, NOT_NEAREST.name, AREA.name), reason))
        column, row = made.pixels.T
        distance, _ = distance_from_line(self.segments, made.owner, column, row, made.intensities)
        not_nearest = int(np.count_nonzero(distance > 0.5 + SLACK))
        errors = {
            MEAN.name: float(distance.mean()),
            LARGEST.name: float(distance.max()),
            NOT_NEAREST.name: per_million(not_nearest, len(distance)),
            AREA.name: self._area_error(made),
        }
        return judged(errors, NOT_NEAREST.name)

    def _area_error(self, made: LinePixels) -> float:
        """Return the area that is drawn too much or too little, for a pixel's length of line."""
        column, row = made.pixels.T
        of_line, right_column, right_row, area = self._areas
        width, height = self.size

        def key(line: Integers, x: Integers, y: Integers) -> Integers:
            return (line * height + y) * width + x

        keys = np.concatenate([key(made.owner, column, row), key(of_line, right_column, right_row)])
        values = np.concatenate([made.intensities, -area])
        _, place = np.unique(keys, return_inverse=True)
        difference = np.abs(np.bincount(place.ravel(), values)).sum()
        length = np.abs(self.segments[:, 1] - self.segments[:, 0]).max(axis=1).sum()
        return float(difference / max(length, 1.0))

    def pictures(self, settings: Settings, made: LinePixels) -> Pictures:
        """Return how much every pixel is drawn."""
        column, row = made.pixels.T
        return scalar_pictures(self._sums(column, row, made.intensities), self.reference)

    def opening(self, settings: Settings, made: LinePixels) -> Opening | None:
        """Return the line with the worst pixel, as the first edge of a triangle that is drawn as outlines."""
        if not len(made.pixels):
            return None
        column, row = made.pixels.T
        distance, step = distance_from_line(self.segments, made.owner, column, row, made.intensities)
        worst = step[int(np.argmax(distance))]
        ends = self.segments[made.owner[worst]]
        pixel = (int(column[worst]), int(row[worst]))
        outlined = replace(settings, polygon_mode="wireframe", cull="none", clipping="homogeneous")
        return Opening(outline_scene(ends, self.size), outlined, "raster", pixel)


LINE = StudyFamily("line", "Lines", ("line",), WORKS, (MEAN, LARGEST, NOT_NEAREST, AREA), LineTask)
