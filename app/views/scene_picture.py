"""The picture of the 3D view: the scene drawn by the core from outside, with lines in space and no hidden backs."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from time import perf_counter

import numpy as np

from app.views.scene_frames import FrameFigures
from app.views.view_space import ViewSpace, thinned, viewed_scene, viewing_camera, viewing_matrix
from core import Settings
from core.coverage.pixel_runs import expand, make_raster
from core.culling.culling import plane_distances
from core.depth.fixed_depth import SCALE
from core.fast_path.workers.band_workers import BandWorkers
from core.framebuffer.display import Bytes, linear_light
from core.lines.drawing import draw_lines, interpolate_line
from core.pipeline import draw
from core.records.arrays import Flags, Floats, Integers
from core.scene import AnyScene, Camera, DirectionalLight, Mesh, Scene
from core.stages.closed_meshes import is_solid
from core.trace import scene_triangle_count
from core.transform.matrices import transform
from core.transform.vertex_stage import transform_vertices
from widgets.basics.theme import Theme, ink_color
from widgets.space.orbit import Orbit, ViewDepth

# Which back faces the 3D view need not draw: those of solids, seen from outside.


FEWEST = 2_000
"""Triangles; the back faces of fewer cost less than it takes to find out."""


class HiddenBacks:
    """Remembers of the meshes that are drawn whether they are solids.

    It is found out when meshes are drawn a second time, so it costs nothing while they are edited; one thread asks.
    """

    def __init__(self) -> None:
        self._meshes: tuple[Mesh, ...] = ()
        self._is_solid: bool | None = None
        self._corners = np.zeros((8, 3))
        """Of the box around the solids, in the world."""

    def are_hidden(self, scene: AnyScene) -> bool:
        """Return whether no back face can be seen; ``False`` also where that is not known."""
        if not isinstance(scene, Scene) or sum(len(mesh.triangles) for mesh in scene.meshes) < FEWEST:
            return False
        if scene.meshes is not self._meshes:
            self._meshes, self._is_solid = scene.meshes, None
            return False
        if self._is_solid is None:
            self._is_solid = is_solid(scene)
            world = transform_vertices(scene).world
            assert world is not None
            ends = np.stack([world[:, :3].min(axis=0), world[:, :3].max(axis=0)])
            self._corners = np.stack(np.meshgrid(*ends.T), axis=-1).reshape(8, 3)
        return self._is_solid and self._is_before(scene.camera)

    def _is_before(self, camera: Camera) -> bool:
        """Return whether the near plane cuts nothing off, so that the eye is outside and no solid is seen cut open."""
        forward = camera.target - camera.eye
        distance = (self._corners - camera.eye) @ forward / np.linalg.norm(forward)
        return bool((distance > camera.near).all())


# Lines in space drawn into a picture by the core's own line method, hidden parts faint.


DEPTH_BIAS = 0.004
"""How much farther than the surface, as a part of its distance, a line on it may seem to be."""


@dataclass(frozen=True, eq=False)
class SpaceLine:
    """A line through points of the space that is shown."""

    points: Floats = field(repr=False)
    """(N, 3) float64; a point that is not finite interrupts it."""
    ink: str
    """Name of a colour, see ``widgets.basics.theme``."""
    width: int = 1
    """Pixels."""
    hidden: float = 0.25
    """Opacity of the parts behind something."""


def visible_part(clip: Floats) -> tuple[Floats, Integers]:
    """Cut segments (L, 2, 4) in clip space to the view volume.

    Returns
    -------
    cut : (M, 2, 4) float64, w > 0
    source : (M,) int64, the segment that each is from

    References
    ----------
    Y. Liang, B. Barsky, *A new concept and method for line clipping*, 1984.
    """
    distance = plane_distances(clip)
    start, end = distance[:, 0], distance[:, 1]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        crossing = start / (start - end)
    enter = np.where((start < 0) & (end >= 0), crossing, 0.0).max(axis=1)
    leave = np.where((start >= 0) & (end < 0), crossing, 1.0).min(axis=1)
    keep = ~((start < 0) & (end < 0)).any(axis=1) & (enter <= leave) & np.isfinite(clip).all(axis=(1, 2))
    ends = np.stack([enter, leave], axis=1)[..., None]
    cut = clip[:, :1] + ends * (clip[:, 1:] - clip[:, :1])
    keep &= (cut[..., 3] > 0).all(axis=1)
    return cut[keep], np.flatnonzero(keep).astype(np.int64)


@dataclass(frozen=True, eq=False)
class LinePixels:
    """N pixels of lines in a picture, a pixel of each line one after the other along it."""

    column: Integers
    """(N,) int64."""
    row: Integers
    """(N,) int64."""
    inverse_w: Floats
    """(N,) float64, 1/w of the line there."""
    line: Integers
    """(N,) int64, which line it is."""
    is_steep: Flags
    """(N,) bool, whether the line goes up more than it goes across: then it is thick across."""
    size: tuple[int, int]
    """Width and height of the picture."""

    @property
    def depth_at(self) -> Integers:
        """(5 N,) int64, the places of the pixels, then of those left, right, below and above, within the picture."""
        width, height = self.size
        place = self.row * width + self.column
        return np.concatenate(
            [
                place,
                place - (self.column > 0),
                place + (self.column < width - 1),
                place - width * (self.row > 0),
                place + width * (self.row < height - 1),
            ]
        )


def find_line_pixels(lines: Sequence[SpaceLine], matrix: Floats, size: tuple[int, int]) -> LinePixels:
    """Return the pixels of lines in a picture.

    Parameters
    ----------
    matrix : (4, 4) float64
        Space to clip space of the viewing camera.
    size : (width, height)
    """
    ends = [np.stack([line.points[:-1], line.points[1:]], axis=1) for line in lines]
    segments = np.concatenate([np.zeros((0, 2, 3)), *ends])
    owner = np.repeat(np.arange(len(lines)), [len(of_line) for of_line in ends])
    homogeneous = np.concatenate([segments, np.ones((*segments.shape[:2], 1))], axis=2)
    with np.errstate(invalid="ignore", over="ignore"):
        clip, source = visible_part(transform(matrix, homogeneous))
    window = (clip[..., :2] / clip[..., 3:] + 1) * np.array([size[0] / 2, size[1] / 2])
    drawn = draw_lines(window, *size, last_pixel=True)
    # 1/w is linear in the window, as depth is.
    near = interpolate_line(drawn.owner, drawn.steps.t, (1 / clip[..., 3])[..., None])[:, 0]
    across, up = np.abs(window[:, 1] - window[:, 0]).T
    column, row = drawn.pixels.T
    return LinePixels(column, row, near, owner[source][drawn.owner], (up > across)[drawn.owner], size)


def paint_lines(
    pixels: Bytes, found: LinePixels, seen: Floats, lines: Sequence[SpaceLine], colors: Sequence[str]
) -> None:
    """Paint lines over a picture.

    Parameters
    ----------
    pixels : (H, W, 4) uint8, contiguous
        The picture, written to.
    seen : (5 N,) float64
        1/w of what is seen at ``found.depth_at``.
    lines : sequence of SpaceLine
        From the first drawn to the last.
    colors : sequence of str
        ``#rrggbb`` of every line.
    """
    # A line on a slanted surface or along its border counts as seen if it would be in a pixel beside.
    farthest = seen.reshape(5, -1).min(axis=0)
    hidden = np.array([line.hidden for line in lines])[found.line]
    opacity = np.where(found.inverse_w >= farthest * (1 - DEPTH_BIAS), 1.0, hidden)[:, None]
    inks = np.array([[int(color[k : k + 2], 16) for k in (1, 3, 5)] for color in colors]).reshape(-1, 3)
    ink = inks[found.line] * opacity
    width, height = found.size
    which, offset = expand(np.array([line.width for line in lines], np.int64)[found.line])
    is_steep = found.is_steep[which]
    column, row = found.column[which] + offset * is_steep, found.row[which] + offset * ~is_steep
    inside = np.flatnonzero((column < width) & (row < height))
    which, place = which[inside], (row * width + column)[inside]
    flat = pixels.reshape(-1, 4)
    flat[place, :3] = np.rint(flat[place, :3] * (1 - opacity[which]) + ink[which])
    flat[place, 3] = 255


# The picture of the 3D view: the scene drawn by the core from outside, with camera, view volume and axes.


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
