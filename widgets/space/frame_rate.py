"""How many pictures a second are shown: from the times at which they were painted."""

from collections import deque
from itertools import pairwise
from statistics import median

WINDOW_SECONDS = 1.0
"""The rate is that of the last so many seconds; a longer pause begins it anew."""


class FrameRate:
    """Remembers when the pictures of the last second were painted."""

    def __init__(self) -> None:
        self._times: deque[float] = deque()

    def add(self, seconds: float) -> None:
        """Take a picture that was painted at a time of one clock."""
        if self._times and seconds - self._times[-1] > WINDOW_SECONDS:
            self._times.clear()
        self._times.append(seconds)
        while seconds - self._times[0] > WINDOW_SECONDS:
            self._times.popleft()

    def per_second(self) -> float | None:
        """Return the rate of the median interval between two pictures, ``None``: there was only one.

        The median, because a hand that rests for a moment is no slow picture.
        """
        intervals = [after - before for before, after in pairwise(self._times)]
        typical = median(intervals) if intervals else 0.0
        return 1 / typical if typical > 0 else None
