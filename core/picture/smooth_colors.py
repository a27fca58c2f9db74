"""Colours that differ within a triangle, in any of the ways that are cheaper than attributes and light per pixel."""

from core.picture.byte_colors import ByteColors, byte_colors
from core.picture.job import Job
from core.picture.lit.by_mesh import LitMeshes, lit_meshes
from core.picture.lit.one_color import LitNormals, lit_normals
from core.picture.lit.textured import LitTexture, lit_texture
from core.picture.textured import TextureColors, texture_colors

SmoothColors = ByteColors | LitNormals | LitTexture | LitMeshes | TextureColors


def smooth_colors(job: Job) -> SmoothColors | None:
    """Return the cheapest colours that give the right bytes; ``None``: only attributes and light per pixel do."""
    colors = byte_colors(job) or lit_normals(job) or lit_texture(job) or lit_meshes(job)
    return colors or texture_colors(job)
