"""Colours that differ within a triangle, in any of the ways that are cheaper than attributes and light per pixel."""

from core.fast_path.corner_colors import CornerColors, corner_colors
from core.fast_path.draw_context import DrawContext
from core.fast_path.lit.by_mesh import LitColors, lit_colors
from core.fast_path.textured import TextureColors, texture_colors

SmoothColors = CornerColors | LitColors | TextureColors


def smooth_colors(context: DrawContext) -> SmoothColors | None:
    """Return the cheapest colours that give the right bytes; ``None``: only attributes and light per pixel do."""
    return corner_colors(context) or lit_colors(context) or texture_colors(context)
