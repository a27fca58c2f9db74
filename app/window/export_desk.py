"""The view as a file, on the clipboard and on paper, with the sentence and the formula of its step."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication, QWidget

from app.export.view_sheet import ViewSheet
from app.export.views import copy_widget, export_widget
from app.files.file_dialogs import SaveDialog
from app.pages.page_bar import Pages
from widgets.basics.message_bar import Message, MessageKind
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import LIGHT, current_theme

SCALES = (1, 2, 4, 8)
"""Pixels of a picture to a pixel of the screen's picture that can be chosen."""


class ExportActions(QObject):
    """Exports, copies and prints the main view of the page that is shown."""

    message_sent = Signal(object)
    """A ``Message`` about what became of it."""

    def __init__(self, pages: Pages, window: QWidget) -> None:
        super().__init__(window)
        self._pages = pages
        self.scale = 1
        """Of pictures, one of `SCALES`."""
        self.has_caption = False
        """Whether the sentence and the formula stand under the view."""

    @Slot(int)
    def set_scale(self, scale: int) -> None:
        """Choose how many pixels pictures have to a pixel of the screen's."""
        self.scale = scale

    def ask_export(self) -> None:
        """Ask where the view is to go, and export it."""
        kinds = "PNG picture (*.png);;SVG drawing (*.svg);;PDF page (*.pdf)"
        name = f"{self._pages.file_stem()}.png"
        path = SaveDialog(self._pages.window(), "Export view", name, kinds).ask()
        if path:
            self.export_to(path)

    def export_to(self, path: str) -> None:
        """Export the view by the ending of the file, and confirm it."""
        try:
            with self._figure() as figure:
                export_widget(figure, path, self._scale())
        except (OSError, ValueError) as error:
            self._tell(f"The view was not exported: {error}", MessageKind.ERROR)
            return
        name = Path(path).name
        size = QImage(path).size() if name.lower().endswith(".png") else None
        self._tell(f"Exported {name}" + (f", {size.width()} × {size.height()} pixels." if size else "."))

    def copy(self) -> None:
        """Put the view on the clipboard as a picture, and confirm it."""
        with self._figure() as figure:
            size = copy_widget(figure, self._scale())
        self._tell(f"Copied the view, {size.width()} × {size.height()} pixels.")

    def print_view(self, title: str) -> None:
        """Show the view with sentence and formula on one page, to be printed."""
        from PySide6.QtPrintSupport import QPrinter, QPrintPreviewDialog  # Only who prints waits for it.

        page = self._pages.current
        with _as_on_paper():
            page.settle()
            sheet = ViewSheet(page.main_view(), page.caption(), title)
            printer = QPrinter(QPrinter.PrinterMode.HighResolution)
            printer.setDocName(title or "Rasterscope")
            printer.setCreator("Rasterscope")
            dialog = QPrintPreviewDialog(printer, self._pages.window())
            dialog.setWindowTitle("Print view")
            # Qt's own size is that of its buttons: a page of a few pixels.
            dialog.resize(self._pages.window().size() * 0.9)
            dialog.paintRequested.connect(sheet.print_on)
            if dialog.exec():
                self._tell("Printed the view.")
            dialog.deleteLater()
            sheet.deleteLater()

    @contextmanager
    def _figure(self) -> Iterator[QWidget]:
        """Yield what is to be exported: the view, or a sheet with what its page says of it."""
        page = self._pages.current
        caption = page.caption()
        if not (self.has_caption and (caption.sentence or caption.formula)):
            yield page.main_view()
            return
        sheet = ViewSheet(page.main_view(), caption)
        yield sheet
        sheet.deleteLater()

    def _scale(self) -> float | None:
        """Return the pixels of a picture to a logical pixel; ``None``: those of the screen."""
        return None if self.scale == 1 else self.scale * self._pages.devicePixelRatioF()

    def _tell(self, text: str, kind: MessageKind = MessageKind.INFORMATION) -> None:
        self.message_sent.emit(Message(kind, text))


@contextmanager
def _as_on_paper() -> Iterator[None]:
    """Show the window in a light theme meanwhile: dark views would cover a page with ink."""
    theme, application = current_theme(), QApplication.instance()
    assert isinstance(application, QApplication)
    if theme.is_dark:
        apply_theme(application, LIGHT)
    try:
        yield
    finally:
        apply_theme(application, theme)
