"""The room of a lesson's pane: as high as it needs, and where that is too much it scrolls."""

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QScrollArea, QWidget


class LessonScroll(QScrollArea):
    """Holds the pane; the column gives it the height that it wants, as far as there is so much."""

    height_changed = Signal()
    """The pane wants another height."""

    def __init__(self, content: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._content = content
        self._kept: QWidget | None = None
        self.setWidget(content)

    def height_for(self, width: int) -> int:
        """Return the height that the content needs in a column of a width."""
        layout = self._content.layout()
        return 0 if layout is None else layout.totalHeightForWidth(width)

    def take_room(self, wanted: int, most: int) -> None:
        """Be as high as the content needs, see `height_for`, and at ``most`` so high: then it scrolls."""
        # Not as Qt sees fit: where a bar makes the text higher, it would keep the bar for that.
        policies = Qt.ScrollBarPolicy
        self.setVerticalScrollBarPolicy(
            policies.ScrollBarAlwaysOff if wanted <= most else policies.ScrollBarAsNeeded
        )
        self.setFixedHeight(min(wanted, most))

    def keep_in_sight(self, widget: QWidget | None) -> None:
        """Scroll to a part of the content, now and when there is another height; ``None``: to the beginning."""
        self._kept = widget
        self._scroll()

    def _scroll(self) -> None:
        if self._kept is None:
            self.verticalScrollBar().setValue(0)
        else:
            self.ensureWidgetVisible(self._kept)
            self.horizontalScrollBar().setValue(
                0
            )  # What is too wide is cut at its end, not at its beginning.

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep in sight what is to be read."""
        super().resizeEvent(event)
        if self._kept is not None:
            self._scroll()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Tell that the content has changed."""
        done = super().eventFilter(watched, event)
        if event.type() == QEvent.Type.LayoutRequest and watched is self._content:
            self.height_changed.emit()
        return done
