r"""The formulas of exact areas: an edge function at a corner, the crossing of a side, the area by cross products."""

from collections.abc import Callable, Mapping
from itertools import pairwise
from math import isnan

from core.explain.formulas.equation import (
    Part,
    comparison,
    conclusion,
    equation,
    linear,
    number_latex,
    signed_latex,
)
from core.explain.records import Formula
from core.explain.step_values import StepValues

MOST = 3
"""Cross products that are written out."""


def _corners(step: StepValues, name: str) -> list[list[float]]:
    """Return the corners of a polygon."""
    return [corner for corner in step.rows(name) if not isnan(corner[0])]


def at_corner(step: StepValues) -> Formula:
    """The edge function at the corner that lies farthest beyond the edge, or nearest to it."""
    edge, corners = step.whole("edge"), _corners(step, "before")
    found = step.vector("corner_distance")[: len(corners)]
    worst = min(range(len(corners)), key=lambda k: found[k])
    coefficients = [(name, step.number(key)) for name, key in (("a", "a"), ("b", "b"), ("E_c", "value"))]
    x, y = corners[worst]
    return linear(f"E_{edge}", found[worst], coefficients, ("x", x), ("y", y))


def crossing(step: StepValues) -> Formula:
    """Where the first side that goes out crosses the edge, or that all corners lie on one side of it."""
    corners = _corners(step, "before")
    distance = step.vector("corner_distance")[: len(corners)]
    for here, there in zip(distance, [*distance[1:], *distance[:1]], strict=True):
        if here > 0 > there:
            symbols = r"\frac{E_{\mathrm{start}}}{E_{\mathrm{start}} - E_{\mathrm{end}}}"
            numbers = rf"\frac{{{number_latex(here)}}}{{{number_latex(here)} - {signed_latex(there)}}}"
            return equation(("t", here / (here - there)), "=", (symbols, numbers))
    if min(distance) >= 0:
        return equation(
            *comparison(r"E_{\mathrm{least}}", r"\ge", min(distance)), *conclusion("all stays", "all stays")
        )
    return equation(
        *comparison(r"E_{\mathrm{greatest}}", r"\le", max(distance)),
        *conclusion("nothing stays", "nothing stays"),
    )


def area(step: StepValues) -> Formula:
    """Twice the area, the sum of the cross products of the ways from the first corner to the others."""
    corners = _corners(step, "polygon")
    if not corners:
        return equation(("A", 0.0), "=", "0")
    x0, y0 = corners[0]
    cross = [(x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0) for (x1, y1), (x2, y2) in pairwise(corners[1:])]
    parts: list[Part] = [(r"2 A", 2 * step.number("piece_area")), "="]
    for place, value in enumerate(cross[:MOST]):
        parts += ["+"] if place else []
        parts.append((rf"d_{place + 1} \times d_{place + 2}", value))
    parts += ["+", (r"\dots", r"\dots")] if len(cross) > MOST else []
    return equation(*parts)


def seen(step: StepValues) -> Formula:
    """What is seen of it is at most all of it."""
    front, whole = step.number("seen_area"), step.number("piece_area")
    return equation((r"A_{\mathrm{front}}", front), r"\le", ("A", max(whole, front)))


def cover(step: StepValues) -> Formula:
    """What triangles cover, and what the background is seen in, make the pixel."""
    covered = min(step.number("covered_area"), 1.0)
    background = (r"A_{\mathrm{background}}", 1 - covered)
    return equation((r"A_{\mathrm{covered}}", covered), "+", background, "=", "1")


FORMULAS: Mapping[str, Callable[[StepValues], Formula]] = {
    "resolve.cut.distances": at_corner,
    "resolve.cut.cut": crossing,
    "resolve.piece.area": area,
    "resolve.piece.seen": seen,
    "resolve.piece.cover": cover,
}
