"""The built-in scenes: small cases for one idea each, where every pixel can be read, and whole meshes."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from core.scene import AnyScene
from lessons import assembled_scenes, window_scenes, world_scenes
from lessons.bone_scenes import bent_bar, blended_bar, twisted_tube
from lessons.curve_scenes import arch, ball, cracked, curve_in_depth, folded_glass, hill
from lessons.layer_scenes import crossing_glass, fan, four_layers, intersecting
from lessons.run_place import FIRST_STEP, RunPlace
from lessons.shapes import cube, knot, sphere, teapot, torus


@dataclass(frozen=True)
class BuiltInScene:
    """One row of the catalogue."""

    name: str
    """The spelling of files and command line, as ``shared-edge``."""
    title: str
    """What a person reads in a menu."""
    description: str
    """One sentence on what the scene shows."""
    make: Callable[[], AnyScene]
    opens: RunPlace = FIRST_STEP
    """Where its run is entered: at what it is about."""
    settings: Mapping[str, str] = field(default_factory=dict)
    """Settings that show what it is about, where not those of every scene do."""

    @property
    def card(self) -> str:
        """What its card and its menu entry say."""
        return f"{self.description} {self.opens.sentence}"


CATALOGUE = (
    BuiltInScene(
        "single-triangle",
        "Single triangle",
        "One triangle with red, green and blue corners at three depths: see which pixel centres lie inside it.",
        window_scenes.single_triangle,
        RunPlace("raster", "covered"),
    ),
    BuiltInScene(
        "shared-edge",
        "Two triangles sharing an edge",
        "Every pixel centre on their common edge belongs to one of them.",
        window_scenes.shared_edge,
        RunPlace("raster", "2: column == 30 and row == 24", pixel=(30, 24)),
    ),
    BuiltInScene(
        "fan",
        "Fan of shared edges",
        "Sixteen triangles meet at a pixel centre, and every pixel still belongs to exactly one.",
        fan,
        RunPlace("raster", "column == 32 and row == 24 and covered", pixel=(32, 24)),
    ),
    BuiltInScene(
        "segment",
        "Segment",
        "One segment from pixel (1, 1) to pixel (9, 4): type its two ends, and step Bresenham's decisions.",
        assembled_scenes.segment,
        RunPlace("raster", 'kind == "bresenham"', "test"),
    ),
    BuiltInScene(
        "clipped-segment",
        "Segment and clip window",
        "One segment crosses a window from pixel (4, 3) to (12, 9): Liang-Barsky finds where it enters and leaves.",
        assembled_scenes.clipped_segment,
        RunPlace("raster", 'kind == "clip-enter"'),
        {"line_clipping": "liang-barsky"},
    ),
    BuiltInScene(
        "polygon-window",
        "Segment and convex polygon",
        "One segment crosses a window of five corners, which Cyrus-Beck clips to.",
        assembled_scenes.segment_in_polygon,
        RunPlace("raster", 'kind == "clip-enter" and crossing_t > bound_before'),
        {"line_clipping": "cyrus-beck"},
    ),
    BuiltInScene(
        "line-strip",
        "Line strip",
        "Five segments in a row draw the pixel of each common vertex once.",
        assembled_scenes.line_strip,
        RunPlace("raster", "triangle == 1"),
    ),
    BuiltInScene(
        "points",
        "Points",
        "Each point is the pixel that contains it, and a point outside of the raster is dropped.",
        assembled_scenes.points,
        RunPlace("raster", "covered"),
    ),
    BuiltInScene(
        "triangle-strip",
        "Triangle strip",
        "Six triangles of eight vertices: each shares an edge with the next, and all are wound alike.",
        assembled_scenes.triangle_strip,
        RunPlace("raster", "2: column == 13 and row == 25", pixel=(13, 25)),
    ),
    BuiltInScene(
        "polygon",
        "Concave polygon",
        "A star of ten corners, cut into eight triangles that draw no pixel twice.",
        assembled_scenes.polygon,
        RunPlace("raster", "tie"),
    ),
    BuiltInScene(
        "polygon-holes",
        "Polygon with holes",
        "One polygon of three rings: step its edge table, and drag a hole out of its outline.",
        window_scenes.polygon_with_holes,
        RunPlace("raster", 'kind == "active-enter"'),
    ),
    BuiltInScene(
        "weiler-atherton",
        "Polygon and concave clip window",
        "Weiler-Atherton walks along the polygon and along a window with a hole.",
        window_scenes.weiler_atherton,
        RunPlace("clip", 'kind == "wa-start"'),
        {"polygon_clipping": "weiler-atherton"},
    ),
    BuiltInScene(
        "connecting-edges",
        "Comb and clip window",
        "Sutherland-Hodgman leaves three teeth joined along the window's border, Weiler-Atherton leaves three rings.",
        window_scenes.connecting_edges,
        RunPlace("clip", "end"),
        {"polygon_clipping": "sutherland-hodgman"},
    ),
    BuiltInScene(
        "pentagram",
        "Self-crossing polygon",
        "The even-odd rule leaves the middle of this star out, the non-zero rule fills it.",
        window_scenes.pentagram,
        RunPlace("raster", "winding == -2 and row == 12", pixel=(16, 12)),
    ),
    BuiltInScene(
        "near-plane",
        "Near-plane crosser",
        "One triangle that begins in front of the camera and ends behind it, where w is negative.",
        world_scenes.near_plane,
        RunPlace("transform", 'kind == "camera-to-clip" and after_w < 0'),
    ),
    BuiltInScene(
        "intersecting",
        "Intersecting triangles",
        "Two triangles pass through each other, which only a test of each pixel's depth gets right.",
        intersecting,
        RunPlace("depth", "depth-failed"),
    ),
    BuiltInScene(
        "crossing-glass",
        "Crossing panes of glass",
        "Two panes pass through each other: scan lines sort them in each segment and blend them from back to front.",
        crossing_glass,
        RunPlace("depth", "end", pixel=(30, 30)),
        {"visibility": "scan-line", "blend": "over"},
    ),
    BuiltInScene(
        "bar-and-wire",
        "Moving bar and thin wire",
        "A bar moves 4 pixels a picture and leaves a ghost in the history; a wire thinner than a pixel stands still.",
        window_scenes.bar_and_wire,
        RunPlace("resolve", "end", pixel=(38, 10)),
        {"antialiasing": "temporal", "pictures": "32", "history": "kept"},
    ),
    BuiltInScene(
        "circle-of-bars",
        "Three bars in a circle",
        "Each bar lies over the next: no order of drawing is right, and a tree of their planes cuts them until one is.",
        window_scenes.circle_of_bars,
        RunPlace("depth", "end", pixel=(33, 35)),
        {"visibility": "painters"},
    ),
    BuiltInScene(
        "depth-table",
        "Table of depths",
        "Two triangles of whole-number depths meet a buffer of infinities: type the cells, and step the depth test.",
        window_scenes.two_triangles,
        RunPlace("depth", "covered"),
    ),
    BuiltInScene(
        "four-layers",
        "Four layers, near to far",
        "Four layers cover every pixel: tested before it is shaded, three of four fragments need no shading.",
        four_layers,
        RunPlace("shade", 'kind == "skipped"'),
        {"depth_test_time": "early"},
    ),
    BuiltInScene(
        "two-buffers",
        "Two buffers",
        "A bar moves to the right while a screen reads its rows: swapped at once, its sides are torn.",
        window_scenes.moving_bar,
        RunPlace("resolve", 'kind == "scan" and refresh == 1 and line == 4'),
        {"presentation": "double-at-once"},
    ),
    BuiltInScene(
        "z-fighting",
        "Z-fighting plates",
        "Two plates lie so close that 16 bits of depth mix them, while 24 bits and floats keep them apart.",
        world_scenes.z_fighting,
        RunPlace("depth", "not passes and stored == before"),
        {"depth": "z-16"},
    ),
    BuiltInScene(
        "textured-floor",
        "Textured floor",
        "Two large triangles with a repeated checkerboard show what perspective does to texture coordinates.",
        world_scenes.textured_floor,
        RunPlace("interpolate", "column == 24 and row == 16", "value-uv"),
    ),
    BuiltInScene(
        "moving-camera",
        "Floor under a moving camera",
        "Looked up where each place was in the picture before, the history stays sharp; kept at its pixel, it smears.",
        world_scenes.moving_camera,
        RunPlace("resolve", "end", pixel=(20, 15)),
        {"antialiasing": "temporal", "pictures": "8", "history": "reprojected"},
    ),
    BuiltInScene(
        "lit-floor",
        "Lit floor",
        "A light is mirrored in the middle of two large triangles: Phong shading shows it, Gouraud shading loses it.",
        world_scenes.lit_floor,
        RunPlace("shade", "column == 31 and row == 20", pixel=(31, 20)),
    ),
    BuiltInScene(
        "box-in-light",
        "Box in the light",
        "What the light sees is drawn first, on 16 x 16 texels: what lies behind that is in the shadow.",
        world_scenes.box_in_light,
        RunPlace("shade", "light_share == 0 and triangle < 2", "compare"),
        {"shadow": "map", "map_size": "16", "shadow_bias": "11"},
    ),
    BuiltInScene(
        "mirror-cube",
        "Mirror on a floor",
        "A mirror looks into six pictures drawn from its middle: what it shows does not meet the floor it stands on.",
        world_scenes.mirror_cube,
        RunPlace("shade", "column == 30 and row == 24 and mirror == 1", "look-up"),
        {"environment": "cube", "cull": "back"},
    ),
    BuiltInScene(
        "cube",
        "Cube",
        "Six faces of one colour each, twelve triangles: follow a vertex from the mesh to the window.",
        world_scenes.of_mesh(cube, 5.4),
        RunPlace("transform", 'kind == "viewport"'),
    ),
    BuiltInScene(
        "boxes-around",
        "Boxes around the viewer",
        "Most of these boxes lie outside the view: each is asked by six planes, and dropped with all its triangles.",
        world_scenes.boxes_around,
        RunPlace("cull", 'kind == "box-outside"'),
        {"object_culling": "frustum", "hierarchy": "none"},
    ),
    BuiltInScene(
        "boxes-behind-wall",
        "Boxes behind a wall",
        "The depth of the wall is drawn first: a box that lies behind it all over its rectangle is dropped.",
        world_scenes.boxes_behind_wall,
        RunPlace("cull", 'kind == "hidden-box"', "compare"),
        {"object_culling": "occlusion", "hierarchy": "none", "occluders": "1"},
    ),
    BuiltInScene(
        "two-boxes",
        "Two boxes on a ray",
        "A ray meets the nearer box, passes beside all that is in it, and hits a triangle in the farther one.",
        world_scenes.two_boxes,
        RunPlace("depth", 'kind == "tree-leaf" and enter_z < 5'),
        {"visibility": "ray-casting-tree", "leaf_size": "12"},
    ),
    BuiltInScene(
        "bent-bar",
        "Bent bar",
        "Two bones bend a bar of width 2 by 90 degrees: halfway between them it is 1.41 wide.",
        bent_bar,
        RunPlace("transform", 'kind == "skin" and vertex == 8', "x"),
    ),
    BuiltInScene(
        "twisted-tube",
        "Twisted tube",
        "A bone twists half of a tube by 170 degrees: the linear mixture of both turns has almost no width.",
        twisted_tube,
        RunPlace("transform", 'kind == "skin" and bones == 2'),
    ),
    BuiltInScene(
        "blended-bar",
        "Blended shapes",
        "Halfway between straight and turned by 90 degrees every point is on its chord: the bar is 0.71 times as long.",
        blended_bar,
        RunPlace("transform", 'kind == "blend"'),
    ),
    BuiltInScene(
        "curve",
        "Bézier curve",
        "Six straight pieces of one curve: each of their ends is a mixture of four control points, level by level.",
        arch,
        RunPlace("transform", 'kind == "mix" and step == 3'),
    ),
    BuiltInScene(
        "curve-in-depth",
        "Bézier curve in perspective",
        "One end is four times as far as the other: the curve is cut before w divides, so the pieces crowd together.",
        curve_in_depth,
        RunPlace("transform", 'kind == "emit" and step == 3'),
    ),
    BuiltInScene(
        "hill",
        "Hill of one patch",
        "Sixteen control points, 72 triangles: the normals come from both derivatives of the surface.",
        hill,
        RunPlace("transform", 'kind == "normal"'),
    ),
    BuiltInScene(
        "diced-hill",
        "Hill of micropolygons",
        "The same patch, split and diced until no side is longer than 4 pixels, and shaded before it is hidden.",
        hill,
        RunPlace("transform", 'kind == "cut-split"'),
        {"tessellation": "reyes", "curve_tolerance": "64", "shading": "gouraud"},
    ),
    BuiltInScene(
        "diced-ball",
        "Ball of micropolygons",
        "Eight patches in pieces of 4 pixels: 1,352 points are shaded, and 16 pixels of the outline are wrong.",
        ball,
        RunPlace("transform", 'kind == "cut-dice"'),
        {"tessellation": "reyes", "curve_tolerance": "64", "shading": "gouraud"},
    ),
    BuiltInScene(
        "folded-glass",
        "Folded sheet of glass",
        "A sheet lies three times over itself, another cuts through it: pixels list up to four micropolygons each.",
        folded_glass,
        RunPlace("depth", 'kind == "list-front" and column == 30 and row == 24', pixel=(30, 24)),
        {
            "tessellation": "reyes",
            "curve_tolerance": "128",
            "shading": "gouraud",
            "visibility": "hit-lists",
            "blend": "over",
        },
    ),
    BuiltInScene(
        "cracked-patches",
        "Crack between patches",
        "Two patches have one curved edge in common, with two pieces on one side and three on the other: a crack.",
        cracked,
        RunPlace("transform", 'kind == "cut-bound"'),
        {"tessellation": "bound", "curve_tolerance": "160", "shading": "unlit"},
    ),
    BuiltInScene(
        "teapot",
        "Teapot",
        "The Utah teapot, 32 Bézier patches cut into 2,256 triangles.",
        world_scenes.of_mesh(teapot, 3.5, "#E8E8E8"),
        RunPlace("raster", "covered"),
    ),
    BuiltInScene(
        "sphere",
        "Sphere",
        "A round surface of 2,208 flat triangles, lit at every pixel.",
        world_scenes.of_mesh(sphere, 3.4, "#56B4E9"),
        RunPlace("shade", "covered"),
    ),
    BuiltInScene(
        "torus",
        "Torus",
        "A ring that hides a part of itself.",
        world_scenes.of_mesh(torus, 3.6, "#E69F00"),
        RunPlace("depth", "depth-failed", triangle=2264),
    ),
    BuiltInScene(
        "knot",
        "Knot",
        "A trefoil knot of 20,000 triangles, a small load test.",
        world_scenes.of_mesh(knot, 5.2, "#009E73"),
        RunPlace("raster", "covered"),
    ),
)
"""The scenes in the order of the menu."""


def scene_names() -> tuple[str, ...]:
    """Return the names of the built-in scenes, in the order of the menu."""
    return tuple(scene.name for scene in CATALOGUE)


def built_in_scene(name: str) -> BuiltInScene:
    """Return the row of the catalogue for ``name``, or raise ValueError with the names that there are."""
    for scene in CATALOGUE:
        if scene.name == name:
            return scene
    raise ValueError(f"scene must be one of {', '.join(scene_names())}, got {name}")


def make_scene(name: str) -> AnyScene:
    """Return the built-in scene ``name``, or raise ValueError with the names that there are."""
    return built_in_scene(name).make()
