"""Expressions, compiled to closures of a call's variables and the mask of the lanes that are there."""

from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np

from core.lanes import nodes
from core.lanes.problem import Place, Problem
from core.lanes.run import Dialect, Frame, Nobody, Some, Value, split

Evaluated = Callable[[Frame, Some], Value]
Stored = Callable[[Frame, Some, Value], None]


class Functions(Protocol):
    """The functions that a program may call beside those of its language."""

    def names(self) -> Sequence[str]:
        """Return their names."""

    def call_named(self, name: str, values: Sequence[Value], mask: Some, place: Place, frame: Frame) -> Value:
        """Return what one of them gives."""


class Expressions:
    """Compiles the expressions of one program."""

    def __init__(self, dialect: Dialect, functions: Functions) -> None:
        self._dialect, self._functions = dialect, functions

    def value(self, node: nodes.Expression) -> Evaluated:
        """Compile what has a value."""
        match node:
            case nodes.Constant(place, typed):
                constant = self._dialect.constant(typed, place)
                return lambda _frame, _mask: constant
            case nodes.Name(place, name):
                return self._name(place, name)
            case nodes.Binary(place, operator, left, right):
                rule, first, second = self._dialect.rule(operator, place), self.value(left), self.value(right)
                return lambda frame, mask: rule(first(frame, mask), second(frame, mask), mask, frame.run)
            case nodes.Unary(place, operator, operand):
                prefix, only = self._dialect.prefix(operator, place), self.value(operand)
                return lambda frame, mask: prefix(only(frame, mask))
            case nodes.Logic():
                return self._logic(node)
            case nodes.Choose():
                return self._choose(node)
            case nodes.Index(place, whole, index):
                of, at = self.value(whole), self.value(index)
                part = self._dialect.part
                return lambda frame, mask: part(of(frame, mask), at(frame, mask), mask, place, frame.run)
            case nodes.Field(place, whole, name):
                owner = self.value(whole)
                return lambda frame, mask: self._dialect.field(owner(frame, mask), name, place)
            case nodes.Many(place, parts):
                return self._many(place, parts)
            case nodes.Gather():
                return self._gather(node)
            case nodes.Call(place, function, arguments):
                return self._call(place, function, [self.value(argument) for argument in arguments])
        raise Problem(node.place, "this has no value")

    def target(self, node: nodes.Expression) -> Stored:
        """Compile what a value is stored in."""
        match node:
            case nodes.Name(place, name):
                return lambda frame, mask, value: self.keep(frame, mask, name, value, place)
            case nodes.Many(place, parts):
                return self._several(place, parts)
            case nodes.Index(place, nodes.Name(_, name), index):
                return self._element(place, name, self.value(index))
            case nodes.Field(place, nodes.Name(_, name), field):
                return self._element(place, name, lambda _frame, _mask: field)
            case nodes.Index(place, nodes.Index(_, nodes.Name(_, name), outer), inner):
                return self._inner_element(place, name, self.value(outer), self.value(inner))
        raise Problem(node.place, "nothing can be stored here: the left side of = must be a name, or several")

    def keep(
        self, frame: Frame, mask: Some, name: str, value: Value, place: Place, is_new: bool = False
    ) -> None:
        """Store a value in a variable, in the lanes of a mask; the mask is (L,)."""
        run, dialect, names = frame.run, self._dialect, frame.names
        dialect.check_stored(value, mask, place, run)
        is_known = name in names and not is_new
        held = dialect.size(names[name]) if name in names else 0
        if is_known and dialect.is_typed:
            dialect.check_kept(name, names[name], value, place)
        if mask is None:
            names[name] = value
            frame.given.pop(name, None)
        elif is_known:
            names[name] = dialect.merged(mask, value, names[name], place, run)
            if name in frame.given:
                frame.given[name] = frame.given[name] | mask
                if frame.given[name].all():
                    del frame.given[name]
        else:
            names[name], frame.given[name] = value, mask
        run.make_room(place, dialect.size(names[name]) - held)

    def look(self, frame: Frame, mask: Some, name: str, place: Place) -> Value:
        """Return the value of a variable, which all lanes of a mask must have given one; the mask is (L,)."""
        if name not in frame.names:
            known = [*frame.names, *self._functions.names()]
            raise Problem(place, self._dialect.unknown(name, known))
        given = frame.given.get(name)
        if given is not None and not frame.run.is_checking:
            missing = ~given if mask is None else mask & ~given
            if missing.any():
                some = frame.run.some(missing)
                raise Problem(place, f"{name} has no value here{some}: it is set in one branch only")
        return frame.names[name]

    def _name(self, place: Place, name: str) -> Evaluated:
        def read(frame: Frame, mask: Some) -> Value:
            if name in frame.names and name not in frame.given:
                return frame.names[name]
            return self.look(frame, mask, name, place)

        return read

    def _logic(self, node: nodes.Logic) -> Evaluated:
        dialect, is_and, place = self._dialect, node.is_and, node.place
        parts = [self.value(part) for part in node.parts]

        def logic(frame: Frame, mask: Some) -> Value:
            found: Any = None
            here, run = mask, frame.run
            for part in parts:
                truth = dialect.truth(part(frame, here), place)
                if np.ndim(truth) == 0 and not run.is_checking:
                    if bool(truth) != is_and:
                        decided = found is None or np.ndim(found) == 0
                        return dialect.flag(truth if decided else np.full_like(found, not is_and))
                    continue
                found = truth if found is None else (found & truth if is_and else found | truth)
                if np.ndim(found) and not run.is_checking:
                    left, _ = split(here, found if is_and else ~found, run.lanes)
                    if isinstance(left, Nobody):
                        break
                    here = left
            return dialect.flag(is_and if found is None else found)

        return logic

    def _choose(self, node: nodes.Choose) -> Evaluated:
        dialect, place = self._dialect, node.place
        test, yes, no = self.value(node.test), self.value(node.yes), self.value(node.no)

        def choose(frame: Frame, mask: Some) -> Value:
            run = frame.run
            truth = dialect.truth(test(frame, mask), place)
            if run.is_checking:
                flags = np.broadcast_to(np.asarray(truth), (run.lanes,))
                return dialect.merged(flags, yes(frame, mask), no(frame, mask), place, run)
            if np.ndim(truth) == 0:
                return yes(frame, mask) if truth else no(frame, mask)
            mine, others = split(mask, truth, run.lanes)
            if isinstance(mine, Nobody):
                return no(frame, mask)
            if isinstance(others, Nobody):
                return yes(frame, mask)
            return dialect.merged(truth, yes(frame, mine), no(frame, others), place, run)

        return choose

    def _many(self, place: Place, several: Sequence[nodes.Expression]) -> Evaluated:
        starred = [isinstance(node, nodes.Star) for node in several]
        parts = [self.value(node.part if isinstance(node, nodes.Star) else node) for node in several]
        many = self._dialect.many
        return lambda frame, mask: many(
            [part(frame, mask) for part in parts], starred, mask, place, frame.run
        )

    def _gather(self, node: nodes.Gather) -> Evaluated:
        dialect, place = self._dialect, node.place
        store, things, element = self.target(node.target), self.value(node.things), self.value(node.element)
        tests = [self.value(test) for test in node.tests]

        def gather(frame: Frame, mask: Some) -> Value:
            kept, given, made, size = dict(frame.names), dict(frame.given), list[Value](), 0
            for thing in dialect.elements(things(frame, mask), mask, place, frame.run):
                frame.run.tick(place)
                store(frame, None, thing)
                if all(dialect.uniform(test(frame, mask), place) for test in tests):
                    made.append(element(frame, mask))
                    size += dialect.size(made[-1])
                    frame.run.check_room(place, size)
            frame.names, frame.given = kept, given
            return dialect.many(made, [False] * len(made), mask, place, frame.run)

        return gather

    def _call(self, place: Place, name: str, arguments: Sequence[Evaluated]) -> Evaluated:
        dialect, functions = self._dialect, self._functions

        def call(frame: Frame, mask: Some) -> Value:
            values = [argument(frame, mask) for argument in arguments]
            if name in functions.names():
                return functions.call_named(name, values, mask, place, frame)
            return dialect.call(name, values, mask, place, frame.run)

        return call

    def _several(self, place: Place, several: Sequence[nodes.Expression]) -> Stored:
        starred = [isinstance(node, nodes.Star) for node in several]
        parts = [self.target(node.part if isinstance(node, nodes.Star) else node) for node in several]

        def unpack(frame: Frame, mask: Some, value: Value) -> None:
            values = self._dialect.unpacked(value, starred, mask, place, frame.run)
            for store, one in zip(parts, values, strict=True):
                store(frame, mask, one)

        return unpack

    def whole(self, frame: Frame, mask: Some, name: str, place: Place) -> Value:
        """Return the value of a variable of which a part is about to be stored; the mask is (L,)."""
        return self.look(frame, mask, name, place)

    def _element(self, place: Place, name: str, at: Callable[[Frame, Some], Any]) -> Stored:
        def store(frame: Frame, mask: Some, value: Value) -> None:
            old = self.whole(frame, mask, name, place)
            new = self._dialect.with_part(old, at(frame, mask), value, mask, place, frame.run)
            self.keep(frame, mask, name, new, place)

        return store

    def _inner_element(self, place: Place, name: str, outer: Evaluated, inner: Evaluated) -> Stored:
        dialect = self._dialect

        def store(frame: Frame, mask: Some, value: Value) -> None:
            run, whole, index = frame.run, self.whole(frame, mask, name, place), outer(frame, mask)
            row = dialect.part(whole, index, mask, place, run)
            changed = dialect.with_part(row, inner(frame, mask), value, mask, place, run)
            self.keep(frame, mask, name, dialect.with_part(whole, index, changed, mask, place, run), place)

        return store
