"""Choosing samples, culling, clipping, depth and order together: one bound, the width of the candidates' colours.

Fewer samples, culled backs, triangles that are not clipped and a coarser depth change which of the candidates a pixel
shows, so together they cost no more than the width of the candidates (see ``surfaces``), not the sum of it.
"""

from dataclasses import dataclass, replace

import numpy as np

from core.geometry.vertex_stage import CornerPositionsOnDemand
from core.methods import table
from core.records.arrays import Flags, Integers
from core.scene import AnyScene
from core.settings import Settings, with_method
from core.study.planner.bounds.color_ranges import ColorRanges, color_ranges, joined_ranges
from core.study.planner.bounds.sample_errors import SampleError, sample_error
from core.study.planner.bounds.translucency import alphas, is_translucent
from core.study.planner.choices.costs import Costs
from core.study.planner.progress import Pause, unpaused
from core.study.planner.records import Tolerance
from core.study.planner.scene_analysis.conservative_coverage import Touched, is_cut
from core.study.planner.scene_analysis.covered_once import is_covered_once
from core.study.planner.scene_analysis.orders import doubtful_pixels
from core.study.planner.scene_analysis.per_sample_check import doubtful_backs, doubtful_depths
from core.study.planner.scene_analysis.sample_patterns import PATTERNS, Pattern
from core.study.planner.scene_analysis.surfaces import Surfaces, format_margin, surfaces

DEPTHS = ("z-16", "z-24", "z-float32")
"""Formats by the bits that they keep."""
ORDERS = ("last-drawn", "painters")
"""Visibility without a depth buffer, the cheaper first."""
FEWER = ("none", "msaa-4", "ssaa-4")
"""Fewer samples than everything on has.

Exact areas are bounded by the widths alone: where these are small enough, one sample does too; else they take 0.8 to 60
times as long as 4 x 4 samples. 3 x 3 samples are within 8/255 of these on 25 of 70 scenes of ``corpus``, 2 x 2 on 23,
nearly all of which need one only."""


@dataclass(frozen=True, eq=False)
class SurfaceChoice:
    """What was chosen of the stages that decide what is seen where."""

    settings: Settings
    surfaces: Surfaces
    """The candidates, with the formats and faces of everything on."""
    colors: ColorRanges
    """At the places that the chosen samples have their colours of."""
    error: float
    """Bound for all of them together, in 1/255; 0: what is seen does not change at any sample."""
    pixels: int
    """Pixels that may differ by more."""
    beyond: int
    """Pixels that would differ by more than the tolerance with one sample a pixel, by the widths."""
    cut: int
    """Triangles that cross a plane of the view volume."""
    translucent: bool
    sample_pixels: int = 0
    """Pixels that the samples alone may change by more."""
    cull_pixels: int = 0
    """Those that culling alone may change."""
    depth_pixels: int = 0
    """Those that the depth format alone may change."""
    doubtful: int = 0
    """Pixels where the order is in doubt without a depth buffer."""
    coarse: int = 0
    """Pixels where z-16 may take one surface for the other."""
    back_pixels: int = 0
    """Pixels where a back face may be seen."""
    is_once: bool = False
    """Whether every sample is covered by one triangle at most."""
    by_widths: bool = False
    """Whether one bound, the candidates' width, holds for samples, culling, clipping and depth together."""
    rejected: tuple[tuple[str, SampleError], ...] = ()
    """Fewer samples that are too far off, and how far."""
    slower: tuple[tuple[str, str], ...] = ()
    """Settings and methods that would do but take longer."""

    @property
    def pattern(self) -> Pattern:
        """The samples that are left."""
        return PATTERNS[self.settings.antialiasing]


class SurfaceChooser:
    """Chooses stage by stage; what was chosen before is kept."""

    def __init__(
        self,
        touched: Touched,
        colors: ColorRanges,
        scene: AnyScene,
        everything: Settings,
        tolerance: Tolerance,
        costs: Costs,
        pause: Pause = unpaused,
    ) -> None:
        self._touched, self._colors, self._scene = touched, colors, scene
        self._everything, self._tolerance, self._costs = everything, tolerance, costs
        self._pause = pause
        """Asked between the parts."""
        self._translucent = is_translucent(touched, scene)
        self._blended = self._translucent or everything.blend == "additive"
        self._slower: list[tuple[str, str]] = []
        self._cut = int(np.count_nonzero(is_cut(touched)))

    def choose(self) -> SurfaceChoice:
        """Choose what is cheapest while the tolerance holds."""
        everything, tolerance = self._everything, self._tolerance
        dearest = self._surfaces(everything.depth, False)
        if everything.blend == "additive":
            dearest = replace(dearest, width=np.full_like(dearest.width, 255.0))
        settings = everything if self._blended else replace(everything, blend="opaque")
        beyond = int(np.count_nonzero(dearest.width > tolerance.bytes))
        start = SurfaceChoice(settings, dearest, self._colors, 0.0, 0, beyond, self._cut, self._translucent)
        # Coarser depths and culled backs hide less, so nothing does where even the dearest are too wide.
        found = self._with_one_sample(start) if beyond <= tolerance.pixels else None
        if found is None:
            is_added = everything.blend == "additive"
            found = self._with_samples_unchanged(start if is_added else self._with_fewer_samples(start))
        found = self._without_depth(found)
        if not self._blended and not self._is_worth(found.settings, "blend", "opaque"):
            found = replace(found, settings=replace(found.settings, blend=everything.blend))
        return replace(found, slower=tuple(self._slower))

    def _surfaces(self, depth: str, culls_backs: bool) -> Surfaces:
        self._pause()
        margin = format_margin(depth)
        background = self._scene.background
        return surfaces(self._touched, self._colors, background, margin, culls_backs, self._blended)

    def _is_worth(self, settings: Settings, name: str, method: str) -> bool:
        """Tell whether a method is not known to be slower than everything on's, and remember if it is."""
        dearest = with_method(settings, name, getattr(self._everything, name))
        if self._costs.is_slower(with_method(settings, name, method), dearest):
            self._slower.append((name, method))
            return False
        return True

    def _with_one_sample(self, start: SurfaceChoice) -> SurfaceChoice | None:
        """Choose with one sample a pixel, all by the widths of the candidates; ``None``: that is too far off."""
        settings, tolerance = start.settings, self._tolerance
        culls = ("back", "none") if settings.cull == "none" else (settings.cull,)
        backs = len(np.unique(self._touched.pixel[self._backs(start.surfaces)]))
        for depth in dict.fromkeys((*DEPTHS, settings.depth)):
            for cull in culls:
                found = self._surfaces(depth, cull == "back")
                is_beyond = found.width > tolerance.bytes
                beyond = int(np.count_nonzero(is_beyond))
                if beyond > tolerance.pixels or (self._blended and cull == "back" and backs):
                    continue
                error = float(found.width[~is_beyond].max(initial=0.0))
                chosen = replace(
                    settings, antialiasing="none", clipping="homogeneous", depth=depth, cull=cull
                )
                # Each of them alone could be as in everything on, and the others still do.
                for name in ("cull", "clipping", "depth"):
                    dearest = getattr(self._everything, name)
                    has_effect = name != "clipping" or self._cut
                    if has_effect and not self._is_worth(chosen, name, getattr(chosen, name)):
                        chosen = with_method(chosen, name, dearest)
                return replace(
                    start,
                    settings=chosen,
                    error=error,
                    pixels=beyond,
                    sample_pixels=beyond,
                    cull_pixels=beyond,
                    depth_pixels=beyond,
                    back_pixels=backs,
                    by_widths=True,
                )
        return None

    def _with_fewer_samples(self, start: SurfaceChoice) -> SurfaceChoice:
        """Choose how many samples, each of which shows what it would with everything on."""
        best, rejected = start, []
        for name in FEWER:
            if self._blended and not PATTERNS[name].stays_inside:
                # How much shines through is not bounded beyond the corners.
                continue
            settings = replace(start.settings, antialiasing=name)
            colors, error = self._colors, self._sample_error(name, self._colors, start.surfaces)
            if error.beyond <= self._tolerance.pixels and not PATTERNS[name].stays_inside:
                colors, error = self._error_beyond_corners(name, start)
            if error.beyond > self._tolerance.pixels:
                rejected.append((name, error))
            elif self._costs.is_slower(settings, start.settings):
                self._slower.append(("antialiasing", name))
            elif best is start or self._costs.is_slower(best.settings, settings):
                best = replace(
                    start,
                    settings=settings,
                    colors=colors,
                    error=error.error,
                    pixels=error.beyond,
                    sample_pixels=error.beyond,
                )
        return replace(best, rejected=tuple(rejected))

    def _sample_error(self, name: str, colors: ColorRanges, seen: Surfaces) -> SampleError:
        self._pause()
        return sample_error(
            self._touched,
            (self._colors, colors),
            seen,
            self._scene.background,
            PATTERNS[name],
            format_margin(self._everything.depth),
            (self._tolerance.bytes, self._tolerance.pixels),
            alphas(self._touched, self._scene) if self._blended else None,
        )

    def _error_beyond_corners(self, name: str, start: SurfaceChoice) -> tuple[ColorRanges, SampleError]:
        """Return the colours at pixels' centres, which may lie beyond the triangles, and the error with these."""
        known = self._colors.is_known
        colors = color_ranges(
            self._touched, self._scene, self._everything, known, stays_inside=False, pause=self._pause
        )
        both, margin = joined_ranges(self._colors, colors), format_margin(start.settings.depth)
        seen = surfaces(self._touched, both, self._scene.background, margin)
        return colors, self._sample_error(name, colors, seen)

    def _with_samples_unchanged(self, start: SurfaceChoice) -> SurfaceChoice:
        """Choose culling and depth where nothing may change at any of the samples that are left."""
        touched, settings, pattern = self._touched, start.settings, start.pattern
        left = self._tolerance.pixels - start.pixels
        if not self._cut:
            settings = replace(settings, clipping="homogeneous")
        backs = np.unique(touched.pixel[self._backs(start.surfaces)])
        cull_pixels = 0
        if settings.cull == "none":
            if not self._blended:
                backs = doubtful_backs(touched, backs, format_margin(settings.depth), pattern)
            if len(backs) <= left and self._is_worth(settings, "cull", "back"):
                settings, cull_pixels = replace(settings, cull="back"), len(backs)
                left -= cull_pixels
        is_drawn = self._is_drawn(settings)
        self._pause()
        coarse, depth_pixels = [], 0
        for name in DEPTHS:
            self._pause()
            margin = format_margin(name)
            doubtful = self._coarse_pixels(margin, is_drawn, pattern)
            coarse.append(len(doubtful_depths(touched, doubtful, is_drawn, margin, pattern)))
            if coarse[-1] <= left and self._is_worth(settings, "depth", name):
                settings, depth_pixels = replace(settings, depth=name), coarse[-1]
                break
        return replace(
            start,
            settings=settings,
            pixels=start.pixels + cull_pixels + depth_pixels,
            cull_pixels=cull_pixels,
            depth_pixels=depth_pixels,
            coarse=coarse[0],
            back_pixels=len(backs),
        )

    def _coarse_pixels(self, margin: float, is_drawn: Flags, pattern: Pattern) -> Integers:
        """Return the pixels of several colours in which one surface may be taken for another."""
        touched = self._touched
        found = surfaces(touched, self._colors, self._scene.background, margin, is_blended=self._blended)
        is_wide = found.is_candidate & (found.width[touched.pixel] > 0)
        return doubtful_pixels(touched, is_wide & is_drawn, margin, pattern.scale)

    def _without_depth(self, start: SurfaceChoice) -> SurfaceChoice:
        """Choose the cheapest order that needs no depth buffer, where there is one."""
        touched, settings, scale = self._touched, start.settings, start.pattern.scale
        if self._cut and settings.clipping == "homogeneous":
            # Pieces are looked at, but whole triangles drawn.
            return start
        if is_covered_once(touched, settings.cull == "back", scale):
            if self._is_worth(settings, "visibility", ORDERS[0]):
                settings = replace(settings, visibility=ORDERS[0])
            return replace(start, settings=settings, is_once=True)
        is_drawn, doubtful = self._is_drawn(settings), []
        # What is drawn behind a translucent surface that is there already fails the depth test: sorted, it would not.
        for name in ORDERS[:1] if self._blended else ORDERS:
            drawing = table.get("visibility", name).function(
                CornerPositionsOnDemand(touched.geometry.vertices)
            )
            place = np.empty(len(drawing.order), np.int64)
            place[drawing.order] = np.arange(len(drawing.order))
            rank = place[touched.geometry.primitives.triangle]
            self._pause()
            margin = format_margin(settings.depth)
            doubtful.append(len(doubtful_pixels(touched, is_drawn, margin, scale, rank)))
            if doubtful[-1] == 0 and self._is_worth(settings, "visibility", name):
                settings = replace(settings, visibility=name)
                break
        return replace(start, settings=settings, doubtful=doubtful[0])

    def _backs(self, found: Surfaces) -> Flags:
        """Return (Q,) bool, the candidates that face away."""
        return np.asarray(found.is_candidate & (self._touched.facing.take(self._touched.primitive) <= 0))

    def _is_drawn(self, settings: Settings) -> Flags:
        """Return (Q,) bool, the pairs whose facing is not culled."""
        touched = self._touched
        if settings.cull == "none":
            return np.ones(len(touched.pixel), bool)
        facing = touched.facing.take(touched.primitive)
        return np.asarray(facing >= 0 if settings.cull == "back" else facing <= 0)
