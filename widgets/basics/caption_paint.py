"""The caption at the foot of a drawing, and the sentence in the middle of an empty one."""

from functools import lru_cache

from PySide6.QtCore import QRect, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter

from widgets.basics.theme import Theme, text_font

_FLAGS = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop | Qt.TextFlag.TextWordWrap


@lru_cache(maxsize=64)
def caption_height(text: str, width: float, theme: Theme) -> float:
    """Return the height in logical pixels that a caption takes, 0 for none."""
    if not text:
        return 0.0
    room = QRectF(0, 0, max(width - 4 * theme.unit, 60), 10000)
    return QFontMetricsF(text_font(theme)).boundingRect(room, int(_FLAGS), text).height() + 3 * theme.unit


def paint_caption(painter: QPainter, area: QRect, text: str, theme: Theme) -> None:
    """Write a caption at the foot of an area."""
    if not text:
        return
    height = caption_height(text, area.width(), theme)
    strip = QRectF(area.left(), area.bottom() + 1 - height, area.width(), height)
    painter.fillRect(strip, QColor(theme.panel))
    painter.setFont(text_font(theme))
    painter.setPen(QColor(theme.muted_text))
    inner = strip.adjusted(2 * theme.unit, theme.unit, -2 * theme.unit, -theme.unit)
    painter.drawText(inner, int(_FLAGS), text)


def paint_empty(painter: QPainter, area: QRect, text: str, theme: Theme) -> None:
    """Say in the middle of an area why there is nothing."""
    painter.fillRect(area, QColor(theme.panel))
    painter.setFont(text_font(theme))
    painter.setPen(QColor(theme.muted_text))
    flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
    painter.drawText(area.adjusted(16, 16, -16, -16), int(flags), text)
