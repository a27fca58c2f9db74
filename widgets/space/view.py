"""A drawing in space under the pointer: turn, move and magnify."""

from PySide6.QtGui import QPainter, QResizeEvent
from PySide6.QtWidgets import QWidget

from core.records.alike import is_alike
from widgets.basics.theme import Theme
from widgets.space.diagram import Diagram
from widgets.space.orbit import Orbit, framed
from widgets.space.orbit_area import OrbitArea
from widgets.space.paint import Projection, paint_diagram, projection_of


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
