"""Rows of a presentation, after the picture is finished: rows written, waits, swaps, and rows that the screen reads."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.framebuffer import presentation
from core.records.arrays import Integers
from core.records.listing import Listing, Operation, listing
from core.records.steps import Level, RowOrder
from core.resolved import resolve
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, InsertedRows, StageTrace, insert_rows

_WRITTEN = (
    Operation("write", "write", {"time": "time"}, ("picture", "line", "begun", "buffer")),
    Operation("transfer", "transfer", {"transfers": "transfers"}),
)
PRESENTED_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "written": _WRITTEN,
    "flushed": _WRITTEN,
    "wait": (Operation("wait", "wait", {"blank": "blank"}, ("picture", "time")),),
    "swap": (Operation("swap", "swap", (), ("picture", "time", "buffer")),),
    "scan": (
        Operation("time", "time", {"time": "time"}, ("refresh", "line")),
        Operation("read", "read", {"picture": "picture"}, ("buffer",)),
    ),
}
"""Kind of row to what it does."""
KINDS = tuple(PRESENTED_OPERATIONS)


class PresentedOrder(RowOrder):
    """Names of the steps: rows of pixels, then refreshes of the screen."""

    def unit(self, level: Level, column: int, row: int) -> str:
        """Return what the step of a level is called."""
        is_pixels = row >= 0
        if level <= Level.TRIANGLE:
            return "The picture" if is_pixels else "The presentation"
        return f"Row {row}" if is_pixels else "One refresh"


ORDER = PresentedOrder(("Picture, presentation", "Row or refresh", "Pixel or row"))


def moved_pictures(picture: NDArray[Any], count: int) -> NDArray[Any]:
    """Return (N, H, W, 4) pictures of a pan: each is moved by an eighth of its width, what leaves comes back."""
    step = max(picture.shape[1] // 8, 1)
    return np.stack([np.roll(picture, k * step, axis=1) for k in range(count)])


def with_presentation(found: StageTrace, source: TraceSource) -> StageTrace:
    """Return the trace of resolving with the rows of the presentation behind it, where one is chosen."""
    settings = source.settings
    buffering: presentation.Buffering = resolve(settings).method("presentation").function()
    if not buffering.buffer_count or source.scene.corner_count == 0:
        return found
    display = next(track for track in found.buffers if track.name == "display")
    height, width = display.initial.shape[:2]
    flush = resolve(settings).method("flush").function()
    happens, times = presentation.events(
        buffering, flush, height, settings.drawing_time, settings.refresh_time
    )
    rows, count = found.steps.row_count, len(happens.what)
    kind = happens.what + 1
    kind[(happens.what == presentation.WRITE) & (not flush.waits_for_picture)] = 0
    buffer = happens.picture % buffering.buffer_count
    later = np.append(times.begun[1:], times.ready[-1])
    drawn = happens.line + 1
    columns = {
        "time": happens.time,
        "refresh": happens.refresh,
        "line": happens.line,
        "picture": happens.picture,
        "buffer": buffer,
        "begun": times.begun[happens.picture],
        "ready": times.ready[happens.picture],
        "blank": times.shown[happens.picture],
        "next_begun": later[happens.picture],
        "transfers": np.array([flush.transfers(int(k), width) for k in drawn]),
        "above": _above(happens),
    }
    joined = insert_rows(
        found,
        np.searchsorted(found.steps.group_ends, np.arange(rows), "right"),
        InsertedRows(
            before=np.full(count, rows),
            group=-1 - happens.refresh,
            triangle=np.full(count, -1),
            kinds=KINDS,
            kind=kind,
            operations=PRESENTED_OPERATIONS,
            columns=columns,
            listings=_listings(source, buffering),
        ),
    )
    pictures = moved_pictures(display.at(rows), len(times.begun))
    return replace(
        joined,
        method=f"presentation={settings.presentation}",
        steps=replace(joined.steps, triangle_ends=np.append(found.steps.triangle_ends, rows + count)),
        constants={
            **joined.constants,
            "drawing_time": settings.drawing_time,
            "refresh_time": settings.refresh_time,
            "height": height,
            "buffer_count": buffering.buffer_count,
        },
        buffers=_tracks(joined, happens, times, pictures, rows, buffering, flush.waits_for_picture),
        order=ORDER,
    )


def _above(happens: presentation.Events) -> Integers:
    """Return (E,) the picture that the row above shows in the same refresh; -1: there is none."""
    above = np.full(len(happens.what), -1)
    scans = np.flatnonzero(happens.what == presentation.SCAN)
    is_same = happens.refresh[scans[1:]] == happens.refresh[scans[:-1]]
    above[scans[1:][is_same]] = happens.picture[scans[:-1][is_same]]
    return above


def _listings(source: TraceSource, buffering: presentation.Buffering) -> dict[str, Listing]:
    swap = listing(presentation.blank_for if buffering.waits_for_blank else presentation.swap_at_once)
    transfer = listing(resolve(source.settings).method("flush").listing or presentation.drawn_time)
    written = listing(presentation.drawn_time)
    return {
        "written": written,
        "flushed": written,
        "written.transfer": transfer,
        "flushed.transfer": transfer,
        "wait": swap,
        "swap": swap,
        "scan": listing(presentation.picture_read),
    }


def _tracks(
    joined: StageTrace,
    happens: presentation.Events,
    times: presentation.Schedule,
    pictures: NDArray[Any],
    first: int,
    buffering: presentation.Buffering,
    is_whole: bool,
) -> tuple[BufferTrack, ...]:
    """Return the buffer that is drawn into, those of the stage, every buffer by itself, and the screen.

    Parameters
    ----------
    pictures : (N, H, W, 4) uint8
    first : int
        The row of the first event.
    is_whole : bool
        Whether an event writes a whole picture, not one row.
    """
    display = next(track for track in joined.buffers if track.name == "display")
    height, width = display.initial.shape[:2]
    buffers = buffering.buffer_count
    whole = np.arange(height * width)
    writes: list[list[tuple[int, Integers, NDArray[Any]]]] = [[] for _ in range(buffers)]
    drawn: list[tuple[int, Integers, NDArray[Any]]] = []
    scanned: list[tuple[int, Integers, NDArray[Any]]] = []
    seen = 0
    for event, (what, line, number) in enumerate(
        zip(happens.what.tolist(), happens.line.tolist(), happens.picture.tolist(), strict=True)
    ):
        row, at = first + event, height - 1 - line
        begun = number + (what == presentation.SWAP)
        if what in (presentation.WRITE, presentation.SWAP) and begun > seen and buffers > 1:
            # The renderer turns to another buffer, which holds an older picture, or nothing: at the latest when
            # its own becomes the front buffer.
            older, seen = begun - buffers, begun
            kept = np.zeros_like(pictures[0]) if older < 0 else pictures[older]
            drawn.append((row, whole, kept.reshape(-1, 4)))
        if what == presentation.WRITE:
            places = whole if is_whole else at * width + np.arange(width)
            written = row, places, pictures[number].reshape(-1, 4)[places]
            writes[number % buffers].append(written)
            drawn.append(written)
        elif what == presentation.SCAN:
            places = at * width + np.arange(width)
            scanned.append((row, places, pictures[number].reshape(-1, 4)[places]))

    def track(
        name: str, initial: NDArray[Any], made: list[tuple[int, Integers, NDArray[Any]]]
    ) -> BufferTrack:
        if not made:
            return BufferTrack(name, initial, whole[:0], whole[:0], initial.reshape(-1, 4)[:0], "bytes")
        rows = np.concatenate([np.full(len(places), row) for row, places, _ in made])
        return BufferTrack(
            name,
            initial,
            rows,
            np.concatenate([places for _, places, _ in made]),
            np.concatenate([values for *_, values in made]),
            "bytes",
        )

    # Picture 0 is in buffer 0 when it is finished.
    finished = display.rows.copy(), display.places.copy(), display.values.copy()
    own = [track(f"buffer {k}", display.initial, made) for k, made in enumerate(writes)]
    own[0] = _joined(own[0], *finished)
    into = _joined(track("drawn into", display.initial, drawn), *finished)
    screen = track("screen", display.initial, scanned)
    singles = own if buffers > 1 else []
    return (into, *joined.buffers, *singles, screen)


def _joined(track: BufferTrack, rows: Integers, places: Integers, values: NDArray[Any]) -> BufferTrack:
    """Return a track with earlier writes before its own."""
    return replace(
        track,
        rows=np.concatenate([rows, track.rows]),
        places=np.concatenate([places, track.places]),
        values=np.concatenate([values, track.values]),
    )
