"""From a pixel to texture space: its four corners and its centre, the texels it reads and their shares."""

from dataclasses import dataclass

import numpy as np

from app.session.moment import Moment
from app.views.pointed_pixel import PointedPixel, fragment_at, pointed_pixels, shown_triangle
from core.interpolation.interpolation import interpolate, plane_value
from core.records.arrays import Floats
from core.records.words import counted, nouns
from core.scene import ClipScene, Texture
from core.textures.look_up import TextureSamples, sample_texture, wrap_period
from core.textures.mipmaps import mipmap_levels, sample_mipmaps
from core.trace.source import TraceSource
from widgets.grid.layers import number_text
from widgets.space.texture_paint import TexelFootprint, TexturePicture

PIXEL_SQUARE = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
"""Corners of a pixel around its centre, in turn."""


@dataclass(frozen=True, eq=False)
class LevelRead:
    """What a fragment reads of one mipmap level; without mipmaps, of the texture itself."""

    level: int
    """Number of the level, 0: the texture itself."""
    samples: TextureSamples
    """What the filter reads there."""
    share: float
    """Share of the level in the colour."""


@dataclass(frozen=True, eq=False)
class PixelInTexture:
    """A fragment in texture space, before any shift; u and v as they are interpolated."""

    corners: Floats
    """(4, 2) uv at the pixel's corners; NaN if 1/w changes its sign among them."""
    center: Floats
    """(2,) uv at its centre."""
    reads: tuple[LevelRead, ...]
    """What the filter reads, of one level or of two, the finer first."""


def texture_of(source: TraceSource, triangle: int) -> Texture | None:
    """Return the texture of a triangle's mesh; ``None`` where shaders choose what they look up."""
    scene = source.scene
    if scene.program is not None:
        return None
    if isinstance(scene, ClipScene):
        return scene.texture
    return scene.meshes[int(source.geometry.vertices.mesh[triangle])].texture


def uv_at(source: TraceSource, primitive: int, x: Floats, y: Floats, interpolation: str) -> Floats:
    """Return the texture coordinates (N, 2) of a primitive's plane at window positions (N,) each."""
    settings, primitives = source.settings, source.geometry.primitives
    which = np.full(len(x), primitive)
    _, values = interpolate(
        source.geometry.planes,
        primitives.varyings[..., primitives.layout["uv"]],
        which,
        x,
        y,
        interpolation,
        settings.provoking,
        settings.correction_interval,
    )
    return values


def pixel_in_texture(
    source: TraceSource, primitive: int, column: int, row: int, slopes: Floats | None = None
) -> PixelInTexture | None:
    """Return a pixel of a primitive in texture space; ``None`` where its triangle has no texture.

    Parameters
    ----------
    slopes : (4, 1) float64 array, optional
        How u and v change there, if the texture filter asks for it.
    """
    texture = texture_of(source, int(source.geometry.primitives.triangle[primitive]))
    if texture is None:
        return None
    settings = source.settings
    center = np.array([[column, row]]) + source.raster.center
    uv = uv_at(source, primitive, center[:, 0], center[:, 1], settings.interpolation)
    # Interpolation that is corrected here and there stands for the one that always is.
    smooth = "perspective" if settings.interpolation == "affine-n" else settings.interpolation
    places = center + PIXEL_SQUARE
    corners = uv_at(source, primitive, places[:, 0], places[:, 1], smooth)
    if smooth == "perspective":
        around = np.concatenate([center, places]).T
        inverse_w = plane_value(source.geometry.inverse_w_plane, np.full(5, primitive), *around)
        if not (inverse_w > 0).all():
            corners = np.full((4, 2), np.nan)
    return PixelInTexture(corners, uv[0], _reads(source, texture, uv, slopes))


def _reads(source: TraceSource, texture: Texture, uv: Floats, slopes: Floats | None) -> tuple[LevelRead, ...]:
    """Return what is read at ``uv`` (1, 2), level by level."""
    how = source.settings.texture_filter, source.settings.wrap
    if slopes is None:
        return (LevelRead(0, sample_texture(texture, uv, *how), 1.0),)
    read = sample_mipmaps(texture, uv, slopes, *how)
    share = float(read.choice.fraction[0])
    near = LevelRead(int(read.near.level[0]), read.near.samples, 1 - share)
    return (near, LevelRead(int(read.far.level[0]), read.far.samples, share)) if share else (near,)


def tile_shift(center: Floats, wrap: str) -> Floats:
    """Return the whole repetitions (2,) that bring a place (2,) in texture coordinates into the texture."""
    period = wrap_period(wrap)
    if not period or not np.isfinite(center).all():
        return np.zeros(2)
    return period * np.floor(center / period)


def texture_pictures(moment: Moment) -> tuple[tuple[TexturePicture, ...], str]:
    """Return what the texture view shows, a picture for each level that is read, or why there is nothing."""
    source = moment.trace.source
    triangle = shown_triangle(moment)
    pixels = pointed_pixels(moment)
    found: list[tuple[PointedPixel, int, PixelInTexture]] = []
    for pixel in pixels:
        fragment = fragment_at(source, pixel.column, pixel.row, triangle)
        if fragment < 0:
            continue
        primitive = int(source.fragments.primitive[fragment])
        slopes = None if source.uv_slopes is None else source.uv_slopes[:, [fragment]]
        at = pixel_in_texture(source, primitive, pixel.column, pixel.row, slopes)
        if at is not None:
            found.append((pixel, primitive, at))
    if found and source.geometry.primitives.triangle[found[0][1]] != triangle:
        triangle = int(source.geometry.primitives.triangle[found[0][1]])
    texture = texture_of(source, triangle)
    if texture is None:
        return (), no_texture_reason(moment, triangle)
    wrap = source.settings.wrap
    shift = tile_shift(found[0][2].center, wrap) if found else np.zeros(2)
    corners = _corner_uv(source, triangle)
    if not found and corners is not None:
        shift = tile_shift(corners.mean(axis=0), wrap)
    pictures = []
    for place, number in enumerate([read.level for read in found[0][2].reads] if found else [0]):
        level = mipmap_levels(texture)[number] if number else texture
        size = np.array([level.pixels.shape[1], level.pixels.shape[0]])
        footprints = [
            _footprint(pixel, at, number, shift, size)
            for pixel, primitive, at in found
            if texture_of(source, int(source.geometry.primitives.triangle[primitive])) is texture
        ]
        picture = TexturePicture(
            pixels=level.pixels,
            period=wrap_period(wrap),
            triangle=None if corners is None else (corners - shift) * size,
            footprints=tuple(footprints),
            caption=_caption(source, triangle, level, pixels, found, shift, place),
        )
        pictures.append(picture)
    return tuple(pictures), ""


def no_texture_reason(moment: Moment, triangle: int) -> str:
    """Say why there is no texture to show."""
    scene = moment.document.scene
    if scene.program is not None:
        return "The scene's shaders choose where they look a texture up: step their lines in Shade."
    if isinstance(scene, ClipScene):
        return nouns(scene.corner_count).text("These {many} have colours at their {corner}s and no texture.")
    if not any(mesh.texture for mesh in scene.meshes):
        return "No mesh of this scene has a texture."
    return f"The mesh of triangle {triangle} has no texture."


def _corner_uv(source: TraceSource, triangle: int) -> Floats | None:
    """Return (3, 2) texture coordinates of a triangle's corners."""
    assembled = source.geometry.assembled
    index = np.flatnonzero(assembled.triangle == triangle)
    if not len(index) or "uv" not in assembled.layout:
        return None
    return np.asarray(assembled.varyings[index[0]][:, assembled.layout["uv"]])


def _footprint(
    pixel: PointedPixel, at: PixelInTexture, level: int, shift: Floats, size: Floats
) -> TexelFootprint:
    """Return a pixel's outline in a level of ``size`` texels, and the texels that it reads of it, if it does."""
    read = next((read for read in at.reads if read.level == level), None)
    texels, shares = np.empty((0, 2), np.int64), np.empty(0)
    if read is not None:
        texels, shares = read.samples.texels[0], read.samples.shares[0] * read.share
    center = at.center * size
    if len(shares) == 1:
        lower = np.floor(center)
        offsets = np.array([[0, 0]])
    else:
        lower = np.floor(center - 0.5)
        offsets = np.array([[0, 0], [1, 0], [0, 1], [1, 1]])[: len(shares)]
    lower = np.nan_to_num(lower - shift * size, nan=0.0, posinf=0.0, neginf=0.0)
    return TexelFootprint(
        corners=(at.corners - shift) * size,
        center=(at.center - shift) * size,
        reads=lower.astype(np.int64) + offsets,
        texels=texels,
        shares=shares,
        label=f"({pixel.column}, {pixel.row})",
        is_pinned=pixel.role != "hover",
    )


def _caption(
    source: TraceSource,
    triangle: int,
    texture: Texture,
    pixels: tuple[PointedPixel, ...],
    found: list[tuple[PointedPixel, int, PixelInTexture]],
    shift: Floats,
    place: int,
) -> str:
    """Describe the ``place``-th of the levels that are shown."""
    height, width = texture.pixels.shape[:2]
    parts = [f"{texture.name[:1].upper()}{texture.name[1:]}, {width}×{height} texels."]
    if not pixels:
        parts.append(f"Triangle {triangle} is outlined; point at a pixel to see its footprint.")
    elif not found:
        parts.append(f"The {pixels[0].name} has no textured fragment.")
    else:
        pixel, _, at = found[0]
        read = at.reads[place]
        reads = f"reads {counted(len(read.samples.shares[0]), 'texel')}"
        u, v = (number_text(float(value)) for value in at.center)
        if len(at.reads) > 1:  # Two levels share the width.
            looks = "" if place else f"looks up u = {u}, v = {v} and "
            share = number_text(100 * read.share, 3)
            parts.append(f"The {pixel.name} {looks}{reads} here, {share} % of the colour.")
        else:
            moved = f", shown {_shift_text(shift)} ({source.settings.wrap})" if shift.any() else ""
            means = source.settings.texture_filter
            parts.append(f"The {pixel.name} looks up u = {u}, v = {v}{moved}, and {reads} ({means}).")
        if np.isfinite(at.corners).all():
            area = abs(_area(at.corners * [width, height]))
            parts.append(f"Its footprint covers {number_text(area, 3)} texels.")
        else:
            parts.append("It reaches over the horizon and has no footprint.")
    return " ".join(parts)


def _shift_text(shift: Floats) -> str:
    across, up = (number_text(float(-value), 6) for value in shift)
    return f"moved by ({across}, {up}) whole repetitions"


def _area(corners: Floats) -> float:
    x, y = corners.T
    return 0.5 * float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
