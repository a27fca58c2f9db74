"""What every picture must be: exact coverage in whole numbers, one triangle at a time, from the definition.

Nothing of the core is used here for coverage, except for a mesh that reaches behind the eye, where the core's plain
fill, itself tested against rational arithmetic, is the reference. A typed text is compared with the rule.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.bench import records
from app.bench.typed_text import by_rule, pixels_of
from app.bench.workloads import corner_picture, lights_of, mesh_of, method_names, view_of
from core import Frame, Settings, render
from core.records.arrays import Flags

PLAIN = {"cull": "back", "fill": "bounding-box"}
"""Settings whose pictures are the reference."""


@dataclass(frozen=True, eq=False)
class Reference:
    """The picture and the work that is in it."""

    covered: Flags
    """(H, W) bool, row 0 at the bottom."""
    colors: records.Bytes
    """(H, W, 3) uint8; 0 where nothing is drawn."""
    primitive_count: int
    """Triangles or lines that are given."""
    fragment_count: int
    """Covered pixels of all front faces, or of all lines, seen or not."""

    @property
    def pixel_count(self) -> int:
        """Pixels that are covered at all."""
        return int(np.count_nonzero(self.covered))


@dataclass(frozen=True, eq=False)
class Cover:
    """The pixels of one triangle."""

    triangle: int
    rows: records.Integers
    """(F,) int64; also ``columns``."""
    columns: records.Integers
    weights: records.Floats
    """(F, 3) float64 barycentric weights of the pixel centres, quotients of whole numbers."""


def make_reference(work: records.Work) -> Reference:
    """Return what the picture of a workload must be."""
    if isinstance(work, records.ColdStart):
        return make_reference(work.triangles)
    if isinstance(work, records.Lines):
        return _line_reference(work)
    if isinstance(work, records.MeshFile):
        corners = corner_picture(work.positions, work.triangles)
        return Reference(np.asarray(corners.any(axis=2)), corners, len(corners), corners.size // 3)
    if isinstance(work, records.ViewedMesh):
        return _mesh_reference(work)
    if isinstance(work, records.TypedPicture):
        return _rule_reference(work)
    return _blended_reference(work) if work.is_blended else _nearest_reference(work)


def cover_triangles(corners: records.Floats, size: tuple[int, int]) -> Iterator[Cover]:
    """Yield the covered pixels of counter-clockwise window triangles (T, 3, 2), one after the other.

    Corners and pixel centres are whole numbers of 1/256 pixel, so every edge function is exact in int64. A centre on
    an edge belongs to the triangle that contains the point moved an infinitesimal step right, then up.
    """
    snapped = np.rint(corners * records.SUBPIXELS).astype(np.int64)
    half, limit = records.SUBPIXELS // 2, np.array(size)
    firsts = np.clip(-((half - snapped.min(axis=1)) // records.SUBPIXELS), 0, limit)
    ends = np.clip((snapped.max(axis=1) - half) // records.SUBPIXELS + 1, 0, limit)
    for triangle in np.flatnonzero((firsts < ends).all(axis=1)).tolist():
        (left, bottom), (right, top) = firsts[triangle], ends[triangle]
        x = records.SUBPIXELS * np.arange(left, right) + half
        y = (records.SUBPIXELS * np.arange(bottom, top) + half)[:, None]
        values = []
        inside = np.ones((top - bottom, right - left), bool)
        for k in range(3):
            (x1, y1), (x2, y2) = snapped[triangle, k - 2], snapped[triangle, k - 1]
            a, b = y1 - y2, x2 - x1
            value = a * (x - x1) + b * (y - y1)
            inside &= value >= (0 if a > 0 or (a == 0 and b > 0) else 1)
            values.append(value)
        row, column = np.nonzero(inside)
        chosen = np.stack([value[row, column] for value in values], axis=1)
        yield Cover(triangle, row + bottom, column + left, chosen / chosen.sum(axis=1, keepdims=True))


def _nearest_reference(work: records.WindowTriangles) -> Reference:
    """Return the picture of opaque triangles: at every pixel the nearest, the first of those that tie."""
    width, height = work.size
    nearest = np.full((height, width), np.inf)
    colors = np.zeros((height, width, 3))
    fragment_count = 0
    for cover in cover_triangles(work.corners, work.size):
        depth = cover.weights @ work.depth[cover.triangle]
        seen = depth < nearest[cover.rows, cover.columns]
        at = cover.rows[seen], cover.columns[seen]
        nearest[at] = depth[seen]
        colors[at] = cover.weights[seen] @ work.colors[cover.triangle, :, :3].astype(np.float64)
        fragment_count += len(seen)
    return Reference(np.isfinite(nearest), rounded(colors), len(work.corners), fragment_count)


def _blended_reference(work: records.WindowTriangles) -> Reference:
    """Return the picture of triangles of one colour each, blended over black in drawing order."""
    width, height = work.size
    colors = np.zeros((height, width, 3))
    covered = np.zeros((height, width), bool)
    fragment_count = 0
    for cover in cover_triangles(work.corners, work.size):
        at, color = (cover.rows, cover.columns), work.colors[cover.triangle, 0].astype(np.float64)
        alpha = color[3] / 255
        colors[at] = alpha * color[:3] + (1 - alpha) * colors[at]
        covered[at] = True
        fragment_count += len(cover.rows)
    return Reference(covered, rounded(colors), len(work.corners), fragment_count)


def plain_frame(work: records.ViewedMesh) -> Frame:
    """Draw a mesh with the plain methods."""
    return render(view_of(work, mesh_of(work), lights_of(work)), Settings(**PLAIN, **method_names(work)))  # type: ignore[arg-type]


def _mesh_reference(work: records.ViewedMesh) -> Reference:
    """Return the picture of a mesh: its colours are those of the core's plain methods."""
    frame = plain_frame(work)
    colors = rounded(255 * np.clip(frame.color[..., :3].astype(np.float64), 0, 1))
    try:
        projected = records.project(work)
    except ValueError:
        covered = np.asarray(frame.primitive >= 0)
        return Reference(covered, colors, len(work.triangles), int(frame.cover_count.sum()))
    covered = np.zeros(frame.primitive.shape, bool)
    fragment_count = 0
    for cover in cover_triangles(projected.corners, work.size):
        covered[cover.rows, cover.columns] = True
        fragment_count += len(cover.rows)
    return Reference(covered, colors, len(work.triangles), fragment_count)


def _rule_reference(work: records.TypedPicture) -> Reference:
    """Return the picture that the rules draw, which a text has to draw as well."""
    scene, settings = by_rule(work)
    frame = render(scene, settings)
    covered = np.asarray(frame.primitive >= 0)
    return Reference(
        covered, pixels_of(frame), frame.statistics["transform"].incoming, int(frame.cover_count.sum())
    )


def _line_reference(work: records.Lines) -> Reference:
    """Return the picture of lines by Bresenham's rule: a tie between two pixels is a step."""
    width, height = work.size
    colors = np.zeros((height, width, 3), np.uint8)
    covered = np.zeros((height, width), bool)
    fragment_count = 0
    for (x0, y0, x1, y1), color in zip(work.ends.tolist(), work.colors, strict=True):
        dx, dy = abs(x1 - x0), abs(y1 - y0)
        major, minor = max(dx, dy), min(dx, dy)
        along = np.arange(major + 1)
        aside = (2 * minor * along + major) // max(2 * major, 1)
        step_x, step_y = (along, aside) if dx >= dy else (aside, along)
        columns, rows = x0 + np.sign(x1 - x0) * step_x, y0 + np.sign(y1 - y0) * step_y
        colors[rows, columns] = color
        covered[rows, columns] = True
        fragment_count += major + 1
    return Reference(covered, colors, len(work.ends), fragment_count)


def rounded(colors: NDArray[np.float64]) -> records.Bytes:
    """Return colours (H, W, 3) from 0 to 255 as bytes, halves up."""
    return np.floor(colors + 0.5).astype(np.uint8)


COLOR_TOLERANCE = 2
"""Steps of 1/255 that a channel may be off: implementations round in different places."""


@dataclass(frozen=True)
class Difference:
    """How a picture differs from the reference."""

    covered: int
    """Pixels that are drawn on one side only."""
    colored: int
    """Other pixels with a channel that is off by more than ``COLOR_TOLERANCE``."""

    @property
    def is_none(self) -> bool:
        """Whether the pictures are the same."""
        return self.covered == self.colored == 0


def compare(pixels: records.Bytes, is_top_down: bool, reference: Reference) -> Difference:
    """Compare pixels (H, W, 3 or 4) with the reference; what is black is not drawn.

    Raises ValueError if the picture has another size.
    """
    colors = (pixels[::-1] if is_top_down else pixels)[..., :3]
    if colors.shape != reference.colors.shape:
        raise ValueError(f"the picture must be {reference.colors.shape}, got {colors.shape}")
    is_off = colors.any(axis=2) != reference.covered
    step = np.abs(colors.astype(np.int16) - reference.colors).max(axis=2)
    return Difference(
        int(np.count_nonzero(is_off)), int(np.count_nonzero((step > COLOR_TOLERANCE) & ~is_off))
    )
