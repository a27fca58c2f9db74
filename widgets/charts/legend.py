"""The series of a crowded chart as a list: the mark and the whole name of each, linked with the marks in the chart."""

from PySide6.QtCore import QEvent, QModelIndex, QSize, Qt, Signal, Slot
from PySide6.QtGui import QIcon, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QWidget

from core.explain.number_text import number_text
from widgets.basics.theme import current_theme, theme_notifier
from widgets.charts.records import ChartMark, ChartSeries
from widgets.charts.series_marks import SeriesIcon

_ADDS = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier


class ChartLegend(QListWidget):
    """One row for each series; pointing at a row points at the series."""

    series_hovered = Signal(str)
    """Key of the series of the row under the pointer, or gone to by an arrow key."""
    series_left = Signal()
    series_chosen = Signal(str, bool)
    """Key of a row that was clicked or entered, and whether Ctrl or Shift asks for it beside another one."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._series: tuple[ChartSeries, ...] = ()
        self._strong: tuple[str, ...] = ()
        self._marks: ChartMark = {}
        self.setAccessibleName("Marks of the chart")
        self.setMouseTracking(True)
        self.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.entered.connect(self._point_at_row)
        theme_notifier().theme_changed.connect(self._refresh)

    def show_series(self, series: tuple[ChartSeries, ...], strong: tuple[str, ...] = ()) -> None:
        """Show series in their order; those of the ``strong`` keys stand out: no other beats them."""
        self._series, self._strong = series, strong
        self.clear()
        for _ in series:
            self.addItem(QListWidgetItem())
        self._refresh()

    def show_pointed(self, key: str) -> None:
        """Mark the row of a series that is pointed at elsewhere; empty: none."""
        keys = [series.key for series in self._series]
        self.blockSignals(True)
        self.setCurrentRow(keys.index(key) if key in keys else -1)
        self.blockSignals(False)

    def show_marks(self, marks: ChartMark) -> None:
        """Write the letters of the chosen series before their names."""
        self._marks = dict(marks)
        self._refresh()

    @Slot()
    def _refresh(self) -> None:
        side = current_theme().text_px
        self.setIconSize(QSize(side, side))
        for row, series in enumerate(self._series):
            item, letter = self.item(row), self._marks.get(series.key, "")
            is_strong = series.key in self._strong
            item.setText(f"{letter}: {series.title}" if letter else series.title)
            item.setToolTip(
                f"{series.title}\nPareto front: no other is better in both." if is_strong else series.title
            )
            item.setIcon(QIcon(SeriesIcon(series.number)))
            font = self.font()
            font.setBold(is_strong)
            points = zip(series.x.tolist(), series.y.tolist(), strict=True)
            values = ", ".join(f"{number_text(y, 3)} at {number_text(x, 3)}" for x, y in points)
            item.setData(Qt.ItemDataRole.AccessibleTextRole, f"{item.text()}: {values}")
            item.setFont(font)

    # Pointer and keyboard.

    @Slot(QModelIndex)
    def _point_at_row(self, index: QModelIndex) -> None:
        self.series_hovered.emit(self._series[index.row()].key)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Choose the row that is clicked."""
        super().mouseReleaseEvent(event)
        row = self.indexAt(event.position().toPoint()).row()
        if row >= 0 and event.button() == Qt.MouseButton.LeftButton:
            self.series_chosen.emit(self._series[row].key, bool(event.modifiers() & _ADDS))

    def leaveEvent(self, event: QEvent) -> None:
        """Point at nothing."""
        super().leaveEvent(event)
        self.series_left.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Point at the row that an arrow goes to; choose with Enter."""
        row = self.currentRow()
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space) and row >= 0:
            self.series_chosen.emit(self._series[row].key, bool(event.modifiers() & _ADDS))
            return
        super().keyPressEvent(event)
        if self.currentRow() != row:
            self.series_hovered.emit(self._series[self.currentRow()].key)
