"""The room of a lesson's pane: as high as it needs, and where that is too much it scrolls."""

from PySide6.QtCore import QEvent, QObject, QSize, Qt
from PySide6.QtWidgets import QFrame, QScrollArea, QSizePolicy, QWidget


class LessonScroll(QScrollArea):
    """Holds the pane; its height is that of its content at its width, where the column has so much."""

    def __init__(self, content: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        self.setWidget(content)

    def wanted_height(self) -> int:
        """Return the height at which nothing scrolls."""
        content = self.widget()
        layout = content.layout()
        if layout is None:
            return content.sizeHint().height()
        return layout.totalHeightForWidth(max(self.width(), 1))

    def sizeHint(self) -> QSize:
        """Return that height."""
        return QSize(self.widget().sizeHint().width(), self.wanted_height())

    def minimumSizeHint(self) -> QSize:
        """Return no height: the column says how much there is."""
        return QSize(0, 0)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Ask for another height when the content has changed."""
        if watched is self.widget() and event.type() == QEvent.Type.LayoutRequest:
            self.updateGeometry()
        return super().eventFilter(watched, event)
