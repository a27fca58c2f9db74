"""Rows of another kind put between those of a trace: what a stage does before the work that its trace is about."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Integers
from core.records.listing import Listing
from core.records.operation import Operation
from core.records.steps import Steps, ends_of
from core.trace.stage_trace import StageTrace, no_pixels


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
