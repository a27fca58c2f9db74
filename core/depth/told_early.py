"""The early depth test, told: why a fragment is not shaded."""

import math

from core.explain.formulas import below, concludes, formula_of, named
from core.explain.number_text import pair_text
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows


@explains("shade.skipped.skip")
def skipped(step: StepValues) -> Said:
    """A fragment that does not pass, and so is not shaded."""
    text = f"{step.fragment_name}: hidden already, so it is not shaded"
    stored, before = step.number("stored"), step.number("before")
    if not step.flag("is_in_range"):
        return f"{step.fragment_name}: out of depth range, so it is not shaded."
    if step.flag("is_prepass"):
        return _not_left(step, stored, before)
    if step.flag("casts_rays"):
        return f"{text}; its ray has met something as near or nearer before."
    if math.isnan(stored) or math.isnan(before):
        return f"{text}; the early depth test has dropped it."
    new, old = pair_text(stored, before)
    word, relation = ("larger", ">") if step.flag("larger_is_nearer") else ("smaller", "<")
    test = named(below("d", "new"), stored).compared(relation, named(below("d", "buffer"), before))
    return (
        f"{text}; its depth {new} is not {word} than the {old} of the depth buffer.",
        formula_of(concludes("shaded", "not shaded", test)),
    )


def _not_left(step: StepValues, stored: float, left: float) -> Said:
    """Return why a fragment is not shaded after a prepass."""
    text = f"{step.fragment_name}: not shaded, since the prepass"
    if math.isnan(stored) or math.isnan(left):
        return f"{text} has left the depth of another fragment."
    if stored == left:
        return f"{text} has left an equal depth, of a fragment that comes first."
    new, old = pair_text(stored, left)
    test = named(below("d", "new"), stored).compared("=", named(below("d", "buffer"), left))
    return f"{text} has left the depth {old}, not its {new}.", formula_of(
        concludes("shaded", "not shaded", test)
    )


shows(
    "shade.skipped",
    {
        "stored": VariableText("d new", "What the depth format stores of the fragment."),
        "before": VariableText(
            "d buffer", "What the depth buffer held; after a prepass, the depth that is left."
        ),
    },
)
