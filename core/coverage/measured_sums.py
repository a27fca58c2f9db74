"""Sums that drift: edge functions and lines by additions, and spans by an inverse slope that is added row by row.

What is right of a line follows from its ends in whole numbers, so any such line can be judged, and made smaller.

What is right follows from the triangles themselves, so any triangles can be judged, and made smaller.
"""

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from math import floor

import numpy as np

from core.coverage.measured_cover import Cover, CoverageExperiment, CoverCase, on_its_grid
from core.coverage.measured_exactly import facing, whole_corner
from core.coverage.measured_triangles import powers, scene_of_window
from core.coverage.scanline import draw_triangle
from core.lines.drawing import draw_lines
from core.lines.line_method import LinePixels
from core.records.arrays import Floats, Integers
from core.scene import ClipScene
from core.settings import Settings
from core.study.experiment import SEGMENTS, Case, Experiment, first_edge, scene_of_segment
from core.study.record import Axis, Judgement, Opening, Outcome, Verdict
from core.study.workloads import on_grid, outline_scene

# Sums that drift over thousands of pixels: edge functions by additions, and lines by an added slope.


LENGTHS = powers(4, 13)
FIRST_ROW = 8192.0
"""Far from the origin a float has fewer bits behind the point."""


def long_triangle(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a flat triangle across a raster of ``length`` x 8 pixels; its long side climbs ``rise`` pixels."""
    length, rise = place
    window = np.array([[-1.0, 0.3], [length + 1.0, 0.3 + rise], [length / 3, 9.0]])
    return scene_of_window(on_grid(window, 1 << 16)[None], (int(length), 8))


INCREMENTAL = CoverageExperiment(
    "incremental-drift",
    "Edge functions by additions",
    "A flat triangle is filled by adding a from pixel to pixel. When have the sums drifted?",
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
    "Sums in float16 drift from the start, sums in float32 within a few thousand pixels, where evaluating "
    "every pixel in float32 is still right. float64 and whole numbers do not drift.",
    long_triangle,
    wanted=on_its_grid,
)


class LineCase(Case):
    """One line between pixel centres; wrong is a step that does not take a nearest pixel."""

    scene: ClipScene

    def __init__(self, scene: ClipScene) -> None:
        super().__init__(scene)
        self.ends = first_edge(scene)

    def start(self, settings: Settings) -> Callable[[], LinePixels]:
        """Prepare the drawing; ValueError for a line that does not lead between pixel centres of the raster."""
        check_line(self.ends, self.scene.size)
        return partial(draw_lines, self.ends[None], *self.scene.size, settings.line)

    def judge(self, settings: Settings, made: LinePixels) -> Judgement:
        """Count the steps that miss a nearest pixel; severity is in pixels."""
        off = _pixels_off(self.ends, made.pixels)
        wrong, farthest = int(np.count_nonzero(off)), int(off.max(initial=0))
        remark = f"{wrong} of {len(off)} steps do not take a nearest pixel, by up to {farthest} pixels"
        return Judgement(Verdict(Outcome.WRONG_PICTURE if wrong else Outcome.RIGHT, float(farthest), remark))

    def wrong_pixel(self, settings: Settings, made: LinePixels) -> tuple[int, int] | None:
        """Return column and row of the first step that misses a nearest pixel; ``None``: none does."""
        wrong = np.flatnonzero(_pixels_off(self.ends, made.pixels))
        if not len(wrong):
            return None
        column, row = made.pixels[wrong[0]].tolist()
        return column, row

    def opening(self, settings: Settings, made: LinePixels) -> Opening:
        """Return the line on a raster that reaches to its first wrong step; the stepper shows a part around it."""
        pixel = self.wrong_pixel(settings, made) or (int(self.ends[0, 0]), int(self.ends[0, 1]))
        # Powers of two, so that the ends are the same numbers in clip space.
        near = size_around(np.array(pixel, float))
        return Opening(outline_scene(self.ends, near), settings, self.stage, pixel)

    def test_body(self, settings: Settings) -> str:
        """Return the statements of a test: twice the distance from the line, across, is at most a pixel's."""
        (x0, y0), (x1, y1) = np.floor(self.ends).astype(int).tolist()
        width, height = self.scene.size
        return (
            f'pixels = draw_lines([{self.ends.tolist()}], {width}, {height}, "{settings.line}").pixels\n'
            f"across, up = {x1 - x0}, {y1 - y0}\n"
            f"for column, row in pixels:\n"
            f"    distance = abs((row - {y0}) * across - (column - {x0}) * up)\n"
            f"    assert 2 * distance <= max(abs(across), abs(up)), (column, row)"
        )


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


def line_at(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return the line of one place as an edge of an outlined triangle."""
    ends = long_line(place)
    return scene_of_segment(ends, size_around(ends.max(axis=0)))


def check_line(ends: Floats, size: tuple[int, int]) -> None:
    """Refuse ends (2, 2) with ValueError unless they are two pixel centres of a raster of this size."""
    if (ends - np.floor(ends) != 0.5).any() or (ends[0] == ends[1]).all():
        raise ValueError(f"the line must lead from one pixel centre to another, got {ends.tolist()}")
    if (ends < 0).any() or (ends > size).any():
        raise ValueError(f"the line must lie in {size[0]}x{size[1]} pixels, got {ends.tolist()}")


def _pixels_off(ends: Floats, pixels: Integers) -> Integers:
    """Return by how many whole pixels each pixel (P, 2) of a line misses a nearest one, (P,) int64."""
    (x0, y0), (x1, y1) = np.floor(ends).astype(int).tolist()
    columns, rows = pixels.T
    # In whole numbers: right is a distance of at most half a pixel across the longer axis, ties either way.
    across, up = x1 - x0, y1 - y0
    longer = max(abs(across), abs(up))
    distance = np.abs(2 * ((rows - y0) * across - (columns - x0) * up))
    return np.asarray(np.maximum(-((longer - distance) // (2 * longer)), 0))


LINES = Experiment(
    "line-drift",
    "Lines by an added slope",
    "A line is drawn by adding its slope from column to column. How long may it be?",
    (
        Axis("length", "Length of the line", "columns", LENGTHS, True),
        Axis("slope", "Slope of the line", "", tuple((np.arange(2, 20) / 20).tolist())),
    ),
    ("line=dda-float32", "line=bresenham-float", "line=dda", "line=midpoint", "line=bresenham"),
    "Slopes added in float32 drift off the line within thousands of columns. Sums in float64 and whole "
    "numbers always take a nearest pixel.",
    line_at,
    LineCase,
    Settings(polygon_mode="wireframe"),
    SEGMENTS,
)
DRIFT_EXPERIMENTS = (INCREMENTAL, LINES)


# Spans between sides that are walked by an added inverse slope, against the same program in fractions.


class SlopeCase(CoverCase):
    """Spans of triangles; wrong is a pixel that the fill's own rule does not give in rational numbers."""

    def __init__(self, scene: ClipScene) -> None:
        super().__init__(scene, lambda scene, settings: RULES[settings.fill](scene, settings))

    def judge(self, settings: Settings, made: Cover) -> Judgement:
        """Compare the cover (H, W)."""
        cover, _ = made
        error = cover - self.wanted(self.scene, settings)
        wrong = int(np.abs(error).sum())
        remark = f"{wrong} pixels of {cover.size} are too many or missing"
        outcome = Outcome.WRONG_PICTURE if wrong else Outcome.RIGHT
        return Judgement(Verdict(outcome, float(wrong), remark), error != 0)


def level_triangle(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a triangle ``height`` rows high with a level upper side, whose far corner is ``shift`` columns away."""
    height, shift = (int(value) for value in place)
    side = 1 << (height + 2).bit_length()
    corners = np.array([[1.5, 1.5], [2.5, height + 1.5], [1.5 + shift, height + 1.5]])
    return scene_of_window(corners[None], (1 << max(shift + 2, 4).bit_length(), side))


def printed_cover(scene: ClipScene, settings: Settings) -> Integers:
    """Return how often LMU's program covers each pixel, (H, W) int64, if its sums are fractions and never rounded.

    Raises ValueError if a corner does not lie in front of the eye.
    """
    width, height = scene.size
    cover = np.zeros((height, width), np.int64)
    for corners in scene.clip:
        placed = [whole_corner(corner, scene.size, True) for corner in corners]
        if any(w <= 0 for _, _, w in placed):
            raise ValueError("every corner must lie in front of the eye")
        # The printed program knows no triangles without area: they are left out before it.
        if facing(placed) == 0:
            continue
        # Rounded, half up, to the pixel with the nearest centre: the one that the corner lies in.
        v1, v2, v3 = ((Fraction(x // w), Fraction(y // w)) for x, y, w in placed)
        for row, first, second in draw_triangle(v1, v2, v3, height):  # type: ignore[arg-type]
            start, stop = (floor(x + Fraction(1, 2)) for x in sorted((first, second)))
            if 0 <= row < height:
                cover[row, max(start, 0) : max(stop + 1, 0)] += 1
    return cover


RULES: dict[str, Callable[[ClipScene, Settings], Integers]] = {
    "scanline-lecture": printed_cover,
    "scanline": on_its_grid,
}
"""Name of a fill to how often it should cover each pixel."""

SLOPES = Experiment(
    "inverse-slopes",
    "Spans by an added inverse slope",
    "The sides of a triangle are followed by adding the inverse slope row by row. Do the sums still round to "
    "the same pixel?",
    (
        Axis("height", "Height of the triangle", "rows", tuple(map(float, range(2, 62, 3)))),
        Axis("shift", "Place of the far corner", "columns", tuple(map(float, range(2, 32, 3)))),
    ),
    ("fill=scanline-lecture", "fill=scanline"),
    "Inverse slopes added in float64 miss ties and round to another pixel. Spans in closed form do not.",
    level_triangle,
    SlopeCase,
)
SLOPE_EXPERIMENTS = (SLOPES,)
