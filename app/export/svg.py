"""A widget as an SVG drawing: every widget in it is a nested ``svg`` element, which clips what it draws.

Qt's own writer either leaves clipping out (version Tiny 1.2) or, of widgets in widgets, clips in wrong
coordinates (version 1.1).
"""

import re
from collections.abc import Iterator
from html import escape
from itertools import count
from math import ceil
from typing import Any

from PySide6.QtCore import QBuffer, QIODevice, QPoint, QRect, QRectF
from PySide6.QtGui import QBrush, QImage, QPainter
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import QWidget

from app.export.paint import Portrait, draws_vectors, paint_alone, shown_children

LARGEST = 4096
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
                    ceil(2 * target.width() / image.width()), LARGEST // max(image.width(), image.height())
                )
                image = image.scaled(image.size() * max(times, 1))
            arguments = (target, image)
        super().drawImage(*arguments)
