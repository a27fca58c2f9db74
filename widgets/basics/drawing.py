"""What drawings have in common: small marks that tell outcomes apart, captions, and free places for names."""

from collections.abc import Callable
from enum import Enum
from functools import lru_cache

from PySide6.QtCore import QPointF, QRect, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QImage, QPainter, QPainterPath, QPen, QPixmap, QPolygonF

from widgets.basics.theme import CLEAR, Theme, contrast, current_theme, text_font

# The small shapes that tell outcomes apart: each kind has its own outline as well as its own colour.


class Mark(Enum):
    """What a shape says; the value is the word a legend uses."""

    COVERED = "covered"
    REJECTED = "rejected"
    TIE = "tie"
    NAN = "NaN"
    DEPTH_FAILED = "depth failed"
    PINNED = "pinned pixel"
    BREAKPOINT = "breakpoint"
    BOOKMARK = "bookmark"
    RIGHT = "right"
    WRONG = "wrong"
    INFORMATION = "information"
    WARNING = "warning"
    ERROR = "error"


def blended(color: str, ground: str, share: float) -> QColor:
    """Return `share` of a colour laid over a ground, both ``#rrggbb``; opaque."""
    top, bottom = QColor(color), QColor(ground)
    channels = [
        round(share * a + (1.0 - share) * b)
        for a, b in zip(top.getRgb()[:3], bottom.getRgb()[:3], strict=True)  # type: ignore[index]
    ]
    return QColor(*channels)


def paint_share(painter: QPainter, room: QRect, share: float) -> None:
    """Draw a bar in its room that is as long as a share of it, 0 to 1."""
    theme = current_theme()
    painter.fillRect(room, blended(theme.muted_text, theme.panel, 0.25))
    full = room.adjusted(0, 0, round(share * room.width()) - room.width(), 0)
    painter.fillRect(full, QColor(theme.muted_text))


def draw_mark(painter: QPainter, mark: Mark, box: QRectF, theme: Theme | None = None) -> None:
    """Draw a mark inside a square box with the painter's present transform.

    Parameters
    ----------
    painter : QPainter
        Active painter; its state is restored.
    mark : Mark
        Which shape.
    box : QRectF
        Square that the shape fills, in logical pixels.
    theme : Theme, optional
        Default: the present one.
    """
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    _PAINTERS[mark](painter, box, theme or current_theme())
    painter.restore()


def mark_pixmap(mark: Mark, side: int, ratio: float = 1.0) -> QPixmap:
    """Return a mark as a pixmap of `side` logical pixels at a device pixel ratio."""
    return QPixmap.fromImage(mark_image(mark, side, ratio, 0.5, current_theme()))


@lru_cache(maxsize=64)
def mark_image(mark: Mark, side: int, ratio: float, margin: float, theme: Theme) -> QImage:
    """Return a mark as an image of `side` logical pixels at a device pixel ratio, with a `margin` around it."""
    image = QImage(round(side * ratio), round(side * ratio), QImage.Format.Format_ARGB32_Premultiplied)
    image.setDevicePixelRatio(ratio)
    image.fill(0)
    with QPainter(image) as painter:
        draw_mark(painter, mark, QRectF(margin, margin, side - 2 * margin, side - 2 * margin), theme)
    return image


def _pen(color: str, box: QRectF, share: float = 0.16) -> QPen:
    pen = QPen(QColor(color), max(1.4, box.width() * share))
    pen.setCapStyle(Qt.PenCapStyle.RoundCap)
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    return pen


def _inset(box: QRectF, share: float) -> QRectF:
    step = box.width() * share
    return box.adjusted(step, step, -step, -step)


def _covered(painter: QPainter, box: QRectF, theme: Theme) -> None:
    painter.setPen(QPen(QColor(theme.text), max(0.8, box.width() * 0.07)))
    painter.setBrush(QColor(theme.covered))
    painter.drawRect(_inset(box, 0.14))


def _cross(painter: QPainter, box: QRectF, color: str, share: float = 0.2) -> None:
    inner = _inset(box, 0.18)
    painter.setPen(_pen(color, box, share))
    painter.drawLine(inner.topLeft(), inner.bottomRight())
    painter.drawLine(inner.bottomLeft(), inner.topRight())


def _rejected(painter: QPainter, box: QRectF, theme: Theme) -> None:
    if contrast(theme.rejected, theme.canvas) < CLEAR:
        _cross(painter, box, theme.text, 0.34)
    _cross(painter, box, theme.rejected)


def _tie(painter: QPainter, box: QRectF, theme: Theme) -> None:
    ring = _inset(box, 0.2)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.text), max(2.4, box.width() * 0.34)))
    painter.drawEllipse(ring)
    painter.setPen(QPen(QColor(theme.tie), max(1.2, box.width() * 0.2)))
    painter.drawEllipse(ring)


def _nan(painter: QPainter, box: QRectF, theme: Theme) -> None:
    square = _inset(box, 0.1)
    half = square.width() / 2
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    painter.fillRect(square, QColor(theme.nan_light))
    painter.fillRect(QRectF(square.left(), square.top(), half, half), QColor(theme.nan_dark))
    painter.fillRect(QRectF(square.left() + half, square.top() + half, half, half), QColor(theme.nan_dark))
    painter.setPen(QPen(QColor(theme.nan_dark), 1.0))
    painter.drawRect(square)


def _depth_failed(painter: QPainter, box: QRectF, theme: Theme) -> None:
    inner = _inset(box, 0.12)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(theme.muted_text))
    corners = [inner.topLeft(), inner.topRight(), QPointF(inner.center().x(), inner.bottom())]
    painter.drawPolygon(QPolygonF(corners))


def _pinned(painter: QPainter, box: QRectF, theme: Theme) -> None:
    inner = _inset(box, 0.06)
    middle = inner.center()
    painter.setPen(_pen(theme.text, box, 0.12))
    painter.setBrush(QColor(theme.panel))
    corners = [
        QPointF(middle.x(), inner.top()),
        QPointF(inner.right(), middle.y()),
        QPointF(middle.x(), inner.bottom()),
        QPointF(inner.left(), middle.y()),
    ]
    painter.drawPolygon(QPolygonF(corners))


def _breakpoint(painter: QPainter, box: QRectF, theme: Theme) -> None:
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(theme.bad))
    painter.drawEllipse(_inset(box, 0.08))


def _bookmark(painter: QPainter, box: QRectF, theme: Theme) -> None:
    inner = box.adjusted(box.width() * 0.2, 0.0, -box.width() * 0.2, 0.0)
    path = QPainterPath(inner.topLeft())
    path.lineTo(inner.topRight())
    path.lineTo(inner.bottomRight())
    path.lineTo(inner.center().x(), inner.bottom() - inner.height() * 0.3)
    path.lineTo(inner.bottomLeft())
    path.closeSubpath()
    painter.fillPath(path, QColor(theme.text))


def _right(painter: QPainter, box: QRectF, theme: Theme) -> None:
    inner = _inset(box, 0.14)
    painter.setPen(_pen(theme.good, box, 0.2))
    middle = QPointF(inner.left() + inner.width() * 0.36, inner.bottom() - inner.height() * 0.08)
    painter.drawLine(QPointF(inner.left(), inner.center().y() + inner.height() * 0.08), middle)
    painter.drawLine(middle, QPointF(inner.right(), inner.top() + inner.height() * 0.1))


def _wrong(painter: QPainter, box: QRectF, theme: Theme) -> None:
    _cross(painter, box, theme.bad)


def _letter(painter: QPainter, box: QRectF, color: str, *, is_information: bool) -> None:
    """Draw the dot and stroke of an i or of an exclamation mark."""
    middle = box.center().x()
    stroke, dot = box.height() * 0.28, box.height() * 0.07
    painter.setPen(_pen(color, box, 0.12))
    first, last = box.center().y() - stroke * 0.75, box.center().y() + stroke * 0.75
    if is_information:
        painter.drawLine(QPointF(middle, box.center().y() - dot), QPointF(middle, last))
        painter.drawPoint(QPointF(middle, first))
    else:
        painter.drawLine(QPointF(middle, first), QPointF(middle, box.center().y() + dot))
        painter.drawPoint(QPointF(middle, last))


def _information(painter: QPainter, box: QRectF, theme: Theme) -> None:
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(theme.muted_text))
    painter.drawEllipse(_inset(box, 0.04))
    _letter(painter, box, theme.panel, is_information=True)


def _warning(painter: QPainter, box: QRectF, theme: Theme) -> None:
    inner = _inset(box, 0.04)
    painter.setPen(_pen(theme.text, box, 0.09))
    painter.setBrush(QColor(theme.tie))
    painter.drawPolygon(
        QPolygonF([QPointF(inner.center().x(), inner.top()), inner.bottomRight(), inner.bottomLeft()])
    )
    _letter(painter, box.translated(0.0, box.height() * 0.14), "#000000", is_information=False)


def _error(painter: QPainter, box: QRectF, theme: Theme) -> None:
    inner = _inset(box, 0.04)
    cut = inner.width() * 0.29
    corners = [
        QPointF(inner.left() + cut, inner.top()),
        QPointF(inner.right() - cut, inner.top()),
        QPointF(inner.right(), inner.top() + cut),
        QPointF(inner.right(), inner.bottom() - cut),
        QPointF(inner.right() - cut, inner.bottom()),
        QPointF(inner.left() + cut, inner.bottom()),
        QPointF(inner.left(), inner.bottom() - cut),
        QPointF(inner.left(), inner.top() + cut),
    ]
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(theme.bad))
    painter.drawPolygon(QPolygonF(corners))
    _letter(painter, box, theme.panel, is_information=False)


_PAINTERS: dict[Mark, Callable[[QPainter, QRectF, Theme], None]] = {
    Mark.COVERED: _covered,
    Mark.REJECTED: _rejected,
    Mark.TIE: _tie,
    Mark.NAN: _nan,
    Mark.DEPTH_FAILED: _depth_failed,
    Mark.PINNED: _pinned,
    Mark.BREAKPOINT: _breakpoint,
    Mark.BOOKMARK: _bookmark,
    Mark.RIGHT: _right,
    Mark.WRONG: _wrong,
    Mark.INFORMATION: _information,
    Mark.WARNING: _warning,
    Mark.ERROR: _error,
}


# Words in drawings: captions, sentences in empty areas, and free places for names beside points.


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
