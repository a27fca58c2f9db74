"""Mistakes in Bresenham's algorithm as printed (LMU), D > 0, ends in order, the last pixel drawn; and in Wu's."""

from collections.abc import Callable

from core import Settings, draw_lines
from core.scene import ClipScene
from lessons.mistakes.twin import Case, Change, Twin, edited, line_pixels, same_settings, segment_ends
from lessons.small_scenes import Point, pixel_segments, segment_scene

LECTURE = Settings(line="bresenham-lecture")
DRAW = "pixels.append((y, x, D) if is_steep else (x, y, D))"
ROW = "y0 + sy * abs(x - x0) * dy // max(dx, 1)"


def in_bresenham(*in_lecture: Change, other: Change | None) -> Callable[[Settings], Settings]:
    """Return what runs Bresenham's listing with changed lines: of ``bresenham`` if settings choose it, else LMU's.

    ``other`` is the change of ``bresenham``; ``None``: the mistake makes no difference there.
    """
    lecture = edited("line", "bresenham-lecture", *in_lecture)
    plain = same_settings if other is None else edited("line", "bresenham", other)
    return lambda settings: (plain if settings.line == "bresenham" else lecture)(settings)


def in_both(old: str, new: str) -> Callable[[Settings], Settings]:
    """Return the same for a line that both listings have."""
    return in_bresenham((old, new), other=(old, new))


def intensities(scene: ClipScene, settings: Settings) -> list[float]:
    """Return the intensities of the pixels of lines."""
    drawn: list[float] = draw_lines(segment_ends(scene), *scene.size, settings.line).intensities.tolist()
    return drawn


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
        change_settings=in_bresenham(("if D > 0:", "if D >= 0:"), other=None),
    ),
    Twin(
        "from-other-end",
        "The line was drawn from its other end, which turns ties over. Begin at the end that the rule names.",
        line(((0, 0), (8, 3))),
        line(((0, 0), (7, 3))),
        change_settings=in_bresenham(
            ("if x0 > x1:", "if x0 < x1:"),
            ("dx, dy = x1 - x0", "dx, dy = x0 - x1"),
            ("sx, sy = 1", "sx, sy = -1"),
            ("while x <= x1:", "while x >= x1:"),
            other=None,
        ),
    ),
    Twin(
        "not-corrected",
        "D was not corrected after a step: 2 dx must be subtracted.",
        GENTLE,
        line(((1, 2), (9, 2))),
        change_settings=in_both("D -= 2 * dx", "D -= 0"),
    ),
    Twin(
        "one-octant",
        "The line ran along x although it is steep. Where |dy| is not below |dx| the axes are exchanged.",
        line(((1, 1), (3, 8))),
        GENTLE,
        change_settings=in_bresenham(
            ("not abs(y1 - y0) < abs(x1 - x0)", "False"), other=("abs(y1 - y0) > abs(x1 - x0)", "False")
        ),
    ),
    Twin(
        "ends-not-ordered",
        "The ends were not exchanged, so a line from right to left is not drawn.",
        line(((9, 4), (1, 1))),
        GENTLE,
        change_settings=in_bresenham(
            ("if x0 > x1:", "if False:"), other=("dx, dy = abs(x1 - x0)", "dx, dy = x1 - x0")
        ),
    ),
    Twin(
        "slope-always-up",
        "The line rises although it should fall: with a negative slope y steps by -1.",
        line(((1, 4), (9, 1))),
        GENTLE,
        change_settings=in_both("(-1 if y1 < y0 else 1)", "1"),
    ),
    Twin(
        "start-not-doubled",
        "D began at dy - dx, but its steps are doubled: it begins at 2 dy - dx.",
        GENTLE,
        line(((1, 2), (9, 2))),
        change_settings=in_both("D = 2 * dy - dx", "D = dy - dx"),
    ),
    Twin(
        "last-pixel-lost",
        "The last pixel is missing. This version draws it.",
        GENTLE,
        OUT_OF_SIGHT,
        change_settings=in_bresenham(("x <= x1", "x < x1"), other=("dx + last_pixel", "dx")),
    ),
    Twin(
        "first-pixel-lost",
        "The first pixel is missing. This version draws it.",
        GENTLE,
        OUT_OF_SIGHT,
        change_settings=in_both(DRAW, f"if x != x0: {DRAW}"),
    ),
    Twin(
        "ends-at-full",
        "The columns of the ends have all of their intensity. They have the share of the column that the line spans.",
        Case(segment_scene([((1.8, 2.1), (8.9, 4.7))], (16, 12)), Settings(line="wu"), intensities),
        Case(segment_scene([((1, 2.1), (9, 4.7))], (16, 12)), Settings(line="wu"), intensities),
        change_settings=edited("line", "wu", ("I = part * g", "I = part if g > 0 else 0.0")),
    ),
    Twin(
        "row-truncated",
        "The row was truncated. The nearest row is floor(y + 1/2).",
        GENTLE,
        line(((1, 1), (6, 6))),
        change_settings=in_both(DRAW, f"pixels.append(({ROW}, x, D) if is_steep else (x, {ROW}, D))"),
    ),
)
