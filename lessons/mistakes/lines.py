"""Mistakes in Bresenham's algorithm as printed (LMU): D > 0, ends in order, the last pixel drawn."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import nan

import numpy as np

from core import Settings, draw_lines
from core.raster.lines.bresenham import Listed
from core.raster.lines.records import LineRun, Segments
from core.raster.lines.smooth import wu
from core.scene import ClipScene
from lessons.mistakes.twin import Case, Twin, line_pixels, segment_ends
from lessons.small_scenes import Point, pixel_segments, segment_scene

LECTURE = Settings(line="bresenham-lecture")


def faulty_listing(
    fault: str, x0: int, y0: int, x1: int, y1: int, is_lecture: bool = True, last_pixel: bool = True
) -> Listed:
    """List the pixels of a Bresenham line between two pixels with one fault, and the D that chose each.

    The lecture's version draws from left to right and keeps the row at a tie. The other one, ``bresenham``, draws from
    the first end and steps at a tie.
    """
    if fault == "from-other-end":
        # Seen from the other end, x and y run the other way, and so do the ties.
        turned = faulty_listing("", -x0, -y0, -x1, -y1, is_lecture, last_pixel)
        return [(-x, -y, decision) for x, y, decision in turned[::-1]]
    is_steep = not abs(y1 - y0) < abs(x1 - x0) and fault != "one-octant"
    if is_steep:
        x0, y0, x1, y1 = y0, x0, y1, x1
    x_step = y_step = 1
    if x0 > x1 and fault != "ends-not-ordered":
        if is_lecture:
            x0, y0, x1, y1 = x1, y1, x0, y0
        else:
            x_step = -1
    dx, dy = (x1 - x0) * x_step, y1 - y0
    if dy < 0:
        y_step, dy = (1 if fault == "slope-always-up" else -1), -dy
    y, D, chosen_by = y0, 2 * dy - dx, nan
    if fault == "start-not-doubled":
        D = dy - dx
    pixels = []
    for number in range(dx + (last_pixel and fault != "last-pixel-lost")):
        x = x0 + number * x_step
        shown = y0 + y_step * number * dy // max(dx, 1) if fault == "row-truncated" else y
        if number or fault != "first-pixel-lost":
            pixels.append((shown, x, chosen_by) if is_steep else (x, shown, chosen_by))
        chosen_by = D
        if D > 0 or (D == 0 and (fault == "ties-step" or not is_lecture)):
            y += y_step
            D -= 0 if fault == "not-corrected" else 2 * dx
        D += 2 * dy
    return pixels


def faulty_lines(fault: str, is_lecture: bool, segments: Segments, last_pixel: bool) -> LineRun:
    """Draw segments with one fault, as a method of the family ``line``; the lecture's draws every last pixel."""
    ends = segments.pixel_indices.reshape(-1, 4).tolist()
    visited = [
        (owner, index, *pixel)
        for owner, (x0, y0, x1, y1) in enumerate(ends)
        for index, pixel in enumerate(
            faulty_listing(fault, x0, y0, x1, y1, is_lecture, is_lecture or last_pixel)
        )
    ]
    steps = np.array(visited, float).reshape(-1, 5).T
    owner, index, column, row = steps[:4].astype(np.int64)
    decision = steps[4]
    moved = (np.diff(column, prepend=0) != 0) & (np.diff(row, prepend=0) != 0) & (index > 0)
    return LineRun(owner, index, column, row, decision, moved, decision == 0)


def ends_at_full(segments: Segments, last_pixel: bool) -> LineRun:
    """Draw Wu's lines with all of both intensities in the columns of the ends, too."""
    run = wu(segments, last_pixel)
    assert run.intensity is not None
    assert run.share is not None
    return replace(run, intensity=run.intensity / run.share)


def intensities(scene: ClipScene, settings: Settings) -> list[float]:
    """Return the intensities of the pixels of lines."""
    drawn: list[float] = draw_lines(segment_ends(scene), *scene.size, settings.line).intensities.tolist()
    return drawn


def with_fault(fault: str) -> Callable[[Settings], Settings]:
    """Return what replaces the line method of settings by a faulty one: of ``bresenham``, else of the lecture's."""
    return lambda settings: settings.replaced(line=partial(faulty_lines, fault, settings.line != "bresenham"))


def line(*ends: tuple[Point, Point]) -> Case:
    """Return lines between pixels, of which the pixels are compared."""
    return Case(pixel_segments(ends, (16, 12)), LECTURE, line_pixels)


GENTLE = line(((1, 1), (9, 4)))
OUT_OF_SIGHT = line(((-4, 1), (20, 8)))
"""Both ends lie outside of the raster."""

TWINS = (
    Twin(
        "ties-step",
        "The line stepped where D = 0. The rule here is D > 0: a tie stays in the row.",
        GENTLE,
        line(((0, 0), (7, 3))),
        change_settings=with_fault("ties-step"),
    ),
    Twin(
        "from-other-end",
        "The line was drawn from its other end, which turns ties over. Begin at the end that the rule names.",
        line(((0, 0), (8, 3))),
        line(((0, 0), (7, 3))),
        change_settings=with_fault("from-other-end"),
    ),
    Twin(
        "not-corrected",
        "D was not corrected after a step: 2 dx must be subtracted.",
        GENTLE,
        line(((1, 2), (9, 2))),
        change_settings=with_fault("not-corrected"),
    ),
    Twin(
        "one-octant",
        "The line ran along x although it is steep. Where |dy| is not below |dx| the axes are exchanged.",
        line(((1, 1), (3, 8))),
        GENTLE,
        change_settings=with_fault("one-octant"),
    ),
    Twin(
        "ends-not-ordered",
        "The ends were not exchanged, so a line from right to left is not drawn.",
        line(((9, 4), (1, 1))),
        GENTLE,
        change_settings=with_fault("ends-not-ordered"),
    ),
    Twin(
        "slope-always-up",
        "The line rises although it should fall: with a negative slope y steps by -1.",
        line(((1, 4), (9, 1))),
        GENTLE,
        change_settings=with_fault("slope-always-up"),
    ),
    Twin(
        "start-not-doubled",
        "D began at dy - dx, but its steps are doubled: it begins at 2 dy - dx.",
        GENTLE,
        line(((1, 2), (9, 2))),
        change_settings=with_fault("start-not-doubled"),
    ),
    Twin(
        "last-pixel-lost",
        "The last pixel is missing. This version draws it.",
        GENTLE,
        OUT_OF_SIGHT,
        change_settings=with_fault("last-pixel-lost"),
    ),
    Twin(
        "first-pixel-lost",
        "The first pixel is missing. This version draws it.",
        GENTLE,
        OUT_OF_SIGHT,
        change_settings=with_fault("first-pixel-lost"),
    ),
    Twin(
        "ends-at-full",
        "The columns of the ends have all of their intensity. They have the share of the column that the line spans.",
        Case(segment_scene([((1.8, 2.1), (8.9, 4.7))], (16, 12)), Settings(line="wu"), intensities),
        Case(segment_scene([((1, 2.1), (9, 4.7))], (16, 12)), Settings(line="wu"), intensities),
        change_settings=lambda settings: settings.replaced(line=ends_at_full),
    ),
    Twin(
        "row-truncated",
        "The row was truncated. The nearest row is floor(y + 1/2).",
        GENTLE,
        line(((1, 1), (6, 6))),
        change_settings=with_fault("row-truncated"),
    ),
)
