"""A texture under the pointer: pan, magnify, read texels; one view, or two for the levels that a pixel reads."""

from math import floor

import numpy as np
from PySide6.QtCore import QEvent, QPointF, Qt, Signal
from PySide6.QtGui import QHelpEvent, QImage, QMouseEvent, QPainter, QPixmap
from PySide6.QtWidgets import QToolTip, QWidget

from widgets.basics.accessibility import announce
from widgets.basics.controls import row_layout
from widgets.basics.image import buffer_image
from widgets.basics.theme import Theme, current_theme
from widgets.grid.layers import GridBuffer
from widgets.space.texture_paint import (
    TexturePicture,
    TexturePlacement,
    outside_image,
    paint_read,
    paint_texture,
)
from widgets.space.view import MovedArea

# A texture under the pointer: pan, magnify, and read texels; footprints of pixels are outlined in it.


_KEY_PIXELS = 32.0
LARGEST_TEXEL = 160.0
"""Largest side of a texel in logical pixels."""
REDUCED = 1024
"""A texture with a longer side is drawn from a smaller copy while its texels are smaller than a pixel."""
FOOTPRINT_ROOM = 3.0
"""The view of a footprint is so many times as wide as the footprint or its texels."""


class TextureView(MovedArea):
    """Shows a :class:`~widgets.space.texture_paint.TexturePicture`.

    Drag: pan. Wheel: magnify about the pointer. Double click: the footprint, and again the whole texture.
    With the keyboard's focus arrows pan, plus and minus magnify, Home shows the whole texture, and Shift with an
    arrow goes from texel to texel. A tooltip gives the texel under the pointer, or the one gone to, in full.
    """

    view_changed = Signal()
    """The user has panned or magnified."""
    wheel_factor = 1.25

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._picture: TexturePicture | None = None
        self._image = QImage()
        self._reduced = QImage()
        self._outside = QPixmap()
        """What is repeated around the texture."""
        self._middle = (0.0, 0.0)
        """Texel coordinates in the middle of the view."""
        self._scale: float | None = None
        """Logical pixels per texel; None: the whole texture."""
        self._is_on_footprint = False
        self._dragged_from: QPointF | None = None
        self._read: tuple[int, int] | None = None
        """The texel that the keyboard reads."""
        self.setAccessibleName("Texture space")

    def picture(self) -> TexturePicture | None:
        """Return what is shown."""
        return self._picture

    def show_picture(self, picture: TexturePicture | None) -> None:
        """Show a texture; None: the empty text."""
        before, self._picture = self._picture, picture
        is_other = before is None or picture is None or before.pixels is not picture.pixels
        is_other = is_other or (
            before is not None and picture is not None and before.period != picture.period
        )
        if is_other:
            self._make_images()
            self._scale = None
            self._is_on_footprint = False
            self._read = None
        elif self._is_on_footprint:
            self._show_footprint()
        self.setAccessibleDescription(self.empty_text if picture is None else picture.caption)
        self.update()

    def fit(self) -> None:
        """Show the whole texture, as the user's wish."""
        self._scale, self._is_on_footprint = None, False
        self._tell()

    def fit_footprint(self) -> None:
        """Show the first footprint and what it reads, and follow it from pixel to pixel."""
        self._is_on_footprint = True
        self._show_footprint()
        self._tell()

    def placement(self) -> TexturePlacement:
        """Return where texels stand in the widget now."""
        area = self._room()
        width, height = self._picture.size if self._picture is not None else (1, 1)
        room = min(area.width() / (1.25 * width), area.height() / (1.25 * height))
        if self._scale is None:
            scale, (x, y) = room, (width / 2, height / 2)
        else:
            scale, (x, y) = min(max(self._scale, room / 16), max(LARGEST_TEXEL, room)), self._middle
        center = area.center()
        return TexturePlacement(area, center.x() - x * scale, center.y() + y * scale, scale)

    def texel_at(self, position: QPointF) -> tuple[int, int]:
        """Return column and row under a widget position, before wrapping."""
        x, y = self.placement().to_texels(position)
        return floor(x), floor(y)

    def _drawn_caption(self) -> str | None:
        return None if self._picture is None else self._picture.caption

    def _paint_drawing(self, painter: QPainter, theme: Theme) -> None:
        if self._picture is not None:
            placement = self.placement()
            image = self._image if placement.scale >= 1 or self._reduced.isNull() else self._reduced
            paint_texture(painter, self._picture, image, self._outside, placement, theme)
            if self._read is not None:
                paint_read(painter, placement, self._read, theme)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin to pan."""
        if event.button() in (Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton):
            self._dragged_from = event.position()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Pan."""
        if self._dragged_from is None:
            return
        delta, self._dragged_from = event.position() - self._dragged_from, event.position()
        self.setCursor(Qt.CursorShape.ClosedHandCursor)
        self._pan(delta.x(), delta.y())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End panning."""
        self._dragged_from = None
        self.unsetCursor()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Show the footprint, and again the whole texture."""
        if self._is_on_footprint or self._picture is None or not self._picture.footprints:
            self.fit()
        else:
            self.fit_footprint()

    def _go(self, across: int, down: int, is_shifted: bool) -> None:
        if is_shifted:
            self._read_next(across, -down)
        else:
            self._pan(-_KEY_PIXELS * across, -_KEY_PIXELS * down)

    def _read_next(self, right: int, up: int) -> None:
        """Mark the neighbouring texel and show its value; the first time the texel in the middle of the view."""
        if self._picture is None:
            return
        column, row = self.texel_at(self.placement().area.center()) if self._read is None else self._read
        if self._read is not None:
            column, row = column + right, row + up
        width, height = self._picture.size
        column, row = min(max(column, 0), width - 1), min(max(row, 0), height - 1)
        self._read = column, row
        place = self.placement().to_widget(column + 0.5, row + 0.5)
        if not self.placement().area.contains(place):
            self._take(column + 0.5, row + 0.5, self.placement().scale)
            place = self.placement().to_widget(column + 0.5, row + 0.5)
        text = self._texel_text(place)
        QToolTip.showText(self.mapToGlobal(place.toPoint()), text, self)
        announce(self, text)
        self.update()

    def _go_home(self) -> None:
        self.fit()

    def event(self, event: QEvent) -> bool:
        """Show the texel under the pointer as a tooltip."""
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            text = self._texel_text(QPointF(event.pos()))
            if text:
                QToolTip.showText(event.globalPos(), text)
            else:
                QToolTip.hideText()
            return True
        return super().event(event)

    def _texel_text(self, position: QPointF) -> str:
        """Return place and colour of the texel at a widget position; empty outside the texture."""
        if self._picture is None:
            return ""
        column, row = self.texel_at(position)
        width, height = self._picture.size
        if not (0 <= column < width and 0 <= row < height):
            return ""
        x, y = self.placement().to_texels(position)
        buffer = GridBuffer("texture", self._picture.pixels, "color")
        return (
            f"Texel ({column}, {row}), u = {x / width:.4g}, v = {y / height:.4g}\n"
            f"{buffer.text_at(column, row, digits=0)}, linear"
        )

    def _pan(self, right: float, down: float) -> None:
        placement = self.placement()
        center = placement.area.center()
        x, y = placement.to_texels(center - QPointF(right, down))
        self._take(x, y, placement.scale)

    def _magnify(self, factor: float, position: QPointF | None) -> None:
        if self._picture is None:
            return
        placement = self.placement()
        position = placement.area.center() if position is None else position
        x, y = placement.to_texels(position)
        self._take(x, y, placement.scale * factor)
        # What is under the pointer stays there, at the scale that was possible.
        scale, center = self.placement().scale, placement.area.center()
        self._middle = (x - (position.x() - center.x()) / scale, y + (position.y() - center.y()) / scale)

    def _take(self, x: float, y: float, scale: float) -> None:
        """Take over a view that the user chose."""
        self._middle, self._scale, self._is_on_footprint = (x, y), scale, False
        self._tell()

    def _tell(self) -> None:
        self.update()
        self.view_changed.emit()

    def _show_footprint(self) -> None:
        """Show the first footprint with the texels it reads."""
        if self._picture is None or not self._picture.footprints:
            self._scale = None
            return
        footprint = self._picture.footprints[0]
        points = np.concatenate(
            [footprint.corners, footprint.center[None], footprint.reads, footprint.reads + 1.0]
        )
        points = points[np.isfinite(points).all(axis=1)]
        if not len(points):
            self._scale = None
            return
        low, high = points.min(axis=0), points.max(axis=0)
        area = self._room()
        span = np.maximum(high - low, 1.0) * FOOTPRINT_ROOM
        self._scale = float(min(area.width() / span[0], area.height() / span[1]))
        x, y = ((low + high) / 2).tolist()
        self._middle = (x, y)

    def _make_images(self) -> None:
        self._image, self._reduced = QImage(), QImage()
        if self._picture is None:
            return
        self._image = buffer_image(GridBuffer("texture", self._picture.pixels, "color"), current_theme())
        if max(self._image.width(), self._image.height()) > REDUCED:
            self._reduced = self._image.scaled(
                REDUCED,
                REDUCED,
                Qt.AspectRatioMode.KeepAspectRatio,
                Qt.TransformationMode.SmoothTransformation,
            )
        around = self._image if self._reduced.isNull() else self._reduced
        self._outside = QPixmap.fromImage(outside_image(around, self._picture.period))

    def _repaint(self) -> None:
        """Paint everything again with the present theme."""
        self._make_images()
        self.update()


# One texture view, or two side by side: the mipmap levels that a pixel reads.


GAP = 4
"""Logical pixels between the views."""


class TextureLevels(QWidget):
    """Shows a texture, or the finer level on the left and the coarser one on the right; each has its own view."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._views = TextureView(), TextureView()
        layout = row_layout(self, GAP)
        for view in self._views:
            layout.addWidget(view)
        self.setAccessibleName("Texture space")
        self._views[1].setAccessibleName("Texture space, coarser level")
        self._views[1].hide()
        self.setFocusProxy(self._views[0])

    def views(self) -> tuple[TextureView, TextureView]:
        """Return the views of the finer and of the coarser level."""
        return self._views

    def pictures(self) -> tuple[TexturePicture, ...]:
        """Return what is shown."""
        found = (view.picture() for view in self._views)
        return tuple(picture for picture in found if picture is not None)

    def show_pictures(self, pictures: tuple[TexturePicture, ...], empty_text: str) -> None:
        """Show one texture, or two levels; of none, the empty text."""
        for place, view in enumerate(self._views):
            view.empty_text = empty_text
            view.show_picture(pictures[place] if place < len(pictures) else None)
        self._views[1].setVisible(len(pictures) > 1)
        captions = " ".join(picture.caption for picture in pictures)
        self.setAccessibleDescription(captions if pictures else empty_text)
