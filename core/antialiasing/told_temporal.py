"""Temporal antialiasing, told step by step: the place of the sample, the history, its range, and the mixture."""

from core.explain.formulas import below, call, formula_of, named
from core.explain.number_text import spoken, vector_text
from core.explain.step_values import CHANNELS, Said, StepValues, explains
from core.explain.steps import VariableText, given, shows
from core.records.words import counted

_ALL = "first|outside|mixed|limited"
_KNOWN = "mixed|limited"


def _channel(step: StepValues) -> int:
    """Return the channel in which the new colour differs most from the history."""
    pairs = zip(step.vector("new"), step.vector("history"), strict=True)
    apart = [abs(new - old) for new, old in pairs]
    return apart.index(max(apart))


@explains(f"resolve.{_ALL}.point")
def point(step: StepValues) -> Said:
    """Where the sample lies, and what it shows."""
    x, y = map(spoken, step.vector("point"))
    age = step.whole("age")
    when = "the last one" if age == 0 else f"{counted(age, 'picture')} before the last"
    return (
        f"{step.pixel_name}, picture {step.whole('picture')}, {when}: its sample lies at ({x}, {y}) in the pixel and "
        f"has the colour {vector_text(step.vector('new'))}."
    )


@explains("resolve.first.begin")
def begin(step: StepValues) -> Said:
    """The first picture."""
    return f"{step.pixel_name}: there is no history yet, so the new colour is kept."


@explains("resolve.outside.lost")
def lost(step: StepValues) -> Said:
    """A pixel that was not in the picture before."""
    return (
        f"{step.pixel_name}: what it shows was outside of the picture before, or behind its camera, so it has no "
        "history, and the new colour is kept."
    )


@explains(f"resolve.{_KNOWN}.history")
def history(step: StepValues) -> Said:
    """Where the history is looked up, and what it is."""
    color, (x, y) = vector_text(step.vector("history")), (step.number("from_x"), step.number("from_y"))
    column, row = step.pixel
    if (x - column, y - row) in ((0.5, 0.5), (0.0, 0.0)):
        return f"{step.pixel_name}: the history of the same pixel is {color}."
    return (
        f"{step.pixel_name}: by its depth, what it shows was at ({spoken(x)}, {spoken(y)}) in the picture before, and "
        f"between the pixels there the history is {color}."
    )


@explains("resolve.limited.clamp")
def clamp(step: StepValues) -> Said:
    """The history, limited to the range of the new colours around."""
    k = _channel(step)
    old, result = step.vector("history")[k], step.vector("limited")[k]
    low, high = step.vector("low")[k], step.vector("high")[k]
    where = "already" if old == result else f"so it becomes {spoken(result)}"
    text = (
        f"{step.pixel_name}: the 3 x 3 new colours around have {CHANNELS[k]} from {spoken(low)} to {spoken(high)}, and "
        f"the history has {spoken(old)}, {where if old != result else 'which lies between them'}."
    )
    limited = call(
        "min", call("max", named("h", old), named(below("h", "low"), low)), named(below("h", "high"), high)
    )
    return text, formula_of(named("h'", result).equals(limited))


@explains(f"resolve.{_KNOWN}.share")
def share(step: StepValues) -> Said:
    """The share of the new colour."""
    found, k = step.named("share", "a"), step.named("picture", "k")
    least = step.named("least_share", below("a", "least"))
    which = (
        "the mean of all pictures so far"
        if found.value > least.value
        else "the least, so older pictures fade"
    )
    return f"{step.pixel_name}: the new colour has a share of {found}: {which}.", formula_of(
        found.equals(call("max", 1 / k, least))
    )


@explains(f"resolve.{_KNOWN}.mix")
def mix(step: StepValues) -> Said:
    """What is kept."""
    k = _channel(step)
    text = f"{step.pixel_name}: {vector_text(step.vector('kept'))} is kept."
    old, new = named("h", step.vector("limited")[k]), named("c", step.vector("new")[k])
    mixed = old + step.named("share", "a") * (new - old)
    return text, formula_of(named(below("h", "new"), step.vector("kept")[k]).equals(mixed))


shows(
    f"resolve.{_ALL}",
    {
        "picture": VariableText("picture", "Number of the picture, from 1."),
        "age": VariableText("before the last", "How many pictures follow this one."),
        "point": given("sample", "Where the sample lies in its pixel."),
        "new": VariableText("new", "Colour of the sample in this picture, linear."),
        "from_x": VariableText("from x", "Where in the window the history is looked up."),
        "from_y": VariableText("from y", "Where in the window the history is looked up."),
        "history": VariableText("history", "Colour kept before this picture, linear."),
        "low": VariableText("least", "Least of the 3 x 3 new colours around."),
        "high": VariableText("greatest", "Greatest of the 3 x 3 new colours around."),
        "limited": VariableText("limited", "The history, within that range.", "history"),
        "share": VariableText("share", "Share of the new colour in what is kept."),
        "kept": VariableText("kept", "Colour that is kept, linear."),
    },
)
