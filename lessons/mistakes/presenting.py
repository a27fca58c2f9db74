"""Mistakes about frame buffers: when a picture is shown, and where a swap tears the screen."""

from core.framebuffer.presentation import Buffering, schedule
from lessons.mistakes.twin import wrong_rule


def shown_with_two(drawing_time: int, refresh_time: int) -> tuple[int, int]:
    """Return when pictures 1 and 2 are shown with two buffers that are swapped between refreshes."""
    buffering = Buffering(2, waits_for_blank=True)
    shown = schedule(buffering, drawing_time, refresh_time, 4 * (drawing_time + refresh_time)).shown
    return int(shown[1]), int(shown[2])


def torn_row(drawing_time: int, refresh_time: int, rows: int) -> tuple[int]:
    """Return from which row on, from the top, a refresh shows the first picture that is swapped at once."""
    return (-(-(drawing_time % refresh_time) * rows // refresh_time),)


@wrong_rule(shown_with_two, shows=(20, 16), hides=(32, 16))
def swap_before_ready(drawing: int, refresh: int) -> tuple[int, int]:
    """The pictures were shown at the ends of refreshes before they are ready. A swap waits for the next end."""
    return (drawing // refresh * refresh, 2 * (drawing // refresh * refresh))


@wrong_rule(shown_with_two, shows=(20, 16), hides=(32, 16))
def swap_without_waiting(drawing_time: int, refresh_time: int) -> tuple[int, int]:
    """The second picture was begun when the first was ready. With two buffers the renderer waits for the swap."""
    buffering = Buffering(3, waits_for_blank=True)
    shown = schedule(buffering, drawing_time, refresh_time, 4 * (drawing_time + refresh_time)).shown
    return int(shown[1]), int(shown[2])


@wrong_rule(shown_with_two, shows=(20, 16), hides=(32, 16))
def swap_when_ready(*times: int) -> tuple[int, int]:
    """The pictures were shown as soon as they were ready. A swap waits for the end of the refresh."""
    return (times[0], 2 * times[0])


@wrong_rule(torn_row, shows=(20, 16, 80), hides=(32, 16, 80))
def torn_share_of_drawing(drawing: int, refresh: int, rows: int) -> tuple[int]:
    """The time into the refresh was divided by the time to draw. The screen reads all its rows in one refresh."""
    return (-(-(drawing % refresh) * rows // drawing),)


@wrong_rule(torn_row, shows=(20, 16, 16), hides=(20, 15, 3))
def torn_from_below(drawing: int, refresh: int, rows: int) -> tuple[int]:
    """The row was counted from the bottom. The screen reads its rows from the top."""
    return (rows - 1 - torn_row(drawing, refresh, rows)[0],)
