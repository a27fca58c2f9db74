"""The record of a shader's run: which statement ran for which lanes, one after the other."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from core.lanes.masks import Some
from core.lanes.nodes import Assign, Declare, Field, Index, Name, Statement
from core.lanes.problem import Problem
from core.lanes.run import Frame, Run
from core.records.arrays import Flags

Reads = tuple[tuple[str, Flags], ...]
"""Own names of variables, and the lanes (L,) that have read them."""
STEP_LIMIT = 20_000
"""Statements of a run that is recorded."""


@dataclass(frozen=True, eq=False)
class ExecutedStatement:
    """A statement that ran for some of L lanes."""

    node: Statement
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

    def begin(self, statement: Statement, mask: Some, frame: Frame) -> None:
        """Note a statement that is about to run in the lanes of a mask (L,): its calls come behind it."""
        if len(self.steps) >= STEP_LIMIT:
            raise Problem(statement.place, f"this takes more than {STEP_LIMIT:,} steps: stopped here")
        self._open.begin(frame.run)
        live = np.ones(self._lanes, bool) if mask is None else mask
        self.steps.append(ExecutedStatement(statement, frame.depth, np.packbits(live), self._lanes, None))

    def end(self, statement: Statement, mask: Some, frame: Frame, value: Any) -> None:
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


def stored_name(statement: Statement) -> str:
    """Return the own name of the variable that a statement gives a value; empty: none."""
    if isinstance(statement, Declare):
        return statement.name
    if not isinstance(statement, Assign):
        return ""
    target = statement.target
    while isinstance(target, Index | Field):
        target = target.whole
    return target.name if isinstance(target, Name) else ""
