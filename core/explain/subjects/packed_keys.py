"""Depth on integer planes, and packed keys: depth above the number of the triangle, compared as one whole number."""

from fractions import Fraction

from core.explain.digits import spoken
from core.explain.formulas import Named, below, call, concludes, formula_of, named, relation, upright
from core.explain.rows import Said, explains
from core.explain.statements import Chain
from core.explain.step_values import StepValues, key_fields
from core.explain.subjects.depth import passes
from core.explain.term_latex import TermLatex, Written
from core.framebuffer.packed_keys import NUMBER_BITS
from core.records.terms import Operation, term

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
