"""The search for something smaller that fails in the same way.

References
----------
A. Zeller, R. Hildebrandt, *Simplifying and isolating failure-inducing input*, 2002.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Generic

import numpy as np

from core.records.arrays import Integers
from core.scene import AnyScene
from core.settings import Settings
from core.study.stability.experiment import Verdict
from core.study.stability.minimization.kind import Kind, Parts
from core.study.stability.record import Outcome
from core.study.stability.stress import StressCancelledError

Judge = Callable[[Any, Settings], Verdict]
"""Runs a scene of the kind that it knows."""


@dataclass
class Search(Generic[Parts]):
    """Runs candidates, counts the runs, and stops where there are too many."""

    kind: Kind[Parts]
    settings: Settings
    judge: Judge
    most_runs: int
    is_cancelled: Callable[[], bool] | None
    run_count: int = 0

    def smallest(self, scene: AnyScene) -> tuple[Parts, Verdict]:
        """Return what is left of a failing scene, and what comes of it: the same outcome.

        Raises
        ------
        ValueError
            If the scene does not fail.
        """
        parts = self.kind.take_apart(scene)
        verdict = self._verdict(parts)
        if verdict is None or verdict.outcome in (Outcome.RIGHT, Outcome.REFUSED):
            raise ValueError("a scene that fails is wanted, got one that is right or refused")
        changed = True
        while changed and not self._is_spent():
            changed = False
            for way in self.kind.ways:
                while (found := self._simpler(parts, way, verdict.outcome)) is not None:
                    parts, verdict = found
                    changed = True
        return parts, verdict

    def _is_spent(self) -> bool:
        """Whether no more runs are left."""
        return self.run_count >= self.most_runs

    def _simpler(
        self, parts: Parts, way: Callable[[Parts], Iterator[Parts]], outcome: Outcome
    ) -> tuple[Parts, Verdict] | None:
        """Return the first candidate that ends in ``outcome`` too; ``None``: there is none, or no run is left."""
        for candidate in way(parts):
            if self._is_spent():
                return None
            verdict = self._verdict(candidate)
            if verdict is not None and verdict.outcome == outcome:
                return candidate, verdict
        return None

    def _verdict(self, parts: Parts) -> Verdict | None:
        """Run a candidate; ``None``: it is no scene, or nobody knows what is right for it."""
        if self.is_cancelled is not None and self.is_cancelled():
            raise StressCancelledError("shrinking was cancelled")
        self.run_count += 1
        try:
            return self.judge(self.kind.put_together(parts), self.settings)
        except ValueError:
            return None


def without_parts(count: int) -> Iterator[Integers]:
    """Yield what is left, (Q,) int64, of ``count`` things without a half, a quarter, an eighth ... of them."""
    every = np.arange(count)
    part = count // 2
    while part:
        for start in range(0, count, part):
            left = every[(every < start) | (every >= start + part)]
            if len(left):
                yield left
        part //= 2
