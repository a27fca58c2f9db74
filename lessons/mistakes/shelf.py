"""The shelf of faulty twins, by name."""

from lessons.mistakes import clipping, coverage, fragments, lines
from lessons.mistakes.twin import Twin

SHELF = {twin.name: twin for twin in (*coverage.TWINS, *lines.TWINS, *clipping.TWINS, *fragments.TWINS)}
"""All twins, stage by stage."""


def twin_named(name: str) -> Twin:
    """Return a twin, or raise ValueError with the names that there are."""
    if name not in SHELF:
        raise ValueError(f"expected a mistake such as {', '.join(SHELF)}, got {name!r:.60}")
    return SHELF[name]
