"""Which functions run meanwhile, and how often: what is done twice, or by the thread of the window, is seen so."""

import sys
from collections import Counter
from collections.abc import Callable, Iterable
from types import FrameType


def calls_of(functions: Iterable[Callable[..., object]], do: Callable[[], object]) -> Counter[str]:
    """Return how often this thread calls each function meanwhile, by its name."""
    codes = {getattr(each, "__func__", each).__code__: each.__qualname__ for each in functions}
    found: Counter[str] = Counter()

    def look(frame: FrameType, event: str, _: object) -> None:
        if event == "call" and frame.f_code in codes:
            found[codes[frame.f_code]] += 1

    sys.setprofile(look)
    try:
        do()
    finally:
        sys.setprofile(None)
    return found
