"""A view as a picture (PNG), a drawing (SVG) or a page (PDF), and on the clipboard."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QBuffer, QIODevice, QMarginsF, QSize, QSizeF
from PySide6.QtGui import QGuiApplication, QImage, QPageSize, QPainter, QPdfWriter
from PySide6.QtWidgets import QWidget

from app.export.paint import drawn_image, paint_tree, seen_image
from app.export.svg import svg_text
from app.files.file_names import VIEW_ENDINGS
from app.files.file_writing import write_file
from widgets.inspector.formula_view import FormulaView


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
