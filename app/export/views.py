"""A view as a picture (PNG), a drawing (SVG) or a page (PDF), on the clipboard, and on a sheet with its words.

Qt's own writer either leaves clipping out (version Tiny 1.2) or, of widgets in widgets, clips in wrong
coordinates (version 1.1).
"""

import re
from collections.abc import Callable, Iterator
from html import escape
from itertools import count
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import (
    QBuffer,
    QCoreApplication,
    QIODevice,
    QMarginsF,
    QPoint,
    QRect,
    QRectF,
    QSize,
    QSizeF,
    Qt,
    QThread,
)
from PySide6.QtGui import (
    QBrush,
    QGuiApplication,
    QImage,
    QPageLayout,
    QPageSize,
    QPainter,
    QPaintEvent,
    QPdfWriter,
    QPicture,
    QRegion,
)
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import QWidget

from app.files.file_access import VIEW_ENDINGS, write_file
from app.pages.page_bar import Caption
from widgets.basics.controls import column_layout, text_label
from widgets.basics.style_sheet import style_sheet
from widgets.basics.theme import current_theme, text_font
from widgets.grid.display import GridDisplay
from widgets.inspector.formula_view import FormulaView
from widgets.space.texture_view import TextureView

if TYPE_CHECKING:
    from PySide6.QtPrintSupport import QPrinter


# What one widget looks like on paper: without the widgets in it, as vectors where that is right.


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


# A widget as an SVG drawing: every widget in it is a nested ``svg`` element, which clips what it draws.


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


# A view as a picture (PNG), a drawing (SVG) or a page (PDF), and on the clipboard.


def export_widget(widget: QWidget, path: str | Path, scale: float | None = None) -> None:
    """Write a widget as it is seen, in the format of the file's ending.

    Parameters
    ----------
    path : str or Path
        Ends with ``.png``, ``.svg`` or ``.pdf``.
    scale : float, optional
        Pixels of a PNG to a logical pixel; by default it is the picture on the screen.

    Raises
    ------
    ValueError
        If the ending is another one, or the widget has no size.
    OSError
        If the file cannot be written; what stood there stays. The message is one sentence.
    """
    makers: dict[str, Callable[[], bytes]] = {
        ".png": lambda: png_bytes(widget_image(widget, scale)),
        ".svg": lambda: svg_bytes(widget),
        ".pdf": lambda: pdf_bytes(widget),
    }
    ending = Path(path).suffix.lower()
    if ending not in makers:
        raise ValueError(
            f"the name of the file must end with {', '.join(VIEW_ENDINGS)}, got {Path(path).name}"
        )
    if widget.size().isEmpty():
        raise ValueError("this view has no size, there is nothing to export")
    content = makers[ending]()
    write_file(path, content)


def copy_widget(widget: QWidget, scale: float | None = None) -> QSize:
    """Put a widget, as it is seen, on the clipboard as a picture; return the picture's size in pixels."""
    image = widget_image(widget, scale)
    QGuiApplication.clipboard().setImage(image)
    return image.size()


def widget_image(widget: QWidget, scale: float | None = None) -> QImage:
    """Return a widget as it is seen; a formula alone, on a clear ground."""
    if isinstance(widget, FormulaView):
        return widget.to_image() if scale is None else widget.to_image(scale)
    if scale is None:
        return seen_image(widget, max(widget.devicePixelRatioF(), 1.0))
    return drawn_image(widget, scale)


def png_bytes(image: QImage) -> bytes:
    """Return an image as a PNG file."""
    buffer = _open_buffer()
    if not image.save(buffer, "PNG"):  # type: ignore[call-overload]
        raise ValueError(f"a picture of {image.width()}x{image.height()} pixels cannot be made")
    return bytes(buffer.data().data())


def svg_bytes(widget: QWidget) -> bytes:
    """Return a widget as an SVG file of its size in pixels; text stays text."""
    return svg_text(widget, title_of(widget)).encode()


def pdf_bytes(widget: QWidget) -> bytes:
    """Return a widget as a PDF file of one page that has its size, at 96 pixels an inch."""
    buffer = _open_buffer()
    writer = QPdfWriter(buffer)
    writer.setTitle(title_of(widget))
    writer.setCreator("Rasterscope")
    points = QSizeF(widget.size()) * 0.75
    writer.setPageSize(QPageSize(points, QPageSize.Unit.Point, "", QPageSize.SizeMatchPolicy.ExactMatch))
    writer.setPageMargins(QMarginsF())
    writer.setResolution(1200)
    with QPainter(writer) as painter:
        painter.scale(1200 / 96, 1200 / 96)
        painter.setRenderHint(QPainter.RenderHint.LosslessImageRendering)
        paint_tree(widget, painter)
    return bytes(buffer.data().data())


def title_of(widget: QWidget) -> str:
    """Return what a drawing of a widget is called."""
    return widget.accessibleName() or widget.windowTitle() or "Rasterscope"


def _open_buffer() -> QBuffer:
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    return buffer


# A view on one sheet of paper, with the sentence and the formula of its step under it; and printing it.


MARGIN = 16
"""Logical pixels around what stands on a sheet."""
CHARACTERS = 70
"""Heights of the text that a sheet is wide, at most: it is read on paper, too."""
LARGEST_SCALE = 2.0
"""Most that a sheet is enlarged on paper: a small view does not fill a page."""


class ViewSheet(QWidget):
    """A view as it is seen, in the present theme, with what its page says of it."""

    def __init__(self, view: QWidget, caption: Caption, title: str = "") -> None:
        super().__init__()
        theme = current_theme()
        self.setAccessibleName(view.accessibleName())
        self.setFont(text_font(theme, max(theme.text_px, view.width() // CHARACTERS)))
        self.setStyleSheet(f"{style_sheet(theme)} * {{ background: {theme.panel}; }}")
        self.setFixedWidth(view.width() + 2 * MARGIN)
        rows = column_layout(self, 12, margins=(MARGIN, MARGIN, MARGIN, MARGIN))
        if title:
            rows.addWidget(text_label(title, self, "title", wraps=True))
        rows.addWidget(Portrait(view, self))
        if caption.sentence:
            label = text_label(caption.sentence, self, wraps=True)
            label.setTextFormat(Qt.TextFormat.PlainText)
            rows.addWidget(label)
        if caption.formula is not None:
            formula = FormulaView(self)
            formula.ensurePolished()
            formula.show_formula(caption.formula)
            while not formula.is_complete():
                QCoreApplication.processEvents()
                QThread.msleep(1)
            formula.setFixedHeight(formula.heightForWidth(view.width()))
            rows.addWidget(formula)
        self.adjustSize()
        self.grab()  # The first painting is what lays texts and formula out.

    def print_on(self, printer: "QPrinter") -> None:
        """Print on one page, as large as it fits, at the top.

        Qt gives a printer every widget as a picture of the printer's own resolution, which takes seconds and leaves
        no text: the sheet is recorded first, as vectors, and played back.
        """
        recorded = QPicture()
        with QPainter(recorded) as painter:
            paint_tree(self, painter)
        is_wide = self.width() > self.height()
        printer.setPageOrientation(
            QPageLayout.Orientation.Landscape if is_wide else QPageLayout.Orientation.Portrait
        )
        page, inch = printer.pageRect(printer.Unit.DevicePixel), printer.resolution() / 96
        scale = min(page.width() / self.width(), page.height() / self.height(), LARGEST_SCALE * inch)
        with QPainter(printer) as painter:
            painter.translate((page.width() - scale * self.width()) / 2, 0)
            own = (
                scale * recorded.logicalDpiX() / printer.logicalDpiX()
            )  # Qt itself goes from inches to inches.
            painter.scale(own, own)
            painter.setRenderHint(QPainter.RenderHint.LosslessImageRendering)
            painter.drawPicture(0, 0, recorded)
