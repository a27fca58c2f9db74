"""Where a picture of a given size lies in a view: as large as it can be without being distorted."""

from math import floor

from PySide6.QtCore import QRectF


def picture_area(room: QRectF, size: tuple[int, int], ratio: float) -> QRectF:
    """Return the part of ``room`` that a picture fills, in the middle.

    Parameters
    ----------
    room : QRectF
        Logical pixels.
    size : (width, height)
        Of the picture in its own pixels.
    ratio : float
        Pixels of the screen to a logical pixel.

    Notes
    -----
    A picture that is too large is made smaller until it fits. One that is smaller is magnified by a whole number
    only, so that all of its pixels stay of one size; its border is on a pixel of the screen, so that they stay sharp.
    """
    width, height = max(room.width() * ratio, 1.0), max(room.height() * ratio, 1.0)
    factor = min(width / size[0], height / size[1])
    if factor >= 1:
        factor = floor(factor)
    columns, rows = size[0] * factor, size[1] * factor
    left, top = floor((width - columns) / 2), floor((height - rows) / 2)
    return QRectF(room.left() + left / ratio, room.top() + top / ratio, columns / ratio, rows / ratio)
