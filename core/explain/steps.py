"""What a step says: its sentence, its formula, its variables as shown, and what can be asked about it."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from importlib import import_module
from itertools import pairwise
from typing import Any

import numpy as np

from core.explain.number_text import in_words, spoken, vector_text
from core.explain.records import Asked, Formula, Value, Variable
from core.explain.step_values import REMARKS, Row, StepValues, find_row, key_fields, row_key
from core.methods import modules_in
from core.records.listing import EditedListing, ShaderListing
from core.records.words import capitalized, counted, joined
from core.trace.stage_trace import KEPT_EXPLANATIONS, Explanation, StageTrace

# How the variables of a trace are shown in the table: name, meaning, and when they are known.


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
    absent: str = ""
    """The variable that is below 0 where this one has no value: then it is ``nothing``."""


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
        now = "nothing" if text.absent and step.whole(text.absent) < 0 else values[name]
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


# What a step says: its sentence, its formula, its variables, and what can be asked about the next one.


TOPICS = (
    *(
        *("transform", "deformation", "tessellation", "trees", "culling", "clipping", "coverage"),
        *("spans", "lines", "interpolation", "textures"),
    ),
    *("shading", "shaders", "depth", "visibility", "framebuffer", "antialiasing"),
)
"""Folders whose ``told`` files say what steps do; the variables of a stage stand in this order."""


@cache
def load_subjects() -> None:
    """Import all ``told`` files of the topics, which enter their rows and variables."""
    for topic in TOPICS:
        for name in modules_in(f"core.{topic}", "told"):
            import_module(name)


def row_of(key: str) -> Row | None:
    """Return the row of an operation, ``stage.kind.operation``; ``None`` where it has none."""
    load_subjects()
    return find_row(row_key(key))


@lru_cache(KEPT_EXPLANATIONS)
def account(
    explanation: Explanation, triangle: int, pixel: tuple[int, int] | None
) -> tuple[str, Formula | None]:
    """Return what a step did and why, in one sentence, and its own formula; ``None`` where it computes nothing.

    Parameters
    ----------
    triangle : int
        Number of the triangle that the step is about, -1 for none.
    pixel : (column, row), optional
        The pixel that it is about; by default the one that the explanation names.
    """
    text, made = _said(StepValues(explanation, triangle, pixel))
    standing = made if made is not None else _earlier_formula(explanation, triangle, pixel)
    return in_words(text, standing.digits if standing is not None else {}), made


def _earlier_formula(
    explanation: Explanation, triangle: int = -1, pixel: tuple[int, int] | None = None
) -> Formula | None:
    """Return the last formula of the row's earlier operations."""
    for earlier in reversed(explanation.earlier):
        _, made = _said(StepValues(earlier, triangle, pixel))
        if made is not None:
            return made
    return None


def _said(step: StepValues) -> tuple[str, Formula | None]:
    """Return the sentence of a step with its numbers marked, and its formula."""
    if isinstance(step.explanation.listing, EditedListing):
        from core.explain.edited import edited_account  # Wanted by few: it takes the evaluator.

        place = f"{step.pixel_name}: " if step.has("column", "row") and step.number("column") >= 0 else ""
        return edited_account(step.explanation, place)
    row = row_of(step.explanation.key)
    said = row.say(step) if row is not None else _plain_account(step)
    return (said, None) if isinstance(said, str) else said


def sentence(explanation: Explanation, triangle: int, pixel: tuple[int, int] | None) -> str:
    """Return the sentence of a step, as `account` does."""
    return account(explanation, triangle, pixel)[0]


def row_sentence(trace: StageTrace, position: int) -> str:
    """Return the sentence of the operation just done, behind those of the same row that chose what it does."""
    row, _ = trace.steps.row_at(position)
    last = trace.explain(position)
    assert last is not None
    deciding = [e for e in last.earlier if (said := row_of(e.key)) is not None and said.decides]
    texts = [_sentence_of(trace, row, e) for e in (*deciding, last)]
    whole = texts[:1]
    for before, text in pairwise(texts):
        name, colon, rest = text.partition(": ")
        whole.append(capitalized(rest) if colon and before.startswith(name) else text)
    return " ".join(whole)


def remarks(trace: StageTrace, first: int, end: int) -> list[str]:
    """Return what a step of the rows from ``first`` to ``end`` (excluded) repeats of them, each kind of remark once."""
    load_subjects()
    steps, said = trace.steps, []
    for key, which in REMARKS.items():
        stage, kinds, operation = key.split(".", 2)
        if stage != trace.stage:
            continue
        numbers = [
            number
            for number, kind in enumerate(steps.kinds)
            if kinds == "*" or kind in kinds.split("|")
            if any(done.name == operation for done in steps.operations[kind])
        ]
        rows = first + np.flatnonzero(np.isin(steps.kind[first:end], numbers)) if numbers else steps.kind[:0]
        rows = rows[which(trace.columns, rows)] if len(rows) else rows
        if len(rows):
            names = [done.name for done in steps.operations[trace.kind_of(int(rows[0]))]]
            explanation = trace.explain(int(steps.starts[rows[0]]) + 1 + names.index(operation))
            assert explanation is not None
            more = f" The same happens {counted(len(rows) - 1, 'more time')}." if len(rows) > 1 else ""
            said.append(_sentence_of(trace, int(rows[0]), explanation) + more)
    return said


def _sentence_of(trace: StageTrace, row: int, explanation: Explanation) -> str:
    column, line = trace.pixel[row].tolist()
    return sentence(explanation, int(trace.triangle[row]), (column, line))


@lru_cache(KEPT_EXPLANATIONS)
def formula(explanation: Explanation) -> Formula | None:
    """Return the formula of a step: where it only copies or stores, the last one of its row, which decided."""
    _, made = _said(StepValues(explanation))
    return made if made is not None else _earlier_formula(explanation)


def question(trace: StageTrace, row: int) -> Asked | None:
    """Return a question about a row of a trace, with its answer; ``None`` where there is nothing to predict."""
    start, end = (int(position) for position in trace.steps.starts[row : row + 2])
    for position in range(start + 1, end + 1):
        explanation = trace.explain(position)
        found = row_of(explanation.key) if explanation is not None else None
        if explanation is not None and found is not None and found.asks is not None:
            column, line = (int(number) for number in trace.pixel[row])
            asked = found.asks(StepValues(explanation, int(trace.triangle[row]), (column, line)))
            return asked and replace(asked, text=in_words(asked.text, {}), reveal=in_words(asked.reveal, {}))
    return None


def _plain_account(step: StepValues) -> str:
    """Return what an operation without a row has set."""
    found = []
    for name in step.explanation.changed:
        value = step.explanation.values.get(name)
        if isinstance(value, np.ndarray) and value.dtype.kind in "fiu":
            shown = vector_text([float(number) for number in value.ravel()])
        else:
            shown = spoken(value) if isinstance(value, float) else str(value)
        found.append(f"{name.replace('_', ' ')} is {shown}")
    done = f"{step.kind}, {step.operation}".replace("-", " ").capitalize()
    return f"{done}: {joined(found)}." if found else f"{done}."


@lru_cache(KEPT_EXPLANATIONS)
def variables(explanation: Explanation) -> tuple[Variable, ...]:
    """Return the variables after a step: those given, those known by now; those just changed have another value before.

    Variables that a later operation sets are left out until then.
    """
    if isinstance(explanation.listing, ShaderListing):
        return _shader_variables(explanation)
    load_subjects()
    if isinstance(explanation.listing, EditedListing):
        from core.explain.edited import edited_variables

        return edited_variables(explanation)
    step = StepValues(explanation)
    found = [
        replace(variable, column=held.column) for held in held_values(step) for variable in _shown(step, held)
    ]
    made = formula(explanation)
    return (
        tuple(replace(variable, digits=made.digits) for variable in found)
        if made is not None
        else tuple(found)
    )


def _shader_variables(explanation: Explanation) -> tuple[Variable, ...]:
    """Return the shader's own variables after a statement."""
    values = explanation.values
    own = [name for name in explanation.known if f"{name} before" in values or name in explanation.changed]
    what = "vertices" if explanation.key.startswith("transform") else "fragments"
    live, lanes, earlier = (int(values[name]) for name in ("live", "lanes", "lanes earlier"))
    together = Variable(
        f"{what} that run",
        f"{live:,} of {lanes:,}",
        f"{earlier:,} of {lanes:,}",
        f"How many {what} of this triangle run this statement together. The others wait, or have ended.",
        share=live / lanes,
    )
    return (
        together,
        *(
            Variable(
                name,
                _value(values[name]),
                _value(values.get(f"{name} before")) if name in explanation.changed else _value(values[name]),
                "A variable of the shader. Its menu (right click) shows it in every pixel.",
            )
            for name in own
        ),
    )


def _shown(step: StepValues, held: Held) -> list[Variable]:
    """Return one variable, or one for every element that has its own."""
    label, text, now, before = held.label, held.text, held.now, held.before
    meaning = text.meaning if isinstance(text.meaning, str) else text.meaning(step)
    if text.is_key:
        return _key_fields(label, meaning, int(now), None if before is None else int(before))
    if not text.spread:
        return [Variable(label, _value(now), _value(before), meaning, text.edge)]
    elements = np.asarray(now)
    earlier = [None] * len(elements) if before is None else list(np.asarray(before))
    return [
        Variable(
            label.replace("#", str(k)),
            _value(element),
            _value(earlier[k]),
            meaning,
            k if text.spread == "edges" else None,
            element=k,
        )
        for k, element in enumerate(elements)
        if text.spread != "corners" or np.isfinite(element).all()
    ]


def _key_fields(label: str, meaning: str, now: int, before: int | None) -> list[Variable]:
    """Return the two fields of a packed key: the depth, and the number of the triangle plus one."""
    depth, number = _digits(now)
    earlier_depth, earlier_number = _digits(before) if before is not None else (None, None)
    return [
        Variable(label, depth, earlier_depth, f"{meaning} Its upper bits, in hexadecimal."),
        Variable(f"{label}, number", number, earlier_number, "Its lower 24 bits, in hexadecimal."),
    ]


def _digits(key: int) -> tuple[str, str]:
    depth, number = key_fields(key)
    return depth.removeprefix("0x"), number.removeprefix("0x")


def _value(value: Any) -> Value:
    """Return a number, a word, or the numbers of an array as plain Python values."""
    if value is None or isinstance(value, str):
        return value
    array = np.asarray(value)
    if array.ndim == 0:
        found: Value = array.item()
        return found
    return tuple(float(element) for element in array.ravel())
