"""What light needs of a mesh as planes over the window: where corners lie, and what its vertices share.

The values at vertices are the same array in every picture of an orbit, where no light on them depends on the
camera; so what was found in the array of the last picture is kept with it.

Planes through corners far from the origin are rounded, these and those of ``render``, by `ROUNDING` times x y over the
area, as a part of what the corners differ by (``core.interpolation.interpolation``).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from core.coverage.snapping import window_position
from core.fast_path.depth_free import is_thin
from core.numeric.planes import window_slopes
from core.records.arrays import Flags, Floats, Integers, cached_property
from core.scene import Camera
from core.stages.geometry import Geometry
from core.transform.matrices import world_to_camera

# Where corners lie in the window before they are snapped: attributes belong to these, coverage to the
# snapped ones.


@dataclass(frozen=True, eq=False)
class CornerPlaces:
    """The corners of P triangles: of those that are doubtful, where nothing is divided by 0.

    An unsnapped thin triangle, hardly wider than snapping moves its corners, may have turned over, or be a line; the
    snapped one is what is drawn. A corner behind the eye, or too far beside the window, has no place in it.
    """

    x: Floats
    """(3, P) float64 pixels."""
    y: Floats
    """(3, P) float64."""
    w: Floats
    """(3, P) float64, above 0."""
    doubled_area: Floats
    """(P,) float64, not 0: 1 for triangles without area, which cover no pixel, and those without places."""
    is_doubtful: Flags
    """(P,) bool, thin triangles (``core.fast_path.depth_free``) and those that cannot be projected: planes do not
    hold."""

    def take(self, chosen: Integers) -> "CornerPlaces":
        """Return the places of the ``chosen`` (C,) triangles."""
        x, y, w = (of.take(chosen, axis=1) for of in (self.x, self.y, self.w))
        return CornerPlaces(x, y, w, self.doubled_area.take(chosen), self.is_doubtful.take(chosen))


def corner_places(geometry: Geometry) -> CornerPlaces:
    """Return where the corners of all primitives lie."""
    primitives, (right, up) = geometry.primitives, geometry.shift
    window = window_position(primitives.vertex_clip.T, geometry.vertices.size)
    x, y = (window[:, 0] + right).take(primitives.corner), (window[:, 1] + up).take(primitives.corner)
    w = primitives.vertex_clip[3].take(primitives.corner)
    has_place = geometry.is_projected
    is_doubtful = is_thin(geometry) | ~has_place
    thin = np.flatnonzero(is_doubtful & has_place)
    for unsnapped, snapped in ((x, geometry.window_x), (y, geometry.window_y)):
        unsnapped[:, thin] = snapped.take(thin, axis=1)
    nowhere = np.flatnonzero(~has_place)
    x[:, nowhere] = y[:, nowhere] = 0.0
    w[:, nowhere] = 1.0
    doubled_area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    doubled_area[doubled_area == 0] = 1.0
    return CornerPlaces(x, y, w, doubled_area, is_doubtful)


# What the colours of a mesh ask of all of its vertices: the same from picture to picture, whatever the
# camera.


Color = tuple[np.float32, ...]
ALIKE = 0.2
"""Least cosine between the normals of a triangle: with less, those between them become too short."""


class VertexValues:
    """The values (M, K) at the vertices of all meshes, or at the corners of pieces, in contiguous columns."""

    def __init__(self, rows: Floats, layout: dict[str, slice]) -> None:
        self.rows, self.layout = rows, layout
        self.of_mesh: dict[int, VertexFacts] = {}
        self._seen: tuple[Camera, Floats] | None = None

    @cached_property
    def normals(self) -> Floats:
        """(3, M) float64 unit normals in world space, a contiguous row for each component."""
        return np.ascontiguousarray(self.rows[:, self.layout["normal"]].T)

    def normals_seen_by(self, camera: Camera) -> Floats:
        """Return the `normals` (3, M) in the space of a camera; those of the last one are kept."""
        seen = self._seen
        if seen is None or seen[0] is not camera:
            # Another thread may keep those of another camera the next moment.
            self._seen = seen = camera, world_to_camera(camera)[:3, :3] @ self.normals
        return seen[1]

    @cached_property
    def colors(self) -> Floats:
        """(3, M) float64 linear red, green and blue, or (1, M) where they agree, a contiguous row each."""
        colors = np.ascontiguousarray(self.rows[:, self.layout["color"]].T[:3])
        return colors[:1] if (colors[1:] == colors[:1]).all() else colors

    @cached_property
    def uv(self) -> Floats:
        """(2, M) float64 texture coordinates, a contiguous row for u and for v."""
        return np.ascontiguousarray(self.rows[:, self.layout["uv"]].T)


class VertexFacts:
    """Facts of the values at the vertices of one mesh, found when they are first asked for.

    The backs of the vertices, if there are rows for them, have the same colours and coordinates, and the same normals
    turned round.
    """

    def __init__(self, values: VertexValues, corner: Integers) -> None:
        """``corner`` (3, T): the rows of the mesh's triangles, which no other mesh has in between."""
        self.values, self._corner = values, corner
        self._rows = slice(int(corner.min()), int(corner.max()) + 1) if corner.size else slice(0)

    @cached_property
    def is_opaque(self) -> bool:
        """Whether all vertices are opaque, and no colour is below 0."""
        colors = self.values.rows[self._rows, self.values.layout["color"]]
        return bool(len(colors) and (colors[:, 3] == 1).all() and colors.min() >= 0)

    @cached_property
    def brightest(self) -> float:
        """Greatest linear colour of a vertex."""
        return float(self.values.rows[self._rows, self.values.layout["color"]][:, :3].max(initial=0))

    @cached_property
    def color(self) -> Color | None:
        """Linear grey, or red, green and blue, of all vertices, if these are opaque; ``None``: they differ."""
        colors = self.values.rows[self._rows, self.values.layout["color"]]
        if not len(colors) or (colors != colors[:1]).any():
            return None
        red, green, blue = (np.float32(part) for part in colors[0, :3])
        return (red,) if red == green == blue else (red, green, blue)

    @property
    def triangle_count(self) -> int:
        """How many triangles the mesh has."""
        return len(self._corner[0])

    @cached_property
    def unlike_count(self) -> int:
        """How many of them have two normals less alike than `ALIKE`."""
        corners = [self.values.normals.take(index, axis=1) for index in self._corner]
        return int(np.count_nonzero(are_unlike(corners)))

    @cached_property
    def farthest_uv(self) -> float:
        """Greatest size of a texture coordinate; NaN if one is."""
        return float(np.abs(self.values.uv[:, self._rows]).max(initial=0))


_last: list[VertexValues] = []


def vertex_facts(geometry: Geometry, mesh_number: int) -> VertexFacts:
    """Return what is known of values at the vertices of a mesh; what was found last is kept.

    Where triangles are clipped it is that of the ones that are drawn, which are others in the next picture.
    """
    of_corners = geometry.primitives.values
    values = next((known for known in _last if known.rows is of_corners.rows), None)
    if values is None:
        values = VertexValues(of_corners.rows, of_corners.layout)
        # Another thread may keep others the next moment.
        _last[:] = [values]
    if geometry.has_pieces:
        return VertexFacts(values, of_corners.index)
    if mesh_number not in values.of_mesh:
        assembled = geometry.assembled
        corner = geometry.vertices.corner_rows.take(assembled.triangle, axis=1)
        if assembled.mesh.any():
            corner = corner[:, assembled.mesh == mesh_number]
        values.of_mesh[mesh_number] = VertexFacts(values, corner)
    return values.of_mesh[mesh_number]


def are_unlike(corners: Sequence[Floats]) -> Flags:
    """Return (P,) bool: two of three unit vectors (3, P) have a cosine below `ALIKE`; a zero vector is like none."""
    first, second, third = corners
    least = np.minimum(np.minimum(_cosine(first, second), _cosine(second, third)), _cosine(third, first))
    return ~np.asarray(least >= ALIKE)


def _cosine(a: Floats, b: Floats) -> Floats:
    product: Floats = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return product


# Planes over the window in float64, evaluated at pixels in memory that is used again.


ROUNDING = 2.0**-48
"""Rounding of planes, as a part of the products of coordinates in them, with room to spare."""

Plane = tuple[Floats, Floats, Floats]
"""Change per column, per row, and value at the window's origin, (P,) float64 each."""


def plane_through(places: CornerPlaces, values: list[Floats]) -> Plane:
    """Return the plane through values (P,) at the three corners."""
    across, up = window_slopes(places.x, places.y, places.doubled_area, *values)
    origin = values[0] - (across * places.x[0] + up * places.y[0])
    return across, up, origin


def rounding(places: CornerPlaces, extent: Floats) -> Floats:
    """Return by how much (P,) values may be off that the corners of a triangle differ in by ``extent`` (P,).

    Used up is ``extent``: second minus first plus third minus first, in size. Doubtful triangles have no such bound: 0.
    """
    extent[places.is_doubtful] = 0
    extent /= np.abs(places.doubled_area)
    extent *= np.abs(places.x).max(axis=0)
    extent *= np.abs(places.y).max(axis=0)
    extent *= ROUNDING
    return extent


class Shown(NamedTuple):
    """The primitives of F pixels."""

    primitives: Integers
    """(U,) int64, each once."""
    local: Integers
    """(F,) int64, which of these a pixel shows: numbers of so few stay in the processor's nearest cache."""


def evaluate(plane: Plane, shown: Shown, x: Floats, y: Floats, values: Floats, term: Floats) -> None:
    """Write the ``values`` (F,) of the planes of primitives at pixel centres (F,); ``term`` (F,) is memory."""
    across, up, origin = (part.take(shown.primitives) for part in plane)
    up.take(shown.local, out=values, mode="clip")
    values *= y
    values += origin.take(shown.local, out=term, mode="clip")
    across.take(shown.local, out=term, mode="clip")
    term *= x
    values += term
