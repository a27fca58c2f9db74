"""Choosing samples, culling, clipping, depth and order together: one bound, the width of the candidates' colours.

Fewer samples, culled backs, triangles that are not clipped and a coarser depth change which of the candidates a pixel
shows, so together they cost no more than the width of the candidates (see ``surfaces``), not the sum of it.
"""

from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Flags, Floats, Integers
from core.geometry.vertex_stage import CornerPositionsOnDemand
from core.methods import table
from core.scene import AnyScene, Scene
from core.settings import Settings
from core.study.planner.closer import doubtful_backs, doubtful_depths
from core.study.planner.color_ranges import SAMPLES, ColorRanges
from core.study.planner.orders import doubtful_pixels
from core.study.planner.records import Tolerance
from core.study.planner.surfaces import Surfaces, format_margin, surfaces
from core.study.planner.touched import Touched
from core.study.planner.value_bounds import is_cut

DEPTHS = ("z-16", "z-24", "z-float32")
"""Formats by the bits that they keep."""
ORDERS = ("last-drawn", "painters")
"""Visibility without a depth buffer, the cheaper first."""


@dataclass(frozen=True, eq=False)
class SurfaceChoice:
    """What was chosen of the stages that decide what is seen where."""

    settings: Settings
    surfaces: Surfaces
    """The candidates, with the formats and faces of everything on."""
    error: float
    """Bound for all of them together, in 1/255; 0: what is seen does not change at any sample."""
    pixels: int
    """Pixels that may differ by more."""
    cull_pixels: int
    """Those of them that culling alone may change."""
    depth_pixels: int
    """Those of them that the depth format alone may change."""
    side: int
    """Samples on a side of a pixel that are left."""
    beyond: int
    """Pixels that would differ by more than the tolerance with one sample a pixel, by the widths."""
    doubtful: int
    """Pixels where the order is in doubt without a depth buffer."""
    coarse: int
    """Pixels where z-16 may take one surface for the other."""
    back_pixels: int
    """Pixels where a back face may be seen."""
    cut: int
    """Triangles that cross a plane of the view volume."""
    translucent: bool


def choose_surfaces(
    touched: Touched, colors: ColorRanges, scene: AnyScene, everything: Settings, tolerance: Tolerance
) -> SurfaceChoice:
    """Choose what is cheapest while the tolerance holds."""
    translucent = is_translucent(touched, scene)
    blended = translucent or everything.blend == "additive"
    dearest = surfaces(touched, colors, scene.background, format_margin(everything.depth), is_blended=blended)
    if everything.blend == "additive":
        dearest = replace(dearest, width=np.full_like(dearest.width, 255.0))
    settings = replace(everything, blend="opaque") if not blended else everything
    # Coarser depths and culled backs hide less, so nothing does where even the dearest are too wide.
    chosen = None
    if _beyond(dearest, tolerance) <= tolerance.pixels:
        chosen = _with_one_sample(touched, colors, scene, settings, tolerance, blended)
    cut = int(np.count_nonzero(is_cut(touched)))
    if chosen is None:
        kept = replace(settings, clipping=settings.clipping if cut else "homogeneous")
        return _with_all_samples(touched, colors, scene, kept, dearest, tolerance, cut, translucent)
    found, error, pixels = chosen
    doubtful = 0
    if not cut:
        found, doubtful = _without_depth(touched, found, 1)
    backs = len(np.unique(touched.pixel[_backs(touched, dearest)]))
    return SurfaceChoice(
        found,
        dearest,
        error,
        pixels,
        pixels,
        pixels,
        1,
        _beyond(dearest, tolerance),
        doubtful,
        0,
        backs,
        cut,
        translucent,
    )


def _with_all_samples(
    touched: Touched,
    colors: ColorRanges,
    scene: AnyScene,
    settings: Settings,
    dearest: Surfaces,
    tolerance: Tolerance,
    cut: int,
    translucent: bool,
) -> SurfaceChoice:
    """Choose culling, depth and order where all samples are kept: nothing may change at any of them."""
    blended = settings.blend != "opaque"
    spent = cull_pixels = 0
    backs = np.unique(touched.pixel[_backs(touched, dearest)])
    if settings.cull == "none":
        if not blended:
            backs = doubtful_backs(touched, backs, format_margin(settings.depth), SAMPLES)
        if len(backs) <= tolerance.pixels:
            settings, spent = replace(settings, cull="back"), len(backs)
            cull_pixels = spent
    is_drawn = _is_drawn(touched, settings)
    coarse = []
    for name in (*DEPTHS, settings.depth):
        margin = format_margin(name)
        doubtful = _coarse_pixels(touched, colors, scene, margin, is_drawn, blended)
        coarse.append(len(doubtful_depths(touched, doubtful, is_drawn, margin, SAMPLES)))
        if name == settings.depth or coarse[-1] <= tolerance.pixels - spent:
            spent += coarse[-1] if name != settings.depth else 0
            settings = replace(settings, depth=name)
            break
    unordered = 0
    if not cut:
        settings, unordered = _without_depth(touched, settings, SAMPLES)
    return SurfaceChoice(
        settings,
        dearest,
        0.0,
        spent,
        cull_pixels,
        spent - cull_pixels,
        SAMPLES,
        _beyond(dearest, tolerance),
        unordered,
        coarse[0],
        len(backs),
        cut,
        translucent,
    )


def _beyond(found: Surfaces, tolerance: Tolerance) -> int:
    return int(np.count_nonzero(found.width > tolerance.bytes))


def _coarse_pixels(
    touched: Touched, colors: ColorRanges, scene: AnyScene, margin: float, is_drawn: Flags, blended: bool
) -> Integers:
    """Return the pixels of several colours in which one surface may be taken for another."""
    found = surfaces(touched, colors, scene.background, margin, is_blended=blended)
    is_wide = found.is_candidate & (found.width[touched.pixel] > 0)
    return doubtful_pixels(touched, is_wide & is_drawn, margin, SAMPLES)


def _with_one_sample(
    touched: Touched,
    colors: ColorRanges,
    scene: AnyScene,
    settings: Settings,
    tolerance: Tolerance,
    blended: bool,
) -> tuple[Settings, float, int] | None:
    """Return the cheapest settings with one sample a pixel, their error and pixels beyond; ``None``: there are none."""
    for depth in (*DEPTHS, settings.depth):
        for cull in ("back", "none") if settings.cull == "none" else (settings.cull,):
            found = surfaces(touched, colors, scene.background, format_margin(depth), cull == "back", blended)
            is_beyond = found.width > tolerance.bytes
            beyond = int(np.count_nonzero(is_beyond))
            if beyond > tolerance.pixels or (blended and cull == "back"):
                continue
            error = float(found.width[~is_beyond].max(initial=0.0))
            chosen = replace(settings, antialiasing="none", clipping="homogeneous", depth=depth, cull=cull)
            return chosen, error, beyond
    return None


def _backs(touched: Touched, found: Surfaces) -> Flags:
    """Return (Q,) bool, the candidates that face away."""
    return np.asarray(found.is_candidate & (touched.facing.take(touched.primitive) <= 0))


def _without_depth(touched: Touched, settings: Settings, side: int) -> tuple[Settings, int]:
    """Return the settings with the cheapest order that needs no depth buffer, and how many pixels forbid the first."""
    is_drawn = _is_drawn(touched, settings)
    doubtful = []
    for name in ORDERS:
        drawing = table.get("visibility", name).function(CornerPositionsOnDemand(touched.geometry.vertices))
        place = np.empty(len(drawing.order), np.int64)
        place[drawing.order] = np.arange(len(drawing.order))
        rank = place[touched.geometry.primitives.triangle]
        doubtful.append(len(doubtful_pixels(touched, is_drawn, format_margin(settings.depth), side, rank)))
        if doubtful[-1] == 0:
            return replace(settings, visibility=name), doubtful[0]
    return settings, doubtful[0]


def _is_drawn(touched: Touched, settings: Settings) -> Flags:
    """Return (Q,) bool, the pairs whose facing is not culled."""
    if settings.cull == "none":
        return np.ones(len(touched.pixel), bool)
    facing = touched.facing.take(touched.primitive)
    return np.asarray(facing >= 0 if settings.cull == "back" else facing <= 0)


def is_translucent(touched: Touched, scene: AnyScene) -> bool:
    """Tell whether any alpha is not 1: of a vertex, or of a texel."""
    primitives = touched.geometry.primitives
    textures = [scene.texture] if not isinstance(scene, Scene) else [mesh.texture for mesh in scene.meshes]
    if any(
        texture is not None and texture.pixels.shape[2] == 4 and bool((texture.pixels[..., 3] != 1).any())
        for texture in textures
    ):
        return True
    alpha: Floats = primitives.varyings[..., primitives.layout.get("color", slice(0))][..., 3:4]
    return bool((np.abs(alpha - 1) > 1e-9).any())
