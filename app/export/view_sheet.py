"""A view on one sheet of paper, with the sentence and the formula of its step under it; and printing it."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication, Qt, QThread
from PySide6.QtGui import QPageLayout, QPainter, QPicture
from PySide6.QtWidgets import QWidget

from app.export.paint import Portrait, paint_tree
from app.pages.page_bar import Caption
from widgets.basics.controls import column_layout
from widgets.basics.labels import text_label
from widgets.basics.style_sheet import style_sheet
from widgets.basics.theme import current_theme, text_font
from widgets.inspector.formula_view import FormulaView

if TYPE_CHECKING:
    from PySide6.QtPrintSupport import QPrinter

MARGIN = 16
"""Logical pixels around what stands on a sheet."""
CHARACTERS = 70
"""Heights of the text that a sheet is wide, at most: it is read on paper, too."""
LARGEST = 2.0
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
        scale = min(page.width() / self.width(), page.height() / self.height(), LARGEST * inch)
        with QPainter(printer) as painter:
            painter.translate((page.width() - scale * self.width()) / 2, 0)
            own = (
                scale * recorded.logicalDpiX() / printer.logicalDpiX()
            )  # Qt itself goes from inches to inches.
            painter.scale(own, own)
            painter.setRenderHint(QPainter.RenderHint.LosslessImageRendering)
            painter.drawPicture(0, 0, recorded)
