"""The lectures' own examples as scenes, lecture by lecture: their numbers are those of `lessons.lectures.catalogue`."""

from collections.abc import Callable
from dataclasses import replace
from difflib import get_close_matches

import numpy as np

from core.scene import Camera, ClipScene, Mesh, Scene
from core.shaders.presets import preset_program
from lessons import window_scenes
from lessons.run_place import RunPlace
from lessons.scenes import CATALOGUE, BuiltInScene
from lessons.shapes import RED_GREEN_BLUE, checkerboard, cube, linear_color
from lessons.small_scenes import SPLIT_SQUARE, pixel_segments, segment_scene, triangles
from lessons.world_scenes import TEACHING_SIZE

LECTURES = {
    "Zwicker": "Zwicker, Computergrafik, Bern 2016: rendering pipeline",
    "Pellacini": "Pellacini, Computer Graphics: graphics pipeline",
    "Jubair": "Jubair, CSE4203 Computer Graphics: chapter 8, part C, graphics pipeline",
    "LMU": "LMU Munich, Computer Graphics 1, 2020: tutorial 5, rasterization",
}
"""Short name of each lecture to its full one, in the order in which they are listed."""

VERTICES = np.array([(-5.0, -3.0, -10.0), (0.0, 5.0, -10.0), (10.0, -5.0, -10.0)])
"""The three.js triangle."""


def three_js_triangle(face: tuple[int, int, int] = (0, 2, 1)) -> Scene:
    """Return the three.js triangle after its vertex shader, with one order of its vertices, seen from the origin."""
    colors = np.stack([linear_color(color) for color in ("#3399ff", "#00ffff", "#5500ee")])
    mesh = Mesh(VERTICES * (1.5, 0.5, 2.0), np.array([face]), colors=colors, name="three.js triangle")
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]), near=0.1, far=100.0)
    return Scene((mesh,), camera, (), (64, 48))


def shaded_triangle(preset: str) -> Callable[[], Scene]:
    """Return the maker of the three.js triangle drawn by two shaders, before any of them has run."""

    def make() -> Scene:
        scene = three_js_triangle()
        mesh = replace(scene.meshes[0], positions=VERTICES)
        plain = replace(scene, meshes=(mesh,))
        return replace(plain, program=preset_program(preset, plain))

    return make


def segment(
    x0: float, y0: float, x1: float, y1: float, size: tuple[int, int] = (16, 12)
) -> Callable[[], ClipScene]:
    """Return the maker of a segment between the centres of two pixels."""
    return lambda: pixel_segments([((x0, y0), (x1, y1))], size)


def clipped(x0: float, y0: float, x1: float, y1: float) -> Callable[[], ClipScene]:
    """Return the maker of a segment and a clip window of 8 x 6 in the middle of 16 x 12, its corner at (0, 0)."""

    def make() -> ClipScene:
        lying = segment_scene([((x0 + 4, y0 + 3), (x1 + 4, y1 + 3))], (16, 12))
        return replace(lying, clip_region=np.array([-0.5, -0.5, 0.5, 0.5]))

    return make


def two_cubes() -> Scene:
    """Return two cubes beside the axis of the camera, the right one higher and mirrored."""
    meshes = []
    for name, across, up, place in (("cube", 1.0, 1.0, -3.4), ("mirrored cube", -1.0, 1.4, 3.4)):
        turn = np.radians(15.0)
        model = np.eye(4)
        model[:3, :3] = [[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]]
        model[:3, :3] = np.diag([across, up, 1.0]) @ model[:3, :3]
        model[0, 3] = place
        meshes.append(replace(cube(), transform=model, name=name))
    camera = Camera(np.array([0.0, 2.0, 5.0]), np.array([0.0, 0.6, 0.0]), field_of_view=np.radians(75.0))
    return Scene(tuple(meshes), camera, (), (64, 48))


def quad_in_perspective() -> ClipScene:
    """A checkered square that leans back: two triangles whose w are all above 0, so nothing needs to be clipped."""
    x, y, w = np.array([6, 58, 45, 19]), np.array([5, 5, 42, 42]), np.array([1, 1, 2, 2])
    uv = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    corners = np.array([[0, 1, 2], [0, 2, 3]])
    clip = np.stack(
        [window_scenes.window_triangle(x[k], y[k], np.full(3, 0.5), w[k], TEACHING_SIZE) for k in corners]
    )
    return ClipScene(clip, uv[corners], TEACHING_SIZE, checkerboard(), shared=corners)


def degenerate() -> ClipScene:
    """Return points and segments parallel to a border: inside, on the border and outside, in the same clip window."""
    ends = [
        ((1, 2), (7, 2)),
        ((0, 0), (8, 0)),
        ((2, 8), (6, 8)),
        ((-2, 1), (-2, 5)),
        ((4, 4), (4, 4)),
        ((8, 6), (8, 6)),
        ((10, 3), (10, 3)),
    ]
    lying = segment_scene([((a + 4, b + 3), (c + 4, d + 3)) for (a, b), (c, d) in ends], (16, 12))
    return replace(lying, clip_region=np.array([-0.5, -0.5, 0.5, 0.5]))


def frustum_segments() -> ClipScene:
    """Return a segment that loses a quarter to the near plane, and one that lies right of the frustum."""
    clip = np.array(
        [[[-1.0, -0.5, -3.0, 2.0], [1.4, 0.5, 1.0, 2.0]], [[2.5, -1.0, 0.0, 2.0], [4.0, 1.5, 0.0, 2.0]]]
    )
    colors = np.repeat([[linear_color("#E69F00")], [linear_color("#56B4E9")]], 2, axis=1)
    return ClipScene(clip, colors, (16, 12), kind="segments")


def _scene(
    name: str,
    title: str,
    description: str,
    make: Callable[[], ClipScene | Scene],
    opens: RunPlace,
    **settings: str,
) -> BuiltInScene:
    return BuiltInScene(name, title, description, make, opens, settings)


LECTURE_SCENES = {
    "Zwicker": (
        _scene(
            "zwicker-4x3",
            "4 x 3 pixels",
            "One triangle on 4 x 3 pixels, with centres from (0.5, 0.5) to (3.5, 2.5).",
            lambda: triangles(((0.0, 0.0), (4.0, 0.0), (0.0, 3.0)), size=(4, 3), colors=RED_GREEN_BLUE[None]),
            RunPlace("raster", "covered"),
        ),
        _scene(
            "zwicker-shared-edge",
            "Shared edge through pixel centres",
            "A split square with pixel centres on its sides: 12 pixels, none twice.",
            lambda: triangles(
                *SPLIT_SQUARE, colors=np.repeat([RED_GREEN_BLUE[:1], RED_GREEN_BLUE[2:]], 3, axis=1)
            ),
            RunPlace("raster", "tie"),
        ),
        _scene(
            "zwicker-z-buffer",
            "Z-buffer of 1/w",
            "Three patches of 1/w in whole numbers: a pixel is updated only if the new value is larger.",
            window_scenes.larger_is_nearer,
            RunPlace("depth", "depth-failed"),
        ),
        _scene(
            "zwicker-perspective",
            "Attributes in perspective",
            "Affine interpolation bends the lines of this leaning checkerboard at the diagonal of its two triangles.",
            quad_in_perspective,
            RunPlace("interpolate", "column == 32 and row == 18", "weights", (32, 18)),
        ),
    ),
    "Pellacini": (
        _scene(
            "pellacini-line",
            "Line of slope 0.4",
            "The segment (0, 0)-(5, 2), where the printed Bresenham loop steps one column early.",
            segment(0, 0, 5, 2, (8, 4)),  # Powers of two: y = 0.4 x + 0, without a rounding error for the 0.
            RunPlace("raster", 'kind == "midpoint"', "round"),
            line="midpoint",
        ),
        _scene(
            "pellacini-rectangle",
            "Line as a rectangle",
            "The segment (1, 1)-(13, 7) as a rectangle one pixel wide: its columns have one and two pixels in turn, 19 "
            "in all, where midpoint has one in each.",
            segment(1, 1, 13, 7),
            RunPlace("raster", "column == 2 and covered"),
            line="rectangle",
        ),
        _scene(
            "pellacini-frustum",
            "Segments against the frustum",
            "One segment loses a quarter of its length at the near plane; the other lies right of the frustum and is "
            "rejected early.",
            frustum_segments,
            RunPlace("clip", 'kind == "out-in"'),
            clipping="sutherland-hodgman",
        ),
        _scene(
            "pellacini-z-buffer",
            "Z-buffer, the other order",
            "The two triangles of Jubair's table, the sloping one first: hidden surfaces do not depend on the order.",
            window_scenes.two_triangles_turned,
            RunPlace("depth", "not passes and stored > before"),
        ),
    ),
    "Jubair": (
        _scene(
            "jubair-triangle",
            "Barycentric coordinates",
            "A triangle of area 16 with red, green and blue corners: a pixel's colour is its weights.",
            lambda: triangles(((0.0, 0.0), (8.0, 0.0), (0.0, 4.0)), colors=RED_GREEN_BLUE[None]),
            RunPlace("interpolate", "covered"),
        ),
        _scene(
            "jubair-cyrus-beck",
            "Cyrus-Beck, four edges",
            "The segment (-2, -1)-(10, 8) enters the window 8 x 6 at t = 1/6 and leaves it at t = 7/9.",
            clipped(-2, -1, 10, 8),
            RunPlace("raster", 'kind == "clip-enter"'),
            line_clipping="cyrus-beck",
        ),
        _scene(
            "jubair-rejected",
            "Cyrus-Beck, entry after exit",
            "The segment (-2, 5)-(2, 9) has t_E = 1/2 above t_L = 1/4, so nothing is left.",
            clipped(-2, 5, 2, 9),
            RunPlace("raster", 'kind == "clip-empty"'),
            line_clipping="cyrus-beck",
        ),
        _scene(
            "jubair-parallel",
            "Cyrus-Beck, parallel segment outside",
            "The segment (2, 8)-(6, 8) lies above the window; the printed algorithm keeps it.",
            clipped(2, 8, 6, 8),
            RunPlace("raster", 'kind == "clip-parallel" and room < 0'),
            line_clipping="cyrus-beck-lecture",
        ),
        _scene(
            "jubair-degenerate",
            "Cyrus-Beck, points and parallel segments",
            "Segments parallel to a border and points, inside, on the border and outside: N . D is 0 at every one.",
            degenerate,
            RunPlace("raster", 'kind == "clip-parallel"'),
            line_clipping="cyrus-beck",
        ),
        _scene(
            "jubair-backfaces",
            "Back-face culling by N · V",
            "Two cubes beside the camera's axis, the right one mirrored: the camera's direction in place of V loses a "
            "side of the left one, and the determinant keeps the inside of the right one.",
            two_cubes,
            RunPlace("cull", "rejected"),
            cull="back-normal",
        ),
        _scene(
            "jubair-z-buffer",
            "Z-buffer, 8 x 8 cells",
            "Two triangles of whole-number depths, drawn into a buffer of 64 infinities.",
            window_scenes.two_triangles,
            RunPlace("depth", "covered"),
        ),
    ),
    "LMU": (
        _scene(
            "lmu-clipped",
            "Liang-Barsky",
            "The segment (-2, 1)-(6, 5) with p = (-8, 8, -4, 4) and q = (-2, 10, 1, 5).",
            clipped(-2, 1, 6, 5),
            RunPlace("raster", 'kind == "clip-enter"'),
            line_clipping="liang-barsky",
        ),
        _scene(
            "lmu-line",
            "Bresenham's rewritings",
            "The segment (0, 0)-(6, 5), the shortest where the versions with floats draw other pixels.",
            segment(0, 0, 6, 5),
            RunPlace("raster", "tie", "test"),
            line="bresenham-lecture",
        ),
        _scene(
            "lmu-falling-line",
            "Bresenham, dy < 0",
            "A segment that falls by 2 in 5 columns; the printed case starts with D = -9 instead of -1.",
            segment(0, 4, 5, 2),
            RunPlace("raster", 'kind == "bresenham-lecture"', "test"),
            line="bresenham-lecture",
        ),
        _scene(
            "lmu-scanline-triangle",
            "Scanline fill",
            "The triangle (2, 12), (9, 7), (4, 1), which is drawn in 12 lines.",
            lambda: triangles(
                ((2.5, 12.5), (9.5, 7.5), (4.5, 1.5)), size=(16, 16), colors=RED_GREEN_BLUE[None]
            ),
            RunPlace("raster", 'kind == "top-first"'),
            fill="scanline-lecture",
        ),
        _scene(
            "lmu-equal-depths",
            "Z-fighting, equal depths",
            "Two patches have the same depth: with < the first one stays, with ≤ the second one replaces it.",
            window_scenes.equal_depths,
            RunPlace("depth", "not passes and stored == before"),
        ),
        _scene(
            "lmu-three-js",
            "three.js triangle",
            "The triangle of face (0, 2, 1), scaled by its vertex shader; (0, 1, 2) is culled.",
            three_js_triangle,
            RunPlace("cull", 'kind == "facing"'),
            cull="back",
            shading="unlit",
        ),
        _scene(
            "lmu-minimal-shaders",
            "Minimal shaders",
            "The minimal vertex and fragment shader of the slides paint the three.js triangle yellow.",
            shaded_triangle("minimal"),
            RunPlace("transform", 'kind == "statement"'),
            cull="back",
        ),
        _scene(
            "lmu-shaders",
            "Task 2 g), GLSL shaders",
            "The task's shaders scale the triangle and hand its colours from vertex to fragment.",
            shaded_triangle("task"),
            RunPlace("shade", 'kind == "statement"'),
            cull="back",
        ),
    ),
}
"""Short name of a lecture to its scenes."""

ALL_SCENES = {scene.name: scene for scene in (*CATALOGUE, *(s for of in LECTURE_SCENES.values() for s in of))}
"""Every scene that can be opened by name: the built-in ones, then those of the lectures."""


def scene_named(name: str) -> BuiltInScene:
    """Return the scene of a name, or raise ValueError with names that are near it."""
    if name not in ALL_SCENES:
        near = get_close_matches(name, ALL_SCENES) or ["single-triangle"]
        raise ValueError(f"expected a built-in scene such as {', '.join(near)}, got {name!r:.60}")
    return ALL_SCENES[name]
