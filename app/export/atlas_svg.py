"""The maps of a stability experiment as a drawing: a square for each cell, told by colour and by a character."""

from textwrap import wrap

from app.export.atlas_text import MARKS, WORDS, axis_text
from app.export.svg_shapes import QUIET, text
from app.pages.compare.words import machine_words
from app.pages.stability.severity_curves import has_curves, severity_svg
from core.study.stability import Atlas, Outcome, StabilityMap

CELL, GAP, LEFT, TOP = 14, 28, 24, 76
WIDEST = 1100
WORDS_IN_LINE = 110
FOOT_LINE = 16
COLORS = {
    Outcome.RIGHT: "#E8EEF2",
    Outcome.HOLE: "#0072B2",
    Outcome.DOUBLE_HIT: "#D55E00",
    Outcome.WRONG_ORDER: "#CC79A7",
    Outcome.NOT_A_NUMBER: "#000000",
    Outcome.OVERFLOW: "#8A7A00",
    Outcome.WRONG_PICTURE: "#882255",
    Outcome.REFUSED: "#BBBBBB",
}
"""Colours that colour-blind people tell apart (M. Okabe, K. Ito, 2008); wine (P. Tol, 2021) where they have green.

Nothing that fails is green: a map of green cells would be read as one where all is well.
"""
DARK = {Outcome.HOLE, Outcome.DOUBLE_HIT, Outcome.NOT_A_NUMBER, Outcome.OVERFLOW, Outcome.WRONG_PICTURE}
"""Outcomes whose character is white."""


def atlas_svg(atlas: Atlas) -> str:
    """Return all maps beside and below each other, with legend, axes and where they were made."""
    info = atlas.experiment
    rows, columns = atlas.maps[0].outcome.shape
    name_width = 7.2 * max(len(each.method) for each in atlas.maps)
    step = max(CELL * columns, name_width) + GAP
    in_row = max(1, int((WIDEST - LEFT) // step))
    height_of_map = CELL * rows + 22 + GAP
    parts = [
        text(LEFT, 30, info.title, size=18, weight=600),
        text(LEFT, 52, info.question, size=12, color=QUIET),
    ]
    for number, each in enumerate(atlas.maps):
        x, y = LEFT + step * (number % in_row), TOP + height_of_map * (number // in_row)
        parts += _map(each, x, y)
    y = TOP + height_of_map * (-(-len(atlas.maps) // in_row))
    if has_curves(info):
        curves, y = severity_svg(atlas, y)
        parts += curves
    parts += _legend(atlas, y)
    foot = [axis_text("Across", info.axes[0])]
    foot += [axis_text("Up", info.axes[1])] if len(info.axes) > 1 else []
    foot += [*wrap(info.claim, WORDS_IN_LINE), f"Seed {atlas.seed}. {machine_words(atlas.machine)}"]
    for number, words in enumerate(foot):
        parts.append(text(LEFT, y + 26 + FOOT_LINE * number, words, size=11, color=QUIET))
    width, height = WIDEST, y + 26 + FOOT_LINE * len(foot) + 8
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height:g}" '
        f'viewBox="0 0 {width} {height:g}" font-family="DejaVu Sans, Verdana, sans-serif">\n'
        f'<rect width="{width}" height="{height:g}" fill="#FFFFFF"/>\n' + "\n".join(parts) + "\n</svg>\n"
    )


def _map(each: StabilityMap, x: float, y: float) -> list[str]:
    """Return one map with its name above."""
    parts = [text(x, y + 12, each.method, size=12)]
    for row, values in enumerate(each.outcome[::-1].tolist()):
        for column, value in enumerate(values):
            parts += _cell(Outcome(value), x + CELL * column, y + 20 + CELL * row)
    return parts


def _cell(outcome: Outcome, x: float, y: float) -> list[str]:
    side = CELL - 1
    square = f'<rect x="{x:g}" y="{y:g}" width="{side}" height="{side}" fill="{COLORS[outcome]}"/>'
    color = "#FFFFFF" if outcome in DARK else QUIET
    return [square, text(x + side / 2, y + 10, MARKS[outcome], size=9, color=color, anchor="middle")]


def _legend(atlas: Atlas, y: float) -> list[str]:
    """Return what the squares mean, those that occur."""
    parts, x = [], float(LEFT)
    for outcome in Outcome:
        if any(each.count(outcome) for each in atlas.maps):
            parts += [*_cell(outcome, x, y - 10), text(x + CELL + 4, y, WORDS[outcome], size=11)]
            x += CELL + 22 + 6.8 * len(WORDS[outcome])
    return parts
