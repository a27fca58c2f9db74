"""What traces each stage, and how the stages of several samples a pixel are traced.

Rows of multisampling go triangle by triangle, and of each triangle sample by sample; those of supersampling in the
order of the larger picture. Where a buffer of the frame has a value for every sample there is a track for each, that of
sample 0 under the usual name; of other buffers the sample written last is what a pixel shows.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.antialiasing.sampling import ROTATED_GRID, grid_positions
from core.coverage.edges import edge_value
from core.coverage.traced_rows import occurrence
from core.lazy_import import imported
from core.records.arrays import Floats, Integers
from core.records.steps import Steps, ends_of
from core.resolved import resolve
from core.settings import Settings
from core.stages.declared import STAGES, UNSAMPLED_STAGES, stage_of
from core.trace.sample_sources import center_source, finer_source, sources_of_samples
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

# Traces of several samples a pixel: the rows of all samples, each about its pixel and with the number of
# its sample.


Tracer = Callable[[TraceSource], StageTrace]
OF_EVERY_SAMPLE = ("depth", "primitive", "color")
"""Tracks of the frame's buffers."""


def trace_samples(source: TraceSource, stage: str, tracer: Tracer) -> StageTrace:
    """Trace a stage before the samples are resolved; ``source`` has an antialiasing with samples."""
    if stage in UNSAMPLED_STAGES:
        return tracer(source)
    side = resolve(source.settings).sampling.side
    if side:
        return _by_pixel(tracer(finer_source(source, side)), source, side)
    if stage == "edges":
        return tracer(source)
    sources = sources_of_samples(source)
    if stage_of(stage).at_centers:
        return tracer(center_source(source, sources))
    return _joined([tracer(of_sample) for of_sample in sources], source)


def _by_pixel(finer: StageTrace, source: TraceSource, side: int) -> StageTrace:
    """Return the trace of the larger picture with its rows about pixels."""
    pixel = finer.pixel.copy()
    at_pixel = pixel[:, 0] >= 0
    sample = np.where(at_pixel, (pixel[:, 1] % side) * side + pixel[:, 0] % side, -1)
    pixel[at_pixel] //= side
    width = source.raster.shape[1] * side
    tracks: list[BufferTrack] = []
    for track in finer.buffers:
        row, column = np.divmod(track.places, width)
        place = (row // side) * (width // side) + column // side
        initial = [track.initial[s // side :: side, s % side :: side] for s in range(side * side)]
        tracks += _tracks(
            track, initial, track.rows, place, (row % side) * side + column % side, track.values
        )
    return replace(
        finer,
        pixel=pixel,
        columns={**finer.columns, **_sample_columns(sample, grid_positions(side))},
        buffers=tuple(tracks),
    )


def _joined(traces: list[StageTrace], source: TraceSource) -> StageTrace:
    """Return the rows of all samples, triangle by triangle or as they are ordered, and then sample by sample."""
    lengths = [trace.steps.row_count for trace in traces]
    sample = np.repeat(np.arange(len(traces)), lengths)
    triangle = np.concatenate([trace.triangle for trace in traces])
    pixel, first = np.concatenate([trace.pixel for trace in traces]), traces[0]
    loops = first.order.keys(pixel) if first.order else (_turns(traces, source, triangle),)
    order = np.lexsort((np.arange(len(sample)), sample, *loops[::-1]))
    new_row = np.empty(len(order), np.int64)
    new_row[order] = np.arange(len(order))
    group = np.concatenate(
        [
            np.searchsorted(trace.steps.group_ends, np.arange(length), "right")
            for trace, length in zip(traces, lengths, strict=True)
        ]
    )
    columns = {
        name: np.concatenate([trace.columns[name] for trace in traces])[order] for name in first.columns
    }
    if first.stage == "raster" and "values" in columns:
        columns |= _at_samples(columns, sample[order])
    starts = np.cumsum([0, *lengths[:-1]])
    outer = loops[0] if first.order else triangle
    within = loops if first.order and first.order.is_by_pixel else (outer, sample, group)
    # What is the same in all rows of one sample may differ between samples: how many spans there are.
    differing = [
        name for name, value in first.constants.items() if any(t.constants[name] != value for t in traces)
    ]
    return StageTrace(
        stage=first.stage,
        method=first.method,
        steps=Steps(
            first.steps.kinds,
            np.concatenate([trace.steps.kind for trace in traces])[order],
            first.steps.operations,
            ends_of(outer[order]),
            ends_of(*(key[order] for key in within)),
        ),
        columns={
            **columns,
            **{
                name: np.array([trace.constants[name] for trace in traces])[sample[order]]
                for name in differing
            },
            **_sample_columns(sample[order], ROTATED_GRID),
        },
        triangle=triangle[order],
        pixel=pixel[order],
        listings=first.listings,
        marks={name: np.concatenate([t.marks[name] for t in traces])[order] for name in first.marks},
        buffers=tuple(
            track
            for number in range(len(first.buffers))
            for track in _joined_tracks([trace.buffers[number] for trace in traces], starts, new_row)
        ),
        extra=first.extra,
        constants={name: value for name, value in first.constants.items() if name not in differing},
        given=first.given,
        order=first.order,
    )


def _turns(traces: list[StageTrace], source: TraceSource, triangle: Integers) -> Integers:
    """Return when the triangle (R,) of each row is drawn; the pieces of one triangle are drawn in several turns."""
    drawn = source.geometry.primitives.triangle
    rank = np.zeros(int(drawn.max(initial=0)) + 2, np.int64)
    rank[drawn[::-1]] = np.arange(len(drawn))[::-1]
    turn = rank[triangle]
    if source.geometry.kept_pieces is None or "primitive" not in traces[0].columns:
        return turn
    primitive = np.concatenate([trace.columns["primitive"] for trace in traces])
    return source.geometry.kept_of_primitive.take(np.where(primitive < 0, turn, primitive))


def _joined_tracks(of_samples: list[BufferTrack], starts: Integers, new_row: Integers) -> list[BufferTrack]:
    """Return one buffer of all samples, its writes in the order of the joined rows."""
    sample = np.repeat(np.arange(len(of_samples)), [len(track.rows) for track in of_samples])
    rows = np.concatenate(
        [new_row[track.rows + start] for track, start in zip(of_samples, starts, strict=True)]
    )
    place = np.concatenate([track.places for track in of_samples])
    values = np.concatenate([track.values for track in of_samples])
    order = np.argsort(rows, kind="stable")
    initial = [track.initial for track in of_samples]
    return _tracks(of_samples[0], initial, rows[order], place[order], sample[order], values[order])


def _tracks(
    track: BufferTrack,
    initial: list[NDArray[Any]],
    rows: Integers,
    place: Integers,
    sample: Integers,
    values: NDArray[Any],
) -> list[BufferTrack]:
    """Return a buffer of S samples as buffers (H, W) of pixels.

    Parameters
    ----------
    initial : list of (H, W) or (H, W, C) arrays
        Of every sample.
    rows, place, sample : (k,) int64
        Which rows write, where in the pixels' buffer, and which sample of it.
    values : (k,) or (k, C)
    """
    if track.name in OF_EVERY_SAMPLE:
        found = []
        for number, before in enumerate(initial):
            of = np.flatnonzero(sample == number)
            name = f"{track.name} {number}" if number else track.name
            written = (rows[of], place[of], values[of])
            found.append(BufferTrack(name, before, *written, track.kind, track.starts_known))
        return found
    before = initial[0]
    if track.name == "overdraw":
        # How often any of the samples was covered.
        before = np.sum(initial, axis=0, dtype=initial[0].dtype)
        values = (before.ravel()[place] + 1 + occurrence(place)).astype(np.int64)
    elif track.name == "coverage":
        return [
            _any_sample(track, before, rows, place, values),
            _covered_samples(before.shape, rows, place, sample, values),
        ]
    return [BufferTrack(track.name, before, rows, place, values, track.kind, track.starts_known)]


def _any_sample(
    track: BufferTrack, before: NDArray[Any], rows: Integers, place: Integers, values: Floats
) -> BufferTrack:
    """Return where any sample is covered by now: a (H, W) buffer from writes (k,)."""
    first = np.full(before.size, len(rows))
    covered = np.flatnonzero(values > 0)
    np.minimum.at(first, place[covered], covered)
    by_now = np.arange(len(rows)) >= first[place]
    return BufferTrack(track.name, before, rows, place, by_now.astype(float), track.kind)


def _covered_samples(
    shape: tuple[int, ...], rows: Integers, place: Integers, sample: Integers, values: Floats
) -> BufferTrack:
    """Return how many samples of every pixel are covered by now: a buffer of ``shape`` from writes (k,)."""
    covered = np.flatnonzero(values > 0)
    key = place[covered] * (int(sample.max(initial=0)) + 1) + sample[covered]
    new = covered[occurrence(key) == 0]
    counted = 1.0 + occurrence(place[new])
    return BufferTrack("samples", np.full(shape, np.nan), rows[new], place[new], counted, "count")


def _at_samples(columns: dict[str, NDArray[Any]], sample: Integers) -> dict[str, NDArray[Any]]:
    """Return x, y (R,) and c (R, 3) of the unmoved triangles, where the edge functions have the same values there.

    Rounding tells them apart where corners are not snapped: then the moved triangles are shown.
    """
    way = 0.5 - ROTATED_GRID[sample]
    # Rows about lanes and spans are about the moved triangle as a whole.
    way = np.where(np.isnan(columns["values"]).any(axis=1, keepdims=True), 0.0, way)
    x, y, a, b = (columns[name] for name in ("x", "y", "a", "b"))
    moved = {"x": x - way[:, 0], "y": y - way[:, 1], "c": columns["c"] + (a * way[:, :1] + b * way[:, 1:])}
    value = edge_value(a, b, moved["c"], moved["x"][:, None], moved["y"][:, None])
    is_pixel = columns["column"] >= 0
    is_same = np.array_equal(value[is_pixel], columns["values"][is_pixel], equal_nan=True)
    return moved if is_same else {}


def _sample_columns(sample: Integers, position: Floats) -> dict[str, NDArray[Any]]:
    """Return the number of the sample (R,) of every row, and where it lies in the pixel (R, 2)."""
    where = np.where(sample[:, None] >= 0, position[sample], np.nan)
    return {"sample": sample, "sample_position": where}


# What traces each stage.


def tracer_of(stage: str) -> Callable[[TraceSource], StageTrace]:
    """Return the function that traces a stage."""
    found: Callable[[TraceSource], StageTrace] = imported(stage_of(stage).tracer)
    return found


def load_tracers() -> None:
    """Import what traces the stages: each of them is otherwise imported when it is first traced."""
    for stage in STAGES:
        tracer_of(stage)


def trace_stage(source: TraceSource, name: str) -> StageTrace:
    """Trace a stage: of several samples a pixel, the stages before they are resolved have rows for each of them.

    Exact areas and filters have their own rows where pixels are resolved; before, the pixels' centres are followed.
    """
    found = _traced(source, name)
    if name != "depth" or source.scene.corner_count == 0 or not source.geometry.drawing.own_rows:
        return found
    ordered: StageTrace = imported(source.geometry.drawing.own_rows)(found, source)
    return ordered


def _traced(source: TraceSource, name: str) -> StageTrace:
    antialiasing = source.settings.antialiasing
    is_single = resolve(source.settings).sampling.count == 1
    # Culling says why nothing is an occluder: where pixels are sampled decides that.
    if name == "resolve" or antialiasing == Settings.antialiasing or (is_single and name == "cull"):
        return tracer_of(name)(source)
    if is_single:
        return tracer_of(name)(replace(source, settings=resolve(source.settings).of_one_sample))
    return trace_samples(source, name, tracer_of(name))
