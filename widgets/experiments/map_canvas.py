"""The maps of an experiment under the pointer and the keyboard: one cursor for all of them."""

from dataclasses import replace
from functools import lru_cache

from PySide6.QtCore import QEvent, QPoint, QRect, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QAccessible,
    QColor,
    QFontMetrics,
    QKeyEvent,
    QMouseEvent,
    QPaintEngine,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
)
from PySide6.QtWidgets import QWidget

from widgets.basics.accessibility import FocusRing
from widgets.basics.drawing import paint_empty
from widgets.basics.theme import Theme, current_theme, text_font, theme_notifier
from widgets.experiments.maps import (
    UNKNOWN,
    AtlasLayout,
    AtlasMap,
    AtlasMetrics,
    AtlasRecord,
    CellKind,
    CellPlace,
    lay_out_maps,
)

_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}
_SMALLEST_CELL = 24
"""Pixels at text of normal size: enough to be clicked and to read the character."""


class AtlasCanvas(QWidget):
    """Paints all maps; reports which cell is pointed at, chosen and opened."""

    spoken_role = QAccessible.Role.Canvas

    cell_hovered = Signal(object)
    """A `CellPlace`."""
    cell_left = Signal()
    cell_chosen = Signal(object)
    """The cell that was clicked or gone to by a key."""
    cell_opened = Signal(object)
    """The cell that was double-clicked or entered."""
    map_shown = Signal(QRect)
    """What should be seen of the canvas: the user has gone there by a key."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._record: AtlasRecord | None = None
        self._empty = ""
        self._room = QSize()
        self._hover: CellPlace | None = None
        self._chosen: CellPlace | None = None
        self._ring = FocusRing(self)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName("Maps of outcomes")
        theme_notifier().theme_changed.connect(self._restyle)

    # Showing.

    def show_empty(self, text: str) -> None:
        """Show no maps and say why, and what to do."""
        self._record, self._empty = None, text
        self._hover = self._chosen = None
        self._fit()

    def show_atlas(self, record: AtlasRecord) -> None:
        """Show maps; the cursor stays where it was if there is such a cell."""
        self._record = record
        self._hover = self._kept(self._hover)
        self._chosen = self._kept(self._chosen)
        self._fit()

    def show_chosen(self, place: CellPlace | None) -> None:
        """Mark the chosen cell; ``None``: none is."""
        self._chosen = self._kept(place)
        self.update()

    def set_room(self, room: QSize) -> None:
        """Say how much room there is without scrolling."""
        self._room = room
        self._fit()

    @property
    def record(self) -> AtlasRecord | None:
        """What is shown."""
        return self._record

    @property
    def chosen(self) -> CellPlace | None:
        """The chosen cell."""
        return self._chosen

    def cell_area(self, place: CellPlace) -> QRect:
        """Return where a cell is painted."""
        layout = self._layout()
        if layout is None or self._record is None:
            return QRect()
        return layout.area_of(place, self._record)

    def _kept(self, place: CellPlace | None) -> CellPlace | None:
        record = self._record
        if record is None or place is None:
            return None
        is_there = place.key in {each.key for each in record.maps}
        return place if is_there and place.column < record.columns and place.row < record.rows else None

    @Slot()
    def _restyle(self) -> None:
        self._fit()

    def _fit(self) -> None:
        """Take the size that the maps need."""
        layout = self._layout()
        size = self._room if layout is None else layout.size.expandedTo(self._room)
        self.setFixedSize(size.expandedTo(QSize(1, 1)))
        self.update()

    def _layout(self) -> AtlasLayout | None:
        record = self._record
        if record is None or not record.maps:
            return None
        theme = current_theme()
        small, metrics = QFontMetrics(text_font(theme, theme.small_px)), QFontMetrics(text_font(theme))
        ticks = () if record.up is None else _ticks(record.up.texts)
        sizes = AtlasMetrics(
            metrics.height(),
            max((small.horizontalAdvance(text) for text in ticks), default=0),
            round(_SMALLEST_CELL * theme.text_px / 13),
            max(metrics.horizontalAdvance(each.title) for each in record.maps),
        )
        return lay_out_maps(
            len(record.maps), record.columns, record.rows, self._room.width(), self._room.height(), sizes
        )

    # Pointer.

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Point at the cell under the pointer."""
        self._point_at(self._place_at(event.position().toPoint()))

    def leaveEvent(self, event: QEvent) -> None:
        """Point at nothing."""
        super().leaveEvent(event)
        self._point_at(None)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Choose the cell under the pointer."""
        place = self._place_at(event.position().toPoint())
        if event.button() == Qt.MouseButton.LeftButton and place is not None:
            self._choose(place)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Open the cell under the pointer."""
        place = self._place_at(event.position().toPoint())
        if event.button() == Qt.MouseButton.LeftButton and place is not None:
            self.cell_opened.emit(place)

    def _place_at(self, point: QPoint) -> CellPlace | None:
        layout = self._layout()
        return None if layout is None or self._record is None else layout.place_at(point, self._record)

    def _point_at(self, place: CellPlace | None) -> None:
        if place == self._hover:
            return
        self._hover = place
        self.update()
        if place is None:
            self.cell_left.emit()
        else:
            self.cell_hovered.emit(place)

    def _choose(self, place: CellPlace) -> None:
        if place != self._chosen:
            self._chosen = place
            self.update()
            self.cell_chosen.emit(place)

    # Keyboard.

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go to the neighbouring cell with an arrow, open it with Enter; other keys belong to the page."""
        key = Qt.Key(event.key())
        if self._record is not None and key in _ARROWS:
            self._go(*_ARROWS[key])
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self._chosen is not None:
            self.cell_opened.emit(self._chosen)
        else:
            event.ignore()

    def focusNextPrevChild(self, is_next: bool) -> bool:
        """Go to the next map with Tab, and out of the maps after the last."""
        maps = () if self._record is None else self._record.maps
        if self._chosen is None or not self.hasFocus():
            return super().focusNextPrevChild(is_next)
        number = [each.key for each in maps].index(self._chosen.key) + (1 if is_next else -1)
        if not 0 <= number < len(maps):
            return super().focusNextPrevChild(is_next)
        self._go_to(replace(self._chosen, key=maps[number].key))
        return True

    def _go(self, across: int, up: int) -> None:
        record = self._record
        assert record is not None
        if self._chosen is None:
            self._go_to(CellPlace(record.maps[0].key, 0, 0))
            return
        column = min(max(self._chosen.column + across, 0), record.columns - 1)
        row = min(max(self._chosen.row + up, 0), record.rows - 1)
        self._go_to(replace(self._chosen, column=column, row=row))

    def _go_to(self, place: CellPlace) -> None:
        self._choose(place)
        self.map_shown.emit(self.cell_area(place))

    # Painting.

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the maps that are to be seen."""
        theme = current_theme()
        with QPainter(self) as painter:
            painter.fillRect(event.rect(), QColor(theme.panel))
            record, layout = self._record, self._layout()
            if record is None or layout is None:
                paint_empty(painter, self.rect(), self._empty, theme)
                self._ring.paint(painter, self.rect())
                return
            for each, area in zip(record.maps, layout.areas, strict=True):
                if area.adjusted(-200, -40, 400, 40).intersects(event.rect()):
                    self._paint_map(painter, record, each, area, layout.cell)
            self._paint_rings(painter, record, layout)
            self._ring.paint(painter, self.rect())

    def _paint_map(
        self, painter: QPainter, record: AtlasRecord, each: AtlasMap, area: QRect, cell: int
    ) -> None:
        theme = current_theme()
        is_vector = painter.paintEngine().type() != QPaintEngine.Type.Raster
        ratio = painter.deviceTransform().m11()
        painter.setFont(text_font(theme))
        painter.setPen(QColor(theme.text))
        metrics = QFontMetrics(painter.font())
        left = area.left()
        painter.drawText(left, area.top() - 2 - metrics.descent(), each.title)
        for row, kinds in enumerate(each.cells.tolist()):
            y = area.top() + (record.rows - 1 - row) * cell
            for column, kind in enumerate(kinds):
                look = None if kind == UNKNOWN else record.kinds[kind]
                x = left + column * cell
                if is_vector:
                    paint_cell(painter, QRectF(x, y, cell, cell), look, theme)
                else:
                    painter.drawPixmap(x, y, cell_pixmap(look, cell, theme, ratio))
        self._paint_ticks(painter, record, area)

    def _paint_ticks(self, painter: QPainter, record: AtlasRecord, area: QRect) -> None:
        """Write the first and the last value of each axis beside the cells."""
        theme = current_theme()
        painter.setFont(text_font(theme, theme.small_px))
        painter.setPen(QColor(theme.muted_text))
        metrics = QFontMetrics(painter.font())
        low, high = _ticks(record.across.texts)
        base = area.bottom() + 2 + metrics.ascent()
        painter.drawText(area.left(), base, low)
        if metrics.horizontalAdvance(low + high) + 8 <= area.width():
            painter.drawText(area.right() - metrics.horizontalAdvance(high), base, high)
        if record.up is not None:
            low, high = _ticks(record.up.texts)
            for text, y in ((high, area.top() + metrics.ascent()), (low, area.bottom() - metrics.descent())):
                painter.drawText(area.left() - 4 - metrics.horizontalAdvance(text), y, text)

    def _paint_rings(self, painter: QPainter, record: AtlasRecord, layout: AtlasLayout) -> None:
        """Mark the cell that is pointed at and the chosen one in all maps: one cursor."""
        theme = current_theme()
        for place, is_chosen in ((self._hover, False), (self._chosen, True)):
            if place is not None:
                for each in record.maps:
                    there = replace(place, key=each.key)
                    paint_ring(
                        painter, layout.area_of(there, record), theme, is_chosen and each.key == place.key
                    )


def _ticks(texts: tuple[str, ...]) -> tuple[str, str]:
    return texts[0], texts[-1]


_MARK_PART = 0.62
"""Height of the character in parts of the cell."""


@lru_cache(maxsize=256)
def cell_pixmap(kind: CellKind | None, side: int, theme: Theme, ratio: float) -> QPixmap:
    """Return one cell of ``side`` logical pixels; ``None``: a cell that has not been run."""
    pixmap = QPixmap(round(side * ratio), round(side * ratio))
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(QColor(0, 0, 0, 0))
    with QPainter(pixmap) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_cell(painter, QRectF(0, 0, side, side), kind, theme)
    return pixmap


def paint_cell(painter: QPainter, area: QRectF, kind: CellKind | None, theme: Theme) -> None:
    """Paint one cell with a pixel between it and the next one."""
    inner = area.adjusted(0.5, 0.5, -0.5, -0.5)
    if kind is None:
        painter.setPen(QPen(QColor(theme.hidden), 1.0, Qt.PenStyle.DotLine))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(inner.adjusted(0.5, 0.5, -0.5, -0.5))
        return
    painter.fillRect(inner, QColor(kind.fills[theme.is_dark]))
    painter.setFont(text_font(theme, max(round(area.height() * _MARK_PART), 7)))
    painter.setPen(QColor(kind.inks[theme.is_dark]))
    painter.drawText(area, int(Qt.AlignmentFlag.AlignCenter), kind.mark)


def paint_ring(painter: QPainter, area: QRect, theme: Theme, is_strong: bool) -> None:
    """Mark a cell: chosen (strong) or pointed at, readable on every fill."""
    outer = QRectF(area).adjusted(-1, -1, 1, 1) if is_strong else QRectF(area)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.halo()), 4.0 if is_strong else 3.0))
    painter.drawRect(outer)
    painter.setPen(QPen(QColor(theme.focus), 2.0 if is_strong else 1.0))
    painter.drawRect(outer)
