"""What is known of fragments wherever they come from: who owns them, their attributes, how their texture changes.

Pixels of areas take their values from planes over the window, pixels of outlines from the ends of their segments.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from core.fragments.interpolation import Interpolator
from core.fragments.textures import uses_mipmaps
from core.fragments.uv_slopes import uv_slopes
from core.fragments.value_rule import ValueRule
from core.methods import table
from core.raster.coverage import Fragments
from core.raster.lines.slopes import line_slopes
from core.raster.lines.wireframe import LineFragments, interpolate_outlines
from core.raster.pixel_runs import Raster
from core.records.arrays import Flags, Floats, Integers
from core.records.frame import StageCount
from core.records.primitives import interpolation_form
from core.resolved import resolve
from core.scene import AnyScene
from core.stages.fragment_color import Surface, shade_fragments
from core.stages.geometry import Geometry

if TYPE_CHECKING:
    from core.fragments.edited_slopes import EditedSlopes  # Edited listings are few.


def owner_of(fragments: Fragments) -> Integers:
    """Return what each fragment belongs to, (F,) int64: its segment or its primitive."""
    return fragments.segment if isinstance(fragments, LineFragments) else fragments.primitive


def fragments_at(geometry: Geometry, owner: Integers, column: Integers, row: Integers) -> Fragments:
    """Return the fragments of owners (F,), see ``owner_of``, at pixels."""
    if geometry.outlines is None:
        return Fragments(owner, column, row)
    return LineFragments(geometry.outlines.primitive.take(owner), column, row, owner)


def fragment_values(geometry: Geometry, fragments: Fragments, raster: Raster) -> tuple[Floats, Floats]:
    """Return weights of the corners (F, C) and interpolated values (F, K) of fragments.

    C is 3, of segments 2 and of points 1: these are drawn as triangles that repeat their last corner.
    """
    mode, varyings = geometry.settings.interpolation, geometry.primitives.varyings
    if isinstance(fragments, LineFragments) and interpolation_form(mode) != "flat":
        assert geometry.outlines is not None
        weights, values = interpolate_outlines(geometry.outlines, varyings, fragments, raster.center, mode)
    else:
        interpolator = Interpolator(geometry.planes, varyings, *resolve(geometry.settings).interpolation)
        centers = raster.centers(fragments.column, fragments.row)
        weights, values = interpolator.weighted(fragments.primitive, *centers)
    last = geometry.vertices.corner_count - 1
    if last < 2:
        weights = np.column_stack([weights[:, :last], weights[:, last:].sum(axis=1)])
    return weights, values


def interpolate(geometry: Geometry, raster: Raster, fragments: Fragments, count: StageCount) -> Floats:
    """Return the interpolated values (F, K) float64 of fragments."""
    with count:
        count.incoming = count.outgoing = len(fragments)
        if isinstance(fragments, LineFragments):
            return fragment_values(geometry, fragments, raster)[1]
        how = resolve(geometry.settings).interpolation
        interpolator = Interpolator(geometry.planes, geometry.primitives.values, *how)
        return interpolator.values(fragments.primitive, *raster.centers(fragments.column, fragments.row))


def shade(
    scene: AnyScene,
    geometry: Geometry,
    raster: Raster,
    fragments: Fragments,
    values: Floats,
    count: StageCount,
) -> Floats:
    """Return the colours (F, 4) float64 of fragments with interpolated ``values`` (F, K)."""
    with count:
        count.incoming = count.outgoing = len(fragments)
        return surface_of(scene, geometry, raster, fragments, values).color


def not_discarded(scene: AnyScene, geometry: Geometry, raster: Raster, fragments: Fragments) -> Flags:
    """Return (F,) bool, which fragments go on to the depth test: all but those that a fragment shader discards."""
    if scene.program is None:
        return np.ones(len(fragments), bool)
    from core.shaders.fragment_stage import discarded_fragments

    discarded = discarded_fragments(scene, geometry, raster, fragments)
    return np.ones(len(fragments), bool) if discarded is None else ~discarded


def surface_of(
    scene: AnyScene,
    geometry: Geometry,
    raster: Raster,
    fragments: Fragments,
    values: Floats,
    slopes: Floats | None = None,
) -> Surface:
    """Return the shaded fragments (F) with interpolated ``values`` (F, K): by the scene's shader, where it has one.

    ``slopes`` of the texture's coordinates, where they are those of other places than the fragments' own.
    """
    if scene.program is not None:
        from core.shaders.fragment_stage import run_fragments

        color = run_fragments(scene, geometry, raster, fragments, values).color.astype(np.float64)
        return Surface(color, None, None, color)
    mesh = geometry.primitives.mesh[fragments.primitive]
    slopes = texture_slopes(geometry, raster, fragments, values) if slopes is None else slopes
    return shade_fragments(scene, geometry.settings, geometry.primitives.layout, mesh, values, slopes)


def shade_once(
    scene: AnyScene,
    geometry: Geometry,
    raster: Raster,
    samples: Sequence[Fragments],
    counts: dict[str, StageCount],
) -> tuple[Floats, list[Integers]]:
    """Shade once for every triangle in a pixel: colours (U, 4) at pixels' centres, and which (F,) each sample's has."""
    pixel_count = raster.shape[0] * raster.shape[1]
    keys = [owner_of(of) * pixel_count + raster.index(of.column, of.row) for of in samples]
    every, number = np.unique(np.concatenate(keys), return_inverse=True)
    owner, pixel = np.divmod(every, pixel_count)
    once = fragments_at(geometry, owner, *raster.position(pixel))
    values = interpolate(geometry, raster, once, counts["interpolate"])
    colors = shade(scene, geometry, raster, once, values, counts["shade"])
    return colors, np.split(number.reshape(-1), np.cumsum([len(key) for key in keys])[:-1])


def texture_slopes(geometry: Geometry, raster: Raster, fragments: Fragments, values: Floats) -> Floats | None:
    """Return du/dx, dv/dx, du/dy, dv/dy (4, F) of fragments with interpolated ``values`` (F, K).

    ``None`` where no texture is looked up, or the texture filter does not ask for them.
    """
    if not _asks_for_slopes(geometry):
        return None
    interpolation = geometry.settings.interpolation
    if isinstance(fragments, LineFragments) and interpolation_form(interpolation) != "flat":
        assert geometry.outlines is not None
        varyings = geometry.primitives.varyings[..., geometry.primitives.layout["uv"]]
        slopes = line_slopes(geometry.outlines, varyings, fragments, raster.center, interpolation)
        return slopes.reshape(4, len(fragments))
    x, y = raster.centers(fragments.column, fragments.row)
    return slopes_at(geometry, fragments.primitive, x, y, values)


def slopes_at(geometry: Geometry, primitive: Integers, x: Floats, y: Floats, values: Floats) -> Floats | None:
    """Return the same (4, F), or ``None``, for primitives at window positions (F,)."""
    if not _asks_for_slopes(geometry):
        return None
    rule, *_ = resolve(geometry.settings).interpolation
    if isinstance(rule, ValueRule):
        return edited_slopes_at(geometry, primitive, x, y).slopes
    uv = values[:, geometry.primitives.layout["uv"]]
    name = geometry.settings.interpolation
    return uv_slopes(geometry.planes, geometry.primitives.values, primitive, x, y, uv, name)


def edited_slopes_at(geometry: Geometry, primitive: Integers, x: Floats, y: Floats) -> "EditedSlopes":
    """Return the slopes for primitives at window positions (F,) where an edited listing interpolates."""
    from core.fragments.edited_slopes import edited_slopes

    rule, provoking, interval = resolve(geometry.settings).interpolation
    assert isinstance(rule, ValueRule)
    name = table.get("interpolation", geometry.settings.interpolation).name
    values = geometry.primitives.values
    return edited_slopes(rule, geometry.planes, values, primitive, x, y, name, provoking, interval)


def _asks_for_slopes(geometry: Geometry) -> bool:
    return "uv" in geometry.primitives.layout and uses_mipmaps(geometry.settings.texture_filter)
