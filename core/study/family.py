"""What a family of methods brings to a study: the work it is put to, how one method runs, and what is counted."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from time import perf_counter, thread_time
from typing import Any

import numpy as np

from core.methods import table
from core.scene import AnyScene
from core.setting_texts import settings_from_texts
from core.settings import Settings
from core.study.record import ErrorMeasure, Judgement, Load, Opening, Pictures, WorkKind, collector_off

BLOCK = 0.003
"""Seconds: a block goes on while it is shorter, so that the caches that another method has filled do not count."""


@dataclass(frozen=True)
class Candidate:
    """One method before it is measured."""

    method: str
    """As `Point.method`."""
    title: str


@dataclass(frozen=True, eq=False)
class Assignment:
    """What all methods of a family are put to, in words; a `Task` is made from it."""

    work: str
    """Name of a `WorkKind`."""
    dials: Mapping[str, float]
    seed: int
    settings: Settings
    """What the methods share."""
    scene: AnyScene | None = None
    """The scene to be measured on, for families that take one."""


class Work(ABC):
    """What methods are put to, made once and the same for all of them; every run begins from nothing."""

    @abstractmethod
    def start(self, settings: Settings) -> Callable[[], Any]:
        """Prepare one run, untimed; return what is to be called and timed."""

    def seconds(self, made: Any, elapsed: float) -> float:
        """Return what counts of the ``elapsed`` seconds of the call that returned ``made``."""
        return elapsed

    @abstractmethod
    def judge(self, settings: Settings, made: Any) -> Judgement:
        """Compare one run with the exact reference."""

    def run(self, settings: Settings) -> Judgement:
        """Run and judge; ValueError if the method does not take the work."""
        return self.judge(settings, self.start(settings)())

    def opening(self, settings: Settings, made: Any) -> Opening | None:
        """Return what opens in the stepper to look at the run; ``None``: nothing was drawn."""
        return None


class Task(Work):
    """Work of a study."""

    unit_count: int
    """Units of work (`WorkKind.unit`) in one run."""

    @abstractmethod
    def counts(self, settings: Settings, made: Any) -> dict[str, int]:
        """Return the work of one run that does not depend on the machine."""

    @abstractmethod
    def pictures(self, settings: Settings, made: Any) -> Pictures:
        """Return what one run drew, the reference and the difference."""


@dataclass(frozen=True, eq=False)
class StudyFamily:
    """One row of the list of studies."""

    name: str
    """The spelling of files, command line and API: the setting that is varied, where it is one."""
    title: str
    varies: tuple[str, ...]
    """Families of the table; the methods of the first are points, and of the others those that are not the default."""
    works: tuple[WorkKind, ...]
    measures: tuple[ErrorMeasure, ...]
    make: Callable[[Assignment], Task]
    base: Settings = field(default_factory=Settings)
    """What all points share."""
    takes_scene: bool = False
    """Whether it measures on a scene, and with settings, that are given."""
    more: tuple[Candidate, ...] = ()
    """Points after those of the table: a method with other numbers."""
    only: tuple[str, ...] = ()
    """The methods of the table that are points; none: all of them."""

    def candidates(self, base: Settings) -> tuple[Candidate, ...]:
        """Return the points in the order of the table."""
        found = []
        for place, family in enumerate(self.varies):
            if family not in table.families:
                continue
            for name in self.only or table.names(family):
                if place == 0 or name != getattr(base, family):
                    found.append(Candidate(f"{family}={name}", table.get(family, name).title))
        return (*found, *self.more)

    def work(self, name: str | None = None) -> WorkKind:
        """Return the work of a name, or the first; ValueError lists those that there are."""
        kinds = {kind.name: kind for kind in self.works}
        name = self.works[0].name if name is None else name
        if name not in kinds:
            raise ValueError(f"work of {self.name} must be one of {', '.join(kinds)}, got {name}")
        return kinds[name]


def settings_of(base: Settings, method: str) -> Settings:
    """Return ``base`` changed by a `Point.method`: ``family=name``, several joined by a blank."""
    return settings_from_texts(dict(part.split("=", 1) for part in method.split()), base)


def chosen_dials(work: WorkKind, given: Mapping[str, float] | None) -> dict[str, float]:
    """Return the value of every dial of a work: those ``given``, the defaults of the others.

    Raises ValueError for a dial that the work does not have, or a value beyond those that can be chosen.
    """
    dials = {dial.name: dial for dial in work.dials}
    values = {name: dial.default for name, dial in dials.items()}
    for name, value in (given or {}).items():
        if name not in dials:
            known = ", ".join(dials) or "none"
            raise ValueError(f"dial of {work.name} must be one of {known}, got {name}")
        low, high = dials[name].values[0], dials[name].values[-1]
        if not low <= value <= high:
            raise ValueError(f"{name} must be from {low:g} to {high:g}, got {value:g}")
        values[name] = float(value)
    return values


def timed_block(work: Work, settings: Settings, load: Load) -> tuple[float, float]:
    """Run a method until a block is full; return the seconds of the block, and of its shortest run."""
    spent, least = 0.0, np.inf
    while least == np.inf or spent < BLOCK:
        call = work.start(settings)
        with collector_off():
            own, start = thread_time(), perf_counter()
            made = call()
            elapsed = perf_counter() - start
            load.add(elapsed, thread_time() - own)
        spent += elapsed
        least = min(least, work.seconds(made, elapsed))
    return spent, least
