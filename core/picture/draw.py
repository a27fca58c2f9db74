"""Draw a picture: choose by what the scene holds, draw, and say which way was taken."""

from threading import local
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from core.arrays import read_only
from core.frame import STAGES, StageCount
from core.framebuffer.nearest import NearestFragments
from core.geometry_stages import Geometry, process_geometry, timed
from core.methods import table
from core.picture.blended import draw_blended
from core.picture.byte_colors import byte_colors
from core.picture.cleared import all_pass_depth_test
from core.picture.deferred import encode, shade_visible
from core.picture.layer import LayerColors, draw_layer
from core.picture.lit_normals import LitNormals, lit_normals
from core.picture.palette import PaletteColors, palette
from core.picture.record import Picture, Route, Split
from core.picture.textured import texture_colors
from core.picture.visible import find_visible
from core.pipeline import draw
from core.raster.schedule import Raster, make_raster
from core.raster.spans.arena import Arena
from core.scene import AnyScene, ClipScene, Mesh
from core.settings import Settings

ENCODINGS = ("srgb", "linear")

Words = NDArray[np.uint32]

FEW = 16
"""Triangles: so few are tried without depth, since it costs little."""

_memory = local()
_overlaps: WeakKeyDictionary[Mesh | ClipScene, bool] = WeakKeyDictionary()
"""Scenes, by their first mesh, that turned out to have more than one layer: depth is not left out again."""


def draw_picture(
    scene: AnyScene,
    settings: Settings | None = None,
    *,
    encoding: str = "srgb",
    with_depth: bool = False,
    region: tuple[int, int, int, int] | None = None,
    out: NDArray[np.uint8] | None = None,
    arena: Arena | None = None,
) -> Picture:
    """Draw a scene as the bytes of a screen.

    Parameters
    ----------
    scene : Scene or ClipScene
    settings : Settings, optional
    encoding : str
        ``"srgb"`` as `to_display`, or ``"linear"``: bytes of the linear colours.
    with_depth : bool
        Keep the depth buffer.
    region : (column, row, columns, rows), optional
        Pixels of the image that are drawn; the whole image by default.
    out : (H, W, 4) uint8, C-contiguous, optional
        Memory for the pixels.
    arena : Arena, optional
        Memory to work in; one per thread by default.

    Returns
    -------
    Picture

    Raises
    ------
    ValueError
        As `core.render`, and for an unknown encoding.

    Notes
    -----
    The bytes are those of `render` and `to_display`; where corner colours are interpolated as bytes (see `Route`), up
    to one away from them.
    """
    settings = settings or Settings()
    raster = make_raster(scene.size, settings.pixel_center, region)
    if encoding not in ENCODINGS:
        raise ValueError(f"encoding must be one of {', '.join(ENCODINGS)}, got {encoding}")
    shape = (*raster.shape, 4)
    if out is not None and (out.shape != shape or out.dtype != np.uint8 or not out.flags.c_contiguous):
        raise ValueError(f"out must be {shape} uint8 and contiguous, got {out.shape} {out.dtype}")
    arena = arena or _memory.__dict__.setdefault("arena", Arena())
    counts = {stage: StageCount() for stage in STAGES}
    with timed(counts["resolve"]):
        pixels = (np.empty(shape, np.uint8) if out is None else out).reshape(-1).view(np.uint32)

    if not is_drawn_by_spans(settings) or (settings.blend != "opaque" and with_depth):
        frame = draw(scene, settings, raster)
        with timed(frame.statistics["resolve"]):
            pixels[:] = encode(frame.color.reshape(-1, 4), encoding)
        route = Route("frame", "deferred", None, int(np.count_nonzero(frame.primitive >= 0)))
        return Picture(_bytes(pixels, raster), frame.depth, frame.statistics, route)

    geometry = process_geometry(scene, settings, counts)
    depth = None
    if settings.blend != "opaque":
        route = _draw_stacks(scene, geometry, settings, raster, encoding, pixels, counts, arena)
    else:
        colors = _choose_colors(scene, geometry, settings, raster, encoding, counts)
        background = encode(scene.background[None], encoding)[0]
        fragments = None
        if (
            isinstance(colors, LayerColors)
            and colors.fits_layer
            and not with_depth
            and _may_be_one_layer(scene, geometry, settings)
        ):
            fragments = draw_layer(geometry, colors, settings, raster, background, pixels, counts, arena)
            if fragments is None:
                _overlaps[_key(scene)] = True
        if fragments is not None and colors is not None:
            split = Split(len(geometry.primitives), 0, 0, fragments)
            route = Route("layer", colors.name, split, fragments)
        else:
            nearest, split = find_visible(geometry, settings, raster, counts, arena)
            with timed(counts["resolve"]):
                pixels.fill(background)
            visible = _color_visible(
                scene, geometry, settings, raster, nearest, colors, encoding, pixels, counts, arena
            )
            route = Route("words", colors.name if colors else "deferred", split, visible)
            if with_depth:
                with timed(counts["resolve"]):
                    depth = read_only(nearest.depth().reshape(raster.shape))
    _count(counts, route, len(pixels))
    return Picture(_bytes(pixels, raster), depth, counts, route)


def _draw_stacks(
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    encoding: str,
    pixels: Words,
    counts: dict[str, StageCount],
    arena: Arena,
) -> Route:
    """Draw every fragment in its turn."""
    with timed(counts["shade"]):
        of_triangles = palette(scene, geometry, settings)
    blended, split = draw_blended(scene, geometry, settings, raster, of_triangles, counts, arena)
    with timed(counts["resolve"]):
        pixels[:] = encode(blended, encoding)
    return Route("stacks", "deferred" if of_triangles is None else "palette", split, split.fragments)


def _color_visible(
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    nearest: NearestFragments,
    colors: LayerColors | LitNormals | None,
    encoding: str,
    pixels: Words,
    counts: dict[str, StageCount],
    arena: Arena,
) -> int:
    """Write the colours of what is seen over the background; return how many pixels that is."""
    if colors is None:
        return shade_visible(scene, geometry, settings, raster, nearest, encoding, pixels, counts, arena)
    with timed(counts[colors.stage]):
        return colors.look_up(nearest, raster, pixels, arena)


def _choose_colors(
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    encoding: str,
    counts: dict[str, StageCount],
) -> LayerColors | LitNormals | None:
    """Return the cheapest colours that give the right bytes; ``None``: only attributes and light per pixel do."""
    with timed(counts["shade"]):
        of_triangles = palette(scene, geometry, settings)
        if of_triangles is not None:
            return PaletteColors(encode(of_triangles, encoding))
    with timed(counts["interpolate"]):
        return (
            byte_colors(scene, geometry, settings, encoding, raster.center)
            or lit_normals(scene, geometry, settings, encoding, raster.center)
            or texture_colors(scene, geometry, settings, encoding)
        )


def is_drawn_by_spans(settings: Settings) -> bool:
    """Tell whether a picture with these settings can be drawn by spans: everything is filled."""
    is_outlined = table.get("polygon_mode", settings.polygon_mode).function()
    return settings.fill == "spans" and not is_outlined


def _key(scene: AnyScene) -> Mesh | ClipScene:
    return scene if isinstance(scene, ClipScene) else scene.meshes[0]


def _may_be_one_layer(scene: AnyScene, geometry: Geometry, settings: Settings) -> bool:
    """Tell whether it is worth trying without depth: one triangle, or a mesh of which only one side is drawn."""
    if not (geometry.is_projected.all() and geometry.is_in_range.all()):
        return False
    is_likely = len(geometry.primitives) <= FEW or (
        settings.cull != "none" and not isinstance(scene, ClipScene)
    )
    if len(geometry.primitives) > 1 and (not is_likely or _key(scene) in _overlaps):
        return False
    return all_pass_depth_test(geometry, table.get("depth", settings.depth).function())


def _count(counts: dict[str, StageCount], route: Route, pixel_count: int) -> None:
    """Note how much each stage took in and gave out."""
    fragments = route.split.fragments if route.split else 0
    counts["bin"].incoming = counts["edges"].outgoing
    counts["bin"].outgoing = counts["raster"].outgoing = counts["depth"].incoming = fragments
    for stage in ("interpolate", "shade", "blend"):
        counts[stage].incoming = counts[stage].outgoing = route.visible
    counts["depth"].outgoing = route.visible
    counts["resolve"].incoming = counts["resolve"].outgoing = pixel_count


def _bytes(words: Words, raster: Raster) -> NDArray[np.uint8]:
    return read_only(words.view(np.uint8).reshape(*raster.shape, 4))
