"""A page of paper made of the window's own charts and maps: a title, the figures, and where they come from."""

import os
from collections.abc import Callable, Iterable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QHBoxLayout, QLabel, QWidget

from app.export.painting import seen_image, svg_text
from app.export.views import png_bytes
from widgets.basics.controls import column_layout
from widgets.basics.style_sheet import style_sheet
from widgets.basics.theme import LIGHT, paint_as, text_font
from widgets.experiments.chart import Chart
from widgets.experiments.series import ChartEmpty, ChartLegend, ChartPicture

ENDINGS = (".svg", ".png")
"""Kinds of files that a sheet is written to."""
WIDTH = 1100
"""Logical pixels, with a `MARGIN` on each side."""
MARGIN = 20
SHARPNESS = 2.0
"""Pixels of a PNG file to a logical pixel, so that it stays sharp on dense screens."""


class Sheet(QWidget):
    """Texts and widgets under each other, always in the light theme."""

    def __init__(self, title: str, subtitle: str) -> None:
        super().__init__()
        self.setAccessibleName(title)
        self.setFont(text_font(LIGHT))
        self.setStyleSheet(f"{style_sheet(LIGHT)} * {{ background: {LIGHT.panel}; }}")
        self.setFixedWidth(WIDTH)
        self._rows = column_layout(self, 4, margins=(MARGIN, 16, MARGIN, 16))
        self.write([title], "title")
        self.write([subtitle], "muted")

    def write(self, lines: Iterable[str], role: str = "muted") -> None:
        """Add paragraphs of text."""
        for line in lines:
            label = QLabel(line, self, textFormat=Qt.TextFormat.PlainText, wordWrap=True)
            label.setProperty("role", role)
            self._rows.addWidget(label)

    def add(self, widget: QWidget) -> None:
        """Add a widget of the whole width."""
        self._rows.addWidget(widget)

    def draw(self, picture: ChartPicture | ChartEmpty, height: int) -> None:
        """Add a chart with the list of its series beside it, as high as ``height`` or the list; or say why not."""
        if isinstance(picture, ChartEmpty):
            self.write([picture.text])
            return
        chart, legend = Chart("", self), ChartLegend(self)
        chart.show_picture(picture)
        legend.show_series(picture.series, picture.front)
        legend.setFixedWidth(legend.sizeHintForColumn(0) + legend.fontMetrics().height())
        chart.setFixedHeight(max(height, (legend.count() + 1) * legend.sizeHintForRow(0)))
        row = QHBoxLayout()
        row.addWidget(chart, 1)
        row.addWidget(legend)
        self._rows.addLayout(row)


def sheet_bytes(make: Callable[[], Sheet], ending: str) -> bytes:
    """Return the sheet that ``make()`` makes as a file with one of `ENDINGS`; text in an SVG file stays text.

    It needs Qt's widgets and no display; where no application runs yet, as on the command line, one is made.
    """
    if QApplication.instance() is None:
        os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    application = QApplication.instance() or QApplication(["rasterscope"])
    with paint_as(LIGHT):
        sheet = make()
        sheet.adjustSize()
        sheet.grab()  # The first painting is what lays charts out.
        content = (
            svg_text(sheet, sheet.accessibleName()).encode()
            if ending == ".svg"
            else png_bytes(seen_image(sheet, SHARPNESS))
        )
        sheet.deleteLater()
    del application
    return content
