"""A rule of interpolation that finds values by itself, beside those that find weights."""

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, NamedTuple

from core.records.arrays import Floats, Integers

if TYPE_CHECKING:
    from core.fragments.interpolation import Planes


class ValuePlaces(NamedTuple):
    """What a rule of the family ``interpolation`` takes: F fragments, and how they are interpolated."""

    planes: "Planes"
    primitive: Integers
    """(F,) int64."""
    x: Floats
    """(F,) float64, pixel centres."""
    y: Floats
    provoking: int
    interval: int


class ValueRule(ABC):
    """A rule that finds values by itself, not only the weights with which they are mixed: an edited listing."""

    @abstractmethod
    def __call__(
        self, planes: "Planes", primitive: Integers, x: Floats, y: Floats, provoking: int, interval: int
    ) -> Floats:
        """Return weights (F, 3)."""

    @abstractmethod
    def weights_and_values(self, at: ValuePlaces, corners: Floats) -> tuple[Floats, Floats]:
        """Return weights (3, F) and the values (F,) between those of the corners, (3, F)."""
