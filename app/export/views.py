"""A view as a picture (PNG), a drawing (SVG) or a page (PDF), on the clipboard, and on a sheet with its words."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QBuffer, QCoreApplication, QIODevice, QMarginsF, QSize, QSizeF, Qt, QThread
from PySide6.QtGui import QGuiApplication, QImage, QPageLayout, QPageSize, QPainter, QPdfWriter, QPicture
from PySide6.QtWidgets import QWidget

from app.export.painting import Portrait, drawn_image, paint_tree, seen_image, svg_text
from app.files.file_access import VIEW_ENDINGS, write_file
from app.pages.page_bar import Caption
from widgets.basics.controls import column_layout, text_label
from widgets.basics.style_sheet import style_sheet
from widgets.basics.theme import current_theme, text_font
from widgets.inspector.formula_view import FormulaView

if TYPE_CHECKING:
    from PySide6.QtPrintSupport import QPrinter


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
