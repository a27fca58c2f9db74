"""The keyboard and the screen reader: where Tab goes, who gets a key, and what a painted view is and says."""

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from functools import cache
from itertools import cycle

from PySide6.QtCore import QEvent, QObject, QRect, Qt, QTimer, Slot
from PySide6.QtGui import (
    QAccessible,
    QAccessibleAnnouncementEvent,
    QAccessibleEvent,
    QAccessibleInterface,
    QColor,
    QFocusEvent,
    QGuiApplication,
    QKeyEvent,
    QPainter,
    QPen,
)
from PySide6.QtWidgets import (
    QAbstractButton,
    QAccessibleWidget,
    QApplication,
    QScrollArea,
    QScrollBar,
    QTabBar,
    QWidget,
)

from widgets.basics.theme import current_theme

# Where Tab goes: the stops of panes in reading order, one for a row of buttons; and how borders take the
# keyboard.


_GROUP = "arrow group"
"""Property of a widget that is one of several in an `ArrowGroup`."""


class ArrowGroup(QObject):
    """Makes several buttons one stop of Tab: Left and Right, or Up and Down, go from one to the next."""

    def __init__(self, buttons: Sequence[QWidget], parent: QWidget, *, is_upright: bool = False) -> None:
        super().__init__(parent)
        keys = (Qt.Key.Key_Up, Qt.Key.Key_Down) if is_upright else (Qt.Key.Key_Left, Qt.Key.Key_Right)
        self._moves: dict[int, int] = dict(zip(keys, (-1, 1), strict=True))
        self._last: QWidget | None = None
        self.show_buttons(buttons)

    def show_buttons(self, buttons: Sequence[QWidget]) -> None:
        """Go through these buttons from now on."""
        self._buttons = list(buttons)
        for button in buttons:
            button.setProperty(_GROUP, self)
            button.installEventFilter(self)

    def stop(self) -> QWidget | None:
        """Return the button that Tab reaches: the one that had the focus last, or the first that can be pressed."""
        usable = [button for button in self._buttons if _is_usable(button)]
        return self._last if self._last in usable else next(iter(usable), None)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Move among the buttons; the arrows are theirs while the keyboard has brought the focus there."""
        if event.type() == QEvent.Type.FocusIn and isinstance(watched, QWidget):
            self._last = watched
        if not isinstance(event, QKeyEvent) or event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier:
            return False
        move = self._moves.get(event.key())
        if move is None or QApplication.mouseButtons() != Qt.MouseButton.NoButton:
            return False
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        if event.type() == QEvent.Type.KeyPress:
            usable = [button for button in self._buttons if _is_usable(button)]
            place = min(max(usable.index(watched) + move, 0), len(usable) - 1) if watched in usable else 0
            give_focus(usable[place])
            return True
        return False


def tab_stops(panes: Sequence[QWidget]) -> list[QWidget]:
    """Return what Tab reaches in panes, pane by pane and each in reading order; nothing twice."""
    return list(dict.fromkeys(stop for pane in panes for stop in _stops(pane)))


def first_stop(panes: Sequence[QWidget]) -> QWidget | None:
    """Return the first that Tab reaches in panes, without looking for the others."""
    return next((stop for pane in panes for stop in _stops(pane)), None)


def next_stop(stops: Sequence[QWidget], now: QWidget | None, *, is_forward: bool) -> QWidget | None:
    """Return the stop after the one that has the focus, or before it, round and round."""
    if not stops:
        return None
    while now is not None and now not in stops:
        now = now.parentWidget()  # a part of a stop, or of a pane that Tab does not stop at
    if now is None:
        return stops[0 if is_forward else -1]
    return stops[(stops.index(now) + (1 if is_forward else -1)) % len(stops)]


def give_focus(stop: QWidget, reason: Qt.FocusReason = Qt.FocusReason.TabFocusReason) -> None:
    """Give a stop the keyboard, and bring it into sight wherever it can be scrolled to."""
    stop.setFocus(reason)
    _bring_into_sight(stop)


def _bring_into_sight(widget: QWidget) -> None:
    for area in _scrolled_in(widget):
        area.ensureWidgetVisible(widget, 8, 8)


def _scrolled_in(widget: QWidget) -> Iterator[QScrollArea]:
    above = widget.parentWidget()
    while above is not None:
        if isinstance(above, QScrollArea):
            yield above
        above = above.parentWidget()


class KeptInSight(QObject):
    """Keeps a part of a scrolled pane in sight while the pane is laid out, until somebody scrolls."""

    def __init__(self, pane: QWidget) -> None:
        super().__init__(pane)
        self._part: QWidget | None = None
        self._bars: list[QScrollBar] = []

    def keep(self, part: QWidget | None) -> None:
        """Scroll to a part, now and whenever it gets another place; ``None``: no longer."""
        if self._part is not None:
            self._part.removeEventFilter(self)
        for bar in self._bars:
            bar.rangeChanged.disconnect(self._scroll)
            bar.actionTriggered.disconnect(self._let_go)
        self._part, self._bars = part, []
        if part is not None:
            part.installEventFilter(self)
            self._bars = [area.verticalScrollBar() for area in _scrolled_in(part)]
            for bar in self._bars:
                bar.rangeChanged.connect(self._scroll)
                bar.actionTriggered.connect(self._let_go)
            self._scroll()

    @Slot()
    def _scroll(self) -> None:
        if self._part is not None:
            _bring_into_sight(self._part)

    @Slot()
    def _let_go(self) -> None:
        self.keep(None)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Scroll again where the part is moved."""
        if event.type() in (QEvent.Type.Move, QEvent.Type.Resize, QEvent.Type.Show):
            self._scroll()
        return False


def _stops(pane: QWidget) -> Iterator[QWidget]:
    if not pane.isVisible() or not pane.width() or not pane.height():
        return
    if _is_stop(pane):
        yield pane
    if isinstance(pane, QTabBar):
        return  # its arrows do what its scroll buttons do
    for child in _in_reading_order(pane):
        yield from _stops(child)


def _is_usable(widget: QWidget) -> bool:
    has_policy = bool(widget.focusPolicy() & Qt.FocusPolicy.TabFocus)
    return has_policy and widget.isVisible() and widget.isEnabled() and widget.focusProxy() is None


def _is_stop(widget: QWidget) -> bool:
    """Return whether Tab stops here: of buttons of which one is always chosen, at that one."""
    if not _is_usable(widget):
        return False
    arrows = widget.property(_GROUP)
    if isinstance(arrows, ArrowGroup):
        return arrows.stop() is widget
    group = widget.group() if isinstance(widget, QAbstractButton) else None
    if group is not None and group.exclusive() and group.checkedButton() is not None:
        return bool(group.checkedButton() is widget)
    return True


def _in_reading_order(parent: QWidget) -> list[QWidget]:
    """Return the parts of a widget from left to right, row by row; those whose middles meet are in one row."""
    children = [child for child in parent.children() if isinstance(child, QWidget) and not child.isWindow()]
    rows: list[list[QWidget]] = []
    for child in sorted(children, key=QWidget.y):
        middle = child.geometry().center().y()
        row = rows[-1][0].geometry() if rows else None
        if row is not None and (row.top() <= middle <= row.bottom() or child.y() <= row.center().y()):
            rows[-1].append(child)
        else:
            rows.append([child])
    return [child for row in rows for child in sorted(row, key=QWidget.x)]


# Who gets a key: a pane that Tab reached keeps the few it needs, a clicked one leaves stepping alone.


_NO_MOVE = (
    Qt.FocusReason.ActiveWindowFocusReason,
    Qt.FocusReason.PopupFocusReason,
    Qt.FocusReason.OtherFocusReason,
)
"""Focus that comes back, or that the program gives, as when the view that had it is put away for another."""


GIVEN_BACK = Qt.FocusReason.ShortcutFocusReason
"""Focus that a page takes, or Escape gives back to the main view: it is seen, but the arrows go on stepping.

Not `NoFocusReason`: with it Qt sends no event, and neither ring nor screen reader would follow.
"""


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


# What a screen reader is told: what views that paint themselves are and show, and what has just happened.


_HOLDERS = ("QWidget", "QScrollArea")
"""Classes of Qt that say nothing of what they hold."""
NOTICE_PLATFORMS = ("wayland", "xcb")
"""Where Orca reads the screen: before its version 45 it says notices that appear, but no announcements."""
NOTICES = 4
"""Announcements that may be under way to it at a time."""
NOTICE_PAUSE = 150
"""Milliseconds before one appears: in a flood of other events, as of a page that opens, it would be lost."""


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
    if role is None and class_name == "QStackedWidget":
        role = QAccessible.Role.Client  # Orca says "layered pane" of it, which helps nobody.
    return None if role is None else _View(owner, role)


@cache
def install_roles() -> None:
    """Let screen readers know the program's own views; once in a process."""
    QAccessible.installFactory(_interface)


class _Notice(QWidget):
    """Never seen: its name is what was announced, and to a screen reader it appears anew each time."""

    spoken_role = QAccessible.Role.Notification


class _Notices(QObject):
    """Says what is announced in one of a few notices, in turn: a screen reader asks for a name a moment later."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        notices = [_Notice(window) for _ in range(NOTICES)]
        for notice in notices:
            notice.hide()
        self._notices = cycle(notices)
        self._due: list[str] = []

    def say(self, text: str) -> None:
        """Let a notice appear with this text, and with all else that is announced at once."""
        if not self._due:
            QTimer.singleShot(NOTICE_PAUSE, self, self._appear)
        self._due.append(text)

    @Slot()
    def _appear(self) -> None:
        notice = next(self._notices)
        notice.setAccessibleName(sentences(self._due))
        self._due.clear()
        QAccessible.updateAccessibility(QAccessibleEvent(notice, QAccessible.Event.ObjectShow))


def sentences(texts: Iterable[str]) -> str:
    """Return texts to be said one after the other, each as a sentence; empty ones are left out."""
    return " ".join(text if text[-1] in ".?!:" else f"{text}." for text in texts if text)


def announce(source: QWidget, text: str, *, is_urgent: bool = False) -> None:
    """Have a screen reader say a text that has just appeared; what is urgent interrupts it."""
    if not text or not QAccessible.isActive():
        return
    if QGuiApplication.platformName() in NOTICE_PLATFORMS:
        window = source.window()
        notices = window.findChild(_Notices) or _Notices(window)
        notices.say(text)
    else:
        event = QAccessibleAnnouncementEvent(source, text)
        levels = QAccessible.AnnouncementPoliteness
        event.setPoliteness(levels.Assertive if is_urgent else levels.Polite)
        QAccessible.updateAccessibility(event)
