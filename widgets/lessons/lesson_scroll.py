"""The room of a lesson's pane: as high as its text; where that is too much, it scrolls, its buttons always in sight."""

from PySide6.QtCore import QCoreApplication, QEvent, QObject, QPoint, QSize, Qt, Signal, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QLayout, QScrollArea, QSizePolicy, QWidget


class FloatingBar(QWidget):
    """Buttons with a ``place`` among the rest of a pane; where that is out of sight, they are at the edge."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("role", "panel")
        self.place = _Place(self, parent)

    def event(self, event: QEvent) -> bool:
        """Need as much room as the buttons that are shown."""
        if event.type() == QEvent.Type.LayoutRequest:
            self.place.updateGeometry()
        return super().event(event)


class _Place(QWidget):
    """Has the height that its bar wants."""

    def __init__(self, bar: FloatingBar, parent: QWidget) -> None:
        super().__init__(parent)
        self._bar = bar
        policy = QSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)

    def sizeHint(self) -> QSize:
        """Return the least size of the bar: its height follows from its width."""
        return self._bar.minimumSizeHint()

    def heightForWidth(self, width: int) -> int:
        """Return that of the bar."""
        return self._bar.heightForWidth(width)


def _invalidate(layout: QLayout | None) -> None:
    """Forget the sizes that a layout keeps, and those in it: Qt does so when it lays out, and so keeps old ones."""
    if layout is not None:
        for index in range(layout.count()):
            item = layout.itemAt(index)
            _invalidate(None if item is None else item.layout())
        layout.invalidate()


class LessonScroll(QScrollArea):
    """Holds the pane; the column gives it the height that it wants, as far as there is so much."""

    height_changed = Signal()
    """The pane wants another height."""

    def __init__(self, content: QWidget, bar: FloatingBar, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._content, self._bar = content, bar
        self._kept: QWidget | None = None
        self.setWidget(content)
        bar.place.installEventFilter(self)
        self.verticalScrollBar().valueChanged.connect(self._float)
        self.verticalScrollBar().rangeChanged.connect(self._keep)

    def height_for(self, width: int) -> int:
        """Return the height that the content needs in a column of a width."""
        layout = self._content.layout()
        return 0 if layout is None else layout.totalHeightForWidth(width)

    def put_off(self, is_put_off: bool) -> None:
        """Lay out no part that is shown until all is known; then take all into account at once."""
        layout = self._content.layout()
        if layout is not None:
            layout.setEnabled(not is_put_off)
        if is_put_off:
            return
        _invalidate(self._bar.layout())
        # Before the pane's own, which would follow it once more.
        QCoreApplication.sendPostedEvents(self._bar, QEvent.Type.LayoutRequest.value)
        _invalidate(layout)

    def take_room(self, width: int, wanted: int, most: int) -> None:
        """Be as high as the content needs in a width, see `height_for`, and at ``most`` so high: then it scrolls."""
        # Not as Qt sees fit: where a bar makes the text higher, it would keep the bar for that.
        policies = Qt.ScrollBarPolicy
        self.setVerticalScrollBarPolicy(
            policies.ScrollBarAlwaysOff if wanted <= most else policies.ScrollBarAsNeeded
        )
        # Both at once: a text that is wrapped otherwise is laid out again.
        height = min(wanted, most)
        self.setMinimumHeight(min(height, self.height()))
        self.setMaximumHeight(max(height, self.height()))
        self.resize(width, height)
        self.setFixedHeight(height)

    @Slot()
    def _float(self) -> None:
        """Put the bar at its place, or where that is out of sight, at the edge of what is seen."""
        box = self._bar.place.geometry()
        top = self.verticalScrollBar().value()
        box.moveTop(max(min(box.y(), top + self.viewport().height() - box.height()), top))
        self._bar.setGeometry(box)
        self._bar.raise_()

    def keep_in_sight(self, widget: QWidget | None) -> None:
        """Scroll to a part of the content, now and when there is another height; ``None``: to the beginning."""
        self._kept = widget
        self._scroll()

    @Slot()
    def _keep(self) -> None:
        """Scroll on where the content has become higher: a text is wrapped after it is shown."""
        if self._kept is not None:
            self._scroll()

    def _scroll(self) -> None:
        if self._kept is None:
            self.verticalScrollBar().setValue(0)
        else:
            self.ensureWidgetVisible(self._kept)

    def ensureWidgetVisible(self, widget: QWidget, across: int = 0, around: int = 8) -> None:
        """Scroll to a part of the content, and to its beginning where not all has room; the bar must not cover it."""
        if self._bar.isAncestorOf(widget):
            return
        bar, covered = self.verticalScrollBar(), self._bar.height() + around
        top = widget.mapTo(self._content, QPoint()).y()
        bottom = top + widget.height() + around - self.viewport().height()
        is_above = top < self._bar.place.y()
        bar.setValue(max(bar.value(), bottom + covered if is_above else bottom))
        bar.setValue(min(bar.value(), top - around if is_above else top - covered))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep in sight what is to be read, and the bar."""
        super().resizeEvent(event)
        if self._kept is not None:
            self._scroll()
        self._float()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Tell that the content has changed, and follow the place of the bar."""
        done = super().eventFilter(watched, event)
        if event.type() == QEvent.Type.LayoutRequest and watched is self._content:
            self.height_changed.emit()
        elif event.type() in (QEvent.Type.Move, QEvent.Type.Resize) and watched is self._bar.place:
            self._float()
        return done
