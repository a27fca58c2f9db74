"""A drawing in space under the pointer and the keyboard, which turn, move and magnify it."""

from math import floor

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QAccessible,
    QColor,
    QHideEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QApplication, QSizePolicy, QWidget

from core.records.arrays import is_alike
from widgets.basics.accessibility import EscapeClaim, FocusRing, KeyClaim
from widgets.basics.drawing import caption_height, paint_caption, paint_empty
from widgets.basics.theme import Theme, current_theme, theme_notifier
from widgets.space.diagram import Diagram, Projection, paint_diagram, projection_of
from widgets.space.orbit import Orbit, framed, panned, turned, zoomed

# A pane with a drawing over its caption, which the pointer and the keyboard move and magnify.


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


# A pane whose space is turned, moved and magnified with the pointer or the keyboard.


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


# A drawing in space under the pointer: turn, move and magnify.


class SpaceView(OrbitArea):
    """Shows a :class:`~widgets.space.diagram.Diagram` along parallel lines.

    The first diagram, and one that covers another part of the space, is shown as a whole until the user has
    turned or moved it.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._diagram: Diagram | None = None
        self._longest_caption = ""
        self._is_own_view = False
        """Whether the user has chosen the view."""
        self.setAccessibleName("Drawing in space")
        self.view_changed.connect(self._keep_view)

    def diagram(self) -> Diagram | None:
        """Return the drawing that is shown."""
        return self._diagram

    def show_diagram(self, diagram: Diagram | None) -> None:
        """Show a drawing; None: the empty text."""
        before, self._diagram = self._diagram, diagram
        caption = "" if diagram is None else diagram.caption
        room = self._room()
        self._longest_caption = max(self._longest_caption, caption, key=len)
        self.setAccessibleDescription(self.empty_text if diagram is None else diagram.caption)
        if diagram is None or room != self._room() or not is_alike(before, diagram, ("caption",)):
            if diagram is not None:
                self._refit()
            self.update()
        elif before is not None and caption != before.caption:
            self._update_captions(caption, before.caption)

    def fit(self) -> None:
        """Show the whole drawing from the present direction, as the user's wish."""
        if self._diagram is not None:
            area = self._space_area()
            self._change(framed(self._orbit, self._diagram.frame, area.width() / max(area.height(), 1.0)))

    def projection(self) -> Projection:
        """Return how the space is mapped to the widget."""
        return projection_of(self._orbit, self._space_area())

    def _drawn_caption(self) -> str | None:
        return None if self._diagram is None else self._diagram.caption

    def _kept_caption(self) -> str:
        # Room for the longest so far: the drawing must not move where a step's caption is shorter.
        return self._longest_caption

    def _paint_drawing(self, painter: QPainter, theme: Theme) -> None:
        if self._diagram is not None:
            area = self._space_area()
            paint_diagram(painter, self._diagram, self.projection(), area, theme)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the whole drawing in view."""
        super().resizeEvent(event)
        self._refit()

    def _refit(self) -> None:
        if self._diagram is None:
            return
        area = self._space_area()
        first = Orbit(self._diagram.azimuth, self._diagram.elevation)
        aspect = area.width() / max(area.height(), 1.0)
        home = framed(first, self._diagram.frame, aspect)
        self.set_home(home)
        if not self._is_own_view:
            self.set_orbit(home)

    def _keep_view(self, orbit: Orbit) -> None:
        """Leave a view that the user has chosen as it is."""
        self._is_own_view = orbit != self._home
