"""Trace of a wireframe's coverage: every pixel of every edge, with the numbers by which the line method chose it."""

import numpy as np

from core.raster.lines.dda import line_coefficients
from core.raster.lines.drawing import LISTINGS
from core.raster.lines.records import Segments, check_segments, major_first
from core.raster.lines.rectangle import SUBPIXELS, snapped_ends
from core.raster.lines.smooth import FILTER_TABLE, filter_entry, line_cosine
from core.raster.lines.wireframe import line_parameter
from core.records.arrays import Flags, Floats
from core.records.listing import listing
from core.records.steps import Steps, ends_of
from core.trace.line_clipping import with_line_clipping
from core.trace.raster_rows import FILL_OPERATIONS, line_kinds, overdraw_track
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

PIXEL_METHODS = ("bresenham", "bresenham-lecture", "bresenham-float")
"""Methods that move the ends to pixels; the others take them as they are."""


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
    if line == "gupta-sproull":
        columns["entry"] = filter_entry(steps.line_distance)
        columns["filtered"] = FILTER_TABLE.take(columns["entry"])
    segments = check_segments(
        outlines.drawn, source.scene.size[0], source.scene.size[1], source.settings.pixel_center
    )
    set_up = line_set_up(segments, line)
    columns |= {name: values[segment] for name, values in set_up.items()}
    is_steep = columns["is_steep"]
    columns["major"] = np.where(is_steep, pixel[:, 1], pixel[:, 0])
    columns["minor"] = np.where(is_steep, pixel[:, 0], pixel[:, 1])

    operations = line_kinds(line)
    kinds = (*FILL_OPERATIONS, *operations)
    triangle = geometry.primitives.triangle[fragments.primitive]
    source_text = LISTINGS.get(line)
    listings = {} if source_text is None else dict.fromkeys(operations, listing(source_text))
    every, place = np.arange(count), source.place
    unknown = np.full(raster.shape, np.nan)
    found = StageTrace(
        stage="raster",
        method=f"line={line}",
        steps=Steps(
            kinds=kinds,
            kind=np.where(steps.index == 0, len(kinds) - 2, len(kinds) - 1),
            operations=FILL_OPERATIONS | operations,
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


def line_set_up(segments: Segments, line: str) -> dict[str, np.ndarray]:
    """Return what a line method works out once for each of L segments.

    Returns
    -------
    dict
        ``first_end``, ``second_end`` (L, 2): what the listing is called with; pixels, or positions where centres
        are whole. ``is_steep`` (L,): the longer axis is y. ``run``, ``rise`` (L,): lengths along the longer
        (major) and the other (minor) axis. ``slope``, ``intercept`` (L,): the minor coordinate is slope times the major
        one plus intercept, NaN where the method has none. ``cosine`` (L,): by what a distance along the minor axis
        shrinks to that from the line. ``length`` (L,): of the segment, in pixels.
    """
    by_pixels = line in PIXEL_METHODS
    ends: Floats = segments.pixel_indices.astype(float) if by_pixels else segments.centered_ends
    if line == "rectangle":
        ends = snapped_ends(segments) / SUBPIXELS
    length = ends[:, 1] - ends[:, 0]
    size = np.abs(length)
    is_steep: Flags = size[:, 1] > size[:, 0]
    if line == "bresenham-lecture":
        is_steep = size[:, 1] >= size[:, 0]
    run, rise = np.where(is_steep[:, None], size[:, ::-1], size).T
    slope, intercept = np.full((2, len(ends)), np.nan)
    if line == "bresenham-float":
        slope = rise / np.maximum(run, 1)
    elif not by_pixels:
        slope, intercept = line_coefficients(major_first(ends, is_steep))
    if line == "dda-float32":
        slope = slope.astype(np.float32).astype(float)
    return {
        "first_end": ends[:, 0],
        "second_end": ends[:, 1],
        "is_steep": is_steep,
        "run": run,
        "rise": rise,
        "slope": slope,
        "intercept": intercept,
        "cosine": line_cosine(slope),
        "length": np.hypot(run, rise),
    }


def _previous(decision: Floats, segment: np.ndarray) -> Floats:
    """Return the decision (R,) one row before on the same segment, NaN where there is none."""
    before = np.full(len(decision), np.nan)
    same = np.flatnonzero(segment[1:] == segment[:-1])
    before[same + 1] = decision[same]
    return before
