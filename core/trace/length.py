"""How long a trace is at most: each pixel test keeps all its numbers, so some runs are too long to be kept."""

from core.raster.fills.traits import fill_traits
from core.resolved import resolve
from core.scene import AnyScene
from core.settings import Settings, no_effect

LONGEST_RUN = 1_500_000
"""Pixel tests that a trace may have."""


def most_tests(scene: AnyScene, settings: Settings, triangle_count: int, pixel_count: int) -> int:
    """Return the pixel tests of a trace at most where every pixel is tested, else a guess."""
    pixels = pixel_count * resolve(settings).sampling.count
    if fill_traits(settings.fill).looks_everywhere and not no_effect(settings, "fill", scene):
        return triangle_count * pixels
    return min(triangle_count, 60) * pixels // 4
