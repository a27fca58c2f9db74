"""Lines by an added slope: how long one may be until its steps no longer take a nearest pixel.

What is right follows from the ends in whole numbers, so any such line can be judged, and made smaller.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from core.raster.lines.drawing import draw_lines
from core.records.arrays import Floats, Integers
from core.scene import ClipScene
from core.settings import Settings
from core.study.accuracy.record import Opening
from core.study.accuracy.workloads import outline_scene
from core.study.stability.coverage.number_formats import powers
from core.study.stability.experiment import Verdict
from core.study.stability.minimization import segments
from core.study.stability.minimization.kind import Kind
from core.study.stability.minimization.segments import SEGMENTS, Segment, first_edge
from core.study.stability.record import Axis, ExperimentInfo, Outcome

LENGTHS = powers(4, 13)
FIRST_ROW = 8192.0
"""Far from the origin a float has fewer bits behind the point."""


@dataclass(frozen=True, eq=False)
class LineDriftExperiment:
    """One long line between pixel centres; wrong is a step that does not take a nearest pixel."""

    info: ExperimentInfo
    stage: ClassVar[str] = "raster"
    kind: ClassVar[Kind[Segment]] = SEGMENTS

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Draw the line of one place."""
        ends = long_line(place)
        return judge_line(ends, method.partition("=")[2], size_around(ends.max(axis=0)))

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return the line on a raster that reaches to its first wrong step; the stepper shows a part around it."""
        ends, line = long_line(place), method.partition("=")[2]
        size = size_around(ends.max(axis=0))
        pixel = first_wrong_step(ends, line, size) or (int(ends[0, 0]), int(ends[0, 1]))
        # Powers of two, so that the ends are the same numbers in clip space.
        near = size_around(np.array(pixel, float))
        return Opening(outline_scene(ends, near), settings_of_line(line), self.stage, pixel)

    def case(self, method: str, place: tuple[float, ...], seed: int) -> tuple[ClipScene, Settings]:
        """Return the line of one place as an edge of an outlined triangle."""
        ends = long_line(place)
        scene = segments.put_together(Segment(ends, size_around(ends.max(axis=0))))
        return scene, settings_of_line(method.partition("=")[2])

    def judge(self, scene: ClipScene, settings: Settings) -> Verdict:
        """Draw the first edge of a triangle."""
        return judge_line(first_edge(scene), settings.line, scene.size)

    def test_body(self, scene: ClipScene, settings: Settings) -> str:
        """Return the statements of a test: twice the distance from the line, across, is at most a pixel's."""
        ends, (width, height) = first_edge(scene), scene.size
        (x0, y0), (x1, y1) = np.floor(ends).astype(int).tolist()
        return (
            f'pixels = draw_lines([{ends.tolist()}], {width}, {height}, "{settings.line}").pixels\n'
            f"across, up = {x1 - x0}, {y1 - y0}\n"
            f"for column, row in pixels:\n"
            f"    distance = abs((row - {y0}) * across - (column - {x0}) * up)\n"
            f"    assert 2 * distance <= max(abs(across), abs(up)), (column, row)"
        )

    def wrong_pixel(self, scene: ClipScene, settings: Settings) -> tuple[int, int] | None:
        """Return the first step that does not take a nearest pixel."""
        return first_wrong_step(first_edge(scene), settings.line, scene.size)


def long_line(place: tuple[float, ...]) -> Floats:
    """Return the ends (2, 2) of a line between pixel centres: ``length`` columns wide, from row 8,192 on.

    Notes
    -----
    It climbs one row less than ``slope`` times its length, so that the slope is no short fraction.
    """
    length, slope = place
    rise = int(slope * length) - 1
    return np.array([[0.5, FIRST_ROW + 0.5], [length + 0.5, FIRST_ROW + rise + 0.5]])


def size_around(place: Floats) -> tuple[int, int]:
    """Return the least powers of two for the columns and rows of a raster that holds a place (2,) in pixels."""
    column, row = np.floor(place).astype(int).tolist()
    return 1 << (column + 1).bit_length(), 1 << (row + 1).bit_length()


def settings_of_line(line: str) -> Settings:
    """Return the settings that draw outlines by one method."""
    return Settings(polygon_mode="wireframe", line=line)


def judge_line(ends: Floats, line: str, size: tuple[int, int]) -> Verdict:
    """Draw a line (2, 2) between pixel centres; severity is in pixels."""
    try:
        _, off = _line_distances(ends, line, size)
    except ValueError as problem:
        return Verdict(Outcome.REFUSED, np.nan, str(problem))
    wrong, farthest = int(np.count_nonzero(off)), int(off.max(initial=0))
    remark = f"{wrong} of {len(off)} steps do not take a nearest pixel, by up to {farthest} pixels"
    return Verdict(Outcome.WRONG_PICTURE if wrong else Outcome.RIGHT, float(farthest), remark)


def first_wrong_step(ends: Floats, line: str, size: tuple[int, int]) -> tuple[int, int] | None:
    """Return column and row of the first step of a line (2, 2) that misses a nearest pixel; ``None``: none does."""
    pixels, off = _line_distances(ends, line, size)
    wrong = np.flatnonzero(off)
    if not len(wrong):
        return None
    column, row = pixels[wrong[0]].tolist()
    return column, row


def _line_distances(ends: Floats, line: str, size: tuple[int, int]) -> tuple[Integers, Integers]:
    """Draw a line; return its pixels (P, 2) and by how many whole pixels (P,) each misses a nearest one."""
    if (ends - np.floor(ends) != 0.5).any() or (ends[0] == ends[1]).all():
        raise ValueError(f"the line must lead from one pixel centre to another, got {ends.tolist()}")
    if (ends < 0).any() or (ends > size).any():
        raise ValueError(f"the line must lie in {size[0]}x{size[1]} pixels, got {ends.tolist()}")
    (x0, y0), (x1, y1) = np.floor(ends).astype(int).tolist()
    pixels = draw_lines(ends[None], *size, line).pixels
    columns, rows = pixels.T
    # In whole numbers: right is a distance of at most half a pixel across the longer axis, ties either way.
    across, up = x1 - x0, y1 - y0
    longer = max(abs(across), abs(up))
    distance = np.abs(2 * ((rows - y0) * across - (columns - x0) * up))
    return pixels, np.maximum(-((longer - distance) // (2 * longer)), 0)


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
EXPERIMENTS = (LINES,)
