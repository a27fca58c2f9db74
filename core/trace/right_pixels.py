"""What the right algorithm draws where one runs as a slide prints it: the same input, row by row and pixel by pixel."""

import numpy as np

from core.methods import table
from core.raster.binning import bound
from core.raster.lines.traits import line_traits
from core.raster.lines.wireframe import draw_outlines, join_batches
from core.records.operation import Columns
from core.trace.row_table import RowTable
from core.trace.source import TraceSource

RIGHT_FILL = "scanline"
"""The fill that is right where the printed scanline is not."""


def right_spans(source: TraceSource, rows: RowTable) -> dict[str, np.ndarray]:
    """Return the columns (R,) that the triangle of each row covers there, and how many rows are never drawn.

    Returns
    -------
    dict
        ``right_start``, ``right_stop``: the span; both 0 where the triangle covers nothing of the row. ``left_out``:
        rows that the triangle covers and that the printed fill does not draw, at its first row, else 0. Empty where
        the number format has no spans.
    """
    edges, raster = source.geometry.edges, source.raster
    if not edges.numbers.suits_spans:
        return {}
    runs = table.get("fill", RIGHT_FILL).function(edges, bound(edges, raster), raster, 1)
    is_covered = runs.stop > runs.start
    height = source.scene.size[1]
    wanted = runs.triangle[is_covered] * height + runs.row[is_covered]
    order = np.argsort(wanted)
    wanted, spans = wanted[order], np.stack([runs.start[is_covered], runs.stop[is_covered]])[:, order]
    places = rows.primitive * height + rows.row
    found = np.searchsorted(wanted, places)
    start, stop = np.zeros((2, len(places)), np.int64)
    if len(wanted):
        is_known = wanted.take(found, mode="clip") == places
        start, stop = np.where(is_known, spans.take(found, axis=1, mode="clip"), 0)
    missing = np.bincount(np.setdiff1d(wanted, places) // height, minlength=len(edges))
    left_out = np.zeros(len(places), np.int64)
    primitives, is_first = np.unique(rows.primitive, return_index=True)
    left_out[is_first] = missing[primitives]
    return {"right_start": start, "right_stop": stop, "left_out": left_out}


def right_pixels(source: TraceSource, columns: Columns, line: str) -> Columns:
    """Return what the right method draws in the column (steep: row) of each pixel of lines as printed.

    Returns
    -------
    dict
        ``right_pixel`` (P, 2): column and row, -1 where it draws nothing there. ``left_out`` (P, 2): at a line's last
        pixel the first one beyond it that only the right method draws, else -1. Empty for a method that is not one as
        printed.
    """
    right = line_traits(line).right
    outlines = source.geometry.outlines
    if not right or outlines is None:
        return {}
    fragments, _ = join_batches(list(draw_outlines(outlines, source.raster, right)))
    segment, is_steep = columns["segment"], columns["is_steep"]
    steep = dict(zip(segment.tolist(), is_steep.tolist(), strict=True))
    drawn: dict[tuple[int, int], tuple[int, int]] = {}
    places = (fragments.segment, fragments.column, fragments.row)
    for owner, x, y in zip(*(each.tolist() for each in places), strict=True):
        drawn[owner, y if steep.get(owner, False) else x] = (x, y)
    keys = list(zip(segment.tolist(), columns["major"].astype(int).tolist(), strict=True))
    found = np.array([drawn.get(key, (-1, -1)) for key in keys], np.int64).reshape(-1, 2)
    rest: dict[int, list[tuple[int, int]]] = {}
    for (owner, _), pixel in ((key, drawn[key]) for key in drawn.keys() - set(keys)):
        rest.setdefault(owner, []).append(pixel)
    left_out = np.full((len(keys), 2), -1)
    for last in np.flatnonzero(np.diff(segment, append=-1)).tolist():
        pixels = rest.get(int(segment[last]), [])
        here = (int(columns["column"][last]), int(columns["row"][last]))
        if pixels:
            left_out[last] = min(pixels, key=lambda pixel: abs(pixel[0] - here[0]) + abs(pixel[1] - here[1]))
    return {"right_pixel": found, "left_out": left_out}
