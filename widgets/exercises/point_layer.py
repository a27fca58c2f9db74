"""Named points over a pixel grid, which are placed by clicks, drags and keys."""

from collections.abc import Sequence

from PySide6.QtCore import QLineF, QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen

from widgets.basics.theme import Theme, text_font
from widgets.grid.geometry import moved_inside, paint_chip
from widgets.grid.view import GridPlacement

Place = tuple[float, float]
REACH = 12.0
"""How near the pointer must come to a point to take it, in widget pixels."""
RADIUS = 6.0


class PointLayer:
    """The points that a form has on the picture; those without a place are not drawn."""

    def __init__(self, names: Sequence[str] = ()) -> None:
        self.names = tuple(names)
        self.places: list[Place | None] = [None] * len(self.names)
        self.marks: dict[int, bool] = {}
        """By point, whether a check has found it right."""
        self.chosen = 0
        """The point that the keys move, and that a click beside all points places."""

    def near(self, placement: GridPlacement, position: QPointF) -> int | None:
        """Return the point under a widget position, or ``None``."""
        best, reach = None, REACH
        for number, place in enumerate(self.places):
            if place is not None:
                distance = QLineF(placement.to_widget(*place), position).length()
                if distance <= reach:
                    best, reach = number, distance
        return best

    def next_free(self) -> int:
        """Return the point that a click places: the first without a place, or else the chosen one."""
        return next((number for number, place in enumerate(self.places) if place is None), self.chosen)

    def text(self, number: int) -> str:
        """Return a point and its place in words."""
        place = self.places[number]
        where = "not placed" if place is None else f"at {place[0]:.6g}, {place[1]:.6g}"
        mark = {True: ", right", False: ", wrong", None: ""}[self.marks.get(number)]
        return f"Point {self.names[number]} {where}{mark}"

    def paint(self, painter: QPainter, placement: GridPlacement, theme: Theme, *, has_focus: bool) -> None:
        """Paint every point with its name; a right one has a tick in its name, a wrong one a cross."""
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(text_font(theme))
        for number, place in enumerate(self.places):
            if place is None:
                continue
            center = placement.to_widget(*place)
            radius = RADIUS + 2 * (has_focus and number == self.chosen)
            for color, width in (("#ffffff", 5.0), ("#000000", 2.0)):
                painter.setPen(QPen(QColor(color), width))
                painter.setBrush(QColor(theme.panel))
                painter.drawEllipse(center, radius, radius)
            mark = {True: " ✓", False: " ✗", None: ""}[self.marks.get(number)]
            text = f"{self.names[number]}{mark}"
            box = _label_box(painter, text)
            box.moveBottomLeft(center + QPointF(RADIUS + 2, -RADIUS))
            paint_chip(painter, moved_inside(box, QRectF(placement.viewport)), text, theme.text, theme)
        painter.restore()


def paint_names(
    painter: QPainter, placement: GridPlacement, theme: Theme, names: Sequence[str], places: Sequence[Place]
) -> None:
    """Write names about places in the window; of a place beside the picture at its border."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setFont(text_font(theme))
    for name, place in zip(names, places, strict=True):
        box = _label_box(painter, name)
        box.moveCenter(placement.to_widget(*place))
        paint_chip(painter, moved_inside(box, QRectF(placement.viewport)), name, theme.text, theme)
    painter.restore()


def _label_box(painter: QPainter, text: str) -> QRectF:
    """Return the room of a name."""
    metrics = painter.fontMetrics()
    return QRectF(0, 0, metrics.horizontalAdvance(text) + 10, metrics.height() + 2)
