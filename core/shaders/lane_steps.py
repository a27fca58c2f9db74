"""Which statement of a shader ran for which lanes, and the steps of one of these, with plain numbers."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.lanes import nodes
from core.lanes.problem import Problem
from core.lanes.program import LaneStep
from core.lanes.run import Frame, Run, Some, Watch
from core.lanes.terms import Equality, equalities, in_symbols, said, term_of
from core.records.arrays import Flags
from core.records.terms import Leaf, Term
from core.shaders.glsl_types import MATRICES, GlslValue, typed_name

# The record of a shader's run: which statement ran for which lanes, one after the other.


Reads = tuple[tuple[str, Flags], ...]
"""Own names of variables, and the lanes (L,) that have read them."""
STEP_LIMIT = 20_000
"""Statements of a run that is recorded."""


@dataclass(frozen=True, eq=False)
class ExecutedStatement:
    """A statement that ran for some of L lanes."""

    node: nodes.Statement
    depth: int
    """How many calls deep it stands: 1 in main."""
    packed: Any
    """Its live lanes as bits."""
    lanes: int
    value: Any
    """What was stored, tested or returned: a `GlslValue`, flags, or ``None``."""
    whole: Any = None
    """The whole variable afterwards, where the statement stores."""
    unset: Reads = ()
    """What it has read before it had a value."""

    @property
    def line(self) -> int:
        """Its line, from 1."""
        return self.node.place.line

    @property
    def live(self) -> Flags:
        """(L,) bool, the lanes that it ran for."""
        return np.unpackbits(self.packed, count=self.lanes).view(bool)


class OpenStatements:
    """Which of the reads of variables without a value belong to which statement: a call's to those of the call."""

    def __init__(self) -> None:
        self._starts: list[int] = []

    def begin(self, run: Run) -> None:
        """Note that a statement begins."""
        self._starts.append(len(run.unset))

    def end(self, run: Run) -> Reads:
        """Return the reads of the statement that began last."""
        start = self._starts.pop()
        found = tuple(run.unset[start:])
        del run.unset[start:]
        return found


class Recorder:
    """Looks on while a shader runs, and keeps every statement."""

    def __init__(self, lanes: int) -> None:
        self.steps: list[ExecutedStatement] = []
        self._lanes, self._open = lanes, OpenStatements()

    def begin(self, statement: nodes.Statement, mask: Some, frame: Frame) -> None:
        """Note a statement that is about to run in the lanes of a mask (L,): its calls come behind it."""
        if len(self.steps) >= STEP_LIMIT:
            raise Problem(statement.place, f"this takes more than {STEP_LIMIT:,} steps: stopped here")
        self._open.begin(frame.run)
        live = np.ones(self._lanes, bool) if mask is None else mask
        self.steps.append(ExecutedStatement(statement, frame.depth, np.packbits(live), self._lanes, None))

    def end(self, statement: nodes.Statement, mask: Some, frame: Frame, value: Any) -> None:
        """Note what the statement gave in the lanes of a mask (L,)."""
        unset = self._open.end(frame.run)
        for at in range(len(self.steps) - 1, -1, -1):
            step = self.steps[at]
            if step.node is statement and step.depth == frame.depth:
                name = stored_name(statement)
                whole = frame.names.get(name) if name else None
                self.steps[at] = ExecutedStatement(
                    statement, step.depth, step.packed, self._lanes, value, whole, unset
                )
                return


def stored_name(statement: nodes.Statement) -> str:
    """Return the own name of the variable that a statement gives a value; empty: none."""
    if isinstance(statement, nodes.Declare):
        return statement.name
    if not isinstance(statement, nodes.Assign):
        return ""
    target = statement.target
    while isinstance(target, nodes.Index | nodes.Field):
        target = target.whole
    return target.name if isinstance(target, nodes.Name) else ""


# The steps of one lane of a shader, with plain numbers: what each line had, computed and left, in words.


SAME = {"++": "+", "--": "-", "^^": "!="}
"""Operators that words have another name for."""
LEAVES: dict[type[nodes.Statement], str] = {
    nodes.Break: "break: the loop ends here",
    nodes.Continue: "continue: the next round begins",
}


def record_lane(run: Callable[[Watch], object], lane: int) -> tuple[LaneStep, ...]:
    """Run a shader and return the steps that one of its lanes lived through."""
    recorder = _LaneRecorder(lane)
    run(recorder)
    return tuple(step for step in recorder.steps if step is not None)


class _LaneRecorder:
    """Keeps what one lane does, in the order in which its statements begin."""

    def __init__(self, lane: int) -> None:
        self.steps: list[LaneStep | None] = []
        self._lane = lane
        self._open: list[tuple[nodes.Statement, int, dict[str, Any]]] = []
        self._statements = OpenStatements()

    def begin(self, statement: nodes.Statement, mask: Some, frame: Frame) -> None:
        """Keep the variables before a statement."""
        self._statements.begin(frame.run)
        if mask is None or mask[self._lane]:
            self._open.append((statement, len(self.steps), dict(frame.names)))
            self.steps.append(None)

    def end(self, statement: nodes.Statement, mask: Some, frame: Frame, value: Any) -> None:
        """Keep the step."""
        unset = self._statements.end(frame.run)
        if not (mask is None or mask[self._lane]):
            return
        while self._open:
            begun, place, before = self._open.pop()
            if begun is statement:
                self.steps[place] = LaneStep(
                    statement,
                    self._plain(before),
                    self._plain(frame.names),
                    plain_value(value, self._lane),
                    frame.depth,
                    tuple(dict.fromkeys(typed_name(name) for name, lanes in unset if lanes[self._lane])),
                )
                return

    def _plain(self, names: Mapping[str, Any]) -> dict[str, Any]:
        return {
            name: plain_value(value, self._lane) for name, value in names.items() if value.of != "sampler2D"
        }


def plain_value(value: Any, lane: int) -> Any:
    """Return a lane's value as Python numbers: a list of a vector, a list of columns of a matrix."""
    if not isinstance(value, GlslValue):
        return None if value is None else _number(value, lane)
    if value.of in MATRICES:
        return [[_number(part, lane) for part in column] for column in value.parts]
    parts = [_number(part, lane) for part in value.parts]
    return None if not parts else parts[0] if len(parts) == 1 else parts


def _number(part: Any, lane: int) -> Any:
    array = np.asarray(part)
    return (array if array.ndim == 0 else array[lane]).item()


def words_of(step: LaneStep) -> str:
    """Return a step in words: its line, the line with its numbers, and what came out."""
    node = step.statement
    if isinstance(node, nodes.Discard):
        return "discard: the fragment ends here, and nothing of it is written"
    if isinstance(node, nodes.Break | nodes.Continue):
        return LEAVES[type(node)]
    if isinstance(node, nodes.Evaluate):
        now = Typed(step.before)
        return f"{in_symbols(term_of(now.expression(node.value), now.values), is_glsl=True)} runs"
    if isinstance(node, nodes.Return) and node.value is None:
        return "return: this function ends here"
    if isinstance(node, nodes.Declare) and node.value is None:
        return f"{typed_name(node.name)} begins without a value: here it is 0"
    told = said(_typed_step(step), is_glsl=True)
    if isinstance(node, nodes.Loop):
        return f"{told}: {'one more round' if step.value else 'the loop ends'}"
    return told


def _typed_step(step: LaneStep) -> LaneStep:
    """Return a step of typed names, with components as variables of their own."""
    now = Typed(step.before)
    whole = now.statement(step.statement)
    return replace(step, statement=whole, before=now.values, after=now.values)


def computed(step: LaneStep) -> Equality | None:
    """Return what a step computes, as terms; ``None``: nothing, or a matrix. Matrices within keep their symbols."""
    node = step.statement
    is_empty = isinstance(node, nodes.Declare | nodes.Return) and node.value is None
    if (
        is_empty
        or isinstance(node, nodes.Discard | nodes.Break | nodes.Continue | nodes.Evaluate)
        or _is_matrix(step.value)
    ):
        return None
    (found,) = equalities(_typed_step(step))
    return replace(found, right=_named(found.right, _is_matrix))


def _is_matrix(value: Any) -> bool:
    return isinstance(value, list) and any(isinstance(part, list) for part in value)


def without_vectors(of: Term) -> Term:
    """Return a term whose vectors keep their names where their numbers would stand."""
    return _named(of, lambda value: isinstance(value, list))


def _named(of: Term, keeps_name: Callable[[Any], bool]) -> Term:
    if isinstance(of, Leaf):
        return Leaf(of.symbol, None) if of.symbol and keeps_name(of.value) else of
    return of.mapped(lambda part: _named(part, keeps_name))


class Typed:
    """A step's expressions with the names that were typed, and with components as variables of their own."""

    def __init__(self, before: Mapping[str, Any]) -> None:
        self._before = before
        self.values: dict[str, Any] = {}

    def statement(self, node: nodes.Statement) -> nodes.Statement:
        """Return a statement of typed names."""
        match node:
            case nodes.Assign(place, target, value):
                return nodes.Assign(place, self.expression(target), self.expression(value))
            case nodes.Declare(place, of, name, value):
                return nodes.Declare(
                    place, of, typed_name(name), None if value is None else self.expression(value)
                )
            case nodes.Return(place, value):
                return nodes.Return(place, None if value is None else self.expression(value))
            case nodes.If(place, test):
                return nodes.If(place, self.expression(test), (), ())
            case nodes.Loop(place, test):
                return nodes.Loop(place, self.expression(test), ())
        return node

    def expression(self, node: nodes.Expression) -> nodes.Expression:
        """Return an expression of typed names."""
        match node:
            case nodes.Name(place, name):
                return self._named(place, typed_name(name), self._before.get(name))
            case nodes.Field(place, nodes.Name(_, name), letters):
                held = self._before.get(name)
                picks = [next((k.index(x) for k in ("xyzw", "rgba", "stpq") if x in k), 0) for x in letters]
                value = None
                if isinstance(held, list) and max(picks) < len(held):
                    value = held[picks[0]] if len(picks) == 1 else [held[k] for k in picks]
                return self._named(place, f"{typed_name(name)}.{letters}", value)
            case nodes.Field(place, whole, letters):
                return nodes.Field(place, self.expression(whole), letters)
            case nodes.Index(place, whole, index):
                return nodes.Index(place, self.expression(whole), self.expression(index))
            case nodes.Binary(place, operator, left, right):
                same = SAME.get(operator, operator)
                return nodes.Binary(place, same, self.expression(left), self.expression(right))
            case nodes.Unary(place, operator, operand):
                return nodes.Unary(place, "not" if operator == "!" else operator, self.expression(operand))
            case nodes.Logic(place, is_and, parts):
                return nodes.Logic(place, is_and, tuple(map(self.expression, parts)))
            case nodes.Choose(place, test, yes, no):
                return nodes.Choose(place, self.expression(test), self.expression(yes), self.expression(no))
            case nodes.Call(place, function, arguments):
                return nodes.Call(place, function, tuple(map(self.expression, arguments)))
        return node

    def _named(self, place: Any, name: str, value: Any) -> nodes.Name:
        self.values[name] = value
        return nodes.Name(place, name)
