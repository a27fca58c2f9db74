"""Where words go beside points: the first of the places around that is free, so that no two words overlap."""

from PySide6.QtCore import QPointF, QRectF, QSizeF

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

        Where that is taken, ``further`` away: multiples of ``reach``, the nearest first. A point outside of the area
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
    return any(rect.intersects(other) for other in others)
