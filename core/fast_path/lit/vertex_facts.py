"""What the colours of a mesh ask of all of its vertices: the same from picture to picture, whatever the camera.

The values at vertices are the same array in every picture of an orbit, where no light on them depends on the
camera; so what was found in the array of the last picture is kept with it.
"""

from collections.abc import Sequence

import numpy as np

from core.geometry.matrices import world_to_camera
from core.records.arrays import Flags, Floats, Integers
from core.records.cached import cached_property
from core.scene import Camera
from core.stages.geometry import Geometry

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
    if geometry.clipped is not None:
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
