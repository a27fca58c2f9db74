"""Which part of a segment lies in a rectangle, in rational arithmetic: the largest and the least parameter."""

from fractions import Fraction

from core.records.arrays import Floats

Ends = tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]


def clipped_ends(segment: Floats, window: tuple[float, float, float, float]) -> Ends | None:
    """Return both ends of the part of a segment (2, 2) inside (left, bottom, right, top); ``None``: nothing is.

    Notes
    -----
    The border is inside; a segment of no length is a point. Every coordinate alone bounds t from both sides.

    Examples
    --------
    >>> [[float(value) for value in end] for end in clipped_ends([[-2, 1], [6, 5]], (0, 0, 4, 3))]
    [[0.0, 2.0], [2.0, 3.0]]
    """
    first, second = ([Fraction(float(value)) for value in end] for end in segment)
    left, bottom, right, top = (Fraction(value) for value in window)
    low, high = Fraction(0), Fraction(1)
    for start, end, least, largest in (
        (first[0], second[0], left, right),
        (first[1], second[1], bottom, top),
    ):
        if start == end:
            if not least <= start <= largest:
                return None
            continue
        crossings = sorted([(least - start) / (end - start), (largest - start) / (end - start)])
        low, high = max(low, crossings[0]), min(high, crossings[1])
    if low > high:
        return None

    def at(t: Fraction) -> tuple[Fraction, Fraction]:
        return first[0] + t * (second[0] - first[0]), first[1] + t * (second[1] - first[1])

    return at(low), at(high)
