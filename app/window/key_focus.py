"""Which keys a control needs while it has the keyboard, so that window-wide shortcuts leave them alone."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QComboBox, QSplitterHandle, QTabBar, QWidget

_PRESS = frozenset({Qt.Key.Key_Space})
_SIDEWAYS = frozenset({Qt.Key.Key_Left, Qt.Key.Key_Right})
_UP_DOWN = frozenset({Qt.Key.Key_Up, Qt.Key.Key_Down})
KEYS: tuple[tuple[type[QWidget], frozenset[Qt.Key]], ...] = (
    (QAbstractButton, _PRESS),
    (QComboBox, _PRESS | _UP_DOWN),
    (QAbstractSpinBox, _UP_DOWN),
    (QTabBar, _SIDEWAYS),
    (QSplitterHandle, _SIDEWAYS | _UP_DOWN),
)
"""Kinds of controls and the keys, without Ctrl and Alt, that they have a use for."""


def has_use_for(widget: QWidget | None, event: QKeyEvent) -> bool:
    """Return whether a control needs a key that is pressed while it has the focus."""
    if widget is None or event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier:
        return False
    return any(isinstance(widget, kind) and event.key() in keys for kind, keys in KEYS)
