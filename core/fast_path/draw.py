"""Draw a picture: choose by what the scene holds, draw, and say which way was taken.

A way that is not that of most pictures is imported when it is first taken: the first picture does not wait for it.
"""

from dataclasses import replace
from functools import partial
from threading import local

import numpy as np
from numpy.typing import NDArray

from core.coverage.pixel_runs import Raster, make_raster
from core.families import decides_itself, suited
from core.fast_path.draw_context import Coloring, DepthStatistics, DrawContext, Picture, Route, Words, encode
from core.fast_path.opaque import draw_opaque
from core.fast_path.unlit import palette
from core.numeric.large_arrays import ScratchBuffers, short_buffers
from core.records.arrays import Integers, read_only
from core.records.frame import StageCount
from core.resolved import resolve
from core.scene import AnyScene
from core.settings import DEFAULTS, Settings
from core.stages.before_matrices import before_matrices
from core.stages.declared import STAGES
from core.stages.vertices import process_geometry

ENCODINGS = ("srgb", "linear")

_memory = local()


@short_buffers()
def draw_picture(
    scene: AnyScene,
    settings: Settings | None = None,
    *,
    encoding: str = "srgb",
    with_depth: bool = False,
    depth_at: Integers | None = None,
    region: tuple[int, int, int, int] | None = None,
    out: NDArray[np.uint8] | None = None,
    scratch: ScratchBuffers | None = None,
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
    depth_at : (N,) int64, optional
        Keep the depth of these pixels only: of row times columns plus column, counted in what is drawn.
    region : (column, row, columns, rows), optional
        Pixels of the image that are drawn; the whole image by default.
    out : (H, W, 4) uint8, C-contiguous, optional
        Memory for the pixels.
    scratch : ScratchBuffers, optional
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
        As `core.render`, for an unknown encoding, and where `out` or `depth_at` do not fit what is drawn.

    Notes
    -----
    A supersampled picture is drawn as the bytes of its samples, which are resolved in linear light: up to one byte
    more away than they are.

    The triangle seen at every pixel is that of `render`. The bytes are those of `render` and `to_display` where the
    `Route` has the colours ``palette`` or ``deferred``, as multisampled pictures always have; with ``corners``
    and ``lit`` they are up to one away, with ``texture`` up to three;
    but the filter ``nearest`` may take the other texel on the border between two. In a triangle that is hardly wider
    than snapping moves it and has corners much alike, ``corners`` stay between these, where `render` extrapolates.
    """
    settings = settings or DEFAULTS
    if scene.makes_positions:
        scene = before_matrices(scene, settings)
    if scene.corner_count != 3:
        settings = suited(settings, scene)
    raster = make_raster(scene.size, settings.pixel_center, region)
    if encoding not in ENCODINGS:
        raise ValueError(f"encoding must be one of {', '.join(ENCODINGS)}, got {encoding}")
    shape = (*raster.shape, 4)
    if out is not None and (out.shape != shape or out.dtype != np.uint8 or not out.flags.c_contiguous):
        raise ValueError(f"out must be {shape} uint8 and contiguous, got {out.shape} {out.dtype}")
    count = raster.shape[0] * raster.shape[1]
    if depth_at is not None and not (depth_at.min(initial=0) >= 0 and depth_at.max(initial=-1) < count):
        raise ValueError(
            f"depth_at must be places of pixels, 0 to {count - 1}, got {depth_at.min()} to {depth_at.max()}"
        )
    scratch = scratch or _memory.__dict__.setdefault("scratch", ScratchBuffers())
    counts = {stage: StageCount() for stage in STAGES}
    with counts["resolve"]:
        pixels = (np.empty(shape, np.uint8) if out is None else out).reshape(-1).view(np.uint32)

    keeps_depth = with_depth or depth_at is not None
    if scene.program is not None:
        return _draw_frame(scene, settings, raster, encoding, pixels, with_depth, depth_at)
    if not keeps_depth and _is_supersampled(settings):
        from core.fast_path.sampled import draw_supersampled

        draw_part = partial(draw_picture, plain_colors=plain_colors)
        return draw_supersampled(draw_part, scene, settings, raster, encoding, pixels, scratch)
    depth = None
    if not keeps_depth and _is_multisampled(settings):
        from core.fast_path.sampled import draw_multisampled

        route, passing = draw_multisampled(scene, settings, raster, encoding, pixels, counts, scratch)
    elif not is_drawn_by_spans(settings) or (settings.blend != "opaque" and keeps_depth):
        return _draw_frame(scene, settings, raster, encoding, pixels, with_depth, depth_at)
    else:
        geometry = process_geometry(scene, settings, counts, raster=raster)
        context = DrawContext(scene, settings, geometry, raster, encoding, pixels, counts, scratch)
        if settings.blend == "opaque":
            route, depth = draw_opaque(context, with_depth, depth_at, plain_colors)
            passing = DepthStatistics(route.visible, route.visible)
        else:
            route, passing = _draw_stacks(context)
    _count(counts, route, passing, resolve(settings).sampling.count * len(pixels), len(pixels))
    return Picture(_bytes(pixels, raster), depth, counts, route)


def _is_supersampled(settings: Settings) -> bool:
    """Return whether the samples of a pixel are pixels of a finer picture, drawn by spans."""
    if not resolve(settings).sampling.side or settings.pixel_center != "half":
        return False
    from core.antialiasing.resolve import finer_settings

    return is_drawn_by_spans(finer_settings(settings))


def _is_multisampled(settings: Settings) -> bool:
    """Return whether spans can find what each of four samples shows."""
    is_plain = settings.antialiasing == "msaa-4" and settings.blend == "opaque"
    return is_plain and is_drawn_by_spans(replace(settings, antialiasing="none"))


def _draw_frame(
    scene: AnyScene,
    settings: Settings,
    raster: Raster,
    encoding: str,
    pixels: Words,
    with_depth: bool,
    depth_at: Integers | None,
) -> Picture:
    """Draw all buffers, and encode the colours."""
    from core.pipeline import draw

    frame = draw(scene, settings, raster)
    with frame.statistics["resolve"]:
        pixels[:] = encode(frame.color.reshape(-1, 4), encoding)
    route = Route("frame", "deferred", None, int(np.count_nonzero(frame.primitive >= 0)))
    depth = frame.depth if with_depth else None
    if depth_at is not None:
        depth = read_only(frame.depth.reshape(-1).take(depth_at))
    return Picture(_bytes(pixels, raster), depth, frame.statistics, route)


def _draw_stacks(context: DrawContext) -> tuple[Route, DepthStatistics]:
    """Draw every fragment in its turn."""
    from core.fast_path.blended import draw_blended

    with context.timed("shade"):
        of_triangles = palette(context)
    blended = draw_blended(context, of_triangles)
    color: Coloring = "deferred" if of_triangles is None else "palette"
    return Route("stacks", color, blended.split, blended.visible), DepthStatistics(
        blended.passed, blended.passed
    )


def is_drawn_by_spans(settings: Settings) -> bool:
    """Return whether spans can draw with these settings: filled, at centres, in numbers that suit, by the table."""
    resolved = resolve(settings)
    suits_spans = resolved.numbers.suits_spans and not decides_itself(settings.visibility)
    is_filled = settings.fill == "spans" and not resolved.is_outlined and settings.antialiasing == "none"
    return is_filled and suits_spans and not settings.replacements


def _count(
    counts: dict[str, StageCount], route: Route, passing: DepthStatistics, sample_count: int, pixel_count: int
) -> None:
    """Note how much each stage took in and gave out; the ends of spans are computed, so no pixel was tested."""
    fragments = route.split.fragments if route.split else 0
    counts["bin"].incoming = counts["edges"].outgoing
    counts["bin"].outgoing = counts["raster"].outgoing = counts["depth"].incoming = fragments
    for stage in ("interpolate", "shade"):
        counts[stage].incoming = counts[stage].outgoing = passing.shaded
    counts["depth"].outgoing = counts["blend"].incoming = counts["blend"].outgoing = passing.passed
    counts["resolve"].incoming, counts["resolve"].outgoing = sample_count, pixel_count


def _bytes(words: Words, raster: Raster) -> NDArray[np.uint8]:
    return read_only(words.view(np.uint8).reshape(*raster.shape, 4))
