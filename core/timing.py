"""How long the stages take: blocks may be nested, each is counted without those inside it."""

from collections.abc import Iterator
from contextlib import contextmanager
from threading import local
from time import perf_counter

from core.frame import StageCount

_nested = local()


@contextmanager
def timed(count: StageCount) -> Iterator[StageCount]:
    """Add the time of the block to ``count``, without that of timed blocks inside it."""
    outer: float = getattr(_nested, "seconds", 0.0)
    _nested.seconds = 0.0
    start = perf_counter()
    try:
        yield count
    finally:
        elapsed = perf_counter() - start
        count.seconds += elapsed - _nested.seconds
        _nested.seconds = outer + elapsed
