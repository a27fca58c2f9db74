"""Where the names of points stand, so that none lies on another or on a mark."""

from collections.abc import Sequence
from dataclasses import dataclass

from app.export.svg_shapes import text_width

HEIGHT = 13
MARK = 6
"""Half the side of a mark in pixels."""


@dataclass(frozen=True)
class Box:
    """A rectangle in pixels, y downwards."""

    left: float
    top: float
    right: float
    bottom: float

    def overlaps(self, other: "Box") -> bool:
        """Whether two rectangles have a point in common."""
        is_beside = self.right <= other.left or other.right <= self.left
        return not (is_beside or self.bottom <= other.top or other.bottom <= self.top)

    def contains(self, other: "Box") -> bool:
        """Whether another rectangle lies inside."""
        is_wide = self.left <= other.left and other.right <= self.right
        return is_wide and self.top <= other.top and other.bottom <= self.bottom


@dataclass(frozen=True)
class Label:
    """A name and where it stands."""

    words: str
    box: Box
    is_far: bool
    """Whether a line has to lead to its mark."""
    anchor: tuple[float, float]
    """Where that line ends."""


def box_around(first: tuple[float, float], second: tuple[float, float]) -> Box:
    """Return the box of a line between two places, a little wider than it."""
    (x0, y0), (x1, y1) = first, second
    return Box(min(x0, x1) - 1, min(y0, y1) - 1, max(x0, x1) + 1, max(y0, y1) + 1)


def place_labels(
    places: list[tuple[float, float]], names: list[str], area: Box, obstacles: Sequence[Box] = ()
) -> list[Label]:
    """Put a name beside each mark, clear of marks, names and ``obstacles``: right, left, above, below, then farther."""
    taken = [*obstacles, *(Box(x - MARK, y - MARK, x + MARK, y + MARK) for x, y in places)]
    found = []
    for (x, y), words in zip(places, names, strict=True):
        label = next(
            (
                each
                for each in _candidates(x, y, words)
                if area.contains(each.box) and _is_free(each.box, taken)
            ),
            next(iter(_candidates(x, y, words))),
        )
        taken.append(label.box)
        found.append(label)
    return found


def _is_free(box: Box, taken: list[Box]) -> bool:
    return not any(box.overlaps(other) for other in taken)


def _candidates(x: float, y: float, words: str) -> list[Label]:
    """Return the places that are tried for one name, the best first."""
    width = text_width(words, 11)
    found = []
    for ring in range(24):
        reach = MARK + 4 + 14 * ring
        for left, top in (
            (x + MARK + 3, y - HEIGHT / 2 - 14 * ring),
            (x + MARK + 3, y - HEIGHT / 2 + 14 * ring),
            (x - MARK - 3 - width, y - HEIGHT / 2 - 14 * ring),
            (x - MARK - 3 - width, y - HEIGHT / 2 + 14 * ring),
            (x - width / 2, y - reach - HEIGHT),
            (x - width / 2, y + reach),
            (x + reach + 10, y - HEIGHT / 2 - 7 * ring),
            (x - reach - 10 - width, y - HEIGHT / 2 - 7 * ring),
        ):
            box = Box(left, top, left + width, top + HEIGHT)
            near_x = min(max(x, box.left), box.right)
            near_y = box.bottom if box.bottom < y else min(box.top, y) if box.top > y else y
            found.append(Label(words, box, ring > 0, (near_x, box.top if box.top > y else near_y)))
    return found


def spread_apart(heights: list[float], gap: float, top: float, bottom: float) -> list[float]:
    """Move heights apart so that neighbours are ``gap`` from each other, between ``top`` and ``bottom``."""
    order = sorted(range(len(heights)), key=lambda index: heights[index])
    moved = list(heights)
    lowest = top
    for index in order:
        moved[index] = lowest = max(heights[index], lowest)
        lowest += gap
    highest = bottom
    for index in reversed(order):
        moved[index] = highest = min(moved[index], highest)
        highest -= gap
    return moved
