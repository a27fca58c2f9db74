"""What a pixel grid paints, kept as pictures: cells repainted only where something changed, outlines shared."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QRect, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen, QPixmap, QRegion

from core.records.arrays import is_alike
from widgets.basics.image import buffer_image, value_range
from widgets.basics.theme import Theme
from widgets.grid.geometry import (
    HALO_OPACITY,
    HALO_WIDTH,
    GridGeometry,
    NameBox,
    outline_lines,
    paint_focus,
    paint_outlines,
)
from widgets.grid.layers import GridBuffer, Overlay, bounds, changed_cells, union
from widgets.grid.marks import SampleDots, paint_samples
from widgets.grid.overlay_paint import paint_above, paint_below
from widgets.grid.paint import (
    Writing,
    centres_are_free,
    number_writing,
    paint_border,
    paint_hidden,
    paint_image,
    paint_lines,
    paint_nan,
    paint_numbers,
    paint_pale_edges,
)
from widgets.grid.rulers import Rulers, paint_rulers, rulers_of
from widgets.grid.view import GridPlacement

# Triangles over a pixel grid as pictures, painted once for all grids that show them at the same place.


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


# What a pixel grid paints, kept as a picture that is repainted only where something changed.


Cells = tuple[int, int, int, int]
"""A block of cells: column0, row0, column1, row1, upper ends excluded."""
NO_CELLS: Cells = (0, 0, 0, 0)
WORDS = ("name", "unit", "title", "description", "origin")
"""What a buffer is called and where it lies: no cell looks otherwise for that."""
COMPACT_LINE_CELL = 10.0
"""Side of a cell from which a thumbnail has grid lines."""


class GridCanvas:
    """The still part of a pixel grid: cells, overlays, outlines and rulers, without marks and handles.

    Setting what is shown already changes nothing. Setters return whether a repaint is needed.
    """

    def __init__(self, is_compact: bool) -> None:
        self._is_compact = is_compact
        """A thumbnail: no rulers, no sample centres, and grid lines only where cells are clearly apart."""
        self._buffer: GridBuffer | None = None
        self._image: QImage | None = None
        self._overlays: tuple[Overlay, ...] = ()
        self._geometry: GridGeometry | None = None
        self._hidden: NDArray[np.bool_] | None = None
        self._samples: SampleDots | None = None
        self.outlines = OutlineLayer()
        """Grids that show the same triangles may share one."""
        self._pixmap: QPixmap | None = None
        self._painted: tuple[GridPlacement, QRect, Theme, Writing | None] | None = None
        # What is made again only where what it is made from differs.
        self._rulers: tuple[tuple[GridPlacement, QRect, Theme], Rulers] | None = None
        self._writing: tuple[tuple[object, ...], Writing | None] | None = None
        self._dirty: Cells | None = None
        """Cells to paint again; None: everything."""

    @property
    def buffer(self) -> GridBuffer | None:
        """The buffer that is shown."""
        return self._buffer

    @property
    def dirty(self) -> Cells | None:
        """The cells that wait to be painted again; None: everything."""
        return self._dirty

    @property
    def overlays(self) -> tuple[Overlay, ...]:
        """The overlays that are shown."""
        return self._overlays

    @property
    def hidden(self) -> NDArray[np.bool_] | None:
        """The (H, W) mask of covered cells, or None."""
        return self._hidden

    def set_buffer(self, buffer: GridBuffer | None) -> bool:
        """Show a buffer."""
        before, self._buffer = self._buffer, buffer
        if buffer is None or before is None:
            return self._forget(before is not buffer)
        if before.values.shape != buffer.values.shape:
            self._hidden = None
        if (before.values.shape, before.origin) != (buffer.values.shape, buffer.origin):
            return self._forget(True)
        if is_alike(before, buffer, WORDS):
            return False
        self._image = None
        looks = [
            (each.kind, each.values.dtype, each.known is None, value_range(each)) for each in (before, buffer)
        ]
        if looks[0] != looks[1]:
            return self._add_dirty((0, 0, buffer.columns, buffer.rows))
        with np.errstate(invalid="ignore"):
            differs = before.values != buffer.values
        if buffer.values.dtype.kind == "f":
            differs &= ~(np.isnan(before.values) & np.isnan(buffer.values))
        changed = differs.any(axis=2) if differs.ndim == 3 else differs
        if before.known is not None and buffer.known is not None:
            changed = changed | (before.known != buffer.known)
        return self._add_dirty(bounds(changed))

    def set_overlays(self, overlays: tuple[Overlay, ...]) -> bool:
        """Lay overlays over the cells, the first lowest."""
        changed = changed_cells(self._overlays, overlays)
        self._overlays = overlays
        return self._forget(True) if changed is None else self._add_dirty(changed)

    def set_geometry(self, geometry: GridGeometry | None) -> bool:
        """Show triangles; their quiet outlines belong to the still part."""
        before, self._geometry = self._geometry, geometry
        keys = [() if shown is None else shown.outline_key for shown in (before, geometry)]
        return self._forget(keys[0] != keys[1])

    def set_hidden(self, hidden: NDArray[np.bool_] | None) -> bool:
        """Cover the cells of an (H, W) mask; None covers none."""
        before, self._hidden = self._hidden, hidden
        return self._forget(not is_alike(before, hidden))

    @property
    def samples(self) -> SampleDots | None:
        """The samples that are shown, or None: one in the middle."""
        return self._samples

    def set_samples(self, samples: SampleDots | None) -> bool:
        """Show several samples in every pixel; None is the one in the middle."""
        before, self._samples = self._samples, samples
        if samples is None or before is None:
            return self._forget(before is not samples)
        if not is_alike(before.position, samples.position) or before.shown.shape != samples.shown.shape:
            return self._forget(True)
        return self._add_dirty(bounds((before.shown != samples.shown).any(axis=0)))

    def paint(self, painter: QPainter, placement: GridPlacement, area: QRect, theme: Theme) -> None:
        """Paint from the kept picture, after painting again what changed in it."""
        ratio = painter.device().devicePixelRatioF()
        key = (placement, area, theme, self.writing(placement, theme))
        if self._pixmap is None or self._painted != key or self._pixmap.devicePixelRatio() != ratio:
            size = area.size() * ratio
            if self._pixmap is None or self._pixmap.size() != size:
                self._pixmap = QPixmap(size)
            self._pixmap.setDevicePixelRatio(ratio)
            self._dirty, self._painted = None, key
        if self._dirty != NO_CELLS:
            with QPainter(self._pixmap) as inner:
                self.paint_now(inner, placement, area, theme, self._dirty, self.outlines)
            self._dirty = NO_CELLS
        painter.drawPixmap(area.topLeft(), self._pixmap)

    def paint_now(
        self,
        painter: QPainter,
        placement: GridPlacement,
        area: QRect,
        theme: Theme,
        cells: Cells | None = None,
        outlines: OutlineLayer | None = None,
    ) -> None:
        """Paint the whole still part, or only ``cells``, straight to any device (as vectors into an SVG).

        Outlines are lines of their own, unless there is a picture of them in ``outlines``.
        """
        visible = placement.visible_cells()
        painter.save()
        if cells is None:
            painter.fillRect(area, QColor(theme.panel))
            if self._is_compact:
                painter.setClipRect(placement.seen_raster)
            else:
                rulers = self.rulers(placement, area, theme)
                paint_rulers(painter, rulers, theme)
                painter.setClipRegion(rulers.beside)
        else:
            # One cell more on each side: glyphs, outlines and lines reach over the border of a cell.
            visible = (
                max(cells[0] - 1, visible[0]),
                max(cells[1] - 1, visible[1]),
                min(cells[2] + 1, visible[2]),
                min(cells[3] + 1, visible[3]),
            )
            block = placement.cells_rect(
                visible[0], visible[1], visible[2] - visible[0], visible[3] - visible[1]
            )
            painter.setClipRect(block.intersected(QRectF(placement.viewport)))
        painter.fillRect(placement.cells_rect(0, 0, placement.columns, placement.rows), QColor(theme.canvas))
        if self._buffer is not None and visible[0] < visible[2] and visible[1] < visible[3]:
            self._paint_cells(painter, placement, self._buffer, theme, visible)
            if self._hidden is not None:
                paint_hidden(painter, placement, self._hidden, theme)
            if self._geometry is not None and outlines is not None:
                outlines.paint_others(painter, placement, area, self._geometry, theme)
            elif self._geometry is not None:
                paint_outlines(painter, outline_lines(placement, self._geometry), theme)
        painter.restore()

    def _paint_cells(
        self, painter: QPainter, placement: GridPlacement, buffer: GridBuffer, theme: Theme, cells: Cells
    ) -> None:
        """Paint colours, overlays, lines and numbers, in this order."""
        image, writing = self.image(theme), self.writing(placement, theme)
        paint_image(painter, placement, image)
        paint_nan(painter, placement, buffer, theme)
        paint_below(painter, placement, self._overlays, theme)
        if not self._is_compact or placement.cell >= COMPACT_LINE_CELL:
            has_centres = buffer.has_centres and self._samples is None and not self._is_compact
            paint_lines(painter, placement, theme, has_centres and centres_are_free(writing))
            if self._samples is not None:
                paint_samples(painter, placement, self._samples, cells)
        paint_pale_edges(painter, placement, buffer, image, theme, cells)
        paint_border(painter, placement, theme)
        if writing is not None:
            paint_numbers(painter, placement, buffer, image, theme, cells, self._hidden, writing)
        paint_above(painter, placement, self._overlays, theme)

    def rulers(self, placement: GridPlacement, area: QRect, theme: Theme) -> Rulers:
        """Return the rulers of a placement in the widget's area."""
        made_from = placement, area, theme
        if self._rulers is None or self._rulers[0] != made_from:
            self._rulers = made_from, rulers_of(*made_from)
        return self._rulers[1]

    def writing(self, placement: GridPlacement, theme: Theme) -> Writing | None:
        """Return how values are written into the cells; None: they are not."""
        if self._buffer is None:
            return None
        made_from = placement, self._buffer, theme, self._samples
        if self._writing is None or self._writing[0] != made_from:
            self._writing = made_from, number_writing(*made_from)
        return self._writing[1]

    def image(self, theme: Theme) -> QImage:
        """Return the picture of the buffer, made once."""
        if self._image is None or (self._painted is not None and self._painted[2] != theme):
            if self._buffer is None:
                raise ValueError("there is no buffer to make a picture of")
            self._image = buffer_image(self._buffer, theme)
        return self._image

    def forget(self) -> None:
        """Paint everything again next time, as after a change of theme."""
        self._image = None
        self._dirty = None

    def _forget(self, changed: bool) -> bool:
        """Paint everything again if something changed."""
        if changed:
            self.forget()
        return changed

    def _add_dirty(self, cells: Cells) -> bool:
        """Paint some cells again."""
        if cells == NO_CELLS:
            return False
        if self._dirty is not None:
            self._dirty = union(self._dirty, cells)
        return True
