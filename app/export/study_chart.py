"""The charts of a study as SVG: error against time, and how time grows with the work.

Both axes are logarithmic. An error of exactly 0 has no logarithm: it has a place of its own below the axis.
"""

from itertools import pairwise, zip_longest

from app.export.study_axes import LogAxis, axis_of, ticks
from app.export.study_labels import Box, box_around, place_labels, spread_apart
from app.export.svg_shapes import GRID, QUIET, TEXT, circle, ground, line, polyline, text, text_width
from app.pages.compare.words import (
    digits,
    machine_sentence,
    names_of,
    settings_sentence,
    time_text,
    work_sentence,
)
from core.study.accuracy.record import ErrorMeasure, Point, Study, pareto_front
from core.study.accuracy.speed_accuracy import cost_dial

WIDTH, HEIGHT = 1000, 560
LEFT, RIGHT, TOP, BOTTOM = 96, 40, 84, 70
ZERO_GAP = 34
"""Pixels between the lowest error of the axis and the place of 0."""
FOOT_LINE = 15
FRONT, OTHER, LEADER = "#0072B2", "#6A6A6A", "#A8A8A8"
MOST_TIMES = 12
"""Points whose times are written beside their names; of more, the axis has to do."""
LINES = ("#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#000000", "#8A7A00")
"""Colours that colour-blind people tell apart (M. Okabe, K. Ito, 2008); every line has its name at its end too."""


def study_svg(study: Study, measure: str | None = None) -> str:
    """Return the chart of an error (the first by default) against time, and below it that of growth if there is one.

    Raises
    ------
    ValueError
        For an error that the study does not have.
    """
    chosen = chosen_measure(study, measure)
    parts, bottom = scatter(study, chosen, 0)
    if len(study.growth) > 1:
        more, bottom = growth(study, bottom + 10)
        parts += more
    foot = [*refusals(study, chosen), settings_sentence(study), machine_sentence(study)]
    for number, words in enumerate(foot):
        parts.append(text(24, bottom + 18 + FOOT_LINE * number, shortened(words), size=11, color=QUIET))
    height = bottom + 18 + FOOT_LINE * len(foot) + 8
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height:g}" '
        f'viewBox="0 0 {WIDTH} {height:g}" font-family="DejaVu Sans, Verdana, sans-serif">\n'
        f'<rect width="{WIDTH}" height="{height:g}" fill="#FFFFFF"/>\n' + "\n".join(parts) + "\n</svg>\n"
    )


def chosen_measure(study: Study, name: str | None) -> ErrorMeasure:
    """Return the error of a name, or the first."""
    for measure in study.measures:
        if name in (None, measure.name):
            return measure
    known = ", ".join(measure.name for measure in study.measures)
    raise ValueError(f"error of {study.family} must be one of {known}, got {name}")


def shortened(words: str) -> str:
    """Return as much of a sentence as fits the width."""
    while text_width(words, 11) > WIDTH - 48:
        words = words[:-2].rstrip(" ,;.…") + "…"
    return words


def refusals(study: Study, measure: ErrorMeasure) -> list[str]:
    """Return a sentence for every method that is not in the chart."""
    found = []
    names = names_of(study)
    for point in study.points:
        reason = point.refused or point.reasons.get(measure.name, "")
        if reason:
            found.append(f"Not shown: {names[point.method]}. {reason}")
    return found


def shown_points(study: Study, measure: ErrorMeasure) -> list[Point]:
    """Return the points that have a time and this error."""
    return [
        point
        for point in study.points
        if point.is_measured and measure.name not in point.reasons and measure.name in point.errors
    ]


def scatter(study: Study, measure: ErrorMeasure, top: float) -> tuple[list[str], float]:
    """Return the chart of an error against time, and where it ends."""
    points = shown_points(study, measure)
    bottom = top + HEIGHT - BOTTOM
    times = [value for point in points for value in (point.median, *point.spread)]
    across = axis_of(times, LEFT + 14, WIDTH - RIGHT)
    errors = [point.errors[measure.name] for point in points]
    up = axis_of([error for error in errors if error > 0], bottom - ZERO_GAP, top + TOP)
    unit = f" ({measure.unit})" if measure.unit else ""
    parts = [
        text(24, top + 32, f"{study.title}: accuracy against speed", size=18, weight=600),
        text(24, top + 52, shortened(work_sentence(study)), size=12, color=QUIET),
        text(24, top + 72, f"{measure.title}{unit}, lower is better", size=12),
        *frame_of_axes(across, up, top + TOP, bottom, has_zero=True),
        text(
            WIDTH - RIGHT,
            bottom + 40,
            f"Time for one {study.work.unit}: median, with a bar from quartile to quartile; left is faster",
            size=12,
            anchor="end",
        ),
    ]

    def place(point: Point) -> tuple[float, float]:
        error = point.errors[measure.name]
        return across.place(point.median), bottom if error == 0 else up.place(error)

    front = pareto_front(tuple(points), measure.name)
    steps = front_steps([place(point) for point in front], WIDTH - RIGHT)
    parts.append(polyline(steps, FRONT, 1.5, opacity=0.45))
    places = [place(point) for point in points]
    for point, (x, y) in zip(points, places, strict=True):
        low, high = (across.place(value) for value in point.spread)
        color = FRONT if point in front else OTHER
        parts += [
            line(low, y, high, y, color, 1.5),
            circle(x, y, 5, color, filled=point in front),
        ]
    # Names stand clear of marks, bars, the front and the axis; lines lead to those that stand far away.
    known = names_of(study)
    names = [known[point.method] for point in points]
    if len(points) <= MOST_TIMES:
        names = [f"{name} ({time_text(point.median)})" for name, point in zip(names, points, strict=True)]
    bars = [tuple(across.place(value) for value in point.spread) for point in points]
    obstacles = [Box(low, y - 1, high, y + 1) for (low, high), (_, y) in zip(bars, places, strict=True)]
    obstacles += [box_around(*ends) for ends in pairwise(steps)]
    obstacles.append(Box(LEFT, bottom - 1, WIDTH - RIGHT, bottom + 1))
    labels = place_labels(places, names, Box(LEFT, top + TOP - 8, WIDTH - 8, bottom + 12), obstacles)
    for (x, y), label in zip(places, labels, strict=True):
        if label.is_far:
            parts.append(line(x, y, *label.anchor, LEADER, 0.8))
    for label in labels:
        box = label.box
        parts.append(ground(box.left - 1, box.top, box.right - box.left + 2, box.bottom - box.top))
        parts.append(text(box.left, box.bottom - 3, label.words, size=11))
    if front:
        legend = "filled: on the Pareto front, no other method is both faster and more accurate"
        parts.append(text(LEFT, bottom + 60, legend, size=11, color=QUIET))
    return parts, top + HEIGHT


def front_steps(places: list[tuple[float, float]], right: float) -> list[tuple[float, float]]:
    """Return the corners of the Pareto front: up to the next point's time nothing is more accurate."""
    steps: list[tuple[float, float]] = []
    for (x, y), following in zip_longest(places, places[1:]):
        steps += [(x, y), (right if following is None else following[0], y)]
    return steps


def frame_of_axes(across: LogAxis, up: LogAxis, top: float, bottom: float, has_zero: bool) -> list[str]:
    """Return the grid with its numbers; ``has_zero``: 0 stands below the lowest error, behind a gap."""
    parts = []
    for value in ticks(across):
        x = across.place(value)
        parts += [
            line(x, top, x, bottom + 6, GRID, 1),
            text(
                x, bottom + 22, time_text(value) if has_zero else digits(value, 1), size=10, anchor="middle"
            ),
        ]
    for value in ticks(up):
        y = up.place(value)
        label = (
            digits(value, 2).rstrip("0").rstrip(".")
            if has_zero and value < 10
            else digits(value, 2)
            if has_zero
            else time_text(value)
        )
        parts += [
            line(LEFT, y, WIDTH - RIGHT, y, GRID, 1),
            text(LEFT - 8, y + 4, label, size=10, anchor="end"),
        ]
    if has_zero:
        parts += [
            line(LEFT, bottom, WIDTH - RIGHT, bottom, TEXT, 1),
            text(LEFT - 8, bottom + 4, "0", size=11, weight=600, anchor="end"),
            text(LEFT - 8, bottom - ZERO_GAP / 2 + 4, "⋮", size=11, anchor="end"),
        ]
    return parts


def growth(study: Study, top: float) -> tuple[list[str], float]:
    """Return the chart of how time grows with the cost dial, and where it ends."""
    dial = cost_dial(study.work)
    assert dial is not None
    values = list(study.growth)
    bottom = top + HEIGHT - BOTTOM
    lines: dict[str, list[tuple[float, float]]] = {}
    names = names_of(study)
    for value, points in study.growth.items():
        for point in points:
            if point.is_measured:
                lines.setdefault(point.method, []).append((value, point.median))
    right = WIDTH - 190
    across = axis_of(values, LEFT + 14, right)
    up = axis_of([time for line_ in lines.values() for _, time in line_], bottom, top + TOP)
    unit = f" ({dial.unit})" if dial.unit else ""
    parts = [
        text(24, top + 32, f"{study.title}: how time grows", size=18, weight=600),
        text(24, top + 72, f"Time for one {study.work.unit}", size=12),
        text(right, bottom + 40, f"{dial.title}{unit}", size=12, anchor="end"),
        *frame_of_axes(across, up, top + TOP, bottom, has_zero=False),
    ]
    ends = []
    for number, (method, measured) in enumerate(lines.items()):
        color = LINES[number % len(LINES)]
        places = [(across.place(value), up.place(time)) for value, time in measured]
        dashes = "" if number < len(LINES) else "5 3"
        parts.append(polyline(places, color, 1.8, dashes=dashes))
        parts += [circle(x, y, 2.5, color, filled=True) for x, y in places]
        ends.append((places[-1], names[method], color))
    heights = spread_apart([place[1] for place, _, _ in ends], 14, top + TOP - 10, bottom + 10)
    for ((x, y), words, color), height in zip(ends, heights, strict=True):
        parts += [
            line(x + 4, y, right + 18, height, color, 0.8),
            text(right + 22, height + 4, words, size=11),
        ]
    return parts, top + HEIGHT - 20
