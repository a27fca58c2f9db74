"""A method of shading that lights points by a rule of its own: an edited listing."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

from core.fragments.lighting import Surface
from core.records.arrays import Floats
from core.scene import Light


class LightRule(ABC):
    """A method of the family ``shading`` with a lighting rule of its own."""

    @abstractmethod
    def __call__(self, *values: Any) -> dict[str, Floats]:
        """Return what is interpolated, as the method does whose listing is edited."""

    @abstractmethod
    def light(
        self, position: Floats, normal: Floats, eye: Floats, lights: Sequence[Light], material: Surface
    ) -> tuple[Floats, Floats]:
        """Return diffuse and specular light (F, 3) of points, as ``core.fragments.lighting.light_surface`` does."""
