"""The pixel that the views are about: its triangle, and its ray in the scene."""

from dataclasses import dataclass

import numpy as np

from app.session.moment import Moment, Pixel
from app.views.scene_picture import fractions
from app.views.view_space import ViewSpace
from core.records.arrays import Floats
from core.records.steps import Level
from core.scene import Scene
from core.trace.source import TraceSource
from core.transform.matrices import transform
from widgets.space.scene_view import SceneMark

# Which pixel the stage views are about, and which triangle covers it.


@dataclass(frozen=True)
class PointedPixel:
    """A pixel of the traced raster."""

    column: int
    row: int
    role: str
    """``pin``, ``hover`` or ``step``."""

    @property
    def name(self) -> str:
        """What a person reads."""
        kind = {"pin": "pinned", "hover": "hovered", "step": "current"}[self.role]
        return f"{kind} pixel ({self.column}, {self.row})"


def pointed_pixels(moment: Moment) -> tuple[PointedPixel, ...]:
    """Return the pinned and the hovered pixel; where there is neither, the one of the step just done.

    While the user predicts there are none: what a view tells of a pixel may be the answer.
    """
    if moment.is_predicting:
        return ()
    found: list[PointedPixel] = []
    seen: set[Pixel] = set()
    for role, pixel in (("pin", moment.pin), ("hover", moment.hover)):
        if pixel is not None and pixel not in seen and moment.has_pixel(pixel):
            found.append(PointedPixel(*pixel, role))
            seen.add(pixel)
    if not found and moment.cursor.level >= Level.PIXEL and moment.pixel is not None:
        found.append(PointedPixel(*moment.pixel, "step"))
    return tuple(found)


def shown_triangle(moment: Moment) -> int:
    """Return the triangle that a view of one triangle shows.

    That is the one in focus, else that of the step just done, else the one seen at the pinned pixel, unless
    that is to be predicted, else 0.
    """
    document = moment.document
    if document.triangle is not None:
        return document.triangle
    if moment.triangle >= 0:
        return moment.triangle
    if moment.pin is not None and not moment.is_predicting:
        column, line = moment.place_of(moment.pin)
        seen = int(moment.trace.source.picture.primitive[line, column])
        return max(seen, 0)
    return 0


def fragment_at(
    source: TraceSource, column: int, row: int, preferred: int = -1, is_required: bool = False
) -> int:
    """Return the fragment that counts at a pixel, -1: none.

    Parameters
    ----------
    preferred : int
        A triangle: its fragment is taken if it has one here. Otherwise it is the last one that passed the
        depth test, or else the last one.
    is_required : bool
        Whether only a fragment of the preferred triangle counts.
    """
    fragments = source.fragments
    here = np.flatnonzero((fragments.column == column) & (fragments.row == row))
    if not len(here):
        return -1
    of_preferred = here[source.triangle_of_fragment[here] == preferred]
    if len(of_preferred):
        return int(of_preferred[-1])
    if is_required:
        return -1
    passed = here[source.depth_tests.passes[here]]
    return int(passed[-1]) if len(passed) else int(here[-1])


# Pixels of the traced picture in the 3D view: the ray through each, and where it meets what is seen.


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
