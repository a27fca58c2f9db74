"""How long the stages take: blocks may be nested, each is counted without those inside it."""

from contextlib import AbstractContextManager
from threading import local
from time import perf_counter

from core.records.frame import StageCount

_nested = local()


class timed(AbstractContextManager[StageCount]):  # noqa: N801
    """Add the time of the block to ``count``, without that of timed blocks inside it.

    A class, since a picture has some twenty blocks: a generator takes three times as long to enter and leave.
    """

    __slots__ = ("count", "outer", "start")

    def __init__(self, count: StageCount) -> None:
        self.count = count

    def __enter__(self) -> StageCount:
        self.outer: float = getattr(_nested, "seconds", 0.0)
        _nested.seconds = 0.0
        self.start = perf_counter()
        return self.count

    def __exit__(self, *raised: object) -> None:
        elapsed = perf_counter() - self.start
        self.count.seconds += elapsed - _nested.seconds
        _nested.seconds = self.outer + elapsed
