"""Resolving, told step by step: areas that edges leave, sums over pieces, weighted means of samples, display bytes.

Of many samples those of equal colour are one summand; of more than `MOST` colours the largest are written out.
"""

import math
from itertools import pairwise
from math import isnan

from core.explain.formulas import (
    CHANNEL_LETTERS,
    HALF,
    Chain,
    below,
    call,
    concludes,
    first_of,
    formula_of,
    in_channel,
    letter_of,
    named,
    outstanding,
    slash,
)
from core.explain.number_text import remainder_note, spoken, vector_text
from core.explain.records import Asked, Formula, number
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.framebuffer.display import SRGB_LIMIT, SRGB_OFFSET, SRGB_SCALE, SRGB_SLOPE
from core.records.terms import term
from core.records.words import counted, noun_of

# Exact areas: edges cut the square of a pixel, cross products give the area of the rest, depth decides the
# order.


MOST_PRODUCTS = 3
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
    return text, formula_of(named("2 A", 2 * value).equals(first_of(products, MOST_PRODUCTS)))


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


# Resolving: weighted means of samples, sums over pieces of exact area, and display bytes.


NAMES = "abcdefghijklmnopqrstuvwxyz"
"""Names of different samples: 0, 1 and 2 are corners."""
MOST_COLORS = 4
"""Summands that are written out."""


def _channel(step: StepValues) -> int:
    """Return the channel in which the samples differ most."""
    kept = zip(step.rows("samples"), step.vector("sample_weights"), strict=True)
    rows = [row for row, weight in kept if weight > 0]
    spans = []
    for channel in range(3):
        finite = [row[channel] for row in rows if abs(row[channel]) < math.inf]
        spans.append(max(finite, default=0.0) - min(finite, default=0.0))
    return max(range(3), key=lambda channel: spans[channel])


def _weights(step: StepValues) -> list[tuple[float, float]]:
    """Return the weights of the different values of the channel, the greatest first."""
    found: dict[str, tuple[float, float]] = {}
    channel = _channel(step)
    for row, weight in zip(step.rows("samples"), step.vector("sample_weights"), strict=True):
        if weight > 0:
            value = row[channel] + 0.0
            known = found.get(repr(value), (0.0, value))
            found[repr(value)] = (known[0] + weight, known[1])
    return sorted(found.values(), key=lambda known: -known[0])


def _together(step: StepValues, whole: str, part: str) -> Formula:
    """Return the sum of weights, or of areas."""
    weights = [weight for weight, _ in _weights(step)]
    parts = [named(f"{part}_{{{NAMES[k % 26]}}}", weight) for k, weight in enumerate(weights)]
    return formula_of(named(whole, sum(weights)).equals(first_of(parts, MOST_COLORS)))


@explains("resolve.average.samples")
def samples(step: StepValues) -> Said:
    """The samples of a pixel and their weights."""
    weights, triangles = step.vector("sample_weights"), step.vector("sample_triangle")
    kept = [triangle for weight, triangle in zip(weights, triangles, strict=True) if weight > 0]
    covered = sum(triangle >= 0 for triangle in kept)
    shown = sorted({int(triangle) for triangle in kept if triangle >= 0})
    names = ", ".join(map(str, shown[:6])) + (" …" if len(shown) > 6 else "")
    what = (
        f"{covered} of {counted(len(kept), 'sample')}" if covered < len(kept) else f"all {len(kept)} samples"
    )
    seen = (
        f"{what} show {noun_of(len(shown), step.nouns.one)} {names}"
        if covered
        else f"no sample shows a {step.nouns.one}"
    )
    text = f"{step.pixel_name}: {seen}; their weights add up to {spoken(sum(weights))}."
    return text, _together(step, "W", "w")


@explains("resolve.average.divide")
def averaged(step: StepValues) -> Said:
    """The weighted mean."""
    channel, color, weights = _channel(step), step.vector("linear"), _weights(step)
    text = f"{step.pixel_name}: the weighted mean of its samples is {vector_text(color)}, in linear light"
    text += f"{remainder_note(color)}."
    letter, whole = CHANNEL_LETTERS[channel], named("W", sum(weight for weight, _ in weights))
    terms = [
        named(f"w_{name}", weight) / whole * named(f"{letter}_{name}", value)
        for name, (weight, value) in zip(NAMES, weights, strict=False)
    ]
    return text, formula_of(letter_of(color, channel).equals(first_of(terms, MOST_COLORS)))


@explains("resolve.areas.samples")
def pieces(step: StepValues) -> Said:
    """The pieces of a pixel and their areas."""
    areas, triangles = step.vector("sample_weights"), step.vector("sample_triangle")
    parts = [(area, int(triangle)) for area, triangle in zip(areas, triangles, strict=True) if area > 0]
    covered = sum(area for area, triangle in parts if triangle >= 0)
    made = "it is one piece" if len(parts) == 1 else f"edges cut it into {len(parts)} pieces"
    text = f"{step.pixel_name}: {made}, and {step.nouns.many} cover {spoken(covered)} of its area"
    if step.has("untold_cuts"):
        text += f"; to step through the cuts, trace one {step.nouns.one} or a smaller part of the picture"
    return f"{text}.", _together(step, "A", "A")


@explains("resolve.areas.divide")
def summed(step: StepValues) -> Said:
    """The sum of areas times colours."""
    channel, color = _channel(step), step.vector("linear")
    text = (
        f"{step.pixel_name}: the colours of its pieces, each times its area, add up to {vector_text(color)}, "
        "in linear light."
    )
    letter = CHANNEL_LETTERS[channel]
    terms = [
        named(f"A_{name}", area) * named(f"{letter}_{name}", value)
        for name, (area, value) in zip(NAMES, _weights(step), strict=False)
    ]
    return text, formula_of(letter_of(color, channel).equals(first_of(terms, MOST_COLORS)))


@explains("resolve.*.clip")
def clipped(step: StepValues) -> Said:
    """Colours clamped to 0 to 1."""
    linear, clamped = step.vector("linear"), step.vector("clipped")
    shown, result = vector_text(linear), vector_text(clamped)
    text = f"the linear colour {result} is between 0 and 1 already"
    if any(map(math.isnan, linear)):
        text = f"the colour {shown} has a NaN, which is shown as 0: {result}"
    elif min(linear[:3]) < 0 or max(linear[:3]) > 1:
        text = f"the colour {shown} is clamped to 0 to 1: {result}"
    channel = outstanding(clamped)
    limited = call("min", call("max", letter_of(linear, channel), 0), 1)
    made = named(f"c_{CHANNEL_LETTERS[channel]}", clamped[channel]).equals(limited)
    return f"{step.pixel_name}: {text}{remainder_note(clamped)}.", formula_of(made)


@explains("resolve.*.encode")
def encoded(step: StepValues) -> Said:
    """The sRGB curve, the part that the value is on."""
    color, clamped = step.vector("encoded"), step.vector("clipped")
    text = f"{step.pixel_name}: the sRGB curve turns the linear colour into {vector_text(color)}"
    text += f"{remainder_note(color)}."
    channel = outstanding(clamped)
    letter = CHANNEL_LETTERS[channel]
    s, c = named(f"s_{letter}", color[channel]), named(f"c_{letter}", clamped[channel])
    if c.value <= SRGB_LIMIT:
        return text, formula_of(s.equals(SRGB_SLOPE * c))
    return text, formula_of(s.equals(SRGB_SCALE * c ** slash(1, 2.4) - SRGB_OFFSET))


def red_byte(step: StepValues) -> Asked | None:
    """Ask for the byte of red."""
    byte = step.vector("bytes")[0]
    return number(f"Which byte does red become at {step.the_pixel}?", byte, f"red is {int(byte)}.")


@explains("resolve.*.round", asks=red_byte)
def rounded(step: StepValues) -> Said:
    """Display bytes."""
    *color, alpha = stored = step.vector("bytes")
    text = f"{step.pixel_name} is displayed as the bytes {vector_text(color)}, with alpha {spoken(alpha)}."
    channel = outstanding(step.vector("clipped"))
    s = named(f"s_{CHANNEL_LETTERS[channel]}", step.vector("encoded")[channel])
    return text, formula_of(in_channel("byte", stored, channel).equals(call("floor", 255 * s + HALF)))


shows(
    "resolve",
    {
        "samples": VariableText(
            "colour #", "Linear red, green, blue, alpha of the sample or piece.", spread="parts"
        ),
        "sample_weights": VariableText(
            "weight #", "Weight of the sample, or the area of the piece.", spread="parts"
        ),
        "linear": VariableText("linear", "Linear red, green, blue, alpha of the colour buffer."),
        "clipped": VariableText("c (clamped)", "Red, green, blue between 0 and 1."),
        "encoded": VariableText("s (sRGB)", "Red, green, blue on the sRGB curve."),
        "bytes": VariableText("bytes", "Red, green, blue, alpha from 0 to 255."),
    },
)
