"""Depth on integer planes, and packed keys: depth above the number of the triangle, compared as one whole number."""

from core.explain.digits import number_latex, spoken
from core.explain.equation import conclusion, equation, linear, relation
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues, key_fields
from core.explain.subjects.depth import passes
from core.framebuffer.packed_keys import NUMBER_BITS

_NEW, _BUFFER = r"\mathrm{key}_{\mathrm{new}}", r"\mathrm{key}_{\mathrm{buffer}}"


def _whole(step: StepValues, name: str) -> str:
    """Write a whole number in full, with a true minus sign."""
    return f"{step.whole(name):,}".replace("-", "−")


def key_text(key: int) -> str:
    """Write a packed key in hexadecimal."""
    return " | ".join(key_fields(key))


def _key_latex(key: int) -> str:
    depth, number = key_fields(key)
    return rf"\mathrm{{{depth}}} \, | \, \mathrm{{{number}}}"


def _holder(key: int) -> str:
    """Say whose key it is."""
    number = key & ((1 << NUMBER_BITS) - 1)
    return f"triangle {number - 1}" if number else "the empty buffer"


@explains("depth.*.plane")
def plane(step: StepValues) -> Said:
    """Depth as an integer plane."""
    on_plane = sum(step.whole(of) * step.whole(by) for of, by in (("across", "column"), ("up", "row")))
    on_plane += step.whole("origin")
    if on_plane != step.whole("stored"):
        return _limited(step, on_plane)
    text = (
        f"{step.pixel_name}: on the triangle's integer plane the depth is {_whole(step, 'stored')} of "
        f"2³⁸ (z = {spoken(step.number('depth'))})."
    )
    slopes = [(rf"\mathrm{{{name}}}", step.number(name)) for name in ("across", "up", "origin")]
    place = ((rf"\mathrm{{{name}}}", step.number(name)) for name in ("column", "row"))
    return text, linear("d", step.number("stored"), slopes, *place)


def _limited(step: StepValues, on_plane: int) -> Said:
    """A depth on the plane far outside the triangle, where it leaves the range of the keys."""
    text = (
        f"{step.pixel_name}: this pixel lies outside the triangle, where its integer plane is at "
        f"{on_plane:,} of 2³⁸; the depth is limited to −2²⁰ … 2³⁸ + 2²⁰, which gives {_whole(step, 'stored')}."
    ).replace("-", "−")
    symbols, numbers = (
        rf"\min(\max({on}, -2^{{20}}), 2^{{38}} + 2^{{20}})"
        for on in (
            r"\mathrm{across} \cdot \mathrm{column} + \mathrm{up} \cdot \mathrm{row} + \mathrm{origin}",
            str(on_plane),
        )
    )
    return text, equation(("d", step.number("stored")), "=", (symbols, numbers))


@explains("depth.rounded.depth")
def rounded(step: StepValues) -> Said:
    """Depth that is rounded at the pixel."""
    depth = step.number("depth")
    text = (
        f"{step.pixel_name}: triangle {step.triangle} has no integer plane, so z = {spoken(depth)} is rounded here, "
        f"to {_whole(step, 'stored')} of 2³⁸."
    )
    numbers = rf"\mathrm{{round}}(2^{{38}} \cdot {number_latex(depth)})"
    return text, equation(("d", step.number("stored")), "=", (r"\mathrm{round}(2^{38} \cdot z)", numbers))


@explains("depth.*.key")
def key(step: StepValues) -> Said:
    """Depth and triangle packed into a key; the slack of 2^20 keeps it from being negative."""
    number, packed = step.whole("number"), step.whole("key")
    text = (
        f"{step.pixel_name}: its key is {key_text(packed)}, the depth above the lower 24 bits, "
        f"which hold the number of triangle {number} plus one."
    )
    depth = (r"(d + 2^{20})", rf"({step.whole('stored')} + 2^{{20}})")
    terms = (depth, r"\cdot", rf"2^{{{NUMBER_BITS}}}", "+", (r"(n + 1)", f"({number} + 1)"))
    return text, equation((_NEW, _key_latex(packed)), "=", *terms)


@explains("depth.*.minimum", asks=passes, decides=True)
def minimum(step: StepValues) -> Said:
    """The depth test as the minimum of two keys."""
    new, old = step.whole("key"), step.whole("before_key")
    there = _holder(old)
    if new < old:
        text = f"passes: its key is less than the buffer's {key_text(old)}, of {there}"
    elif new >> NUMBER_BITS == old >> NUMBER_BITS:
        text = f"fails: the depths tie, and {there} has the lower number, as it came first"
    else:
        text = f"fails: the buffer's key, {key_text(old)} of {there}, is smaller"
    return f"{step.pixel_name} {text}.", equation(
        (_NEW, _key_latex(new)),
        ("<", relation(float(new - old))),
        (_BUFFER, _key_latex(old)),
        *conclusion("passes", "passes" if step.flag("passes") else "fails"),
    )


@explains("depth.rounded.write")
def key_written(step: StepValues) -> Said:
    """The key in the buffer after the test."""
    after = step.whole("after_key")
    verb = "now holds" if step.flag("passes") else "keeps"
    text = f"the buffer {verb} the smaller key, {key_text(after)}, of {_holder(after)}"
    if step.flag("passes") and not step.flag("writes"):
        text = f"the buffer keeps {key_text(after)}, of {_holder(after)}, as the line covers under half of the pixel"
    kept = (
        rf"\lfloor \min({_NEW}, {_BUFFER}) / 2^{{{NUMBER_BITS}}} \rfloor",
        rf"\mathrm{{{key_fields(after)[0]}}}",
    )
    made = equation((r"d_{\mathrm{buffer}}", step.number("after")), "=", kept, "-", "2^{20}")
    return f"{step.pixel_name}: {text}.", made


@explains("depth.plane.write")
def plane_written(step: StepValues) -> Said:
    """A depth on a plane that is written without a test."""
    text = (
        f"{step.pixel_name}: without a depth test {_whole(step, 'after')} replaces {_whole(step, 'before')} "
        "in the depth buffer."
    )
    return text, equation((r"d_{\mathrm{buffer}}", step.number("after")), "=", ("d", step.number("stored")))
