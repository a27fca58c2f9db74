"""Trace of attribute interpolation: weights and values of every covered pixel."""

from collections.abc import Callable
from typing import Any

import numpy as np

from core.interpolation.barycentric import WAYS, numbers_at
from core.interpolation.corrected_affine import place_anchors
from core.interpolation.interpolation import numerators, perspective
from core.lines import wireframe
from core.methods import table
from core.records.arrays import Floats, Integers
from core.records.listing import Operation, listing
from core.records.primitives import interpolation_form
from core.records.steps import Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

ALONG_LINES: dict[str, tuple[Callable[..., Any], tuple[Operation, ...]]] = {
    "line-perspective": (
        wireframe.interpolate_along,
        (
            Operation("parts", "parts", {"parts": "start end"}, ("t", "end_w")),
            Operation("total", "total", ("total",), ("inverse_w",)),
            Operation("weight", "weight", ("s",)),
        ),
    ),
    "line-affine": (wireframe.interpolate_affine_along, (Operation("weight", "weight", ("s",), ("t",)),)),
    "point": (wireframe.take_point_value, ()),
}
"""Kind of row of lines and points to its listing and to what it does before the values."""


def trace_interpolate(source: TraceSource) -> StageTrace:
    """Return one row for every fragment."""
    geometry, mode = source.geometry, source.settings.interpolation
    outline_kind = _outline_kind(source)
    fragments, values = source.fragments, source.interpolated[1]
    columns = _columns(source, outline_kind)
    values_of_layout = tuple(
        Operation(f"value-{name}", "value", {name: "value"}) for name in geometry.primitives.layout
    )
    of_layout = {name: values[:, part] for name, part in geometry.primitives.layout.items()}
    triangle = source.triangle_of_fragment
    method = table.get("interpolation", mode)
    kinds = (mode, outline_kind) if outline_kind else tuple(method.operations)
    operations = {**method.operations, **{kind: done for kind, (_, done) in ALONG_LINES.items()}}
    listings = dict.fromkeys(method.operations, method.listing)
    listings |= {kind: made for kind, (made, _) in ALONG_LINES.items()}
    steps = Steps(
        kinds=kinds,
        kind=_kinds(columns, outline_kind),
        operations={kind: (*operations[kind], *values_of_layout) for kind in kinds},
        triangle_ends=ends_of(triangle),
        group_ends=ends_of(fragments.primitive, fragments.row),
    )
    return StageTrace(
        stage="interpolate",
        method=f"interpolation={mode}",
        steps=steps,
        columns={**columns, **of_layout},
        triangle=triangle,
        pixel=np.stack([fragments.column, fragments.row], axis=1),
        listings={kind: listing(made) for kind in kinds if (made := listings[kind])},
        marks={"covered": np.ones(len(fragments), bool), "nan": np.any(~np.isfinite(values), axis=1)},
        buffers=_buffers(source),
        extra={"layout": geometry.primitives.layout, "planes": geometry.planes},
    )


def _outline_kind(source: TraceSource) -> str:
    """Return the kind of all rows where values come from the ends of lines or from points; empty: from areas."""
    if source.scene.corner_count == 1:
        return "point"
    form = interpolation_form(source.settings.interpolation)
    if not isinstance(source.fragments, wireframe.LineFragments) or form == "flat":
        return ""
    # Lines have no rows of pixels to be corrected along.
    return "line-affine" if form == "affine" else "line-perspective"


def _columns(source: TraceSource, outline_kind: str) -> dict[str, np.ndarray]:
    """Return the numbers of every fragment; see `_outline_kind`."""
    geometry, fragments = source.geometry, source.fragments
    weights, values = source.interpolated
    x, y = source.centers
    corners = weights.shape[1]
    varyings = geometry.primitives.varyings[fragments.primitive]
    columns: dict[str, np.ndarray] = {
        "column": fragments.column,
        "row": fragments.row,
        "x": x,
        "y": y,
        "a": geometry.planes.a[fragments.primitive],
        "b": geometry.planes.b[fragments.primitive],
        "c": geometry.planes.c[fragments.primitive],
        "corner_w": geometry.planes.w[fragments.primitive, :corners],
        "inverse_w": source.inverse_w,
        "weights": weights,
        "corner_values": varyings[:, :corners],
        "values": values,
        "primitive": fragments.primitive,
    }
    if outline_kind:
        mode = outline_kind.removeprefix("line-")
        columns |= _along_lines(source, mode) if mode != "point" else {}
    elif source.settings.interpolation in WAYS:
        columns["corner_window"] = geometry.planes.window.take(fragments.primitive, axis=2).transpose(2, 0, 1)
        columns |= numbers_at(source.settings.interpolation, geometry.planes, fragments.primitive, x, y)
    else:
        is_corrected = (
            "correction_interval" in table.get("interpolation", source.settings.interpolation).takes
        )
        columns |= _between_anchors(source) if is_corrected else _over_areas(source)
    return columns


def _kinds(columns: dict[str, np.ndarray], outline_kind: str) -> Integers:
    """Return (F,) int64, which kind each row is: the way, or what stands beside it."""
    if "has_area" in columns:
        return (~columns["has_area"]).astype(np.int64)
    return np.full(len(columns["row"]), int(outline_kind != ""))


def _between_anchors(source: TraceSource) -> dict[str, np.ndarray]:
    """Return the anchors of fragments (F,) in their rows, and the weights there."""
    planes, primitive = source.geometry.planes, source.fragments.primitive
    interval = source.settings.correction_interval
    x, y = source.centers
    anchors = place_anchors(planes, primitive, x, y, interval)

    def weights_at(anchor_x: Floats) -> Floats:
        weights: Floats = perspective(planes, primitive, anchor_x, y, 0, interval)
        return weights

    return {
        "row_ends": np.stack([anchors.row_left, anchors.row_right], axis=1),
        "grid": np.stack([anchors.grid, anchors.grid + interval], axis=1),
        "anchor_x": np.stack([anchors.left, anchors.right], axis=1),
        "fraction": anchors.fraction,
        "anchor_weights": np.stack([weights_at(anchors.left), weights_at(anchors.right)], axis=1),
        "interval": np.full(len(x), interval),
        "determinant": planes.determinant[primitive],
    }


def _over_areas(source: TraceSource) -> dict[str, np.ndarray]:
    """Return the numbers from which the weights of fragments (F,) are made."""
    planes, primitive = source.geometry.planes, source.fragments.primitive
    n = np.stack(numerators(planes, primitive, *source.centers), axis=1)
    if interpolation_form(source.settings.interpolation) == "affine":
        n = n * planes.w[primitive]
    return {"numerators": n, "total": n[:, 0] + n[:, 1] + n[:, 2]}


def _along_lines(source: TraceSource, mode: str) -> dict[str, np.ndarray]:
    """Return the same of fragments (F,) on the segments of a wireframe, and the values (F, 2, K) at their ends."""
    outlines, fragments = source.geometry.outlines, source.fragments
    assert outlines is not None
    assert isinstance(fragments, wireframe.LineFragments)
    center = source.raster.center
    t = wireframe.line_parameter(outlines, fragments, center)
    start, end = wireframe.inverse_w_parts(outlines, fragments, center)
    at_ends = wireframe.values_at_ends(outlines, source.geometry.primitives.varyings, mode)
    differences = _differences(fragments.segment, t, source.interpolated[1]) if mode == "affine" else {}
    return differences | {
        "segment": fragments.segment,
        "edge": outlines.edge[fragments.segment],
        "t": t,
        "end_w": outlines.w[fragments.segment],
        "parts": np.stack([start, end], axis=1),
        "total": start + end,
        "s": t if mode == "affine" else end / (start + end),
        "end_values": at_ends[fragments.segment],
    }


def _differences(segment: Integers, t: Floats, values: Floats) -> dict[str, np.ndarray]:
    """Return t (F,) and values (F, K) at the pixel before on the same segment; NaN at its first pixel."""
    t_before, values_before = np.full(t.shape, np.nan), np.full(values.shape, np.nan)
    follows = np.flatnonzero(segment[1:] == segment[:-1])
    t_before[follows + 1], values_before[follows + 1] = t[follows], values[follows]
    return {"t_before": t_before, "values_before": values_before[:, None]}


def _buffers(source: TraceSource) -> tuple[BufferTrack, ...]:
    weights, values = source.interpolated
    unknown = np.full(source.raster.shape, np.nan)
    rows, place = np.arange(len(source.fragments)), source.place

    def track(name: str, written: np.ndarray, kind: str = "scalar") -> BufferTrack:
        initial = np.full((*source.raster.shape, *written.shape[1:]), np.nan)
        return BufferTrack(name, initial, rows, place, written, kind)

    tracks = [track(f"weight {k}", weights[:, k], "signed") for k in range(weights.shape[1])]
    tracks.append(BufferTrack("1/w", unknown, rows, place, source.inverse_w))
    for name, part in source.geometry.primitives.layout.items():
        if name == "uv":
            tracks += [track("u", values[:, part.start]), track("v", values[:, part.start + 1])]
        elif name in ("normal", "position"):
            axes = zip("xyz", range(part.start, part.stop), strict=True)
            tracks += [track(f"{name} {axis}", values[:, k], "signed") for axis, k in axes]
        else:
            color = np.zeros((len(values), 4))
            color[:, 3] = 1
            color[:, : part.stop - part.start] = values[:, part]
            tracks.append(track(name.replace("_", " "), color, "color"))
    return tuple(tracks)
