"""Colours that differ within a triangle, in any of the ways that are cheaper than attributes and light per pixel."""

from core.fast_path.corner_colors import CornerColors, corner_colors
from core.fast_path.draw_context import DrawContext
from core.fast_path.lit.by_mesh import LitMeshes, lit_meshes
from core.fast_path.lit.one_color import LitNormals, lit_normals
from core.fast_path.lit.textured import LitTexture, lit_texture
from core.fast_path.textured import TextureColors, texture_colors

SmoothColors = CornerColors | LitNormals | LitTexture | LitMeshes | TextureColors


def smooth_colors(context: DrawContext) -> SmoothColors | None:
    """Return the cheapest colours that give the right bytes; ``None``: only attributes and light per pixel do."""
    return (
        corner_colors(context)
        or lit_normals(context)
        or lit_texture(context)
        or lit_meshes(context)
        or texture_colors(context)
    )
