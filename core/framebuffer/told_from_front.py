"""Blending from front to back: what each hit of a list adds, what is let through, and what the background gives."""

from core.explain.formulas import Named, below, formula_of, in_channel, named, outstanding
from core.explain.number_text import remainder_note, spoken, vector_text
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.framebuffer.told import red

_BEFORE, _REST, _SHARE = below("r", "before"), "r", "s"


def _alpha(step: StepValues) -> Named:
    return named(below("a", "source"), step.vector("source")[3])


@explains("blend.front|line-front.share")
def share(step: StepValues) -> Said:
    """How much of the pixel the fragment gives."""
    part, before = step.named("share", _SHARE), step.named("rest_before", _BEFORE)
    text = f"nothing in front hides any of {step.name}, so it gives its alpha, {part}, of the pixel."
    if before.value != 1:
        text = (
            f"what is in front of {step.name} lets {before} through, and with its alpha of {_alpha(step)} it gives "
            f"{part} of the pixel."
        )
    return f"{step.pixel_name}: {text}", formula_of(part.equals(before @ _alpha(step)))


@explains("blend.front|line-front.add")
def add(step: StepValues) -> Said:
    """The colour so far."""
    before, after, source = (step.vector(name) for name in ("front_color", "added", "source"))
    channel = outstanding([after[k] - before[k] for k in range(3)])
    text = f"{step.pixel_name}: with {step.name} added, the colour is {vector_text(after)}"
    new = in_channel("new", after, channel)
    added = in_channel("front", before, channel) + step.named("share", _SHARE) @ in_channel(
        "source", source, channel
    )
    return f"{text}{remainder_note(after)}.", formula_of(new.equals(added))


@explains("blend.front|line-front.rest")
def rest(step: StepValues) -> Said:
    """What is let through."""
    left, before = step.named("rest", _REST), step.named("rest_before", _BEFORE)
    text = f"{left} of what is behind {step.name} shows through."
    if left.value == 0:
        text = f"nothing behind {step.name} shows through."
    return f"{step.pixel_name}: {text}", formula_of(left.equals(before * (1 - _alpha(step))))


@explains("blend.front-shut.shut")
def shut(step: StepValues) -> Said:
    """A fragment that is not added."""
    in_front = step.named_primitive(step.whole("in_front"))
    return f"{step.pixel_name}: {step.name} is not added, as {in_front} in front of it lets nothing through."


@explains("blend.front-store.store", asks=red)
def store(step: StepValues) -> Said:
    """The end of a list."""
    left, after, before, added = (
        step.named("rest", _REST),
        *(step.vector(name) for name in ("after", "before", "added")),
    )
    channel = outstanding([after[k] - before[k] for k in range(3)])
    shown = f"{spoken(left.value)} of the buffer's colour, {vector_text(before)}, shows"
    if left.value == 0:
        shown = f"nothing of the buffer's colour, {vector_text(before)}, shows"
    text = f"{step.pixel_name}: the list is resolved; {shown}, and the buffer now holds {vector_text(after)}"
    new, front = in_channel("new", after, channel), in_channel("front", added, channel)
    made = front + left @ in_channel("buffer", before, channel)
    return f"{text}{remainder_note(after)}.", formula_of(new.equals(made))


shows(
    "blend",
    {
        "rest_before": VariableText("r before", "How much what is in front lets through."),
        "share": VariableText("s", "How much of the pixel the hit gives."),
        "front_color": VariableText("front", "Colour and alpha of the hits in front, added up."),
        "added": VariableText(
            "colour", "Colour and alpha of the hits so far, added up.", previous="front_color"
        ),
        "rest": VariableText("r", "How much the hits so far let through.", previous="rest_before"),
    },
)
