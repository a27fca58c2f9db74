"""Edited texture filters: the colour comes from the text."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from core.edits.typed import Typed, parameters_of
from core.fragments.color_rule import ColorRule
from core.fragments.mipmaps import mipmap_levels
from core.fragments.textures import fill_missing_channels
from core.lanes.tables import LEVEL, Table, table_of
from core.methods import Method
from core.records.arrays import Floats
from core.scene import Texture
from core.settings import Settings

COLOR = "the colour: as many numbers as a texel has"


@lru_cache(4)
def texels_of(levels: tuple[Texture, ...], is_stack: bool) -> Table:
    """Return what a listing knows as ``pixels`` (``is_stack``: as ``levels``)."""
    found = table_of([level.pixels for level in levels])
    return found if is_stack else replace(found, chosen=(0,) * (LEVEL + 1))


def filter_inputs(typed: Typed, texture: Texture, u: Any, v: Any, lod: Any, wrap: str) -> list[Any]:
    """Return what the listing of a filter is given: ``lod`` is left out where it takes none."""
    takes_levels = "levels" in parameters_of(typed.of)
    levels = mipmap_levels(texture) if takes_levels else (texture,)
    return [texels_of(levels, takes_levels), u, v, *([lod] if takes_levels else []), str(wrap)]


@dataclass(frozen=True)
class TypedFilter(ColorRule):
    """A texture filter that runs a typed text."""

    typed: Typed
    right: Callable[..., Any]
    """The rule of the method: which texels the trace shows as read."""

    def __call__(self, *values: Any) -> Any:
        """Return what the method reads."""
        return self.right(*values)

    def colors(self, texture: Texture, uv: Floats, lod: Floats | None, wrap: str) -> Floats:
        """Return colours (4, F) of finite coordinates ``uv`` (2, F)."""
        channels = texture.pixels.shape[2]
        color = np.empty((4, uv.shape[1]))

        def of_block(part: slice) -> list[Any]:
            (u, v), levels = uv[:, part], None if lod is None else lod[part]
            return filter_inputs(self.typed, texture, u, v, levels, wrap)

        color[:channels] = self.typed.run_blocks(of_block, uv.shape[1], ("number",) * channels, COLOR)
        fill_missing_channels(color.T, channels)
        return color


def check_filter(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    white = Texture(np.ones((1, 1, 4), np.float32))
    none = np.zeros(0)
    typed.checked(filter_inputs(typed, white, none, none, none, "repeat"), ("number",) * 4, COLOR)


def edited_filter(method: Method, typed: Typed) -> Method:
    """Return a texture filter that runs a text."""
    return replace(method, function=TypedFilter(typed, method.function), listing=typed)


def filter_is_passed_over(settings: Settings, scene: Any) -> str:
    """Return why an edited texture filter would not run."""
    if "wrap" in settings.replacements:
        return "It knows the three wraps by their names: choose one of them."
    return ""
