"""Trace of attribute interpolation: weights and values of every covered pixel."""

import numpy as np

from core.fragments.interpolation import (
    interpolate_affine_at,
    interpolate_at,
    numerators,
    take_provoking_value,
)
from core.listing import listing
from core.steps import Operation, Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

LISTINGS = {"perspective": interpolate_at, "affine": interpolate_affine_at, "flat": take_provoking_value}


def trace_interpolate(source: TraceSource) -> StageTrace:
    """Return one row for every fragment."""
    geometry, fragments = source.geometry, source.fragments
    weights, values = source.interpolated
    n = np.stack(numerators(geometry.planes, fragments.primitive, *source.centers), axis=1)
    mode = source.settings.interpolation
    if mode == "affine":
        n = n * geometry.planes.w[fragments.primitive]
    x, y = source.centers
    varyings = geometry.primitives.varyings[fragments.primitive]
    columns = {
        "column": fragments.column,
        "row": fragments.row,
        "x": x,
        "y": y,
        "a": geometry.planes.a[fragments.primitive],
        "b": geometry.planes.b[fragments.primitive],
        "c": geometry.planes.c[fragments.primitive],
        "corner_w": geometry.planes.w[fragments.primitive],
        "numerators": n,
        "total": n[:, 0] + n[:, 1] + n[:, 2],
        "inverse_w": source.inverse_w,
        "weights": weights,
        "corner_values": varyings,
        "values": values,
        "primitive": fragments.primitive,
    }
    summed = Operation("total", "total", ("total", "inverse_w"))
    operations = (
        *(() if mode == "flat" else (Operation("numerators", "numerators", ("numerators",)), summed)),
        Operation("weights", "weights", ("weights",)),
        *(Operation(f"value-{name}", "value", (name,)) for name in geometry.primitives.layout),
    )
    for name, part in geometry.primitives.layout.items():
        columns[name] = values[:, part]
    triangle = source.triangle_of_fragment
    steps = Steps(
        kinds=(mode,),
        kind=np.zeros(len(fragments), np.int64),
        operations={mode: operations},
        triangle_ends=ends_of(triangle),
        group_ends=ends_of(fragments.primitive, fragments.row),
    )
    return StageTrace(
        stage="interpolate",
        method=f"interpolation={mode}",
        steps=steps,
        columns=columns,
        triangle=triangle,
        pixel=np.stack([fragments.column, fragments.row], axis=1),
        listings={mode: listing(LISTINGS[mode])},
        marks={"covered": np.ones(len(fragments), bool), "nan": np.any(~np.isfinite(values), axis=1)},
        buffers=_buffers(source),
        extra={"layout": geometry.primitives.layout, "planes": geometry.planes},
    )


def _buffers(source: TraceSource) -> tuple[BufferTrack, ...]:
    weights, values = source.interpolated
    unknown = np.full(source.raster.shape, np.nan)
    rows, place = np.arange(len(source.fragments)), source.place

    def track(name: str, written: np.ndarray, kind: str = "scalar") -> BufferTrack:
        initial = np.full((*source.raster.shape, *written.shape[1:]), np.nan)
        return BufferTrack(name, initial, rows, place, written, kind)

    tracks = [track(f"weight {k}", weights[:, k], "signed") for k in range(3)]
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
