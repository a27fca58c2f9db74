"""What is said about every stage and method: titles, cards, where a method is exact and where it breaks."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from core import STAGES
from core.explain.records import StageCard
from core.methods import table
from core.settings import FIELDS

SHORT_TITLES: Mapping[str, str] = {
    "transform": "Transform",
    "cull": "Cull",
    "clip": "Clip",
    "edges": "Edges",
    "bin": "Bin",
    "raster": "Raster",
    "interpolate": "Interpolate",
    "shade": "Shade",
    "depth": "Depth",
    "blend": "Blend",
    "resolve": "Resolve",
}
"""What the pipeline rail calls the stages."""

STAGE_CARDS: Mapping[str, StageCard] = {
    "transform": StageCard(
        title="Transform: from the mesh to the window",
        gets="The vertices of every mesh in object space, the camera, and the size of the picture.",
        gives="Every vertex in world, camera, clip, NDC and window space.",
        purpose="Brings all triangles into the one space in which pixels are counted.",
        source="Zwicker 2016, The complete vertex transform; Pellacini, Vertex processing",
    ),
    "cull": StageCard(
        title="Cull: triangles that cannot be seen",
        gets="Triangles in clip space.",
        gives="The triangles that may be seen, and a reason for each that was dropped.",
        purpose="Saves all work on triangles behind the eye, outside the view, without area, or turned away.",
        source="LMU 2020, Culling; Jubair, Backface culling",
    ),
    "clip": StageCard(
        title="Clip: cutting at the view volume",
        gets="Triangles in clip space, some of which reach through a plane.",
        gives="Triangles wholly inside: the polygon of each cut one is split into a fan.",
        purpose="Makes every w positive, for methods that divide by it; homogeneous drawing does without.",
        source="Sutherland and Hodgman 1974; Pellacini, Polygon clipping",
    ),
    "edges": StageCard(
        title="Edges: one linear function for each",
        gets="The three corners of a triangle as (x, y, w) in the window.",
        gives="Three functions E = a x + b y + c that are positive inside the triangle.",
        purpose="Turns the question whether a pixel is inside into three signs, for any signs of w.",
        source="Zwicker 2016, Homogeneous rasterization; Olano and Greer 1997",
    ),
    "bin": StageCard(
        title="Bin: which pixels are worth a look",
        gets="The edge functions and the corners in the window.",
        gives="A box of pixels for every triangle, and blocks that are wholly in, wholly out, or neither.",
        purpose="Leaves out most pixels without looking at them one by one.",
        source="Zwicker 2016, Binning; Greene 1996",
    ),
    "raster": StageCard(
        title="Raster: which pixels are covered",
        gets="The edge functions and the pixels to look at.",
        gives="The covered pixels of every triangle, each of a shared edge exactly once.",
        purpose="Decides by the sign of three edge functions at the pixel's centre.",
        source="Zwicker 2016, Pixel inside/outside test; Pineda 1988; LMU 2020, Scan line algorithm",
    ),
    "interpolate": StageCard(
        title="Interpolate: values between the corners",
        gets="Covered pixels, and colours, texture coordinates or normals at the corners.",
        gives="Three weights at every pixel, and the corners' values mixed by them.",
        purpose="Spreads what is known at three corners over the triangle, in correct perspective.",
        source="Zwicker 2016, Perspective correct interpolation; Jubair, Barycentric interpolation",
    ),
    "shade": StageCard(
        title="Shade: the colour of a fragment",
        gets="The interpolated values, textures, lights and materials.",
        gives="One linear colour with alpha for every fragment.",
        purpose="Looks the surface's colour up and lights it.",
        source="Zwicker 2016, Texture mapping; Pellacini, Lighting computation",
    ),
    "depth": StageCard(
        title="Depth: which fragment is in front",
        gets="Fragments in drawing order with their depth, and the depth buffer.",
        gives="The fragments that are nearer than what was there before.",
        purpose="Makes the picture independent of the order in which opaque triangles are drawn.",
        source="Catmull 1974; Zwicker 2016, Z-buffering",
    ),
    "blend": StageCard(
        title="Blend: into the colour buffer",
        gets="The colours of the fragments that passed, and the colour buffer.",
        gives="The colour buffer with every fragment written or mixed into it.",
        purpose="Lets a fragment replace what is there, or show a part of it through.",
        source="Porter and Duff 1984; Pellacini, Framebuffer processing",
    ),
    "resolve": StageCard(
        title="Resolve: samples to display bytes",
        gets="The colour buffer in linear light, every sample of it.",
        gives="One colour a pixel: red, green and blue as sRGB bytes, alpha as it is.",
        purpose="Averages the samples of a pixel, and puts the mean on the sRGB curve that screens want.",
        source="LMU 2020, Supersampling and multisampling; IEC 61966-2-1, sRGB, 1999",
    ),
}
"""The cards of all stages."""


@dataclass(frozen=True)
class MethodText:
    """What the table knows of one method, as sentences."""

    title: str
    source: str
    exact_for: str
    breaks_where: str
    """Empty: nowhere."""

    @property
    def tooltip(self) -> str:
        """All of it, a line each."""
        lines = [self.title, f"Source: {self.source}", f"Exact for: {self.exact_for}"]
        return "\n".join(lines + ([f"Breaks where: {self.breaks_where}"] if self.breaks_where else []))


def stage_card(stage: str, method: str = "") -> StageCard:
    """Return the card of a stage.

    Parameters
    ----------
    stage : str
        A name of ``core.STAGES``.
    method : str, optional
        The method that ran, as ``fill=hierarchy``: the card then names it and its source.

    Raises
    ------
    ValueError
        If there is no such stage.
    """
    if stage not in STAGE_CARDS:
        raise ValueError(f"stage must be one of {', '.join(STAGES)}, got {stage}")
    card = STAGE_CARDS[stage]
    if not method:
        return card
    family, name = method.split("=", 1)
    text = method_text(family, name)
    return replace(card, source=f"{card.source}. {family_title(family)}, {text.title}: {text.source}")


def method_text(family: str, name: str) -> MethodText:
    """Return the texts of a method; a name that is not in the table raises ValueError."""
    found = table.get(family, name)
    return MethodText(found.title, found.source, found.exact_for, found.breaks_where)


def family_title(family: str) -> str:
    """Return what a setting is called; one that settings do not have goes by its own name."""
    return FIELDS[family].title if family in FIELDS else family.replace("_", " ").capitalize()
