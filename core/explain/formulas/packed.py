"""The formulas of depth on integer planes and of packed keys."""

from collections.abc import Callable, Mapping

from core.explain.formulas.equation import conclusion, equation, linear, number_latex, relation
from core.explain.records import Formula
from core.explain.step_values import KEY_NUMBER_BITS, StepValues, key_fields

_NEW, _BUFFER = r"\mathrm{key}_{\mathrm{new}}", r"\mathrm{key}_{\mathrm{buffer}}"


def _key_latex(key: int) -> str:
    """Write a key in hexadecimal."""
    depth, number = key_fields(key)
    return rf"\mathrm{{{depth}}} \, | \, \mathrm{{{number}}}"


def plane(step: StepValues) -> Formula:
    """Depth as an integer plane."""
    origin, across, up = (step.number(name) for name in ("origin", "across", "up"))
    column, row = step.number("column"), step.number("row")
    slopes = [(r"\mathrm{across}", across), (r"\mathrm{up}", up), (r"\mathrm{origin}", origin)]
    return linear("d", step.number("stored"), slopes, (r"\mathrm{column}", column), (r"\mathrm{row}", row))


def rounded(step: StepValues) -> Formula:
    """Depth rounded at the pixel."""
    depth = number_latex(step.number("depth"))
    return equation(
        ("d", step.number("stored")),
        "=",
        (r"\mathrm{round}(2^{38} \cdot z)", rf"\mathrm{{round}}(2^{{38}} \cdot {depth})"),
    )


def key(step: StepValues) -> Formula:
    """Depth and triangle packed into a key; the slack keeps it from being negative."""
    number = step.whole("number")
    return equation(
        (_NEW, _key_latex(step.whole("key"))),
        "=",
        (r"(d + 2^{20})", rf"({step.whole('stored')} + 2^{{20}})"),
        r"\cdot",
        rf"2^{{{KEY_NUMBER_BITS}}}",
        "+",
        (r"(n + 1)", f"({number} + 1)"),
    )


def minimum(step: StepValues) -> Formula:
    """The depth test as a comparison of keys."""
    new, old = step.whole("key"), step.whole("before_key")
    return equation(
        (_NEW, _key_latex(new)),
        ("<", relation(float(new - old))),
        (_BUFFER, _key_latex(old)),
        *conclusion("passes", "passes" if step.flag("passes") else "fails"),
    )


def key_written(step: StepValues) -> Formula:
    """The depth in the key that is kept."""
    after = step.whole("after_key")
    return equation(
        (r"d_{\mathrm{buffer}}", step.number("after")),
        "=",
        (
            rf"\lfloor \min({_NEW}, {_BUFFER}) / 2^{{{KEY_NUMBER_BITS}}} \rfloor",
            rf"\mathrm{{{key_fields(after)[0]}}}",
        ),
        "-",
        "2^{20}",
    )


def plane_written(step: StepValues) -> Formula:
    """A depth that is stored without a test."""
    return equation((r"d_{\mathrm{buffer}}", step.number("after")), "=", ("d", step.number("stored")))


FORMULAS: Mapping[str, Callable[[StepValues], Formula]] = {
    "depth.test.plane": plane,
    "depth.plane.plane": plane,
    "depth.rounded.depth": rounded,
    **{f"depth.{kind}.key": key for kind in ("test", "rounded")},
    **{f"depth.{kind}.minimum": minimum for kind in ("test", "rounded")},
    "depth.rounded.write": key_written,
    "depth.plane.write": plane_written,
}
