"""What is said of triangles, said of segments and points: they go the same way, and have ends in place of corners."""

import re

_WORDS = {
    2: (
        (r", edge 0:", ":"),
        (r"edge 2 of triangle|triangle", "segment"),
        (r"(the )?edge 2\b", "the segment"),
        (r"edge", "segment"),
        (r"corner", "end"),
    ),
    1: (
        (r", edge 0:", ":"),
        (r"corner 0 of triangle|edge 2 of triangle|triangle", "point"),
        (r"(the )?edge 2\b", "the point"),
        (r"edge", "point"),
        (r"corner", "position"),
    ),
}
"""By the corners of a primitive, what is replaced by what."""


def of_kind(text: str, corner_count: int) -> str:
    """Return a sentence about triangles as one about primitives of so many corners."""
    for pattern, noun in _WORDS.get(corner_count, ()):
        text = re.sub(
            pattern,
            lambda found, noun=noun: noun.capitalize() if found[0][0].isupper() else noun,  # type: ignore[misc]
            text,
            flags=re.IGNORECASE,
        )
    return text
