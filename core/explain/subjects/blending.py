"""Blending: how a fragment's colour enters the colour buffer. Formulas have the channel that changes most."""

from core.explain.digits import is_remainder, remainder_note, signed_latex, spoken, vector_text
from core.explain.equation import Part, channel_symbol, equation, outstanding
from core.explain.records import Asked, number
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues
from core.explain.variable_text import VariableText, shows

_ALPHA = r"a_{\mathrm{source}}"


def red(step: StepValues) -> Asked | None:
    """Ask for red in the buffer."""
    after = step.vector("after")[0]
    return number(f"What is red at {step.the_pixel} afterwards?", after, f"red is {spoken(after)}.")


@explains("blend.opaque.write", asks=red)
def opaque(step: StepValues) -> Said:
    """A colour that replaces another."""
    after, before = (vector_text(step.vector(name)) for name in ("after", "before"))
    channel = _channel(step)
    new = (channel_symbol("new", channel), step.vector("after")[channel])
    source = (channel_symbol("source", channel), step.vector("source")[channel])
    text = f"{step.pixel_name}: the fragment's colour {after} replaces {before}{remainder_note(step.vector('after'))}."
    return text, equation(new, "=", source)


@explains("blend.over|line-over.source")
def over_source(step: StepValues) -> Said:
    """What of the buffer shows through."""
    alpha = step.vector("source")[3]
    before = vector_text(step.vector("before"))
    text = (
        f"{step.pixel_name}: the fragment's alpha is {spoken(alpha)}, "
        f"so {spoken(1 - alpha)} of the buffer's colour, {before}, shows through."
    )
    if is_remainder(1 - alpha):
        text = (
            f"{step.pixel_name}: the fragment's alpha is 1 up to rounding, which leaves s = {spoken(1 - alpha)}, "
            f"so the buffer's colour, {before}, does not show through."
        )
    return text, equation(("s", 1 - alpha), "=", "1", "-", (_ALPHA, alpha))


def _channel(step: StepValues) -> int:
    after, before = step.vector("after"), step.vector("before")
    return outstanding([after[k] - before[k] for k in range(3)])


def _sum(step: StepValues) -> tuple[Part, ...]:
    """Return the new colour as the fragment's times its alpha, plus the buffer's."""
    source, channel = step.vector("source"), _channel(step)
    return (
        (channel_symbol("new", channel), step.vector("after")[channel]),
        "=",
        (channel_symbol("source", channel), source[channel]),
        r"\cdot",
        (_ALPHA, source[3]),
        "+",
        (channel_symbol("buffer", channel), step.vector("before")[channel]),
    )


@explains("blend.over|line-over.color")
def over_color(step: StepValues) -> Said:
    """Fragment over buffer."""
    after, alpha = step.vector("after"), step.vector("source")[3]
    text = f"{step.pixel_name}: fragment over buffer gives {vector_text(after)}{remainder_note(after)}."
    left = (rf"(1 - {_ALPHA})", f"(1 - {signed_latex(alpha)})")
    return text, equation(*_sum(step), r"\cdot", left)


@explains("blend.additive|line-additive.source")
def additive_source(step: StepValues) -> Said:
    """The light that a fragment adds, in the channel that is strongest."""
    source, before = step.vector("source"), vector_text(step.vector("before"))
    channel = outstanding(source[:3])
    text = (
        f"{step.pixel_name}: the fragment's colour is scaled by its alpha, {spoken(source[3])}, "
        f"and all of the buffer's colour, {before}, stays."
    )
    color = (channel_symbol("source", channel), source[channel])
    return text, equation(("s", source[channel] * source[3]), "=", color, r"\cdot", (_ALPHA, source[3]))


@explains("blend.additive|line-additive.color")
def additive_color(step: StepValues) -> Said:
    """Fragment plus buffer."""
    after = step.vector("after")
    above = ", more than the display can show" if max(after[:3]) > 1 else ""
    text = (
        f"{step.pixel_name}: fragment plus buffer gives {vector_text(after)}{above}{remainder_note(after)}."
    )
    return text, equation(*_sum(step))


@explains("blend.*.write", asks=red)
def written(step: StepValues) -> Said:
    """The mix in the buffer."""
    after, before = (vector_text(step.vector(name)) for name in ("after", "before"))
    note = remainder_note(step.vector("after"))
    return f"{step.pixel_name}: the colour buffer now holds {after} instead of {before}{note}."


shows(
    "blend",
    {
        "color": VariableText("shaded", "Linear red, green, blue and straight alpha, as shaded."),
        "intensity": VariableText("I", "Intensity: fraction of the line's colour that the pixel gets."),
        "source": VariableText("source", "Fragment's colour: linear red, green, blue and straight alpha."),
        "before": VariableText("buffer", "Colour that the buffer held."),
        "after": VariableText("new", "Colour that the buffer holds.", previous="before"),
    },
)
