"""An opaque picture by spans: the cheapest colours with the right bytes, and no depth where there is one layer.

The files of each way are imported when it is first taken, as in `core.fast_path.draw`.
"""

from dataclasses import replace
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

from core.fast_path.draw_context import DrawContext
from core.fast_path.palette import PaletteColors, palette
from core.fast_path.record import Route
from core.fast_path.visible import find_visible
from core.framebuffer.nearest import NearestFragments
from core.records.arrays import Integers, Singles, read_only
from core.scene import AnyScene, ClipScene, Mesh

if TYPE_CHECKING:
    from core.fast_path.smooth_colors import SmoothColors

FEW = 16
"""Triangles: so few are tried without depth, since it costs little."""

_overlaps: WeakKeyDictionary[Mesh | ClipScene, bool] = WeakKeyDictionary()
"""Scenes, by their first mesh, that turned out to have more than one layer: depth is not left out again."""


def draw_opaque(
    context: DrawContext, with_depth: bool, depth_at: Integers | None, plain_colors: bool
) -> tuple[Route, Singles | None]:
    """Draw what is nearest at every pixel.

    Parameters
    ----------
    with_depth, depth_at, plain_colors
        As `draw_picture`.

    Returns
    -------
    route : Route
    depth : (H, W) or (N,) array, or None where none is asked for
    """
    allowed = _choose_colors(context)
    colors = None if plain_colors and not isinstance(allowed, PaletteColors) else allowed
    keeps_depth = with_depth or depth_at is not None
    depth, route = None, None if keeps_depth else _draw_layer(context, colors)
    if route is None:
        nearest, route = _draw_visible(context, colors)
        if depth_at is not None:
            depth = read_only(nearest.depth_at(depth_at))
        elif with_depth:
            depth = read_only(nearest.depth().reshape(context.raster.shape))
    # A part without triangles forbids nothing, as one colour a triangle does not.
    name = allowed.name if allowed else "deferred"
    return replace(route, allowed=name if len(context.geometry.primitives) else PaletteColors.name), depth


def _choose_colors(context: DrawContext) -> "PaletteColors | SmoothColors | None":
    """Return the cheapest colours that give the right bytes; ``None``: only attributes and light per pixel do."""
    with context.timed("shade"):
        of_triangles = palette(context)
        if of_triangles is not None:
            return PaletteColors(context.encode(of_triangles))
    from core.fast_path.smooth_colors import smooth_colors

    with context.timed("interpolate"):
        return smooth_colors(context)


def _draw_layer(context: DrawContext, colors: "PaletteColors | SmoothColors | None") -> Route | None:
    """Draw without depth, if that can be right; ``None``: it is not."""
    of_layer = None if colors is None else colors.for_layer
    if of_layer is None or not _may_be_one_layer(context):
        return None
    from core.fast_path.layer import draw_layer

    split = draw_layer(context, of_layer)
    if split is None:
        _overlaps[_key(context.scene)] = True
        return None
    return Route("layer", of_layer.name, split, split.fragments)


def _may_be_one_layer(context: DrawContext) -> bool:
    """Return whether it is worth trying without depth: one triangle, or a mesh of which only one side is drawn."""
    geometry, scene = context.geometry, context.scene
    if not (geometry.is_projected.all() and geometry.is_in_range.all()):
        return False
    count = len(geometry.primitives)
    is_likely = count <= FEW or (context.settings.cull != "none" and not isinstance(scene, ClipScene))
    if count > 1 and (not is_likely or _key(scene) in _overlaps):
        return False
    from core.fast_path.depth_free import all_pass_depth_test

    with context.timed("depth"):
        return all_pass_depth_test(geometry, context.depth_format)


def _key(scene: AnyScene) -> Mesh | ClipScene:
    return scene if isinstance(scene, ClipScene) else scene.meshes[0]


def _draw_visible(
    context: DrawContext, colors: "PaletteColors | SmoothColors | None"
) -> tuple[NearestFragments, Route]:
    """Find what is seen, then colour it."""
    nearest, split = find_visible(context)
    if not isinstance(colors, PaletteColors):  # which writes the background as one of its colours
        with context.timed("resolve"):
            context.pixels.fill(context.background)
    if colors is None:
        from core.fast_path.fragment_colors import shade_visible

        return nearest, Route("packed-depth", "deferred", split, shade_visible(context, nearest))
    with context.timed(colors.stage):
        return nearest, Route("packed-depth", colors.name, split, colors.look_up(context, nearest))
