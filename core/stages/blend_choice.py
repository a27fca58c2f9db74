"""Which blend method runs: the one that the settings choose, or the one that lines with intensities need.

The pixels of a line with intensities are mixed with what is there (`core.raster.lines.intensities`). ``opaque`` mixes
nothing, so "over" is inserted in its place, and the pipeline says so.
"""

from core.framebuffer.blending import blend_traits
from core.methods import is_registered, table
from core.raster.lines.traits import has_intensities
from core.settings import Settings

INSERTED = "over"
"""Blend method of lines with intensities where the settings choose none that mixes."""


def blend_choice(settings: Settings) -> tuple[str, str]:
    """Return the blend method that runs, and the line method that asked for it where the settings did not."""
    is_outlined = table.get("polygon_mode", settings.polygon_mode).function()
    needs_mixing = is_outlined and has_intensities(settings.line)
    if needs_mixing and not blend_traits(settings.blend).mixes:
        return INSERTED, settings.line
    return settings.blend, ""


def is_mixed(settings: Settings) -> bool:
    """Tell whether colours are mixed with what is there, so that every fragment that passes is shaded."""
    return not is_registered(blend_choice(settings)[0], "opaque")
