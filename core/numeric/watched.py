"""Long work that reports how far it is to whoever watches it, and ends where nobody waits for it any more."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import local
from time import monotonic

Report = Callable[[float | None, str], None]
"""Of the fraction done (``None``: not known) and what is being done."""
PAUSE = 0.05
"""Seconds between two reports of the same work."""


class AbandonedError(Exception):
    """Nobody waits for the work any more."""


class _Watching(local):
    """Who watches the work of this thread, and what it is."""

    progress: Report | None = None
    is_cancelled: Callable[[], bool] | None = None
    doing: str = ""
    reported: float = 0.0


_watching = _Watching()


@contextmanager
def watched(progress: Report | None, is_cancelled: Callable[[], bool] | None = None) -> Iterator[None]:
    """Watch the work that this thread does in the block: it reports, and raises AbandonedError where cancelled."""
    before = _watching.progress, _watching.is_cancelled
    _watching.progress, _watching.is_cancelled = progress, is_cancelled
    try:
        yield
    finally:
        _watching.progress, _watching.is_cancelled = before


@contextmanager
def work(doing: str) -> Iterator[None]:
    """Name the work of the block, and report it at once; without a name nothing is reported."""
    before, _watching.doing = _watching.doing, doing
    _watching.reported = 0.0
    report(None)
    try:
        yield
    finally:
        _watching.doing = before


def report(fraction: float | None) -> None:
    """Report how far the work is, now and then; raises AbandonedError if it is cancelled."""
    if _watching.is_cancelled is not None and _watching.is_cancelled():
        raise AbandonedError("nobody waits for the work any more")
    if _watching.progress is None or not _watching.doing or monotonic() - _watching.reported < PAUSE:
        return
    _watching.reported = monotonic()
    _watching.progress(fraction, _watching.doing)
