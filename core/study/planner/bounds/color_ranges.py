"""The least and the largest colour that a triangle can have in a pixel's square, whatever the samples.

Two hulls bound what is interpolated: the corners of the triangle, and the corners of the pixel's square. A value is
``(a x + b y + c) / (1/w)``, a projective map of the window, which takes a convex polygon in front of the eye to a
convex one with the same corners; so both hold, and the smaller one is taken. Snapping lets the triangle reach beyond
its corners by `SNAPPED`: the square is grown by more, and the range of the corners by what the weights can be below 0.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from core.fragments.interpolation import value_plane
from core.records.arrays import Flags, Floats, Integers
from core.scene import AnyScene, Scene, Texture
from core.settings import Settings
from core.stages.vertex_light import viewpoint
from core.study.planner.bounds.light_ranges import Cones, LightRange, Reflectances, cones, light_range
from core.study.planner.bounds.texture_ranges import magnified_range, minified_range, range_around
from core.study.planner.progress import Pause, unpaused
from core.study.planner.scene_analysis.conservative_coverage import MARGIN, Touched

Levels = tuple[Floats, Floats]
"""The least and the largest level of detail (Q,)."""
SAMPLES = 4
"""Samples on a side of a pixel of everything on."""
CHUNK = 1 << 14
"""Pairs that are worked on together."""
SNAPPED = 0.75 / 256
"""Pixels that snapping moves a corner at most: half a step each way."""
MOST_WEIGHT = 4.0
"""A triangle whose weights can be farther below 0 than this is bounded by the square alone."""


@dataclass(frozen=True, eq=False)
class ColorRanges:
    """Colours of the Q pairs of a look."""

    low: Floats
    """(Q, 3) float64 linear."""
    high: Floats
    """(Q, 3) float64 linear; infinite: not known."""
    lod: Floats
    """(Q,) float64, largest level of detail of a texture, at one sample a pixel; -inf where there is none."""
    albedo: Floats
    """(Q, 3) float64 linear, the largest colour before it is lit."""
    texels: Floats
    """(Q, 3) float64, how far apart the colours are by the texels that filters read alone."""
    gain: Floats
    """(Q, 3) float64, what the colour changes by, at most, for a change of its texel: vertex colour times light."""
    bright: Floats
    """(Q, 3) float64, the largest diffuse light; 1 where nothing is lit."""
    is_known: Flags
    """(Q,) bool; the others were not looked at, as they are hidden."""

    def take(self, index: Integers) -> "ColorRanges":
        """Return the colours of the pairs ``index`` (R,)."""
        return ColorRanges(*(getattr(self, field.name).take(index, axis=0) for field in fields(self)))


@dataclass(frozen=True, eq=False)
class Hull:
    """What is interpolated, bounded by the corners of something around each of Q patches."""

    low: Floats
    """(Q, K) float64."""
    high: Floats
    """(Q, K) float64."""
    is_sound: Flags
    """(Q,) bool: the values are within these."""
    light: LightRange | None
    """Of Q patches; ``None``: nothing is lit."""

    def take(self, index: Integers) -> "Hull":
        """Return the bounds of the patches ``index`` (Q,)."""
        light = None if self.light is None else self.light.take(index)
        return Hull(
            self.low.take(index, axis=0),
            self.high.take(index, axis=0),
            self.is_sound.take(index),
            light,
        )


def color_ranges(
    touched: Touched,
    scene: AnyScene,
    settings: Settings,
    chosen: Flags,
    stays_inside: bool = True,
    pause: Pause = unpaused,
) -> ColorRanges:
    """Bound the colours of the ``chosen`` (Q,) pairs, a part at a time and a ``pause`` between them.

    Of the others nothing is known.

    Where colours are taken at the pixels' centres, they may be those of places beyond the triangle: it does not
    ``stay inside``, and its corners bound nothing.
    """
    index = np.flatnonzero(chosen)
    seen = touched.take(index)
    rows, lod = np.empty((6, len(index), 3)), np.empty(len(index))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        corners = _corner_hull(touched, scene)
        if not stays_inside:
            corners = replace(corners, is_sound=np.zeros_like(corners.is_sound))
        for part in _parts(len(index)):
            pause()
            levels = _levels_of_detail(seen, scene, part, stays_inside)
            lod[part] = levels[1]
            for row, values in zip(rows, _ranges(seen, scene, settings, levels, corners, part), strict=True):
                row[part] = values
    every = np.full((6, len(chosen), 3), np.inf)
    every[0] = 0.0
    every[:, index] = rows
    every_lod = np.full(len(chosen), -np.inf)
    every_lod[index] = lod
    low, high, albedo, texels, gain, bright = every
    return ColorRanges(low, high, every_lod, albedo, texels, gain, bright, chosen)


def joined_ranges(first: ColorRanges, second: ColorRanges) -> ColorRanges:
    """Return the first with colours that reach as far as either's."""
    return replace(first, low=np.minimum(first.low, second.low), high=np.maximum(first.high, second.high))


def _parts(count: int) -> Iterator[slice]:
    for start in range(0, count, CHUNK):
        yield slice(start, min(start + CHUNK, count))


def _ranges(
    touched: Touched, scene: AnyScene, settings: Settings, levels: Levels, corners: Hull, part: slice
) -> tuple[Floats, ...]:
    """Return the fields low, high, albedo, texels, gain and bright of `ColorRanges` for a part of the pairs."""
    hulls = _square_hull(touched, scene, part), corners.take(touched.primitive[part])
    low, high, spread, factor = _albedo(touched, scene, settings, hulls, levels, part)
    if corners.light is None:
        return low, high, high, spread, factor, np.ones_like(high)
    least_light, most_light, least_shine, most_shine = (
        np.broadcast_to(start, high.shape) for start in (0.0, np.inf, 0.0, np.inf)
    )
    for hull in hulls:
        assert hull.light is not None
        sound = hull.is_sound[:, None]
        least_light = np.where(sound, np.fmax(least_light, hull.light.diffuse_low), least_light)
        most_light = np.where(sound, np.fmin(most_light, hull.light.diffuse_high), most_light)
        least_shine = np.where(sound, np.fmax(least_shine, hull.light.specular_low), least_shine)
        most_shine = np.where(sound, np.fmin(most_shine, hull.light.specular_high), most_shine)
    lit_low = low * least_light + least_shine
    lit_high = np.nan_to_num(high * most_light + most_shine, nan=np.inf, posinf=np.inf)
    return (
        lit_low,
        np.maximum(lit_high, lit_low),
        high,
        spread * most_light,
        factor * most_light,
        most_light,
    )


def _corner_hull(touched: Touched, scene: AnyScene) -> Hull:
    """Return the bounds by the corners of all P primitives."""
    primitives = touched.geometry.primitives
    values = planar(primitives.varyings.swapaxes(0, 1))
    weight = weights_below_zero(touched)
    below_zero = np.minimum(weight, MOST_WEIGHT)
    low, high = values.min(axis=0), values.max(axis=0)
    extra = (high - low) * (2 * below_zero)[:, None]
    light = _light(touched, scene, values, primitives.mesh, below_zero)
    return Hull(low - extra, high + extra, weight <= MOST_WEIGHT, light)


def planar(values: Floats) -> Floats:
    """Return values (H, Q, K), those of each k side by side in memory: sums over few of them are fast so."""
    return np.moveaxis(np.ascontiguousarray(np.moveaxis(values, 2, 0)), 0, 2)


def areas_below_zero(touched: Touched) -> Floats:
    """Return (P,) float64: how far below 0 affine weights can be, as snapping moves corners by `SNAPPED`."""
    window = touched.geometry.corners.window
    edge = np.linalg.norm(window - np.roll(window, 1, axis=1), axis=2).max(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.nan_to_num(SNAPPED * edge / np.abs(touched.facing), nan=np.inf))


def weights_below_zero(touched: Touched) -> Floats:
    """Return (P,) float64: how far below 0 a weight can be, affine or in perspective."""
    with np.errstate(invalid="ignore"):
        return np.asarray(np.nan_to_num(areas_below_zero(touched) * w_ratio(touched), nan=np.inf))


def w_ratio(touched: Touched) -> Floats:
    """Return (P,) float64, the largest over the smallest w of the corners; infinite where one is not positive."""
    w = touched.geometry.primitives.clip[..., 3]
    least = w.min(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(least > 0, w.max(axis=1) / least, np.inf)


def _square_hull(touched: Touched, scene: AnyScene, part: slice) -> Hull:
    """Return the bounds by the corners of the pixels' grown squares."""
    primitive = touched.primitive[part]
    primitives = touched.geometry.primitives
    inverse_w = _at(touched.geometry.inverse_w_plane, primitive, touched, part)
    values = np.empty((primitives.varyings.shape[2], 4, len(primitive)))
    for k, of_corners in enumerate(np.moveaxis(primitives.varyings, 2, 0)):
        plane = value_plane(touched.geometry.planes, of_corners)
        np.divide(_at(plane, primitive, touched, part), inverse_w, out=values[k])
    low, high = values.min(axis=1), values.max(axis=1)
    is_sound = np.asarray((inverse_w > 0).all(axis=0) & np.isfinite(low + high).all(axis=0))
    light = _light(
        touched,
        scene,
        np.moveaxis(np.where(is_sound, values, 0.0), 0, 2),
        primitives.mesh.take(primitive),
        0.0,
    )
    return Hull(low.T, high.T, is_sound, light)


def _at(
    plane: tuple[Floats, Floats, Floats],
    primitive: Integers,
    touched: Touched,
    part: slice,
) -> Floats:
    """Return planes (P,) at the corners of the squares, (4, Q)."""
    a, b, c = (values.take(primitive) for values in plane)
    middle = a * touched.x[part] + b * touched.y[part] + c
    right, up = a * (0.5 + MARGIN), b * (0.5 + MARGIN)
    return np.stack(
        [middle - (right + up), middle + (right - up), middle - (right - up), middle + (right + up)]
    )


def joint_range(hulls: Sequence[Hull], columns: slice) -> tuple[Floats, Floats]:
    """Return the least and the largest of some values (Q, k) that are in all sound hulls; infinite: there is none."""
    shape = hulls[0].low[:, columns].shape
    low, high = np.full(shape, -np.inf), np.full(shape, np.inf)
    for hull in hulls:
        sound = hull.is_sound[:, None]
        low = np.where(sound, np.maximum(low, hull.low[:, columns]), low)
        high = np.where(sound, np.minimum(high, hull.high[:, columns]), high)
    return low, np.maximum(low, high)


def _albedo(
    touched: Touched,
    scene: AnyScene,
    settings: Settings,
    hulls: Sequence[Hull],
    levels: Levels,
    part: slice,
) -> tuple[Floats, Floats, Floats, Floats]:
    """Return the range (Q, 3) of colours before they are lit, that of texels times vertex colours, and these."""
    layout, count = touched.geometry.primitives.layout, part.stop - part.start
    low, high, spread = np.ones((count, 3)), np.ones((count, 3)), np.zeros((count, 3))
    if "color" in layout:
        least, most = joint_range(hulls, layout["color"])
        width = min(least.shape[1], 3)
        low, high = np.zeros((count, 3)), np.zeros((count, 3))
        low[:, :width], high[:, :width] = np.maximum(least[:, :width], 0), np.maximum(most[:, :width], 0)
    factor = high.copy()
    least_lod, lod = levels
    reach = 1.5 * np.exp2(np.ceil(np.maximum(lod, 0.0))) + 1
    for chosen, texture in textures_of(touched, scene, part):
        uv_low, uv_high = (values[chosen] for values in joint_range(hulls, layout["uv"]))
        least, most = range_around(texture, uv_low, uv_high, reach[chosen], settings.wrap)
        least, most = as_rgb(np.maximum(least, 0)), as_rgb(np.maximum(most, 0))
        spread[chosen] = (most - least) * high[chosen]
        is_magnified = (lod[chosen] <= 0)[:, None]
        inner = magnified_range(texture, uv_low, uv_high, settings.wrap)
        # Trilinear reads no finer level than that of the least step, which samples make shorter.
        above = minified_range(texture, least_lod[chosen] - np.log2(SAMPLES))
        least = np.maximum(least, np.where(is_magnified, as_rgb(inner[0]), as_rgb(above[0])))
        most = np.minimum(most, np.where(is_magnified, as_rgb(inner[1]), as_rgb(above[1])))
        low[chosen] *= np.maximum(least, 0)
        high[chosen] *= np.maximum(most, least)
    return low, high, spread, factor


def as_rgb(texels: Floats) -> Floats:
    """Return texels (Q, 1, 3 or 4) as red, green and blue (Q, 3)."""
    return np.repeat(texels, 3, axis=1) if texels.shape[1] == 1 else texels[:, :3]


def textures_of(touched: Touched, scene: AnyScene, part: slice) -> Iterator[tuple[Integers, Texture]]:
    """Yield which pairs of a part have which texture."""
    if not isinstance(scene, Scene):
        if scene.texture is not None:
            yield np.arange(part.stop - part.start), scene.texture
        return
    mesh = touched.geometry.primitives.mesh.take(touched.primitive[part])
    for number, of_scene in enumerate(scene.meshes):
        chosen = np.flatnonzero(mesh == number)
        if of_scene.texture is not None and len(chosen):
            yield chosen, of_scene.texture


def _levels_of_detail(touched: Touched, scene: AnyScene, part: slice, stays_inside: bool) -> Levels:
    """Return the least and the largest lambda (Q,) in the squares, one sample a pixel.

    Notes
    -----
    With U = u/w and D = 1/w linear, du/dx is (U_x D - U D_x) / D^2: above is a function of y alone and linear, so it is
    largest and smallest at corners of the square, and so is D.
    """
    layout = touched.geometry.primitives.layout
    lowest, lod = np.full((2, part.stop - part.start), -np.inf)
    if "uv" not in layout:
        return lowest, lod
    primitive, varyings = touched.primitive[part], touched.geometry.primitives.varyings
    inverse_w = touched.geometry.inverse_w_plane
    at_corner = _at(inverse_w, primitive, touched, part)
    least = np.maximum(at_corner.min(axis=0), 0.0)
    if stays_inside:
        least = np.maximum(least, inverse_w_floor(touched).take(primitive))
    most = at_corner.max(axis=0)
    slopes = np.empty((2, 2, 2, len(primitive)))
    for number, k in enumerate(range(layout["uv"].start, layout["uv"].stop)):
        plane = value_plane(touched.geometry.planes, varyings[..., k])
        value = _at(plane, primitive, touched, part)
        for way in (0, 1):
            change = plane[way].take(primitive) * at_corner - value * inverse_w[way].take(primitive)
            is_one_sign = (change > 0).all(axis=0) | (change < 0).all(axis=0)
            slopes[0, number, way] = np.where(is_one_sign, np.abs(change).min(axis=0), 0.0) / (most * most)
            slopes[1, number, way] = np.abs(change).max(axis=0) / (least * least)
    for chosen, texture in textures_of(touched, scene, part):
        height, width = texture.pixels.shape[:2]
        lengths = np.hypot(slopes[:, 0][..., chosen] * width, slopes[:, 1][..., chosen] * height).max(axis=1)
        # A hair, as slopes are rounded another way where they are drawn.
        lowest[chosen] = np.nan_to_num(np.log2(lengths[0]), nan=-np.inf) - 1e-9
        lod[chosen] = np.nan_to_num(np.log2(lengths[1]), nan=np.inf)
    return lowest, lod


def inverse_w_floor(touched: Touched) -> Floats:
    """Return (P,) float64, the least 1/w in each primitive; where snapping lets weights go below 0, less than it."""
    ratio, farthest = w_ratio(touched), touched.geometry.primitives.clip[..., 3].max(axis=1)
    with np.errstate(invalid="ignore"):
        beyond = np.nan_to_num(2 * weights_below_zero(touched) * (ratio - 1), nan=np.inf)
    return np.asarray(np.maximum(1 - beyond, 1e-3) / farthest)


def _light(
    touched: Touched, scene: AnyScene, values: Floats, mesh: Integers, below_zero: Floats | float
) -> LightRange | None:
    """Return the light on Q patches with values (H, Q, K) at their corners; ``None``: nothing is lit."""
    layout = touched.geometry.primitives.layout
    if "normal" not in layout:
        return None
    assert isinstance(scene, Scene)
    positions, normals = values[..., layout["position"]], values[..., layout["normal"]]
    to_eye = viewpoint(scene.camera, positions) - positions
    return light_range(normals, positions, to_eye, scene.lights, materials(scene, mesh), below_zero)


def normal_cones(touched: Touched) -> Cones:
    """Return the cones of the normals of P primitives that are lit."""
    primitives = touched.geometry.primitives
    return cones(primitives.varyings[..., primitives.layout["normal"]].swapaxes(0, 1))


def materials(scene: Scene, mesh: Integers) -> Reflectances:
    """Return the materials of meshes (Q,)."""
    rows = np.array(
        [
            (each.ambient, each.diffuse, each.specular, each.shininess)
            for each in (mesh_of.material for mesh_of in scene.meshes)
        ]
    )
    return Reflectances(*rows[mesh].T)
