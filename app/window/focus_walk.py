"""The way of the keyboard through the window: Tab from stop to stop, F6 from pane to pane, Escape to the main view."""

from PySide6.QtCore import QObject, Qt, Slot
from PySide6.QtWidgets import QAbstractSpinBox, QApplication, QWidget

from app.help.pane import HelpPane
from app.window.appearance import the_application
from app.window.parts import WindowParts
from widgets.basics.accessibility import GIVEN_BACK, KeyClaim, first_stop, give_focus, next_stop, tab_stops
from widgets.basics.typed_value import NumberEdit


class FocusWalk(QObject):
    """Gives the keyboard to what comes next; nothing that is covered or folded away gets it."""

    def __init__(self, window: WindowParts, help_pane: HelpPane) -> None:
        super().__init__(window)
        self._help = help_pane
        self._last: dict[QWidget, QWidget] = {}
        """The stop that had the keyboard last in each pane."""
        self._under: dict[QWidget, QWidget] = {}
        """What had the keyboard before each overlay took it."""
        self.is_by_mouse = False
        """Whether the focus was given by a click: then the keys go on stepping."""
        the_application().focusChanged.connect(self._focus_moved)

    @property
    def window(self) -> WindowParts:
        """The window; not an attribute, since a window in a cycle would not be deleted when it is released."""
        return self.parent()  # type: ignore[return-value]

    @Slot(QWidget, QWidget)
    def _focus_moved(self, before: QWidget | None, now: QWidget | None) -> None:
        if now is not None and now.window() is self.window:
            self.is_by_mouse = QApplication.mouseButtons() != Qt.MouseButton.NoButton
            over = self._overlay(now)
            if over is not None and before is not None and self._overlay(before) is not over:
                self._under[over] = before

    def _overlay(self, widget: QWidget) -> QWidget | None:
        overlays = self.window.overlays.all()
        return next((over for over in overlays if over is widget or over.isAncestorOf(widget)), None)

    def panes(self) -> list[QWidget]:
        """Return what Tab walks through: a page of keys alone where one is open, else the main view first."""
        window = self.window
        for whole in (window.overlays.keys.editor, window.overlays.key_help):
            if whole.isVisible():
                return [whole]
        panes = [window.pages.current.first_pane(), *window.pages.current.focus_panes()]
        panes = [window.overlays.ask_bar, window.messages, *panes]
        return panes if self._help.dock is None else [*panes, self._help.dock]

    def go(self, *, is_forward: bool) -> bool:
        """Go to the next stop, or back to the one before; return whether there is one.

        Qt asks for this also when what has the keyboard is being hidden: then it goes back to what had it before an
        overlay, else to the first stop; the arrows go on as they did.
        """
        now, panes = self.window.focusWidget(), self.panes()
        if now is None or now.isVisible():
            stop, reason = (
                next_stop(tab_stops(panes), now, is_forward=is_forward),
                Qt.FocusReason.TabFocusReason,
            )
        else:
            over = self._overlay(now)
            under = None if over is None else self._under.get(over)
            if under is not None and under in tab_stops(panes):
                stop, reason = under, Qt.FocusReason.OtherFocusReason
            else:
                stop, reason = first_stop(panes), GIVEN_BACK
        if stop is not None:
            give_focus(stop, reason)
        return stop is not None

    def go_pane(self, direction: int) -> None:
        """Go to the pane after this one (1) or before it (-1): to where the keyboard was there last."""
        seen: set[QWidget] = set()
        groups: list[tuple[QWidget, list[QWidget]]] = []
        for pane in self.panes():
            own = [stop for stop in tab_stops([pane]) if stop not in seen]
            seen.update(own)
            if own:
                groups.append((pane, own))
        now = self.window.focusWidget()
        place = next((k for k, (_, own) in enumerate(groups) if now in own), -1)
        if place >= 0 and now is not None:
            self._last[groups[place][0]] = now
        if groups:
            start = place if place >= 0 or direction > 0 else 0
            pane, own = groups[(start + direction) % len(groups)]
            last = self._last.get(pane)
            give_focus(last if last in own else own[0])

    def go_home(self) -> bool:
        """Give the keyboard back to the main view and the arrows to stepping; return whether others had them."""
        own = tab_stops([self.window.pages.current.main_view()])
        now = self.window.focusWidget()
        is_field = isinstance(now, NumberEdit | QAbstractSpinBox)  # It keeps digits from the stages.
        if (self.is_by_mouse and not is_field) or not own or now is None or now is self.window:
            return False
        if now in own:
            claim = now.findChild(KeyClaim, options=Qt.FindChildOption.FindDirectChildrenOnly)
            return claim is not None and claim.end()
        give_focus(own[0], GIVEN_BACK)
        return True
