"""What B does otherwise: at first something that shows in the stage at hand; and the same in words."""

from collections.abc import Iterator
from dataclasses import replace

from app.session.document import Document
from app.session.tracing import QUICK_SECONDS
from core import Settings, Trace
from core.explain.stage_texts import family_title
from core.methods import table
from core.settings import FAMILIES, no_effect

FIRST_CHOICES = {
    "transform": (("depth", "reversed-z"),),
    "edges": (("coverage", "float32"),),
    "bin": (("fill", "hierarchy"), ("fill", "blocks")),
    "raster": (("line", "dda"), ("fill", "scanline"), ("fill_rule", "inclusive")),
    "interpolate": (("interpolation", "affine"),),
    "depth": (("visibility", "last-drawn"), ("visibility", "z-buffer"), ("depth", "z-16")),
    "blend": (("blend", "over"), ("blend", "additive")),
    "resolve": (("antialiasing", "msaa-4"),),
}
"""Stage to families and methods that are tried before the classical ones of the stage."""
BY_OUTCOME = frozenset({"depth"})
"""Stages in which other steps to the same result are no difference: where no triangle is hidden, B keeps the test."""
ANYWHERE = (("interpolation", "affine"), ("depth", "z-16"), ("fill", "scanline"))
"""What is tried where no method of the stage makes a difference."""


def first_difference(document: Document, trace: Trace, stage: str) -> dict[str, str | int]:
    """Return family and method in which B differs from a document at first.

    B can draw the scene, and does something else than the ``trace`` in the stage that is shown, if any method does.
    """
    # The window opens without the studies.
    from core.study.accuracy.divergence import is_same_schedule, stage_divergence

    drawn: dict[str, str | int] = {}
    for family, method in _candidates(stage):
        settings = replace(document.settings, **{family: method})  # type: ignore[arg-type]
        other = replace(document, settings=settings)
        if settings == document.settings or no_effect(settings, family, document.scene):
            continue
        if other.estimated_seconds > QUICK_SECONDS:
            return {family: method}
        try:
            mine, theirs = trace.stage(stage), other.make_trace(earlier=trace).stage(stage)
        except ValueError:
            continue
        by_outcome = stage in BY_OUTCOME
        has_other_steps = not by_outcome and not is_same_schedule(mine, theirs)
        if has_other_steps or stage_divergence(mine, theirs, by_outcome) is not None:
            return {family: method}
        drawn = drawn or {family: method}
    return drawn


def _candidates(stage: str) -> Iterator[tuple[str, str]]:
    yield from FIRST_CHOICES.get(stage, ())
    for name, family in FAMILIES.items():
        if family.stage == stage:
            yield from ((name, method) for method in family.classical)
    yield from ANYWHERE


def settings_difference(mine: Settings, other: Settings) -> str:
    """Return in words what ``other`` does otherwise than ``mine``."""
    parts = []
    for name, value in mine.differences(other).items():
        text = table.get(name, value).title if isinstance(value, str) else str(value)
        parts.append(f"{family_title(name).lower()}: {text}")
    return ", ".join(parts)
