"""What every stage's trace is: rows of numbers, marks, and buffers as they fill; rows that are put between others."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Flags, Integers, cached_property, read_only
from core.records.listing import EditedListing, Listing, Operation
from core.records.steps import RowOrder, Steps, ends_of

if TYPE_CHECKING:
    from core.lanes.program import LaneStep


# What every stage's trace is: rows of numbers, marks, and buffers as they fill.


Value = float | int | bool | str | NDArray[Any]
MARKS = ("covered", "rejected", "tie", "nan", "depth-failed")
"""Kinds of marks on the timeline."""
PRESENTED = ("written", "flushed", "wait", "swap", "scan")
"""Kinds of rows of a presentation, which summaries count one by one."""
KEPT_EXPLANATIONS = 16
"""Of the last steps that were asked for: all that is said of a step is made from the same one, once."""


@dataclass(frozen=True, eq=False)
class BufferTrack:
    """A buffer and who writes what into it."""

    name: str
    initial: NDArray[Any]
    """(h, w) or (h, w, C), the buffer before the first row; NaN (or -1 in identities) where nothing is known yet."""
    rows: Integers
    """(k,) int64, rising: the rows that write."""
    places: Integers
    """(k,) int64, index into the flattened buffer that each writes."""
    values: NDArray[Any]
    """(k,) or (k, C), what each writes."""
    kind: str = "scalar"
    """``scalar``, ``signed``, ``color``, ``bytes``, ``ids``, ``flags`` or ``count``: how it is to be looked at."""
    starts_known: bool = False
    """Whether ``initial`` is a buffer of the frame, rather than no values yet."""

    def moved(self, place: Integers) -> "BufferTrack":
        """Return the same writes by rows that now stand at ``place`` (R,)."""
        rows = place[self.rows]
        order = np.argsort(rows, kind="stable")
        return replace(self, rows=rows[order], places=self.places[order], values=self.values[order])

    def at(self, rows_done: int) -> NDArray[Any]:
        """Return the buffer after ``rows_done`` rows; of several writes to a place the last one stays."""
        done = int(np.searchsorted(self.rows, rows_done, "left"))
        buffer = self.initial.copy()
        flat = buffer.reshape(-1, *buffer.shape[2:])
        flat[self.places[:done]] = self.values[:done]
        return read_only(buffer)

    @cached_property
    def value_range(self) -> tuple[float, float]:
        """Least and greatest finite value that the buffer ever holds; (0, 1) where there is none."""
        held = [self.values.ravel()] + ([self.initial.ravel()] if self.starts_known else [])
        values = np.concatenate(held).astype(float)
        values = values[np.isfinite(values)]
        return (float(values.min()), float(values.max())) if values.size else (0.0, 1.0)

    def known_at(self, rows_done: int) -> Flags:
        """Return (h, w) bool, where the buffer holds something after ``rows_done`` rows."""
        known = np.full(self.initial.shape[:2], self.starts_known)
        known.ravel()[self.places[: int(np.searchsorted(self.rows, rows_done, "left"))]] = True
        return known


@dataclass(frozen=True, eq=False)
class Explanation:
    """What one step did. Core gives keys and numbers; sentences and formulas are made from them."""

    key: str
    """``stage.kind.operation``: names the sentence and the formula."""
    values: Mapping[str, Value]
    """All variables of the row, those of later operations too."""
    known: tuple[str, ...]
    """Variables that have a value by now."""
    changed: tuple[str, ...]
    """Variables that this operation has set."""
    listing: Listing | None
    """The algorithm that the operation is part of."""
    line: int
    """Its line, from 1; 0: none."""
    earlier: tuple["Explanation", ...] = ()
    """What the row has done before, operation by operation."""
    corner_count: int = 3
    """Corners of what is drawn: 2 of segments, 1 of points."""
    later_lines: tuple[int, ...] = ()
    """Of an edited listing: its lines that the row runs after this operation."""
    step: "LaneStep | None" = None
    """The statement of a shader that ran, with its variables; ``None``: the row runs none."""


@dataclass(frozen=True, eq=False)
class StageTrace:
    """The work of one stage as R rows, in drawing order or as ``order`` says."""

    stage: str
    method: str
    """Name of the method that ran, as ``fill=hierarchy``; empty where the stage has no choice."""
    steps: Steps
    columns: Mapping[str, NDArray[Any]]
    """Every number that took part in a decision: name to (R, ...) array."""
    triangle: Integers
    """(R,) int64, number of the triangle in drawing order, -1: none."""
    pixel: Integers
    """(R, 2) int64 column and row, -1: the row of the trace is about no pixel."""
    listings: Mapping[str, Listing]
    """Kind of row, or ``kind.operation``, to its listing."""
    marks: Mapping[str, Flags] = field(default_factory=dict)
    """Kind of mark (``MARKS``) to (R,) bool."""
    buffers: tuple[BufferTrack, ...] = ()
    extra: Mapping[str, Any] = field(default_factory=dict)
    """Records of the stage that its own view draws (blocks, clipped polygons, spaces of the vertices)."""
    constants: Mapping[str, Value] = field(default_factory=dict)
    """Variables that are the same in all rows."""
    corner_count: int = 3
    """Corners of what is drawn: 2 of segments, 1 of points."""
    given: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Kind of row to the variables that earlier rows have set for it."""
    order: RowOrder | None = None
    """The order of the rows and the names of its levels; ``None``: triangle by triangle."""

    def kind_of(self, row: int) -> str:
        """Return the kind of a row."""
        return self.steps.kinds[int(self.steps.kind[row])]

    def variables(self, row: int) -> dict[str, Value]:
        """Return all variables of a row."""
        found: dict[str, Value] = dict(self.constants)
        for name, column in self.columns.items():
            value = column[row]
            found[name] = value if isinstance(value, np.ndarray) else value.item()
        return found

    @cached_property
    def _latest(self) -> dict[int, Mapping[str, Value]]:
        """The row that was explained last, to its variables: all of its operations are about these."""
        return {}

    @cached_property
    def _explained(self) -> dict[int, Explanation | None]:
        return {}

    def explain(self, position: int) -> Explanation | None:
        """Explain the operation that was done last; ``None`` at the initial state."""
        explained = self._explained.get(position)
        if explained is None:
            explained = self._explain(position)
            if len(self._explained) >= KEPT_EXPLANATIONS:
                self._explained.clear()
            self._explained[position] = explained
        return explained

    def _explain(self, position: int) -> Explanation | None:
        row, operation = self.steps.row_at(position)
        if row < 0:
            return None
        values = self._latest.get(row)
        if values is None:
            values = self.variables(row)
            self._latest.clear()
            self._latest[row] = values
        done: tuple[Explanation, ...] = ()
        for k in range(operation + 1):
            done = (*done, replace(self._done(row, values, k), earlier=done))
        return done[-1]

    def _done(self, row: int, values: Mapping[str, Value], operation: int) -> Explanation:
        """Explain one operation of a row with its variables."""
        kind = self.kind_of(row)
        operations: tuple[Operation, ...] = self.steps.operations[kind]
        done = operations[operation]
        listing = self._listing_of(kind, done)
        later: tuple[int, ...] = ()
        if isinstance(listing, EditedListing):
            own = [o for o in operations[operation + 1 :] if self._listing_of(kind, o) is listing]
            later = tuple(listing.lines.get(o.label_at(self.columns, row), 0) for o in own)
        return Explanation(
            key=f"{self.stage}.{kind}.{done.name}",
            values=values,
            known=(
                *self.constants,
                *self.given.get(kind, ()),
                *(name for o in operations[: operation + 1] for name in o.shows),
            ),
            changed=tuple(done.sets),
            listing=listing,
            line=listing.lines.get(done.label_at(self.columns, row), 0) if listing else 0,
            corner_count=self.corner_count,
            later_lines=later,
        )

    def _listing_of(self, kind: str, operation: Operation) -> Listing | None:
        return self.listings.get(f"{kind}.{operation.name}", self.listings.get(kind))

    def state(self, position: int) -> dict[str, NDArray[Any]]:
        """Return all buffers as they are at a position; a row counts when its last operation is done."""
        rows_done = self.steps.rows_done(position)
        return {track.name: track.at(rows_done) for track in self.buffers}

    def rows_at_pixel(self, column: int, row: int) -> Integers:
        """Return the rows that are about one pixel."""
        return np.flatnonzero((self.pixel[:, 0] == column) & (self.pixel[:, 1] == row))

    def line_shares(self, row: int) -> Mapping[int, float]:
        """Return the lines (from 1) of a shader that the row runs, each with the share of lanes that run it."""
        return {}

    def waiting_at(self, row: int) -> tuple[Integers, Integers] | None:
        """Return the fragments (n,) that wait, and those that were discarded, while a shader's row runs."""
        return None

    def summary(self, first: int, end: int) -> dict[str, int]:
        """Count the rows from ``first`` to ``end`` (excluded), the pixels ``tested`` in them, and their marks.

        ``samples`` is 1 where the rows are about samples of pixels, else 0. Rows about ``boxes`` count if there are.
        """
        kinds = [k for k, name in enumerate(self.steps.kinds) if _tests_pixel(self.steps.operations[name])]
        tested = int(np.count_nonzero(np.isin(self.steps.kind[first:end], kinds))) if kinds else 0
        counts = {"rows": end - first, "tested": tested, "samples": int("sample" in self.columns)}
        boxes = int(np.count_nonzero(self.triangle[first:end] < 0)) if "node" in self.columns else 0
        counts |= {"boxes": boxes} if boxes else {}
        for name in PRESENTED if "scan" in self.steps.kinds else ():
            number = self.steps.kinds.index(name)
            counts[name] = int(np.count_nonzero(self.steps.kind[first:end] == number))
        for name, flags in self.marks.items():
            counts[name] = int(np.count_nonzero(flags[first:end]))
        return counts


def _tests_pixel(done: tuple[Operation, ...]) -> bool:
    """Return whether a row that does this decides by a test whether its pixel is covered."""
    return any(operation.name == "decide" and "covered" in operation.sets for operation in done)


def no_pixels(count: int) -> Integers:
    """Return (count, 2) pixels of rows that are about none."""
    return np.full((count, 2), -1, np.int64)


def without_steps(found: StageTrace) -> StageTrace:
    """Return the trace of a stage that a scene does not go through: nothing was done."""
    start = np.zeros(1, np.int64)
    tracks = (
        replace(track, rows=track.rows[:0], places=track.places[:0], values=track.values[:0])
        for track in found.buffers
    )
    return replace(
        found,
        steps=Steps(found.steps.kinds, found.steps.kind[:0], found.steps.operations, start, start),
        columns={name: column[:0] for name, column in found.columns.items()},
        triangle=found.triangle[:0],
        pixel=found.pixel[:0],
        marks={name: flags[:0] for name, flags in found.marks.items()},
        buffers=tuple(tracks),
    )


# Rows of another kind put between those of a trace: what a stage does before the work that its trace is
# about.


@dataclass(frozen=True, eq=False)
class InsertedRows:
    """I rows, in order; about no pixel, where they have none."""

    before: Integers
    """(I,) int64, rising: the row of the trace that each stands before; R: after all."""
    group: Integers
    """(I,) int64, what is one step of the level GROUP, in the numbers of the trace's own groups."""
    triangle: Integers
    """(I,) int64, see ``StageTrace``."""
    kinds: tuple[str, ...]
    kind: Integers
    """(I,) int64, index of ``kinds``."""
    operations: Mapping[str, tuple[Operation, ...]]
    columns: Mapping[str, NDArray[Any]]
    """Name to (I, ...) array; a column that the trace does not have is empty (NaN, -1, no text) in its rows."""
    listings: Mapping[str, Listing]
    pixel: Integers | None = None
    """(I, 2) int64 column and row; ``None``: about no pixel."""


def insert_rows(found: StageTrace, group: Integers, rows: InsertedRows) -> StageTrace:
    """Return a trace with ``rows`` in their places; ``group`` (R,) numbers the groups of the rows that are there."""
    count, added = found.steps.row_count, len(rows.before)
    order = np.argsort(np.concatenate([2 * np.arange(count) + 1, 2 * rows.before]), kind="stable")
    place = np.empty(count + added, np.int64)
    place[order] = np.arange(count + added)

    def merged(present: NDArray[Any], new: NDArray[Any]) -> NDArray[Any]:
        return np.concatenate([present, new])[order]

    columns = {}
    for name in {**found.columns, **rows.columns}:
        present, new = found.columns.get(name), rows.columns.get(name)
        if present is None:
            assert new is not None
            present = empty_like(new, count)
        columns[name] = merged(present, empty_like(present, added) if new is None else new)
    triangle = merged(found.triangle, rows.triangle)
    steps = Steps(
        kinds=(*found.steps.kinds, *rows.kinds),
        kind=merged(found.steps.kind, rows.kind + len(found.steps.kinds)),
        operations={**found.steps.operations, **rows.operations},
        triangle_ends=ends_of(triangle),
        group_ends=ends_of(triangle, merged(group, rows.group)),
    )
    return replace(
        found,
        steps=steps,
        columns=columns,
        triangle=triangle,
        pixel=merged(found.pixel, no_pixels(added) if rows.pixel is None else rows.pixel),
        listings={**found.listings, **rows.listings},
        marks={name: merged(flags, np.zeros(added, bool)) for name, flags in found.marks.items()},
        buffers=tuple(replace(track, rows=place[track.rows]) for track in found.buffers),
    )


def empty_like(values: NDArray[Any], count: int) -> NDArray[Any]:
    """Return ``count`` rows of no value like those of a column (R, ...): NaN, -1, False or an empty text."""
    missing: Any = {"f": np.nan, "i": -1, "u": 0, "b": False}.get(values.dtype.kind, "")
    return np.full((count, *values.shape[1:]), missing, values.dtype)
