"""The picture of the 3D view: the scene drawn by the core from outside, with camera, view volume and axes."""

from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.views.scene_lines import SpaceLine, draw_space_lines
from app.views.view_space import ViewSpace, viewed_scene, viewing_camera, viewing_matrix
from core import Settings, render
from core.arrays import Floats, Integers, Singles
from core.framebuffer.display import Bytes, linear_light, to_display
from core.geometry.matrices import transform
from core.scene import AnyScene, Scene
from widgets.ink import ink_color
from widgets.orbit import Orbit
from widgets.theme import Theme


@dataclass(frozen=True, eq=False)
class DrawnScene:
    """A scene drawn from an orbit."""

    pixels: Bytes
    """(H, W, 4) uint8 sRGB, row 0 at the bottom, with lines."""
    primitive: NDArray[np.integer[Any]]
    """(h, w) int32, the triangle of the document that is seen, -1: none; may be coarser than the picture."""
    seconds: float
    """What drawing took."""
    part: int = 1
    """One in so many triangles was drawn."""

    def triangle_at(self, column: int, row: int) -> int:
        """Return the triangle at a pixel of the picture, -1: none."""
        rows, columns = self.primitive.shape
        height, width = self.pixels.shape[:2]
        return int(self.primitive[row * rows // height, column * columns // width])


def view_settings(scene: AnyScene, settings: Settings) -> Settings:
    """Return the settings of the view: the document's look, every face, and depth as 1/w."""
    return Settings(
        fill="blocks",
        shading=settings.shading if isinstance(scene, Scene) else "unlit",
        texture_filter=settings.texture_filter,
        wrap=settings.wrap,
        depth="inverse-w",
    )


def draw_scene(
    space: ViewSpace,
    scene: AnyScene,
    numbers: Integers | None,
    settings: Settings,
    orbit: Orbit,
    size: tuple[int, int],
    scale: int,
    lines: tuple[SpaceLine, ...],
    theme: Theme,
) -> DrawnScene:
    """Draw a space.

    Parameters
    ----------
    space : ViewSpace
    scene : AnyScene
        What is drawn: the scene of ``space``, or some of its triangles.
    numbers : (T',) int64, optional
        Which triangle of the document each triangle of ``scene`` is; None: the same.
    settings : Settings
        Of the document.
    orbit : Orbit
    size : (width, height)
        Of the picture in pixels.
    scale : int
        Pixels of the picture that one drawn pixel is wide and high; lines are always fine.
    lines : tuple of SpaceLine
    theme : Theme
    """
    begin = perf_counter()
    width, height = size
    coarse = (max(-(-width // scale), 1), max(-(-height // scale), 1))
    camera = viewing_camera(space, orbit)
    background = np.append(linear_light(_bytes_of(theme.canvas) / 255), 1.0)
    viewed, pieces = viewed_scene(space, scene, camera, coarse, background)
    frame = render(viewed, view_settings(scene, settings))
    primitive: NDArray[np.integer[Any]] = frame.primitive
    for of_drawn in (pieces, numbers):
        if of_drawn is not None and len(of_drawn):
            primitive = np.where(primitive < 0, -1, of_drawn[primitive])
    part = 1 if numbers is None else -(-len(space.vertices.corners) // max(len(numbers), 1))
    pixels = to_display(frame.color).pixels
    if scale > 1:
        pixels = pixels.repeat(scale, axis=0).repeat(scale, axis=1)[:height, :width]
    pixels = np.array(pixels)
    depth: Singles = frame.depth
    colors = [ink_color(line.ink, theme) for line in lines]
    draw_space_lines(pixels, depth, lines, viewing_matrix(camera, size), colors)
    return DrawnScene(pixels, primitive, perf_counter() - begin, part)


def fractions(space: ViewSpace, orbit: Orbit, size: tuple[int, int], points: Floats) -> Floats:
    """Return (N, 2) places in the picture of points (N, 3), as fractions with y up; NaN behind the viewer."""
    clip = _view_clip(space, orbit, size, points)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        placed = (clip[:, :2] / clip[:, 3:] + 1) / 2
    return np.where(clip[:, 3:] > 0, placed, np.nan)


def moved_parallel(
    space: ViewSpace, orbit: Orbit, size: tuple[int, int], point: Floats, x: float, y: float
) -> Floats:
    """Return the place (3,) at fractions (x, y) of the picture, as far from the viewer as ``point`` (3,)."""
    camera = viewing_camera(space, orbit)
    matrix = viewing_matrix(camera, size)
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
        lines += [
            SpaceLine(corners[[(k + 1) % 3, (k + 2) % 3]], f"vertex {k}", 2, hidden=0.4) for k in range(3)
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


def _view_clip(space: ViewSpace, orbit: Orbit, size: tuple[int, int], points: Floats) -> Floats:
    matrix = viewing_matrix(viewing_camera(space, orbit), size)
    return transform(matrix, np.column_stack([points, np.ones(len(points))]))


def _bytes_of(color: str) -> Floats:
    return np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)], float)
