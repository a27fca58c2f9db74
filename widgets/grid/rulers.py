"""The rulers of a pixel grid: numbers of columns and rows beside it, and the pixel that is pointed at."""

from functools import reduce
from typing import NamedTuple

from PySide6.QtCore import QRect, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QRegion

from widgets.basics.theme import Theme, text_font
from widgets.grid.view import GridPlacement

_LINE_ROOM = 4.0
"""What a line along the border of the picture takes of the rulers."""


def ruler_size(rows: int, theme: Theme, part: str = "") -> tuple[int, int]:
    """Return the width of the ruler of rows and the height of the ruler of columns in logical pixels."""
    metrics = QFontMetricsF(text_font(theme, theme.small_px))
    return int(metrics.horizontalAdvance("0" * max(len(str(rows - 1)), 2) + part) + 12), int(
        metrics.height() + 6
    )


class Rulers(NamedTuple):
    """The rulers of a grid."""

    labels: list[tuple[QRectF, str]]
    """Boxes and texts of the numbers, in widget pixels."""
    beside: QRegion
    """The viewport without them, as no line may cross them: outlines that leave a small raster come upon them."""


def paint_rulers(painter: QPainter, rulers: Rulers, theme: Theme) -> None:
    """Write the numbers of the rulers."""
    painter.save()
    painter.setFont(text_font(theme, theme.small_px))
    painter.setPen(QColor(theme.muted_text))
    for box, number in rulers.labels:
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, number)
    painter.restore()


def rulers_of(placement: GridPlacement, area: QRect, theme: Theme) -> Rulers:
    """Return the column numbers below and the row numbers left of the raster, as many as have room."""
    labels = ruler_labels(placement, area, theme)
    beside = QRegion(placement.viewport)
    picture = placement.cells_rect(0, 0, placement.columns, placement.rows)
    for is_below in (True, False):
        boxes = [box for box, _ in labels if (box.top() >= picture.bottom()) is is_below]
        # One gap for a whole ruler: a line is not broken at each of its numbers.
        strip = reduce(QRectF.united, boxes, QRectF())
        if not strip.intersects(picture):
            # A line along the border of the picture keeps its width.
            border = picture.adjusted(-_LINE_ROOM, 0, 0, _LINE_ROOM)
            strip.setTop(max(strip.top(), border.bottom() if is_below else strip.top()))
            strip.setRight(min(strip.right(), strip.right() if is_below else border.left()))
            boxes = [strip]
        for box in boxes:
            beside -= QRegion(box.toAlignedRect())
    return Rulers(labels, beside)


def ruler_labels(placement: GridPlacement, area: QRect, theme: Theme) -> list[tuple[QRectF, str]]:
    """Return the boxes and texts of the rulers' numbers, in widget pixels."""
    metrics = QFontMetricsF(text_font(theme, theme.small_px))
    column0, row0, column1, row1 = placement.visible_cells()
    viewport = placement.viewport
    first_column, first_row = placement.origin
    widest = metrics.horizontalAdvance(placement.ruler_text(first_column + placement.columns - 1))
    every_column = _ruler_step(placement.cell, widest + 8)
    every_row = _ruler_step(placement.cell, metrics.height() + 2)
    labels = []
    for column in _ruler_numbers(column0, column1, first_column, every_column):
        x = placement.cells_rect(column, 0).center().x()
        if viewport.left() <= x <= viewport.right():
            labels.append(
                (_below(placement, area, x, widest + 4), placement.ruler_text(column + first_column))
            )
    column_count = len(labels)
    for row in _ruler_numbers(row0, row1, first_row, every_row):
        y = placement.cells_rect(0, row).center().y()
        if viewport.top() <= y <= viewport.bottom():
            labels.append(
                (_beside(placement, area, y, metrics.height()), placement.ruler_text(row + first_row))
            )
    if placement.has_centers:
        return labels
    # Before a number stands what is counted, where there is room: the number keeps its place.
    room = placement.left + metrics.height()  # Farther to the left may stand the label of a vertex.
    for place, (box, number) in enumerate(labels[: min(column_count, 2)]):
        titled = box.adjusted(-metrics.horizontalAdvance("column "), 0, 0, 0)
        if titled.left() >= room:
            labels[place] = titled, f"column {number}"
            break
        room = max(room, box.right() + metrics.height())
    else:
        return labels
    if len(labels) > column_count:
        box, number = labels[column_count]
        is_high = every_row * placement.cell >= 2 * metrics.height() + 2
        if is_high and metrics.horizontalAdvance("row") <= box.width():
            labels[column_count] = box.adjusted(0, -metrics.height(), 0, 0), f"row\n{number}"
    return labels


def _ruler_numbers(first: int, end: int, origin: int, step: int) -> range:
    """Return the cells from ``first`` to ``end`` whose number, counted from ``origin``, is a multiple of ``step``."""
    return range(-(-(first + origin) // step) * step - origin, end, step)


def paint_ruler_pixel(
    painter: QPainter, placement: GridPlacement, area: QRect, theme: Theme, pixel: tuple[int, int]
) -> None:
    """Write the column and row of one pixel so that they stand out on the rulers."""
    painter.save()
    font = text_font(theme, theme.small_px)
    font.setBold(True)
    painter.setFont(font)
    middle = placement.cells_rect(*pixel).center()
    metrics = QFontMetricsF(font)
    number_x, number_y = (placement.ruler_text(pixel[k] + placement.origin[k]) for k in range(2))
    below = _below(placement, area, middle.x(), metrics.horizontalAdvance(number_x) + 8)
    beside = _beside(placement, area, middle.y(), metrics.height() + 2)
    viewport = placement.viewport
    for box, number, is_shown in (
        (below.adjusted(0, 2, 0, -2), number_x, viewport.left() <= middle.x() <= viewport.right()),
        (beside.adjusted(2, 0, -2, 0), number_y, viewport.top() <= middle.y() <= viewport.bottom()),
    ):
        if is_shown:
            painter.fillRect(box, QColor(theme.text))
            painter.setPen(QColor(theme.panel))
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, number)
    painter.restore()


def ruler_areas(placement: GridPlacement, area: QRect) -> tuple[QRect, QRect]:
    """Return the parts of a widget that the rulers of columns and of rows may write into."""
    below = _below(placement, area, area.center().x(), area.width())
    beside = _beside(placement, area, area.center().y(), area.height())
    return below.toAlignedRect(), beside.toAlignedRect()


def _below(placement: GridPlacement, area: QRect, x: float, width: float) -> QRectF:
    """Return the box of a column number centred at widget ``x``: under the raster or the viewport."""
    height = area.bottom() - placement.viewport.bottom()
    top = min(placement.bottom + 1, placement.viewport.bottom() + 1)
    return QRectF(x - width / 2, top, width, height)


def _beside(placement: GridPlacement, area: QRect, y: float, height: float) -> QRectF:
    """Return the box of a row number centred at widget ``y``: left of the raster or the viewport."""
    width = placement.viewport.left() - area.left()
    left = max(placement.left - 1 - width, area.left())
    return QRectF(left, y - height / 2, width, height)


def _ruler_step(cell: float, space: float) -> int:
    """Return every how many cells a number has room: 1, 2, 5, 10, 20, 50, ..."""
    step = 1
    while True:
        for factor in (1, 2, 5):
            if step * factor * cell >= space:
                return step * factor
        step *= 10
