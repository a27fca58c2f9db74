"""Random scenes under random settings of all families, and the law they are searched with.

Picture, trace, pixel history and fast path say the same of every pixel.
"""

from dataclasses import dataclass, replace

import numpy as np

from core import (
    Camera,
    ClipScene,
    DirectionalLight,
    Material,
    Mesh,
    PointLight,
    Scene,
    Settings,
    Texture,
    draw_picture,
    render,
    trace,
)
from core.framebuffer.display import to_display
from core.methods import table
from core.records.frame import Frame
from core.scene import AnyScene
from core.settings import WHOLE_NUMBERS, families
from tests.core.fast_path.references import shows_thin_triangle
from tests.core.pixel_history.test_why_picture import check_pixels
from tests.core.spans.adversarial import mixed, projected
from tests.core.strategies import clip_of_window
from tests.core.trace.test_trace_folding import check_frame
from tests.core.trace.trace_cases import settings_of

USUAL = {"polygon_mode": 0.7, "antialiasing": 0.6, "fill": 0.4, "coverage": 0.4, "interpolation": 0.3}
"""How often the default of a family is chosen where chance alone would hide other families behind it."""
BYTES_AWAY = {"palette": 0, "deferred": 0, "texture": 3}
"""How far the fast path's bytes may be from those of the picture, by its route; 1 where nothing is said."""

Source = np.random.Generator


@dataclass(frozen=True, eq=False)
class Case:
    """A scene, the settings to draw it with, and pixels to ask the history of."""

    scene: AnyScene
    settings: Settings
    pixels: list[tuple[int, int]]


def random_case(seed: int) -> Case:
    """Return the case of a seed."""
    source = np.random.default_rng(seed)
    longest = 60 if source.random() < 0.05 else 16
    size = int(source.integers(1, longest + 1)), int(source.integers(1, longest))
    scene = _lit_scene(source, size) if source.random() < 0.2 else _clip_scene(source, size)
    pixels = [(int(source.integers(size[0])), int(source.integers(size[1]))) for _ in range(2)]
    return Case(scene, settings_of(_choice(source), scene), pixels)


def _choice(source: Source) -> dict[str, str | int]:
    choice: dict[str, str | int] = {}
    for family in families():
        if source.random() >= USUAL.get(family, 0.0):
            choice[family] = str(source.choice(table.names(family)))
    for name, number in WHOLE_NUMBERS.items():
        choice[name] = int(source.choice(number.offered))
    # Deeper, a few triangles stand in more cells than an octree may list.
    choice["octree_depth"] = min(int(choice["octree_depth"]), 6)
    return choice


def _triangles(source: Source, count: int, size: tuple[int, int]) -> np.ndarray:
    """Return clip positions (count, 3, 4): of every kind of w, all before the eye, or small numbers of all signs."""
    kind = source.integers(4)
    if kind == 0:
        return mixed(source, count, size)
    if kind == 1:
        return source.integers(-24, 25, (count, 3, 4)) / 8
    depth = source.choice([-1.0, -0.5, 0.0, 0.25, 0.99999, 1.0], (count, 3))
    if kind == 2:
        return clip_of_window(
            projected(source, count, size), size, source.choice([0.5, 1.0, 3.0], (count, 3)), depth
        )
    points = source.uniform(-4, np.array(size) + 4, (count, 3, 2))
    return clip_of_window(
        points, size, source.uniform(0.2, 4, (count, 3)), source.uniform(-1.1, 1.1, (count, 3))
    )


def _clip_scene(source: Source, size: tuple[int, int]) -> ClipScene:
    count = int(source.integers(1, 41 if source.random() < 0.1 else 9))
    clip, background = _triangles(source, count, size), source.random(4).round(2)
    kind = source.integers(4)
    if kind == 0:
        texture = Texture(source.random((int(source.integers(1, 6)), 4, 3)).astype(np.float32))
        return ClipScene(clip, source.uniform(-1, 2, (count, 3, 2)), size, texture, background)
    values = source.random((count, 3, int(source.integers(1, 6))))
    if kind == 1:
        values[:] = values[:, :1]
    elif kind == 2 and source.random() < 0.5:
        # Light above 1, and less than none.
        values = 3 * values - 1
    return ClipScene(clip, values, size, background=background)


def _mesh(source: Source) -> Mesh:
    count = int(source.integers(3, 8))
    triangles = np.array([source.permutation(count)[:3] for _ in range(int(source.integers(1, 6)))])
    has_texture = source.random() < 0.5
    colors = source.random((count, 4))
    colors[:, 3] = source.choice([1.0, 0.5])
    return Mesh(
        positions=source.uniform(-1.5, 1.5, (count, 3)),
        triangles=triangles,
        normals=source.normal(size=(count, 3)) if source.random() < 0.5 else None,
        uvs=source.uniform(-1, 2, (count, 2)) if has_texture else None,
        colors=colors,
        texture=Texture(source.random((4, 3, 3)).astype(np.float32)) if has_texture else None,
        material=Material(0.2, 0.7, float(source.choice([0.0, 0.5])), 8.0),
    )


def _lit_scene(source: Source, size: tuple[int, int]) -> Scene:
    camera = Camera(
        source.uniform(-3, 3, 3),
        source.uniform(-0.5, 0.5, 3),
        up=np.array([0.1, 1.0, 0.2]),
        projection=str(source.choice(["perspective", "perspective", "orthographic"])),
        near=float(source.choice([0.05, 1.0])),
        far=float(source.choice([3.0, 20.0])),
    )
    lights = (DirectionalLight(np.array([0.3, -1.0, -0.5])), PointLight(np.array([1.0, 1.5, 2.0])))
    meshes = tuple(_mesh(source) for _ in range(int(source.integers(1, 3))))
    return Scene(meshes, camera, lights, size, source.random(4).round(2))


def check_case(case: Case) -> None:
    """Check that picture, trace, history and fast path agree."""
    frame = render(case.scene, case.settings)
    check_frame(trace(case.scene, case.settings), frame)
    row, column = np.unravel_index(np.argmax(frame.cover_count), frame.cover_count.shape)
    check_pixels(case.scene, case.settings, [(int(column), int(row)), *case.pixels])
    _check_fast_path(case.scene, case.settings, frame)


def _check_fast_path(scene: AnyScene, settings: Settings, frame: Frame) -> None:
    with_depth = draw_picture(scene, settings, with_depth=True)
    assert with_depth.depth.dtype == frame.depth.dtype
    assert np.array_equal(with_depth.depth, frame.depth, equal_nan=True), with_depth.route
    expected = to_display(frame.color).pixels.astype(int)
    for picture in (with_depth, draw_picture(scene, settings)):
        route = picture.route
        away = np.abs(picture.pixels - expected).max(axis=2)
        allowed = BYTES_AWAY.get(route.color, 1) + (route.visibility == "supersampled")
        if route.color not in ("palette", "deferred"):
            if route.color == "texture" and settings.texture_filter == "nearest":
                continue
            away[shows_thin_triangle(scene, replace(settings, antialiasing="none"))] = 0
        assert away.max(initial=0) <= allowed, (route, away[::-1])
