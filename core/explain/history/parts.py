"""The words of a pixel's history where a pixel has parts: several samples, or pieces of exact area."""

from collections.abc import Sequence
from math import isclose

from core.explain.number_text import exact_text
from core.records.nouns import TRIANGLES, Nouns
from core.records.words import joined

MOST_NAMED = 4
"""Samples, or triangles with the largest pieces, that are named one by one."""

_OF_SAMPLE = {
    "no pixel centre": "no sample of this place",
    "the pixel centre": "the sample",
    "The pixel centre": "The sample",
    "the pixel is in": "the sample is in",
    "the pixel is outside": "the sample is outside",
    "this pixel": "this sample",
}
"""Words about a pixel's centre, and the same about a sample."""


def of_sample(text: str) -> str:
    """Return a sentence about a pixel's centre as one about a sample."""
    for of_center, of_one in _OF_SAMPLE.items():
        text = text.replace(of_center, of_one)
    return text


def samples_name(samples: Sequence[int]) -> str:
    """Return what samples are called: ``Sample 2``, ``Samples 0 and 3``, ``Samples 0, 1, 2 and 6 more``."""
    if len(samples) == 1:
        return f"Sample {samples[0]}"
    named = [str(sample) for sample in samples]
    if len(samples) > MOST_NAMED + 1:
        named = [*named[: MOST_NAMED - 1], f"{len(samples) - MOST_NAMED + 1} more"]
    return f"Samples {joined(named)}"


def samples_verdict(groups: Sequence[tuple[int, Sequence[int]]], count: int, drawn: Nouns = TRIANGLES) -> str:
    """Return the first line of a pixel of ``count`` samples: which of them show what.

    Parameters
    ----------
    groups : sequence of (int, sequence of int)
        A triangle, -1 for none, and the samples that show it.
    """
    parts: list[str] = []
    for triangle, samples in groups:
        what = f"{drawn.one} {triangle}" if triangle >= 0 else "none"
        number = f"all {count}" if len(samples) == count else f"{len(samples)} of {count}"
        parts.append(f"{number} samples show {what}" if not parts else f"{len(samples)} show {what}")
    text = ", ".join(parts)
    return f"{text[0].upper()}{text[1:]}."


def share_name(area: float) -> str:
    """Return how much of a pixel in words: ``all of the pixel``, ``almost all of``, ``0.25 of the pixel``."""
    if is_same(area, 1.0):
        return "all of the pixel"
    share = exact_text(area)
    return f"{'almost all' if share == '1' else share} of the pixel"


def is_same(first: float, second: float) -> bool:
    """Return whether two areas differ by no more than rounding, in pixels."""
    return isclose(first, second, rel_tol=0.0, abs_tol=1e-9)


def pieces_verdict(
    shown: Sequence[tuple[int, float]], background: float, is_blended: bool, drawn: Nouns = TRIANGLES
) -> str:
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
        return f"No {drawn.one} is visible in any part of the pixel."
    verb = "lies on top in" if is_blended else "is visible in"
    largest = sorted(shown, key=lambda each: -each[1])
    parts = [f"{drawn.one.capitalize()} {largest[0][0]} {verb} {share_name(largest[0][1])}"]
    parts += [f"{drawn.one} {triangle} in {exact_text(area)}" for triangle, area in largest[1:MOST_NAMED]]
    rest = largest[MOST_NAMED:]
    if rest:
        parts.append(f"{len(rest)} more in {exact_text(sum(area for _, area in rest))}")
    if not is_same(background, 0.0):
        parts.append(f"no {drawn.one} in {exact_text(background)}")
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
    through = "" if is_same(passed, area) else f", {exact_text(passed)} of it passes the depth test"
    if is_same(seen, passed):
        return f"{covers}{through}"
    later = "none of it is visible" if is_same(seen, 0.0) else f"{exact_text(seen)} is visible"
    return f"{covers}{through}; {later} in the end"
