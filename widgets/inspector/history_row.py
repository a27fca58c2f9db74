"""How one event of a pixel's history is drawn: mark and title, three swatches with depth, the reason."""

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QPoint, QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QGuiApplication, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QListView, QStyle, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from core.explain.number_text import exact_text
from widgets.basics.marks import blended, draw_mark
from widgets.basics.theme import current_theme
from widgets.inspector.pixel_story import ENTRY_ROLE, HistoryEntry, PixelValue


class EntryDelegate(QStyledItemDelegate):
    """Draws an entry in two lines: title and three swatches with depth, then mark and reason."""

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        """Title and values, below each other where the row is narrow, and as many lines as the reason takes."""
        entry: HistoryEntry = index.data(ENTRY_ROLE)
        lines = QFontMetrics(_text_font()).height() + 10
        if any((entry.before, entry.out, entry.after)) and is_stacked(option.rect.width()):
            lines += QFontMetrics(_text_font()).height() + 2
        return QSize(200, lines + (_reason_room(option.rect, entry).height() + 3 if entry.reason else 0))

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        """Draw ground, mark, title, values and reason."""
        theme = current_theme()
        entry: HistoryEntry = index.data(ENTRY_ROLE)
        box: QRect = option.rect
        ground = QColor(theme.window if index.row() % 2 else theme.panel)
        if option.state & QStyle.StateFlag.State_Selected:
            ground = QColor(theme.selection)
        painter.save()
        painter.fillRect(box, ground)
        if option.state & QStyle.StateFlag.State_Selected:
            painter.setPen(QColor(theme.text))
            painter.drawRect(box.adjusted(0, 0, -1, -1))
        text_height = QFontMetrics(_text_font()).height()
        top = box.top() + 5
        mark_side = text_height - 2
        if entry.mark is not None:
            draw_mark(painter, entry.mark, QRectF(box.left() + 7, top + 1, mark_side, mark_side))
        cells = value_columns(box)
        title = QRect(box.left() + 12 + mark_side, top, 0, text_height)
        values_top = top
        values = entry.before, entry.out, entry.after
        if is_stacked(box.width()) or not any(values):
            title.setRight(box.right() - 4)
            values_top += text_height + 2
        else:
            title.setRight(cells[0].left() - 3)
        font = _text_font()
        painter.setFont(font)
        painter.setPen(QColor(theme.text))
        painter.drawText(title, _LEFT, QFontMetrics(font).elidedText(entry.title, _ELIDE, title.width()))
        for cell, value in zip(cells, values, strict=True):
            if value is not None:
                place = QRect(cell.left(), values_top, cell.width(), text_height)
                self._paint_value(painter, place, value)
        if entry.reason:
            room = _reason_room(box, entry)
            room.moveTopLeft(QPoint(title.left(), box.bottom() - 4 - room.height()))
            painter.setFont(_small_font())
            painter.setPen(QColor(theme.muted_text))
            painter.drawText(room, Qt.TextFlag.TextWordWrap, entry.reason)
        painter.restore()

    @staticmethod
    def _paint_value(painter: QPainter, cell: QRect, value: PixelValue) -> None:
        theme = current_theme()
        side = cell.height() - 2
        swatch = QRectF(cell.left() + 0.5, cell.top() + 1.5, side, side)
        red, green, blue, alpha = value.rgba
        solid = QColor(red, green, blue)
        painter.fillRect(swatch, solid)
        if alpha < 255:
            # The lower right half shows the colour as it lies over the ground.
            painter.save()
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(blended(solid.name(), theme.panel, alpha / 255))
            painter.drawPolygon(
                QPolygonF([swatch.topRight(), swatch.bottomRight(), QPointF(swatch.left(), swatch.bottom())])
            )
            painter.restore()
        painter.setPen(QPen(QColor(theme.outline), 1.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(swatch)
        if value.depth is not None:
            painter.setFont(_small_font())
            painter.setPen(QColor(theme.text))
            room = cell.adjusted(side + 4, 0, 0, 0)
            text = exact_text(value.depth)
            painter.drawText(room, _LEFT, QFontMetrics(_small_font()).elidedText(text, _ELIDE, room.width()))


_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_ELIDE = Qt.TextElideMode.ElideRight


def _reason_room(box: QRect, entry: HistoryEntry) -> QRect:
    """Return how much of a row's box its reason takes, wrapped."""
    width = box.width() - QFontMetrics(_text_font()).height() - 18
    metrics = QFontMetrics(_small_font())
    wrapped = metrics.boundingRect(QRect(0, 0, width, 10_000), Qt.TextFlag.TextWordWrap, entry.reason)
    return QRect(0, 0, width, wrapped.height())


def is_stacked(width: int) -> bool:
    """Return whether a row is too narrow for title and values on one line."""
    title = QFontMetrics(_text_font()).horizontalAdvance("Triangle 00")
    return width - 3 * _value_width(width) < title + 2 * QFontMetrics(_text_font()).height()


def value_columns(box: QRect) -> tuple[QRect, QRect, QRect]:
    """Return where Before, Out and After stand in a row: at the right, or across a row that is stacked."""
    width = _value_width(box.width())
    left = box.right() - 3 * width + 1
    if is_stacked(box.width()):
        left = box.left() + 12 + QFontMetrics(_text_font()).height() - 2
        width = min(width, (box.right() - left) // 3)
    cells = [QRect(left + k * width, box.top(), width - 4, box.height()) for k in range(3)]
    return cells[0], cells[1], cells[2]


def _value_width(width: int) -> int:
    # A depth in float32 needs eight digits to be told from its neighbours.
    figures = QFontMetrics(_small_font()).horizontalAdvance("0.00000000")
    least = figures + QFontMetrics(_text_font()).height() + 8
    return min(3 * least // 2, max(least, width // 5))


def _text_font() -> QFont:
    font = QFont(QGuiApplication.font())
    font.setPixelSize(current_theme().text_px)
    return font


def _small_font() -> QFont:
    font = QFont(QGuiApplication.font())
    font.setPixelSize(current_theme().small_px)
    font.setFeature(QFont.Tag("tnum"), 1)
    return font


class ValueHeader(QWidget):
    """The names over the three columns of values."""

    def __init__(self, view: QListView, parent: QWidget) -> None:
        super().__init__(parent)
        self._view = view

    def sizeHint(self) -> QSize:
        """One line of small text."""
        return QSize(200, QFontMetrics(_small_font()).height() + 6)

    def minimumSizeHint(self) -> QSize:
        """Never less than that line."""
        return self.sizeHint()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the names where the values stand."""
        painter = QPainter(self)
        painter.setFont(_small_font())
        painter.setPen(QColor(current_theme().muted_text))
        box = QRect(0, 0, self._view.viewport().width(), self.height())
        for cell, name in zip(value_columns(box), ("Before", "Out", "After"), strict=True):
            painter.drawText(cell, _LEFT, name)
        if not is_stacked(box.width()):
            painter.drawText(box.adjusted(8, 0, 0, 0), _LEFT, "Event")
