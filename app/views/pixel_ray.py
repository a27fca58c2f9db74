"""Pixels of the traced picture in the 3D view: the ray through each, and where it meets what is seen."""

import numpy as np

from app.views.pointed_pixel import PointedPixel, fragment_at
from app.views.scene_picture import fractions
from app.views.view_space import ViewSpace
from core.geometry.matrices import transform
from core.records.arrays import Floats
from core.scene import Scene
from core.trace import TraceSource
from widgets.space.scene_view import SceneMark

PARTS = 24
"""A ray is projected in so many parts, so that what is behind the viewer can be left out."""


def pixel_ray(source: TraceSource, space: ViewSpace, column: int, row: int) -> tuple[Floats, bool]:
    """Return the ray (2, 3) of a pixel, from the eye or the near plane to what is hit or the far plane.

    The flag says whether something is hit: the fragment among those traced, else the triangle of the picture.
    """
    width, height = source.scene.size
    center = source.raster.center
    x, y = 2 * (column + center) / width - 1, 2 * (row + center) / height - 1
    near, far = _placed(space, np.array([[x, y, -1.0, 1.0], [x, y, 1.0, 1.0]]))
    scene = space.scene
    start = (
        scene.camera.eye if isinstance(scene, Scene) and scene.camera.projection == "perspective" else near
    )
    fragment = fragment_at(source, column, row)
    if fragment >= 0:
        depth = float(source.depths[0][fragment])
        return np.stack([start, _placed(space, np.array([[x, y, 2 * depth - 1, 1.0]]))[0]]), True
    first_column, first_row, _, _ = source.raster.bounds
    seen = int(source.picture.primitive[row - first_row, column - first_column])
    hit = None if seen < 0 else _meet(start, far, space.corners(seen))
    return (np.stack([start, far]), False) if hit is None else (np.stack([start, hit]), True)


def pixel_marks(
    source: TraceSource, space: ViewSpace, matrix: Floats, pixels: tuple[PointedPixel, ...]
) -> tuple[SceneMark, ...]:
    """Return the rays of pixels as lines over the picture of a ``matrix``, see `DrawnScene`."""
    marks = []
    for pixel in pixels:
        ray, is_hit = pixel_ray(source, space, pixel.column, pixel.row)
        along = np.linspace(0.0, 1.0, PARTS + 1)[:, None]
        points = fractions(matrix, ray[0] + along * (ray[1] - ray[0]))
        label = f"pixel ({pixel.column}, {pixel.row})"
        marks.append(SceneMark(points, "text", label, "ring" if is_hit else "cross"))
    return tuple(marks)


def _meet(start: Floats, end: Floats, corners: Floats) -> Floats | None:
    """Return where the line from ``start`` to ``end`` meets the plane of three corners (3, 3)."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    slope = float(normal @ (end - start))
    if not np.isfinite(corners).all() or slope == 0:
        return None
    met: Floats = start + float(normal @ (corners[0] - start)) / slope * (end - start)
    return met


def _placed(space: ViewSpace, clip: Floats) -> Floats:
    moved = transform(space.from_clip, clip)
    return np.asarray(moved[:, :3] / moved[:, 3:])
