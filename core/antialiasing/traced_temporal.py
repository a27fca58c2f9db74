"""Trace of temporal antialiasing: one picture after another is mixed with the history, then the last one is encoded."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.antialiasing.temporal import MixedPicture, blended_history, sample_point
from core.framebuffer.display import encode_linear, encode_srgb, srgb, srgb_byte
from core.pipeline import mixed_pictures
from core.records.arrays import Integers, Singles
from core.records.listing import RETURN, Operation, listing
from core.records.steps import Level, RowOrder, Steps, ends_of
from core.resolved import resolve
from core.stages.vertices import Before
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

_POINT = Operation("point", "point", {"point": RETURN}, ("picture", "age", "new"))
_HISTORY = Operation("history", "", (), ("from_x", "from_y", "history"))
_MIX = (Operation("share", "share", ("share",)), Operation("mix", "mix", {"kept": RETURN}))
TEMPORAL_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "first": (_POINT, Operation("begin", "begin", {"kept": RETURN})),
    "outside": (_POINT, Operation("lost", "begin", {"kept": RETURN}, ("from_x", "from_y"))),
    "mixed": (_POINT, _HISTORY, *_MIX),
    "limited": (
        _POINT,
        _HISTORY,
        Operation("clamp", "clamp", {"limited": "history"}, ("low", "high")),
        *_MIX,
    ),
}
"""Kind of row to what it does: in the first picture, where a pixel was not in the picture before, and where it was."""


class PictureOrder(RowOrder):
    """Picture after picture, and in each row after row."""

    def unit(self, level: Level, column: int, row: int) -> str:
        """Return what the step of a level is called."""
        return "One picture" if level <= Level.TRIANGLE else f"One picture, row {row}"


PICTURE_BY_PICTURE = PictureOrder(("Picture", "Row", "Pixel"), sums=(("rows", "place", "done"),))


def trace_temporal(source: TraceSource, last: Before | None, encode: tuple[Operation, ...]) -> StageTrace:
    """Return one row for every pixel of every picture, and one that encodes each pixel of the last.

    Parameters
    ----------
    last : Before, optional
        What the buffers show after the last row; ``None``: all triangles.
    encode : tuple of Operation
        What makes bytes of a linear colour.
    """
    pictures, inner = mixed_pictures(source.scene, source.settings, source.raster, last)
    count = source.raster.shape[0] * source.raster.shape[1]
    rule = resolve(source.settings).method("history").function()
    operations = {**TEMPORAL_OPERATIONS, "encode": encode}
    kinds = tuple(operations)
    kind = np.concatenate(
        [_kinds(kinds, picture, inner, rule.is_clamped) for picture in pictures]
        + [np.full(count, kinds.index("encode"))]
    )
    turn = np.repeat(np.arange(1, len(pictures) + 2), count)
    column, row = (np.tile(part, len(pictures) + 1) for part in source.raster.position(np.arange(count)))
    linear = pictures[-1].kept[inner].astype(np.float32).reshape(count, 4)
    columns = {
        "column": column,
        "row": row,
        **_columns(pictures, inner, count),
        **_encoded(linear, len(pictures) * count),
    }
    is_last = turn == len(pictures) + 1
    return StageTrace(
        stage="resolve",
        method=f"antialiasing={source.settings.antialiasing}",
        steps=Steps(kinds, kind, operations, ends_of(turn), ends_of(turn, row)),
        columns=columns,
        triangle=np.full(len(kind), -1),
        pixel=np.stack([column, row], axis=1),
        listings=dict.fromkeys(TEMPORAL_OPERATIONS, listing(blended_history))
        | {f"{name}.point": listing(sample_point) for name in TEMPORAL_OPERATIONS}
        | {"encode": listing(srgb_byte)},
        constants={"pictures": len(pictures), "least_share": source.settings.blend_share / 100},
        marks={"nan": np.any(np.isnan(columns["kept"]), axis=1) & ~is_last},
        buffers=_tracks(source.raster.shape, columns, is_last),
        order=PICTURE_BY_PICTURE,
    )


def _kinds(
    kinds: tuple[str, ...], picture: MixedPicture, inner: tuple[slice, slice], is_clamped: bool
) -> Integers:
    """Return what is done to each pixel (R,) of a picture."""
    known = picture.is_known[inner].ravel()
    none = "first" if not picture.is_known.any() else "outside"
    return np.where(known, kinds.index("limited" if is_clamped else "mixed"), kinds.index(none))


def _columns(pictures: list[MixedPicture], inner: tuple[slice, slice], count: int) -> dict[str, NDArray[Any]]:
    """Return what is known of every pixel of every picture, and no value for the rows that encode."""

    def of(name: str, *shape: int) -> NDArray[Any]:
        parts = [getattr(picture, name)[inner].reshape(count, *shape).astype(float) for picture in pictures]
        return np.concatenate([*parts, np.full((count, *shape), np.nan)])

    each = np.arange(1, len(pictures) + 1)
    points = np.array([picture.point for picture in pictures] + [(np.nan, np.nan)])
    shares = np.array([picture.share for picture in pictures] + [np.nan])
    return {
        "picture": np.repeat(np.append(each, -1), count),
        "age": np.repeat(np.append(len(pictures) - each, -1), count),
        "point": np.repeat(points, count, axis=0),
        "share": np.repeat(shares, count),
        "from_x": of("from_x"),
        "from_y": of("from_y"),
        **{name: of(name, 4) for name in ("new", "history", "low", "high", "limited", "kept")},
    }


def _encoded(linear: Singles, before: int) -> dict[str, NDArray[Any]]:
    """Return the columns of the rows that encode colours (R, 4), behind ``before`` rows of no value."""
    with np.errstate(invalid="ignore"):
        clipped = np.clip(np.nan_to_num(linear[:, :3].astype(float)), 0.0, 1.0)
    pixels = np.column_stack([encode_srgb(linear[:, :3]), encode_linear(linear[:, 3])])
    found = {"linear": linear, "clipped": clipped, "encoded": srgb(clipped), "bytes": pixels}
    return {
        name: np.concatenate(
            [
                np.full((before, values.shape[1]), 0 if values.dtype == np.uint8 else np.nan, values.dtype),
                values,
            ]
        )
        for name, values in found.items()
    }


def _tracks(
    shape: tuple[int, int], columns: dict[str, NDArray[Any]], is_last: NDArray[np.bool_]
) -> tuple[BufferTrack, ...]:
    """Return what is kept, what each picture brings and finds, and the display."""
    shown, mixed = np.flatnonzero(is_last), np.flatnonzero(~is_last)
    at = np.arange(shape[0] * shape[1])
    place = np.tile(at, len(mixed) // max(len(at), 1))
    unknown, nothing = np.full((*shape, 4), np.nan, np.float32), np.full(shape, np.nan)
    bytes_before = np.zeros((*shape, 4), np.uint8)
    colors = {"color": "kept", "new": "new", "history": "limited", "least": "low", "greatest": "high"}
    return (
        *(
            BufferTrack(title, unknown, mixed, place, columns[name][mixed].astype(np.float32), "color")
            for title, name in colors.items()
        ),
        *(
            BufferTrack(f"sample {axis}", nothing, mixed, place, columns["point"][mixed, k])
            for k, axis in enumerate("xy")
        ),
        BufferTrack("display", bytes_before, shown, at, columns["bytes"][shown], "bytes"),
    )
