"""A logarithmic axis over whole powers of ten, or over the values themselves where they span little."""

from dataclasses import dataclass
from math import ceil, floor, log10


@dataclass(frozen=True)
class LogAxis:
    """Where positive values stand between two ends in pixels."""

    start: float
    end: float
    lowest: float
    """Logarithm (base 10) of the value at ``start``; ``highest``: at ``end``."""
    highest: float

    def place(self, value: float) -> float:
        """Return where a value is, in pixels; 0 and less stand at the start."""
        if value <= 0:
            return self.start
        share = (log10(value) - self.lowest) / (self.highest - self.lowest)
        return self.start + share * (self.end - self.start)


def axis_of(values: list[float], start: float, end: float) -> LogAxis:
    """Return an axis that holds all positive ``values``, with a little room at both ends."""
    positive = [log10(value) for value in values if value > 0] or [0.0]
    lowest, highest = min(positive), max(positive)
    room = max((highest - lowest) * 0.06, 0.15)
    return LogAxis(start, end, lowest - room, highest + room)


def ticks(axis: LogAxis) -> list[float]:
    """Return the values with a line and a number: powers of ten, or 1, 2 and 5 times them where there are few."""
    powers = range(floor(axis.lowest), ceil(axis.highest) + 1)
    span = axis.highest - axis.lowest
    steps: tuple[float, ...] = (1.0,)
    if span < 2.5:
        steps = (1.0, 2.0, 5.0) if span > 0.8 else tuple(k / 2 for k in range(2, 20))
    found = [step * 10.0**power for power in powers for step in steps]
    shown = [value for value in found if axis.lowest <= log10(value) <= axis.highest]
    return shown[:: max(len(shown) // 9, 1)]
