"""A pane whose space is turned, moved and magnified with the pointer or the keyboard."""

from PySide6.QtCore import QEvent, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QHideEvent, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QApplication, QWidget

from widgets.basics.key_claim import EscapeClaim
from widgets.space.moved_area import MovedArea
from widgets.space.orbit import Orbit, panned, turned, zoomed

GRAB_RADIUS = 12.0
"""How near the pointer must come to a handle to take it, in logical pixels."""
_KEY_PIXELS = 16.0
"""A key turns or moves as far as a drag of this many pixels."""


class OrbitArea(MovedArea):
    """Left drag turns, middle or Shift drag moves, the wheel magnifies, a double click shows all of it.

    With the keyboard's focus: arrows turn, Shift and arrows move, plus and minus magnify, Home shows all
    of it from where it was first seen. A subclass names handles, which a left drag takes instead, and paints.
    """

    view_changed = Signal(object)
    """The new :class:`~widgets.space.orbit.Orbit` after the user turned, moved or magnified."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._orbit = Orbit()
        self._home = Orbit()
        self._handle: int | None = None
        """The handle under the pointer or being dragged."""
        self._button = Qt.MouseButton.NoButton
        self._is_moving_space = False
        self._has_moved = False
        self._pressed_at = self._last_at = QPointF()
        self._pressed_handle: int | None = None
        """The handle at the last press."""
        self._escape = EscapeClaim(self, self._is_dragging_handle)

    def orbit(self) -> Orbit:
        """Return from where the space is seen."""
        return self._orbit

    def set_orbit(self, orbit: Orbit) -> None:
        """Look from there; emits nothing."""
        if orbit != self._orbit:
            self._orbit = orbit
            self._orbit_replaced()

    def chosen_orbit(self) -> Orbit | None:
        """Return from where the space is seen, if that is not from where it is first seen."""
        return None if self._orbit == self._home else self._orbit

    def look_from(self, orbit: Orbit | None) -> None:
        """Look from there, or from where the space is first seen, as the user's wish."""
        self._change(orbit or self._home)

    def set_home(self, home: Orbit) -> None:
        """Say what a double click and the Home key go back to; emits nothing."""
        self._home = home

    # What a subclass says about its content.

    def _handle_near(self, position: QPointF) -> int | None:
        """Return the handle that a press here would take."""
        return None

    def _handle_taken(self, handle: int) -> None:
        """Begin to drag a handle."""

    def _handle_moved(self, handle: int, from_press: QPointF) -> None:
        """Drag a handle, ``from_press`` logical pixels from where it was taken."""

    def _handle_dropped(self, handle: int, is_taken_back: bool) -> None:
        """End the drag of a handle."""

    def _clicked(self, position: QPointF) -> None:
        """Take a click that moved nothing."""

    def _orbit_at(self, position: QPointF) -> Orbit:
        """Return the orbit to magnify about a position: the present one, its target perhaps as far as what is there."""
        return self._orbit

    def _space_area(self) -> QRectF:
        """Return the part of the widget that shows the space."""
        return self._room()

    def _orbit_replaced(self) -> None:
        """Draw from another direction."""
        self.update()

    # Pointer.

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take a handle, or begin to turn or to move."""
        if self._button is not Qt.MouseButton.NoButton:
            return
        button = event.button()
        if button not in (Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton):
            return
        self._button = button
        self._pressed_at = self._last_at = event.position()
        self._has_moved = False
        is_shifted = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        self._is_moving_space = button == Qt.MouseButton.MiddleButton or is_shifted
        self._pressed_handle = self._handle_near(event.position())
        self._set_handle(None if self._is_moving_space else self._pressed_handle)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Turn, move, or drag the handle that was taken."""
        position = event.position()
        if self._button is Qt.MouseButton.NoButton:
            self._set_handle(self._handle_near(position))
            return
        delta, self._last_at = position - self._last_at, position
        if not self._has_moved:
            travelled = position - self._pressed_at
            if travelled.manhattanLength() < QApplication.startDragDistance() / 2:
                return
            self._has_moved, delta = True, travelled
            if self._handle is not None:
                self._handle_taken(self._handle)
        if self._handle is not None:
            self._handle_moved(self._handle, position - self._pressed_at)
        elif self._is_moving_space:
            self._change(panned(self._orbit, delta.x(), delta.y(), self._space_area().height()))
        else:
            self._change(turned(self._orbit, delta.x(), delta.y()))
        self._update_cursor()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End a drag; without a movement it was a click."""
        if event.button() != self._button:
            return
        had_moved = self._has_moved
        self._end_drag(is_taken_back=False)
        if not had_moved and event.button() == Qt.MouseButton.LeftButton:
            self._clicked(event.position())
        self._set_handle(self._handle_near(event.position()))

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Show the whole space again, from the present direction, unless a handle was clicked.

        The first click may have brought a handle there, by choosing a triangle: what it found counts.
        """
        if event.button() == Qt.MouseButton.LeftButton and self._pressed_handle is None:
            self.fit()

    def leaveEvent(self, event: QEvent) -> None:
        """Point at no handle."""
        if self._button is Qt.MouseButton.NoButton:
            self._set_handle(None)
        super().leaveEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:
        """End a drag that would never see its release."""
        self._end_drag(is_taken_back=False)
        super().hideEvent(event)

    # Keyboard and wheel.

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Turn, move or magnify by one notch; Escape takes the drag of a handle back."""
        if event.key() == Qt.Key.Key_Escape and self._is_dragging_handle():
            self._end_drag(is_taken_back=True)
        else:
            super().keyPressEvent(event)

    def _go(self, across: int, down: int, is_shifted: bool) -> None:
        right, below = _KEY_PIXELS * across, _KEY_PIXELS * down
        if is_shifted:
            self._change(panned(self._orbit, right, below, self._space_area().height()))
        else:
            self._change(turned(self._orbit, right, below))

    def _magnify(self, factor: float, position: QPointF | None) -> None:
        area, before, offset = self._space_area(), self._orbit, QPointF()
        if position is not None:
            before, offset = self._orbit_at(position), position - area.center()
        self._change(zoomed(before, factor, offset.x(), offset.y(), area.height()))

    def _go_home(self) -> None:
        self._change(self._home)

    def fit(self) -> None:
        """Show the whole space from the present direction, as the user's wish."""
        self._change(Orbit(self._orbit.azimuth, self._orbit.elevation, self._home.target, self._home.extent))

    def _change(self, orbit: Orbit) -> None:
        """Take over a direction that the user chose."""
        if orbit != self._orbit:
            self.set_orbit(orbit)
            self.view_changed.emit(orbit)

    def _is_dragging_handle(self) -> bool:
        return self._handle is not None and self._has_moved

    def _end_drag(self, is_taken_back: bool) -> None:
        handle, had_moved = self._handle, self._has_moved
        self._button, self._has_moved, self._is_moving_space = Qt.MouseButton.NoButton, False, False
        if handle is not None and had_moved:
            self._handle_dropped(handle, is_taken_back)
        self._update_cursor()

    def _set_handle(self, handle: int | None) -> None:
        if handle != self._handle:
            self._handle = handle
            self.update()
        self._update_cursor()

    def _update_cursor(self) -> None:
        """Show what the button does or would do here."""
        if self._handle is not None:
            self.setCursor(Qt.CursorShape.SizeAllCursor)
        elif self._has_moved:
            self.setCursor(Qt.CursorShape.ClosedHandCursor)
        else:
            self.unsetCursor()
