"""The least and the largest colour that a triangle can have in a pixel's square, whatever the samples.

Two hulls bound what is interpolated: the corners of the triangle, and the corners of the pixel's square. A value is
``(a x + b y + c) / (1/w)``, a projective map of the window, which takes a convex polygon in front of the eye to a
convex one with the same corners; so both hold, and the smaller one is taken. Snapping lets the triangle reach beyond
its corners by `SNAPPED`: the square is grown by more, and the range of the corners by what the weights can be below 0.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from core.arrays import Flags, Floats, Integers
from core.fragments.interpolation import value_plane
from core.scene import AnyScene, Scene, Texture
from core.settings import Settings
from core.study.planner.light_ranges import LightRange, Reflectances, light_range
from core.study.planner.texture_ranges import magnified_range, minified_range, range_around
from core.study.planner.touched import MARGIN, Touched
from core.surface import viewpoint

Levels = tuple[Floats, Floats]
"""The least and the largest level of detail (Q,)."""
SAMPLES = 4
"""Samples on a side of a pixel of everything on."""
CHUNK = 1 << 16
"""Pairs that are worked on together."""
SNAPPED = 0.75 / 256
"""Pixels that snapping moves a corner at most: half a step each way."""
MOST_WEIGHT = 0.5
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


@dataclass(frozen=True, eq=False)
class Hull:
    """What is interpolated at H corners around each of Q pairs."""

    values: Floats
    """(H, Q, K) float64."""
    is_sound: Flags
    """(Q,) bool, the values in the square are mixtures of these."""
    below_zero: Floats
    """(Q,) float64, how far below 0 their weights can be."""


def color_ranges(touched: Touched, scene: AnyScene, settings: Settings) -> ColorRanges:
    """Bound the colours of all pairs, a part at a time."""
    count = len(touched.pixel)
    rows, lod = np.empty((6, count, 3)), np.empty(count)
    for part in _parts(count):
        levels = _levels_of_detail(touched, scene, part)
        lod[part] = levels[1]
        for row, values in zip(rows, _ranges(touched, scene, settings, levels, part), strict=True):
            row[part] = values
    low, high, albedo, texels, gain, bright = rows
    return ColorRanges(low, high, lod, albedo, texels, gain, bright)


def _parts(count: int) -> Iterator[slice]:
    for start in range(0, count, CHUNK):
        yield slice(start, min(start + CHUNK, count))


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def _ranges(
    touched: Touched, scene: AnyScene, settings: Settings, levels: Levels, part: slice
) -> tuple[Floats, ...]:
    """Return the fields low, high, albedo, texels, gain and bright of `ColorRanges` for a part of the pairs."""
    count = part.stop - part.start
    low, high = np.full((count, 3), -np.inf), np.full((count, 3), np.inf)
    albedo, texels, gain, bright = np.full((4, count, 3), np.inf)
    for hull in (_square_hull(touched, part), _corner_hull(touched, part)):
        least, most, spread, factor = _albedo(touched, scene, settings, hull, levels, part)
        light = np.ones((count, 3))
        sound = hull.is_sound[:, None]
        albedo = np.where(sound, np.fmin(albedo, most), albedo)
        if "normal" in touched.geometry.primitives.layout:
            assert isinstance(scene, Scene)
            lit = _light(touched, scene, hull, part)
            least = least * lit.diffuse_low + lit.specular_low
            most = most * lit.diffuse_high + lit.specular_high
            light = lit.diffuse_high
        low = np.where(sound, np.fmax(low, least), low)
        high = np.where(sound, np.fmin(high, most), high)
        texels = np.where(sound, np.fmin(texels, spread * light), texels)
        gain = np.where(sound, np.fmin(gain, factor * light), gain)
        bright = np.where(sound, np.fmin(bright, light), bright)
    high = np.nan_to_num(np.maximum(high, low), nan=np.inf, posinf=np.inf)
    return np.maximum(low, 0.0), high, albedo, texels, gain, bright


def _corner_hull(touched: Touched, part: slice) -> Hull:
    primitive = touched.primitive[part]
    values = touched.geometry.primitives.varyings[primitive].swapaxes(0, 1)
    weight = weights_below_zero(touched).take(primitive)
    return Hull(values, weight <= MOST_WEIGHT, np.minimum(weight, 1.0))


def weights_below_zero(touched: Touched) -> Floats:
    """Return (P,) float64: how far below 0 a weight can be, as snapping moves corners by `SNAPPED`."""
    window = touched.geometry.corners.window
    edge = np.linalg.norm(window - np.roll(window, 1, axis=1), axis=2).max(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(
            np.nan_to_num(SNAPPED * edge / np.abs(touched.facing), nan=np.inf) * w_ratio(touched)
        )


def w_ratio(touched: Touched) -> Floats:
    """Return (P,) float64, the largest over the smallest w of the corners; infinite where one is not positive."""
    w = touched.geometry.primitives.clip[..., 3]
    least = w.min(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(least > 0, w.max(axis=1) / least, np.inf)


def _square_hull(touched: Touched, part: slice) -> Hull:
    primitive = touched.primitive[part]
    reach = 0.5 + MARGIN
    ways = [(-reach, -reach), (reach, -reach), (-reach, reach), (reach, reach)]
    varyings = touched.geometry.primitives.varyings
    planes = touched.geometry.planes
    inverse_w = _at(touched.geometry.inverse_w_plane, primitive, touched, part, ways)
    values = np.empty((4, len(primitive), varyings.shape[2]))
    for k in range(varyings.shape[2]):
        plane = value_plane(planes, varyings[..., k])
        values[..., k] = _at(plane, primitive, touched, part, ways) / inverse_w
    is_sound = np.asarray((inverse_w > 0).all(axis=0) & np.isfinite(values).all(axis=(0, 2)))
    return Hull(np.where(is_sound[:, None], values, 0.0), is_sound, np.zeros(len(primitive)))


def _at(
    plane: tuple[Floats, Floats, Floats],
    primitive: Integers,
    touched: Touched,
    part: slice,
    ways: list[tuple[float, float]],
) -> Floats:
    """Return planes (P,) at the corners of the squares, (4, Q)."""
    a, b, c = (values.take(primitive) for values in plane)
    middle = a * touched.x[part] + b * touched.y[part] + c
    return np.stack([middle + (right * a + up * b) for right, up in ways])


def hull_range(hull: Hull, part: slice) -> tuple[Floats, Floats]:
    """Return the least and the largest of some values (Q, k) over a hull."""
    values = hull.values[..., part]
    low, high = values.min(axis=0), values.max(axis=0)
    extra = (high - low) * (2 * hull.below_zero)[:, None]
    return low - extra, high + extra


def _albedo(
    touched: Touched, scene: AnyScene, settings: Settings, hull: Hull, levels: Levels, part: slice
) -> tuple[Floats, Floats, Floats, Floats]:
    """Return the range (Q, 3) of colours before they are lit, that of texels times vertex colours, and these."""
    layout, count = touched.geometry.primitives.layout, part.stop - part.start
    low, high, spread = np.ones((count, 3)), np.ones((count, 3)), np.zeros((count, 3))
    if "color" in layout:
        least, most = hull_range(hull, layout["color"])
        width = min(least.shape[1], 3)
        low, high = np.zeros((count, 3)), np.zeros((count, 3))
        low[:, :width], high[:, :width] = np.maximum(least[:, :width], 0), np.maximum(most[:, :width], 0)
    factor = high.copy()
    least_lod, lod = levels
    reach = 1.5 * np.exp2(np.ceil(np.maximum(lod, 0.0))) + 1
    for chosen, texture in textures_of(touched, scene, part):
        uv_low, uv_high = (values[chosen] for values in hull_range(hull, layout["uv"]))
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


def _levels_of_detail(touched: Touched, scene: AnyScene, part: slice) -> Levels:
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
    reach = 0.5 + MARGIN
    ways = [(-reach, -reach), (reach, -reach), (-reach, reach), (reach, reach)]
    inverse_w = touched.geometry.inverse_w_plane
    at_corner = _at(inverse_w, primitive, touched, part, ways)
    least = np.maximum(at_corner.min(axis=0), inverse_w_floor(touched).take(primitive))
    most = at_corner.max(axis=0)
    slopes = np.empty((2, 2, 2, len(primitive)))
    for number, k in enumerate(range(layout["uv"].start, layout["uv"].stop)):
        plane = value_plane(touched.geometry.planes, varyings[..., k])
        value = _at(plane, primitive, touched, part, ways)
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
    """Return (P,) float64, the least 1/w in each primitive, and a hair less for snapping."""
    w = touched.geometry.primitives.clip[..., 3].max(axis=1)
    weight = np.minimum(weights_below_zero(touched), 1.0)
    return np.asarray(np.maximum(1 - 2 * weight, 1e-3) / w)


def _light(touched: Touched, scene: Scene, hull: Hull, part: slice) -> LightRange:
    layout = touched.geometry.primitives.layout
    positions, normals = hull.values[..., layout["position"]], hull.values[..., layout["normal"]]
    to_eye = viewpoint(scene.camera, positions.reshape(-1, 3)) - positions.reshape(-1, 3)
    mesh = touched.geometry.primitives.mesh.take(touched.primitive[part])
    return light_range(
        normals,
        positions,
        to_eye.reshape(positions.shape),
        scene.lights,
        materials(scene, mesh),
        hull.below_zero,
    )


def materials(scene: Scene, mesh: Integers) -> Reflectances:
    """Return the materials of meshes (Q,)."""
    rows = np.array(
        [
            (each.ambient, each.diffuse, each.specular, each.shininess)
            for each in (mesh_of.material for mesh_of in scene.meshes)
        ]
    )
    return Reflectances(*rows[mesh].T)
