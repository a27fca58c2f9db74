"""Flushing: how the bytes of a picture get into the memory that the screen is read from.

Every transfer costs a call, whatever it carries. So one transfer of a whole picture is much faster than one for each
pixel; but it can begin only when the picture is finished.

References
----------
LMU 2020, tutorial, "Why do we need a frame buffer?"
"""

from dataclasses import dataclass

from core.methods import method

BYTES = 4
"""Of one pixel: red, green, blue, alpha."""


@dataclass(frozen=True)
class Flush:
    """What a way of flushing means for the time at which rows arrive."""

    waits_for_picture: bool = False
    """Whether nothing arrives before the picture is finished; else every row does when it is drawn."""
    is_by_pixel: bool = False
    """Whether a row takes a transfer for each of its pixels."""

    def transfers(self, row_count: int, width: int) -> int:
        """Return how many transfers ``row_count`` rows of ``width`` pixels take."""
        if self.waits_for_picture:
            return 1
        return row_count * (width if self.is_by_pixel else 1)


def copy_by_row(memory: bytearray, picture: bytes, width: int) -> int:
    """Copy a picture into a memory of its size row by row; return the number of transfers."""
    transfers, size = 0, 4 * width
    for first in range(0, len(picture), size):
        memory[first : first + size] = picture[first : first + size]
        transfers += 1  #: transfer
    return transfers


def copy_by_pixel(memory: bytearray, picture: bytes, width: int) -> int:
    """Copy a picture into a memory of its size pixel by pixel; return the number of transfers."""
    transfers = 0
    for first in range(0, len(picture), 4):
        memory[first : first + 4] = picture[first : first + 4]
        transfers += 1  #: transfer
    return transfers


def copy_at_once(memory: bytearray, picture: bytes, width: int) -> int:
    """Copy a picture into a memory of its size in one piece; return the number of transfers."""
    memory[:] = picture
    transfers = 1  #: transfer
    return transfers


@method(
    "flush",
    "by-row",
    "Row by row",
    source="LMU 2020, Why do we need a frame buffer?",
    exact_for="every picture; a row arrives as soon as it is drawn",
    breaks_where="one transfer a row costs time; a screen that reads meanwhile shows rows of two pictures",
    listing=copy_by_row,
)
def by_row() -> Flush:
    """Send a row when it is drawn."""
    return Flush()


@method(
    "flush",
    "by-pixel",
    "Pixel by pixel",
    source="LMU 2020, Why do we need a frame buffer?: rendering pixel by pixel",
    exact_for="every picture; a pixel arrives as soon as it is drawn",
    breaks_where="one transfer a pixel: by far the slowest, see the chart Flushing of the page Compare",
    listing=copy_by_pixel,
)
def by_pixel() -> Flush:
    """Send each pixel of a row by itself."""
    return Flush(is_by_pixel=True)


@method(
    "flush",
    "at-once",
    "The whole picture at once",
    source="LMU 2020, Why do we need a frame buffer?: flushing an entire buffer at once",
    exact_for="every picture, in one transfer",
    breaks_where="nothing arrives before the picture is finished",
    listing=copy_at_once,
)
def at_once() -> Flush:
    """Send the picture when its last row is drawn."""
    return Flush(waits_for_picture=True)
