"""The stages of the pipeline, each declared once: chapters, cards, keys, settings and traces read it here."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, eq=False, kw_only=True)
class Stage:
    """One stage."""

    name: str
    """The spelling of files, command line and API.

    Other texts have names of what is drawn in braces, as ``{one}`` and ``{corner}``: see ``core.records.words``.
    """
    short_title: str
    """Its name as a chapter of the run."""
    title: str
    """Heading of its card."""
    purpose: str
    takes: str
    gives: str
    source: str
    """Author, title, year, or the lecture it is from."""
    heading: str
    """What the settings of its families stand under."""
    tracer: str
    """The function that traces it, with its module."""
    initial: str
    """The sentence before its first step."""
    group: str = "one row of pixels"
    """What a step of level GROUP is, in a sentence."""
    group_label: str = "Row"
    """The same on a button."""
    row_label: str = ""
    """What a step of level PIXEL is, where it is not a pixel."""
    view: str = "pixels"
    """The main view that shows its work, in which it opens."""
    of_triangles: bool = False
    """Whether its work is on triangles, before any pixel is looked at."""
    is_sampled: bool = True
    """Whether it is done anew for every sample of a pixel."""
    at_centers: bool = False
    """Whether multisampling does it once for a pixel and triangle, at the centre."""
    is_schedule: bool = False
    """Whether it only decides what is looked at: methods may differ there and still do the same."""
    not_for: Mapping[str, str] = field(default_factory=dict)
    """Why ``polygons``, ``segments`` or ``points`` do not go through it."""
    outcomes: tuple[str, ...] = ()
    """What comes of a pixel, by columns of its trace."""


DECLARED = (
    Stage(
        name="transform",
        short_title="Transform",
        title="Transform: from the mesh to the window",
        purpose="Brings all {many} into window space, where pixels are counted.",
        takes="The {vertices} of every mesh in object space, the camera, and the size of the picture.",
        gives="Every {vertex} in world, camera, clip, NDC and window space.",
        source="Zwicker 2016, The complete vertex transform; Pellacini, Vertex processing",
        heading="Geometry",
        tracer="core.transform.traced.trace_transform",
        initial="No {vertex} is transformed yet: all are in object space.",
        group="one {corner}",
        group_label="Vertex",
        row_label="Matrix",
        of_triangles=True,
        is_sampled=False,
        view="scene",
    ),
    Stage(
        name="cull",
        short_title="Cull",
        title="Cull: drop {many} that cannot be seen",
        purpose="Saves all work on {many} behind the eye, outside the view, without area, or turned away.",
        takes="{Many} in clip space.",
        gives="The {many} that may be visible, and a reason for each dropped one.",
        source="LMU 2020, Culling; Jubair, Backface culling",
        heading="Geometry",
        tracer="core.culling.traced.trace_cull",
        initial="No {one} has been tested yet.",
        group="one kind of test",
        group_label="Test",
        row_label="Plane",
        of_triangles=True,
        is_sampled=False,
        view="scene",
    ),
    Stage(
        name="clip",
        short_title="Clip",
        title="Clip: cut {many} at the view volume",
        purpose="Makes every w positive, for methods that divide by it. Homogeneous rasterization does not need it.",
        takes="{Many} in clip space, some of which cross a plane of the view volume.",
        gives="{Many} wholly inside: each cut one becomes a polygon, split into a fan.",
        source="Sutherland and Hodgman 1974; Pellacini, Polygon clipping",
        heading="Geometry",
        tracer="core.clipping.traced.trace_clip",
        initial="No {one} has reached the view volume yet.",
        group="one plane",
        group_label="Plane",
        row_label="Edge",
        of_triangles=True,
        is_sampled=False,
        view="clip",
    ),
    Stage(
        name="edges",
        short_title="Edges",
        title="Edges: one linear function for each",
        purpose="Turns the inside test of a pixel into three signs, for any signs of w.",
        takes="The three corners of a triangle as (x, y, w) in the window.",
        gives="Three functions E = a x + b y + c that are positive inside the triangle.",
        source="Zwicker 2016, Homogeneous rasterization; Olano and Greer 1997",
        heading="Raster",
        tracer="core.coverage.traced_edges.trace_edges",
        initial="No edge function has been set up yet.",
        not_for={
            "polygons": "A polygon needs no edge functions: its edge table is filled in the stage Raster.",
            "segments": "A segment has no edge functions: it has no inside.",
            "points": "A point has no edge functions: it has no inside.",
        },
        group="one part of the set-up",
        group_label="All corners, edges",
        row_label="Corner or edge",
        of_triangles=True,
    ),
    Stage(
        name="bin",
        short_title="Bin",
        title="Bin: find the pixels to test",
        purpose="Skips most pixels without testing them one by one.",
        takes="The edge functions and the corners in the window.",
        gives="A bounding box for every triangle, and blocks that lie inside, outside, or neither.",
        source="Zwicker 2016, Binning; Greene 1996",
        heading="Raster",
        tracer="core.coverage.traced_edges.trace_bin",
        initial="No box and no block has been tested yet.",
        not_for={
            "polygons": "A polygon's spans are computed row by row, without boxes and blocks.",
            "segments": "A segment has no area: its pixels are found without boxes and blocks.",
            "points": "A point has no area: its pixels are found without boxes and blocks.",
        },
        group="one block with its parts",
        group_label="Large block",
        row_label="Block",
        is_schedule=True,
    ),
    Stage(
        name="raster",
        short_title="Raster",
        title="Raster: which pixels are covered",
        purpose="Decides by the sign of three edge functions at the pixel's centre.",
        takes="The edge functions and the pixels to test.",
        gives="The covered pixels of every {one}; a pixel on a shared edge belongs to exactly one.",
        source="Zwicker 2016, Pixel inside/outside test; Pineda 1988; LMU 2020, Scan line algorithm",
        heading="Raster",
        tracer="core.coverage.traced.trace_raster",
        initial="No pixel has been tested yet.",
        group="one row",
        outcomes=("covered",),
    ),
    Stage(
        name="interpolate",
        short_title="Interpolate",
        title="Interpolate: values between the {corner}s",
        purpose="Extends the values of three corners over the {one}, in correct perspective.",
        takes="Covered pixels, and colours, texture coordinates or normals at the {corner}s.",
        gives="Three weights at every pixel, and the weighted sum of the corners' values.",
        source="Zwicker 2016, Perspective correct interpolation; Jubair, Barycentric interpolation",
        heading="Fragments",
        tracer="core.interpolation.traced.trace_interpolate",
        initial="No pixel has weights and values yet.",
        at_centers=True,
        outcomes=("values",),
    ),
    Stage(
        name="shade",
        short_title="Shade",
        title="Shade: the colour of a fragment",
        purpose="Reads the surface's colour from its texture and lights it.",
        takes="The interpolated values, textures, lights and materials.",
        gives="One linear colour with alpha for every fragment.",
        source="Zwicker 2016, Texture mapping; Pellacini, Lighting computation",
        heading="Fragments",
        tracer="core.shading.traced.trace_shade",
        initial="No fragment has a colour yet.",
        at_centers=True,
        outcomes=("color",),
    ),
    Stage(
        name="depth",
        short_title="Depth",
        title="Depth: which fragment is in front",
        purpose="Makes the picture independent of the order in which opaque {many} are drawn.",
        takes="Fragments in drawing order with their depth, and the depth buffer.",
        gives="The fragments that are nearer than the buffer's depth.",
        source="Catmull 1974; Zwicker 2016, Z-buffering",
        heading="Framebuffer",
        tracer="core.depth.traced.trace_depth",
        initial="No fragment has been tested yet: the depth buffer is unchanged.",
        outcomes=("stored", "passes", "after"),
    ),
    Stage(
        name="blend",
        short_title="Blend",
        title="Blend: into the colour buffer",
        purpose="Lets a fragment replace the buffer's colour, or mix with it.",
        takes="The colours of the fragments that passed, and the colour buffer.",
        gives="The colour buffer with every fragment written or mixed into it.",
        source="Porter and Duff 1984; Pellacini, Framebuffer processing",
        heading="Framebuffer",
        tracer="core.framebuffer.traced.trace_blend",
        initial="No fragment has been written yet: the colour buffer is unchanged.",
        outcomes=("after",),
    ),
    Stage(
        name="resolve",
        short_title="Resolve",
        title="Resolve: samples to display bytes",
        purpose="Averages the samples of a pixel, and encodes the mean with the sRGB curve of displays.",
        takes="The colour buffer in linear light, every sample of it.",
        gives="One colour per pixel: red, green and blue as sRGB bytes, and unchanged alpha.",
        source="LMU 2020, Super Sampling Antialiasing; IEC 61966-2-1, sRGB, 1999",
        heading="Framebuffer",
        tracer="core.antialiasing.traced.trace_resolve",
        initial="No pixel has display bytes yet.",
        outcomes=("bytes",),
    ),
)
"""All stages, in pipeline order."""


@dataclass(frozen=True)
class Phase:
    """One of the four stages that the pipeline has in the lecture; those of `DECLARED` are its parts."""

    title: str
    stages: tuple[str, ...]
    takes: str
    """What goes in, behind the number of them."""
    gives: str
    """What comes out, behind the number of them."""


PHASES = (
    Phase(
        "Vertex processing", ("transform",), "in object space, with {values}", "in clip space, with {values}"
    ),
    Phase(
        "Clipping and rasterization",
        ("cull", "clip", "edges", "bin", "raster", "interpolate"),
        "assembled of these vertices",
        "with interpolated {values}",
    ),
    Phase(
        "Fragment processing",
        ("shade",),
        "with interpolated {values}",
        "with one colour each, and their depth",
    ),
    Phase(
        "Framebuffer processing",
        ("depth", "blend", "resolve"),
        "with colour and depth",
        "of the final picture, as display bytes",
    ),
)
"""The four stages of F. Pellacini, "Graphics pipeline stages", in pipeline order."""
STAGES = tuple(stage.name for stage in DECLARED)
"""Their names."""
GEOMETRY_STAGES = tuple(stage.name for stage in DECLARED if stage.of_triangles)
"""Those of triangles."""
UNSAMPLED_STAGES = tuple(stage.name for stage in DECLARED if not stage.is_sampled)
"""Those that are done once, however many samples a pixel has."""
BY_NAME = {stage.name: stage for stage in DECLARED}


def stage_of(name: str) -> Stage:
    """Return a stage; ValueError names those that there are."""
    if name not in BY_NAME:
        raise ValueError(f"stage must be one of {', '.join(STAGES)}, got {name}")
    return BY_NAME[name]
