"""How wrong cheaper filters, interpolation and shading can be: bounds of linear light, then of bytes.

**Filters.** All mix texels with weights that sum to 1, so two of them differ by no more than the texels in reach do. At
a level of detail of 0 or below trilinear reads level 0 only, as bilinear does: no difference.

**Affine interpolation.** Of weights a (affine) perspective makes b_i = a_i q_i / sum a_j q_j with q = 1/w. Where b > a
the affine weights sum to some A, and b to at most A r / (A r + 1 - A) with the ratio r of the corners' w; that is above
A by at most k = (sqrt r - 1)/(sqrt r + 1). So no attribute is off by more than k times the range of its values at the
corners. With corrections every n columns, r is what 1/w can change by in n columns.

**Gouraud.** With unit normals n_i at the corners and a distant light L, sum b_i n_i.L is what Gouraud interpolates and,
over |sum b_i n_i|, what Phong computes. |sum b_i n_i|^2 is 1 - sum over pairs of 2 b_i b_j (1 - n_i.n_j), at least
m^2 = (1 + 2 c)/3 for the smallest cosine c: they differ by (1/m - 1) of the brightest corner, the sagitta of the
cosine. Where corners lie on both sides of the terminator, by p n/(p + n) of the cosines p and -n there as well. A near
light adds twice the radius of the cone of its directions. Highlights are bounded by cones, see ``light_ranges``.

**Flat.** The normal of a face and the interpolated one are no farther apart than the face's is from the corners'.

References
----------
P. Heckbert, H. Moreton, *Interpolation for polygon texture mapping and shading*, 1991.
T. Bishop, D. Weimer, *Fast Phong shading*, 1986.
"""

from dataclasses import dataclass

import numpy as np

from core.arrays import Flags, Floats
from core.fragments.lighting import planes
from core.fragments.shading import face_normals
from core.geometry.vertex_stage import unit
from core.scene import AnyScene, DirectionalLight, Scene, Texture
from core.study.planner.color_ranges import (
    MOST_WEIGHT,
    ColorRanges,
    as_rgb,
    materials,
    textures_of,
    w_ratio,
    weights_below_zero,
)
from core.study.planner.light_ranges import LightRange, cones, light_range
from core.study.planner.texture_ranges import texture_ranges
from core.study.planner.touched import Touched, is_cut
from core.study.planner.translucency import ROUNDING
from core.surface import viewpoint


@dataclass(frozen=True, eq=False)
class LightError:
    """How far the light of P primitives may be off, (P, 3) float64 linear each."""

    diffuse: Floats
    specular: Floats


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


def share_of_range(touched: Touched, columns: int | None = None) -> Floats:
    """Return k (P,) float64 for affine interpolation, or for corrections every so many ``columns``."""
    ratio = w_ratio(touched)
    if columns is not None:
        with np.errstate(invalid="ignore", over="ignore"):
            change = np.abs(touched.geometry.inverse_w_plane[0]) * columns
            least = (1 / touched.geometry.primitives.clip[..., 3]).min(axis=1)
            ratio = np.fmin(ratio, 1 + change / np.maximum(least, 1e-300))
    with np.errstate(invalid="ignore"):
        root = np.sqrt(ratio)
        share = np.nan_to_num((root - 1) / (root + 1), nan=1.0)
    # Equal w differ by rounding; a triangle that crosses the eye is not interpolated affinely at all.
    return np.where(is_cut(touched), np.inf, np.where(share < 1e-12, 0.0, share))


def interpolation_error(
    touched: Touched,
    colors: ColorRanges,
    scene: AnyScene,
    share: Floats,
    shading: str,
    texture_filter: str,
    side: int,
) -> Floats:
    """Return how far colours are off, (Q, 3) linear, if attributes are by ``share`` (P,) of their range.

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
        is_minified = (colors.lod[chosen] - np.log2(side) > 0) & (moved > 0)
        step = np.where(is_minified[:, None], np.inf, step)
        if _has_several_alphas(texture):
            error[chosen[moved > 0]] = np.inf
        error[chosen] += times(np.minimum(step, as_rgb(ranges.contrast[None])), colors.gain[chosen])
    if "normal" in layout and shading != "unlit":
        assert isinstance(scene, Scene)
        light = _interpolated_light_error(touched, scene, share, shading)
        error += times(colors.albedo, light.diffuse[primitive]) + light.specular[primitive]
    return error


def _interpolated_light_error(touched: Touched, scene: Scene, share: Floats, shading: str) -> LightError:
    """Return how far light is off: as a value of the vertices, or by other normals and places in the triangle."""
    spread = corner_light(touched, scene)
    diffuse, specular = (
        spread.diffuse_high - spread.diffuse_low,
        spread.specular_high - spread.specular_low,
    )
    if shading == "flat":
        return LightError(np.zeros_like(diffuse), np.zeros_like(specular))
    part = np.minimum(share, 1.0) if shading == "gouraud" else np.where(share > 0, 1.0, 0.0)
    most = part[:, None]
    error = LightError(times(most, diffuse), times(most, specular))
    lost = np.isinf(share)
    error.diffuse[lost] = error.specular[lost] = np.inf
    return error


def shading_error(touched: Touched, scene: Scene, name: str) -> LightError:
    """Return how far light that is evaluated at vertices, faces or nowhere is from Phong's."""
    spread = corner_light(touched, scene, with_faces=name == "flat")
    diffuse = spread.diffuse_high - spread.diffuse_low
    specular = spread.specular_high - spread.specular_low
    if name == "unlit":
        away = np.maximum(np.abs(spread.diffuse_low - 1), np.abs(spread.diffuse_high - 1))
        return LightError(away, spread.specular_high)
    angles = _gouraud_error(touched, scene) if name == "gouraud" else _flat_error(touched, scene)
    # Light at the corners of a triangle, or at its middle, is not bounded by what is in view of it.
    material = materials(scene, touched.geometry.primitives.mesh)
    cut = is_cut(touched) & bool(scene.lights)
    return LightError(
        np.where((cut & (material.diffuse > 0))[:, None], np.inf, np.minimum(angles, diffuse)),
        np.where((cut & (material.specular > 0))[:, None], np.inf, specular),
    )


def _gouraud_error(touched: Touched, scene: Scene) -> Floats:
    """Return the error of the diffuse light (P, 3): the sagitta of the cosine, and the terminator."""
    normal = _corner(touched, "normal")
    cosines = [(normal[k] * normal[(k + 1) % 3]).sum(axis=1) for k in range(3)]
    squared = (1 + 2 * np.min(cosines, axis=0)) / 3
    with np.errstate(divide="ignore", invalid="ignore"):
        sagitta = np.where(squared > 0, 1 / np.sqrt(np.maximum(squared, 1e-300)) - 1, np.inf)
    error = np.zeros((len(sagitta), 3))
    for direction, radius, color in _lights(touched, scene):
        cosine = np.stack([(each * direction).sum(axis=1) for each in normal])
        bright, dark = np.maximum(cosine.max(axis=0), 0), np.maximum(-cosine.min(axis=0), 0)
        both = bright * dark / np.maximum(bright + dark, 1e-300)
        # Where no corner is lit nothing between them is, however the normals turn.
        error += (times(bright, sagitta) + both + 2 * radius)[:, None] * color
    material = materials(scene, touched.geometry.primitives.mesh)
    return np.where(_is_unit(normal)[:, None], material.diffuse[:, None] * error, np.inf)


def _flat_error(touched: Touched, scene: Scene) -> Floats:
    """Return the error of the diffuse light (P, 3): the chord from the face's normal to those of the corners."""
    normal, face = _corner(touched, "normal"), _face_normal(touched)
    chord = np.max([np.linalg.norm(each - face, axis=1) for each in normal], axis=0)
    error = np.zeros((len(chord), 3))
    for _, radius, color in _lights(touched, scene):
        error += (chord + 2 * radius)[:, None] * color
    material = materials(scene, touched.geometry.primitives.mesh)
    is_wide = ~(chord < np.sqrt(2.0))
    return np.asarray(np.where(is_wide[:, None], np.inf, material.diffuse[:, None] * error))


def _is_unit(normal: Floats) -> Flags:
    """Return (P,) bool, all three normals (3, P, 3) are unit."""
    return np.asarray((np.abs(np.linalg.norm(normal, axis=2) - 1) < 1e-9).all(axis=0))


def _lights(touched: Touched, scene: Scene) -> list[tuple[Floats, Floats, Floats]]:
    """Return for every light the middle direction to it (P, 3), the radius of its cone (P,), and its colour (3,)."""
    position = _corner(touched, "position")
    found = []
    for light in scene.lights:
        if isinstance(light, DirectionalLight):
            towards = np.broadcast_to(unit(-light.direction), position[0].shape)
            radius = np.zeros(len(towards))
        else:
            cone = cones(light.position - position)
            towards, radius = cone.axis, cone.radius
        found.append((towards, radius, np.maximum(light.color, 0)))
    return found


def corner_light(touched: Touched, scene: Scene, with_faces: bool = False) -> LightRange:
    """Return the range of the light over whole primitives (P, 3), ``with_faces`` at their middle too."""
    position, normal = _corner(touched, "position"), _corner(touched, "normal")
    if with_faces:
        position = np.concatenate([position, position.mean(axis=0)[None]])
        normal = np.concatenate([normal, _face_normal(touched)[None]])
    to_eye = viewpoint(scene.camera, position.reshape(-1, 3)) - position.reshape(-1, 3)
    weight = weights_below_zero(touched)
    below_zero = np.where(weight <= MOST_WEIGHT, weight, np.inf)
    material = materials(scene, touched.geometry.primitives.mesh)
    with np.errstate(invalid="ignore"):
        return light_range(
            normal, position, to_eye.reshape(position.shape), scene.lights, material, below_zero
        )


def _corner(touched: Touched, name: str) -> Floats:
    """Return one attribute of the corners, (3, P, 3)."""
    primitives = touched.geometry.primitives
    return np.asarray(primitives.varyings[..., primitives.layout[name]].swapaxes(0, 1))


def _face_normal(touched: Touched) -> Floats:
    """Return the unit normals of the faces (P, 3), on the side of those of the corners."""
    position, normal = _corner(touched, "position"), _corner(touched, "normal")
    count = position.shape[1]
    corners = np.arange(3 * count).reshape(3, count).T
    face = unit(face_normals(position.reshape(-1, 3), corners))
    x, y, z = planes(face * normal.sum(axis=0))
    return np.asarray(np.where((x + y + z < 0)[:, None], -face, face))


def times(first: Floats, second: Floats) -> Floats:
    """Return the product of bounds, arrays of any shape; nothing times the unknown is nothing."""
    with np.errstate(invalid="ignore"):
        return np.asarray(np.where((first == 0) | (second == 0), 0.0, first * second))
