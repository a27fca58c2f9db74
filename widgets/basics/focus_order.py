"""Where Tab goes: the stops of panes in reading order, one for a row of buttons; and how borders take the keyboard."""

from collections.abc import Iterator, Sequence

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractButton, QApplication, QScrollArea, QTabBar, QWidget

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
    above = stop.parentWidget()
    while above is not None:
        if isinstance(above, QScrollArea):
            above.ensureWidgetVisible(stop, 8, 8)
        above = above.parentWidget()


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
