"""The outlines of triangles as a picture, painted once for all grids that show them at the same place."""

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from widgets.grid_geometry import HALO_OPACITY, HALO_WIDTH, GridGeometry, outline_lines
from widgets.grid_view import GridPlacement
from widgets.theme import Theme

_Place = tuple[GridPlacement, QRect, float]
"""Where the cells stand, the area of the grid, and device pixels per logical pixel."""
MOST_PICTURES = 4
"""Thumbnails side by side differ by a pixel in width; when something else is looked at, all of them do."""


class OutlineLayer:
    """Keeps the outlines of the last triangles: smooth lines are slow to paint, a picture of them is not."""

    def __init__(self) -> None:
        self._shown: tuple[GridGeometry, Theme] | None = None
        self._pictures: list[tuple[_Place, QPixmap]] = []

    def paint(
        self, painter: QPainter, placement: GridPlacement, area: QRect, geometry: GridGeometry, theme: Theme
    ) -> None:
        """Paint the triangles that are not in focus, as `paint_outlines` does."""
        if len(geometry.triangles) == len(geometry.focus_vertices) // 3:
            return
        if self._shown != (geometry, theme):
            self._shown = (geometry, theme)
            self._pictures.clear()
        place = placement, area, painter.device().devicePixelRatioF()
        picture = next((known for at, known in self._pictures if at == place), None)
        if picture is None:
            picture = self._painted(place, geometry, theme)
            if len(self._pictures) == MOST_PICTURES:
                self._pictures.clear()
            self._pictures.append((place, picture))
        painter.drawPixmap(area.topLeft(), picture)

    @staticmethod
    def _painted(place: _Place, geometry: GridGeometry, theme: Theme) -> QPixmap:
        """Return the outlines on nothing.

        Half transparent smooth lines take ten times as long as opaque ones (17 ms of 600 lines, else 1.4): the halo is
        painted opaque, and becomes transparent as a whole.
        """
        placement, area, ratio = place
        lines = outline_lines(placement, geometry)

        def painted(color: str, width: float, below: QPixmap | None) -> QPixmap:
            layer = QPixmap(area.size() * ratio)
            layer.setDevicePixelRatio(ratio)
            layer.fill(Qt.GlobalColor.transparent)
            with QPainter(layer) as inner:
                if below is not None:
                    inner.setOpacity(HALO_OPACITY)
                    inner.drawPixmap(0, 0, below)
                    inner.setOpacity(1.0)
                inner.translate(-area.topLeft())
                inner.setRenderHint(QPainter.RenderHint.Antialiasing)
                inner.setPen(QPen(QColor(color), width))
                inner.drawLines(lines)
            return layer

        return painted(theme.text, 1.0, painted(theme.halo(), HALO_WIDTH, None))
