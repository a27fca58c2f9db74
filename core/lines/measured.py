"""Study of lines: how far pixels lie from the ideal line, and how well they fill it, against exact areas."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import partial

import numpy as np

from core.coverage.measured_exactly import area_in_pixels
from core.lines.drawing import draw_lines
from core.lines.line_method import LinePixels
from core.records.arrays import Floats, Integers, cached_property
from core.settings import Settings
from core.study.counted_listings import count_line_operations
from core.study.family import Assignment, StudyFamily, Task
from core.study.frame_task import per_million, scalar_pictures
from core.study.record import Axis, ErrorMeasure, Judgement, Opening, Pictures, WorkKind, judged
from core.study.workloads import outline_scene, random_lines

# Segments and ideal lines: the part of a segment in a rectangle, the area of a line, distances from it.


Ends = tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]
HALF_WIDTH = 0.5
"""Half the width of the ideal line, in pixels."""
CENTER = 0.5
"""Of pixel 0 along an axis: all lines here have pixel centres at halves."""


def clipped_ends(segment: Floats, window: tuple[float, float, float, float]) -> Ends | None:
    """Return both ends of the part of a segment (2, 2) inside (left, bottom, right, top); ``None``: nothing is.

    Notes
    -----
    The border is inside; a segment of no length is a point. Every coordinate alone bounds t from both sides.

    Examples
    --------
    >>> [[float(value) for value in end] for end in clipped_ends([[-2, 1], [6, 5]], (0, 0, 4, 3))]
    [[0.0, 2.0], [2.0, 3.0]]
    """
    first, second = ([Fraction(float(value)) for value in end] for end in segment)
    left, bottom, right, top = (Fraction(value) for value in window)
    low, high = Fraction(0), Fraction(1)
    for start, end, least, largest in (
        (first[0], second[0], left, right),
        (first[1], second[1], bottom, top),
    ):
        if start == end:
            if not least <= start <= largest:
                return None
            continue
        crossings = sorted([(least - start) / (end - start), (largest - start) / (end - start)])
        low, high = max(low, crossings[0]), min(high, crossings[1])
    if low > high:
        return None

    def at(t: Fraction) -> tuple[Fraction, Fraction]:
        return first[0] + t * (second[0] - first[0]), first[1] + t * (second[1] - first[1])

    return at(low), at(high)


def line_rectangles(ends: Floats) -> Floats:
    """Return the rectangles (L, 4, 2), counter-clockwise, one pixel wide around segments (L, 2, 2), ends cut square."""
    along = ends[:, 1] - ends[:, 0]
    length = np.hypot(along[:, 0], along[:, 1])
    along = along / np.where(length == 0, 1.0, length)[:, None]
    across = HALF_WIDTH * np.stack([-along[:, 1], along[:, 0]], axis=1)
    return np.stack(
        [ends[:, 0] - across, ends[:, 1] - across, ends[:, 1] + across, ends[:, 0] + across], axis=1
    )


def line_areas(ends: Floats, size: tuple[int, int]) -> tuple[Integers, Integers, Integers, Floats]:
    """Return owner, column, row (F,) and area (F,) of all pixels that the lines (L, 2, 2) one pixel wide touch.

    Parameters
    ----------
    ends : (L, 2, 2) float64
        Window x and y in pixels, pixel centres at halves.
    size : (width, height)
        Pixels outside are left out.
    """
    rectangles = line_rectangles(ends)
    parts = []
    for owner, rectangle in enumerate(rectangles):
        column, row = _pixels_near(ends[owner], rectangle, size)
        area = area_in_pixels(rectangle, column, row)
        touched = area > 0
        parts.append(
            (np.full(np.count_nonzero(touched), owner), column[touched], row[touched], area[touched])
        )
    if not parts:
        none = np.empty(0, np.int64)
        return none, none, none, np.empty(0)
    owners, columns, rows, areas = (np.concatenate(values) for values in zip(*parts, strict=True))
    return owners, columns, rows, areas


def _pixels_near(ends: Floats, rectangle: Floats, size: tuple[int, int]) -> tuple[Integers, Integers]:
    """Return column and row (F,) of the pixels in the box of one line that are not far from it."""
    low = np.maximum(np.floor(rectangle.min(axis=0)), 0).astype(np.int64)
    high = np.minimum(np.ceil(rectangle.max(axis=0)), size).astype(np.int64)
    row, column = np.mgrid[low[1] : max(high[1], low[1]), low[0] : max(high[0], low[0])]
    column, row = column.ravel(), row.ravel()
    along = ends[1] - ends[0]
    length = max(float(np.hypot(*along)), np.finfo(np.float64).tiny)
    offset = (column + CENTER - ends[0, 0]) * along[1] - (row + CENTER - ends[0, 1]) * along[0]
    near = np.abs(offset) <= length * (HALF_WIDTH + 1.0)
    return column[near], row[near]


def distance_from_line(
    ends: Floats, owner: Integers, column: Integers, row: Integers, intensity: Floats
) -> tuple[Floats, Integers]:
    """Compare the pixels of lines with the ideal line, step by step along the longer axis.

    Parameters
    ----------
    ends : (L, 2, 2) float64
        Window x and y in pixels, pixel centres at halves.
    owner, column, row : (P,) int64
    intensity : (P,) float64
        Several pixels of one step are one place: their mean, weighted with it.

    Returns
    -------
    distance : (S,) float64, pixels along the shorter axis between the drawn place and the ideal line
    step : (S,) int64, index of a pixel of each step
    """
    along = ends[:, 1] - ends[:, 0]
    is_steep = np.abs(along[:, 1]) > np.abs(along[:, 0])
    steep = is_steep[owner]
    major, minor = np.where(steep, row, column), np.where(steep, column, row)
    start = np.where(is_steep[:, None], ends[:, 0, ::-1], ends[:, 0])[owner] - CENTER
    run, rise = np.where(is_steep[:, None], along[:, ::-1], along)[owner].T

    # (minor - v0) - (major - u0) rise / run with one division: products of multiples of 1/1024 pixel are exact.
    offset = ((minor - start[:, 1]) * run - (major - start[:, 0]) * rise) / np.where(run == 0, 1.0, run)
    key = np.stack([owner, major], axis=1)
    _, step, of_pixel = np.unique(key, axis=0, return_index=True, return_inverse=True)
    of_pixel = of_pixel.ravel()
    weight = np.bincount(of_pixel, intensity, len(step))
    total = np.bincount(of_pixel, intensity * offset, len(step))
    return np.abs(total / np.where(weight == 0, 1.0, weight)), step.astype(np.int64)


# Study of lines: how far the pixels lie from the ideal line, and how well they fill its area.


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
