"""The depth test, told step by step: what each format stores, the comparison, integer planes and packed keys."""

import math
from fractions import Fraction

from core.depth.fixed_depth import NUMBER_BITS
from core.explain.formulas import (
    Chain,
    Named,
    below,
    call,
    concludes,
    formula_of,
    named,
    relation,
    slash,
    upright,
)
from core.explain.number_text import pair_text, spoken, steps_apart
from core.explain.records import Asked, Formula, choice
from core.explain.step_values import Said, StepValues, explains, key_fields
from core.explain.steps import GIVEN, VariableText, hides, shows
from core.explain.term_latex import TermLatex, Written
from core.records.terms import Operation, term

# The depth test: what each format stores of a fragment, the comparison, and what the buffer holds then.


QUANTITIES = {
    "z": ("z", "z", "depth"),
    "inverse-w": ("1/w", r"\frac{1}{w}", "inverse_w"),
    "reversed-z": ("reversed z", "r", "value"),
    "logarithm": ("logarithmic depth", "l", "value"),
    "whole depth": ("depth", "z", "stored"),
    "whole 1/w": ("1/w", r"\frac{1}{w}", "stored"),
}
"""Quantity of the depth buffer to its name, its symbol and the variable that holds it."""


def quantity_of(step: StepValues) -> tuple[str, str, str]:
    """Return the quantity of the depth buffer: its name, its symbol and its variable."""
    quantity = step.text("quantity")
    return QUANTITIES.get(quantity, (quantity.replace("-", " "), "q", "value"))


def held_name(step: StepValues, where: str) -> tuple[str, str]:
    """Return symbol and label of a stored depth: of the ``new`` one, or of that in the ``buffer``."""
    if step.has("origin"):
        return ("d", "d") if where == "new" else (r"d_{\mathrm{buffer}}", "d buffer")
    name, symbol, _ = quantity_of(step)
    below = rf"\mathrm{{{where}}}"
    if name == "1/w":
        return rf"\frac{{1}}{{w_{{{below}}}}}", f"1/w {where}"
    return rf"{symbol}_{{{below}}}", f"{symbol} {where}"


@explains("depth.*.value")
def value_made(step: StepValues) -> Said:
    """The number that is stored instead of z, before it is rounded."""
    value, depth = step.number("value"), spoken(step.number("depth"))
    name, symbol, _ = quantity_of(step)
    text, made = f"its {name} is {spoken(value)} (z = {depth})", formula_of(named(symbol, value))
    if name == "logarithmic depth":
        inverse_w, near, far = step.number("inverse_w"), step.named("near", "n"), step.named("far", "f")
        text = (
            f"on a scale of octaves from w = {near} to w = {far}, "
            f"1/w = {spoken(inverse_w)} is at {spoken(value)} (z = {depth})"
        )
        w = named("w", 1 / inverse_w if inverse_w else math.inf)
        made = formula_of(
            named(symbol, value).equals(call("log2", slash(w, near)) / call("log2", slash(far, near)))
        )
    elif name == "reversed z":
        where = "along the outline" if step.has("t") else f"on the {step.nouns.one}'s plane"
        text = f"{where}, from 1 at the near to 0 at the far plane, the reversed z is {spoken(value)} (z = {depth})"
        made = _reversed(step, value)
    return f"{step.pixel_name}: {text}.", made


def _reversed(step: StepValues, value: float) -> Formula:
    """Return the reversed depth along a line, or on the plane of a triangle."""
    r = named("r", value)
    if not step.has("t"):
        a, b, c, x, y = (step.named(name, name) for name in "abcxy")
        return formula_of(r.equals(a * x + b * y + c))
    t, (start, end) = step.named("t", "t"), map(named, ("r_0", "r_1"), step.vector("ends"))
    return formula_of(r.equals((1 - t) * start + t * end))


@explains("depth.*.depth")
def stored(step: StepValues) -> Said:
    """What the depth format stores of a fragment."""
    value, (name, symbol, variable) = step.number("stored"), quantity_of(step)
    before = step.number(variable)
    if variable == "stored":
        text = f"{step.pixel_name}: the cell of {step.name} holds {spoken(value)}."
        return text, formula_of(named(held_name(step, "new")[0], value))
    if name == "z":
        of_steps = f" of {step.whole('scale')} steps" if step.has("scale") else ""
        text = f"{step.pixel_name}: its depth z = {spoken(before)} is stored as {spoken(value)}{of_steps}."
    elif name == "1/w":
        text = f"{step.pixel_name}: its 1/w = {spoken(before)} is stored as {spoken(value)}."
    else:
        limited = "" if 0 <= before <= 1 else "limited to 0 to 1 and "
        text = (
            f"{step.pixel_name}: {name} {spoken(before)} is {limited}stored as the float32 {spoken(value)}."
        )
    exact = named(symbol, before)
    kept = call("float32", exact)
    if step.has("origin"):
        kept = call("round", term(2) ** 38 * exact)
    elif name == "z" and step.has("scale"):
        kept = call("round", step.named("scale", upright("steps")) * exact)
    return text, formula_of(named(held_name(step, "new")[0], value).equals(kept))


def passes(step: StepValues) -> Asked:
    """Ask whether a fragment passes."""
    new, old = pair_text(step.number("stored"), step.number("before"))
    is_kept = step.flag("passes")
    return choice(
        f"The buffer holds {old} at {step.the_pixel}. Does {new} pass?",
        0 if is_kept else 1,
        f"{new} against {old}{_apart(step)}: it {'passes' if is_kept else 'fails'}.",
    )


def _apart(step: StepValues) -> str:
    """Return in brackets how many steps of the format a fragment and the buffer are apart, if that is few."""
    text = steps_apart(step.number("stored"), step.number("before"), step.has("scale"))
    return f" ({text})" if text else ""


_THAN = {
    "<": "smaller than",
    "≤": "smaller than or equal to",
    ">": "larger than",
    "≥": "larger than or equal to",
}
"""What a comparison is called inside a sentence."""


@explains("depth.*.compare", asks=passes, decides=True)
def compared(step: StepValues) -> Said:
    """The depth test."""
    new, old = step.number("stored"), step.number("before")
    shown, shown_before, name = spoken(new), spoken(old), quantity_of(step)[0]
    if step.has("comparison"):
        holds, outcome = ("", "passes") if step.flag("passes") else ("not ", "fails")
        text = f"{outcome}: {shown} is {holds}{_THAN[step.text('comparison')]} the buffer's {shown_before}."
    elif math.isnan(new) or math.isnan(old):
        text = f"fails: its {name}, {shown}, cannot be compared with the buffer's {shown_before}."
    elif new == old:
        text = f"fails: its {name}, {shown}, equals the buffer's, and a tie keeps the stored depth."
    else:
        verdict, outcome = ("passes", "nearer") if step.flag("passes") else ("fails", "hidden")
        than = "larger" if new > old else "smaller"
        text = (
            f"{verdict}: its {name}, {shown}, is {than} than the buffer's {shown_before}"
            f"{_apart(step)}, so it is {outcome}."
        )
    wanted = ">" if step.flag("larger_is_nearer") else "<"
    if step.has("comparison"):
        wanted = {"≤": r"\le", "≥": r"\ge"}.get(step.text("comparison"), step.text("comparison"))
    test = named(held_name(step, "new")[0], new).compared(wanted, named(held_name(step, "buffer")[0], old))
    made = concludes("passes", "passes" if step.flag("passes") else "fails", test)
    return f"{step.pixel_name} {text}", formula_of(made)


@explains("depth.*.write")
def written(step: StepValues) -> Said:
    """What the depth buffer holds after the test."""
    after, before = spoken(step.number("after")), spoken(step.number("before"))
    if step.flag("passes") and not step.flag("writes"):
        return _not_stored(step)
    if step.flag("passes"):
        text = f"now holds {after}, of {step.name}, instead of {before}."
    else:
        text = f"keeps {before}, and {step.name} is hidden here."
    return f"{step.pixel_name}: the depth buffer {text}"


@explains("depth.store.write")
def untested(step: StepValues) -> Said:
    """A fragment written without a test."""
    if not step.flag("writes"):
        return _not_stored(step)
    after, before = pair_text(step.number("after"), step.number("before"))
    return f"{step.pixel_name}: without a depth test {after} replaces {before} in the depth buffer."


def _not_stored(step: StepValues) -> str:
    """A pale pixel of a line, whose depth is not stored."""
    return (
        f"{step.pixel_name}: the depth buffer keeps {spoken(step.number('before'))}, as the line covers less than "
        "half of this pixel and must not hide what is drawn there later."
    )


@explains("depth.*.range")
def out_of_range(step: StepValues) -> Said:
    """A fragment in front of the near or behind the far plane."""
    z, depth = step.named("depth", "z"), step.number("depth")
    why = "below 0: in front of the near plane" if depth < 0 else "above 1: behind the far plane"
    why = "which is not a number" if math.isnan(depth) else why
    made = concludes("kept", "dropped", z.compared(r"\ge"), z.compared(r"\le", 1))
    return f"{step.pixel_name} is dropped: its depth z is {z}, {why}.", formula_of(made)


@explains("depth.discarded.discard")
def discarded(step: StepValues) -> Said:
    """A fragment that the scene's fragment shader ended."""
    return f"{step.pixel_name} is dropped: the fragment shader discarded this fragment."


shows(
    "depth",
    {
        "depth": VariableText("z", "Window depth: 0 is near, 1 is far."),
        "m": VariableText("m", "2 x − W: the ray's x/w is m/W.", "depth"),
        "n": VariableText("n", "2 y − H: the ray's y/w is n/H.", "depth"),
        "x": VariableText("x", "x of the pixel's centre, in pixels.", "depth"),
        "y": VariableText("y", "y of the pixel's centre, in pixels.", "depth"),
        "a": VariableText("a", "Change of the value per step to the right.", "depth"),
        "b": VariableText("b", "Change of the value per step upwards.", "depth"),
        "c": VariableText("c", "Value where both coordinates are 0.", "depth"),
        "d": VariableText("d", "Determinant of the corners' x, y and w.", "depth"),
        "t": VariableText("t", "Position along the line: 0 at the first end, 1 at the second.", "depth"),
        "ends": VariableText("r₀, r₁", "Reversed z at both ends of the line.", "depth"),
        "scale": VariableText("steps", "The whole number that depth 1 is stored as.", GIVEN),
        "near": VariableText("n (near)", "w at which the logarithmic depth is 0.", GIVEN),
        "far": VariableText("f (far)", "w at which the logarithmic depth is 1.", GIVEN),
        "nearness": VariableText("v", "Where the ray meets the triangle: 1/w or −z/w, larger is nearer."),
        "error": VariableText("e", "Bound of the rounding error of v."),
        "nearest": VariableText("nearest", "Number of the nearest triangle on the ray so far; −1: none."),
        "nearest_nearness": VariableText("v nearest", "Where the ray meets the nearest triangle so far."),
        "nearest_error": VariableText("e nearest", "Bound of the rounding error of v nearest."),
        "sign": VariableText("sign", "1: nearer than the nearest so far, −1: farther, 0: equally near."),
        "value": VariableText(
            lambda step: quantity_of(step)[1], "Value to store instead of z, before rounding."
        ),
        "inverse_w": VariableText("1/w", "One over w at the pixel.", "stored"),
        "stored": VariableText(
            lambda step: held_name(step, "new")[1], "What the depth format stores of the fragment."
        ),
        "number": VariableText("number", "Number of the triangle; its key holds one more.", "key"),
        "key": VariableText("key", "Depth above, number plus one below, in one whole number.", is_key=True),
        "before_key": VariableText("key before", "Key in the buffer; the smaller one stays.", is_key=True),
        "before": VariableText(lambda step: held_name(step, "buffer")[1], "What the depth buffer held."),
        "passes": VariableText("passes", "Whether the fragment is kept."),
        "after": VariableText("depth buffer", "What the depth buffer holds.", previous="before"),
        "after_key": VariableText(
            "key in buffer", "The smaller of both keys.", previous="before_key", is_key=True
        ),
        "origin": VariableText("origin", "Depth at column 0, row 0, in units of 2⁻³⁸.", "stored"),
        "across": VariableText("across", "Change of the depth per column, in units of 2⁻³⁸.", "stored"),
        "up": VariableText("up", "Change of the depth per row, in units of 2⁻³⁸.", "stored"),
    },
)
hides("depth.rounded|out-of-range|store", ("origin", "across", "up"))
hides("depth.cell", ("depth", "inverse_w"))


# Depth on integer planes, and packed keys: depth above the number of the triangle, compared as one whole
# number.


_NEW, _BUFFER = below(upright("key"), "new"), below(upright("key"), "buffer")
_SLACK, _DEPTHS = term(2) ** 20, term(2) ** 38


def _whole(step: StepValues, name: str) -> str:
    """Write a whole number in full, with a true minus sign."""
    return f"{step.whole(name):,}".replace("-", "−")


def key_text(key: int) -> str:
    """Write a packed key in hexadecimal."""
    return " | ".join(key_fields(key))


def _key(symbol: str, key: int) -> Written:
    depth, number = map(upright, key_fields(key))
    return Written(symbol, rf"{depth} \, | \, {number}")


def _holder(step: StepValues, key: int) -> str:
    """Say whose key it is."""
    number = key & ((1 << NUMBER_BITS) - 1)
    return step.named_primitive(number - 1) if number else "the empty buffer"


@explains("depth.*.plane")
def plane(step: StepValues) -> Said:
    """Depth as an integer plane."""
    on_plane = sum(step.whole(of) * step.whole(by) for of, by in (("across", "column"), ("up", "row")))
    on_plane += step.whole("origin")
    if on_plane != step.whole("stored"):
        return _limited(step, on_plane)
    text = (
        f"{step.pixel_name}: on the {step.nouns.one}'s integer plane the depth is {_whole(step, 'stored')} of "
        f"2³⁸ (z = {spoken(step.number('depth'))})."
    )
    return text, formula_of(step.named("stored", "d").equals(_on_plane(step)))


def _on_plane(step: StepValues) -> Operation:
    across, column, up, row, origin = map(step.upright, ("across", "column", "up", "row", "origin"))
    return across * column + up * row + origin


def _limited(step: StepValues, on_plane: int) -> Said:
    """A depth on the plane far outside the triangle, where it leaves the range of the keys."""
    text = (
        f"{step.pixel_name}: this pixel lies outside the {step.nouns.one}, where its integer plane is at "
        f"{on_plane:,} of 2³⁸; the depth is limited to −2²⁰ … 2³⁸ + 2²⁰, which gives {_whole(step, 'stored')}."
    ).replace("-", "−")
    there = Named(TermLatex(False).text(_on_plane(step)), Fraction(on_plane))
    limited = call("min", call("max", there, -_SLACK), _DEPTHS + _SLACK)
    return text, formula_of(step.named("stored", "d").equals(limited))


@explains("depth.rounded.depth")
def rounded(step: StepValues) -> Said:
    """Depth that is rounded at the pixel."""
    z = step.named("depth", "z")
    text = (
        f"{step.pixel_name}: {step.name} has no integer plane, so z = {z} is rounded here, "
        f"to {_whole(step, 'stored')} of 2³⁸."
    )
    return text, formula_of(step.named("stored", "d").equals(call("round", _DEPTHS * z)))


@explains("depth.*.key")
def key(step: StepValues) -> Said:
    """Depth and triangle packed into a key; the slack of 2^20 keeps it from being negative."""
    number, packed = step.whole("number"), step.whole("key")
    text = (
        f"{step.pixel_name}: its key is {key_text(packed)}, the depth above the lower 24 bits, "
        f"which hold the number of {step.named_primitive(number)} plus one."
    )
    made = (named("d", step.whole("stored")) + _SLACK) * term(2) ** NUMBER_BITS + (named("n", number) + 1)
    return text, formula_of(Chain((_key(_NEW, packed), made), ("=",)))


@explains("depth.*.minimum", asks=passes, decides=True)
def minimum(step: StepValues) -> Said:
    """The depth test as the minimum of two keys."""
    new, old = step.whole("key"), step.whole("before_key")
    there = _holder(step, old)
    if new < old:
        text = f"passes: its key is less than the buffer's {key_text(old)}, of {there}"
    elif new >> NUMBER_BITS == old >> NUMBER_BITS:
        text = f"fails: the depths tie, and {there} has the lower number, as it came first"
    else:
        text = f"fails: the buffer's key, {key_text(old)} of {there}, is smaller"
    test = Chain((_key(_NEW, new), _key(_BUFFER, old)), (("<", relation(float(new - old))),))
    made = concludes("passes", "passes" if step.flag("passes") else "fails", test)
    return f"{step.pixel_name} {text}.", formula_of(made)


@explains("depth.rounded.write")
def key_written(step: StepValues) -> Said:
    """The key in the buffer after the test."""
    after = step.whole("after_key")
    verb = "now holds" if step.flag("passes") else "keeps"
    text = f"the buffer {verb} the smaller key, {key_text(after)}, of {_holder(step, after)}"
    if step.flag("passes") and not step.flag("writes"):
        held = f"{key_text(after)}, of {_holder(step, after)}"
        text = f"the buffer keeps {held}, as the line covers under half of the pixel"
    upper = rf"\lfloor \min({_NEW}, {_BUFFER}) / 2^{{{NUMBER_BITS}}} \rfloor"
    kept = Written(upper, upright(key_fields(after)[0]))
    made = step.named("after", below("d", "buffer")).equals(kept - _SLACK)
    return f"{step.pixel_name}: {text}.", formula_of(made)


@explains("depth.plane.write")
def plane_written(step: StepValues) -> Said:
    """A depth on a plane that is written without a test."""
    text = (
        f"{step.pixel_name}: without a depth test {_whole(step, 'after')} replaces {_whole(step, 'before')} "
        "in the depth buffer."
    )
    return text, formula_of(step.named("after", below("d", "buffer")).equals(step.named("stored", "d")))
