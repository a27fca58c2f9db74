"""Choosing samples, culling, clipping, depth and order together: one bound, the width of the candidates' colours.

Fewer samples, culled backs, triangles that are not clipped and a coarser depth change which of the candidates a pixel
shows, so together they cost no more than the width of the candidates (see ``surfaces``), not the sum of it.
"""

from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Flags, Floats
from core.geometry.vertex_stage import CornerPositionsOnDemand
from core.methods import table
from core.scene import AnyScene, Scene
from core.settings import Settings
from core.study.planner.color_ranges import ColorRanges
from core.study.planner.orders import doubtful_pixels
from core.study.planner.records import Tolerance
from core.study.planner.surfaces import Surfaces, format_margin, surfaces
from core.study.planner.touched import Touched
from core.study.planner.value_bounds import is_cut

DEPTHS = ("z-16", "z-24", "z-float32")
"""Formats by the bits that they keep."""
SAMPLES = 4
"""Samples on a side of a pixel of everything on."""
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
    side: int
    """Samples on a side of a pixel that are left."""
    beyond: int
    """Pixels that would differ by more than the tolerance with one sample a pixel, by the widths."""
    doubtful: int
    """Pixels where the order is in doubt without a depth buffer."""
    coarse: int
    """Pixels where the coarsest format may take one surface for the other."""
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
    chosen = _with_one_sample(touched, colors, scene, settings, tolerance, blended)
    cut = int(np.count_nonzero(is_cut(touched)))
    if chosen is None:
        chosen = replace(settings, clipping=settings.clipping if cut else "homogeneous"), 0.0, 0
        if everything.cull == "none" and not _backs(touched, dearest).any():
            chosen = replace(chosen[0], cull="back"), 0.0, 0
    found, error, pixels = chosen
    side = 1 if found.antialiasing == "none" else SAMPLES
    coarse = [_coarse_pixels(touched, colors, scene, name, side, blended) for name in DEPTHS]
    if side > 1:
        fit = [name for name, count in zip(DEPTHS, coarse, strict=True) if count == 0]
        found = replace(found, depth=fit[0] if fit else everything.depth)
    doubtful = len(touched.pixel)
    if not cut:
        found, doubtful = _without_depth(touched, found, side)
    return SurfaceChoice(
        found,
        dearest,
        error,
        pixels,
        side,
        int(np.count_nonzero(dearest.width > tolerance.bytes)),
        doubtful,
        coarse[0],
        len(np.unique(touched.pixel[_backs(touched, dearest)])),
        cut,
        translucent,
    )


def _coarse_pixels(
    touched: Touched, colors: ColorRanges, scene: AnyScene, depth: str, side: int, blended: bool
) -> int:
    """Return in how many pixels of several colours a format may take one surface for another."""
    margin = format_margin(depth)
    found = surfaces(touched, colors, scene.background, margin, is_blended=blended)
    is_wide = found.is_candidate & (found.width[touched.pixel] > 0)
    return len(doubtful_pixels(touched, is_wide, margin, side))


def _with_one_sample(
    touched: Touched,
    colors: ColorRanges,
    scene: AnyScene,
    settings: Settings,
    tolerance: Tolerance,
    blended: bool,
) -> tuple[Settings, float, int] | None:
    """Return the cheapest settings with one sample a pixel, their error and pixels beyond; ``None``: there are none."""
    if settings.blend == "additive":
        return None
    for depth in (*DEPTHS, settings.depth):
        for cull in ("back", "none") if settings.cull == "none" else (settings.cull,):
            found = surfaces(
                touched, colors, scene.background, format_margin(depth), cull == "back", blended
            )
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
    is_drawn = np.ones(len(touched.pixel), bool)
    if settings.cull == "back":
        is_drawn = touched.facing.take(touched.primitive) > 0
    elif settings.cull == "front":
        is_drawn = touched.facing.take(touched.primitive) < 0
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
