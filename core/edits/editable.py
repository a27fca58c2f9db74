"""Which listings can be edited, and why others cannot: one table for window, command line, help and tests."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from core.coverage.edges import covers
from core.depth.depth import depth_test
from core.lazy_import import imported
from core.methods import Method, table
from core.settings import FAMILIES, Settings
from core.shading.lighting import blinn_phong

if TYPE_CHECKING:
    from core.edits.typed import Typed


def own_listing(method: Method) -> Callable[..., Any] | None:
    """Return the listing of a method."""
    return method.listing


@dataclass(frozen=True, eq=False)
class Part:
    """A kind of listings that can be edited."""

    name: str
    noun: str
    """What one is called in a sentence."""
    family: str
    """The setting that an edit stands in."""
    place: str
    """What runs a text: file and word of ``core.edits.lines.check_line``, ``edited_line`` and, where there is one,
    ``line_is_passed_over``. They come with the language of listings: they are imported with the first edit."""
    function: Callable[[Method], Callable[..., Any] | None] = own_listing
    """Of a method, what is edited."""
    is_always_run: bool = False
    """Whether settings that choose the method always run its listing."""
    refused: dict[str, str] = field(default_factory=dict)
    """By method: why its listing cannot be edited, as a sentence."""

    @property
    def stage(self) -> str:
        """The stage that runs it."""
        return FAMILIES[self.family].stage

    def check(self, typed: "Typed") -> None:
        """Raise `Problem` for a text that cannot run."""
        self._named("check_{}")(typed)

    def made(self, method: Method, typed: "Typed") -> Method:
        """Return the method with a text in place of its listing."""
        made: Method = self._named("edited_{}")(method, typed)
        return made

    def passed_over(self, settings: Settings, scene: Any) -> str:
        """Return why settings and a scene, or None, would not run an edit, as a sentence; empty: they do."""
        return "" if self.is_always_run else str(self._named("{}_is_passed_over")(settings, scene))

    def _named(self, form: str) -> Callable[..., Any]:
        file, word = self.place.split(".")
        found: Callable[..., Any] = imported(f"core.edits.{file}.{form.format(word)}")
        return found


def _test_of(method: Method) -> Callable[..., Any]:
    return covers


def _depth_test_of(method: Method) -> Callable[..., Any]:
    return depth_test


def _light_of(method: Method) -> Callable[..., Any]:
    return blinn_phong


_BLOCKS = "It takes or leaves whole blocks without testing their pixels: choose fill bounding-box."
_SPANS = "It tests no pixel, but finds the spans of rows: choose fill bounding-box."
_BY_AREA = "The sign of the area decides, and its listing returns words: choose cull back-normal."
_AT_VERTICES = "It lights vertices or faces before any step of a fragment: choose shading phong."
_PLANAR = "It compares whole numbers that stand in integer planes, packed with the triangle's number."
EDITABLE = {
    part.name: part
    for part in (
        Part("line", "listing", "line", "lines.line", is_always_run=True),
        Part(
            "cull",
            "back-face test",
            "cull",
            "coverage.cull",
            refused={"none": "No face is dropped.", "back": _BY_AREA, "front": _BY_AREA},
        ),
        Part(
            "line_clipping",
            "listing",
            "line_clipping",
            "lines.clipper",
            is_always_run=True,
            refused={
                "none": "Nothing is clipped.",
                "exact": "Its listing computes with fractions, which are not in the language of listings.",
            },
        ),
        Part("fill_rule", "rule", "fill_rule", "coverage.fill_rule"),
        Part(
            "fill",
            "inside test",
            "fill",
            "coverage.test",
            function=_test_of,
            refused={
                "hierarchy": _BLOCKS,
                "blocks": _BLOCKS,
                "incremental": "It adds from pixel to pixel: choose fill bounding-box.",
                "scanline": _SPANS,
                "spans": _SPANS,
                "scanline-lecture": _SPANS,
            },
        ),
        Part("interpolation", "listing", "interpolation", "fragments.interpolation"),
        Part(
            "shading",
            "light",
            "shading",
            "fragments.shading",
            function=_light_of,
            refused={"gouraud": _AT_VERTICES, "flat": _AT_VERTICES, "unlit": "Nothing is lit."},
        ),
        Part("texture_filter", "listing", "texture_filter", "fragments.filter"),
        Part(
            "depth_test",
            "depth test",
            "depth",
            "framebuffer.depth_test",
            function=_depth_test_of,
            refused={"fixed-38": _PLANAR},
        ),
        Part(
            "depth",
            "rounding",
            "depth",
            "framebuffer.depth_format",
            refused={"fixed-38": _PLANAR},
        ),
        Part("blend", "listing", "blend", "framebuffer.blend"),
    )
}
"""By name, which the command line takes before ``=``."""
_FIXED = "It chooses what is drawn, and has no listing."
NOT_EDITABLE = {
    "skinning": "Its listings add up over bones, of which vertices have different numbers.",
    "tessellation": "Its listings make a list of points, or numbers for a whole curve, not one for each pixel.",
    "object_culling": "It asks boxes of whole meshes, before there are triangles.",
    "hierarchy": "Its listing builds a tree of all boxes.",
    "clipping": "Its listing builds polygons of any number of corners.",
    "coverage": "The edge functions of all triangles are set up together, in numbers of their own.",
    "polygon_mode": _FIXED,
    "polygon_clipping": "Its listing walks along lists of crossings that differ from polygon to polygon.",
    "polygon_fill": "Its listing keeps tables of edges.",
    "pixel_center": _FIXED,
    "provoking": _FIXED,
    "depth_test_time": _FIXED.replace(
        "chooses what is drawn, and has no listing", "runs whole stages, not numbers"
    ),
    "wrap": "Its listing stands below that of the texture filter: edit it there.",
    "shadow": "It compares with a picture of the whole scene that is drawn first.",
    "environment": "It looks into pictures of the whole scene that are drawn first.",
    "visibility": "It orders triangles, or casts rays, for the whole picture at once.",
    "antialiasing": _FIXED,
    "resolve_filter": "Its listing takes all samples of a pixel.",
    "history": "Its listing mixes one channel, and all pictures depend on the one before.",
    "presentation": "Its listing gives the time of a swap, and all pictures depend on the one before.",
    "flush": "Its listing copies memory, and computes no numbers of a pixel.",
}
"""Families without a part, and why, as sentences."""


def refusal(part: str, of: str) -> str:
    """Return why the listing of a method cannot be edited, as a sentence; empty: it can."""
    if part in NOT_EDITABLE:
        return NOT_EDITABLE[part]
    if part not in EDITABLE:
        return f"What can be edited is one of {', '.join(EDITABLE)}, not {part}."
    known = EDITABLE[part]
    method = table.get(known.family, str(of))
    if of in known.refused:
        return known.refused[of]
    return "" if known.function(method) is not None else f"{method.title} has no listing."
