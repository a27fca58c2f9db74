"""How wrong cheaper filters and interpolation can be: bounds of linear light, then of bytes.

**Filters.** All mix texels with weights that sum to 1, so two of them differ by no more than the texels in reach do. At
a level of detail of 0 or below trilinear reads level 0 only, as bilinear does: no difference.

**Affine interpolation.** Of weights a (affine) perspective makes b_i = a_i q_i / sum a_j q_j with q = 1/w. Where b > a
the affine weights sum to some A, and b to at most A r / (A r + 1 - A) with the ratio r of the corners' w; that is above
A by at most k = (sqrt r - 1)/(sqrt r + 1). So no attribute is off by more than k times the range of its values at the
corners. Snapping lets weights go t below 0; against the nearest place in the triangle the corners' parts in a change by
no more than 4 t in all, and with e_i = q_i/sum a_j q_j - 1 that adds t (r - 1)(6 + 8 t)/(1 - 2 t (r - 1)). With
corrections every n columns, r is what 1/w can change by in n columns. What is lit by it is off by less than its slope
times that, see ``light_changes``.

References
----------
J. Blinn, *Hyperbolic interpolation*, 1992.
P. Heckbert, H. Moreton, *Interpolation for polygon texture mapping and shading*, 1991.
"""

import numpy as np

from core.records.arrays import Floats
from core.scene import AnyScene, Scene, Texture
from core.study.planner.bounds.bytes import times
from core.study.planner.bounds.color_ranges import ColorRanges, areas_below_zero, as_rgb, textures_of, w_ratio
from core.study.planner.bounds.interpolated_light import interpolated_light_error
from core.study.planner.bounds.texture_ranges import texture_ranges
from core.study.planner.bounds.translucency import ROUNDING
from core.study.planner.bounds.tried_light import tried_error
from core.study.planner.scene_analysis.conservative_coverage import Touched, is_cut
from core.study.planner.scene_analysis.sample_patterns import Pattern

EQUAL = 1e-12
"""Ratios of w no farther from 1 are 1, but for rounding."""


def filter_error(touched: Touched, colors: ColorRanges, scene: AnyScene, name: str, side: int) -> Floats:
    """Return how far a filter is from trilinear, (Q, 3) linear, with ``side`` x ``side`` samples a pixel."""
    error = np.zeros_like(colors.texels)
    is_minified = colors.lod - np.log2(side) > 0
    error[is_minified] = colors.texels[is_minified]
    if name == "nearest":
        for chosen, texture in textures_of(touched, scene, slice(0, len(touched.pixel))):
            magnified = chosen[~is_minified[chosen]]
            step = as_rgb(texture_ranges(texture).neighbours[None]) * colors.gain[magnified]
            error[magnified] = np.fmin(colors.texels[magnified], step)
    for chosen, texture in textures_of(touched, scene, slice(0, len(touched.pixel))):
        if _has_several_alphas(texture) and (name == "nearest" or is_minified[chosen].any()):
            error[chosen] = np.inf
    return error


def _has_several_alphas(texture: Texture) -> bool:
    """Tell whether how much shines through depends on the texel: what is behind is not bounded here."""
    return texture.pixels.shape[2] == 4 and bool(np.ptp(texture.pixels[..., 3]) > 0)


def share_of_range(touched: Touched, is_clipped: bool = True, columns: int | None = None) -> Floats:
    """Return k (P,) float64 for affine interpolation, or for corrections every so many ``columns``.

    Where triangles that cross a plane of the view volume are not clipped to it, nothing is known of them: what is
    interpolated is the whole triangle, or another piece of it.
    """
    ratio, weight = w_ratio(touched), areas_below_zero(touched)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        if columns is not None:
            change = np.abs(touched.geometry.inverse_w_plane[0]) * columns
            least = (1 / touched.geometry.primitives.clip[..., 3]).min(axis=1)
            ratio = np.fmin(ratio, 1 + change / np.maximum(least, 1e-300))
        root = np.sqrt(ratio)
        share = np.nan_to_num((root - 1) / (root + 1), nan=1.0)
        left = 1 - 2 * weight * (ratio - 1)
        share += np.where(left > 0, weight * (ratio - 1) * (6 + 8 * weight) / left, np.inf)
        share = np.nan_to_num(share, nan=np.inf, posinf=np.inf)
    # Equal w differ by rounding.
    share[ratio - 1 < EQUAL] = 0.0
    return share if is_clipped else np.where(is_cut(touched), np.inf, share)


def interpolation_error(
    touched: Touched,
    colors: ColorRanges,
    scene: AnyScene,
    share: Floats,
    shading: str,
    texture_filter: str,
    pattern: Pattern,
    is_affine: bool = False,
) -> Floats:
    """Return how far colours are off, (Q, 3) linear, if attributes are by ``share`` (P,) of their range.

    If interpolation ``is_affine``, it is tried at the samples where bounds say little.

    Notes
    -----
    A step of one texel changes a bilinear colour by no more than neighbouring texels differ, each way; nearest jumps by
    one texel more. Where a texture is minified, the level goes wrong too, and all its contrast is at stake.
    """
    primitives, primitive = touched.geometry.primitives, touched.primitive
    layout, error = primitives.layout, np.zeros_like(colors.low)
    with np.errstate(invalid="ignore"):
        part = np.nan_to_num(share[:, None] * np.ptp(primitives.varyings, axis=1), nan=0.0, posinf=np.inf)
    if "color" in layout:
        change = part[:, layout["color"]][:, :3]
        error[:, : change.shape[1]] += times(change[primitive], colors.bright[:, : change.shape[1]])
        alpha = part[:, layout["color"]][:, 3:]
        error[(alpha > ROUNDING).any(axis=1)[primitive]] = np.inf
    for chosen, texture in textures_of(touched, scene, slice(0, len(primitive))):
        ranges = texture_ranges(texture)
        height, width = texture.pixels.shape[:2]
        moved = (part[:, layout["uv"]] * (width, height)).sum(axis=1)[primitive[chosen]]
        # At the border of two texels rounding alone decides which of them is nearest.
        moved += texture_filter == "nearest"
        step = times(moved[:, None], as_rgb(ranges.neighbours[None]))
        is_minified = (colors.lod[chosen] - np.log2(pattern.side) > 0) & (moved > 0)
        step = np.where(is_minified[:, None], np.inf, step)
        if _has_several_alphas(texture):
            error[chosen[moved > 0]] = np.inf
        error[chosen] += times(np.minimum(step, as_rgb(ranges.contrast[None])), colors.gain[chosen])
    if "normal" in layout and shading != "unlit":
        assert isinstance(scene, Scene)
        light = interpolated_light_error(touched, scene, share, shading)
        of_light = times(colors.albedo, light.diffuse[primitive]) + light.specular[primitive]
        if is_affine and shading == "phong":
            of_light = tried_error(of_light, touched, colors, scene, pattern, "affine")
        error += of_light
    return error
