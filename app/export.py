"""A view as a picture (PNG), a drawing (SVG) or a page (PDF), on the clipboard, and a table as CSV."""

import csv
from collections.abc import Callable, Iterable, Sequence
from io import StringIO
from pathlib import Path

from PySide6.QtCore import QBuffer, QIODevice, QMarginsF, QPoint, QRect, QSizeF, Qt
from PySide6.QtGui import QGuiApplication, QImage, QPageSize, QPainter, QPdfWriter, QRegion
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import QWidget

from app.file_writing import whole_file
from widgets.formula import FormulaView
from widgets.grid_display import GridDisplay

ENDINGS = (".png", ".svg", ".pdf")
PNG_SCALE = 2.0
"""Device pixels of a picture to a logical pixel of the screen, so that it is sharp on a projector."""


def export_widget(widget: QWidget, path: str | Path, scale: float | None = None) -> None:
    """Write a widget as it is seen, in the format of the file's ending.

    Parameters
    ----------
    widget : QWidget
    path : str or Path
        Ends with ``.png``, ``.svg`` or ``.pdf``.
    scale : float, optional
        Pixels of a PNG to a logical pixel; by default that of the screen, at least 1.

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
        raise ValueError(f"the name of the file must end with {', '.join(ENDINGS)}, got {Path(path).name}")
    if widget.size().isEmpty():
        raise ValueError("this view has no size, there is nothing to export")
    content = makers[ending]()
    with whole_file(path) as file:
        file.write(content)


def copy_widget(widget: QWidget) -> None:
    """Put a widget, as it is seen, on the clipboard as a picture."""
    QGuiApplication.clipboard().setImage(widget_image(widget))


def write_table(path: str | Path, names: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Write a table as CSV (UTF-8, commas, a line of names first); raises OSError as ``export_widget``."""
    text = StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    writer.writerows(rows)
    with whole_file(path) as file:
        file.write(text.getvalue().encode())


def widget_image(widget: QWidget, scale: float | None = None) -> QImage:
    """Return a widget as it is seen; a formula alone, on a clear ground."""
    if isinstance(widget, FormulaView):
        return widget.to_image() if scale is None else widget.to_image(scale)
    ratio = max(widget.devicePixelRatioF(), 1.0) if scale is None else scale
    size = widget.size() * ratio
    image = QImage(size, QImage.Format.Format_ARGB32_Premultiplied)
    image.setDevicePixelRatio(ratio)
    image.fill(0)
    widget.render(image, QPoint())
    return image


def png_bytes(image: QImage) -> bytes:
    """Return an image as a PNG file."""
    buffer = _open_buffer()
    if not image.save(buffer, "PNG"):  # type: ignore[call-overload]
        raise ValueError(f"a picture of {image.width()}x{image.height()} pixels cannot be made")
    return bytes(buffer.data().data())


def svg_bytes(widget: QWidget) -> bytes:
    """Return a widget as an SVG file of its size in pixels; text stays text."""
    buffer = _open_buffer()
    generator = QSvgGenerator(QSvgGenerator.SvgVersion.Svg11)  # the tiny version cannot clip
    generator.setOutputDevice(buffer)
    generator.setSize(widget.size())
    generator.setViewBox(QRect(QPoint(), widget.size()))
    generator.setTitle(widget.accessibleName() or widget.windowTitle() or "Rasterscope")
    generator.setResolution(96)
    with QPainter(generator) as painter:
        paint_widget(widget, painter)
    return bytes(buffer.data().data())


def pdf_bytes(widget: QWidget) -> bytes:
    """Return a widget as a PDF file of one page that has its size, at 96 pixels an inch."""
    buffer = _open_buffer()
    writer = QPdfWriter(buffer)
    writer.setTitle(widget.accessibleName() or widget.windowTitle() or "Rasterscope")
    writer.setCreator("Rasterscope")
    points = QSizeF(widget.size()) * 0.75
    writer.setPageSize(QPageSize(points, QPageSize.Unit.Point, "", QPageSize.SizeMatchPolicy.ExactMatch))
    writer.setPageMargins(QMarginsF())
    writer.setResolution(1200)
    with QPainter(writer) as painter:
        painter.scale(1200 / 96, 1200 / 96)
        paint_widget(widget, painter)
    return bytes(buffer.data().data())


def paint_widget(widget: QWidget, painter: QPainter) -> None:
    """Paint a widget and what is in it at the origin; pixel grids as vectors, whatever they stand in."""
    if isinstance(widget, GridDisplay) and widget.buffer() is not None:
        widget.paint_to(painter)
        return
    if not any(grid.isVisibleTo(widget) for grid in widget.findChildren(GridDisplay)):
        widget.render(painter, QPoint())
        return
    # Qt would paint the grids from their kept pictures: every widget by itself, in the order they lie.
    widget.render(painter, QPoint(), QRegion(), QWidget.RenderFlag.DrawWindowBackground)
    for child in widget.children():
        if isinstance(child, QWidget) and child.isVisibleTo(widget) and not child.isWindow():
            painter.save()
            painter.translate(child.pos())
            painter.setClipRect(child.rect(), Qt.ClipOperation.IntersectClip)
            paint_widget(child, painter)
            painter.restore()


def _open_buffer() -> QBuffer:
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    return buffer
