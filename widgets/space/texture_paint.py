"""A texture with a triangle and footprints of pixels over it: the record, and how it is painted."""

from dataclasses import dataclass, field
from math import ceil, floor

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QBrush, QColor, QImage, QPainter, QPen, QPixmap, QPolygonF, QTransform

from widgets.basics.drawing import LabelPlaces
from widgets.basics.theme import Theme, faded, text_font
from widgets.grid.layers import number_text
from widgets.grid.view import clip_segments
from widgets.space.diagram import clip_polygon, paint_label

# What the texture view shows: a texture, a triangle laid over it, and the footprints of pixels.


@dataclass(frozen=True, eq=False)
class TexelFootprint:
    """A pixel in texture space; x and y in texels, (0, 0) the lower left corner of the texture."""

    corners: NDArray[np.float64] = field(repr=False)
    """(4, 2) float64, the pixel's corners in turn; not finite where it has none (at the horizon)."""
    center: NDArray[np.float64] = field(repr=False)
    """(2,) float64, the pixel's centre: the place that is looked up."""
    reads: NDArray[np.integer] = field(repr=False)
    """(K, 2) integers, columns and rows that are read, before wrapping, shifted like the centre."""
    texels: NDArray[np.integer] = field(repr=False)
    """(K, 2) integers, the texels that these are after wrapping."""
    shares: NDArray[np.float64] = field(repr=False)
    """(K,) float64, share of each in the colour."""
    label: str = ""
    is_pinned: bool = False
    """A pinned pixel has a solid outline, a hovered one a dashed one."""

    def __post_init__(self) -> None:
        if self.corners.shape != (4, 2) or self.center.shape != (2,):
            raise ValueError(
                f"corners and center must be (4, 2) and (2,), got {self.corners.shape} and {self.center.shape}"
            )
        if not self.reads.shape == self.texels.shape == (len(self.shares), 2):
            raise ValueError(f"reads and texels must be ({len(self.shares)}, 2), got {self.reads.shape}")


@dataclass(frozen=True, eq=False)
class TexturePicture:
    """A texture with what is marked in it."""

    pixels: NDArray[np.float32] = field(repr=False)
    """(h, w, C) linear colours, row 0 at the bottom."""
    period: int = 1
    """Textures after which the plane repeats; 2: every second is a mirror image; 0: the border texels go on."""
    triangle: NDArray[np.float64] | None = field(default=None, repr=False)
    """(3, 2) float64, corners of a triangle in texels, or None."""
    footprints: tuple[TexelFootprint, ...] = ()
    caption: str = ""

    def __post_init__(self) -> None:
        if self.pixels.ndim != 3 or self.pixels.shape[2] not in (1, 3, 4) or 0 in self.pixels.shape:
            raise ValueError(f"pixels must be (h, w, 1, 3 or 4) and not empty, got {self.pixels.shape}")
        if self.period not in (0, 1, 2):
            raise ValueError(f"period must be 0, 1 or 2, got {self.period}")
        if self.triangle is not None and self.triangle.shape != (3, 2):
            raise ValueError(f"triangle must be (3, 2), got {self.triangle.shape}")

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in texels."""
        return int(self.pixels.shape[1]), int(self.pixels.shape[0])


# How the texture view is painted: the texture, faint copies outside, texel lines, footprints and shares.


OUTSIDE_OPACITY = 0.38
LINE_SCALE = 7.0
"""Side of a texel in logical pixels from which texels are outlined."""
SHARE_SCALE = 34.0
"""Side from which the shares are written into texels."""


@dataclass(frozen=True)
class TexturePlacement:
    """Where texels stand in the widget."""

    area: QRectF
    left: float
    """Widget x of the texture's left border."""
    bottom: float
    """Widget y of its bottom border."""
    scale: float
    """Logical pixels per texel."""

    def to_widget(self, x: float, y: float) -> QPointF:
        """Return the widget position of a place in texels."""
        return QPointF(self.left + x * self.scale, self.bottom - y * self.scale)

    def to_texels(self, position: QPointF) -> tuple[float, float]:
        """Return the place in texels of a widget position."""
        return (position.x() - self.left) / self.scale, (self.bottom - position.y()) / self.scale

    def widget_points(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (N, 2) widget positions of places (N, 2) in texels."""
        with np.errstate(over="ignore", invalid="ignore"):
            return np.stack(
                [self.left + points[:, 0] * self.scale, self.bottom - points[:, 1] * self.scale], axis=1
            )

    def rect(self, column: float, row: float, columns: float = 1, rows: float = 1) -> QRectF:
        """Return the widget rectangle of a block of texels."""
        corner = self.to_widget(column, row + rows)
        return QRectF(corner, QSizeF(columns * self.scale, rows * self.scale))


def paint_read(painter: QPainter, placement: TexturePlacement, texel: tuple[int, int], theme: Theme) -> None:
    """Outline the texel (column, row) that is being read."""
    rect = placement.rect(*texel).adjusted(-1, -1, 1, 1)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for color, width in ((theme.panel, 4.0), (theme.focus, 2.0)):
        painter.setPen(QPen(QColor(color), width))
        painter.drawRect(rect)


def outside_image(image: QImage, period: int) -> QImage:
    """Return what is repeated around a texture: itself, or two by two with mirror images."""
    if period != 2:
        return image
    across, down, both = (
        image.transformed(QTransform.fromScale(x, y)) for x, y in ((-1, 1), (1, -1), (-1, -1))
    )
    width, height = image.width(), image.height()
    four = QImage(2 * width, 2 * height, QImage.Format.Format_ARGB32)
    painter = QPainter(four)
    painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_Source)
    for x, y, part in ((0, 0, image), (width, 0, across), (0, height, down), (width, height, both)):
        painter.drawImage(x, y, part)
    painter.end()
    return four


def paint_texture(
    painter: QPainter,
    picture: TexturePicture,
    image: QImage,
    outside: QPixmap,
    placement: TexturePlacement,
    theme: Theme,
) -> None:
    """Paint a texture, what wrapping puts around it, and what is marked in it."""
    area = placement.area
    width, height = picture.size
    painter.save()
    painter.setClipRect(area)
    painter.fillRect(area, QColor(theme.canvas))
    is_reduced = placement.scale * width < image.width()
    painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, is_reduced)
    painter.setOpacity(OUTSIDE_OPACITY)
    if not picture.period:
        _paint_clamped(painter, image, placement, picture.size)
    else:
        brush = QBrush(outside)
        corner = placement.to_widget(0, height)
        columns = outside.width() / picture.period
        stretch = placement.scale * width / columns
        brush.setTransform(QTransform(stretch, 0, 0, stretch, corner.x(), corner.y()))
        painter.fillRect(area, brush)
    painter.setOpacity(1.0)
    base = placement.rect(0, 0, width, height)
    painter.fillRect(base, QColor(theme.canvas))
    painter.drawImage(base, image)
    _paint_texel_lines(painter, placement, picture, theme)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    for pen in (QPen(faded(theme.halo(), 0.7), 3.4), QPen(QColor(theme.text), 1.6)):
        painter.setPen(pen)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(base)
    places = LabelPlaces(area.adjusted(3, 3, -3, -3))
    if picture.triangle is not None:
        _paint_triangle(painter, placement, picture.triangle, theme)
    for footprint in picture.footprints:
        _paint_texels(painter, placement, footprint, theme)
    for footprint in picture.footprints:
        _paint_footprint(painter, placement, footprint, theme, places)
    if picture.triangle is not None:
        _paint_corners(painter, placement, picture.triangle, theme, places)
    for x, y, text in ((0, 0, "(0, 0)"), (width, 0, "u = 1"), (0, height, "v = 1")):
        paint_label(painter, places, placement.to_widget(x, y), text, "text", theme, 3.0)
    painter.restore()


def _paint_clamped(
    painter: QPainter, image: QImage, placement: TexturePlacement, size: tuple[int, int]
) -> None:
    """Stretch the border texels to the borders of the view."""
    area, base = placement.area, placement.rect(0, 0, *size)
    columns = (
        (area.left(), base.left(), 0, 1),
        (base.left(), base.right(), 0, image.width()),
        (base.right(), area.right(), image.width() - 1, 1),
    )
    rows = (
        (area.top(), base.top(), 0, 1),
        (base.top(), base.bottom(), 0, image.height()),
        (base.bottom(), area.bottom(), image.height() - 1, 1),
    )
    for x0, x1, column, columns_read in columns:
        for y0, y1, row, rows_read in rows:
            if x1 > x0 and y1 > y0:
                source = QRectF(column, row, columns_read, rows_read)
                painter.drawImage(QRectF(x0, y0, x1 - x0, y1 - y0), image, source)


def _paint_texel_lines(
    painter: QPainter, placement: TexturePlacement, picture: TexturePicture, theme: Theme
) -> None:
    """Outline texels where they are large, and the borders of the copies."""
    area = placement.area
    x0, y0 = placement.to_texels(area.bottomLeft())
    x1, y1 = placement.to_texels(area.topRight())
    steps = [(*picture.size, 0.9, QColor(theme.text))]
    if placement.scale >= LINE_SCALE:
        steps.insert(0, (1, 1, 1.0, faded(theme.grid_line, 0.55)))
    for across, up, width, color in steps:
        if across * placement.scale < 4 or up * placement.scale < 4:
            continue
        painter.setPen(QPen(color, width))
        lines = [
            QLineF(placement.to_widget(x, y0), placement.to_widget(x, y1))
            for x in range(ceil(x0 / across) * across, floor(x1) + 1, across)
        ]
        lines += [
            QLineF(placement.to_widget(x0, y), placement.to_widget(x1, y))
            for y in range(ceil(y0 / up) * up, floor(y1) + 1, up)
        ]
        painter.drawLines(lines)


def _box(area: QRectF) -> tuple[float, float, float, float]:
    return area.left() - 20, area.top() - 20, area.right() + 20, area.bottom() + 20


def _stroke(
    painter: QPainter,
    placement: TexturePlacement,
    points: NDArray[np.float64],
    color: QColor,
    width: float,
    theme: Theme,
    style: Qt.PenStyle = Qt.PenStyle.SolidLine,
) -> None:
    """Draw a closed line through places in texels, on a halo."""
    seen = placement.widget_points(points)
    cut, _ = clip_segments(np.stack([seen, np.roll(seen, -1, axis=0)], axis=1), _box(placement.area))
    lines = [QLineF(*row) for row in cut.reshape(-1, 4).tolist()]
    for pen in (QPen(faded(theme.halo(), 0.75), width + 2.2), QPen(color, width, style)):
        pen.setCapStyle(Qt.PenCapStyle.RoundCap if style == Qt.PenStyle.SolidLine else Qt.PenCapStyle.FlatCap)
        painter.setPen(pen)
        painter.drawLines(lines)


def _paint_triangle(
    painter: QPainter, placement: TexturePlacement, triangle: NDArray[np.float64], theme: Theme
) -> None:
    """Draw the edges of a triangle in their colours."""
    seen = placement.widget_points(triangle)
    ends = np.stack([seen[[1, 2, 0]], seen[[2, 0, 1]]], axis=1)
    cut, source = clip_segments(ends, _box(placement.area))
    for row, edge in zip(cut.reshape(-1, 4).tolist(), source.tolist(), strict=True):
        for pen in (QPen(faded(theme.halo(), 0.6), 3.6), QPen(QColor(theme.vertex[edge]), 1.8)):
            painter.setPen(pen)
            painter.drawLine(QLineF(*row))


def _paint_corners(
    painter: QPainter,
    placement: TexturePlacement,
    triangle: NDArray[np.float64],
    theme: Theme,
    places: LabelPlaces,
) -> None:
    """Mark and name the corners of a triangle."""
    for k, (x, y) in enumerate(placement.widget_points(triangle).tolist()):
        if not (abs(x) < 1e7 and abs(y) < 1e7):
            continue
        painter.setPen(QPen(QColor("#ffffff"), 1.6))
        painter.setBrush(QColor(theme.vertex[k]))
        painter.drawEllipse(QPointF(x, y), 4.0, 4.0)
        paint_label(painter, places, QPointF(x, y), str(k), f"vertex {k}", theme, 6.0, is_bold=True)


def _paint_texels(
    painter: QPainter, placement: TexturePlacement, footprint: TexelFootprint, theme: Theme
) -> None:
    """Outline the texels that are read, and where they really are if wrapping moved them."""
    style = Qt.PenStyle.SolidLine if footprint.is_pinned else Qt.PenStyle.DashLine
    for read, texel in zip(footprint.reads.tolist(), footprint.texels.tolist(), strict=True):
        for place, used in ((read, style), (texel, Qt.PenStyle.DotLine)):
            if used == Qt.PenStyle.DotLine and place == read:
                continue
            rect = placement.rect(*place)
            if not rect.intersects(placement.area):
                continue
            painter.setBrush(Qt.BrushStyle.NoBrush)
            for pen in (QPen(faded(theme.halo(), 0.8), 3.6), QPen(QColor(theme.text), 1.6, used)):
                painter.setPen(pen)
                painter.drawRect(rect)


def _paint_footprint(
    painter: QPainter,
    placement: TexturePlacement,
    footprint: TexelFootprint,
    theme: Theme,
    places: LabelPlaces,
) -> None:
    """Fill and outline the pixel, mark its centre, and write the shares into the texels."""
    style = Qt.PenStyle.SolidLine if footprint.is_pinned else Qt.PenStyle.DashLine
    if np.isfinite(footprint.corners).all():
        inside = clip_polygon(placement.widget_points(footprint.corners), _box(placement.area))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(faded(theme.covered, 0.35))
        painter.drawPolygon(QPolygonF([QPointF(x, y) for x, y in inside.tolist()]))
        _stroke(painter, placement, footprint.corners, QColor(theme.covered), 2.2, theme, style)
    if not np.isfinite(footprint.center).all():
        return
    x, y = footprint.center.tolist()
    center = placement.to_widget(x, y)
    if not placement.area.adjusted(-20, -20, 20, 20).contains(center):
        return
    lines = [
        QLineF(center + QPointF(-6, 0), center + QPointF(6, 0)),
        QLineF(center + QPointF(0, -6), center + QPointF(0, 6)),
    ]
    for pen in (QPen(faded(theme.halo(), 0.9), 4.0), QPen(QColor(theme.text), 1.8)):
        painter.setPen(pen)
        painter.drawLines(lines)
    places.take(QRectF(center.x() - 7, center.y() - 7, 14, 14))
    if placement.scale >= SHARE_SCALE:
        for read, share in zip(footprint.reads.tolist(), footprint.shares.tolist(), strict=True):
            _paint_share(painter, placement.rect(*read), share, theme, places)
    if footprint.label:
        paint_label(painter, places, center, footprint.label, "text", theme, 9.0)


def _paint_share(painter: QPainter, rect: QRectF, share: float, theme: Theme, places: LabelPlaces) -> None:
    """Write a share into the upper left corner of a texel."""
    text = f"{number_text(100 * share, 3)} %"
    painter.setFont(text_font(theme, theme.small_px))
    metrics = painter.fontMetrics()
    if metrics.horizontalAdvance(text) + 8 > rect.width():
        return
    chip = QRectF(rect.left() + 2, rect.top() + 2, metrics.horizontalAdvance(text) + 6, metrics.height())
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(faded(theme.panel, 0.85))
    painter.drawRoundedRect(chip, 2, 2)
    painter.setPen(QColor(theme.text))
    painter.drawText(chip, Qt.AlignmentFlag.AlignCenter, text)
    places.take(chip)
