"""The record of a shader's run: which statement ran for which lanes, one after the other."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from core.lanes.masks import Some
from core.lanes.nodes import Assign, Declare, Field, Index, Name, Statement
from core.lanes.problem import Problem
from core.lanes.run import Frame
from core.records.arrays import Flags

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

    @property
    def line(self) -> int:
        """Its line, from 1."""
        return self.node.place.line

    @property
    def live(self) -> Flags:
        """(L,) bool, the lanes that it ran for."""
        return np.unpackbits(self.packed, count=self.lanes).view(bool)


class Recorder:
    """Looks on while a shader runs, and keeps every statement."""

    def __init__(self, lanes: int) -> None:
        self.steps: list[ExecutedStatement] = []
        self._lanes = lanes

    def begin(self, statement: Statement, mask: Some, frame: Frame) -> None:
        """Note a statement that is about to run in the lanes of a mask (L,): its calls come behind it."""
        if len(self.steps) >= STEP_LIMIT:
            raise Problem(statement.place, f"this takes more than {STEP_LIMIT:,} steps: stopped here")
        live = np.ones(self._lanes, bool) if mask is None else mask
        self.steps.append(ExecutedStatement(statement, frame.depth, np.packbits(live), self._lanes, None))

    def end(self, statement: Statement, mask: Some, frame: Frame, value: Any) -> None:
        """Note what the statement gave in the lanes of a mask (L,)."""
        for at in range(len(self.steps) - 1, -1, -1):
            step = self.steps[at]
            if step.node is statement and step.depth == frame.depth:
                name = stored_name(statement)
                whole = frame.names.get(name) if name else None
                self.steps[at] = ExecutedStatement(
                    statement, step.depth, step.packed, self._lanes, value, whole
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
