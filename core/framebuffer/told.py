"""Blending: how a fragment's colour enters the colour buffer. Formulas have the channel that changes most."""

from core.explain.formulas import Named, below, formula_of, in_channel, named, outstanding
from core.explain.number_text import is_remainder, remainder_note, spoken, vector_text
from core.explain.records import Asked, Formula, number
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.records.terms import Term


def _alpha(step: StepValues) -> Named:
    return named(below("a", "source"), step.vector("source")[3])


def _of(step: StepValues, name: str, column: str, channel: int) -> Named:
    return in_channel(name, step.vector(column), channel)


def red(step: StepValues) -> Asked | None:
    """Ask for red in the buffer."""
    after = step.vector("after")[0]
    return number(f"What is red at {step.the_pixel} afterwards?", after, f"red is {spoken(after)}.")


@explains("blend.opaque.write", asks=red)
def opaque(step: StepValues) -> Said:
    """A colour that replaces another."""
    after, before = (vector_text(step.vector(name)) for name in ("after", "before"))
    channel = _channel(step)
    text = f"{step.pixel_name}: the fragment's colour {after} replaces {before}{remainder_note(step.vector('after'))}."
    return text, formula_of(_of(step, "new", "after", channel).equals(_of(step, "source", "source", channel)))


@explains("blend.over|line-over.source")
def over_source(step: StepValues) -> Said:
    """What of the buffer shows through."""
    alpha = _alpha(step)
    s, before = named("s", 1 - alpha.value), vector_text(step.vector("before"))
    text = (
        f"{step.pixel_name}: the fragment's alpha is {alpha}, "
        f"so {s} of the buffer's colour, {before}, shows through."
    )
    if is_remainder(s.value):
        text = (
            f"{step.pixel_name}: the fragment's alpha is 1 up to rounding, which leaves s = {s}, "
            f"so the buffer's colour, {before}, does not show through."
        )
    return text, formula_of(s.equals(1 - alpha))


def _channel(step: StepValues) -> int:
    after, before = step.vector("after"), step.vector("before")
    return outstanding([after[k] - before[k] for k in range(3)])


def _mixed(step: StepValues, share: Term | None = None) -> Formula:
    """Return the new colour as the fragment's times its alpha, plus a share of the buffer's, or all of it."""
    channel = _channel(step)
    buffer = _of(step, "buffer", "before", channel)
    added = _of(step, "source", "source", channel) * _alpha(step) + (buffer * share if share else buffer)
    return formula_of(_of(step, "new", "after", channel).equals(added))


@explains("blend.over|line-over.color")
def over_color(step: StepValues) -> Said:
    """Fragment over buffer."""
    after = step.vector("after")
    text = f"{step.pixel_name}: fragment over buffer gives {vector_text(after)}{remainder_note(after)}."
    return text, _mixed(step, 1 - _alpha(step))


@explains("blend.additive|line-additive.source")
def additive_source(step: StepValues) -> Said:
    """The light that a fragment adds, in the channel that is strongest."""
    source, before = step.vector("source"), vector_text(step.vector("before"))
    channel = outstanding(source[:3])
    text = (
        f"{step.pixel_name}: the fragment's colour is scaled by its alpha, {spoken(source[3])}, "
        f"and all of the buffer's colour, {before}, stays."
    )
    light = named("s", source[channel] * source[3])
    return text, formula_of(light.equals(in_channel("source", source, channel) * _alpha(step)))


@explains("blend.additive|line-additive.color")
def additive_color(step: StepValues) -> Said:
    """Fragment plus buffer."""
    after = step.vector("after")
    above = ", more than the display can show" if max(after[:3]) > 1 else ""
    text = (
        f"{step.pixel_name}: fragment plus buffer gives {vector_text(after)}{above}{remainder_note(after)}."
    )
    return text, _mixed(step)


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
