"""The picture of the 3D view: the scene drawn by the core from outside, with camera, view volume and axes."""

from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from app.views.hidden_backs import HiddenBacks
from app.views.scene_figures import FrameFigures
from app.views.scene_lines import SpaceLine, find_line_pixels, paint_lines
from app.views.view_space import ViewSpace, thinned, viewed_scene, viewing_camera, viewing_matrix
from core import Camera, Settings
from core.fast_path.workers import BandWorkers
from core.framebuffer.display import Bytes, linear_light
from core.framebuffer.fixed_depth import SCALE
from core.geometry.matrices import transform
from core.pipeline import draw
from core.raster.pixel_runs import make_raster
from core.records.arrays import Floats, Integers
from core.scene import AnyScene, DirectionalLight, Scene
from core.trace import scene_triangle_count
from widgets.basics.theme import Theme, ink_color
from widgets.space.orbit import Orbit
from widgets.space.view_depth import ViewDepth

SIGHT_COLUMNS, SIGHT_ROWS = 96, 64
"""Places at which the distance of what is seen is kept."""


MOST_TRIANGLES = 600_000
"""A scene of more is thinned to so many."""


@dataclass(frozen=True, eq=False)
class SceneShot:
    """All that one picture is drawn from; it can be drawn in any thread."""

    space: ViewSpace
    scene: AnyScene
    """The scene of ``space``, or some of its triangles."""
    numbers: Integers | None
    """(T',) int64, which triangle of the document each triangle of ``scene`` is; None: the same."""
    settings: Settings
    """Of the document."""
    orbit: Orbit
    size: tuple[int, int]
    """Width and height of the picture in pixels."""
    focus: int | None
    """The triangle of the document whose edges are drawn."""
    thickness: float
    """Pixels of a line of width 1."""
    theme: Theme
    is_lit: bool = True
    """Whether the scene's own lights shine: before its fragments are shaded, a lamp at the viewer shows the shape."""


@dataclass(frozen=True, eq=False)
class DrawnScene:
    """A scene drawn from an orbit."""

    pixels: Bytes
    """(H, W, 4) uint8 sRGB, row 0 at the bottom, with lines."""
    shot: SceneShot
    matrix: Floats
    """(4, 4) float64, the space that is shown to clip space of the viewing camera."""
    figures: FrameFigures
    sight: ViewDepth


def view_settings(shot: SceneShot, are_backs_hidden: bool = False) -> Settings:
    """Return the settings of the view: the document's look, every face that may be seen, and what draws fastest."""
    settings, shading = shot.settings, "unlit"
    if isinstance(shot.scene, Scene):
        shading = settings.shading if shot.is_lit else "flat"
    return Settings(
        cull="back" if are_backs_hidden else "none",
        fill="spans",
        shading=shading,
        texture_filter=settings.texture_filter,
        wrap=settings.wrap,
        depth="fixed-38",
    )


class Thinning:
    """Keeps the thinned scene from one picture to the next; used by one thread."""

    def __init__(self) -> None:
        self._scene: AnyScene | None = None
        self._thinned: tuple[AnyScene, Integers] | None = None

    def thin(self, shot: SceneShot) -> SceneShot:
        """Return what is drawn instead of a scene of more than `MOST_TRIANGLES`."""
        if scene_triangle_count(shot.scene) <= MOST_TRIANGLES:
            self._scene = self._thinned = None
            return shot
        if self._thinned is None or self._scene is not shot.scene:
            self._scene, self._thinned = shot.scene, thinned(shot.scene, MOST_TRIANGLES)
        scene, chosen = self._thinned
        return replace(shot, scene=scene, numbers=chosen if shot.numbers is None else shot.numbers[chosen])


def draw_thinned(shot: SceneShot, thinning: Thinning, workers: BandWorkers, backs: HiddenBacks) -> DrawnScene:
    """Draw a picture as `draw_scene` does, of at most `MOST_TRIANGLES`."""
    return draw_scene(thinning.thin(shot), workers, backs)


def draw_scene(shot: SceneShot, workers: BandWorkers, backs: HiddenBacks) -> DrawnScene:
    """Draw a picture with its lines; the workers draw parts of it where that is faster."""
    begin = perf_counter()
    viewed, _ = _viewed(shot)
    are_backs_hidden = backs.are_hidden(viewed)
    settings = view_settings(shot, are_backs_hidden)
    width, height = shot.size
    pixels = np.empty((height, width, 4), np.uint8)
    lines = tuple(
        replace(line, width=max(round(line.width * shot.thickness), 1))
        for line in space_lines(shot.space, shot.focus)
    )
    camera = viewing_camera(shot.space, shot.orbit)
    matrix = viewing_matrix(camera, shot.size)
    found = find_line_pixels(lines, matrix, shot.size)
    at_lines, at_sight = found.depth_at, sight_places(shot.size)
    depth_at = np.concatenate([at_lines, at_sight.ravel()])
    picture = workers.draw(viewed, settings, depth_at=depth_at, out=pixels)
    sharing = workers.sharing
    assert picture.depth is not None
    colors = [ink_color(line.ink, shot.theme) for line in lines]
    of_lines, of_sight = np.split(picture.depth, [len(at_lines)])
    paint_lines(pixels, found, _inverse_w(camera, of_lines), lines, colors)
    distance = np.where(of_sight < SCALE, 1 / _inverse_w(camera, of_sight), np.nan)
    sight = ViewDepth(shot.orbit, camera.field_of_view, distance.reshape(at_sight.shape))
    count, seconds = scene_triangle_count(shot.scene), perf_counter() - begin
    figures = FrameFigures(
        shot.size, count, seconds, picture.statistics, picture.route, sharing, are_backs_hidden
    )
    return DrawnScene(pixels, shot, matrix, figures, sight)


def sight_places(size: tuple[int, int]) -> Integers:
    """Return (R, C) int64 places within a picture of (width, height): the middles of R by C equal parts of it."""
    width, height = size
    columns, rows = min(SIGHT_COLUMNS, width), min(SIGHT_ROWS, height)
    column = (2 * np.arange(columns) + 1) * width // (2 * columns)
    row = (2 * np.arange(rows) + 1) * height // (2 * rows)
    return row[:, None] * width + column


def triangle_seen(shot: SceneShot, column: int, row: int) -> int:
    """Return the triangle of the document that is seen at a pixel of a picture, -1: none.

    Only this pixel is drawn, by the same rules as the picture, so a picture need not remember its triangles.
    """
    viewed, pieces = _viewed(shot)
    settings = view_settings(shot)
    raster = make_raster(shot.size, settings.pixel_center, (column, row, 1, 1))
    seen = int(draw(viewed, settings, raster).primitive[0, 0])
    for of_drawn in (pieces, shot.numbers):
        if seen >= 0 and of_drawn is not None:
            seen = int(of_drawn[seen])
    return seen


def _viewed(shot: SceneShot) -> tuple[AnyScene, Integers | None]:
    """Return the scene as the viewing camera sees it, see ``viewed_scene``; its meshes are the same."""
    background = np.append(linear_light(_bytes_of(shot.theme.canvas) / 255), 1.0)
    camera, scene = viewing_camera(shot.space, shot.orbit), shot.scene
    if isinstance(scene, Scene) and not shot.is_lit:
        right, up, back = shot.orbit.axes()
        scene = replace(scene, lights=(DirectionalLight(0.3 * right - 0.4 * up - back),))
    return viewed_scene(shot.space, scene, camera, shot.size, background)


def _inverse_w(camera: Camera, depth: Floats) -> Floats:
    """Return 1/w at stored depths (F,), whole numbers of 2^-38: both are linear over the window."""
    nearest, farthest = 1 / camera.near, 1 / camera.far
    return nearest - (nearest - farthest) * (depth / SCALE)


def fractions(matrix: Floats, points: Floats) -> Floats:
    """Return (N, 2) places of points (N, 3) in the picture of a ``matrix``: fractions, y up; NaN behind the viewer."""
    clip = transform(matrix, np.column_stack([points, np.ones(len(points))]))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        placed = (clip[:, :2] / clip[:, 3:] + 1) / 2
    return np.where(clip[:, 3:] > 0, placed, np.nan)


def moved_parallel(matrix: Floats, point: Floats, x: float, y: float) -> Floats:
    """Return the place (3,) at fractions (x, y) of the picture of a ``matrix``, as far away as ``point`` (3,)."""
    clip = transform(matrix, np.append(point, 1.0))
    clip[:2] = (2 * x - 1) * clip[3], (2 * y - 1) * clip[3]
    moved = np.linalg.solve(matrix, clip)
    return np.asarray(moved[:3] / moved[3])


def space_lines(space: ViewSpace, focus: int | None) -> tuple[SpaceLine, ...]:
    """Return axes, the camera with its view volume (or the box's edges), and the triangle in focus."""
    near, far = space.volume()
    closed = [0, 1, 2, 3, 0]
    lines = [
        SpaceLine(far[closed], "muted_text", hidden=0.45),
        *(SpaceLine(np.stack([near[k], far[k]]), "muted_text", hidden=0.45) for k in range(4)),
        SpaceLine(near[closed], "text", 2, hidden=0.45),
    ]
    if isinstance(space.scene, Scene):
        lines += _axis_lines(space)
        if space.scene.camera.projection == "perspective":
            eye = space.scene.camera.eye
            lines += [SpaceLine(np.stack([eye, corner]), "text", hidden=0.45) for corner in near]
            up = near[2] + near[3] - near[0] - near[1]
            tip = (near[2] + near[3]) / 2 + up * 0.18
            roof = np.stack([near[3] * 0.7 + near[2] * 0.3, tip, near[2] * 0.7 + near[3] * 0.3])
            lines.append(SpaceLine(roof, "text", hidden=0.45))
    if focus is not None:
        corners = space.corners(focus)
        vertices = space.vertices
        lines += [
            SpaceLine(corners[ends], f"vertex {color}", 2, hidden=0.4)
            for ends, color in zip(vertices.sides, vertices.colors, strict=True)
        ]
    return tuple(lines)


def axis_length(space: ViewSpace) -> float:
    """Return how long the axes of the world are drawn."""
    return 0.35 * space.radius


def space_words(space: ViewSpace) -> tuple[tuple[Floats, str], ...]:
    """Return words and where they stand (3,)."""
    near, far = space.volume()
    if not isinstance(space.scene, Scene):
        return (
            (near[2], "near, z = −1"),
            (far[2], "far, z = 1"),
            ((near[0] + near[1]) / 2, "x"),
            ((near[0] + near[3]) / 2, "y"),
        )
    length = axis_length(space)
    axes = tuple((length * np.eye(3)[k], "xyz"[k]) for k in range(3))
    camera = space.scene.camera
    eye = camera.eye if camera.projection == "perspective" else near.mean(axis=0)
    return (*axes, (eye, "camera"), (near[2], "near"), (far[2], "far"))


def _axis_lines(space: ViewSpace) -> list[SpaceLine]:
    length = axis_length(space)
    return [
        SpaceLine(np.stack([np.zeros(3), length * np.eye(3)[k]]), "outline", hidden=0.5) for k in range(3)
    ]


def _bytes_of(color: str) -> Floats:
    return np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)], float)
