"""A pane with a drawing over its caption, which the pointer and the keyboard move and magnify."""

from math import floor

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QAccessible, QColor, QKeyEvent, QPainter, QPaintEvent, QWheelEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from widgets.basics.drawn_text import caption_height, paint_caption, paint_empty
from widgets.basics.key_claim import FocusRing, KeyClaim
from widgets.basics.theme import Theme, current_theme, theme_notifier

_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, -1),
    Qt.Key.Key_Down: (0, 1),
}
"""Columns to the right and rows down."""
_KEYS = (*_ARROWS, Qt.Key.Key_Plus, Qt.Key.Key_Equal, Qt.Key.Key_Minus, Qt.Key.Key_Home)


class MovedArea(QWidget):
    """Paints what a subclass draws, its caption and the focus ring, and tells it what wheel and keys ask for."""

    spoken_role = QAccessible.Role.Canvas

    wheel_factor = 1.2
    """How much larger a notch of the wheel, or plus, makes everything."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.empty_text = "Nothing to show yet"
        self._claim = KeyClaim(self, _KEYS)
        self._ring = FocusRing(self)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(120, 90)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        theme_notifier().theme_changed.connect(self._repaint)

    # What a subclass says about its content.

    def _drawn_caption(self) -> str | None:
        """Return what stands below the drawing; ``None``: there is no drawing."""
        raise NotImplementedError

    def _paint_drawing(self, painter: QPainter, theme: Theme) -> None:
        """Paint what is seen above the caption."""
        raise NotImplementedError

    def _go(self, across: int, down: int, is_shifted: bool) -> None:
        """Move by one arrow key, to the right and down or the other way."""
        raise NotImplementedError

    def _magnify(self, factor: float, position: QPointF | None) -> None:
        """Magnify about a position; ``None``: about the middle."""
        raise NotImplementedError

    def _go_home(self) -> None:
        """Show what is seen first."""
        raise NotImplementedError

    def _kept_caption(self) -> str:
        """Return the caption that there is room for."""
        return self._drawn_caption() or ""

    def zoom_by(self, factor: float) -> None:
        """Magnify about the middle, as the user's wish."""
        self._magnify(factor, None)

    def move_view(self, across: int, up: int) -> None:
        """Look further to one side, as the user's wish."""
        self._go(across, -up, True)

    # Events.

    def paint_to(self, painter: QPainter, is_caption: bool = False) -> None:
        """Paint what is seen, to any device of the widget's size; drawings in space are vectors in an SVG.

        ``is_caption``: only what stands below the drawing is to be seen.
        """
        theme, caption = current_theme(), self._drawn_caption()
        if caption is None:
            paint_empty(painter, self.rect(), self.empty_text, theme)
            return
        painter.fillRect(self.rect(), QColor(theme.panel))
        if not is_caption:
            self._paint_drawing(painter, theme)
        paint_caption(painter, self.rect(), caption, theme)

    def sizeHint(self) -> QSize:
        """Return the size that suits the main view."""
        return QSize(640, 480)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the drawing, its caption and the focus ring."""
        with QPainter(self) as painter:
            self.paint_to(painter, event.rect().top() >= self._room().bottom())
            self._ring.paint(painter, self.rect())

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Magnify about the pointer."""
        notches = event.angleDelta().y() / 120.0
        if notches == 0:
            event.ignore()
            return
        self._magnify(self.wheel_factor**notches, event.position())
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move or magnify by one notch, or show what is seen first."""
        key = event.key()
        if key in _ARROWS:
            self._go(*_ARROWS[Qt.Key(key)], bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier))
        elif key in (Qt.Key.Key_Plus, Qt.Key.Key_Equal, Qt.Key.Key_Minus):
            self._magnify(1 / self.wheel_factor if key == Qt.Key.Key_Minus else self.wheel_factor, None)
        elif key == Qt.Key.Key_Home:
            self._go_home()
        else:
            super().keyPressEvent(event)

    def _room(self) -> QRectF:
        """Return the part above the caption, which takes at most three fifths."""
        height = caption_height(self._kept_caption(), self.width(), current_theme())
        return QRectF(self.rect()).adjusted(0, 0, 0, -min(round(height), round(0.6 * self.height())))

    def _update_captions(self, *captions: str) -> None:
        """Paint again what stands or stood below the drawing."""
        highest = max(caption_height(caption, self.width(), current_theme()) for caption in captions)
        self.update(self.rect().adjusted(0, floor(self.height() - highest), 0, 0))

    def _repaint(self) -> None:
        """Paint again with the present theme."""
        self.update()
