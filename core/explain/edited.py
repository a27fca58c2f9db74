"""Steps of an edited listing: what its own lines do, with its own variables. The words of the method would be false.

The run of a trace has the rows of the method, and an edited listing its own lines: the lines from a labelled one up to
the next labelled one belong to the operation of that label, in the order in which they run on the row's numbers.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from core.edits.typed import Typed, parameters_of
from core.explain.formulas import formula_of
from core.explain.listed_code import stated
from core.explain.number_text import spoken
from core.explain.records import Formula, Value, Variable
from core.lanes.nodes import Put
from core.lanes.problem import LISTING
from core.lanes.program import LaneStep, steps_until_problem
from core.lanes.python_values import Range, Table, at_lane
from core.lanes.terms import equalities, in_symbols, shown
from core.lines.line_clipping import ClipWindow
from core.records.listing import EditedListing, moved_lines
from core.records.words import counted, joined
from core.textures.look_up import finite_coordinates
from core.trace.stage_trace import KEPT_EXPLANATIONS, Explanation, StageTrace

GIVEN = {
    "cull": {"corners": "eye_corners", "given": "object_corners"},
    "interpolate": {"w": "corner_w", "corners": "corner_window"},
    "depth": {"new": "stored", "old": "before"},
    "shade": {name: f"lit_{name}" for name in ("position", "normal", "eye", "material")},
    "blend": {"destination": "before"},
}
"""Stage to parameters of its listings, where the column that they come from has another name."""
PLACE = {"column": "Column of the pixel, from the left.", "row": "Row of the pixel, from the bottom."}
SAID_LINES = 4
"""Lines of a step that its sentence tells of."""
EQUATIONS = 3
"""Equations of a step that stand beside each other."""
LOOPS = ("for", "while")
LONGEST_SHOWN = 4
"""Elements of a list that has rows of its own, or is written out."""
SEARCHED_STEPS = 400
"""Steps in which a line that has no label is looked for."""
MOST_ROUNDS = 1_000_000


@dataclass(frozen=True, eq=False)
class EditedStep:
    """The lines that one operation of a row has run."""

    listing: EditedListing
    steps: tuple[LaneStep, ...]
    """In the order in which they ran; empty: this operation runs none of the edited lines."""
    latest: LaneStep | None
    """The last line that has run by now."""

    @property
    def main(self) -> LaneStep | None:
        """The line that the operation stands for: its labelled one, else the first that computes something."""
        lines = set(map(self.listing.begin_of, self.listing.lines.values()))
        told = [step for step in self.steps if step.kind not in LOOPS] or list(self.steps)
        return next((step for step in told if step.line in lines), told[0] if told else None)


def is_edited(explanation: Explanation) -> bool:
    """Return whether a step is one of an edited listing."""
    return isinstance(explanation.listing, EditedListing)


def is_clipping(explanation: Explanation) -> bool:
    """Return whether a step of an edited listing is one of a line clipper, in a row before those of the pixels."""
    return int(explanation.values.get("clip_row", -1)) >= 0


@lru_cache(KEPT_EXPLANATIONS)
def edited_step(explanation: Explanation) -> EditedStep | None:
    """Return the lines that an operation of an edited listing has run; ``None``: they cannot be told."""
    listing = explanation.listing
    assert isinstance(listing, EditedListing)
    inputs = _inputs(explanation, listing)
    if inputs is None:
        return None
    ran: Sequence[LaneStep] = _recorded(Typed(listing.original.function, listing.source), _frozen(inputs))
    if is_clipping(explanation):
        ran = _of_put(ran, int(explanation.values["clip_row"]))
    elif explanation.key.startswith("raster.") and "first_end" in explanation.values:
        found = _of_pixel(ran, explanation.values)
        if found is None:
            return None
        ran = found
    chain = _own_steps(explanation, listing)
    begin, group = 0, range(0)
    for place, each in enumerate(chain):
        line = listing.begin_of(each.line)
        stops = set(map(listing.begin_of, each.later_lines)) - ({line} if _is_value(each) else set())
        group = _group(ran, begin, line, stops, is_first=place == 0)
        begin = group.stop if len(group) or place < len(chain) - 1 else begin
    latest = ran[group.stop - 1] if group.stop > 0 else (ran[begin - 1] if begin else None)
    return EditedStep(listing, tuple(ran[group.start : group.stop]), latest)


def _is_value(explanation: Explanation) -> bool:
    """Return whether a step interpolates one attribute of several, with which the listing runs anew."""
    return explanation.key.startswith("interpolate.") and ".value-" in explanation.key


def _own_steps(explanation: Explanation, listing: EditedListing) -> list[Explanation]:
    """Return the operations of a listing up to one, those on other attributes left out."""
    chain = [each for each in (*explanation.earlier, explanation) if each.listing is listing]
    if _is_value(explanation):
        chain = [each for each in chain if each is explanation or not _is_value(each)]
    return chain


def _group(ran: Sequence[LaneStep], begin: int, line: int, stops: set[int], *, is_first: bool) -> range:
    """Return which steps belong to an operation of a line: those from it up to the lines that follow, see ``stops``."""
    at = next((k for k in range(begin, len(ran)) if ran[k].line == line), None)
    if at is None:
        return range(begin, begin)
    end = at + 1
    while end < len(ran) and ran[end].line not in stops:
        end += 1
    if end < len(ran):
        # The head of a loop's next round belongs to what follows.
        while end > at + 1 and ran[end - 1].kind in LOOPS:
            end -= 1
    return range(0 if is_first else begin, end)


def _of_put(ran: Sequence[LaneStep], index: int) -> Sequence[LaneStep]:
    """Return the steps that lead to what is put to a list, by its index; behind the last one, all that follow."""
    puts = [k for k, step in enumerate(ran) if isinstance(step.statement, Put)]
    return ran[puts[index - 1] + 1 if index else 0 : puts[index] + 1 if index < len(puts) else len(ran)]


def _of_pixel(ran: Sequence[LaneStep], values: Mapping[str, Any]) -> Sequence[LaneStep] | None:
    """Return the steps of a line's run that lead to one pixel: those behind the pixel before."""
    puts = [
        k for k, step in enumerate(ran) if isinstance(step.statement, Put) and isinstance(step.value, list)
    ]
    pixel = [int(values["column"]), int(values["row"])]
    index = int(values["index"])
    if index >= len(puts) or ran[puts[index]].value[:2] != pixel:
        index = next((n for n, k in enumerate(puts) if ran[k].value[:2] == pixel), -1)
    if index < 0:
        return None
    return ran[puts[index - 1] + 1 if index else 0 : puts[index] + 1]


def _inputs(explanation: Explanation, listing: EditedListing) -> list[Any] | None:
    """Return what the listing is given in a step, in the order of its parameters."""
    values, names = explanation.values, parameters_of(listing.original.function)
    typed = Typed(listing.original.function, listing.source)
    if "first_end" in values and "last_pixel" in names:
        ends = [*np.asarray(values["first_end"]).tolist(), *np.asarray(values["second_end"]).tolist()]
        is_whole = all(float(end).is_integer() for end in ends)
        return [*(int(end) if is_whole else end for end in ends), explanation.corner_count == 2]
    if is_clipping(explanation):
        return _clipper_inputs(values, typed, listing.given["window"])
    if "textures" in listing.given:
        return _filter_inputs(values, typed, listing.given)
    stage, _, operation = explanation.key.split(".", 2)
    held: dict[str, Any] = {name: value for name, value in listing.given.items() if name in names}
    for name in names:
        column = GIVEN.get(stage, {}).get(name, name)
        if column in values:
            held[name] = _plain(values[column])
    if stage == "cull" and "corner" in names:
        held["corner"] = _plain(values["eye_corners"])[0]
    if stage == "interpolate":
        component = _component(explanation, operation)
        held["values"] = [row[component] for row in np.asarray(values["corner_values"], float).tolist()]
        if "provoking" in names:
            held["provoking"] = int(np.argmax(np.asarray(values["weights"], float)))
    return [held[name] for name in names] if all(name in held for name in names) else None


def _clipper_inputs(values: Mapping[str, Any], typed: Typed, window: ClipWindow) -> list[Any]:
    """Return what the listing of a line clipper is given."""
    from core.edits.lines import clipper_inputs

    ends = [*np.asarray(values["window_start"]).tolist(), *np.asarray(values["window_end"]).tolist()]
    return clipper_inputs(typed, ends, window, values["line_clipping"] == "cyrus-beck-lecture")


def _filter_inputs(values: Mapping[str, Any], typed: Typed, given: Mapping[str, Any]) -> list[Any] | None:
    """Return what the listing of a texture filter is given."""
    from core.edits.fragments import filter_inputs

    texture = given["textures"][int(values["mesh"])]
    if texture is None:
        return None
    u, v = finite_coordinates(np.asarray(values["uv"], float).reshape(1, 2))[:, 0].tolist()
    return filter_inputs(typed, texture, u, v, values.get("lod"), given["wrap"])


def _component(explanation: Explanation, operation: str) -> int:
    """Return which of the interpolated numbers an operation is about: the first of its attribute."""
    name, first = operation.removeprefix("value-"), 0
    values = np.asarray(explanation.values["values"], float)
    for attribute in ("color", "uv", "position", "normal", "diffuse_light", "specular_light"):
        if attribute == name and attribute in explanation.values:
            wanted = np.asarray(explanation.values[attribute], float).ravel()
            places = range(len(values) - len(wanted) + 1)
            return next(
                (k for k in places if np.array_equal(values[k : k + len(wanted)], wanted, equal_nan=True)), 0
            )
    return first


def _plain(value: Any) -> Any:
    return (
        value.tolist() if isinstance(value, np.ndarray) else value.item() if hasattr(value, "item") else value
    )


def _frozen(value: Any) -> Any:
    return tuple(map(_frozen, value)) if isinstance(value, list) else value


def _thawed(value: Any) -> Any:
    return [_thawed(part) for part in value] if isinstance(value, tuple) else value


@lru_cache(64)
def _recorded(typed: Typed, inputs: tuple[Any, ...]) -> tuple[LaneStep, ...]:
    """Return the steps of the listing itself, without those of listings that it calls."""
    limits = replace(LISTING, rounds=MOST_ROUNDS)
    steps, _ = steps_until_problem(typed.program, _thawed(inputs), limits=limits)
    return tuple(step for step in steps if step.depth == 1)


def position_that_runs(
    trace: StageTrace, listing: EditedListing, line: int, begin: int
) -> tuple[int | None, int]:
    """Return the first position behind another one whose step runs a line, from 1; ``None``: none was found.

    Beside it the last position that was looked at: `SEARCHED_STEPS` at most are.
    """
    last = min(begin + SEARCHED_STEPS, trace.steps.count)
    for position in range(begin + 1, last + 1):
        done = trace.explain(position)
        step = edited_step(done) if done is not None and done.listing is listing else None
        if step is not None and any(each.line == line for each in step.steps):
            return position, position
    return None, last


# What is said.


def edited_account(explanation: Explanation, pixel_name: str = "") -> tuple[str, Formula | None]:
    """Return what the lines of a step have done, in plain words with marked numbers, and as a formula.

    ``pixel_name`` is what the step is about, as ``Pixel (3, 4): ``.
    """
    step = edited_step(explanation)
    listing = explanation.listing
    assert isinstance(listing, EditedListing)
    if step is None:
        return _line_said(listing, explanation.line), None
    if not step.steps:
        if not explanation.line:
            return f"{pixel_name}Your listing {listing.name} is given its numbers.", None
        return f"{pixel_name}{_line_said(listing, explanation.line)} It does not run here.", None
    # A list that is still empty tells nothing.
    told = [each for each in step.steps if each.kind not in LOOPS and _has_value(each)] or list(step.steps)
    texts = [_said(each) for each in told[:SAID_LINES]]
    more = len(told) - SAID_LINES
    if more > 0:
        texts.append(f"{counted(more, 'more line')} {'runs' if more == 1 else 'run'}.")
    return pixel_name + " ".join(texts), _formula(step)


def _has_value(step: LaneStep) -> bool:
    return not isinstance(step.value, list) or bool(step.value)


def _line_said(listing: EditedListing, line: int) -> str:
    lines = listing.source.splitlines()
    code = lines[line - 1].strip() if 1 <= line <= len(lines) else ""
    return f"Line {line} of your listing: {code}." if code else f"Your listing {listing.name}."


def _said(step: LaneStep) -> str:
    """Return what a line has done: its results, as the formula has the rest."""
    found = equalities(step)
    if step.kind in ("if", "while"):
        return f"Line {step.line}: {in_symbols(found[0].right)} is {_word(step.value)}."
    if step.kind == "append":
        return f"Line {step.line} puts {_word(step.value)} into {found[0].symbol}."
    if step.kind == "return":
        parts = step.value if isinstance(step.value, list) else [step.value]
        is_short = len(parts) <= LONGEST_SHOWN
        return f"Line {step.line} returns {', '.join(map(_word, parts)) if is_short else shown(parts)}."
    sets = joined([f"{each.symbol} = {_word(each.result)}" for each in found])
    return f"Line {step.line}: {sets}."


def _word(value: Any) -> str:
    """Return a value in a sentence; numbers are marked, so that they have the digits of the formula."""
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    if isinstance(value, int | float | np.integer | np.floating):
        return spoken(float(value))
    if isinstance(value, list) and len(value) <= LONGEST_SHOWN:
        return f"({', '.join(map(_word, value))})" if value else "an empty list"
    return shown(value)


def _formula(step: EditedStep) -> Formula | None:
    """Return the line that a step stands for, and its lines that were changed, as one formula."""
    main, changed = step.main, _changed_lines(step.listing)
    told = [each for each in step.steps if each is main or (each.line in changed and each.kind not in LOOPS)]
    made = [stated(equality, each.kind, each.before) for each in told for equality in equalities(each)]
    return formula_of(*made[:EQUATIONS]) if made else None


@lru_cache(8)
def _changed_lines(listing: EditedListing) -> frozenset[int]:
    """Return the lines of an edited listing that the right one does not have."""
    kept = moved_lines(listing.original.source, listing.source)
    old, new = listing.original.source.splitlines(), listing.source.splitlines()
    same = {now for before, now in kept.items() if now <= len(new) and old[before - 1] == new[now - 1]}
    return frozenset(range(1, len(new) + 1)) - same


def edited_variables(explanation: Explanation) -> tuple[Variable, ...]:
    """Return the variables of the listing itself, after a step, behind the pixel that it is about."""
    place = [
        Variable(
            name, int(np.asarray(explanation.values[name])), int(np.asarray(explanation.values[name])), text
        )
        for name, text in PLACE.items()
        if name in explanation.values and not is_clipping(explanation)
    ]
    step = edited_step(explanation)
    if step is None or step.latest is None:
        return tuple(place)
    before = step.steps[0].before if step.steps else step.latest.after
    digits = made.digits if (made := edited_account(explanation)[1]) is not None else {}
    given = set(Typed(step.listing.original.function, step.listing.source).program.parameters)
    own = [
        replace(variable, digits=digits)
        # What it has been given stands last: it is known from the steps before.
        for name, value in sorted(step.latest.after.items(), key=lambda item: item[0] in given)
        if name != "_"
        for variable in _shown(name, value, before.get(name))
    ]
    return (*place, *own)


def _shown(name: str, value: Any, before: Any) -> list[Variable]:
    """Return one variable, or one for each element of a short list of numbers."""
    meaning = f"{name}, in your listing."
    is_flat = isinstance(value, list) and not any(isinstance(part, list) for part in value)
    if not is_flat or not value or len(value) > LONGEST_SHOWN:
        return [Variable(name, _value(value), _value(before), meaning)]
    earlier = before if isinstance(before, list) else []
    return [
        Variable(
            f"{name}[{k}]",
            _value(part),
            _value(earlier[k]) if k < len(earlier) else None,
            meaning,
            k if k < 3 and len(value) == 3 else None,
        )
        for k, part in enumerate(value)
    ]


def _value(value: Any) -> Value:
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    is_many = isinstance(value, list | range | Range | Table)
    return shown(at_lane(value, 0)) if is_many else value
