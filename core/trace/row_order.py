"""The rows of a trace in another order: the same decisions, listed as a method with other loops visits them."""

from dataclasses import replace

import numpy as np

from core.records.arrays import Integers
from core.records.steps import RowOrder, ends_of
from core.trace.stage_trace import StageTrace


def in_order(found: StageTrace, order: RowOrder) -> StageTrace:
    """Return a trace with its rows sorted pixel by pixel or row by row; rows of one pixel keep their order.

    Notes
    -----
    What a row reads and writes belongs to its own pixel. So every row still stands after those that it builds on,
    each row has the same numbers as before, and the buffers end with the same values, bit for bit.
    """
    keys = order.keys(found.pixel)
    within = keys[1] if order.is_by_pixel else found.triangle
    return replace(in_rows(found, np.lexsort(keys[::-1]), keys[0], within), order=order)


def in_rows(found: StageTrace, rows: Integers, outer: Integers, within: Integers) -> StageTrace:
    """Return a trace whose rows stand in the order of ``rows`` (R,).

    Parameters
    ----------
    outer, within : (R,) int64
        What a step of the levels TRIANGLE and GROUP is about, by the rows as they stood.
    """
    place = np.empty_like(rows)
    place[rows] = np.arange(len(rows))
    outer = outer[rows]
    ends = ends_of(outer), ends_of(outer, within[rows])
    return replace(
        found,
        steps=replace(found.steps, kind=found.steps.kind[rows], triangle_ends=ends[0], group_ends=ends[1]),
        columns={name: column[rows] for name, column in found.columns.items()},
        triangle=found.triangle[rows],
        pixel=found.pixel[rows],
        marks={name: flags[rows] for name, flags in found.marks.items()},
        buffers=tuple(track.moved(place) for track in found.buffers),
    )
