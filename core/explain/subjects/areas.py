"""Exact areas: edges cut the square of a pixel, cross products give the area of the rest, depth decides the order."""

from itertools import pairwise
from math import isnan

from core.explain.digits import spoken
from core.explain.formulas import below, concludes, first_of, formula_of, named
from core.explain.rows import Said, explains
from core.explain.statements import Chain
from core.explain.step_values import StepValues
from core.explain.variable_text import VariableText, shows
from core.records.terms import term

MOST = 3
"""Cross products that are written out."""
SHAPES = {3: "a triangle", 4: "a quadrilateral", 5: "a pentagon", 6: "a hexagon", 7: "a heptagon"}
FULL = 1 - 2.0**-40
"""Area in pixels from which a pixel counts as whole: sums of areas are rounded."""


def _corners(step: StepValues, name: str) -> list[list[float]]:
    """Return the corners of a polygon."""
    return [corner for corner in step.rows(name) if not isnan(corner[0])]


@explains("resolve.cut.distances")
def distances(step: StepValues) -> Said:
    """The edge function at the corner that lies farthest beyond the edge, or nearest to it."""
    corners, edge = _corners(step, "before"), step.whole("edge")
    values = step.vector("corner_distance")[: len(corners)]
    outside = sum(value < 0 for value in values)
    name = f"edge {edge} of triangle {step.triangle}"
    text = f"{step.pixel_name}: no corner lies beyond {name}, so it cuts nothing off."
    if outside:
        verb = "lies" if outside == 1 else "lie"
        text = f"{step.pixel_name}: {outside} of {len(values)} corners {verb} beyond {name}, where it is negative."
    worst = min(range(len(corners)), key=lambda k: values[k])
    a, b, centre = (step.named(key, symbol) for key, symbol in (("a", "a"), ("b", "b"), ("value", "E_c")))
    x, y = map(named, "xy", corners[worst])
    return text, formula_of(named(f"E_{edge}", values[worst]).equals(a * x + b * y + centre))


@explains("resolve.cut.cut")
def cut(step: StepValues) -> Said:
    """The rest of the polygon; where the first side that goes out crosses the edge."""
    count = step.whole("corner_count")
    left = SHAPES[count] if count else "nothing of it that has an area"
    text = f"{step.pixel_name}: edge {step.whole('edge')} of triangle {step.triangle} leaves {left}."
    distance = step.vector("corner_distance")[: len(_corners(step, "before"))]
    for here, there in zip(distance, [*distance[1:], *distance[:1]], strict=True):
        if here > 0 > there:
            start, end = named(below("E", "start"), here), named(below("E", "end"), there)
            return text, formula_of(named("t", here / (here - there)).equals(start / (start - end)))
    test, found = named(below("E", "least"), min(distance)).compared(r"\ge"), "all stays"
    if min(distance) < 0:
        test, found = named(below("E", "greatest"), max(distance)).compared(r"\le"), "nothing stays"
    return text, formula_of(concludes(found, found, test))


@explains("resolve.piece.area")
def area(step: StepValues) -> Said:
    """Twice the area, the sum of the cross products of the vectors from the first corner to the others."""
    count, value = step.whole("corner_count"), step.number("piece_area")
    text = f"{step.pixel_name}: triangle {step.triangle} "
    if not count:
        text += "touches it at most in a point or along a side, which has no area."
    elif value == 1:
        text += "covers all of its square."
    else:
        text += f"covers {SHAPES[count]} of it, and half the sum of the cross products is its area, {spoken(value)}."
    corners = _corners(step, "polygon")
    if not corners:
        return text, formula_of(named("A", 0).equals(0))
    x0, y0 = corners[0]
    cross = [(x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0) for (x1, y1), (x2, y2) in pairwise(corners[1:])]
    products = [named(rf"d_{place + 1} \times d_{place + 2}", product) for place, product in enumerate(cross)]
    return text, formula_of(named("2 A", 2 * value).equals(first_of(products, MOST)))


@explains("resolve.piece.seen")
def seen(step: StepValues) -> Said:
    """How much of it passes the depth test: at most all of it."""
    front, whole = step.number("seen_area"), step.number("piece_area")
    text = f"shows {spoken(front)} of the pixel, and the rest of it lies behind earlier triangles."
    if not front:
        text = "is hidden: it is in front of nothing here."
    elif front >= whole * FULL:
        text = f"is in front of all earlier triangles, and shows {spoken(front)} of the pixel."
    seen_of = Chain((named(below("A", "front"), front), named("A", max(whole, front))), (r"\le",))
    return f"{step.pixel_name}: triangle {step.triangle} {text}", formula_of(seen_of)


@explains("resolve.piece.cover")
def cover(step: StepValues) -> Said:
    """How much of the pixel triangles cover so far; the background is seen in the rest."""
    value = step.number("covered_area")
    text = (
        f"{step.pixel_name}: triangles cover {spoken(value)} of it so far, and the rest shows the background."
    )
    if value >= FULL:
        text = f"{step.pixel_name}: triangles cover all of it."
    covered = min(value, 1.0)
    both = named(below("A", "covered"), covered) + named(below("A", "background"), 1 - covered)
    return text, formula_of(Chain((both, term(1)), ("=",)))


shows(
    "resolve",
    {
        "edge": VariableText("edge", "Number of the edge that cuts."),
        "a": VariableText("a", "Change of the edge function per pixel to the right."),
        "b": VariableText("b", "Change of the edge function per pixel upwards."),
        "value": VariableText("E at centre", "Value of the edge function at the pixel's centre."),
        "before": VariableText(
            "corner #",
            "Corner of the polygon before the cut, x and y from the pixel's centre.",
            spread="corners",
        ),
        "corner_distance": VariableText(
            "E at corner #", "Edge function at the corner: positive is inside.", spread="corners"
        ),
        "polygon": VariableText(
            "remaining corner #",
            "Corner of the polygon after the cut, x and y from the pixel's centre.",
            spread="corners",
        ),
        "corner_count": VariableText("corners", "Corners after the cut; 0: nothing that has an area."),
        "piece_area": VariableText("A", "Area after the cuts, in pixels."),
        "primitive": VariableText(
            "drawing number", "Index of the triangle in drawing order, with pieces counted separately."
        ),
        "part_area": VariableText(
            "part #",
            "Area of the pixel that a triangle, or the background, shows so far; 0: none.",
            spread="parts",
        ),
        "part_primitive": VariableText(
            "part # shows", "Index of its triangle in drawing order; −1: the background.", spread="parts"
        ),
        "untold_cuts": VariableText(
            "cuts left out",
            "Number of cuts in this pixel, too many to step through. Trace one triangle, or a smaller part of the "
            "picture, to step through them.",
        ),
        "seen_area": VariableText("A front", "Part of the area that is in front of earlier triangles."),
        "covered_area": VariableText("A covered", "Area of the pixel that shows any triangle so far."),
    },
)
