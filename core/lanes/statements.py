"""Statements, compiled to closures of a call's variables and the mask of the lanes that are there.

A statement takes the mask of its lanes and gives the mask of those that go on behind it. So return, break, continue and
discard are one thing, and where all lanes agree no mask exists. A condition that is one bool branches as Python does.
"""

from collections.abc import Callable, Sequence

import numpy as np

from core.lanes import nodes
from core.lanes.expressions import Evaluated, Expressions, Functions, Stored
from core.lanes.problem import Place, Problem
from core.lanes.run import NOBODY, UNSET, Dialect, Frame, Mask, Nobody, Some, joined, split

Step = Callable[[Frame, Some], Mask]


class Statements:
    """Compiles the statements of one program."""

    expressions: type[Expressions] = Expressions
    """What compiles their expressions."""

    def __init__(self, dialect: Dialect, functions: Functions) -> None:
        self.dialect = dialect
        self._expressions = self.expressions(dialect, functions)
        self._value, self._target = self._expressions.value, self._expressions.target

    def body(self, body: Sequence[nodes.Statement]) -> Step:
        """Compile statements that run one after the other."""
        steps = [self.statement(statement) for statement in body]
        if len(steps) == 1:
            return steps[0]

        def run_body(frame: Frame, mask: Some) -> Mask:
            here = mask
            for step in steps:
                after = step(frame, here)
                if isinstance(after, Nobody):
                    if not frame.run.is_checking:
                        return NOBODY
                    after = None
                here = after
            return here

        return run_body

    def statement(self, node: nodes.Statement) -> Step:
        """Compile a statement."""
        match node:
            case nodes.Nothing():
                return lambda _frame, mask: mask
            case nodes.Block(_, body):
                return self.body(body)
            case nodes.Assign():
                return self._assign(node)
            case nodes.Declare():
                return self._declare(node)
            case nodes.Put():
                return self._put(node)
            case nodes.Evaluate(_, value):
                return self._evaluate(node, self._value(value))
            case nodes.If():
                return self._if(node)
            case nodes.Loop():
                return self._loop(node)
            case nodes.Each():
                return self._each(node)
            case nodes.Break() | nodes.Continue():
                return self._leave(node, int(isinstance(node, nodes.Continue)))
            case nodes.Return():
                return self._return(node)
            case nodes.Discard():
                return self._discard(node)
        raise Problem(node.place, "this is not known here")

    def _assign(self, node: nodes.Assign) -> Step:
        value, store, place = self._value(node.value), self._target(node.target), node.place

        def run_assign(frame: Frame, mask: Some) -> Mask:
            frame.run.tick(place)
            watch = frame.run.watch
            if watch is not None:
                watch.begin(node, mask, frame)
            found = value(frame, mask)
            store(frame, mask, found)
            if watch is not None:
                watch.end(node, mask, frame, found)
            return mask

        return run_assign

    def _declare(self, node: nodes.Declare) -> Step:
        made = None if node.value is None else self._value(node.value)
        place, dialect, keep = node.place, self.dialect, self._expressions.keep

        def run_declare(frame: Frame, mask: Some) -> Mask:
            frame.run.tick(place)
            watch = frame.run.watch
            if watch is not None:
                watch.begin(node, mask, frame)
            if made is None:
                value = dialect.zero(node.of)
            else:
                value = dialect.typed(node.of, made(frame, mask), place, node.name)
            keep(frame, mask, node.name, value, place, is_new=True)
            if made is None and not frame.run.is_checking:
                frame.given[node.name] = np.zeros(frame.run.lanes, bool)
            if watch is not None:
                watch.end(node, mask, frame, value)
            return mask

        return run_declare

    def _put(self, node: nodes.Put) -> Step:
        value, place, look = self._value(node.value), node.place, self._expressions.look

        def run_put(frame: Frame, mask: Some) -> Mask:
            frame.run.tick(place)
            watch = frame.run.watch
            if watch is not None:
                watch.begin(node, mask, frame)
            found = value(frame, mask)
            self.dialect.put(look(frame, mask, node.name, place), found, mask, place, frame.run)
            if watch is not None:
                watch.end(node, mask, frame, found)
            return mask

        return run_put

    def _evaluate(self, node: nodes.Evaluate, value: Evaluated) -> Step:
        def run_evaluate(frame: Frame, mask: Some) -> Mask:
            frame.run.tick(node.place)
            value(frame, mask)
            return mask

        return run_evaluate

    def _if(self, node: nodes.If) -> Step:
        test, yes, place = self._value(node.test), self.body(node.yes), node.place
        no = self.body(node.no) if node.no else None

        def run_if(frame: Frame, mask: Some) -> Mask:
            run = frame.run
            run.tick(place)
            watch = run.watch
            if watch is not None:
                watch.begin(node, mask, frame)
            truth = self.dialect.truth(test(frame, mask), place)
            if watch is not None:
                watch.end(node, mask, frame, truth)
            if run.is_checking:
                yes(frame, mask)
                if no is not None:
                    no(frame, mask)
                return mask
            if np.ndim(truth) == 0:
                if truth:
                    return yes(frame, mask)
                return mask if no is None else no(frame, mask)
            mine, others = split(mask, truth, run.lanes)
            after = mine if isinstance(mine, Nobody) else yes(frame, mine)
            beside = others if no is None or isinstance(others, Nobody) else no(frame, others)
            return mask if after is mine and beside is others else joined(after, beside)

        return run_if

    def _loop(self, node: nodes.Loop) -> Step:
        test, body, place = self._value(node.test), self.body(node.body), node.place
        step = None if node.step is None else self.statement(node.step)

        def turn(frame: Frame, mask: Some, number: int) -> tuple[Mask, Mask]:
            run = frame.run
            watch = run.watch
            if watch is not None:
                watch.begin(node, mask, frame)
            truth = self.dialect.truth(test(frame, mask), place)
            if watch is not None:
                watch.end(node, mask, frame, truth)
            if run.is_checking:
                return (mask, NOBODY) if number == 0 else (NOBODY, mask)
            if np.ndim(truth) == 0:
                return (mask, NOBODY) if truth else (NOBODY, mask)
            return split(mask, truth, run.lanes)

        def run_loop(frame: Frame, mask: Some) -> Mask:
            return _turn_around(frame, mask, place, turn, body, step)

        return run_loop

    def _each(self, node: nodes.Each) -> Step:
        store: Stored = self._target(node.target)
        things, body, place = self._value(node.things), self.body(node.body), node.place

        def run_each(frame: Frame, mask: Some) -> Mask:
            watch = frame.run.watch
            thing_of = self.dialect.turns(things(frame, mask), mask, place, frame.run)

            def turn(frame: Frame, mask: Some, number: int) -> tuple[Mask, Mask]:
                if watch is not None:
                    watch.begin(node, mask, frame)
                mine, others, thing = thing_of(mask, number)
                if not isinstance(mine, Nobody):
                    store(frame, mine, thing)
                    if watch is not None:
                        watch.end(node, mine, frame, thing)
                return mine, others

            return _turn_around(frame, mask, place, turn, body, None)

        return run_each

    def _leave(self, node: nodes.Break | nodes.Continue, which: int) -> Step:
        def run_leave(frame: Frame, mask: Some) -> Mask:
            frame.run.tick(node.place)
            if not frame.loops:
                word = "continue" if which else "break"
                raise Problem(node.place, f"{word} stands outside of a loop")
            frame.loops[-1][which] = joined(frame.loops[-1][which], mask)
            return NOBODY

        return run_leave

    def _return(self, node: nodes.Return) -> Step:
        made = None if node.value is None else self._value(node.value)
        place, dialect = node.place, self.dialect

        def run_return(frame: Frame, mask: Some) -> Mask:
            frame.run.tick(place)
            watch = frame.run.watch
            if watch is not None:
                watch.begin(node, mask, frame)
            value = dialect.nothing if made is None else made(frame, mask)
            dialect.check_stored(value, mask, place, frame.run)
            if frame.value is UNSET or (mask is None and not frame.run.is_checking):
                frame.value = value
            else:
                flags = np.ones(frame.run.lanes, bool) if mask is None else mask
                frame.value = dialect.merged(flags, value, frame.value, place, frame.run, 1)
            frame.returned += 1
            if watch is not None:
                watch.end(node, mask, frame, value)
            return NOBODY

        return run_return

    def _discard(self, node: nodes.Discard) -> Step:
        def run_discard(frame: Frame, mask: Some) -> Mask:
            frame.run.tick(node.place)
            frame.run.dead = joined(frame.run.dead, mask)
            frame.returned += 1
            return NOBODY

        return run_discard


def _turn_around(
    frame: Frame,
    mask: Some,
    place: Place,
    turn: Callable[[Frame, Some, int], tuple[Mask, Mask]],
    body: Step,
    step: Step | None,
) -> Mask:
    """Run rounds of a loop until no lane goes on; return the mask behind it."""
    run, returned = frame.run, frame.returned
    here: Mask = mask
    gone: Mask = NOBODY
    number = 0
    while not isinstance(here, Nobody):
        run.tick(place)
        here, done = turn(frame, here, number)
        gone = joined(gone, done)
        if isinstance(here, Nobody):
            break
        if number >= run.limits.rounds:
            some = run.some(here)
            raise Problem(place, f"the loop goes on after {number:,} rounds{some}: does it ever end?")
        number += 1
        left: list[Mask] = [NOBODY, NOBODY]
        frame.loops.append(left)
        after = body(frame, here)
        frame.loops.pop()
        here, gone = joined(after, left[1]), joined(gone, left[0])
        if step is not None and not isinstance(here, Nobody):
            step(frame, here)
    return mask if frame.returned == returned and not isinstance(gone, Nobody) else gone
