"""Cells of an experiment: their outcomes, and a case made smaller: parts left out, cropped, in fewer digits.

A case is a list of elements (triangles, one segment) over vertices, arrays of numbers by name, and a size in pixels.
What kinds of cases there are, and how they are cropped, is in ``kinds``.

References
----------
A. Zeller, R. Hildebrandt, *Simplifying and isolating failure-inducing input*, 2002.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Floats, Integers
from core.records.words import counted
from core.scene import AnyScene
from core.study.record import Axis, Outcome, StudyCancelledError, Verdict

# What a stability experiment says: one outcome for every cell of a grid of parameters, one map for every
# method.


@dataclass(frozen=True)
class ExperimentInfo:
    """What an experiment asks, before it is run."""

    name: str
    """As ``slivers``."""
    title: str
    question: str
    """One sentence: what is varied and what should hold."""
    axes: tuple[Axis, ...]
    """One or two."""
    methods: tuple[str, ...]
    """``family=name``, several joined by a blank; in the order of the maps, the exact ones last. Which fails most is
    measured, not said here."""
    claim: str
    """One sentence that tests/stability pins down: who fails where, and who holds."""


@dataclass(frozen=True, eq=False)
class StabilityMap:
    """The outcomes of one method."""

    method: str
    title: str
    outcome: NDArray[np.uint8]
    """(rows, columns) uint8 `Outcome`, the second axis up, the first to the right; one row where there is one axis."""
    severity: Floats
    """(rows, columns) float64, how wrong: pixels, values; 0 where right, NaN where there is no number."""
    remarks: tuple[tuple[str, ...], ...] = ()
    """(rows, columns) what was said of each run, in a sentence; empty: nothing was kept."""
    seconds: Floats = field(default_factory=lambda: np.empty((0, 0)))
    """(rows, columns) float64 seconds of a run, the least of a block; NaN where it was refused; empty: not timed."""

    def count(self, outcome: Outcome) -> int:
        """Return how many cells ended so."""
        return int(np.count_nonzero(self.outcome == outcome))

    def remark(self, column: int, row: int) -> str:
        """Return what was said of one run; empty: nothing."""
        return self.remarks[row][column] if self.remarks else ""


@dataclass(frozen=True, eq=False)
class Atlas:
    """One experiment, run."""

    experiment: ExperimentInfo
    maps: tuple[StabilityMap, ...]
    """In the order of ``experiment.methods``."""
    seed: int = 0
    machine: Mapping[str, str] = field(default_factory=dict)


# A case made smaller: parts left out, the picture cropped, numbers in fewer digits, as long as it fails
# alike.


DIGITS = 17
"""Significant digits of a float64."""


@dataclass(frozen=True, eq=False)
class Parts:
    """A case, taken apart."""

    elements: Integers
    """(T, n) int64, the vertices of every element."""
    numbers: dict[str, Floats]
    """What it is made of, by the names of the kind's fields."""
    size: tuple[int, int]
    scene: AnyScene
    """What it was taken from; the rest of it stays."""

    def changed(self, **numbers: Floats) -> "Parts":
        """Return the same with other numbers, any shape."""
        return replace(self, numbers=self.numbers | numbers)


@dataclass(frozen=True)
class Field:
    """One array of numbers of a kind of cases."""

    name: str
    rows: str = "whole"
    """What its rows are of: a ``vertex``, an ``element``, or of the ``whole`` case."""
    simplest: tuple[float, ...] = (0.0,)
    """What each number of a row may become at best; one for all."""
    offsets: tuple[float, ...] = (0.0,)
    """Numbers are rounded as multiples from these: pixels' centres are at 0.5."""
    is_tied: bool = False
    """Whether numbers of an element that are the same at its corners change together."""
    most: int = 1 << 20
    """If there are more numbers, all of them stay."""

    def places(self, values: Floats) -> Iterator[tuple[Any, ...]]:
        """Yield the indices of single values, any shape, or of those that change together: (N, 3, C) if tied."""
        if len(values.ravel()) > self.most:
            return
        if not self.is_tied:
            yield from np.ndindex(values.shape)
            return
        for number, channel in np.ndindex(len(values), values.shape[2]):
            of_corners = values[number, :, channel]
            if (of_corners == of_corners[0]).all():
                yield number, slice(None), channel
            else:
                yield from ((number, corner, channel) for corner in range(len(of_corners)))


@dataclass(frozen=True)
class Kind:
    """How cases of one kind are taken apart, cropped and put together."""

    noun: str
    """What an element is: ``triangle``."""
    fields: tuple[Field, ...]
    take_apart: Callable[[AnyScene], Parts]
    """From a scene; a ``ValueError`` where it is of another kind."""
    put_together: Callable[[Parts], AnyScene]
    """To the scene that is run, opens in the stepper and is saved; a ``ValueError`` where the parts make none."""
    crops: tuple[Callable[[Parts], Iterator[Parts]], ...]
    """Each yields smaller pictures, or what else is cut in halves; the most promising first."""

    def as_case(self, scene: AnyScene) -> AnyScene:
        """Return what of a scene is made smaller."""
        return self.put_together(self.take_apart(scene))

    def words(self, parts: Parts) -> str:
        """Return how much it is: ``2 triangles in 1x1 pixels``."""
        return f"{counted(len(parts.elements), self.noun)} in {parts.size[0]}x{parts.size[1]} pixels"

    def smaller(self, parts: Parts, way: int) -> Iterator[Parts]:
        """Yield what is smaller in one of the ways: with fewer elements, cropped, with fewer digits."""
        ways = (self.with_fewer_elements, *self.crops, self.with_fewer_digits)
        yield from ways[way](parts)

    def with_fewer_elements(self, parts: Parts) -> Iterator[Parts]:
        """Yield the case without a half, a quarter, an eighth ... of its elements, and without their vertices."""
        every = np.arange(len(parts.elements))
        part = len(every) // 2
        while part:
            for start in range(0, len(every), part):
                left = every[(every < start) | (every >= start + part)]
                if len(left):
                    used, elements = np.unique(parts.elements[left], return_inverse=True)
                    rows = {"vertex": used, "element": left}
                    kept = {
                        field.name: parts.numbers[field.name][rows[field.rows]]
                        for field in self.fields
                        if field.rows in rows and field.name in parts.numbers
                    }
                    shape = len(left), parts.elements.shape[1]
                    yield replace(parts.changed(**kept), elements=elements.reshape(shape).astype(np.int64))
            part //= 2

    def with_fewer_digits(self, parts: Parts) -> Iterator[Parts]:
        """Yield the case with one number, or those that go together, in fewer digits; the longest numbers first."""
        places = []
        for owner in self.fields:
            values = parts.numbers.get(owner.name, np.empty(0))
            for place in owner.places(values):
                value = float(values[place].flat[0]) if values[place].ndim else float(values[place])
                places.append((-digit_count(value), owner, place, value))
        for negative, owner, place, value in sorted(places, key=lambda each: each[0]):
            simplest = owner.simplest[place[-1] if len(owner.simplest) > 1 else 0]
            for simpler in simpler_numbers(value, simplest, -negative, owner.offsets):
                values = parts.numbers[owner.name].copy()
                values[place] = simpler
                yield parts.changed(**{owner.name: values})


def simpler_numbers(
    value: float, simplest: float, digits: int, offsets: tuple[float, ...] = (0.0,)
) -> Iterator[float]:
    """Yield numbers near ``value`` that are written with fewer than ``digits`` digits, the simplest first."""
    seen = {value}
    rounded = (
        float(f"{value - offset:.{count}g}") + offset for count in range(1, DIGITS) for offset in offsets
    )
    for candidate in (simplest, *rounded):
        if candidate not in seen and (digit_count(candidate) < digits or candidate == simplest):
            seen.add(candidate)
            yield candidate


def digit_count(value: float) -> int:
    """Return how many characters a number takes but for its sign; 0 for 0."""
    return 0 if value == 0 else len(f"{abs(value):g}" if float(f"{value:g}") == value else repr(abs(value)))


@dataclass(frozen=True, eq=False)
class Smallest:
    """What is left of a failing scene."""

    parts: Parts
    verdict: Verdict
    run_count: int


def minimize(
    kind: Kind,
    scene: AnyScene,
    judge: Callable[[Any], Verdict],
    most_runs: int,
    is_cancelled: Callable[[], bool] = lambda: False,
) -> Smallest:
    """Return what is left of a failing scene, with the same outcome.

    Parameters
    ----------
    kind : Kind
        Of the scene.
    judge : callable
        Runs a scene; a ``ValueError`` where nobody knows what is right for it.
    most_runs : int
        Runs after which what is left is returned.
    is_cancelled : callable, optional
        Asked before every run.

    Raises
    ------
    ValueError
        If the scene does not fail.
    StudyCancelledError
        As soon as ``is_cancelled()``.
    """
    run_count = 0

    def verdict_of(parts: Parts) -> Verdict | None:
        """Run a candidate; ``None``: it is no scene, or nobody knows what is right for it."""
        nonlocal run_count
        if is_cancelled():
            raise StudyCancelledError("shrinking was cancelled")
        run_count += 1
        try:
            return judge(kind.put_together(parts))
        except ValueError:
            return None

    def simpler(parts: Parts, way: int) -> tuple[Parts, Verdict] | None:
        """Return the first candidate that fails alike; ``None``: there is none, or no run is left."""
        for candidate in kind.smaller(parts, way):
            if run_count >= most_runs:
                return None
            found = verdict_of(candidate)
            if found is not None and found.outcome == outcome:
                return candidate, found
        return None

    parts = kind.take_apart(scene)
    verdict = verdict_of(parts)
    if verdict is None or verdict.outcome in (Outcome.RIGHT, Outcome.REFUSED):
        raise ValueError("expected a scene that fails, got one that is right or refused")
    outcome, is_changed = verdict.outcome, True
    while is_changed and run_count < most_runs:
        is_changed = False
        for way in range(2 + len(kind.crops)):
            while (found := simpler(parts, way)) is not None:
                parts, verdict = found
                is_changed = True
    return Smallest(parts, verdict, run_count)
