"""Scenes and settings that the laws of the traces are tested on: every built-in scene, every method."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from core import Camera, ClipScene, DirectionalLight, Material, Mesh, PointLight, Scene, Settings, Texture
from core.methods import table
from core.settings import FAMILIES, families
from core.stages.needs import refusal
from lessons.scenes import make_scene, scene_names
from tests.covering import covering, fewest, in_turn, is_everything

Region = tuple[int, int, int, int]


def small_scene(name: str) -> ClipScene | Scene:
    """Return a built-in scene, its raster no larger than that of the teaching cases."""
    scene = make_scene(name)
    return replace(scene, size=(40, 30)) if scene.size[0] > 100 else scene


def small_region(scene: ClipScene | Scene) -> Region:
    """Return a window around the middle of the picture, on no block's border."""
    width, height = scene.size
    column, row = max(width // 2 - 5, 0), max(height // 2 - 3, 0)
    return column, row, min(7, width - column), min(5, height - row)


def lit_scene(projection: str = "perspective") -> Scene:
    """Return two meshes that cross, one textured, one half transparent, under two kinds of light."""
    generator = np.random.default_rng(3)
    texture = Texture(generator.random((5, 3, 4)).astype(np.float32))
    wall = Mesh(
        positions=np.array([[-2.0, -1, -2], [2, -1.2, 1], [2, 1.5, 0.5], [-2, 1, -1]]),
        triangles=np.array([[0, 1, 2], [0, 2, 3]]),
        uvs=np.array([[-0.4, 0], [1.7, 0.1], [1.5, 1.2], [0, 1]]),
        texture=texture,
    )
    colors = np.array([[1, 0.2, 0.1, 0.4], [0.1, 1, 0.3, 0.6], [0.2, 0.1, 1, 1.0]])
    tilt = np.array([[0.0, -1, 0, 0.3], [1, 0, 0, -0.2], [0, 0, 1, 0], [0, 0, 0, 1]])
    leaf = Mesh(
        positions=np.array([[-1.0, -1, 1], [1.5, -0.5, -2], [0, 1.5, 0.2]]),
        triangles=np.array([[0, 1, 2]]),
        colors=colors,
        transform=tilt,
        material=Material(0.2, 0.7, 0.5, 8.0),
    )
    camera = Camera(np.array([0.5, 0.6, 4.0]), np.array([0.0, 0, 0]), projection=projection, view_height=4.0)
    lights = (DirectionalLight(np.array([0.3, -1.0, -0.5])), PointLight(np.array([1.0, 1.5, 2.0])))
    return Scene((wall, leaf), camera, lights, (16, 12), np.array([0.1, 0.2, 0.3, 0.5]))


def clip_scene() -> ClipScene:
    """Return triangles of every kind: through the eye, behind it, out of range, equal, flat, outside."""
    clip = np.array(
        [
            [[-0.9, -0.8, 0.2, 1], [0.9, -0.7, 0.4, 1], [0.1, 0.9, -0.3, 1]],
            [[-0.9, -0.8, 0.2, 1], [0.1, 0.9, -0.3, 1], [0.9, -0.7, 0.4, 1]],
            [[-0.5, -0.5, 0.1, 1], [1.0, 1.5, 0.2, 2], [0.3, 0.2, 0.4, -0.5]],
            [[-1, -1, 0, -1], [1, -1, 0, -1], [0, 1, 0, -1]],
            [[-0.8, 0.8, -2, 1], [-0.6, -0.8, 2, 1.2], [0.8, 0.1, 0, 1]],
            [[-0.9, -0.8, 0.2, 1], [0.9, -0.7, 0.4, 1], [0.1, 0.9, -0.3, 1]],
            [[-0.5, -0.5, 0, 1], [0, 0, 0, 1], [0.5, 0.5, 0, 1]],
            [[-3, -3, 0.5, 1], [3, -3, 0.5, 1], [0, 3, 0.5, 1]],
            [[2, 2, 0, 1], [3, 2, 0, 1], [2, 3, 0, 1]],
            [[-0.25, -0.25, 0.75, 1], [0.5, -0.25, 0.75, 1], [-0.25, 0.5, 0.75, 1]],
        ]
    )
    generator = np.random.default_rng(5)
    values = generator.random((len(clip), 3, 5))
    return ClipScene(clip, values, (12, 9), background=np.array([0.5, 0.25, 0.125, 0.75]))


def textured_clip_scene() -> ClipScene:
    """Return a texture on a triangle whose corners differ in w, its coordinates beyond 0 to 1."""
    texture = Texture(np.random.default_rng(7).random((3, 4, 3)).astype(np.float32))
    clip = np.array(
        [[[-1, -1, 0.1, 1], [2, -1.5, 0.5, 2], [0, 2, 1, 3.0]], [[-1, 1, 0, 1], [0, -1, 0, 1], [1, 1, 0, 1]]]
    )
    uv = np.array([[[-0.5, 0], [2.5, 0], [0, 3]], [[0, 0], [1, 0], [0, 1.0]]])
    return ClipScene(clip, uv, (10, 8), texture)


LEFT_OUT = (
    "bar-and-wire",
    "moving-camera",
    "crossing-glass",
    "twisted-tube",
    "blended-bar",
    "curve-in-depth",
    "hill",
    "diced-hill",
    "diced-ball",
    "folded-glass",
    "cracked-patches",
    "fan",
    "triangle-strip",
    "polygon",
    "polygon-window",
    "z-fighting",
    "lit-floor",
    "box-in-light",
    "mirror-cube",
    "boxes-around",
    "boxes-behind-wall",
    "two-boxes",
    "teapot",
    "sphere",
    "torus",
    "knot",
)
"""Built-in scenes with too many triangles, or with nothing that the others lack."""
SCENES = {name: small_scene(name) for name in scene_names() if name not in LEFT_OUT} | {
    "lit": lit_scene(),
    "orthographic": lit_scene("orthographic"),
    "clip": clip_scene(),
    "textured-clip": textured_clip_scene(),
}
"""Scenes of few triangles, to be traced as a whole."""

_OF_OUTLINES = {"line", "line_clipping"}
_OF_POLYGONS = {"polygon_clipping", "polygon_fill"}

CHOICES = [{}] + [
    {family: name}
    for family in families()
    for name in table.names(family)
    if name != getattr(Settings(), family) and family not in _OF_OUTLINES | _OF_POLYGONS
]
"""Every method of triangles once, beside the defaults of the other families."""

MIXES = [
    {"fill": "scanline-lecture", "blend": "over", "pixel_center": "integer", "visibility": "last-drawn"},
    {
        "fill": "scanline",
        "clipping": "sutherland-hodgman",
        "depth": "inverse-w",
        "blend": "over",
        "wrap": "mirror",
    },
    {"polygon_mode": "wireframe", "line": "dda", "blend": "over", "clipping": "sutherland-hodgman"},
    {"fill": "blocks", "block_size": 3, "fill_rule": "inclusive", "blend": "over", "interpolation": "affine"},
    {
        "fill": "spans",
        "depth": "fixed-38",
        "blend": "over",
        "fill_rule": "exclusive",
        "pixel_center": "integer",
    },
    {"fill": "spans", "depth": "fixed-38", "clipping": "sutherland-hodgman", "visibility": "last-drawn"},
    {
        "fill": "hierarchy",
        "block_size": 1,
        "coverage": "float64",
        "cull": "back",
        "texture_filter": "nearest",
    },
    {
        "fill": "bounding-box",
        "visibility": "painters",
        "interpolation": "flat",
        "shading": "gouraud",
        "wrap": "clamp",
    },
    {"interpolation": "affine-n", "correction_interval": 3, "texture_filter": "trilinear", "blend": "over"},
    {"interpolation": "affine", "texture_filter": "trilinear", "wrap": "mirror"},
    {"interpolation": "flat", "texture_filter": "mipmap-nearest"},
    {"polygon_mode": "wireframe", "texture_filter": "trilinear"},
    {"polygon_mode": "wireframe", "interpolation": "affine", "texture_filter": "mipmap-nearest"},
    {"polygon_mode": "wireframe", "interpolation": "affine-n", "texture_filter": "trilinear"},
    {"antialiasing": "ssaa-n", "samples_across": 1, "blend": "over"},
    {"antialiasing": "ssaa-n", "samples_across": 5, "resolve_filter": "tent", "pixel_center": "integer"},
    {"fill": "incremental", "coverage": "float16", "blend": "over", "pixel_center": "integer"},
    {"fill": "incremental", "coverage": "exact", "fill_rule": "inclusive"},
    {"fill": "blocks", "block_size": 3, "coverage": "fixed-24.8", "interpolation": "affine"},
    {"fill": "spans", "coverage": "int64", "depth": "fixed-38", "clipping": "sutherland-hodgman"},
]
"""Choices that meet each other."""


Choice = dict[str, str | int]


def _together(choices: Sequence[Choice], count: int) -> list[Choice]:
    """Return so many choices that make those of different families together, each of them once."""
    return [
        {family: name for choice in choices[k::count] for family, name in choice.items()}
        for k in range(count)
    ]


_WIREFRAME: Choice = {"polygon_mode": "wireframe"}
"""It fills nothing, so it stands alone."""
EACH_METHOD: list[Choice] = (
    [*CHOICES, *MIXES]
    if is_everything()
    else [{}, _WIREFRAME, *_together([each for each in CHOICES[1:] if each != _WIREFRAME], 20), *MIXES[::4]]
)
"""Every method of triangles, two or three at a time, and a few mixes; with --all one by one, and all mixes."""


def _met(families: set[str], scenes: Sequence[str], **numbers: tuple[int, ...]) -> list[tuple[str, Choice]]:
    """Return cases of a scene's name and a choice in which every two methods of some families meet."""
    methods = {family: table.names(family) for family in table.families if family in families}
    return [(case.pop("scene"), case) for case in covering({"scene": scenes, **methods, **numbers})]


_OF_FILLS = {"fill", "fill_rule", "coverage", "pixel_center"}
_SEGMENTS = {"segment", "clipped-segment", "line-strip"}
_WITHOUT_SIDES = {"points", "depth-table"}
_POLYGONS = [name for name, scene in SCENES.items() if scene.corner_count > 3]
_OF_EDGES = {"cull", "clipping", "interpolation", "provoking", "texture_filter", "wrap", "shading"}

FILLED = _met(
    set(table.families) - _OF_OUTLINES - _OF_POLYGONS - {"polygon_mode"},
    [name for name in SCENES if name not in _SEGMENTS and name not in _POLYGONS],
    block_size=(8, 1, 3),
    correction_interval=(16, 3),
    samples_across=(3, 1),
)
"""Filled triangles: in some case any two methods of different families meet, and each meets each scene."""

OUTLINED = [
    (name, {"polygon_mode": "wireframe", **choice})
    for name, choice in _met(
        set(table.families) - _OF_FILLS - _OF_POLYGONS - {"polygon_mode"},
        [name for name in SCENES if name not in _WITHOUT_SIDES and name not in _POLYGONS],
    )
]
"""Wireframes and segments, likewise."""
POLYGONS = _met(
    set(table.families) - (_OF_FILLS - {"pixel_center"}) - _OF_OUTLINES - _OF_EDGES - {"polygon_mode"},
    _POLYGONS,
)
"""Polygons, likewise."""


def settings_of(choice: dict[str, str | int], scene: ClipScene | Scene) -> Settings:
    """Return the settings of a choice, but for methods that refuse the scene."""
    possible = {
        family: name
        for family, name in choice.items()
        if family not in FAMILIES or not refusal(family, str(name), scene)
    }
    return Settings(**possible)  # type: ignore[arg-type]


def name_of(choice: object) -> str:
    """Return a choice as the name of a test."""
    if isinstance(choice, dict):
        return ",".join(f"{family}={name}" for family, name in choice.items()) or "defaults"
    return str(choice)


def _cases() -> list[tuple[str, Choice]]:
    """Return scenes and choices; every day the fewest in which each scene and each method occurs."""
    every = [*FILLED, *OUTLINED, *POLYGONS]
    if is_everything():
        return [*every, *in_turn(SCENES, [*CHOICES, *MIXES])]
    named = {f"{name} {name_of(choice)}": (name, choice) for name, choice in every}
    taken = {
        case: {name, *Settings().differences(settings_of(choice, SCENES[name])).items()}
        for case, (name, choice) in named.items()
    }
    return [named[case] for case in fewest(taken)]


CASES = _cases()
"""Scenes and choices for a law that holds of every picture."""
