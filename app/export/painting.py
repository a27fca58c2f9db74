"""What a widget looks like on paper, with the widgets in it: as vectors where that is right, and as an SVG drawing.

In the drawing every widget is a nested ``svg`` element, which clips what it draws. Qt's own writer either leaves
clipping out (version Tiny 1.2) or, of widgets in widgets, clips in wrong coordinates (version 1.1).
"""

import re
from collections.abc import Iterator
from html import escape
from itertools import count
from math import ceil
from typing import Any

from PySide6.QtCore import QBuffer, QIODevice, QPoint, QRect, QRectF, Qt
from PySide6.QtGui import QBrush, QImage, QPainter, QPaintEvent, QRegion
from PySide6.QtSvg import QSvgGenerator
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


LARGEST_IMAGE = 4096
"""Pixels each way of an enlarged picture."""


_BODY = re.compile(r"<svg[^>]*>(?P<body>.*)</svg>", re.DOTALL)


_DESCRIPTION = re.compile(r"<(title|desc)>.*?</\1>\n?", re.DOTALL)


_FAMILY = re.compile(r'font-family="(?P<family>[^"]*)"')


_NAME = re.compile(r'(?P<before>\bid="|url\(#|href="#)(?P<name>\w+)')


def svg_text(widget: QWidget, title: str) -> str:
    """Return the drawing of a widget as it is seen, in logical pixels; text stays text.

    Pixel grids draw themselves as vectors (``GridDisplay.paint_to``), every other widget as on the screen.
    """
    names = (f"part{number}_" for number in count())
    width, height = widget.width(), widget.height()
    return (
        '<?xml version="1.0" encoding="UTF-8" standalone="no"?>\n'
        f'<svg width="{width}" height="{height}" viewBox="0 0 {width} {height}" version="1.1" '
        'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink">\n'
        f"<title>{escape(title)}</title>\n{_content(widget, names)}</svg>\n"
    )


def _content(widget: QWidget, names: Iterator[str]) -> str:
    """Return what a widget draws and, above it, what its children do, in the order in which they lie."""
    if isinstance(widget, Portrait):
        return _content(widget.of, names)
    parts = [_drawn(widget, next(names))]
    for child in shown_children(widget):
        place = child.geometry()
        parts.append(
            f'<svg x="{place.x()}" y="{place.y()}" width="{place.width()}" height="{place.height()}" '
            f'viewBox="0 0 {place.width()} {place.height()}" overflow="hidden">\n'
            f"{_content(child, names)}</svg>\n"
        )
    return "".join(parts)


def _drawn(widget: QWidget, name: str) -> str:
    """Return what a widget itself draws, with names of its own for gradients and the like."""
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    versions = QSvgGenerator.SvgVersion
    generator = QSvgGenerator(versions.Svg11 if draws_vectors(widget) else versions.SvgTiny12)
    generator.setOutputDevice(buffer)
    generator.setSize(widget.size())
    generator.setViewBox(QRect(QPoint(), widget.size()))
    painter = _SvgPainter(generator)
    paint_alone(widget, painter)
    painter.end()
    found = _BODY.search(bytes(buffer.data().data()).decode())
    assert found is not None
    body = _DESCRIPTION.sub("", found["body"])
    body = _FAMILY.sub(_with_fallback, body)
    return _NAME.sub(rf"\g<before>{name}\g<name>", body)


def _with_fallback(found: re.Match[str]) -> str:
    """Name a kind of font behind the one of this machine, which a reader may not have."""
    family = found["family"]
    kind = "monospace" if "mono" in family.lower() else "sans-serif"
    names = kind if family.lower() in ("sans serif", "sans", "monospace") else f"{family}, {kind}"
    return f'font-family="{names}"'


class _SvgPainter(QPainter):
    """A painter that does what Qt's SVG writer leaves out: parts of pictures, and where a pattern begins."""

    def fillRect(self, *arguments: Any) -> None:
        """Fill a rectangle; the tiles of a pattern begin at the brush's origin."""
        if len(arguments) == 2 and isinstance(arguments[0], QRectF) and isinstance(arguments[1], QBrush):
            origin = self.brushOrigin()
            self.save()
            self.translate(origin)
            super().fillRect(arguments[0].translated(-origin), arguments[1])
            self.restore()
        else:
            super().fillRect(*arguments)

    def drawImage(self, *arguments: Any) -> None:
        """Draw a picture or a part of it; cells are enlarged, as some programs blur what they enlarge."""
        if len(arguments) == 3 and isinstance(arguments[1], QImage) and isinstance(arguments[2], QRectF):
            target, image, part = arguments
            image = image.copy(part.toAlignedRect())
            if not self.testRenderHint(QPainter.RenderHint.SmoothPixmapTransform):
                times = min(
                    ceil(2 * target.width() / image.width()),
                    LARGEST_IMAGE // max(image.width(), image.height()),
                )
                image = image.scaled(image.size() * max(times, 1))
            arguments = (target, image)
        super().drawImage(*arguments)
