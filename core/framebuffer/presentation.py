"""Frame buffers and the screen: when each row of which picture is drawn, swapped to the front, and read.

A model without a clock, in whole milliseconds. The screen reads its rows from the top, row r of refresh f at
(f + r/H) P, where P is the time of a refresh. The renderer draws rows from the top too, and needs T for a picture.
Picture 0 is in the front buffer at time 0, and the renderer begins picture 1. Pictures are shown in order, and none is
left out: a renderer that finds no free buffer waits for one.

References
----------
LMU 2020, tutorial, "Double buffering"; J. Foley, A. van Dam, S. Feiner, J. Hughes, *Computer Graphics: Principles and
Practice*, 1990, section 4.3.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from core.framebuffer.flushing import Flush
from core.methods import method
from core.records.arrays import Flags, Floats, Integers

MOST_REFRESHES = 16
"""Refreshes that are stepped."""
Time = TypeVar("Time", float, Floats)
WRITE, WAIT, SWAP, SCAN = range(4)
"""What an event is, in the order of those at one time."""


@dataclass(frozen=True)
class Buffering:
    """Which buffers there are, and when they are swapped."""

    buffer_count: int
    """0: nothing is shown; 1: the screen reads the buffer that is drawn into."""
    waits_for_blank: bool = False
    """Whether a swap waits for the end of the refresh; else it is done when the picture is ready."""


@dataclass(frozen=True, eq=False)
class Schedule:
    """Times of pictures 0 to n - 1, in milliseconds; picture 0 is there from the beginning."""

    begun: Integers
    """(N,) int64, when the renderer begins each; 0 for picture 0."""
    ready: Integers
    """(N,) int64, when its last row is drawn."""
    shown: Integers
    """(N,) int64, when its buffer is the front buffer; of a single buffer, when it is ready."""


def blank_for(ready: int, shown: int, refresh_time: int) -> int:
    """Listing: when a picture that is ready is swapped; the one before it is shown since ``shown``."""
    refreshes = max(-(-ready // refresh_time), shown // refresh_time + 1)
    blank = refreshes * refresh_time  #: wait
    return blank  #: swap


def swap_at_once(ready: int) -> int:
    """Listing: when a picture that is ready is swapped, whatever the screen is reading."""
    return ready  #: swap


def drawn_time(begun: Time, line: Time, height: int, drawing_time: int) -> Time:
    """Listing: when row ``line`` of a picture is drawn, from the top and from 0; arrays may be of any shape, (E,)."""
    time = (begun * height + (line + 1) * drawing_time) / height  #: write
    return time


def read_time(refresh: Time, line: Time, height: int, refresh_time: int) -> Time:
    """Return when the screen reads row ``line`` of a refresh; arrays may be of any shape, (E,)."""
    return (refresh * height + line) * refresh_time / height


def picture_read(
    refresh: int, line: int, height: int, refresh_time: int, since: Sequence[float]
) -> tuple[float, int]:
    """Listing: when a row of a refresh is read, and of which picture; ``since`` tells from when each is there."""
    time = (refresh * height + line) * refresh_time / height  #: time
    picture = max(k for k in range(len(since)) if since[k] <= time)  #: read
    return time, picture


def schedule(buffering: Buffering, drawing_time: int, refresh_time: int, end: int) -> Schedule:
    """Return the times of all pictures that are begun before ``end``, in milliseconds."""
    begun, ready, shown = [0], [0], [0]
    count = buffering.buffer_count
    while True:
        # Its buffer is free once the picture after the one that it holds is shown.
        free = shown[len(shown) - count + 1] if 1 < count <= len(shown) else 0
        start = max(ready[-1], free)
        if start >= end:
            return Schedule(np.array(begun), np.array(ready), np.array(shown))
        begun.append(start)
        ready.append(start + drawing_time)
        is_delayed = buffering.waits_for_blank
        shown.append(blank_for(ready[-1], shown[-1], refresh_time) if is_delayed else swap_at_once(ready[-1]))


def available(buffering: Buffering, flush: Flush, times: Schedule, height: int, drawing_time: int) -> Floats:
    """Return (N, H) float64, from when each row of each picture is what the screen finds there, in milliseconds."""
    if buffering.buffer_count > 1 or flush.waits_for_picture:
        return np.repeat(times.shown[:, None].astype(np.float64), height, axis=1)
    drawn = drawn_time(
        times.begun[:, None].astype(float), np.arange(height, dtype=float), height, drawing_time
    )
    drawn[0] = 0.0
    return drawn


def pictures_read(since: Floats, refresh_count: int, refresh_time: int) -> Integers:
    """Return (F, H) int64, the picture that each row of each refresh shows; ``since`` is (N, H)."""
    height = since.shape[1]
    found = np.empty((refresh_count, height), np.int64)
    for line in range(height):
        lines = np.full(refresh_count, float(line))
        read = read_time(np.arange(refresh_count, dtype=float), lines, height, refresh_time)
        found[:, line] = np.searchsorted(since[:, line], read, "right") - 1
    return found


def torn(pictures: Integers) -> Flags:
    """Return (F,) bool, which of the refreshes (F, H) show rows of several pictures."""
    return np.asarray((pictures != pictures[:, :1]).any(axis=1))


@dataclass(frozen=True, eq=False)
class Events:
    """What happens, in order of time, (E,) each."""

    what: Integers
    """int64, `WRITE` to `SCAN`."""
    time: Floats
    """float64, milliseconds."""
    refresh: Integers
    """int64, the refresh that is being read, from 0."""
    line: Integers
    """int64, the row from the top that is written or read; of a whole picture the last one, of a swap the one that is
    read next; -1: a wait."""
    picture: Integers
    """int64, which is written, waits, is swapped, or is read."""


def events(
    buffering: Buffering, flush: Flush, height: int, drawing_time: int, refresh_time: int
) -> tuple[Events, Schedule]:
    """Return what is stepped, and the times of the pictures in it."""
    count = min(2 * -(-drawing_time // refresh_time) + 1, MOST_REFRESHES)
    end = count * refresh_time
    times = schedule(buffering, drawing_time, refresh_time, end)
    since = available(buffering, flush, times, height, drawing_time)
    every = np.arange(1, len(times.begun))
    lines = np.array([height - 1]) if flush.waits_for_picture else np.arange(height)
    picture, line = (part.ravel() for part in np.meshgrid(every, lines, indexing="ij"))
    drawn = drawn_time(times.begun[picture].astype(float), line.astype(float), height, drawing_time)
    waits = every[times.shown[1:] > times.ready[1:]]
    swaps = every if buffering.buffer_count > 1 else every[:0]
    position = times.shown[swaps] % refresh_time * height
    next_line = -(-position // refresh_time)
    refresh, scanned = (part.ravel() for part in np.mgrid[:count, :height])
    read = read_time(refresh.astype(float), scanned.astype(float), height, refresh_time)
    parts = (
        (WRITE, drawn, line, picture),
        (WAIT, times.ready[waits].astype(float), np.full(len(waits), -1), waits),
        (SWAP, times.shown[swaps].astype(float), next_line, swaps),
        (SCAN, read, scanned, pictures_read(since, count, refresh_time).ravel()),
    )
    what = np.concatenate([np.full(len(part[1]), part[0]) for part in parts])
    time, lines, pictures = (np.concatenate([part[k] for part in parts]) for k in (1, 2, 3))
    order = np.lexsort((lines, what, time))
    order = order[time[order] < end]
    time = time[order]
    return Events(
        what[order], time, (time // refresh_time).astype(np.int64), lines[order], pictures[order]
    ), times


@method(
    "presentation",
    "none",
    "None: one picture",
    source="Pellacini, Framebuffer processing: the picture is finished",
    exact_for="a picture that stands still",
)
def not_presented() -> Buffering:
    """Show nothing: the picture ends with its bytes."""
    return Buffering(0)


@method(
    "presentation",
    "single",
    "Single buffer",
    source="LMU 2020, Frame buffer",
    exact_for="pictures that do not move, or are drawn row by row in the time of one refresh",
    breaks_where="the screen reads what is half drawn: rows of two pictures are seen together",
    takes=("flush", "drawing_time", "refresh_time"),
)
def single() -> Buffering:
    """Draw into the buffer that the screen is read from."""
    return Buffering(1)


@method(
    "presentation",
    "double",
    "Double buffer, swapped between refreshes",
    source="LMU 2020, Double buffering",
    exact_for="whole pictures: no refresh shows rows of two",
    breaks_where="a picture that takes longer than a refresh waits for the next one, and the renderer with it: "
    "1 / (P ceil(T / P)) pictures a second",
    takes=("flush", "drawing_time", "refresh_time"),
    listing=blank_for,
)
def double() -> Buffering:
    """Draw into a back buffer, and swap between two refreshes."""
    return Buffering(2, waits_for_blank=True)


@method(
    "presentation",
    "double-at-once",
    "Double buffer, swapped at once",
    source="LMU 2020, Double buffering, without waiting for the screen",
    exact_for="the rate: the renderer never waits, 1 / T pictures a second",
    breaks_where="a swap in the middle of a refresh tears it, which no swap does only where T is a multiple of P",
    takes=("flush", "drawing_time", "refresh_time"),
    listing=swap_at_once,
)
def double_at_once() -> Buffering:
    """Draw into a back buffer, and swap when the picture is ready."""
    return Buffering(2)


@method(
    "presentation",
    "triple",
    "Triple buffer",
    source="LMU 2020, caching several frames; T. Akenine-Moeller et al., Real-Time Rendering, 2018, section 23.6",
    exact_for="whole pictures, min(1 / P, 1 / T) of them a second",
    breaks_where="a third buffer takes memory, and a picture that waits is seen later",
    takes=("flush", "drawing_time", "refresh_time"),
    listing=blank_for,
)
def triple() -> Buffering:
    """Draw the next picture into a third buffer while one waits for the end of the refresh."""
    return Buffering(3, waits_for_blank=True)
