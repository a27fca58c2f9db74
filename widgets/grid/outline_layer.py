"""Triangles over a pixel grid as pictures, painted once for all grids that show them at the same place."""

from collections.abc import Callable

from PySide6.QtCore import QLineF, QRect, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap, QRegion

from widgets.basics.theme import Theme
from widgets.grid.geometry import (
    HALO_OPACITY,
    HALO_WIDTH,
    GridGeometry,
    NameBox,
    outline_lines,
    paint_focus,
)
from widgets.grid.view import GridPlacement


class OutlineLayer:
    """Keeps pictures of the last triangles: smooth lines are slow to paint, a picture of them is not."""

    def __init__(self, most: int = 2) -> None:
        """Keep at most so many pictures: two for every size of grid that shows the triangles."""
        self._most = most
        self._pictures: dict[object, tuple[object, QPixmap]] = {}
        """By what they show and where: what they were made from, and they."""

    def paint_others(
        self, painter: QPainter, placement: GridPlacement, area: QRect, geometry: GridGeometry, theme: Theme
    ) -> None:
        """Paint the outlines below the triangle in focus, as `paint_outlines` does."""
        if not geometry.outline_key:
            return

        def draw(picture: QPixmap) -> None:
            lines = outline_lines(placement, geometry)
            # Half transparent smooth lines take ten times as long as opaque ones (17 ms for 600 lines, not 1.4).
            _draw(picture, area, lines, QPen(QColor(theme.halo()), HALO_WIDTH))
            _fade(picture, HALO_OPACITY)
            _draw(picture, area, lines, QPen(QColor(theme.text), 1.0))

        self._paint(painter, area, ("others", placement), (geometry.outline_key, theme), draw)

    def paint_focus(
        self,
        painter: QPainter,
        area: QRect,
        placement: GridPlacement,
        geometry: GridGeometry,
        theme: Theme,
        held: int | None,
        free: QRegion | None,
        names: list[NameBox],
    ) -> None:
        """Paint the triangle in focus, as the function `paint_focus` does."""
        if not geometry.focus_vertices:
            return

        def draw(picture: QPixmap) -> None:
            with QPainter(picture) as inner:
                inner.translate(-area.topLeft())
                paint_focus(inner, placement, geometry, theme, held, free, names)

        self._paint(painter, area, ("focus", placement), (geometry, theme, held, free, names), draw)

    def _paint(
        self,
        painter: QPainter,
        area: QRect,
        what: tuple[str, GridPlacement],
        made_from: object,
        draw: Callable[[QPixmap], None],
    ) -> None:
        """Paint the picture that is kept for a place, drawn again where it was made from something else."""
        place = what, area, painter.device().devicePixelRatioF()
        before, picture = self._pictures.get(place, (None, None))
        if picture is None:
            for oldest in list(self._pictures)[: len(self._pictures) + 1 - self._most]:
                del self._pictures[oldest]
            picture = QPixmap(area.size() * place[2])
            picture.setDevicePixelRatio(place[2])
        if before != made_from:
            picture.fill(Qt.GlobalColor.transparent)
            draw(picture)
            self._pictures[place] = made_from, picture
        painter.drawPixmap(area.topLeft(), picture)


def _draw(picture: QPixmap, area: QRect, lines: list[QLineF], pen: QPen) -> None:
    with QPainter(picture) as inner:
        inner.translate(-area.topLeft())
        inner.setRenderHint(QPainter.RenderHint.Antialiasing)
        inner.setPen(pen)
        inner.drawLines(lines)


def _fade(picture: QPixmap, opacity: float) -> None:
    """Make a picture transparent as a whole."""
    color = QColor(Qt.GlobalColor.black)
    color.setAlphaF(opacity)
    with QPainter(picture) as inner:
        inner.setCompositionMode(QPainter.CompositionMode.CompositionMode_DestinationIn)
        inner.fillRect(picture.rect(), color)
