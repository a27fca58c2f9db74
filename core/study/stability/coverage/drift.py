"""Sums that drift: edge functions by additions, lines by an added slope, spans by an added inverse slope."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import floor
from typing import ClassVar

import numpy as np

from core.arrays import Floats, Integers
from core.frame import STAGES, StageCount
from core.geometry_stages import process_geometry
from core.pipeline import schedule
from core.raster.lines import draw_lines
from core.raster.schedule import make_raster
from core.scene import ClipScene
from core.settings import Settings
from core.study.family import settings_of
from core.study.record import Opening
from core.study.stability.coverage.covered_pixels import CoverageExperiment, on_its_lattice
from core.study.stability.coverage.number_formats import powers, scene_of_window
from core.study.stability.experiment import Verdict
from core.study.stability.record import Axis, ExperimentInfo, Outcome
from core.study.workloads import on_lattice, outline_scene

LENGTHS = powers(4, 13)
FIRST_ROW = 8192.0
"""Far from the origin a float has fewer bits behind the point."""


def long_triangle(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a flat triangle across a raster of ``length`` x 8 pixels; its long side climbs ``rise`` pixels."""
    length, rise = place
    window = np.array([[-1.0, 0.3], [length + 1.0, 0.3 + rise], [length / 3, 9.0]])
    return scene_of_window(on_lattice(window, 1 << 16)[None], (int(length), 8))


@dataclass(frozen=True, eq=False)
class LineDriftExperiment:
    """One long line between pixel centres; wrong is a step that does not take a nearest pixel."""

    info: ExperimentInfo

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Draw the line of one place."""
        ends = long_line(place)
        try:
            _, off = _line_distances(ends, method.partition("=")[2])
        except ValueError as problem:
            return Verdict(Outcome.REFUSED, np.nan, str(problem))
        wrong = int(np.count_nonzero(off))
        remark = f"{wrong} of {len(off)} steps do not take a nearest pixel, by up to {int(off.max(initial=0))} pixels"
        return Verdict(Outcome.WRONG_PICTURE if wrong else Outcome.RIGHT, float(off.max(initial=0)), remark)

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return the line on a raster that reaches to its first wrong step; the stepper shows a part around it."""
        ends, name = long_line(place), method.partition("=")[2]
        pixels, off = _line_distances(ends, name)
        wrong = np.flatnonzero(off)
        column, row = pixels[wrong[0] if len(wrong) else 0].tolist()
        # A power of two, so that the ends are the same numbers in clip space.
        size = 1 << (column + 1).bit_length(), 1 << (row + 1).bit_length()
        settings = Settings(polygon_mode="wireframe", line=name)
        return Opening(outline_scene(ends, size), settings, "raster", (column, row))


def long_line(place: tuple[float, ...]) -> Floats:
    """Return the ends (2, 2) of a line between pixel centres: ``length`` columns wide, from row 8,192 on.

    Notes
    -----
    It climbs one row less than ``slope`` times its length, so that the slope is no short fraction.
    """
    length, slope = place
    rise = int(slope * length) - 1
    return np.array([[0.5, FIRST_ROW + 0.5], [length + 0.5, FIRST_ROW + rise + 0.5]])


def _line_distances(ends: Floats, line: str) -> tuple[Integers, Integers]:
    """Draw a line; return its pixels (P, 2) and by how many whole pixels (P,) each misses a nearest one."""
    (x0, y0), (x1, y1) = np.floor(ends).astype(int).tolist()
    pixels = draw_lines(ends[None], x1 + 1, y1 + 2, line).pixels
    columns, rows = pixels.T
    # In whole numbers: the row is right where its distance from the line is at most half a pixel, ties either way.
    distance = np.abs(2 * ((rows - y0) * (x1 - x0) - (columns - x0) * (y1 - y0)))
    return pixels, np.maximum(-((x1 - x0 - distance) // (2 * (x1 - x0))), 0)


@dataclass(frozen=True, eq=False)
class SlopeSumExperiment:
    """Spans of a triangle with a level side; wrong is a span that its own rule does not give in rational numbers."""

    info: ExperimentInfo
    bound_to: ClassVar[str] = "a triangle whose upper side is level: the rows below it are compared"
    """Why nothing of it can be left out."""

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Fill the triangle of one place and compare its spans."""
        scene, settings = self._scene(place), settings_of(Settings(), method)
        geometry = process_geometry(scene, settings, {stage: StageCount() for stage in STAGES})
        _, runs = schedule(geometry.edges, settings, make_raster(scene.size, settings.pixel_center))
        rule = SPAN_RULES[settings.fill]
        wrong = 0
        for row, start, stop in zip(runs.row.tolist(), runs.start.tolist(), runs.stop.tolist(), strict=True):
            if row > place[0]:
                # The level side: who owns it is another question.
                continue
            right_start, right_stop = rule(*_sides(place, row))
            wrong += abs(start - right_start) + abs(stop - right_stop)
        remark = f"{wrong} pixels are too many or missing in {len(runs)} spans"
        return Verdict(Outcome.WRONG_PICTURE if wrong else Outcome.RIGHT, float(wrong), remark)

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return the triangle."""
        return Opening(self._scene(place), settings_of(Settings(), method), "raster")

    def _scene(self, place: tuple[float, ...]) -> ClipScene:
        height, shift = (int(value) for value in place)
        side = 1 << (height + 2).bit_length()
        corners = np.array([[1.5, 1.5], [2.5, height + 1.5], [1.5 + shift, height + 1.5]])
        return scene_of_window(corners[None], (1 << max(shift + 2, 4).bit_length(), side))


def _sides(place: tuple[float, ...], row: int) -> tuple[Fraction, Fraction]:
    """Return x of the left and right side in one row, in pixels with centres at whole numbers."""
    height, shift = (int(value) for value in place)
    part = Fraction(row - 1, height)
    return 1 + part, 1 + part * shift


def _printed_span(left: Fraction, right: Fraction) -> tuple[int, int]:
    """Return the columns that LMU's program draws: both ends rounded, half up."""
    return floor(left + Fraction(1, 2)), floor(right + Fraction(1, 2)) + 1


def _exact_span(left: Fraction, right: Fraction) -> tuple[int, int]:
    """Return the columns whose centres lie between the sides, the left one included, the right one not."""
    start, stop = -floor(-left), -floor(-right)
    return start, max(start, stop)


SPAN_RULES: dict[str, Callable[[Fraction, Fraction], tuple[int, int]]] = {
    "scanline-lecture": _printed_span,
    "scanline": _exact_span,
}
"""Name of a fill to the first column and the column after the last of a row, from where its sides are."""

INCREMENTAL = CoverageExperiment(
    ExperimentInfo(
        "incremental-drift",
        "Edge functions by additions",
        "A flat triangle is filled by adding a from pixel to pixel: how long until the sums have drifted?",
        (
            Axis("length", "Width of the triangle", "pixels", LENGTHS, True),
            Axis("rise", "Rise of its long side", "pixels", (0.7, 1.3, 1.9, 2.6, 3.3, 4.1, 5.3, 6.7)),
        ),
        (
            "coverage=float16 fill=incremental",
            "coverage=float32 fill=incremental",
            "coverage=float32",
            "coverage=float64 fill=incremental",
            "coverage=snapped fill=incremental",
            "coverage=int64 fill=incremental",
            "coverage=float64",
        ),
        "Sums in float16 drift from the start, and in float32 within a few thousand pixels, where "
        "evaluating every pixel in float32 is still right; float64 and whole numbers do not drift.",
    ),
    long_triangle,
    on_its_lattice,
)
LINES = LineDriftExperiment(
    ExperimentInfo(
        "line-drift",
        "Lines by an added slope",
        "A line is drawn by adding its slope from column to column: how long may it be?",
        (
            Axis("length", "Length of the line", "columns", LENGTHS, True),
            Axis("slope", "Slope of the line", "", tuple((np.arange(2, 20) / 20).tolist())),
        ),
        ("line=dda-float32", "line=bresenham-float", "line=dda", "line=midpoint", "line=bresenham"),
        "Slopes added in float32 drift off the line within thousands of columns; sums in float64 and whole "
        "numbers always take a nearest pixel.",
    )
)
SLOPES = SlopeSumExperiment(
    ExperimentInfo(
        "inverse-slopes",
        "Spans by an added inverse slope",
        "The sides of a triangle are walked by adding the inverse slope row by row: do the sums still round alike?",
        (
            Axis("height", "Height of the triangle", "rows", tuple(map(float, range(2, 62, 3)))),
            Axis("shift", "Place of the far corner", "columns", tuple(map(float, range(2, 32, 3)))),
        ),
        ("fill=scanline-lecture", "fill=scanline"),
        "Inverse slopes added in float64 fall beside ties and round another way; spans in closed form do "
        "not.",
    )
)
EXPERIMENTS = (INCREMENTAL, LINES, SLOPES)
