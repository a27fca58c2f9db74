"""How the cells of a pixel grid are painted: colour, then lines, centres, numbers as zoom grows."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QFont, QFontMetricsF, QImage, QPainter, QPen, QRegion

from core.framebuffer.display import linear_light
from widgets.basics.theme import LUMINANCE, Theme, relative_luminance, text_font
from widgets.grid.layers import NAN, CellMark, GridBuffer
from widgets.grid.marks import SampleDots, between_samples, cell_tile, has_room
from widgets.grid.overlay_paint import paint_pattern
from widgets.grid.view import GridPlacement

LINE_CELL = 6.0
"""Side of a cell in logical pixels from which grid lines are drawn."""
OUTLINED_CELL = 3.0
"""Side from which fragments that are as light or dark as the empty grid are outlined."""
LEAST_CONTRAST = 3.0
_LIGHT_OF_BYTES = linear_light(np.arange(256) / 255.0)
CENTRE_CELL = 12.0
"""Side from which sample centres are drawn."""
NUMBER_CELL = 40.0
"""Side from which values are written into the cells, if they fit."""
NUMBER_PART = 0.45
"""Size of small whole numbers relative to their cells."""
_GAP = 5.0
"""Between the sample centre and the value below it, which else would read as an i."""
TALLNESS = 0.8
"""Height of digits as a part of the size of their type, with the room that they need between dots."""
_LEAST_CHARACTERS = 6
"""Values are written only where so many digits fit."""
_SMALL_WHOLE = 100
"""Whole numbers below it are written large, over the sample centre if need be: the table is about them."""


def paint_image(painter: QPainter, placement: GridPlacement, image: QImage) -> None:
    """Paint the visible cells of the buffer's picture, each cell one plain square."""
    column0, row0, column1, row1 = placement.visible_cells()
    if column1 <= column0 or row1 <= row0:
        return
    target = placement.cells_rect(column0, row0, column1 - column0, row1 - row0)
    source = QRectF(column0, placement.rows - row1, column1 - column0, row1 - row0)
    painter.save()
    # Below one screen pixel a cell, averaging tells more than picking some cells and losing others.
    painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, placement.cell < 1)
    painter.drawImage(target, image.convertToFormat(QImage.Format.Format_ARGB32_Premultiplied), source)
    painter.restore()


def paint_lines(painter: QPainter, placement: GridPlacement, theme: Theme, has_centres: bool) -> None:
    """Paint grid lines, and with ``has_centres`` the pixels' centres, where the cells are large enough."""
    raster = placement.cells_rect(0, 0, placement.columns, placement.rows)
    shown = raster.intersected(QRectF(placement.viewport))
    cell = placement.cell
    if cell >= LINE_CELL:
        strength = min(0.25 + 0.02 * (cell - LINE_CELL), 0.6)
        ratio = painter.device().devicePixelRatioF()
        has_centre = has_centres and cell >= CENTRE_CELL
        painter.save()
        painter.setBrushOrigin(QPointF(placement.left, placement.bottom))
        painter.fillRect(shown, QBrush(cell_tile(cell, round(strength, 2), has_centre, theme, ratio)))
        painter.restore()


def paint_pale_edges(
    painter: QPainter,
    placement: GridPlacement,
    buffer: GridBuffer,
    image: QImage,
    theme: Theme,
    cells: tuple[int, int, int, int],
) -> None:
    """Draw a line between cells that have a value and empty ones of nearly the same colour: white on a light grid."""
    holds_value = buffer.known
    if buffer.kind == "color" and buffer.channels == 4:
        is_seen = buffer.values[..., 3].astype(bool)
        holds_value = is_seen if holds_value is None else is_seen & holds_value
    if holds_value is None or buffer.kind == "bool" or placement.cell < OUTLINED_CELL:
        return
    # The line at the border of a block depends on the cells on both sides of it.
    column0, row0 = max(cells[0] - 1, 0), max(cells[1] - 1, 0)
    column1, row1 = min(cells[2] + 1, buffer.columns), min(cells[3] + 1, buffer.rows)
    shown = image.copy(column0, placement.rows - row1, column1 - column0, row1 - row0)
    pixels = np.frombuffer(shown.constBits(), np.uint8).reshape(shown.height(), -1, 4)[::-1, : shown.width()]
    light = _LIGHT_OF_BYTES[pixels[..., 2::-1]] @ LUMINANCE + 0.05
    empty = relative_luminance(theme.empty) + 0.05
    known = holds_value[row0:row1, column0:column1]
    pale = known & (np.maximum(light, empty) < LEAST_CONTRAST * np.minimum(light, empty))
    if not pale.any():
        return
    lines = []
    for first, second, step in (
        ((slice(None), slice(None, -1)), (slice(None), slice(1, None)), (1, 0)),
        ((slice(None, -1), slice(None)), (slice(1, None), slice(None)), (0, 1)),
    ):
        meets = (pale[first] & ~known[second]) | (pale[second] & ~known[first])
        for row, column in np.argwhere(meets).tolist():
            rect = placement.cells_rect(column + column0 + step[0], row + row0 + step[1])
            corner = rect.topLeft() if step[0] else rect.bottomRight()
            # Whole pixels, in files as on the screen: cells may end between two.
            lines.append(QLineF(rect.bottomLeft().toPoint(), corner.toPoint()).translated(0.5, 0.5))
    painter.save()
    painter.setPen(QPen(QColor(theme.text), 1.0))
    painter.drawLines(lines)
    painter.restore()


def paint_border(painter: QPainter, placement: GridPlacement, theme: Theme) -> None:
    """Paint a thin line around the raster, so that it ends visibly whatever its colours are."""
    raster = placement.cells_rect(0, 0, placement.columns, placement.rows)
    painter.save()
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.grid_line), 1.0))
    painter.drawRect(raster.adjusted(-0.5, -0.5, 0.5, 0.5))
    painter.restore()


def paint_nan(painter: QPainter, placement: GridPlacement, buffer: GridBuffer, theme: Theme) -> None:
    """Paint a fine checker over NaN pixels."""
    has_nan = buffer.values.dtype.kind == "f" and np.isnan(buffer.values.min())
    if has_nan and placement.cell >= LINE_CELL:
        is_nan = np.isnan(buffer.values)
        is_nan = is_nan.any(axis=2) if is_nan.ndim == 3 else is_nan
        if buffer.known is not None:
            is_nan = is_nan & buffer.known
        if is_nan.any():
            paint_pattern(painter, placement, is_nan, CellMark.NAN, theme)


def _number_size(
    placement: GridPlacement, buffer: GridBuffer, theme: Theme, samples: SampleDots | None = None
) -> int | None:
    """Return the text size of the values in logical pixels, or None where cells are too small, or full of dots."""
    cell, least = placement.cell, round(0.73 * theme.small_px)
    if cell >= NUMBER_CELL and samples is None and _has_small_wholes(buffer):
        return int(min(NUMBER_PART * cell, 2 * theme.text_px))
    room = (cell - 6) / (1.25 * buffer.channels)
    if cell < NUMBER_CELL or room < least + (buffer.channels > 1):
        return None
    size = max(int(min(cell / 5.2, room, theme.text_px)), least)
    if samples is not None and has_room(placement, samples):
        _, free = between_samples(placement, samples)
        size = min(size, int(free / (TALLNESS * buffer.channels)))
        if size < least:
            return None
    return size if _characters(cell, size, theme) >= _LEAST_CHARACTERS else None


def _has_small_wholes(buffer: GridBuffer) -> bool:
    """Return whether a buffer is a table of whole numbers of two digits: counts, or also beyond 0 and 1."""
    if buffer.kind != "scalar":
        return False
    is_count = buffer.values.dtype.kind in "iu"
    values = buffer.values[~np.isnan(buffer.values)]
    finite = values[np.isfinite(values)]
    is_small = (finite == np.rint(finite)).all() and (np.abs(finite) < _SMALL_WHOLE).all()
    return bool(is_small and (is_count or len(finite) < len(values) or (finite > 1).any()))


def _characters(cell: float, size: int, theme: Theme) -> int:
    """Return how many digits of a text size fit side by side into a cell."""
    return int((cell - 5) / QFontMetricsF(text_font(theme, size)).horizontalAdvance("0"))


class Writing(NamedTuple):
    """How values are written into cells."""

    font: QFont
    height: float
    """Of a line."""
    width: int
    """Most characters."""
    top: float
    """Where the first line begins below the middle of a cell."""


def paint_numbers(
    painter: QPainter,
    placement: GridPlacement,
    buffer: GridBuffer,
    image: QImage,
    theme: Theme,
    cells: tuple[int, int, int, int],
    hidden: NDArray[np.bool_] | None,
    writing: Writing,
) -> None:
    """Write values into cells (column0, row0, column1, row1), in black or white, whichever is seen better."""
    font, height, width, top = writing
    dark, light = QColor("#000000"), QColor("#ffffff")
    painter.save()
    painter.setFont(font)
    flags = Qt.AlignmentFlag.AlignCenter
    for row in range(cells[1], cells[3]):
        for column in range(cells[0], cells[2]):
            if (hidden is not None and hidden[row, column]) or not buffer.is_known(column, row):
                continue
            if buffer.is_cleared(column, row):
                continue  # four zeros in every cell would hide what is drawn over them
            color = image.pixel(column, placement.rows - 1 - row)
            painter.setPen(dark if _is_light(color, theme.canvas) else light)
            rect = placement.cells_rect(column, row)
            lines = buffer.lines_at(column, row, 4, width)
            first = rect.center().y() + top
            if NAN in lines:
                chip = QRectF(0, first - 1, placement.cell * 0.8, height * len(lines) + 2)
                chip.moveLeft(rect.center().x() - chip.width() / 2)
                painter.fillRect(chip, QColor(theme.nan_light))
                painter.setPen(dark)
            for index, line in enumerate(lines):
                box = QRectF(rect.left(), first + index * height, rect.width(), height)
                painter.drawText(box, flags, line)
    painter.restore()


def number_writing(
    placement: GridPlacement, buffer: GridBuffer, theme: Theme, samples: SampleDots | None = None
) -> Writing | None:
    """Return how values are written into the cells at this zoom; None: they are not.

    They stand below the sample centre if there is room, or between samples, so that both can be read.
    """
    size = None if buffer.kind == "bool" else _number_size(placement, buffer, theme, samples)
    if size is None:
        return None
    font = text_font(theme, size)
    height = QFontMetricsF(font).height() * 0.95
    top = -height * buffer.channels / 2
    if samples is not None and has_room(placement, samples):
        top += between_samples(placement, samples)[0]
    elif placement.cell / 2 - _GAP - 3 >= height * buffer.channels:
        top = _GAP
    return Writing(font, height, _characters(placement.cell, size, theme), top)


def centres_are_free(writing: Writing | None) -> bool:
    """Return whether no number is written over the sample centres."""
    return writing is None or writing.top == _GAP


def number_boxes(
    placement: GridPlacement, buffer: GridBuffer, writing: Writing, cells: set[tuple[int, int]]
) -> QRegion:
    """Return what the values written into some cells (column, row) take, which no line may cross."""
    region = QRegion()
    font, height, width, top = writing
    digit = QFontMetricsF(font).horizontalAdvance("0")
    for column, row in cells:
        if buffer.is_known(column, row) and not buffer.is_cleared(column, row):
            lines = buffer.lines_at(column, row, 4, width)
            across = max(len(line) for line in lines) * digit
            middle = placement.cells_rect(column, row).center()
            box = QRectF(middle.x() - across / 2, middle.y() + top, across, height * len(lines))
            region += QRegion(box.toAlignedRect())
    return region


def is_on_numbers(placement: GridPlacement, writing: Writing, line_count: int, box: QRectF) -> bool:
    """Return whether a box reaches into where the cells below it write their values, of so many lines each."""
    (left, top), (right, bottom) = map(placement.to_window, (box.topLeft(), box.bottomRight()))
    if max(left, 0.0) >= min(right, placement.columns):
        return False
    for row in range(max(int(bottom), 0), min(int(top) + 1, placement.rows)):
        first = placement.cells_rect(0, row).center().y() + writing.top
        if box.top() < first + line_count * writing.height and first < box.bottom():
            return True
    return False


@lru_cache(maxsize=1024)
def _is_light(color: int, backdrop: str) -> bool:
    """Return whether black text is seen better than white on a colour, as of `QRgb`, that lies on a backdrop."""
    top, below = QColor.fromRgba(color), QColor(backdrop)
    mixed = (
        top.alphaF() * upper + (1 - top.alphaF()) * lower
        for upper, lower in zip(top.getRgbF()[:3], below.getRgbF()[:3], strict=True)  # type: ignore[index]
    )
    red, green, blue = (channel**2.2 for channel in mixed)
    return bool(0.2126 * red + 0.7152 * green + 0.0722 * blue > 0.18)


def paint_hidden(
    painter: QPainter, placement: GridPlacement, hidden: NDArray[np.bool_], theme: Theme
) -> None:
    """Cover the cells of an (H, W) mask; a question mark says that something is to be found out there."""
    column0, row0, column1, row1 = placement.visible_cells()
    rows, columns = np.nonzero(hidden[row0:row1, column0:column1])
    cell = placement.cell
    painter.save()
    painter.setFont(text_font(theme, int(min(max(cell * 0.5, 9), 2 * theme.text_px))))
    line = QColor(theme.grid_line)
    rects = [
        placement.cells_rect(column + column0, row + row0)
        for row, column in zip(rows.tolist(), columns.tolist(), strict=True)
    ]
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(theme.hidden))
    painter.drawRects(rects)
    if cell >= LINE_CELL:
        # Lines of its own: through those of the grid the colour below them would be seen.
        for rect in rects:
            painter.fillRect(QRectF(rect.left(), rect.top(), 1.0, rect.height()), line)
            painter.fillRect(QRectF(rect.left(), rect.bottom() - 1.0, rect.width(), 1.0), line)
    if cell >= 14:
        painter.setPen(QColor(theme.text))
        for rect in rects:
            painter.drawText(rect, Qt.AlignmentFlag.AlignCenter, "?")
    painter.restore()
