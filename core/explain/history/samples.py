"""The words of a pixel's history where it has several samples."""

from collections.abc import Sequence

from core.explain.number_text import joined

MOST_NAMED = 4
"""Samples that are named one by one; of more the first ones are."""
_OF_SAMPLE = {
    "no pixel centre": "no sample of this place",
    "the pixel centre": "the sample",
    "The pixel centre": "The sample",
    "the pixel is in": "the sample is in",
    "the pixel is not in": "the sample is not in",
}
"""What is said of a pixel's centre, and of a sample in its place."""


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


def samples_verdict(groups: Sequence[tuple[int, Sequence[int]]], count: int) -> str:
    """Return the first line of a pixel of ``count`` samples: which of them show what.

    Parameters
    ----------
    groups : sequence of (int, sequence of int)
        A triangle, -1 for none, and the samples that show it.
    """
    parts: list[str] = []
    for triangle, samples in groups:
        what = f"triangle {triangle}" if triangle >= 0 else "none"
        number = f"all {count}" if len(samples) == count else f"{len(samples)} of {count}"
        parts.append(f"{number} samples show {what}" if not parts else f"{len(samples)} show {what}")
    text = ", ".join(parts)
    return f"{text[0].upper()}{text[1:]}."
