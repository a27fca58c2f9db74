"""From records of the trace to what the pixel grids show: buffers, outlines and overlays."""

from dataclasses import replace

import numpy as np

from app.session.moment import Step
from core import STAGES, Trace
from core.coverage.number_formats import number_format
from core.coverage.pixel_runs import INSIDE, LEAF, OUTSIDE, SPLIT
from core.coverage.snapping import SUBPIXELS, window_position
from core.coverage.traced_edges import half_plane, known_edges, weights_everywhere
from core.coverage.traced_rows import PRINTED
from core.explain.stage_texts import depth_text
from core.framebuffer.display import to_display
from core.records.arrays import Integers
from core.records.primitives import own_corners
from core.resolved import resolve
from core.trace.conditions import symbols_of
from core.trace.source import TraceSource
from core.trace.stage_trace import PRESENTED, BufferTrack, StageTrace
from core.transform.traced import WINDOW, is_dropped, spaces_reached
from widgets.grid.geometry import GridGeometry
from widgets.grid.layers import (
    EDGE_MARKS,
    BlockOverlay,
    BlockState,
    BufferKind,
    CellMark,
    CountOverlay,
    GridBuffer,
    MaskOverlay,
    Overlay,
    SegmentOverlay,
    SpanOverlay,
)
from widgets.grid.marks import SampleDots

OUTLINE_LIMIT = 400
"""Triangles up to which every outline is drawn; of more, only the one in focus: a part would look like a shape."""
KINDS: dict[str, BufferKind] = {
    "scalar": "scalar",
    "signed": "signed",
    "color": "color",
    "bytes": "color",
    "ids": "ids",
    "flags": "bool",
    "count": "scalar",
}
STATES = {
    OUTSIDE: BlockState.REJECTED,
    INSIDE: BlockState.ACCEPTED,
    SPLIT: BlockState.SPLIT,
    LEAF: BlockState.LEAF,
}


LANE_MARKS = {"does not run this line": CellMark.REJECTED, "discarded": CellMark.DEPTH_FAILED}
"""What fragments of a triangle do while another one runs a statement, and how that is marked."""


def buffers_of(step: Step) -> list[GridBuffer]:
    """Return the buffers of a stage after a step: what is known by then, and nothing that comes later."""
    stage, done, source = step.stage_trace, step.rows_done, step.trace.source
    if stage.stage == "edges" and resolve(source.settings).sampling.count == 1 and known_edges(done)[1]:
        return half_planes(source, done)
    if not stage.buffers:
        return [_cleared(source)]
    origin, depth = source.raster.bounds[:2], source.settings.depth
    found = [_described(grid_buffer(track, done, origin), depth) for track in stage.buffers]
    # The number that chooses a line's pixels is called what the formulas call it.
    decision = symbols_of(stage).get("decision", "decision")
    return [replace(buffer, title=decision) if buffer.name == "decision" else buffer for buffer in found]


def half_planes(source: TraceSource, rows_done: int) -> list[GridBuffer]:
    """Return the edge functions that are set up of the triangle at hand, the latest one first; of all, the weights."""
    primitive, count = known_edges(rows_done)
    weights = weights_everywhere(source, primitive) if count == 3 else ()
    return [
        GridBuffer(
            f"edge {edge}",
            half_plane(source, primitive, edge),
            "signed",
            unit="" if source.geometry.edges.numbers.divides else "px²",
            description=f"Edge function {edge} at every pixel's centre: positive on the inner side of the edge.",
            origin=source.raster.bounds[:2],
        )
        for edge in reversed(range(count))
    ] + [
        GridBuffer(
            f"weight {corner}",
            values,
            "signed",
            description=f"Weight of corner {corner} at every pixel's centre: below 0 beyond edge {corner}.",
            origin=source.raster.bounds[:2],
        )
        for corner, values in enumerate(weights)
    ]


def _cleared(source: TraceSource) -> GridBuffer:
    """Return the colour buffer before the first triangle."""
    color = np.empty((*source.raster.shape, 4), np.float32)
    color[:] = source.scene.background
    description = "Nothing is drawn yet: the colour buffer holds the background."
    pixels, origin = to_display(color).pixels, source.raster.bounds[:2]
    return GridBuffer("color", pixels, "color", title="colour", description=description, origin=origin)


def _described(buffer: GridBuffer, depth: str) -> GridBuffer:
    """Return the buffer with its unit and description where it holds depths, by the method ``depth``."""
    text = depth_text(buffer.name, depth)
    return buffer if text is None else replace(buffer, unit=text.unit, description=text.description)


def grid_buffer(track: BufferTrack, rows_done: int, origin: tuple[int, int]) -> GridBuffer:
    """Return one buffer after ``rows_done`` rows; ``origin`` is the place of its lower left pixel in the picture."""
    values, known = track.at(rows_done), track.known_at(rows_done)
    if track.kind == "flags":
        values = np.nan_to_num(values) > 0
    if track.kind == "color":
        values = np.where(known[..., None], values, 0.0)
    scale = track.value_range if track.kind in ("scalar", "signed", "count") else None
    title = track.name.replace("color", "colour")
    return GridBuffer(
        track.name,
        values,
        KINDS[track.kind],
        range=scale,
        title=title,
        origin=origin,
        known=known,
        is_weight=track.name.startswith("weight "),
    )


def is_presented(step: Step) -> bool:
    """Return whether the step presents the finished picture: a picture that moves lies elsewhere than its corners."""
    return step.row >= 0 and step.stage_trace.kind_of(step.row) in PRESENTED


def geometry_of(step: Step, focus: int | None = None) -> GridGeometry:
    """Return the outlines of the traced triangles, in the columns and rows of the grid.

    Corners that have not reached the window by the step have no place, nor have triangles that are dropped.
    ``focus``: the triangle with coloured edges and handles, where none is in focus.
    """
    trace, source = step.trace, step.trace.source
    at, geometry = (step.cursor.stage, step.cursor.position), source.geometry
    wanted = source.triangle if source.triangle is not None else focus
    triangles = outlined_triangles(trace, wanted)
    corner_count = source.scene.corner_count
    vertices = geometry.vertices
    corners = vertices.all_corners[triangles].ravel()
    origin = np.array(step.origin, float)
    chosen = np.isin(geometry.assembled.triangle, triangles)
    is_placed = (spaces_reached(trace, *at)[chosen] == WINDOW) & (not is_presented(step))
    # The triangle in focus keeps its handles: a drag may bring it back.
    is_left = ~is_dropped(trace, *at)[chosen] | (triangles == wanted)
    is_placed &= is_left[:, None]
    clip = geometry.vertices.clip[corners]
    in_front = (clip[:, 3:] > 0) & is_placed.reshape(-1, 1)
    window = np.where(in_front, geometry.vertices.window[corners, :2], np.nan)
    is_behind = ~(clip[:, 3] > 0) & is_placed.ravel()
    behind = None
    if is_behind.any():
        size = np.array(source.scene.size, float)
        x_y, w = clip[:, :2], clip[:, 3:]
        behind = np.hstack(((x_y + w) * size / 2 - origin * w, w))
        behind[~is_behind] = np.nan
    with np.errstate(invalid="ignore"):
        snapped = np.rint(window * SUBPIXELS) / SUBPIXELS
    snaps = number_format(source.settings.coverage).corner_kind == "snapped"
    place = np.flatnonzero(triangles == wanted)
    return GridGeometry(
        vertices=window - origin,
        triangles=(
            own_corners(np.arange(len(triangles)), corner_count).T
            if vertices.rings is None
            else np.arange(len(corners)).reshape(-1, corner_count)
        ),
        focus=0 if len(triangles) == 1 else int(place[0]) if len(place) else -1,
        snapped=(snapped - origin) if snaps else None,
        behind=behind,
        rings=(0,) if vertices.rings is None else tuple(vertices.rings.tolist()),
        owner="" if step.triangle in (-1, wanted) else f"of triangle {wanted}",
    )


def outlined_triangles(trace: Trace, focus: int | None) -> Integers:
    """Return (K,) the primitives whose outlines are drawn: all, or of many the one in focus; fragments have none."""
    triangles = trace.source.geometry.assembled.triangle
    if trace.source.scene.corner_count == 0:
        return triangles[:0]
    return triangles if len(triangles) <= OUTLINE_LIMIT else triangles[triangles == focus][:1]


def edge_overlays(step: Step, geometry: GridGeometry) -> list[Overlay]:
    """Return the edges of the triangle in focus that are set up by now as whole lines."""
    stage = step.cursor.stage
    count = 0 if STAGES.index(stage) < STAGES.index("edges") else 3
    if stage == "edges":
        count = known_edges(step.rows_done)[1]
    if len(geometry.focus_vertices) != 3 or not count:
        return []
    a, b, c = geometry.triangles[geometry.focus].tolist()
    segments = geometry.edges(np.array([[b, c], [c, a], [a, b]]))[:count]
    return [SegmentOverlay("edge lines", segments, (0, 1, 2)[:count], extended=True, title="edge lines")]


def piece_overlays(step: Step) -> list[Overlay]:
    """Return the outlines of the pieces that a tree has cut triangles into, where they lie before the eye."""
    pieces = step.trace.source.geometry.kept_pieces
    if pieces is None or STAGES.index(step.cursor.stage) < STAGES.index("clip"):
        return []
    clip = pieces.clip[(pieces.number > 0) & (pieces.clip[..., 3] > 0).all(axis=1)]
    if not len(clip):
        return []
    window = window_position(clip, step.trace.source.scene.size) - np.array(step.origin)
    sides = np.stack([window, np.roll(window, -1, axis=1)], axis=2).reshape(-1, 2, 2)
    return [SegmentOverlay("tree pieces", sides, title="pieces of the tree")]


def block_overlays(step: Step) -> list[Overlay]:
    """Return the boxes and blocks that binning has tested so far (all of them in later stages)."""
    stage, trace = step.stage_trace, step.trace
    blocks = trace.source.runs.blocks if stage.stage in ("bin", "raster") else None
    if stage.stage != "bin" and (blocks is None or step.is_predicting):
        # An accepted block tells which pixels are covered.
        return []
    bins = trace.stage("bin")
    if "sample" in bins.columns or "column" not in bins.columns:
        # Every sample has blocks of its own: over each other they would show nothing. Typed depths have none.
        return []
    done = step.rows_done if stage.stage == "bin" else bins.steps.row_count
    first_column, first_row, end_column, end_row = trace.source.raster.bounds
    columns = bins.columns
    left, bottom = np.maximum(columns["column"], first_column), np.maximum(columns["row"], first_row)
    right, top = np.minimum(columns["column_end"], end_column), np.minimum(columns["row_end"], end_row)
    boxes = np.stack([left - first_column, bottom - first_row, right - left, top - bottom], axis=1)[:done]
    states = [
        STATES[int(blocks.verdict[node])] if blocks is not None and node >= 0 else BlockState.SPLIT
        for node in columns["node"][:done]
    ]
    keep = (boxes[:, 2:] > 0).all(axis=1)
    if stage.stage == "raster":
        keep &= columns["node"][:done] >= 0
    if not keep.any():
        return []
    chosen = np.flatnonzero(keep)
    return [
        BlockOverlay(
            "blocks",
            boxes[chosen],
            tuple(states[k] for k in chosen),
            edges=tuple(int(k) for k in columns["rejected_by"][chosen]),
            title="blocks",
        )
    ]


def mask_overlays(step: Step) -> list[Overlay]:
    """Return the marks of the rows done so far, one mask for each kind."""
    stage, raster, done = step.stage_trace, step.trace.source.raster, step.rows_done
    pixel = stage.pixel[:done]
    of_pixel = pixel[:, 0] >= 0
    if not len(stage.pixel) or (stage.pixel[:, 0] < 0).all():
        return []

    def mask(flags: np.ndarray) -> np.ndarray:
        found = np.zeros(raster.shape, bool)
        chosen = pixel[flags & of_pixel]
        found.ravel()[raster.index(chosen[:, 0], chosen[:, 1])] = True
        return found

    overlays: list[Overlay] = []
    marks = {name: flags[:done] for name, flags in stage.marks.items()}
    if stage.stage == "raster":
        overlays.append(MaskOverlay("covered", CellMark.COVERED, mask(marks["covered"])))
        overlays.append(MaskOverlay("rejected", CellMark.REJECTED, mask(marks["rejected"])))
        values = stage.columns.get("values")
        # A line has no edge functions: nothing is outside an edge.
        for k in range(3 if values is not None else 0):
            assert values is not None
            outside = mask(values[:done, k] < 0)
            overlays.append(MaskOverlay(f"outside {k}", EDGE_MARKS[k], outside, title=f"outside edge {k}"))
        overlays.append(MaskOverlay("tie", CellMark.TIE, mask(marks["tie"]), title="on an edge"))
        counted = next(track for track in stage.buffers if track.name == "overdraw").at(done)
        overlays.append(CountOverlay("overdraw", counted))
    if stage.stage == "depth":
        overlays.append(MaskOverlay("passed", CellMark.DEPTH_PASSED, mask(marks["covered"])))
        overlays.append(MaskOverlay("failed", CellMark.DEPTH_FAILED, mask(marks["depth-failed"])))
    if (waiting := stage.waiting_at(step.row) if done else None) is not None:
        for key, mark, lanes in zip(LANE_MARKS, LANE_MARKS.values(), waiting, strict=True):
            chosen = np.zeros(raster.shape, bool)
            chosen.ravel()[step.trace.source.place[lanes]] = True
            overlays.append(MaskOverlay(key, mark, chosen, title=key))
    if "unset" in stage.extra:
        unset = mask(stage.extra["unset"][:done])
        overlays.append(MaskOverlay("unset", CellMark.MISSING, unset, title="read without a value"))
    if "nan" in marks:
        overlays.append(MaskOverlay("nan", CellMark.NAN, mask(marks["nan"])))
    return overlays


def span_overlays(step: Step) -> list[Overlay]:
    """Return the spans of a scanline fill that are known so far."""
    stage, done = step.stage_trace, step.rows_done
    if stage.stage != "raster" or "sample" in stage.columns:
        return []
    kinds = np.array([kind in ("span", "lane-row", *PRINTED) for kind in stage.steps.kinds])
    rows = np.flatnonzero(kinds[stage.steps.kind[:done]])
    if not len(rows):
        return []
    first_column, first_row = step.origin
    spans = np.stack(
        [
            stage.columns["row"][rows] - first_row,
            stage.columns["start"][rows] - first_column,
            stage.columns["stop"][rows] - first_column,
        ],
        axis=1,
    )
    return [SpanOverlay("spans", spans)]


COVERED = ("interpolate", "shade")
"""Stages behind the raster that do not know yet what is hidden: every sample has the last triangle that covers it."""
SEEN = ("blend", "resolve")
"""Stages behind the depth test."""


def sample_dots(step: Step) -> SampleDots | None:
    """Return the samples after a step; ``None``: a pixel has one. What is to be predicted, no sample tells."""
    trace, stage, source = step.trace, step.stage_trace, step.trace.source
    count = resolve(source.settings).sampling.count
    if count == 1:
        return None
    done = step.rows_done
    shown: Integers = np.full((count, *source.raster.shape), -1)
    if stage.stage == "raster":
        _mark_covered(shown, trace, stage, done)
    elif stage.stage in COVERED:
        raster = trace.stage("raster")
        _mark_covered(shown, trace, raster, raster.steps.row_count)
    elif stage.stage == "depth":
        tracks = {track.name: track for track in stage.buffers}
        for sample in range(count):
            shown[sample] = tracks[f"primitive {sample}" if sample else "primitive"].at(done)
    elif stage.stage in SEEN and not step.is_predicting:
        samples = source.picture.samples
        assert samples is not None
        shown[:] = samples.primitive
    return SampleDots(resolve(source.settings).sampling.position, shown)


def _mark_covered(shown: Integers, trace: Trace, raster: StageTrace, done: int) -> None:
    """Give samples (S, H, W) to the triangles that ``done`` rows have found to cover them, the last one of each."""
    covered = np.flatnonzero(raster.marks["covered"][:done] & (raster.pixel[:done, 0] >= 0))
    place = trace.source.raster.index(*raster.pixel[covered].T)
    of_sample = shown.reshape(len(shown), -1)
    of_sample[raster.columns["sample"][covered], place] = raster.triangle[covered]
