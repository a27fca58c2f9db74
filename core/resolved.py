"""Settings resolved: what the names in settings stand for, looked up once for all runs with the same settings.

Each is looked up when it is first asked for: a picture that draws no outlines does not wait for the files of lines.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from core.methods import Method, ReplacedName, is_registered, table
from core.records.arrays import cached_property
from core.settings import FAMILIES, Settings, families, no_effect

if TYPE_CHECKING:
    from core.antialiasing.sampling import Sampling
    from core.clipping.planes import PolygonClipping
    from core.coverage.edges import PixelRule
    from core.coverage.number_formats import NumberFormat
    from core.culling.normal_view import EyeTriangles, NormalView
    from core.depth.depth import DepthFormat
    from core.records.primitives import DrawingOrder

MIXING = "over"
"""Blend method of lines with intensities where the settings choose none that mixes."""


def import_methods(settings: Settings) -> None:
    """Import all methods that settings choose: before the stages are timed, so that no stage's time contains it."""
    for family in families():
        if not no_effect(settings, family):
            table.get(family, getattr(settings, family))


class ResolvedSettings:
    """What runs with some settings; make it with `resolve`."""

    def __init__(self, settings: Settings) -> None:
        self.settings = settings

    def method(self, family: str) -> Method:
        """Return the row of the table, or the one in its place, that the settings choose of a family."""
        return table.get(family, getattr(self.settings, family))

    @cached_property
    def imported(self) -> "ResolvedSettings":
        """The same, all methods imported: before stages are timed, so that no stage's time contains it."""
        import_methods(self.settings)
        return self

    @cached_property
    def draws_any_scene(self) -> bool:
        """Whether all methods are the defaults, which refuse no scene."""
        chosen = all(getattr(self.settings, family) == getattr(Settings, family) for family in FAMILIES)
        return chosen and not self.settings.replacements

    @cached_property
    def drops_facing(self) -> Callable[..., Any]:
        """Culling: which facings (T,) are dropped."""
        return self.method("cull").function

    @cached_property
    def look(self) -> "Callable[[EyeTriangles], NormalView] | None":
        """Culling by N . V: what it sees of triangles; ``None``: the facing decides."""
        look: Callable[[EyeTriangles], NormalView] | None = self.method("cull").traits
        return look

    @cached_property
    def asks_boxes(self) -> bool:
        """Whether a chosen method asks the boxes of a hierarchy."""
        return any("hierarchy" in self.method(family).takes for family in FAMILIES["hierarchy"].takers)

    @cached_property
    def drawing_order(self) -> "Callable[..., DrawingOrder]":
        """Visibility: from the corners of all triangles to their order."""
        return self.method("visibility").function

    @cached_property
    def clipping(self) -> "PolygonClipping":
        """How triangles are clipped."""
        clipping: PolygonClipping = self.method("clipping").function()
        return clipping

    @cached_property
    def clips(self) -> bool:
        """Whether triangles are clipped, even where no method needs it."""
        return self.clipping.is_any

    @cached_property
    def numbers(self) -> "NumberFormat":
        """The numbers that edge functions are computed in."""
        numbers: NumberFormat = self.method("coverage").function()
        return numbers

    @cached_property
    def owns_tie(self) -> Callable[..., Any]:
        """Fill rule: who owns a centre on an edge, by the edge's coefficients."""
        return self.method("fill_rule").function

    @cached_property
    def center(self) -> float:
        """Where in a pixel its centre lies."""
        center: float = self.method("pixel_center").function()
        return center

    @cached_property
    def fill_name(self) -> str:
        """The fill that runs; see `core.coverage.fills.effective_fill`."""
        from core.coverage.fills import effective_fill

        return effective_fill(self.settings.fill, self.settings.coverage)

    @cached_property
    def fill(self) -> Callable[..., Any]:
        """The schedule of pixels that the fill looks at."""
        return table.get("fill", self.fill_name).function

    @cached_property
    def pixel_rule(self) -> "PixelRule | None":
        """What decides on a pixel of a triangle, where it is not the inside test."""
        from core.coverage.pixel_runs import fill_traits

        return fill_traits(self.fill_name).rule

    @cached_property
    def looks_everywhere(self) -> bool:
        """Whether the fill looks at every pixel of the raster for every triangle."""
        from core.coverage.pixel_runs import fill_traits

        return fill_traits(self.fill_name).looks_everywhere

    @cached_property
    def is_outlined(self) -> bool:
        """Whether the edges of triangles are drawn, and not their areas."""
        is_outlined: bool = self.method("polygon_mode").function()
        return is_outlined

    @cached_property
    def clips_lines(self) -> bool:
        """Whether outlines are cut to the raster before they are drawn."""
        return self.is_outlined and not is_registered(self.settings.line_clipping, "none")

    @cached_property
    def clips_polygons(self) -> bool:
        """Whether polygons are cut to the clip window of the scene before they are filled."""
        return not is_registered(self.settings.polygon_clipping, "none")

    @cached_property
    def polygon_fill(self) -> Callable[..., Any]:
        """What of a row that crosses a polygon is inside, see `core.coverage.active_edges.Rule`."""
        return self.method("polygon_fill").function

    @cached_property
    def interpolation(self) -> tuple[Callable[..., Any], int, int]:
        """What an `Interpolator` takes: the rule of the weights, the provoking corner, columns between corrections."""
        provoking: int = self.method("provoking").function()
        return self.method("interpolation").function, provoking, self.settings.correction_interval

    @cached_property
    def is_flat(self) -> bool:
        """Whether all corners have the provoking corner's values already: a replaced function decides by itself."""
        return is_registered(self.settings.interpolation, "flat")

    @cached_property
    def shadow(self) -> Method | None:
        """How shadows are found, where light is computed at fragments; ``None``: there are none."""
        method = self.method("shadow")
        return method if method.traits and "shadow" in self.method("shading").takes else None

    @cached_property
    def environment(self) -> Method | None:
        """How mirrors find what is around them, where light is computed at fragments; ``None``: nothing mirrors."""
        method = self.method("environment")
        return method if method.traits and "environment" in self.method("shading").takes else None

    @cached_property
    def shades(self) -> str:
        """Which fragments are shaded, see `core.depth.early_depth`: all where visibility tests no depth in a buffer.

        What is mixed with others is not left out, though its depth does not stay.
        """
        which: str = self.method("depth_test_time").function()
        if "depth_test_time" not in self.method("visibility").takes:
            return "all"
        return "passing" if which == "left" and self.is_mixed else which

    @cached_property
    def depth_format(self) -> "DepthFormat":
        """How depth is stored and compared."""
        made: DepthFormat = self.method("depth").function()
        return made

    @cached_property
    def blend_inserted_for(self) -> str:
        """The line method that needs blending although the settings have none, else empty.

        The pixels of a line with intensities are mixed with what is there (`core.lines.wireframe_fragments`).
        """
        from core.framebuffer.blending import blend_traits
        from core.lines.line_method import has_intensities

        needs_mixing = self.is_outlined and has_intensities(self.settings.line)
        return self.settings.line if needs_mixing and not blend_traits(self.settings.blend).mixes else ""

    @cached_property
    def blend_name(self) -> str:
        """The blend method that runs."""
        return MIXING if self.blend_inserted_for else self.settings.blend

    @cached_property
    def blend_method(self) -> Method:
        """Its row: from the fragment's colour and the one that is there to the one that is left."""
        return table.get("blend", self.blend_name)

    @cached_property
    def is_mixed(self) -> bool:
        """Whether colours are mixed with what is there, so that every fragment that passes is shaded."""
        mixes: bool = self.blend_method.traits.mixes
        return mixes or isinstance(self.blend_name, ReplacedName)

    @cached_property
    def sampling(self) -> "Sampling":
        """Where the samples of a pixel lie, and how they are drawn."""
        sampling: Sampling = self.method("antialiasing").function(self.settings.samples_across)
        return sampling

    @cached_property
    def samples_centers(self) -> bool:
        """Whether pixels are sampled at their centres, and nowhere else."""
        sampling = self.sampling
        return sampling.count == 1 and not (sampling.side or sampling.is_area or sampling.is_temporal)

    @cached_property
    def of_one_sample(self) -> Settings:
        """The settings that each sample is drawn with; beside centres no depth of occluders is known."""
        plain = replace(self.settings, antialiasing=Settings.antialiasing)
        is_known = self.samples_centers or self.settings.object_culling != "occlusion"
        return plain if is_known else replace(plain, object_culling="frustum")


@lru_cache(maxsize=16)
def resolve(settings: Settings) -> ResolvedSettings:
    """Return what settings stand for; that of the last few settings is kept.

    Its ``settings`` are the first that were equal to these: passed on, they are found again without being compared.
    """
    return ResolvedSettings(settings)
