"""The maps of an experiment in a pane that scrolls, their axes above and the legend with them."""

from PySide6.QtCore import QRect, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QLabel, QScrollArea, QSizePolicy, QWidget

from widgets.basics.controls import ElidedLabel, FlowLayout, column_layout, row_layout
from widgets.basics.theme import current_theme, theme_notifier
from widgets.experiments.map_canvas import AtlasCanvas, paint_cell
from widgets.experiments.maps import UNKNOWN, AtlasRecord, CellKind, CellPlace


class _Scroll(QScrollArea):
    """Tells the canvas how much room there is."""

    def __init__(self, canvas: AtlasCanvas, parent: QWidget) -> None:
        super().__init__(parent)
        self._canvas = canvas
        self.setWidget(canvas)
        self.setFrameShape(QScrollArea.Shape.NoFrame)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setMinimumHeight(96)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the canvas the room that there is beside a scroll bar."""
        super().resizeEvent(event)
        self._canvas.set_room(
            self.maximumViewportSize() - QSize(self.verticalScrollBar().sizeHint().width(), 0)
        )


class _Swatch(QWidget):
    """One cell of the legend."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._kind: CellKind | None = None
        theme_notifier().theme_changed.connect(self._restyle)
        self._restyle()

    def show_kind(self, kind: CellKind | None) -> None:
        """Show a kind; ``None``: cells that have not been run."""
        self._kind = kind
        self.update()

    @Slot()
    def _restyle(self) -> None:
        side = current_theme().text_px + 5
        self.setFixedSize(side, side)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the cell."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            paint_cell(painter, QRectF(self.rect()), self._kind, current_theme())
            painter.setPen(QColor(current_theme().hidden))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5))


class AtlasLegend(QWidget):
    """What the cells mean, and how many there are of each kind."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._flow = FlowLayout(self, 16)
        self._entries: list[tuple[QWidget, _Swatch, QLabel]] = []
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self.setAccessibleName("Legend")

    def show_counts(self, record: AtlasRecord | None) -> None:
        """Show every kind that occurs, with its count; ``None``: nothing is shown."""
        rows: list[tuple[CellKind | None, str]] = []
        if record is not None:
            kinds: list[tuple[int, CellKind | None]] = [*enumerate(record.kinds), (UNKNOWN, None)]
            for number, kind in kinds:
                count = record.count(number)
                if count:
                    rows.append((kind, f"{'not run yet' if kind is None else kind.title}  {count:,}"))
        while len(self._entries) < len(rows):
            self._entries.append(self._make_entry())
        for number, (pair, swatch, label) in enumerate(self._entries):
            pair.setVisible(number < len(rows))
            if number < len(rows):
                swatch.show_kind(rows[number][0])
                label.setText(rows[number][1])
        self._flow.invalidate()
        self._keep_height()

    def texts(self) -> list[str]:
        """Return what the legend says, with the counts."""
        return [label.text() for pair, _, label in self._entries if not pair.isHidden()]

    def _make_entry(self) -> tuple[QWidget, _Swatch, QLabel]:
        pair = QWidget(self)
        row = row_layout(pair, 4)
        swatch, label = _Swatch(pair), QLabel(pair)
        row.addWidget(swatch)
        row.addWidget(label)
        self._flow.addWidget(pair)
        return pair, swatch, label

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep room for all lines."""
        super().resizeEvent(event)
        self._keep_height()

    def _keep_height(self) -> None:
        self.setMinimumHeight(self.heightForWidth(self.width()))


class AtlasView(QWidget):
    """Axes, maps and legend."""

    cell_hovered = Signal(object)
    cell_left = Signal()
    cell_chosen = Signal(object)
    cell_opened = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.canvas = AtlasCanvas()
        self.pane = _Scroll(self.canvas, self)
        self.axes = ElidedLabel(self)
        self.axes.setProperty("role", "muted")
        self.legend = AtlasLegend(self)
        self.setFocusProxy(self.canvas)
        for name in ("cell_hovered", "cell_left", "cell_chosen", "cell_opened"):
            getattr(self.canvas, name).connect(getattr(self, name))
        self.canvas.map_shown.connect(self._show_part)
        layout = column_layout(self, 4)
        layout.addWidget(self.axes)
        layout.addWidget(self.pane, 1)
        layout.addWidget(self.legend)

    def show_empty(self, text: str) -> None:
        """Show no maps and say why."""
        self.axes.hide()
        self.canvas.show_empty(text)
        self.legend.show_counts(None)

    def show_atlas(self, record: AtlasRecord) -> None:
        """Show all maps."""
        axes = [f"→ {record.across.title}{_scale(record.across.is_logarithmic)}"]
        if record.up is not None:
            axes.append(f"↑ {record.up.title}{_scale(record.up.is_logarithmic)}")
        self.axes.setText("        ".join(axes))
        self.axes.show()
        self.canvas.show_atlas(record)
        self.legend.show_counts(record)

    def show_whole(self, width: int) -> None:
        """Be as high as all maps need in this width, so that none has to be scrolled to."""
        self.canvas.set_room(QSize(width - self.pane.verticalScrollBar().sizeHint().width(), 1))
        self.pane.setFixedHeight(self.canvas.height())

    def show_chosen(self, place: CellPlace | None) -> None:
        """Mark the chosen cell."""
        self.canvas.show_chosen(place)

    @Slot(QRect)
    def _show_part(self, area: QRect) -> None:
        self.pane.ensureVisible(area.center().x(), area.center().y(), area.width(), 2 * area.height())


def _scale(is_logarithmic: bool) -> str:
    return ", logarithmic" if is_logarithmic else ""
