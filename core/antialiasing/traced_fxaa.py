"""Trace of FXAA: one row for every pixel of the finished picture, which is left alone or moved towards its edge."""

import numpy as np

from core.antialiasing.fxaa import SmoothedPicture, bends, edge_pixel, mixed_byte, smooth_edges
from core.framebuffer.display import encode_linear, encode_srgb, srgb_byte
from core.records.arrays import Integers
from core.records.listing import RETURN, Listing, Operation, listing
from core.records.steps import Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

CONTRAST = Operation("contrast", "contrast", ("contrast",), ("around", "threshold"))


def filter_operations(shown: tuple[Operation, ...]) -> dict[str, tuple[Operation, ...]]:
    """Return what the rows do: ``shown`` makes the values that the screen would show, and the last of it a byte."""
    return {
        "kept": (*shown[:-1], CONTRAST, shown[-1]),
        "smoothed": (
            *shown[:-1],
            CONTRAST,
            Operation("rows", "rows", ("along_row",)),
            Operation("columns", "columns", ("along_column",)),
            Operation("direction", "direction", {"is_horizontal": "horizontal"}),
            Operation("side", "side", ("side",)),
            Operation("pair", "pair", ("pair", "step")),
            Operation("back", "back", {"steps_back": "k"}, ("back",)),
            Operation("forth", "forth", {"steps_forth": "j"}, ("forth",)),
            Operation("edge", "edge", {"edge_offset": "edge"}),
            Operation("detail", "detail", {"detail_offset": "detail"}),
            Operation("offset", "offset", {"offset": RETURN}),
            Operation("blend", "blend", ("mixed",), ("encoded", "other")),
            Operation("round", "round", {"bytes": RETURN}),
        ),
    }


def trace_filter(
    source: TraceSource, color: np.ndarray, wide_of: tuple[slice, slice], shown: tuple[Operation, ...]
) -> StageTrace:
    """Return one row for every pixel of the raster, of a picture (h, w, 4) that has all pixels the filter looks at.

    Parameters
    ----------
    wide_of : (slice, slice)
        Where the raster's pixels stand in the picture.
    shown : tuple of Operation
        What makes of a linear colour the values that the screen would show, and of these bytes.
    """
    smoothed = smooth_edges(color)
    rows, columns_of = wide_of
    height, width = source.raster.shape
    count = height * width
    column, row = source.raster.position(np.arange(count))
    at = np.full(smoothed.luma.shape, -1)
    at.ravel()[smoothed.edges.place] = np.arange(len(smoothed.edges.place))
    edge = at[rows, columns_of].ravel()
    linear = color[rows, columns_of].reshape(count, 4)
    with np.errstate(invalid="ignore"):
        clipped = np.clip(np.nan_to_num(linear[:, :3].astype(float)), 0.0, 1.0)
    result = smoothed.color[rows, columns_of].reshape(count, 4)
    pixels = np.column_stack([encode_srgb(result[:, :3]), encode_linear(result[:, 3])])
    encoded = smoothed.shown[rows, columns_of].reshape(count, 4)
    columns = {
        "column": column,
        "row": row,
        "linear": linear,
        "clipped": clipped,
        "encoded": encoded[:, :3],
        "bytes": pixels,
        "around": _around(smoothed, rows, columns_of),
        "contrast": smoothed.contrast[rows, columns_of].ravel(),
        "threshold": smoothed.threshold[rows, columns_of].ravel(),
        **_edge_columns(smoothed, edge),
    }
    kinds = ("kept", "smoothed")
    every = np.arange(count)
    nothing = np.full((height, width), np.nan)
    found = np.flatnonzero(edge >= 0)
    tracks = (
        BufferTrack("display", np.zeros((height, width, 4), np.uint8), every, every, pixels, "bytes"),
        BufferTrack("color", np.full((height, width, 4), np.nan, np.float32), every, every, result, "color"),
        BufferTrack("luma", nothing, every, every, columns["around"][:, 1, 1]),
        BufferTrack("edges", nothing, every, every, (edge >= 0).astype(float), "flags"),
        BufferTrack("moved by", nothing, found, found, columns["offset"][found]),
    )
    return StageTrace(
        stage="resolve",
        method=f"antialiasing={source.settings.antialiasing}",
        steps=Steps(
            kinds, (edge >= 0).astype(np.int64), filter_operations(shown), np.array([count]), ends_of(row)
        ),
        columns=columns,
        triangle=np.full(count, -1),
        pixel=np.stack([column, row], axis=1),
        listings=_listings(),
        marks={"nan": np.any(np.isnan(linear), axis=1)},
        buffers=tracks,
    )


def _around(smoothed: SmoothedPicture, rows: slice, columns: slice) -> np.ndarray:
    """Return the lumas (R, 3, 3) around the pixels, those at the border repeated."""
    wide = np.pad(smoothed.luma, 1, mode="edge")
    height, width = rows.stop - rows.start, columns.stop - columns.start
    parts = [
        wide[rows.start + j : rows.start + j + height, columns.start + i : columns.start + i + width].ravel()
        for j in range(3)
        for i in range(3)
    ]
    return np.stack(parts, axis=1).reshape(-1, 3, 3)


def _edge_columns(smoothed: SmoothedPicture, edge: Integers) -> dict[str, np.ndarray]:
    """Return what is known of the pixels beside an edge, NaN or 0 at others; ``edge`` (R,) tells which, -1: none."""
    edges, has_edge = smoothed.edges, edge >= 0
    along_row, along_column = bends(edges.around)
    known: dict[str, np.ndarray] = {
        "along_row": along_row,
        "along_column": along_column,
        "is_horizontal": edges.is_horizontal,
        "side": edges.side,
        "pair": edges.pair,
        "step": edges.step,
        "back": edges.walked[:, 0],
        "forth": edges.walked[:, 1],
        "steps_back": edges.distance[:, 0],
        "steps_forth": edges.distance[:, 1],
        "edge_offset": edges.edge_offset,
        "detail_offset": edges.detail_offset,
        "offset": edges.offset,
        "other": smoothed.other,
        "mixed": smoothed.mixed,
    }
    columns = {}
    for name, values in known.items():
        filled = np.zeros((len(edge), *values.shape[1:]), values.dtype)
        filled[has_edge] = values[edge[has_edge]]
        columns[name] = filled
    return columns


def _listings() -> dict[str, Listing]:
    shown, found, mixed = listing(srgb_byte), listing(edge_pixel), listing(mixed_byte)
    of_edge = (
        *("contrast", "rows", "columns", "direction", "side", "pair", "back", "forth", "edge"),
        *("detail", "offset"),
    )
    return (
        {"kept": shown, "smoothed": shown}
        | {f"{kind}.contrast": found for kind in ("kept", "smoothed")}
        | {f"smoothed.{name}": found for name in of_edge}
        | {f"smoothed.{name}": mixed for name in ("blend", "round")}
    )
