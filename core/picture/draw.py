"""Draw a picture: choose by what the scene holds, draw, and say which way was taken."""

from dataclasses import replace
from functools import partial
from threading import local
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from core.antialiased.sample_counts import sample_count, side_of
from core.antialiased.supersampling import finer_settings
from core.arrays import read_only
from core.frame import STAGES, StageCount
from core.framebuffer.nearest import NearestFragments
from core.geometry_stages import process_geometry
from core.methods import table
from core.picture.blended import draw_blended
from core.picture.byte_colors import byte_colors
from core.picture.cleared import all_pass_depth_test
from core.picture.deferred import shade_visible
from core.picture.job import Job, Words, encode
from core.picture.layer import LayerColors, draw_layer
from core.picture.lit_normals import LitNormals, lit_normals
from core.picture.lit_texture import LitTexture, lit_texture
from core.picture.multisampled import draw_multisampled
from core.picture.palette import PaletteColors, palette
from core.picture.record import Picture, Route, Split
from core.picture.supersampled import draw_supersampled
from core.picture.textured import texture_colors
from core.picture.visible import find_visible
from core.pipeline import draw
from core.raster.number_format import number_format
from core.raster.schedule import Raster, make_raster
from core.raster.spans.arena import Arena
from core.scene import AnyScene, ClipScene, Mesh
from core.settings import Settings
from core.timing import timed

Colors = LayerColors | LitNormals | LitTexture

ENCODINGS = ("srgb", "linear")

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
    plain_colors: bool = False,
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
    plain_colors : bool
        Attributes and light at every pixel, even where the triangles of the region allow cheaper colours: those of the
        whole picture may not, see `Route`.

    Returns
    -------
    Picture

    Raises
    ------
    ValueError
        As `core.render`, and for an unknown encoding.

    Notes
    -----
    A supersampled picture is drawn as the bytes of its samples, which are resolved in linear light: up to one byte
    more away than they are.

    The triangle seen at every pixel is that of `render`. The bytes are those of `render` and `to_display` where the
    `Route` has the colours ``palette`` or ``deferred``, as multisampled pictures always have; with ``bytes``,
    ``normals`` and ``lit-texture`` they are up to one away, with ``texture`` up to two. In a triangle that is hardly
    wider than snapping moves it, ``bytes`` stay between those of the corners, where `render` extrapolates.
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

    if (
        side_of(settings)
        and not with_depth
        and settings.pixel_center == "half"
        and is_drawn_by_spans(finer_settings(settings))
    ):
        draw_part = partial(draw_picture, plain_colors=plain_colors)
        return draw_supersampled(draw_part, scene, settings, raster, encoding, pixels, arena)
    if (
        settings.antialiasing == "msaa-4"
        and not with_depth
        and settings.blend == "opaque"
        and is_drawn_by_spans(replace(settings, antialiasing="none"))
    ):
        route = draw_multisampled(scene, settings, raster, encoding, pixels, counts, arena)
        _count(counts, route, len(pixels))
        counts["resolve"].incoming = sample_count(settings) * len(pixels)
        return Picture(_bytes(pixels, raster), None, counts, route)
    if not is_drawn_by_spans(settings) or (settings.blend != "opaque" and with_depth):
        return _draw_frame(scene, settings, raster, encoding, pixels, with_depth)
    geometry = process_geometry(scene, settings, counts, raster=raster)
    job = Job(scene, settings, geometry, raster, encoding, pixels, counts, arena)
    depth = None
    if settings.blend != "opaque":
        route = _draw_stacks(job)
    else:
        allowed = _choose_colors(job)
        colors = None if plain_colors and not isinstance(allowed, PaletteColors) else allowed
        layer = None if with_depth else _draw_layer(job, colors)
        if layer is None:
            nearest, route = _draw_visible(job, colors)
            depth = read_only(nearest.depth().reshape(raster.shape)) if with_depth else None
        else:
            route = layer
        # A part without triangles forbids nothing, as one colour a triangle does not.
        name = allowed.name if allowed else "deferred"
        route = replace(route, allowed=name if len(geometry.primitives) else PaletteColors.name)
    _count(counts, route, len(pixels))
    return Picture(_bytes(pixels, raster), depth, counts, route)


def _draw_frame(
    scene: AnyScene, settings: Settings, raster: Raster, encoding: str, pixels: Words, with_depth: bool
) -> Picture:
    """Draw all buffers, and encode the colours."""
    frame = draw(scene, settings, raster)
    with timed(frame.statistics["resolve"]):
        pixels[:] = encode(frame.color.reshape(-1, 4), encoding)
    route = Route("frame", "deferred", None, int(np.count_nonzero(frame.primitive >= 0)))
    depth = frame.depth if with_depth else None
    return Picture(_bytes(pixels, raster), depth, frame.statistics, route)


def _draw_stacks(job: Job) -> Route:
    """Draw every fragment in its turn."""
    with job.timed("shade"):
        of_triangles = palette(job)
    split = draw_blended(job, of_triangles)
    return Route("stacks", "deferred" if of_triangles is None else "palette", split, split.fragments)


def _draw_layer(job: Job, colors: Colors | None) -> Route | None:
    """Draw without depth, if that can be right; ``None``: it is not."""
    if (
        colors is None
        or isinstance(colors, LitNormals | LitTexture)
        or not colors.fits_layer
        or not _may_be_one_layer(job)
    ):
        return None
    fragments = draw_layer(job, colors)
    if fragments is None:
        _overlaps[_key(job.scene)] = True
        return None
    return Route("layer", colors.name, Split(len(job.geometry.primitives), 0, 0, fragments), fragments)


def _draw_visible(job: Job, colors: Colors | None) -> tuple[NearestFragments, Route]:
    """Find what is seen, then colour it."""
    nearest, split = find_visible(job)
    with job.timed("resolve"):
        job.pixels.fill(job.background)
    if colors is None:
        return nearest, Route("words", "deferred", split, shade_visible(job, nearest))
    with job.timed(colors.stage):
        return nearest, Route("words", colors.name, split, colors.look_up(job, nearest))


def _choose_colors(job: Job) -> Colors | None:
    """Return the cheapest colours that give the right bytes; ``None``: only attributes and light per pixel do."""
    with job.timed("shade"):
        of_triangles = palette(job)
        if of_triangles is not None:
            return PaletteColors(job.encode(of_triangles))
    with job.timed("interpolate"):
        return byte_colors(job) or lit_normals(job) or lit_texture(job) or texture_colors(job)


def is_drawn_by_spans(settings: Settings) -> bool:
    """Tell whether spans can draw with these settings: all filled, at centres, in numbers that suit, without rays."""
    is_outlined = table.get("polygon_mode", settings.polygon_mode).function()
    suits_spans = number_format(settings.coverage).suits_spans and settings.visibility != "ray-casting"
    return settings.fill == "spans" and not is_outlined and suits_spans and settings.antialiasing == "none"


def _key(scene: AnyScene) -> Mesh | ClipScene:
    return scene if isinstance(scene, ClipScene) else scene.meshes[0]


def _may_be_one_layer(job: Job) -> bool:
    """Tell whether it is worth trying without depth: one triangle, or a mesh of which only one side is drawn."""
    geometry, scene = job.geometry, job.scene
    if not (geometry.is_projected.all() and geometry.is_in_range.all()):
        return False
    count = len(geometry.primitives)
    is_likely = count <= FEW or (job.settings.cull != "none" and not isinstance(scene, ClipScene))
    if count > 1 and (not is_likely or _key(scene) in _overlaps):
        return False
    with job.timed("depth"):
        return all_pass_depth_test(geometry, job.depth_format)


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
