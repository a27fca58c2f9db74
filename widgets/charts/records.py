"""What a chart shows: axes, series of points, and the front of those that no other beats."""

from collections.abc import Mapping
from dataclasses import dataclass

from core.records.arrays import Floats

MOST_NAMED = 12
"""Marks of a chart that are named beside them at once; of more series there is a list too."""


@dataclass(frozen=True)
class ChartAxis:
    """One axis; both are logarithmic, with places of their own for 0 and for infinity."""

    title: str
    """What a person reads, without the unit."""
    unit: str = ""
    """``s`` is written with a prefix, as ``20 µs``; other units stand behind the title."""

    @property
    def label(self) -> str:
        """Title and unit."""
        return f"{self.title} ({self.unit})" if self.unit and self.unit != "s" else self.title


@dataclass(frozen=True, eq=False)
class ChartSeries:
    """One method: a single point, or several that are joined by a line."""

    key: str
    """What signals name it by."""
    title: str
    number: int
    """Which colour and shape it has; the same in every chart of a page."""
    x: Floats
    """(N,) float64, 0 or more; N is at least 1."""
    y: Floats
    """(N,) float64, 0 or more."""
    x_spread: Floats | None = None
    """(N, 2) float64, ends of the horizontal bars; ``None``: no bars."""
    y_spread: Floats | None = None
    """(N, 2) float64, ends of the vertical bars."""
    best: int = -1
    """The point of a line that stands out, whatever is pointed at: where its cost is least; -1: none."""


@dataclass(frozen=True, eq=False)
class ChartPicture:
    """Everything that a chart shows."""

    x_axis: ChartAxis
    y_axis: ChartAxis
    series: tuple[ChartSeries, ...] = ()
    front: tuple[str, ...] = ()
    """Keys of the series of one point that no other beats on both axes, the smallest x first."""
    ringed: tuple[str, ...] = ()
    """Keys of the series that stand out, whatever is pointed at: what a plan chose."""
    is_named: bool = True
    """Whether all names are written beside the marks; else a list beside the chart has them."""


@dataclass(frozen=True)
class ChartEmpty:
    """A chart without anything to show: why, and what to do."""

    text: str


ChartMark = Mapping[str, str]
"""Key of a series to the letter that marks it as chosen: A or B."""
