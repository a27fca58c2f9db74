"""Texts of every stage and method: titles, cards, summaries, where a method is exact and where it breaks."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

from core.explain.number_text import counted
from core.explain.records import StageCard
from core.methods import table
from core.records.frame import STAGES
from core.records.steps import Level
from core.settings import FIELDS
from core.trace.stage_trace import MARKS


@dataclass(frozen=True)
class StageText:
    """Everything that is said about a stage as a whole."""

    short_title: str
    """Its name on the pipeline rail."""
    card: StageCard
    initial: str
    """The sentence before the first step."""
    account: Callable[[Mapping[str, int]], list[str]]
    """Makes of the counts of rows and marks what a larger step did, in a few parts."""
    group: str = "one row of pixels"
    """What a step of level GROUP is."""


def _cull_account(counts: Mapping[str, int]) -> list[str]:
    verdicts = [f"{counts['covered']:,} kept"] if counts["covered"] else []
    verdicts += [f"{counts['rejected']:,} dropped"] if counts["rejected"] else []
    return [counted(counts["rows"], "test"), *(verdicts or ["nothing decided yet"])]


def _clip_account(counts: Mapping[str, int]) -> list[str]:
    outside = [f"{counts['rejected']:,} wholly outside"] if counts["rejected"] else []
    return [
        counted(counts["rows"], "edge or untouched triangle", "edges or untouched triangles"),
        *outside,
    ]


def _edges_account(counts: Mapping[str, int]) -> list[str]:
    flat = [f"{counted(counts['rejected'], 'triangle')} without area"] if counts["rejected"] else []
    return [f"{counted(counts['rows'], 'corner, area or edge', 'corners, areas and edges')} set up", *flat]


def _bin_account(counts: Mapping[str, int]) -> list[str]:
    blocks = [f"{counted(counts['covered'], 'block')} accepted", f"{counts['rejected']:,} rejected"]
    tested = f"{counted(counts['rows'], 'box or block', 'boxes and blocks')} tested"
    return [tested, *(blocks if counts["covered"] + counts["rejected"] else [])]


def _raster_account(counts: Mapping[str, int]) -> list[str]:
    tested = counted(counts["covered"] + counts["rejected"], "pixel")
    ties = [f"{counts['tie']:,} on an edge"] if counts["tie"] else []
    return [f"{tested} tested", f"{counts['covered']:,} covered", *ties]


def _depth_account(counts: Mapping[str, int]) -> list[str]:
    tested = f"{counted(counts['rows'], 'fragment')} tested"
    return [tested, f"{counts['covered']:,} kept", f"{counts['depth-failed']:,} hidden or out of range"]


def _rows_account(noun: str, done: str) -> Callable[[Mapping[str, int]], list[str]]:
    """Return the account of a stage that does one thing to every row."""
    return lambda counts: [f"{counted(counts['rows'], noun)} {done}"]


STAGE_TEXTS: Mapping[str, StageText] = {
    "transform": StageText(
        "Transform",
        StageCard(
            title="Transform: from the mesh to the window",
            gets="The vertices of every mesh in object space, the camera, and the size of the picture.",
            gives="Every vertex in world, camera, clip, NDC and window space.",
            purpose="Brings all triangles into window space, where pixels are counted.",
            source="Zwicker 2016, The complete vertex transform; Pellacini, Vertex processing",
        ),
        "No vertex is transformed yet: the corners are in object space.",
        _rows_account("position", "transformed to the next space"),
        "one corner",
    ),
    "cull": StageText(
        "Cull",
        StageCard(
            title="Cull: drop triangles that cannot be seen",
            gets="Triangles in clip space.",
            gives="The triangles that may be visible, and a reason for each dropped one.",
            purpose="Saves all work on triangles behind the eye, outside the view, without area, or turned away.",
            source="LMU 2020, Culling; Jubair, Backface culling",
        ),
        "No triangle has been tested yet.",
        _cull_account,
        "one kind of test",
    ),
    "clip": StageText(
        "Clip",
        StageCard(
            title="Clip: cut triangles at the view volume",
            gets="Triangles in clip space, some of which cross a plane of the view volume.",
            gives="Triangles wholly inside: each cut one becomes a polygon, split into a fan.",
            purpose="Makes every w positive, for methods that divide by it. Homogeneous rasterization does without.",
            source="Sutherland and Hodgman 1974; Pellacini, Polygon clipping",
        ),
        "No triangle has been clipped yet.",
        _clip_account,
        "one plane",
    ),
    "edges": StageText(
        "Edges",
        StageCard(
            title="Edges: one linear function for each",
            gets="The three corners of a triangle as (x, y, w) in the window.",
            gives="Three functions E = a x + b y + c that are positive inside the triangle.",
            purpose="Turns the inside test of a pixel into three signs, for any signs of w.",
            source="Zwicker 2016, Homogeneous rasterization; Olano and Greer 1997",
        ),
        "No corner has been snapped and no edge function set up yet.",
        _edges_account,
        "one part of the set-up",
    ),
    "bin": StageText(
        "Bin",
        StageCard(
            title="Bin: find the pixels to test",
            gets="The edge functions and the corners in the window.",
            gives="A bounding box for every triangle, and blocks that lie inside, outside, or neither.",
            purpose="Skips most pixels without testing them one by one.",
            source="Zwicker 2016, Binning; Greene 1996",
        ),
        "No box and no block has been tested yet.",
        _bin_account,
        "one block with its parts",
    ),
    "raster": StageText(
        "Raster",
        StageCard(
            title="Raster: which pixels are covered",
            gets="The edge functions and the pixels to test.",
            gives="The covered pixels of every triangle; a pixel on a shared edge belongs to exactly one.",
            purpose="Decides by the sign of three edge functions at the pixel's centre.",
            source="Zwicker 2016, Pixel inside/outside test; Pineda 1988; LMU 2020, Scan line algorithm",
        ),
        "No pixel has been tested yet.",
        _raster_account,
        "one row or block",
    ),
    "interpolate": StageText(
        "Interpolate",
        StageCard(
            title="Interpolate: values between the corners",
            gets="Covered pixels, and colours, texture coordinates or normals at the corners.",
            gives="Three weights at every pixel, and the weighted sum of the corners' values.",
            purpose="Extends the values of three corners over the triangle, in correct perspective.",
            source="Zwicker 2016, Perspective correct interpolation; Jubair, Barycentric interpolation",
        ),
        "No pixel has weights and values yet.",
        _rows_account("pixel", "given weights and values"),
    ),
    "shade": StageText(
        "Shade",
        StageCard(
            title="Shade: the colour of a fragment",
            gets="The interpolated values, textures, lights and materials.",
            gives="One linear colour with alpha for every fragment.",
            purpose="Reads the surface's colour from its texture and lights it.",
            source="Zwicker 2016, Texture mapping; Pellacini, Lighting computation",
        ),
        "No fragment has a colour yet.",
        _rows_account("pixel", "coloured"),
    ),
    "depth": StageText(
        "Depth",
        StageCard(
            title="Depth: which fragment is in front",
            gets="Fragments in drawing order with their depth, and the depth buffer.",
            gives="The fragments that are nearer than the buffer's depth.",
            purpose="Makes the picture independent of the order in which opaque triangles are drawn.",
            source="Catmull 1974; Zwicker 2016, Z-buffering",
        ),
        "No fragment has been tested yet: the depth buffer is unchanged.",
        _depth_account,
    ),
    "blend": StageText(
        "Blend",
        StageCard(
            title="Blend: into the colour buffer",
            gets="The colours of the fragments that passed, and the colour buffer.",
            gives="The colour buffer with every fragment written or mixed into it.",
            purpose="Lets a fragment replace the buffer's colour, or mix with it.",
            source="Porter and Duff 1984; Pellacini, Framebuffer processing",
        ),
        "No fragment has been written yet: the colour buffer is unchanged.",
        _rows_account("colour", "written"),
    ),
    "resolve": StageText(
        "Resolve",
        StageCard(
            title="Resolve: samples to display bytes",
            gets="The colour buffer in linear light, every sample of it.",
            gives="One colour per pixel: red, green and blue as sRGB bytes, and unchanged alpha.",
            purpose="Averages the samples of a pixel, and encodes the mean with the sRGB curve of displays.",
            source="LMU 2020, Supersampling and multisampling; IEC 61966-2-1, sRGB, 1999",
        ),
        "No pixel has display bytes yet.",
        _rows_account("pixel", "encoded for the display"),
    ),
}
"""The texts of all stages."""

SHORT_TITLES: Mapping[str, str] = {stage: text.short_title for stage, text in STAGE_TEXTS.items()}
"""The names of the stages on the pipeline rail."""


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


class DepthText(NamedTuple):
    """How a buffer of depths is shown."""

    unit: str
    """Behind every number."""
    description: str
    """One sentence: range, cleared value, and which of two is nearer."""


def initial_sentence(stage: str) -> str:
    """Return the sentence of a stage before its first step."""
    return STAGE_TEXTS[stage].initial


def summary_sentence(stage: str, level: Level, counts: Mapping[str, int], triangle: int | None) -> str:
    """Say what a step larger than one operation did.

    Parameters
    ----------
    stage : str
    level : Level
    counts : mapping
        ``rows`` and the marks among them, as ``StageTrace.summary`` counts them.
    triangle : int, optional
        The triangle that all rows are about; ``None`` or -1: several, or none.
    """
    known = {name: counts.get(name, 0) for name in ("rows", *MARKS)}
    text = STAGE_TEXTS[stage]
    account = ", ".join(text.account(known))
    if known["nan"]:
        account += f", {known['nan']:,} undefined (NaN)"
    who = "All triangles" if triangle is None or triangle < 0 else f"Triangle {triangle}"
    if level == Level.STAGE:
        who = "Whole stage"
    elif level == Level.GROUP:
        who = text.group.capitalize() if who == "All triangles" else f"{who}, {text.group}"
    return f"{who}: {account}."


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
    if stage not in STAGE_TEXTS:
        raise ValueError(f"stage must be one of {', '.join(STAGES)}, got {stage}")
    card = STAGE_TEXTS[stage].card
    if not method:
        return card
    family, name = method.split("=", 1)
    text = method_text(family, name)
    return replace(card, source=f"{card.source}. {family_title(family)}, {text.title}: {text.source}")


NEARNESS = DepthText(
    "",
    "1/w of a perspective scene, else −z/w, where the ray meets the nearest triangle so far: larger is nearer.",
)
"""What rays compare, in float64."""


def depth_text(buffer: str, method: str) -> DepthText | None:
    """Return the text of a buffer of the stage depth under a depth method; ``None``: it holds no depths."""
    if buffer == "nearness":
        return NEARNESS
    if buffer != "depth":
        return None
    kept = table.get("depth", method).function()
    return DepthText(kept.unit, kept.description)


def method_text(family: str, name: str) -> MethodText:
    """Return the texts of a method; a name that is not in the table raises ValueError."""
    found = table.get(family, name)
    return MethodText(found.title, found.source, found.exact_for, found.breaks_where)


def family_title(family: str) -> str:
    """Return what a setting is called; one that settings do not have goes by its own name."""
    return FIELDS[family].title if family in FIELDS else family.replace("_", " ").capitalize()
