"""Words in drawings: captions, sentences in empty areas, and free places for names beside points."""

from functools import lru_cache

from PySide6.QtCore import QPointF, QRect, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter

from widgets.basics.theme import Theme, text_font

_DIRECTIONS = ((1, -1), (1, 1), (-1, -1), (-1, 1), (0, -1), (0, 1), (1, 0), (-1, 0))

FURTHER = (1.0, 2.5, 5.0)


class LabelPlaces:
    """Remembers what is taken in an area and finds free places in it."""

    def __init__(self, area: QRectF) -> None:
        self._area = area
        self._taken: list[QRectF] = []
        self._avoided: list[QRectF] = []

    def take(self, rect: QRectF) -> None:
        """Keep a rectangle free of words."""
        self._taken.append(rect)

    def avoid(self, rect: QRectF) -> None:
        """Keep a rectangle free of words that have another place."""
        self._avoided.append(rect)

    def find(
        self, point: QPointF, size: QSizeF, reach: float, further: tuple[float, ...] = FURTHER
    ) -> QRectF | None:
        """Return a rectangle of ``size`` beside ``point``, ``reach`` away from it, or None if all is taken.

        Where that is taken, ``further`` away: multiples of ``reach``, the nearest first. A point outside the area
        has no place.
        """
        if not self._area.adjusted(-1, -1, 1, 1).contains(point):
            return None
        free = (
            rect
            for times in further
            for direction in _DIRECTIONS
            if self._is_free(rect := _beside(point, size, reach * times, direction))
        )
        best = next(free, None)
        if best is not None and _meets(best, self._avoided):
            best = next((rect for rect in free if not _meets(rect, self._avoided)), best)
        if best is not None:
            self._taken.append(best)
        return best

    def _is_free(self, rect: QRectF) -> bool:
        return self._area.contains(rect) and not _meets(rect, self._taken)


def _beside(point: QPointF, size: QSizeF, away: float, direction: tuple[int, int]) -> QRectF:
    across, down = direction
    rect = QRectF(QPointF(), size)
    rect.moveCenter(point + QPointF(across * (away + size.width() / 2), down * (away + size.height() / 2)))
    return rect


def _meets(rect: QRectF, others: list[QRectF]) -> bool:
    return any(map(rect.intersects, others))


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
