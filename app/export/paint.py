"""What one widget looks like on paper: without the widgets in it, as vectors where that is right."""

from PySide6.QtCore import QPoint, QRect, QRectF, Qt
from PySide6.QtGui import QImage, QPainter, QPaintEvent, QRegion
from PySide6.QtWidgets import QWidget

from widgets.grid.display import GridDisplay
from widgets.inspector.formula_view import FormulaView
from widgets.space.texture_view import TextureView

SHARPNESS = 4.0
"""Pixels, to a logical pixel, of what cannot be drawn as vectors."""


class Portrait(QWidget):
    """Shows another widget, which stays where it is, in a sheet of paper."""

    def __init__(self, of: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.of = of
        self.setFixedSize(of.size())

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the other widget and what is in it."""
        with QPainter(self) as painter:
            paint_tree(self.of, painter)


def draws_vectors(widget: QWidget) -> bool:
    """Return whether a widget has a way of its own to draw for paper."""
    return isinstance(widget, GridDisplay) and widget.buffer() is not None


def paint_alone(widget: QWidget, painter: QPainter, *, as_vectors: bool = True) -> None:
    """Paint a widget at the origin, without its children.

    Typeset formulas go in as pictures, because Qt draws them with outlines on anything but a screen, and
    textures, because its SVG writer knows no scaled patterns. A pixel grid sets its own clipping, so where a
    part of it is hidden (``as_vectors`` false) it goes in as a picture too.
    """
    is_grid = isinstance(widget, GridDisplay) and draws_vectors(widget)
    if isinstance(widget, Portrait):
        paint_tree(widget.of, painter)
    elif isinstance(widget, GridDisplay) and is_grid and as_vectors:
        widget.paint_to(painter)
    elif is_grid or isinstance(widget, FormulaView | TextureView):
        painter.drawImage(QRectF(widget.rect()), seen_image(widget, SHARPNESS))
    else:
        QWidget.render(widget, painter, QPoint(), QRegion(), QWidget.RenderFlag.DrawWindowBackground)


def paint_tree(widget: QWidget, painter: QPainter, seen: QRect | None = None) -> None:
    """Paint a widget at the origin and, above it, what is in it, in the order in which it lies.

    Parameters
    ----------
    seen : QRect, optional
        Part of the widget, in its own coordinates, that is not cut off by those around it.
    """
    seen = widget.rect() if seen is None else seen
    painter.save()
    painter.setClipRect(seen, Qt.ClipOperation.IntersectClip)
    paint_alone(widget, painter, as_vectors=seen == widget.rect())
    painter.restore()
    for child in shown_children(widget):
        part = seen.translated(-child.pos()).intersected(child.rect())
        if not part.isEmpty():
            painter.save()
            painter.translate(child.pos())
            paint_tree(child, painter, part)
            painter.restore()


def shown_children(widget: QWidget) -> list[QWidget]:
    """Return the widgets in a widget that can be seen, the lowest first."""
    found = [child for child in widget.children() if isinstance(child, QWidget) and not child.isWindow()]
    return [
        child for child in found if child.isVisibleTo(widget) and child.geometry().intersects(widget.rect())
    ]


def seen_image(widget: QWidget, scale: float) -> QImage:
    """Return a widget as it is seen, ``scale`` pixels to a logical pixel."""
    image = QImage(widget.size() * scale, QImage.Format.Format_ARGB32_Premultiplied)
    image.setDevicePixelRatio(scale)
    image.fill(0)
    # As a widget: a graphics view has a method of its own by this name, which draws its scene only.
    QWidget.render(widget, image, QPoint())
    return image


def drawn_image(widget: QWidget, scale: float) -> QImage:
    """Return a widget drawn anew, ``scale`` pixels to a logical pixel: lines and texts stay sharp when enlarged."""
    image = QImage(widget.size() * scale, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(0)
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.scale(scale, scale)
        paint_tree(widget, painter)
    return image
