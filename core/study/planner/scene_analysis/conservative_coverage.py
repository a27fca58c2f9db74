"""The look at a scene: every pixel with every triangle that touches its square, and how deep it lies there.

One sample a pixel would miss what lies between the samples, so the look is conservative: a pixel's square is grown by
`MARGIN`, and a triangle touches it if no edge has all of it outside. Then nothing that any number of samples sees, and
nothing that snapping moves, is missed. It costs about as much as drawing the outlines of the fragments once: 60 to 200
bytes and some twenty operations for each pair, a few times an unantialiased picture without shading.

References
----------
T. Akenine-Moeller, T. Aila, *Conservative and tiled rasterization using a modified triangle set-up*, 2005.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from core.fragments.interpolation import value_plane
from core.geometry.outcodes import PLANE_BITS, has_bits, joined_bits, outcodes
from core.methods import table
from core.raster.edges.snapping import snap
from core.records.arrays import Flags, Floats, Integers
from core.records.frame import STAGES, StageCount
from core.scene import AnyScene
from core.settings import Settings
from core.stages.geometry import Geometry
from core.stages.vertices import process_geometry
from core.study.planner.progress import Pause, unpaused
from core.study.planner.scene_analysis.pieces import Pieces, pieces_of

MARGIN = 1 / 64
"""Pixels by which squares are grown: more than twice snapping to 1/256 pixel moves anything."""
CHUNK = 1 << 18
"""Pixels of bounding boxes that are looked at in one go."""
THIN = 1 / 8
"""Triangles of no more height than this, in pixels, are looked at sample by sample."""
MOST_PAIRS = 1 << 24
"""Pairs of pixel and triangle that are kept; a scene with more is not planned."""


@dataclass(frozen=True, eq=False)
class Touched:
    """Q pairs of a pixel and a primitive that touches its square, by pixel and drawing order."""

    geometry: Geometry
    """The P primitives, clipped to the view volume."""
    pixel: Integers
    """(Q,) int64, row * width + column."""
    primitive: Integers
    """(Q,) int64."""
    x: Floats
    """(Q,) float64 pixels, centre of the square."""
    y: Floats
    """(Q,) float64 pixels."""
    near: Floats
    """(Q,) float64, window depth at least, over the square and within the triangle."""
    far: Floats
    """(Q,) float64, window depth at most."""
    is_outlined: Flags
    """(Q,) bool, an edge that has no neighbour of the same facing crosses the square."""
    depth_plane: tuple[Floats, Floats, Floats]
    """(P,) float64 each: window depth is a x + b y + c."""
    is_drawn: Flags
    """(Q,) bool, False: a triangle so thin that it covers no sample there, of one or of 4 x 4."""
    component: Integers
    """(P,) int64, which primitives hang together by their corners."""
    facing: Floats
    """(P,) float64, twice the signed area in the window; positive: a front."""
    size: tuple[int, int]
    pieces: Pieces
    """Of the pairs."""
    vertex: Integers
    """(P, 3) int64, numbers of the corners: the same where their clip positions are, bit for bit."""

    @property
    def pixel_count(self) -> int:
        """Pixels of the picture."""
        return self.size[0] * self.size[1]

    def take(self, index: Integers) -> "Touched":
        """Return the look at the pairs ``index`` (R,) only; pieces stay those of all."""
        of_pairs = ("pixel", "primitive", "x", "y", "near", "far", "is_outlined", "is_drawn")
        return replace(self, **{name: getattr(self, name).take(index) for name in of_pairs})


def touch(scene: AnyScene, settings: Settings, pause: Pause = unpaused) -> Touched:
    """Look which primitives touch which pixels.

    Parameters
    ----------
    scene : Scene or ClipScene
    settings : Settings
        Those of everything on; clipping makes sure that every primitive is in front of the eye.
    pause : callable, optional
        Asked between the parts, see `Pause`.

    Raises
    ------
    ValueError
        If there are too many pairs.
    """
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(scene, replace(settings, antialiasing="none"), counts)
    offset = float(table.get("pixel_center", settings.pixel_center).function())
    window = geometry.corners.window
    x, y = window[..., 0].T, window[..., 1].T
    facing = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    edges = _edges(x, y, facing)
    pause()
    vertex = _vertices(geometry)
    component = components(vertex)
    outlined = outline_edges(vertex, component, facing)
    found, total = [], 0
    pause()
    for number, column, row in _boxes(x, y, scene.size, offset):
        pause()
        at_x, at_y = column + np.float64(offset), row + np.float64(offset)
        kept, crossing = _touches(
            edges, outlined, number, at_x, at_y, _inside(column, row, scene.size, offset)
        )
        total += int(np.count_nonzero(kept))
        if total > MOST_PAIRS:
            raise ValueError(f"a scene to be planned must touch at most {MOST_PAIRS:,} pixels, got more")
        pixel = row * scene.size[0] + column
        found.append((number[kept], pixel[kept], at_x[kept], at_y[kept], crossing[kept]))
    empty = np.empty(0, np.int64)
    primitive = np.concatenate([empty, *(part[0] for part in found)])
    pixel = np.concatenate([empty, *(part[1] for part in found)])
    pause()
    order = np.argsort(pixel * np.int64(len(geometry.primitives)) + primitive, kind="stable")
    primitive, pixel = primitive[order], pixel[order]
    x_of_pixel = np.concatenate([np.empty(0), *(part[2] for part in found)])[order]
    y_of_pixel = np.concatenate([np.empty(0), *(part[3] for part in found)])[order]
    is_outlined = np.concatenate([np.empty(0, bool), *(part[4] for part in found)])[order]
    pause()
    clip = geometry.primitives.clip
    plane = value_plane(geometry.planes, (clip[..., 2] + clip[..., 3]) / 2)
    near, far = _depths(geometry, plane, primitive, x_of_pixel, y_of_pixel)
    return Touched(
        geometry,
        pixel,
        primitive,
        x_of_pixel,
        y_of_pixel,
        near,
        far,
        is_outlined,
        plane,
        _is_drawn(geometry, facing, primitive, x_of_pixel, y_of_pixel),
        component,
        facing,
        scene.size,
        pieces_of(pixel, component.take(primitive), facing.take(primitive), far, is_outlined),
        vertex,
    )


def is_cut(touched: Touched) -> Flags:
    """Return (P,) bool: the primitive is of a triangle that crosses a plane of the view volume."""
    return _is_cut(touched.geometry)


def _is_cut(geometry: Geometry) -> Flags:
    cut = has_bits(joined_bits(outcodes(geometry.kept.vertex_clip.T), geometry.kept.corner), PLANE_BITS)
    return np.asarray(np.isin(geometry.primitives.triangle, geometry.kept.triangle[cut]))


@dataclass(frozen=True, eq=False)
class _Inside:
    """How squares at the border of the picture are moved and made smaller: no sample lies beyond."""

    x: Floats
    y: Floats
    width: Floats
    """(Q,) float64 pixels, half the side."""
    height: Floats


def _inside(column: Integers, row: Integers, size: tuple[int, int], offset: float) -> _Inside:
    """Return the squares (Q,) as far as samples can lie: those at the border are not grown outwards, but shrunk."""
    parts = []
    for place, length in ((column, size[0]), (row, size[1])):
        # Where centres are whole numbers, the outer half of a border pixel lies beyond the view volume.
        first, last = ((place == end) & (offset == 0.5) for end in (0, length - 1))
        move = MARGIN * (first.astype(np.float64) - last)
        parts.append((place + offset + move, 0.5 + MARGIN * (1.0 - first - last)))
    return _Inside(parts[0][0], parts[1][0], parts[0][1], parts[1][1])


def square_range(
    plane: tuple[Floats, Floats, Floats], primitive: Integers, x: Floats, y: Floats
) -> tuple[Floats, Floats]:
    """Return the least and the largest value (Q,) of planes (P,) over grown squares around ``x``, ``y`` (Q,)."""
    a, b, c = (part.take(primitive) for part in plane)
    middle, reach = a * x + b * y + c, (np.abs(a) + np.abs(b)) * (0.5 + MARGIN)
    return middle - reach, middle + reach


def _is_drawn(geometry: Geometry, facing: Floats, primitive: Integers, x: Floats, y: Floats) -> Flags:
    """Return (Q,) bool, False where a thin triangle that is not cut covers no sample, decided as coverage does."""
    window = geometry.corners.window
    edge = np.linalg.norm(window - np.roll(window, 1, axis=1), axis=2).max(axis=1)
    is_thin = ~_is_cut(geometry) & ~(np.abs(facing) > THIN * edge)
    index = np.flatnonzero(is_thin.take(primitive))
    found = np.ones(len(primitive), bool)
    found[index] = False
    for side in (1, 4):
        corners = snap(window * side)[0]
        corner_x, corner_y = corners[..., 0].T, corners[..., 1].T
        area = (corner_x[1] - corner_x[0]) * (corner_y[2] - corner_y[0])
        area -= (corner_x[2] - corner_x[0]) * (corner_y[1] - corner_y[0])
        a, b, c = (part[:, primitive[index]] for part in _edges(corner_x, corner_y, area))
        for step_y in range(side):
            for step_x in range(side):
                at_x = side * (x[index] - 0.5) + step_x + 0.5
                at_y = side * (y[index] - 0.5) + step_y + 0.5
                found[index] |= (a * at_x + b * at_y + c >= 0).all(axis=0) & (area[primitive[index]] != 0)
    return found


def _depths(
    geometry: Geometry, plane: tuple[Floats, Floats, Floats], primitive: Integers, x: Floats, y: Floats
) -> tuple[Floats, Floats]:
    """Return the range of window depth (Q,) over the squares, within that of the corners."""
    near, far = square_range(plane, primitive, x, y)
    corner = geometry.depth.take(primitive, axis=1)
    # Snapping lets depth run on past the corners by a hair.
    hair = (np.abs(plane[0]) + np.abs(plane[1])).take(primitive) * MARGIN
    near = np.fmax(near, corner.min(axis=0) - hair)
    far = np.fmin(far, corner.max(axis=0) + hair)
    return np.nan_to_num(near, nan=-np.inf), np.nan_to_num(far, nan=np.inf)


def _edges(x: Floats, y: Floats, facing: Floats) -> tuple[Floats, Floats, Floats]:
    """Return a, b, c (3, P) of the edge functions a x + b y + c, positive inside; edge k starts at corner k."""
    end_x, end_y = np.roll(x, -1, axis=0), np.roll(y, -1, axis=0)
    sign = np.where(facing < 0, -1.0, 1.0)
    a, b = (y - end_y) * sign, (end_x - x) * sign
    return a, b, -(a * x + b * y)


def _boxes(
    x: Floats, y: Floats, size: tuple[int, int], offset: float
) -> Iterator[tuple[Integers, Integers, Integers]]:
    """Yield primitive, column and row of the pixels in the bounding boxes, some primitives at a time."""
    reach = 0.5 + MARGIN
    with np.errstate(invalid="ignore"):
        low = [np.ceil(np.nan_to_num(at.min(axis=0), nan=-1e9) - offset - reach) for at in (x, y)]
        high = [np.floor(np.nan_to_num(at.max(axis=0), nan=1e9) - offset + reach) + 1 for at in (x, y)]
    first = [np.clip(at, 0, most).astype(np.int64) for at, most in zip(low, size, strict=True)]
    end = [np.clip(at, 0, most).astype(np.int64) for at, most in zip(high, size, strict=True)]
    columns, rows = (np.maximum(last - start, 0) for start, last in zip(first, end, strict=True))
    area = columns * rows
    cut = np.flatnonzero(np.diff(np.cumsum(area) // CHUNK)) + 1
    for part in np.split(np.arange(len(area)), cut):
        number = np.repeat(part, area[part])
        place = np.arange(len(number)) - np.repeat(np.cumsum(area[part]) - area[part], area[part])
        yield (
            number,
            first[0][number] + place % np.maximum(columns[number], 1),
            first[1][number] + place // np.maximum(columns[number], 1),
        )


def _touches(
    edges: tuple[Floats, Floats, Floats],
    outlined: Flags,
    primitive: Integers,
    x: Floats,
    y: Floats,
    inside: _Inside,
) -> tuple[Flags, Flags]:
    """Return (Q,) bool: the primitive touches the grown square; and one of its outlined edges crosses it inside."""
    kept, crossing = np.ones(len(primitive), bool), np.zeros(len(primitive), bool)
    for edge in range(3):
        plane = edges[0][edge], edges[1][edge], edges[2][edge]
        kept &= ~(square_range(plane, primitive, x, y)[1] < 0)
        a, b, c = (part.take(primitive) for part in plane)
        low = a * inside.x + b * inside.y + c - np.abs(a) * inside.width - np.abs(b) * inside.height
        crossing |= outlined[edge].take(primitive) & ~(low > 0)
    return kept, crossing


def _vertices(geometry: Geometry) -> Integers:
    """Return (P, 3) int64 numbers of the corners, the same where their clip positions are, bit for bit."""
    corners = (geometry.primitives.clip + 0.0).reshape(-1, 4)
    if not len(corners):
        return np.empty((0, 3), np.int64)
    return np.asarray(np.unique(corners, axis=0, return_inverse=True)[1].reshape(-1, 3))


def components(vertex: Integers) -> Integers:
    """Return (P,) int64, the same number for triangles (P, 3) that hang together by their corners."""
    label = np.arange(int(vertex.max(initial=-1)) + 1)
    while True:
        least = label[vertex].min(axis=1)
        joined = label.copy()
        np.minimum.at(joined, vertex, least[:, None])
        joined = joined[joined]
        if (joined == label).all():
            return np.asarray(least)
        label = joined


def outline_edges(vertex: Integers, component: Integers, facing: Floats) -> Flags:
    """Return (3, P) bool: edge k of a primitive has no neighbour in its component that faces the same way.

    Parameters
    ----------
    vertex : (P, 3) int64
        Corners of one number are snapped alike, so no pixel is lost between.
    component : (P,) int64
    facing : (P,) float64

    Notes
    -----
    Crossing an edge that is not outlined, the number of triangles of this component and facing stays the same: an edge
    goes as often one way as the other.
    """
    count = len(vertex)
    if not count:
        return np.zeros((3, 0), bool)
    start, end = vertex.T, np.roll(vertex, -1, axis=1).T
    group = np.broadcast_to(component * 2 + (facing < 0), (3, count))
    keys = np.stack([group, np.minimum(start, end), np.maximum(start, end)], axis=-1).reshape(-1, 3)
    edge = np.unique(keys, axis=0, return_inverse=True)[1].reshape(-1)
    direction = np.where(start < end, 1, -1).reshape(-1)
    balance = np.bincount(edge, direction, minlength=1)
    return np.asarray((balance[edge] != 0).reshape(3, count))
