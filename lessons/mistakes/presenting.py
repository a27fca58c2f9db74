"""Mistakes about frame buffers: when a picture is shown, and where a swap tears the screen."""

from core.framebuffer.presentation import Buffering, schedule
from lessons.mistakes.twin import WrongRule


def shown_with_two(drawing_time: int, refresh_time: int) -> tuple[int, int]:
    """Return when pictures 1 and 2 are shown with two buffers that are swapped between refreshes."""
    buffering = Buffering(2, waits_for_blank=True)
    shown = schedule(buffering, drawing_time, refresh_time, 4 * (drawing_time + refresh_time)).shown
    return int(shown[1]), int(shown[2])


def shown_without_waiting(drawing_time: int, refresh_time: int) -> tuple[int, int]:
    """Let the renderer begin the second picture when the first is ready, as with a third buffer."""
    buffering = Buffering(3, waits_for_blank=True)
    shown = schedule(buffering, drawing_time, refresh_time, 4 * (drawing_time + refresh_time)).shown
    return int(shown[1]), int(shown[2])


def torn_row(drawing_time: int, refresh_time: int, rows: int) -> tuple[int]:
    """Return from which row on, from the top, a refresh shows the first picture that is swapped at once."""
    return (-(-(drawing_time % refresh_time) * rows // refresh_time),)


RULES = (
    WrongRule(
        "swap-before-ready",
        "The pictures were shown at the ends of refreshes before they are ready. A swap waits for the next end.",
        shown_with_two,
        lambda drawing, refresh: (drawing // refresh * refresh, 2 * (drawing // refresh * refresh)),
        (20, 16),
        (32, 16),
    ),
    WrongRule(
        "swap-without-waiting",
        "The second picture was begun when the first was ready. With two buffers the renderer waits for the swap.",
        shown_with_two,
        shown_without_waiting,
        (20, 16),
        (32, 16),
    ),
    WrongRule(
        "swap-when-ready",
        "The pictures were shown as soon as they were ready. A swap waits for the end of the refresh.",
        shown_with_two,
        lambda *times: (times[0], 2 * times[0]),
        (20, 16),
        (32, 16),
    ),
    WrongRule(
        "torn-share-of-drawing",
        "The time into the refresh was divided by the time to draw. The screen reads all its rows in one refresh.",
        torn_row,
        lambda drawing, refresh, rows: (-(-(drawing % refresh) * rows // drawing),),
        (20, 16, 80),
        (32, 16, 80),
    ),
    WrongRule(
        "torn-from-below",
        "The row was counted from the bottom. The screen reads its rows from the top.",
        torn_row,
        lambda drawing, refresh, rows: (rows - 1 - torn_row(drawing, refresh, rows)[0],),
        (20, 16, 16),
        (20, 15, 3),
    ),
)
