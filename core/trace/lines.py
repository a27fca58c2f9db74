"""Trace of a wireframe's coverage: every pixel of every edge, with the numbers by which the line method chose it."""

import numpy as np

from core.methods import table
from core.raster.lines.records import check_segments
from core.raster.lines.traits import line_set_up, line_traits
from core.raster.lines.wireframe import line_parameter
from core.records.arrays import Floats
from core.records.listing import listing
from core.records.steps import Steps, ends_of
from core.trace.line_clipping import with_line_clipping
from core.trace.raster_rows import FILL_OPERATIONS, overdraw_track
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace


def trace_lines(source: TraceSource) -> StageTrace:
    """Return one row for every pixel of the outlines; rows of one edge of one primitive are a group.

    Before the pixels of an edge stand the steps of the line clipper.
    """
    geometry, raster, line = source.geometry, source.raster, source.settings.line
    outlines, (fragments, steps) = geometry.outlines, source.lines
    assert outlines is not None
    segment, is_smooth = fragments.segment, fragments.intensity is not None
    count = len(fragments)
    pixel = np.stack([fragments.column, fragments.row], axis=1)
    columns: dict[str, np.ndarray] = {
        "column": fragments.column,
        "row": fragments.row,
        "primitive": fragments.primitive,
        "segment": segment,
        "edge": outlines.edge[segment],
        "window_start": outlines.window[segment, 0],
        "window_end": outlines.window[segment, 1],
        "covered": np.ones(count, bool),
        **{name: values for name, values in vars(steps).items() if name != "t"},
        "fraction": steps.decision - np.floor(steps.decision),
        "t": line_parameter(outlines, fragments, raster.center),
        "previous": _previous(steps.decision, segment),
    }
    columns |= line_traits(line).columns(steps)
    segments = check_segments(outlines.drawn, *source.scene.size, raster.center)
    set_up = line_set_up(segments, line)
    columns |= {name: values[segment] for name, values in set_up.items()}
    is_steep = columns["is_steep"]
    columns["major"] = np.where(is_steep, pixel[:, 1], pixel[:, 0])
    columns["minor"] = np.where(is_steep, pixel[:, 0], pixel[:, 1])
    # A listing that has swapped x and y for a steep line goes on with dx along its longer axis.
    is_unswapped = is_steep & (not line_traits(line).swaps_axes)
    columns["dx"], columns["dy"] = (
        np.where(is_unswapped, columns[other], columns[own])
        for own, other in (("run", "rise"), ("rise", "run"))
    )

    method = table.get("line", line)
    operations = method.operations
    kinds = (*FILL_OPERATIONS, *operations)
    triangle = geometry.primitives.triangle[fragments.primitive]
    assert method.listing is not None, f"{line} has no listing"
    listings = dict.fromkeys(operations, listing(method.listing))
    every, place = np.arange(count), source.place
    unknown = np.full(raster.shape, np.nan)
    found = StageTrace(
        stage="raster",
        method=f"line={line}",
        steps=Steps(
            kinds=kinds,
            kind=np.where(steps.index == 0, len(kinds) - 2, len(kinds) - 1),
            operations={**FILL_OPERATIONS, **operations},
            triangle_ends=ends_of(triangle),
            group_ends=ends_of(segment),
        ),
        columns=columns,
        triangle=triangle,
        pixel=pixel,
        listings=listings,
        marks={
            "covered": columns["covered"],
            "rejected": np.zeros(count, bool),
            "tie": steps.is_tie,
            "nan": np.zeros(count, bool),
        },
        buffers=(
            BufferTrack(
                "coverage", unknown, every, place, steps.intensity, "scalar" if is_smooth else "flags"
            ),
            BufferTrack("edge", np.full(raster.shape, -1), every, place, columns["edge"], "ids"),
            BufferTrack("t", unknown, every, place, columns["t"]),
            BufferTrack("decision", unknown, every, place, steps.decision, "signed"),
            overdraw_track(source, every),
        ),
        extra={
            "runs": source.runs,
            "boxes": source.boxes,
            "blocks": None,
            "edges": geometry.edges,
            "outlines": outlines,
        },
        constants={"center": raster.center},
    )
    return with_line_clipping(found, source)


def _previous(decision: Floats, segment: np.ndarray) -> Floats:
    """Return the decision (R,) one row before on the same segment, NaN where there is none."""
    before = np.full(len(decision), np.nan)
    same = np.flatnonzero(segment[1:] == segment[:-1])
    before[same + 1] = decision[same]
    return before
