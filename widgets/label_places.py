"""Where words go beside points: the first of eight places that is free, so that no two words overlap."""

from PySide6.QtCore import QPointF, QRectF, QSizeF

_DIRECTIONS = ((1, -1), (1, 1), (-1, -1), (-1, 1), (0, -1), (0, 1), (1, 0), (-1, 0))

FURTHER = (1.0, 2.5, 5.0)


class LabelPlaces:
    """Remembers what is taken in an area and finds free places in it."""

    def __init__(self, area: QRectF) -> None:
        self._area = area
        self._taken: list[QRectF] = []

    def take(self, rect: QRectF) -> None:
        """Keep a rectangle free of words."""
        self._taken.append(rect)

    def find(
        self, point: QPointF, size: QSizeF, reach: float, further: tuple[float, ...] = FURTHER
    ) -> QRectF | None:
        """Return a rectangle of ``size`` beside ``point``, ``reach`` away from it, or None if all is taken.

        Where that is taken, ``further`` away: multiples of ``reach``, the nearest first. A point outside of the area
        has no place.
        """
        if not self._area.adjusted(-1, -1, 1, 1).contains(point):
            return None
        for times in further:
            for across, down in _DIRECTIONS:
                rect = QRectF(QPointF(), size)
                rect.moveCenter(
                    QPointF(
                        point.x() + across * (reach * times + size.width() / 2),
                        point.y() + down * (reach * times + size.height() / 2),
                    )
                )
                if self._area.contains(rect) and not any(rect.intersects(other) for other in self._taken):
                    self._taken.append(rect)
                    return rect
        return None
