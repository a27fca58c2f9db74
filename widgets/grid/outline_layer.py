"""Triangles over a pixel grid as pictures, painted once for all grids that show them at the same place."""

from collections.abc import Callable

from PySide6.QtCore import QLineF, QRect, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap, QRegion

from widgets.basics.theme import Theme
from widgets.grid.geometry import HALO_OPACITY, HALO_WIDTH, GridGeometry, outline_lines, paint_focus
from widgets.grid.view import GridPlacement


class OutlineLayer:
    """Keeps a picture of the last triangles: smooth lines are slow to paint, a picture of them is not."""

    def __init__(self, most: int = 2) -> None:
        """Keep at most so many pictures: two for every size of grid that shows the triangles."""
        self._most = most
        self._shown: tuple[GridGeometry, Theme] | None = None
        self._pictures: list[tuple[object, QPixmap]] = []

    def paint_others(
        self, painter: QPainter, placement: GridPlacement, area: QRect, geometry: GridGeometry, theme: Theme
    ) -> None:
        """Paint the triangles that are not in focus, as `paint_outlines` does."""
        if len(geometry.triangles) > bool(geometry.focus_vertices):
            ratio = painter.device().devicePixelRatioF()

            def others() -> QPixmap:
                return _others(placement, area, ratio, geometry, theme)

            self._paint(painter, area, geometry, theme, ("others", placement, area, ratio), others)

    def paint_focus(
        self,
        painter: QPainter,
        placement: GridPlacement,
        area: QRect,
        geometry: GridGeometry,
        theme: Theme,
        held: int | None,
        free: QRegion | None,
    ) -> None:
        """Paint the triangle in focus, as the function `paint_focus` does."""
        if not geometry.focus_vertices:
            return
        ratio = painter.device().devicePixelRatioF()

        def focus() -> QPixmap:
            picture = _blank(area, ratio)
            with QPainter(picture) as inner:
                inner.translate(-area.topLeft())
                paint_focus(inner, placement, geometry, theme, held, free)
            return picture

        self._paint(painter, area, geometry, theme, ("focus", placement, area, ratio, held, free), focus)

    def _paint(
        self,
        painter: QPainter,
        area: QRect,
        geometry: GridGeometry,
        theme: Theme,
        key: object,
        make: Callable[[], QPixmap],
    ) -> None:
        """Paint the picture that is kept under a key, or another that is kept from now on."""
        if self._shown != (geometry, theme):
            self._shown = (geometry, theme)
            self._pictures.clear()
        picture = next((kept for name, kept in self._pictures if name == key), None)
        if picture is None:
            picture = make()
            del self._pictures[: len(self._pictures) + 1 - self._most]
            self._pictures.append((key, picture))
        painter.drawPixmap(area.topLeft(), picture)


def _others(
    placement: GridPlacement, area: QRect, ratio: float, geometry: GridGeometry, theme: Theme
) -> QPixmap:
    """Return the triangles that are not in focus on nothing.

    Half transparent smooth lines take ten times as long as opaque ones (17 ms for 600 lines, not 1.4): the halo is
    painted opaque, and becomes transparent as a whole.
    """
    lines = outline_lines(placement, geometry)
    halo, picture = _blank(area, ratio), _blank(area, ratio)
    _draw(halo, area, lines, QPen(QColor(theme.halo()), HALO_WIDTH))
    with QPainter(picture) as inner:
        inner.setOpacity(HALO_OPACITY)
        inner.drawPixmap(0, 0, halo)
    _draw(picture, area, lines, QPen(QColor(theme.text), 1.0))
    return picture


def _draw(picture: QPixmap, area: QRect, lines: list[QLineF], pen: QPen) -> None:
    with QPainter(picture) as inner:
        inner.translate(-area.topLeft())
        inner.setRenderHint(QPainter.RenderHint.Antialiasing)
        inner.setPen(pen)
        inner.drawLines(lines)


def _blank(area: QRect, ratio: float) -> QPixmap:
    """Return a transparent picture of an area, with so many device pixels for a logical one."""
    picture = QPixmap(area.size() * ratio)
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    return picture
