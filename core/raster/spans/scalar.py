"""Listings of the span engine: what it does with one triangle, one row, one pixel, to be read and executed."""

from math import ceil, floor

from core.raster.spans.lanes import ROUNDING_MARGIN, SUBPIXEL_GUARD


def rows_of_triangle(
    y: list[float], center: float, bounds: tuple[int, int], owns_bottom: bool, owns_top: bool
) -> tuple[int, int]:
    """Listing of the rows of a triangle: corners at y (3,) in pixels, bounds of the raster to first row and count."""
    low = min(y) - center - (SUBPIXEL_GUARD if owns_bottom else -SUBPIXEL_GUARD)
    high = max(y) - center - (-SUBPIXEL_GUARD if owns_top else SUBPIXEL_GUARD)
    first = min(max(ceil(low), bounds[0]), bounds[1])  #: first
    count = max(min(max(ceil(high), bounds[0]), bounds[1]) - first, 0)  #: count
    return first, count


def place_by_size(sizes: list[int], number: int) -> int:
    """Listing of the order of lanes (sizes (L,) in rows) and spans (in pixels): largest first, equals as they came."""
    own, before = sizes[number], 0
    for other, size in enumerate(sizes):
        before += size > own or (size == own and other < number)  #: place
    return before


def span_of_row(
    sides: list[tuple[float, float, float, float, bool]], y: float, start: int, stop: int, center: float
) -> tuple[int, int]:
    """Listing of one row: sides (x0, y0, x1, y1, owns tie), counter-clockwise, in pixels; columns start to stop."""
    for x0, y0, x1, y1, owns_tie in sides:
        dx, dy = x1 - x0, y1 - y0
        if dy == 0:  #: level
            continue
        crossing = ((x0 - center) * dy + (y - y0) * dx) * (1 / dy)  #: crossing
        is_left = dy < 0
        guard = ROUNDING_MARGIN
        if owns_tie == is_left:
            guard = -guard
        column = floor(crossing + (1 + guard))
        if is_left:
            start = max(start, column)  #: start
        else:
            stop = min(stop, column)  #: stop
    return start, max(start, stop)


def order_of_pixels(spans: list[tuple[int, int, int]]) -> list[tuple[int, int]]:
    """Listing of the passes: spans (row, start, stop), longest first, to pixels (column, row) as they are drawn."""
    drawn = []
    longest = spans[0][2] - spans[0][1] if spans else 0
    for k in range(longest):  #: pass
        for row, start, stop in spans:
            if start + k >= stop:
                break
            drawn.append((start + k, row))  #: draw
    return drawn
