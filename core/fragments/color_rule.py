"""A texture filter that finds colours by itself, beside those that say which texels are read: an edited listing."""

from abc import ABC, abstractmethod
from typing import Any

from core.records.arrays import Floats
from core.scene import Texture


class ColorRule(ABC):
    """A rule of the family ``texture_filter`` that finds colours by itself."""

    @abstractmethod
    def __call__(self, *values: Any) -> Any:
        """Return which texels, or levels, the method reads whose listing is edited."""

    @abstractmethod
    def colors(self, texture: Texture, uv: Floats, lod: Floats | None, wrap: str) -> Floats:
        """Return colours (4, F) float64 of finite coordinates ``uv`` (2, F), with mipmaps of levels of detail (F,)."""
