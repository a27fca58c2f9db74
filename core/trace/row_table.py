"""The rows of the raster stage before their numbers: what each is about, in drawing order."""

from dataclasses import dataclass

import numpy as np

from core.raster.pixel_runs import EVALUATED, SideWalk
from core.records.arrays import Floats, Integers
from core.trace.raster_rows import FILL_OPERATIONS, PRINTED
from core.trace.source import TraceSource

KIND = {name: number for number, name in enumerate(FILL_OPERATIONS)}
"""Number of every kind of row of a fill."""


PIXEL_KINDS = np.array([KIND["test"], KIND["climb"], KIND["step"]])
"""Kind of a pixel's row by how its values were got: ``EVALUATED``, ``ADDED_B`` or ``ADDED_A``."""


@dataclass(frozen=True, eq=False)
class RowTable:
    """R rows, each about a triangle, a stretch of pixels in one of its rows, or one pixel."""

    kind: Integers
    """(R,) int64, number in `KIND`."""
    primitive: Integers
    """(R,) int64."""
    group: Integers
    """(R,) int64, equal in neighbouring rows that are one step of the level GROUP."""
    row: Integers
    """(R,) int64, -1: about no row of pixels."""
    start: Integers
    """(R,) int64, first column of the stretch that the row is about or lies in, -1: none."""
    stop: Integers
    """(R,) int64, column after the last."""
    crossings: Floats
    """(R, 3) float64, x where the edges are crossed; NaN: not known or of no use."""
    run: Integers
    """(R,) int64, index of the run that the row is about or lies in, -1: none."""
    test: Integers
    """(R,) int64, index of the pixel test, -1: the row is about no pixel."""


def rows_of_runs(source: TraceSource) -> RowTable:
    """Return one row for every pixel looked at; of fills by spans, one before the pixels of every span."""
    runs, tests = source.runs, source.tests
    has_spans = runs.crossings is not None
    headers = np.arange(len(runs)) if has_spans else np.empty(0, np.int64)
    run = np.concatenate([headers, tests.run])
    test = np.concatenate([np.full(len(headers), -1), np.arange(len(tests.run))])
    order = np.argsort(run, kind="stable")
    run, test = run[order], test[order]
    span_kind = KIND["span"] if runs.walk is None else _printed_kinds(runs.walk)[run]
    pixel_kind = np.where(
        runs.accepted[run], KIND["accept"], PIXEL_KINDS[np.append(tests.added, EVALUATED)[test]]
    )
    return RowTable(
        kind=np.where(test >= 0, pixel_kind, span_kind),
        primitive=runs.triangle[run],
        group=run if has_spans else runs.group[run],
        row=runs.row[run],
        start=runs.start[run],
        stop=runs.stop[run],
        crossings=runs.crossings[run] if runs.crossings is not None else np.full((len(run), 3), np.nan),
        run=run,
        test=test,
    )


def _printed_kinds(walk: SideWalk) -> Integers:
    """Return (R,) int64, the kind of the row before every span of the printed scanline."""
    found: Integers = np.array([KIND[name] for name in PRINTED])[2 * ~walk.is_upper + ~walk.is_first]
    return found


def printed_columns(walk: SideWalk, table: RowTable) -> dict[str, np.ndarray]:
    """Return the numbers that the sides of the printed scanline are made from: slopes, and x in the row before."""
    run = table.run
    of_sides = {
        "crossing_before": walk.before,
        "slope": walk.slope,
        "width": walk.width,
        "height": walk.height,
    }
    columns = {f"{name}_{k}": values[k][run] for name, values in of_sides.items() for k in range(2)}
    return columns | {"part_x": walk.corner[0][run], "part_y": walk.corner[1][run]}
