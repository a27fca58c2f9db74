"""The formulas of blending and of the display.

Colours are shown in the channel that matters most; the others follow the same law.
"""

import math
from collections.abc import Callable, Mapping, Sequence

from core.explain.formulas import depth as formulas_depth
from core.explain.formulas.equation import (
    Part,
    equation,
    number_latex,
    signed_latex,
)
from core.explain.records import Formula
from core.explain.step_values import StepValues

CHANNEL_LETTERS = "rgba"
SRGB_LIMIT = 0.0031308
"""Linear values up to here are on the straight part of the sRGB curve."""


def outstanding(values: Sequence[float]) -> int:
    """Return where the value of greatest size stands; NaN is never the greatest."""
    return max(range(len(values)), key=lambda k: -1.0 if math.isnan(values[k]) else abs(values[k]))


def channel_symbol(name: str, channel: int) -> str:
    """Write the name of one channel of a colour."""
    return rf"\mathrm{{{name}}}_{{{CHANNEL_LETTERS[channel]}}}"


def over_source(step: StepValues) -> Formula:
    """What of the buffer shows through."""
    alpha = step.vector("source")[3]
    return equation(("s", 1 - alpha), "=", "1", "-", (r"a_{\mathrm{source}}", alpha))


def over_color(step: StepValues) -> Formula:
    """Fragment over buffer, in the channel that changes most."""
    source, before, after = (step.vector(name) for name in ("source", "before", "after"))
    channel = outstanding([after[k] - before[k] for k in range(3)])
    return equation(
        (channel_symbol("new", channel), after[channel]),
        "=",
        (channel_symbol("source", channel), source[channel]),
        r"\cdot",
        (r"a_{\mathrm{source}}", source[3]),
        "+",
        (channel_symbol("buffer", channel), before[channel]),
        r"\cdot",
        (r"(1 - a_{\mathrm{source}})", f"(1 - {signed_latex(source[3])})"),
    )


def additive_source(step: StepValues) -> Formula:
    """What the fragment adds, in the channel that is strongest."""
    source = step.vector("source")
    channel = outstanding(source[:3])
    return equation(
        ("s", source[channel] * source[3]),
        "=",
        (channel_symbol("source", channel), source[channel]),
        r"\cdot",
        (r"a_{\mathrm{source}}", source[3]),
    )


def additive_color(step: StepValues) -> Formula:
    """Fragment plus buffer, in the channel that changes most."""
    source, before, after = (step.vector(name) for name in ("source", "before", "after"))
    channel = outstanding([after[k] - before[k] for k in range(3)])
    return equation(
        (channel_symbol("new", channel), after[channel]),
        "=",
        (channel_symbol("source", channel), source[channel]),
        r"\cdot",
        (r"a_{\mathrm{source}}", source[3]),
        "+",
        (channel_symbol("buffer", channel), before[channel]),
    )


def _display_channel(step: StepValues) -> int:
    return outstanding(step.vector("clipped"))


def display_clipped(step: StepValues) -> Formula:
    """A linear value cut off at 0 and 1."""
    channel = _display_channel(step)
    linear, letter = step.vector("linear")[channel], CHANNEL_LETTERS[channel]
    numbers = rf"\min(\max({number_latex(linear)}, 0), 1)"
    return equation(
        (rf"c_{letter}", step.vector("clipped")[channel]),
        "=",
        (rf"\min(\max({letter}, 0), 1)", numbers),
    )


def encoded(step: StepValues) -> Formula:
    """The sRGB curve, the part that the value is on."""
    channel = _display_channel(step)
    value, letter = step.vector("clipped")[channel], CHANNEL_LETTERS[channel]
    parts: list[Part] = [(f"s_{letter}", step.vector("encoded")[channel]), "="]
    if value <= SRGB_LIMIT:
        return equation(*parts, "12.92", r"\cdot", (f"c_{letter}", value))
    power = (rf"c_{letter}^{{1/2.4}}", rf"{number_latex(value)}^{{1/2.4}}")
    return equation(*parts, "1.055", r"\cdot", power, "-", "0.055")


def rounded(step: StepValues) -> Formula:
    """A value as a byte."""
    channel = _display_channel(step)
    value, letter = step.vector("encoded")[channel], CHANNEL_LETTERS[channel]
    numbers = rf"\lfloor 255 \cdot {number_latex(value)} + \frac{{1}}{{2}} \rfloor"
    return equation(
        (rf"\mathrm{{byte}}_{{{letter}}}", step.vector("bytes")[channel]),
        "=",
        (rf"\lfloor 255 \cdot s_{letter} + \frac{{1}}{{2}} \rfloor", numbers),
    )


FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    **formulas_depth.FORMULAS,
    "blend.over.source": over_source,
    "blend.over.color": over_color,
    "blend.additive.source": additive_source,
    "blend.additive.color": additive_color,
    **{f"resolve.{kind}.clip": display_clipped for kind in ("encode", "average", "areas")},
    **{f"resolve.{kind}.encode": encoded for kind in ("encode", "average", "areas")},
    **{f"resolve.{kind}.round": rounded for kind in ("encode", "average", "areas")},
}
