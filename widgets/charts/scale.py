"""Where values stand on a logarithmic axis that has places of its own for 0 and for infinity.

A logarithmic axis has no 0, yet an exact method has exactly that error: it stands in a band below the axis, set apart
by a line, and infinity in a band above. Positions are decades (log10); nothing here knows pixels.
"""

from dataclasses import dataclass
from math import ceil, floor, inf, log10

import numpy as np

from core.explain.number_text import number_text
from core.records.arrays import Floats

_ROOM = 0.08
"""Part of the range that is kept free at its ends."""
_BAND = 0.16
"""Height of the band of 0, and of infinity, as a part of the range."""
_FEW_DECADES = 2.5
"""Of a range of fewer decades 1, 2 and 5 are labelled, else the decades alone."""
_MOST_DECADES = 7
_LEAST, _MOST = -307, 307
"""Decades of normal float64 numbers."""
_PREFIXES = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"), (1e-12, "ps"))


@dataclass(frozen=True)
class ChartScale:
    """One axis."""

    low: float
    """Decade at which the logarithmic part begins."""
    high: float
    """Decade at which it ends."""
    has_zero: bool
    has_infinite: bool

    @property
    def band(self) -> float:
        """Height of a band, in decades."""
        return _BAND * (self.high - self.low)

    @property
    def start(self) -> float:
        """Lowest position of the axis."""
        return self.low - self.band if self.has_zero else self.low

    @property
    def stop(self) -> float:
        """Highest position of the axis."""
        return self.high + self.band if self.has_infinite else self.high

    @property
    def separators(self) -> tuple[float, ...]:
        """Positions of the lines between the bands and the logarithmic part."""
        return (self.low,) * self.has_zero + (self.high,) * self.has_infinite

    def positions(self, values: Floats) -> Floats:
        """Return the (N,) positions of (N,) values; those below 0 and NaN have none: NaN."""
        positive = np.isfinite(values) & (values > 0)
        found = np.full(len(values), np.nan)
        found[positive] = np.log10(values[positive])
        found[values == 0] = self.low - self.band / 2
        found[values == inf] = self.high + self.band / 2
        return found

    def ticks(self, low: float, high: float, unit: str) -> list[tuple[float, str]]:
        """Return positions between ``low`` and ``high`` that are labelled, with their labels."""
        low, high = max(low, self.low), min(high, self.high)
        marks = [(self.low - self.band / 2, axis_text(0.0, unit))] * self.has_zero
        marks += [(self.high + self.band / 2, "∞")] * self.has_infinite
        if high <= low:
            return marks
        steps = (1, 2, 5) if high - low < _FEW_DECADES else (1,)
        stride = max(1, ceil((high - low) / _MOST_DECADES))
        for decade in range(max(floor(low), _LEAST), min(ceil(high), _MOST) + 1):
            for step in steps if decade % stride == 0 else ():
                if low <= decade + log10(step) <= high:
                    marks.append((decade + log10(step), axis_text(step * 10.0**decade, unit)))
        return marks


def scale_of(values: Floats) -> ChartScale:
    """Return the scale that (N,) values need; NaN and values below 0 do not count."""
    positive = values[np.isfinite(values) & (values > 0)]
    has_zero, has_infinite = bool((values == 0).any()), bool((values == inf).any())
    if len(positive) == 0:
        # Nothing but zeros: one decade on which nothing stands, so that their band has a size.
        return ChartScale(-1.0, 0.0, has_zero, has_infinite)
    low, high = float(np.log10(positive.min())), float(np.log10(positive.max()))
    middle, half = (low + high) / 2, max((high - low) / 2, 0.25)
    room = 2 * half * _ROOM + 0.02
    return ChartScale(middle - half - room, middle + half + room, has_zero, has_infinite)


def time_text(seconds: float, digits: int = 4) -> str:
    """Write seconds with the prefix that leaves a number from 1 to 1000: ``12.5 µs``."""
    size, name = next(((s, n) for s, n in _PREFIXES if abs(seconds) >= s * 0.9995), _PREFIXES[-1])
    if seconds == 0:
        size, name = _PREFIXES[0]
    return f"{number_text(seconds / size, digits)} {name}"


def axis_text(value: float, unit: str) -> str:
    """Write a value at an axis: units other than seconds stand in its title."""
    if unit == "s":
        return "0" if value == 0 else time_text(value)
    if 1e-4 < value < 1e6:
        return f"{value:,.10g}"
    return number_text(value)
