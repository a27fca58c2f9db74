"""What a screen reader is told: what views that paint themselves are and show, and what has just happened."""

from functools import cache

from PySide6.QtCore import QObject, QTimer, Slot
from PySide6.QtGui import (
    QAccessible,
    QAccessibleAnnouncementEvent,
    QAccessibleEvent,
    QAccessibleInterface,
    QGuiApplication,
)
from PySide6.QtWidgets import QAccessibleWidget, QWidget

_HOLDERS = ("QWidget", "QScrollArea")
"""Classes of Qt that say nothing of what they hold."""
NOTICE_PLATFORMS = ("wayland", "xcb")
"""Where Orca reads the screen: before its version 45 it says notices that appear, but no announcements."""


class _View(QAccessibleWidget):
    """Describes a view when it is asked, so that what it says is never of an earlier step."""

    def text(self, kind: QAccessible.Text) -> str:
        """Return the view's own description where it has one; else what Qt knows."""
        describe = getattr(self.widget(), "spoken_description", None)
        if describe is not None and kind == QAccessible.Text.Description:
            return str(describe())
        return QAccessibleWidget.text(self, kind)


def _interface(class_name: str, owner: QObject) -> QAccessibleInterface | None:
    """Return what a screen reader sees of a widget that Qt knows nothing about; ``None``: Qt knows better.

    A widget says what it is by the class attribute ``spoken_role``; one that only holds others is a group if it has
    a name.
    """
    if not isinstance(owner, QWidget):
        return None
    role = getattr(owner, "spoken_role", None)
    if role is None and class_name in _HOLDERS and owner.accessibleName():
        role = QAccessible.Role.Grouping
    return None if role is None else _View(owner, role)


@cache
def install_roles() -> None:
    """Let screen readers know the program's own views; once in a process."""
    QAccessible.installFactory(_interface)


class _Notice(QWidget):
    """Never seen: its name is what was announced last, and to a screen reader it appears anew each time."""

    spoken_role = QAccessible.Role.Notification

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self.hide()
        self._due: list[str] = []

    def say(self, text: str) -> None:
        """Appear with this text, and with all else that is announced at once: the next one would cut it off."""
        if not self._due:
            QTimer.singleShot(0, self, self._appear)
        self._due.append(text)

    @Slot()
    def _appear(self) -> None:
        self.setAccessibleName(" ".join(self._due))
        self._due.clear()
        QAccessible.updateAccessibility(QAccessibleEvent(self, QAccessible.Event.ObjectShow))


def announce(source: QWidget, text: str, *, is_urgent: bool = False) -> None:
    """Have a screen reader say a text that has just appeared; what is urgent interrupts it."""
    if not text or not QAccessible.isActive():
        return
    if QGuiApplication.platformName() in NOTICE_PLATFORMS:
        window = source.window()
        notice = window.findChild(_Notice) or _Notice(window)
        notice.say(text)
    else:
        event = QAccessibleAnnouncementEvent(source, text)
        levels = QAccessible.AnnouncementPoliteness
        event.setPoliteness(levels.Assertive if is_urgent else levels.Polite)
        QAccessible.updateAccessibility(event)
