"""Who gets a key: a pane that Tab reached keeps the few it needs, a clicked one leaves stepping alone."""

from collections.abc import Callable, Collection

from PySide6.QtCore import QEvent, QObject, QRect, Qt
from PySide6.QtGui import QColor, QFocusEvent, QKeyEvent, QPainter, QPen
from PySide6.QtWidgets import QWidget

from widgets.basics.theme import current_theme

_NO_MOVE = (
    Qt.FocusReason.ActiveWindowFocusReason,
    Qt.FocusReason.PopupFocusReason,
    Qt.FocusReason.OtherFocusReason,
)
"""Focus that comes back, or that the program gives, as when the view that had it is put away for another."""


GIVEN_BACK = Qt.FocusReason.NoFocusReason
"""Focus that a page takes, or Escape gives back to the main view: it is seen, but the arrows go on stepping."""


def is_focus_by_keyboard(event: QFocusEvent, before: bool) -> bool:
    """Return whether the keyboard gave the focus; where the user gave none, ``before``."""
    return before if event.reason() in _NO_MOVE else event.reason() != Qt.FocusReason.MouseFocusReason


class FocusRing(QObject):
    """Tells whether a widget that paints itself shows a ring for the keyboard's focus: not after a click."""

    def __init__(self, widget: QWidget, painted: QWidget | None = None) -> None:
        """Follow the focus of a widget, and paint on ``painted`` in its stead, if that is another one."""
        super().__init__(widget)
        self._widget, self._painted = widget, painted or widget
        self._is_by_keyboard = False
        widget.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the focus; nothing is kept from the widget."""
        if isinstance(event, QFocusEvent):
            if event.type() == QEvent.Type.FocusIn:
                is_seen = event.reason() == GIVEN_BACK
                self._is_by_keyboard = is_seen or is_focus_by_keyboard(event, self._is_by_keyboard)
            self._painted.update()
        elif event.type() == QEvent.Type.MouseButtonPress and self._is_by_keyboard:
            self._is_by_keyboard = False
            self._painted.update()
        return False

    def paint(self, painter: QPainter, area: QRect) -> None:
        """Paint the ring just inside an area, if it is to be seen."""
        if self._widget.hasFocus() and self._is_by_keyboard:
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(current_theme().focus), 2))
            painter.drawRect(area.adjusted(1, 1, -1, -1))


class KeyClaim(QObject):
    """Keeps keys of a widget from window-wide shortcuts while the keyboard has brought the focus there.

    A click on a code line or a table row gives it the focus too, but the arrows must go on stepping then.
    """

    def __init__(self, widget: QWidget, keys: Collection[Qt.Key]) -> None:
        super().__init__(widget)
        self._keys = frozenset(keys)
        self._is_by_keyboard = False
        widget.installEventFilter(self)

    @property
    def is_kept(self) -> bool:
        """Whether the keys are kept while the widget has the focus."""
        return self._is_by_keyboard

    def end(self) -> bool:
        """Leave the keys to the window until the keyboard brings the focus again; return whether they were kept."""
        was_kept, self._is_by_keyboard = self._is_by_keyboard, False
        return was_kept

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Accept claimed keys, and leave every other key to the shortcuts of the window."""
        if isinstance(event, QFocusEvent) and event.type() == QEvent.Type.FocusIn:
            is_given = event.reason() == GIVEN_BACK
            self._is_by_keyboard = not is_given and is_focus_by_keyboard(event, self._is_by_keyboard)
        elif event.type() == QEvent.Type.MouseButtonPress:
            self._is_by_keyboard = False
        elif isinstance(event, QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride:
            is_plain = not event.modifiers() & ~(
                Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier
            )
            is_claimed = is_plain and self._is_by_keyboard and event.key() in self._keys
            event.setAccepted(is_claimed)
            return True
        return False


class EscapeClaim(QObject):
    """Keeps Escape of a widget from window-wide shortcuts while the widget has something to take back.

    Of several filters Qt asks the last installed first: this one is made after a `KeyClaim` of the same widget.
    """

    def __init__(self, widget: QWidget, is_needed: Callable[[], bool]) -> None:
        super().__init__(widget)
        self._is_needed = is_needed
        widget.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Accept Escape where it is needed."""
        if not isinstance(event, QKeyEvent) or event.type() != QEvent.Type.ShortcutOverride:
            return False
        if event.key() != Qt.Key.Key_Escape or not self._is_needed():
            return False
        event.accept()
        return True
