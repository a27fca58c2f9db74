"""What a pixel grid shows, without the pointer: a buffer, overlays, triangles and marks."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRect, QRectF, QSize, Qt
from PySide6.QtGui import QAccessible, QColor, QPainter, QPaintEvent, QRegion
from PySide6.QtWidgets import QSizePolicy, QWidget

from core.records.arrays import is_alike
from widgets.basics.accessibility import FocusRing
from widgets.basics.theme import current_theme, theme_notifier
from widgets.grid.canvas import GridCanvas, OutlineLayer
from widgets.grid.geometry import GridGeometry, NameBox, paint_chip, paint_focus, vertex_place
from widgets.grid.layers import NO_VALUE, CenterOverlay, GridBuffer, Overlay
from widgets.grid.marks import SampleDots, StepMark, marked_rect, paint_hover, paint_pin, paint_step_mark
from widgets.grid.names import name_boxes
from widgets.grid.paint import is_on_numbers, number_boxes
from widgets.grid.rulers import paint_ruler_pixel, ruler_areas, ruler_size
from widgets.grid.view import FIT, GridPlacement, GridView, clamped, place


class GridDisplay(QWidget):
    """The showing half of a :class:`~widgets.grid.pixel_grid.PixelGrid`; slots paint only what changed."""

    spoken_role = QAccessible.Role.Canvas

    def __init__(self, parent: QWidget | None = None, compact: bool = False) -> None:
        """Make an empty grid; a ``compact`` one is a thumbnail without rulers, handles and keyboard focus."""
        super().__init__(parent)
        self._compact = compact
        self._canvas = GridCanvas(is_compact=compact)
        self._geometry: GridGeometry | None = None
        self._view = FIT
        self._corner = 0.0
        # What is made again only where what it is made from differs.
        self._placed: tuple[tuple[object, ...], GridPlacement] | None = None
        self._names: tuple[tuple[object, ...], list[NameBox]] | None = None
        self._hover: tuple[int, int] | None = None
        self._pin: tuple[int, int] | None = None
        self._step = StepMark()
        self._ring = FocusRing(self)
        self._vertex: int | None = None
        """The vertex under the pointer or being dragged."""
        self.empty_text = "Nothing to show yet"
        """What the grid says while it has no buffer."""
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus if compact else Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName("Pixel grid")
        theme_notifier().theme_changed.connect(self._repaint_all)

    def buffer(self) -> GridBuffer | None:
        """Return the buffer that is shown."""
        return self._canvas.buffer

    def view(self) -> GridView:
        """Return the zoom and pan."""
        return self._view

    def overlays(self) -> tuple[Overlay, ...]:
        """Return the overlays over the cells, the first lowest."""
        return self._canvas.overlays

    def hidden(self) -> NDArray[np.bool_] | None:
        """Return the (H, W) mask of the cells that are covered up; None: none."""
        return self._canvas.hidden

    def pin(self) -> tuple[int, int] | None:
        """Return the pinned pixel."""
        return self._pin

    def step(self) -> StepMark:
        """Return the mark of the step just done."""
        return self._step

    def placement(self) -> GridPlacement:
        """Return where the cells stand in the widget now."""
        buffer = self._canvas.buffer
        columns, rows = (buffer.columns, buffer.rows) if buffer else (1, 1)
        origin = buffer.origin if buffer else (0, 0)
        ratio = self.devicePixelRatioF()
        has_centers = any(isinstance(overlay, CenterOverlay) for overlay in self._canvas.overlays)
        look = (self._view, self._corner, ratio, has_centers, current_theme())
        made_from = (columns, rows, origin, self.size(), look)
        if self._placed is None or self._placed[0] != made_from:
            viewport = self._viewport(rows + origin[1], has_centers)
            placed = place(columns, rows, viewport, self._view, ratio, self._corner)
            self._placed = made_from, replace(placed, origin=origin, has_centers=has_centers)
        return self._placed[1]

    def show_buffer(self, buffer: GridBuffer | None) -> None:
        """Show a buffer; only pixels that differ are painted again."""
        before = self._canvas.buffer
        changed = self._canvas.set_buffer(buffer)
        if buffer is not None and (before is None or before.label != buffer.label):
            self.setAccessibleName(f"Pixel grid: {buffer.label}")
        if changed:
            self._update_dirty()

    def show_overlays(self, overlays: tuple[Overlay, ...] | list[Overlay]) -> None:
        """Lay overlays over the cells, the first lowest."""
        if self._canvas.set_overlays(tuple(overlays)):
            self._update_dirty()

    def show_geometry(self, geometry: GridGeometry | None) -> None:
        """Show triangles in window coordinates."""
        if geometry is not self._geometry:
            self._geometry = geometry
            self._canvas.set_geometry(geometry)
            self.update()

    def share_outlines(self, outlines: OutlineLayer) -> None:
        """Take the triangles from pictures that other grids use too."""
        self._canvas.outlines = outlines

    def show_hover(self, pixel: tuple[int, int] | None) -> None:
        """Mark (column, row) as the pixel under the pointer."""
        if pixel != self._hover:
            before, self._hover = self._hover, pixel
            self._update_marks(before, pixel)

    def show_pin(self, pixel: tuple[int, int] | None) -> None:
        """Mark (column, row) as the pinned pixel."""
        if pixel != self._pin:
            before, self._pin = self._pin, pixel
            self._update_marks(before, pixel)

    def show_step(self, mark: StepMark) -> None:
        """Mark what the step just done was about."""
        before, self._step = self._step, mark
        if not is_alike(before, mark):
            placement = self.placement()
            for each in (before, mark):
                self.update(self._with_room(each.reach(placement)))

    def show_hidden(self, hidden: NDArray[np.bool_] | None) -> None:
        """Cover the cells of an (H, W) mask until they have been predicted; None covers none."""
        buffer = self._canvas.buffer
        if hidden is not None and (buffer is None or hidden.shape != (buffer.rows, buffer.columns)):
            raise ValueError(f"hidden must have the shape of the buffer's pixels, got {hidden.shape}")
        if self._canvas.set_hidden(hidden):
            self.update()

    def show_samples(self, samples: SampleDots | None) -> None:
        """Show several samples in every pixel, and who has them; None: the one in the middle."""
        if self._canvas.set_samples(samples):
            self._update_dirty()

    def set_pixel_center(self, name: str) -> None:
        """Say where centres lie: "half" at (i + 0.5, j + 0.5), "integer" at (i, j)."""
        corners = {"half": 0.0, "integer": -0.5}
        if name not in corners:
            raise ValueError(f"pixel center must be half or integer, got {name!r}")
        if corners[name] != self._corner:
            self._corner = corners[name]
            self.update()

    def set_view(self, view: GridView) -> None:
        """Zoom and pan as a linked grid did; emits nothing."""
        view = clamped(view)
        if view != self._view:
            self._view = view
            self.update()

    def has_numbers(self) -> bool:
        """Return whether the values are written into the cells at this zoom."""
        buffer = self._canvas.buffer
        return buffer is not None and bool(self._canvas.writing(self.placement(), current_theme()))

    def samples_text(self, pixel: tuple[int, int]) -> str:
        """Return who has the samples of a pixel as text; empty: it has one sample, or is covered up."""
        samples = self._canvas.samples
        column, row = pixel
        if samples is None or self._is_hidden(pixel):
            return ""
        _, rows, columns = samples.shown.shape
        return samples.text_at(column, row) if column < columns and row < rows else ""

    def value_text(self, pixel: tuple[int, int], digits: int = 4) -> str:
        """Return the value of a pixel as text: "?" where it is covered, empty outside the raster."""
        buffer = self._canvas.buffer
        if buffer is None or not self._is_inside(pixel):
            return ""
        return "?" if self._is_hidden(pixel) else buffer.text_at(*pixel, digits)

    def spoken_description(self) -> str:
        """Return what a screen reader says of the pixels that are pinned and pointed at."""
        marked = (("Pinned pixel", self._pin), ("Pixel under the pointer", self._hover))
        texts = ((what, at, self.value_text(at)) for what, at in marked if at is not None)
        return "; ".join(
            f"{what} {x}, {y}: {'no value' if text == NO_VALUE else text}" for what, (x, y), text in texts
        )

    def paint_to(self, painter: QPainter) -> None:
        """Paint the grid as it is seen, but as vectors, for an SVG or PDF of the widget's size."""
        theme, placement = current_theme(), self.placement()
        if self._canvas.buffer is not None:
            self._canvas.paint_now(painter, placement, self.rect(), theme)
            self._paint_marks(painter, placement)

    def sizeHint(self) -> QSize:
        """Return the size that suits a grid: a thumbnail or the main view."""
        return QSize(192, 144) if self._compact else QSize(640, 480)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the kept picture, then marks, handles and the focus ring."""
        theme = current_theme()
        with QPainter(self) as painter:
            if self._canvas.buffer is None:
                painter.fillRect(self.rect(), QColor(theme.panel))
                painter.setPen(QColor(theme.muted_text))
                flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
                painter.drawText(self.rect().adjusted(8, 8, -8, -8), flags, self.empty_text)
            else:
                placement = self.placement()
                self._canvas.paint(painter, placement, self.rect(), theme)
                self._paint_marks(painter, placement)
            painter.setClipping(False)
            self._ring.paint(painter, self.rect())

    def _paint_marks(self, painter: QPainter, placement: GridPlacement) -> None:
        """Paint what changes at every move: triangle, step, pin, hover, and the rulers' numbers."""
        theme = current_theme()
        painter.save()
        if self._geometry is not None:
            self._paint_geometry(painter, placement, self._geometry)
        painter.setClipRect(placement.seen_raster if self._compact else placement.viewport)
        paint_step_mark(painter, placement, self._step, theme, self._written(placement))
        if self._pin is not None and self._is_inside(self._pin):
            self._paint_pin(painter, placement, self._pin)
        if self._hover is not None and self._is_inside(self._hover):
            paint_hover(painter, placement, self._hover)
        painter.restore()
        if self._hover is not None and not self._compact and self._is_inside(self._hover):
            paint_ruler_pixel(painter, placement, self.rect(), theme, self._hover)

    def _paint_pin(self, painter: QPainter, placement: GridPlacement, pixel: tuple[int, int]) -> None:
        """Mark the pinned pixel, beside names."""
        painter.save()
        free = QRegion(painter.clipRegion())
        for box, _, _ in self.names():
            free -= box.toAlignedRect()
        painter.setClipRegion(free)
        paint_pin(painter, placement, pixel)
        self._paint_pinned_value(painter, placement, pixel)
        painter.restore()

    def _paint_pinned_value(
        self, painter: QPainter, placement: GridPlacement, pixel: tuple[int, int]
    ) -> None:
        """Write the pinned pixel's value over a vertex that hides it, unless that is held."""
        geometry, buffer, theme = self._geometry, self._canvas.buffer, current_theme()
        writing = self._canvas.writing(placement, theme)
        if geometry is None or buffer is None or writing is None or self._compact or self._is_hidden(pixel):
            return
        box = QRectF(number_boxes(placement, buffer, writing, {pixel}).boundingRect())
        others = (vertex for vertex in geometry.focus_vertices if vertex != self._vertex)
        places = (vertex_place(geometry, placement, vertex) for vertex in others)
        if not box.isEmpty() and any(place is not None and box.contains(place) for place in places):
            painter.setFont(writing.font)
            text = "\n".join(buffer.lines_at(*pixel, 4, writing.width))
            paint_chip(painter, box.adjusted(-3, 0, 3, 0), text, theme.text, theme)

    def _paint_geometry(self, painter: QPainter, placement: GridPlacement, geometry: GridGeometry) -> None:
        """Paint the triangle in focus, on the screen from a kept picture: smooth lines are slow to draw."""
        theme = current_theme()
        # Outlines may go beside the numbers of the rulers; a thumbnail has neither these nor names.
        free = None if self._compact else self._canvas.rulers(placement, self.rect(), theme).beside
        shown = placement, geometry, theme, self._vertex, free, self.names()
        if painter.device() is self:
            self._canvas.outlines.paint_focus(painter, self.rect(), *shown)
        else:
            paint_focus(painter, *shown)

    def names(self) -> list[NameBox]:
        """Return the names of the vertices and edges of the triangle in focus, and where they are written."""
        placement, theme = self.placement(), current_theme()
        if self._compact or self._geometry is None:
            return []
        made_from = placement, self._geometry, theme, self._canvas.writing(placement, theme)
        if self._names is None or self._names[0] != made_from:
            self._names = made_from, name_boxes(placement, self._geometry, theme, self._unwritten(placement))
        return self._names[1]

    def _unwritten(self, placement: GridPlacement) -> Callable[[QRectF], bool]:
        """Return what says whether neither a cell nor a ruler writes a number into a box."""
        theme, buffer = current_theme(), self._canvas.buffer
        writing = self._canvas.writing(placement, theme)
        beside = self._canvas.rulers(placement, self.rect(), theme).beside

        def is_unwritten(box: QRectF) -> bool:
            is_beside = QRegion(box.toAlignedRect()).subtracted(beside).isEmpty()
            if not is_beside or buffer is None or writing is None:
                return is_beside
            return not is_on_numbers(placement, writing, buffer.channels, box)

        return is_unwritten

    def _written(self, placement: GridPlacement) -> QRegion:
        """Return what names and the numbers below the step's mark take."""
        region, buffer = QRegion(), self._canvas.buffer
        if self._compact or buffer is None:
            return region
        for box, _, _ in self.names():
            region += box.toAlignedRect()
        writing = self._canvas.writing(placement, current_theme())
        if writing is not None:
            cells = {
                cell for cell in self._step.crossed if self._is_inside(cell) and not self._is_hidden(cell)
            }
            region += number_boxes(placement, buffer, writing, cells)
        return region

    def _update_dirty(self) -> None:
        """Have the cells painted that changed."""
        cells = self._canvas.dirty
        if cells is None:
            self.update()
        else:
            placement = self.placement()
            self._update_rect(
                placement.cells_rect(cells[0], cells[1], cells[2] - cells[0], cells[3] - cells[1])
            )

    def _update_marks(self, before: tuple[int, int] | None, after: tuple[int, int] | None) -> None:
        """Have the places painted where a mark was and is, and the numbers of the rulers."""
        placement = self.placement()
        for pixel in (before, after):
            if pixel is not None:
                self._update_rect(marked_rect(placement, pixel))
        if not self._compact:
            for area in ruler_areas(placement, self.rect()):
                self.update(area)

    def _update_rect(self, rect: QRectF) -> None:
        """Have a part painted, with the room that marks take around it.

        Where the step's mark reaches into it, all of the mark is: Qt draws a part of a smooth line otherwise than the
        whole line.
        """
        area, mark = self._with_room(rect), self._with_room(self._step.reach(self.placement()))
        self.update(area)
        if area.intersects(mark):
            self.update(mark)

    def _with_room(self, rect: QRectF) -> QRect:
        """Return the part of the widget in which something in a rectangle is drawn; of none, none."""
        room = 10
        grown = QRectF() if rect.isNull() else rect.adjusted(-room, -room, room, room)
        return grown.toAlignedRect().intersected(self.rect())

    def _viewport(self, rows: int, has_centers: bool) -> QRect:
        """Return the part of the widget that shows pixels."""
        if self._compact:
            return self.rect()
        theme = current_theme()
        across, down = ruler_size(rows, theme, ".5" * has_centers)
        margin = round(8 * theme.text_px / 13)  # That of a handle on the border, which grows with the text.
        return self.rect().adjusted(across, margin, -margin, -down)

    def _is_inside(self, pixel: tuple[int, int]) -> bool:
        """Return whether a pixel belongs to the raster."""
        buffer = self._canvas.buffer
        return buffer is not None and 0 <= pixel[0] < buffer.columns and 0 <= pixel[1] < buffer.rows

    def _is_hidden(self, pixel: tuple[int, int]) -> bool:
        """Return whether a pixel of the raster is covered up."""
        hidden = self._canvas.hidden
        return hidden is not None and bool(hidden[pixel[1], pixel[0]])

    def _repaint_all(self) -> None:
        """Paint everything again with the present theme."""
        self._canvas.forget()
        self.update()
