"""The chart as a PNG file: Qt draws the SVG, without a display."""

import os
from typing import BinaryIO

SCALE = 2
"""Pixels of the file for one of the chart, so that it stays sharp on dense screens."""


def write_png(file: BinaryIO, svg: str) -> None:
    """Draw an SVG text and write it as PNG."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from PySide6.QtCore import QByteArray
    from PySide6.QtGui import QGuiApplication, QImage, QPainter
    from PySide6.QtSvg import QSvgRenderer

    from app.export.views import png_bytes

    application = QGuiApplication.instance() or QGuiApplication(["rasterscope"])
    renderer = QSvgRenderer(QByteArray(svg.encode("utf-8")))
    image = QImage(renderer.defaultSize() * SCALE, QImage.Format.Format_RGB32)
    painter = QPainter(image)
    renderer.render(painter)
    painter.end()
    file.write(png_bytes(image))
    del application
