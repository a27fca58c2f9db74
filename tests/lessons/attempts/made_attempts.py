"""Attempts for tests, made without the pipeline: other processes save them, too."""

from datetime import UTC, datetime, timedelta

from lessons.attempts.record import Attempt


def attempt(number: int = 0, **changes: object) -> Attempt:
    """Return an attempt that differs from those of other numbers."""
    values: dict[str, object] = {
        "user": "me",
        "at": datetime(2026, 11, 23, 8, 0, 0, number, tzinfo=UTC) + timedelta(hours=number),
        "template": "triangle-coverage",
        "version": 1,
        "seed": number,
        "stage": "raster",
        "asked": ("corner-for-center", "all-edges-inclusive"),
        "answer": "..#\n.##",
        "verdict": "2 right, 1 missing, 0 extra",
        "score": 0.5,
        "points": 2.0,
        "most": 4,
        "seconds": 12.5,
    }
    return Attempt.model_validate(values | changes)
