"""The words of a pixel's history where pixels are cut into pieces: who covers how much of it."""

from collections.abc import Sequence
from math import isclose

from core.explain.number_text import spoken

MOST_NAMED = 4
"""Triangles that are named in the first line; of more the ones with the largest pieces are."""


def share_name(area: float) -> str:
    """Return how much of a pixel in words: ``all of the pixel``, ``almost all of``, ``0.25 of the pixel``."""
    if is_same(area, 1.0):
        return "all of the pixel"
    share = spoken(area)
    return f"{'almost all' if share == '1' else share} of the pixel"


def is_same(first: float, second: float) -> bool:
    """Tell whether two areas differ by no more than rounding, in pixels."""
    return isclose(first, second, rel_tol=0.0, abs_tol=1e-9)


def pieces_verdict(shown: Sequence[tuple[int, float]], background: float, is_blended: bool) -> str:
    """Return the first line of a pixel: which triangles are seen in how much of it.

    Parameters
    ----------
    shown : sequence of (int, float)
        Triangles that are seen and their areas, in pixels.
    background : float
        The area that shows none.
    is_blended : bool
        Whether triangles are transparent: the last one lies on others.
    """
    if not shown:
        return "No triangle is seen in any part of the pixel."
    verb = "lies on top in" if is_blended else "is seen in"
    largest = sorted(shown, key=lambda each: -each[1])
    parts = [f"Triangle {largest[0][0]} {verb} {share_name(largest[0][1])}"]
    parts += [f"triangle {triangle} in {spoken(area)}" for triangle, area in largest[1:MOST_NAMED]]
    rest = largest[MOST_NAMED:]
    if rest:
        parts.append(f"{len(rest)} more in {spoken(sum(area for _, area in rest))}")
    if not is_same(background, 0.0):
        parts.append(f"none in {spoken(background)}")
    return f"{', '.join(parts)}."


def piece_reason(area: float, passed: float, seen: float) -> str:
    """Return how much of the pixel a triangle covers, and what became of that, all in pixels.

    Parameters
    ----------
    area : float
        What lies inside its edges.
    passed : float
        What passed the depth test, when it was drawn.
    seen : float
        What is seen of it when everything is drawn.
    """
    covers = f"covers {share_name(area)}"
    if is_same(passed, 0.0):
        return f"{covers}, none of it passes the depth test"
    through = "" if is_same(passed, area) else f", {spoken(passed)} of it passes the depth test"
    if is_same(seen, passed):
        return f"{covers}{through}"
    later = "nothing of it is seen" if is_same(seen, 0.0) else f"{spoken(seen)} is seen"
    return f"{covers}{through}; {later} in the end"
