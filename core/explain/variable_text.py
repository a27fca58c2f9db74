"""How the variables of a trace are shown in the table: name, meaning, and when they are known."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from core.explain.step_values import StepValues

GIVEN = ""
"""Marks variables that are known before the first operation."""


@dataclass(frozen=True)
class VariableText:
    """How one variable of a trace is shown."""

    label: str | Callable[[StepValues], str]
    """Its name, that of the formula; ``#`` stands for the number of an element or edge."""
    meaning: str | Callable[[StepValues], str]
    after: str = "itself"
    """The variable that must be known before this one is shown; `GIVEN`: none."""
    spread: str = ""
    """Elements of an array with rows of their own: ``edges`` (0, 1, 2, coloured), ``parts``, or those of ``corners``
    that are numbers."""
    edge: int | None = None
    """0, 1 or 2 where the variable belongs to that edge."""
    previous: str = ""
    """The variable that holds its value before the step, where there was one."""
    is_key: bool = False
    """Whether it is a packed key, to be shown in hexadecimal."""


VARIABLES: dict[str, dict[str, VariableText]] = {}
"""Stage to its variables in the order of the algorithm; what is not here stays hidden."""
OF_KIND: dict[str, dict[str, VariableText]] = {}
"""``stage.kind`` to variables that rows of the kind have in the place of those of the same name."""
HIDDEN: dict[str, frozenset[str]] = {}
"""``stage.kind`` to the variables that rows of the kind do not use."""


def shows(where: str, variables: Mapping[str, VariableText]) -> None:
    """Enter variables of a stage, behind those that it has, or of some kinds of its rows, ``stage.kind|kind``.

    Raises ValueError for a name that has another text there: what is shown never hangs on the order of imports.
    """
    stage, _, kinds = where.partition(".")
    for key in [f"{stage}.{kind}" for kind in kinds.split("|")] if kinds else [stage]:
        held = (OF_KIND if kinds else VARIABLES).setdefault(key, {})
        twice = [name for name, text in variables.items() if held.get(name, text) != text]
        if twice:
            raise ValueError(f"{key} has a variable {twice[0]} already")
        held.update(variables)


def variables_of(stage: str, kind: str) -> dict[str, VariableText]:
    """Return the variables of one kind of rows, in the order of the algorithm."""
    return VARIABLES.get(stage, {}) | OF_KIND.get(f"{stage}.{kind}", {})


def hides(kinds: str, names: Iterable[str]) -> None:
    """Leave variables out of rows of these kinds: ``stage.kind``, or ``stage.kind|kind``."""
    stage, _, names_of_kinds = kinds.partition(".")
    for kind in names_of_kinds.split("|"):
        key = f"{stage}.{kind}"
        HIDDEN[key] = HIDDEN.get(key, frozenset()) | frozenset(names)


@dataclass(frozen=True)
class Held:
    """A variable after a step."""

    label: str
    column: str
    text: VariableText
    now: Any
    before: Any
    """What it was before the step; ``None``: it had no value."""


def held_values(step: StepValues) -> list[Held]:
    """Return the variables after a step, in the order of the algorithm.

    Columns of one label are one variable at different times: what an operation sets takes the place of what was known
    before.
    """
    explanation, hidden = step.explanation, HIDDEN.get(f"{step.stage}.{step.kind}", frozenset())
    values, order = explanation.values, {name: k for k, name in enumerate(explanation.known)}
    found: dict[str, list[tuple[int, str, VariableText]]] = {}
    for name, text in variables_of(step.stage, step.kind).items():
        needed = name if text.after == "itself" else text.after
        if name not in values or name in hidden or (needed != GIVEN and needed not in order):
            continue
        if name.endswith("_before") and values[name] != values[name]:
            continue  # Nothing was there before.
        label = text.label if isinstance(text.label, str) else text.label(step)
        found.setdefault(label, []).append((order.get(name, -1), name, text))
    held = []
    for label, times in found.items():
        *earlier, (_, name, text) = sorted(times, key=lambda time: time[0])
        now = values[name]
        before: Any = now
        if name in explanation.changed:
            before = values[earlier[-1][1]] if earlier else values.get(text.previous)
        held.append(Held(label, name, text, now, before))
    return held


def given(label: str, meaning: str, spread: str = "") -> VariableText:
    """Return a variable that is known before the first operation."""
    return VariableText(label, meaning, GIVEN, spread)


PIXEL = {
    "column": given("column", "Column of the pixel, from the left; of n × n samples that of the sample."),
    "row": given("row", "Row of the pixel, from the bottom; of n × n samples that of the sample."),
}
SAMPLE = {
    "sample": given("sample", "Number of the sample in its pixel, from 0 at the lower left."),
    "sample_position": given("place in pixel", "Position of the sample, from the pixel's lower left corner."),
}
"""Where a pixel has several samples."""
CENTRE = {
    "x": given("x", "x of the pixel's centre, in pixels."),
    "y": given("y", "y of the pixel's centre, in pixels."),
}
COEFFICIENTS = {
    "a": given("a#", "Change of the edge function per pixel to the right.", "edges"),
    "b": given("b#", "Change of the edge function per pixel upwards.", "edges"),
    "c": given("c#", "Value of the edge function at the window's origin.", "edges"),
}

for _stage in ("raster", "interpolate", "shade", "depth", "blend"):
    shows(_stage, PIXEL | SAMPLE)
shows("resolve", PIXEL)
