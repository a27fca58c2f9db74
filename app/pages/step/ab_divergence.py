"""Where A and B do something different first: the search, and what is said of it."""

from core import Trace
from core.study.accuracy.divergence import Divergence, is_same_schedule, stage_divergence
from core.trace import StageTrace

ALIKE = "A and B do the same in every stage."
REORDERED = "A and B give the same results; only the order of their steps differs."
ORDERED_STAGES = ("bin", "raster", "depth")
"""Stages in which methods may do the same in another order."""


def report(found: Divergence | None, first: Trace, second: Trace) -> str:
    """Return in words where two runs differ first."""
    if found is None:
        is_same_order = all(
            is_same_schedule(first.stage(stage), second.stage(stage)) for stage in ORDERED_STAGES
        )
        return ALIKE if is_same_order else REORDERED
    where = f"pixel {found.pixel}" if found.pixel is not None else f"triangle {found.triangle}"
    if None in found.rows:
        said = f"{'AB'[found.rows.index(None)]} has no step there"
    else:
        said = f"they differ in {', '.join(name.replace('color', 'colour') for name in found.names)}"
    return f"First divergence, at {where}: {said}. Ctrl+[ goes back."


def rows_about(
    first: StageTrace, second: StageTrace, pixel: tuple[int, int]
) -> tuple[int | None, int | None]:
    """Return the rows about a pixel in which two runs differ first, or else the first row about it of each."""
    found = stage_divergence(first, second, by_outcome=True)
    if found is not None and found.pixel == pixel:
        return found.rows
    rows = [stage.rows_at_pixel(*pixel) for stage in (first, second)]
    mine, theirs = (int(each[0]) if len(each) else None for each in rows)
    return mine, theirs
