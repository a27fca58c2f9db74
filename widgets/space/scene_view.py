"""A picture of a scene under the pointer: turn, move, magnify, pick a pixel, drag the vertices in focus."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import combinations
from time import perf_counter

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRectF, QSize, QSizeF, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QImage,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QWidget

from core.records.arrays import is_alike
from widgets.basics.drawing import LabelPlaces
from widgets.basics.image import display_image
from widgets.basics.theme import Theme, current_theme, faded, ink_color
from widgets.space.diagram import Spot, paint_label, paint_spot
from widgets.space.frame_corner import FrameCorner, SizeChoice, picture_area
from widgets.space.orbit import Orbit, ViewDepth
from widgets.space.view import GRAB_RADIUS, OrbitArea

AROUND = (1.0, 2.0, 4.0, 7.0)
"""How far away words may stand, as multiples of their usual distance: boxes may be crowded."""
MANY_SIDES, SMALL = 5, 0.2
"""A mark of at least so many points, and at most this part of the picture, is a box that words should not cover."""


@dataclass(frozen=True)
class SceneHandle:
    """A vertex of the triangle in focus."""

    index: int
    """Its name, and its number in signals."""
    x: float
    """Fraction of the picture's width, from the left."""
    y: float
    """Fraction of the picture's height, from the bottom."""
    color: int
    """0, 1 or 2."""


@dataclass(frozen=True, eq=False)
class SceneMark:
    """A thin line over the picture, with a mark and a name at its last point."""

    points: NDArray[np.float64] = field(repr=False)
    """(N, 2) fractions of width and height; NaN interrupts the line."""
    ink: str = "text"
    label: str = ""
    shape: str = "ring"
    """Mark at the last point: ``ring``, ``disc``, ``cross`` or ``none``."""

    def __post_init__(self) -> None:
        if self.points.ndim != 2 or self.points.shape[1] != 2:
            raise ValueError(f"points must be (N, 2), got {self.points.shape}")


@dataclass(frozen=True, eq=False)
class ScenePicture:
    """A drawn scene."""

    pixels: NDArray[np.uint8] = field(repr=False)
    """(H, W, 4) sRGB bytes, row 0 at the bottom; alpha is not shown."""
    handles: tuple[SceneHandle, ...] = ()
    marks: tuple[SceneMark, ...] = ()
    labels: tuple[tuple[float, float, str, str], ...] = ()
    """Fraction across, fraction up, text, ink."""
    caption: str = ""
    sight: ViewDepth | None = None
    """Where the wheel goes; None: to the target of the orbit."""

    def __post_init__(self) -> None:
        if self.pixels.ndim != 3 or self.pixels.shape[2] != 4 or 0 in self.pixels.shape:
            raise ValueError(f"pixels must be (H, W, 4) with at least one pixel, got {self.pixels.shape}")


class SceneView(OrbitArea):
    """Shows a :class:`ScenePicture`, and asks for another one when the user turns, moves or magnifies it."""

    picked = Signal(int, int)
    """Column and row of the picture that was clicked, row 0 at the bottom."""
    vertex_dragged = Signal(int, float, float)
    """Vertex and its new place: fractions of the picture's width and height, y up."""
    vertex_drag_finished = Signal(int)
    """Vertex."""
    vertex_drag_taken_back = Signal(int)
    """Vertex; the drag ended and is to be as if it had not been."""
    size_changed = Signal()
    """The picture should have another size: see :meth:`picture_size`."""
    size_chosen = Signal(str)
    """Name of a size that the user has chosen in the corner's menu."""
    picture_painted = Signal(float)
    """New pixels are on the screen; when, by ``time.perf_counter``, in seconds."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._picture: ScenePicture | None = None
        self._image = QImage()
        self._reduced = QImage()
        """The picture at the size that it was last painted at, where that is smaller."""
        self._caption, self._has_caption = "", True
        self._origin = (0.0, 0.0)
        self._fixed_size: tuple[int, int] | None = None
        self._has_new_pixels = False
        self._left_free = QRectF()
        """Where the corner was when words were painted."""
        self._corner = FrameCorner(self)
        self._corner.size_chosen.connect(self.size_chosen)
        self.setAccessibleName("3D scene")

    def picture(self) -> ScenePicture | None:
        """Return what is shown."""
        return self._picture

    def show_picture(self, picture: ScenePicture | None) -> None:
        """Show a picture; None: the empty text."""
        before, self._picture = self._picture, picture
        if picture is None:
            self._image, self._reduced = QImage(), QImage()
        elif before is None or before.pixels is not picture.pixels:
            self._image, self._reduced = display_image(picture.pixels), QImage()
            self._has_new_pixels = True
        caption = self.empty_text if picture is None else picture.caption
        self.setAccessibleDescription(caption)
        is_painted = not self._has_new_pixels and is_alike(before, picture, ("pixels", "sight"))
        if picture is None or not is_painted or self._corner_area() != self._left_free:
            self.update()

    def set_caption(self, caption: str) -> None:
        """Keep room for a caption that all pictures will have, so that the picture's size does not change."""
        self._caption_as(caption, self._has_caption)

    def show_caption(self, is_shown: bool) -> None:
        """Show the caption below the pictures, or leave its room to them."""
        self._caption_as(self._caption, is_shown)

    def _caption_as(self, caption: str, is_shown: bool) -> None:
        if (caption, is_shown) != (self._caption, self._has_caption):
            before = self.picture_size()
            self._caption, self._has_caption = caption, is_shown
            self.update()
            if self.picture_size() != before:
                self.size_changed.emit()

    def show_figures(self, text: str) -> None:
        """Show in the corner what the last picture took."""
        self._corner.show_figures(text)

    def show_sizes(self, choices: Sequence[SizeChoice], chosen: str) -> None:
        """Offer sizes of the picture in the corner's menu; one of them is chosen."""
        self._corner.show_sizes(choices, chosen)

    def corner(self) -> FrameCorner:
        """Return the corner with figures and sizes."""
        return self._corner

    def _corner_area(self) -> QRectF:
        """Return where the corner is; empty while it is hidden."""
        return QRectF(self._corner.geometry()) if self._corner.isVisible() else QRectF()

    def fix_picture_size(self, size: tuple[int, int] | None) -> None:
        """Ask for pictures of this (width, height), whatever the size of the view; None: of the view's own."""
        if size != self._fixed_size:
            self._fixed_size = size
            self.update()
            self.size_changed.emit()

    def picture_size(self) -> tuple[int, int]:
        """Return the columns and rows of the picture: the fixed ones, or one pixel for each of the screen."""
        if self._fixed_size is not None:
            return self._fixed_size
        area, ratio = self._room(), self.devicePixelRatioF()
        return max(round(area.width() * ratio), 1), max(round(area.height() * ratio), 1)

    def pixels_per_point(self) -> float:
        """Return how many pixels of the picture a logical pixel of the view shows, along one axis."""
        return self.picture_size()[0] / max(self._space_area().width(), 1.0)

    def _drawn_caption(self) -> str | None:
        if self._picture is None:
            return None
        return self._picture.caption if self._has_caption else ""

    def _paint_drawing(self, painter: QPainter, theme: Theme) -> None:
        if self._picture is None:
            return
        area = self._space_area()
        painter.drawImage(area, self._image_for(area.size() * painter.device().devicePixelRatioF()))
        painter.save()
        painter.setClipRect(area)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint_over(painter, self._picture, area, theme)
        painter.restore()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the picture and what is over it, and say when."""
        super().paintEvent(event)
        if self._has_new_pixels:
            self._has_new_pixels = False
            self.picture_painted.emit(perf_counter())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Ask for a picture of the new size."""
        super().resizeEvent(event)
        self._place_corner()
        if self._fixed_size is None:
            self.size_changed.emit()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Offer the sizes of the picture where they are looked for too."""
        self._corner.open_menu(event.globalPos())

    def _orbit_replaced(self) -> None:
        """Paint nothing: what is seen changes with the next picture."""

    def _place_corner(self) -> None:
        margin = current_theme().unit
        self._corner.move(margin, margin)
        self._corner.set_most_width(self.width() - 2 * margin)

    def _space_area(self) -> QRectF:
        """Return where the picture is."""
        if self._fixed_size is None:
            return self._room()
        return picture_area(self._room(), self._fixed_size, self.devicePixelRatioF())

    def _kept_caption(self) -> str:
        return self._caption if self._has_caption else ""

    def _image_for(self, room: QSizeF) -> QImage:
        """Return the picture for so many pixels of the screen: magnified pixels stay squares, others are averaged."""
        wanted = QSize(round(room.width()), round(room.height()))
        if wanted.width() >= self._image.width() or wanted.isEmpty():
            return self._image
        if self._reduced.size() != wanted:
            self._reduced = self._image.scaled(
                wanted, Qt.AspectRatioMode.IgnoreAspectRatio, Qt.TransformationMode.SmoothTransformation
            )
        return self._reduced

    def _paint_over(self, painter: QPainter, picture: ScenePicture, area: QRectF, theme: Theme) -> None:
        """Paint marks, handles and words."""
        places = LabelPlaces(area.adjusted(2, 2, -2, -2))
        self._left_free = self._corner_area()
        if not self._left_free.isEmpty():
            places.take(self._left_free)
        handles = self._placed_handles()
        for _, place in handles:
            places.take(QRectF(place.x() - 7, place.y() - 7, 14, 14))
        for mark in picture.marks:
            if (around := _small_box(mark, area)) is not None:
                places.avoid(around)
        # All words after all marks: none may lie over a word.
        ends = [_paint_mark(painter, mark, area, places, theme) for mark in picture.marks]
        for mark, end in zip(picture.marks, ends, strict=True):
            if mark.label and end is not None:
                paint_label(painter, places, end, mark.label, mark.ink, theme, 7.0, further=AROUND)
        apart = [QLineF(a, b).length() for (_, a), (_, b) in combinations(handles, 2)]
        # Smaller where they would cover each other.
        radius = min(max(min(apart, default=15.0) / 3, 2.0), 5.0)
        for handle, place in handles:
            ink, reach = f"vertex {handle.color}", 8.0 * theme.text_px / 13
            spot, is_held = Spot(np.zeros(3), ink, radius=radius), handle.index == self._handle
            paint_spot(painter, place, spot, theme, is_handle=True, is_held=is_held)
            paint_label(painter, places, place, str(handle.index), ink, theme, reach, is_bold=True)
        if picture.sight is not None:
            for left, bottom, right, top in picture.sight.covered:
                corners = area.left() + left * area.width(), area.bottom() - top * area.height()
                places.avoid(QRectF(*corners, (right - left) * area.width(), (top - bottom) * area.height()))
        for x, y, text, ink in picture.labels:
            placed = _place(area, x, y)
            if placed is not None:
                paint_label(painter, places, placed, text, ink, theme, 4.0, further=AROUND)

    def _placed_handles(self) -> list[tuple[SceneHandle, QPointF]]:
        """Return the handles that have a place in the widget, each with it."""
        area = self._space_area()
        handles = self._picture.handles if self._picture is not None else ()
        places = [(handle, _place(area, handle.x, handle.y)) for handle in handles]
        return [(handle, place) for handle, place in places if place is not None]

    def _handle_near(self, position: QPointF) -> int | None:
        best, reach = None, GRAB_RADIUS
        for handle, place in self._placed_handles():
            distance = QLineF(place, position).length()
            if distance <= reach:
                best, reach = handle.index, distance
        return best

    def _orbit_at(self, position: QPointF) -> Orbit:
        if self._picture is None or self._picture.sight is None:
            return self.orbit()
        area = self._space_area()
        x, y = (position.x() - area.left()) / area.width(), (area.bottom() - position.y()) / area.height()
        return self._picture.sight.focused(self.orbit(), x, y)

    def _handle_taken(self, handle: int) -> None:
        handles = self._picture.handles if self._picture is not None else ()
        self._origin = next(((h.x, h.y) for h in handles if h.index == handle), (0.5, 0.5))

    def _handle_moved(self, handle: int, from_press: QPointF) -> None:
        area = self._space_area()
        x = self._origin[0] + from_press.x() / area.width()
        y = self._origin[1] - from_press.y() / area.height()
        self.vertex_dragged.emit(handle, x, y)

    def _handle_dropped(self, handle: int, is_taken_back: bool) -> None:
        (self.vertex_drag_taken_back if is_taken_back else self.vertex_drag_finished).emit(handle)

    def _clicked(self, position: QPointF) -> None:
        area = self._space_area()
        if self._picture is None or not area.contains(position):
            return
        rows, columns, _ = self._picture.pixels.shape
        column = int((position.x() - area.left()) * columns / area.width())
        # A press at y is in the pixel below y, as one at x is in the pixel to the right of x.
        row = rows - 1 - int((position.y() - area.top()) * rows / area.height())
        self.picked.emit(min(max(column, 0), columns - 1), min(max(row, 0), rows - 1))


def _place(area: QRectF, x: float, y: float) -> QPointF | None:
    """Return where fractions of a picture are that fills an area; None: too far away to be painted."""
    place = QPointF(area.left() + x * area.width(), area.bottom() - y * area.height())
    return place if abs(place.x()) < 1e7 and abs(place.y()) < 1e7 else None


def _small_box(mark: SceneMark, area: QRectF) -> QRectF | None:
    """Return the rectangle around a mark that words should leave visible; ``None``: it is large, or not in the area."""
    with np.errstate(invalid="ignore"):
        is_placed = (np.abs(mark.points) < 1e3).all(axis=1)
    if len(mark.points) < MANY_SIDES or not is_placed.any():
        return None
    (left, bottom), (right, top) = mark.points[is_placed].min(axis=0), mark.points[is_placed].max(axis=0)
    if max(right - left, top - bottom) > SMALL:
        return None
    first, last = _place(area, left, top), _place(area, right, bottom)
    return None if first is None or last is None else QRectF(first, last)


def _paint_mark(
    painter: QPainter, mark: SceneMark, area: QRectF, places: LabelPlaces, theme: Theme
) -> QPointF | None:
    """Paint a line over the picture, and the mark at its end; return where that is, ``None``: too far away."""
    runs: list[list[QPointF]] = [[]]
    last = None
    for x, y in mark.points.tolist():
        last = _place(area, x, y)
        if last is None:
            runs.append([])
        else:
            runs[-1].append(last)
    runs = [run for run in runs if len(run) > 1]
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for pen in (
        QPen(faded(theme.halo(), 0.7), 3.6),
        QPen(QColor(ink_color(mark.ink, theme)), 1.4 * theme.text_px / 13),
    ):
        painter.setPen(pen)
        for run in runs:
            painter.drawPolyline(QPolygonF(run))
    if last is not None and mark.shape in ("ring", "disc", "cross"):
        spot = Spot(np.zeros(3), mark.ink, mark.shape, 4.0)  # type: ignore[arg-type]
        paint_spot(painter, last, spot, theme)
        around = QRectF(last.x() - 5, last.y() - 5, 10, 10)
        (places.take if mark.label else places.avoid)(around)
    return last
