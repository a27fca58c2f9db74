"""Where a number comes from: the step that made it, in the same row or in an earlier stage.

A trace is rows of numbers, so nothing has to be recorded for this: the rows of the earlier stage about the same
vertex, edge or fragment are looked up, and the number must stand there bit for bit.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.coverage.traced_edges import ROWS
from core.records.arrays import Integers
from core.trace import Trace
from core.trace.stage_trace import StageTrace


@dataclass(frozen=True)
class Origin:
    """The step that made a number."""

    stage: str
    position: int
    """Operations of the stage that are done when the number is there."""
    variable: str
    """Its name in that stage."""
    is_alike: bool = False
    """Whether that step makes the number's counterpart: of the same corners, but snapped."""


Finder = Callable[[StageTrace, int, StageTrace, int], Integers]
"""Takes a trace, a row of it, the trace of the source, and which element of the variable is meant; returns rows of the
source that may have made it, the latest one last."""


@dataclass(frozen=True)
class _Source:
    """The variable of another row that a variable is a copy of."""

    stage: str
    variable: str
    rows: Finder
    is_alike: bool = False
    """As of `Origin`: the numbers need not be equal."""


def _same_fragment(here: StageTrace, row: int, there: StageTrace, element: int) -> Integers:
    """Return the rows about the same pixel (or sample) of the same primitive."""
    rows = _same_pixel(here, row, there, element)
    same: Integers = rows[there.columns["primitive"][rows] == here.columns["primitive"][row]]
    return same


def _plain_fragment(here: StageTrace, row: int, there: StageTrace, element: int) -> Integers:
    """Return the same where nothing is done to the colour: it has no texture and no light."""
    return _same_fragment(here, row, there, element)[: None if here.kind_of(row) == "plain" else 0]


def _untextured_fragment(here: StageTrace, row: int, there: StageTrace, element: int) -> Integers:
    """Return the same where the surface has the colour of its vertices, lit or not."""
    return _same_fragment(here, row, there, element)[: 0 if "textured" in here.kind_of(row) else None]


def _same_pixel(here: StageTrace, row: int, there: StageTrace, element: int) -> Integers:
    """Return the rows about the same pixel, and sample where there are several."""
    rows = there.rows_at_pixel(*here.pixel[row])
    if "sample" in here.columns and "sample" in there.columns:
        rows = rows[there.columns["sample"][rows] == here.columns["sample"][row]]
    return rows


def _before(here: StageTrace, row: int, there: StageTrace, element: int) -> Integers:
    """Return the earlier rows about the same pixel of the same stage."""
    rows = _same_pixel(here, row, there, element)
    return rows[rows < row]


def _corner(kind: str) -> Finder:
    """Return how the row of a vertex is found that takes it to a space."""

    def rows(here: StageTrace, row: int, there: StageTrace, element: int) -> Integers:
        corner = int(here.columns["corner"][row]) if "corner" in here.columns else element
        is_it = (there.triangle == here.triangle[row]) & (there.columns["corner"] == corner)
        return np.flatnonzero(is_it & (there.steps.kind == there.steps.kinds.index(kind)))

    return rows


def _space_before(here: StageTrace, row: int, there: StageTrace, element: int) -> Integers:
    """Return the row that took the same vertex to the space where this one starts."""
    return np.array(
        [row - 1] if row and there.columns["corner"][row - 1] == here.columns["corner"][row] else [], int
    )


def _edge(first: int) -> Finder:
    """Return how the row of an edge (``first`` is 4) or a snapped corner (0) of the primitive is found."""

    def rows(here: StageTrace, row: int, there: StageTrace, element: int) -> Integers:
        primitive = int(here.columns["primitive"][row]) if "primitive" in here.columns else row
        return np.array([ROWS * primitive + first + element])

    return rows


def _end_of_edge(turn: int) -> Finder:
    """Return how the row of the corner is found that an edge starts (1) or ends (2) at."""

    def rows(here: StageTrace, row: int, there: StageTrace, element: int) -> Integers:
        corner = row // ROWS * ROWS + (int(here.columns["edge"][row]) + turn) % 3
        return np.array([corner] if corner < row else [], int)

    return rows


def _earlier_of_line(which: int) -> Finder:
    """Return how an earlier row about the same line is found: its first (0), or the one before (-1)."""

    def rows(here: StageTrace, row: int, there: StageTrace, element: int) -> Integers:
        if "segment" not in here.columns:
            return np.empty(0, int)
        segment = here.columns["segment"]
        is_line = np.char.startswith(np.array(here.steps.kinds), here.method.removeprefix("line="))
        of_line = np.flatnonzero((segment[:row] == segment[row]) & is_line[here.steps.kind[:row]])
        return of_line[[which]] if len(of_line) else of_line

    return rows


SOURCES = {
    **{f"transform.before_{axis}": _Source("transform", f"after_{axis}", _space_before) for axis in "xyzw"},
    "transform.before": _Source("transform", "after", _space_before),
    "cull.w": _Source("transform", "after_w", _corner("camera-to-clip")),
    "edges.window": _Source("transform", "after", _corner("viewport")),
    "edges.start": _Source("edges", "snapped", _end_of_edge(1)),
    "edges.finish": _Source("edges", "snapped", _end_of_edge(2)),
    **{f"raster.{name}": _Source("edges", name, _edge(4)) for name in ("a", "b", "c", "owns_tie")},
    **{f"interpolate.{name}": _Source("edges", name, _edge(4), is_alike=True) for name in "abc"},
    "interpolate.corner_w": _Source("transform", "after_w", _corner("camera-to-clip")),
    "shade.color": _Source("interpolate", "color", _plain_fragment),
    "shade.albedo": _Source("interpolate", "color", _untextured_fragment),
    "shade.vertex_color": _Source("interpolate", "color", _same_fragment),
    **{
        f"shade.{name}": _Source("interpolate", name, _same_fragment)
        for name in ("uv", "diffuse_light", "specular_light")
    },
    **{
        f"raster.{name}": _Source("raster", name, _earlier_of_line(0))
        for name in ("dx", "dy", "sx", "sy", "slope", "intercept", "cosine", "length")
    },
    **{
        f"raster.{name}_before": _Source("raster", now, _earlier_of_line(-1))
        for name, now in (("sum", "sum_advanced"), ("major", "major"), ("minor", "minor"))
    },
    "depth.before": _Source("depth", "after", _before),
    "blend.source": _Source("shade", "color", _same_fragment),
    "blend.before": _Source("blend", "after", _before),
    "resolve.linear": _Source("blend", "after", _same_pixel),
}
"""``stage.variable`` to what it is a copy of."""


def origin(
    trace: Trace, stage: str, position: int, variable: str, element: int | None = None
) -> Origin | None:
    """Return the step that made a variable's number.

    Parameters
    ----------
    position : int
        Operations of the stage that are done; the variable is that of the last row.
    variable : str
        Column of the trace.
    element : int, optional
        Which number of an array is meant.

    Returns
    -------
    Origin or None
        ``None`` where it was given, or the step at ``position`` itself made it.
    """
    here = trace.stage(stage)
    row, _ = here.steps.row_at(position)
    if row < 0 or variable not in here.columns:
        return None
    source = SOURCES.get(f"{stage}.{variable}")
    if source is not None:
        there = trace.stage(source.stage)
        whole = here.columns[variable][row]
        value = whole if element is None or np.ndim(whole) == 0 else whole[element]
        held = there.columns.get(source.variable, np.empty(0))
        for candidate in source.rows(here, row, there, element or 0)[::-1] if len(held) else ():
            there_held = held[candidate]
            if element is not None and np.ndim(there_held) == np.ndim(whole) == 1:
                if element >= len(there_held):
                    continue
                there_held = there_held[element]
            # A position may have a further component in one of the two.
            is_same = all(a == b for a, b in zip(np.ravel(there_held), np.ravel(value), strict=False))
            if is_same or source.is_alike:
                made = _done_at(there, int(candidate), source.variable)
                return Origin(source.stage, made, source.variable, not is_same)
    made = _done_at(here, row, variable)
    return Origin(stage, made, variable) if made < position else None


def _done_at(stage: StageTrace, row: int, variable: str) -> int:
    """Return the position at which a row's variable is known: after the operation that sets it, else after the row."""
    start, end = (int(place) for place in stage.steps.starts[row : row + 2])
    sets = [variable in operation.shows for operation in stage.steps.operations[stage.kind_of(row)]]
    return start + sets.index(True) + 1 if True in sets else end
