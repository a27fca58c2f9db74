"""What the colours of a mesh ask of all of its vertices: the same from picture to picture, whatever the camera.

The values at vertices are the very same array in every picture of an orbit, where no light on them depends on the
camera; so what was found in the array of the last picture is kept with it.
"""

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from core.arrays import Flags, Floats
from core.primitives import CornerValues
from core.scene import Mesh

Color = tuple[np.float32, ...]
ALIKE = 0.2
"""Least cosine between the normals of a triangle: with less, those between them become too short."""


class VertexFacts:
    """Facts of the values (M, K) at the vertices of one mesh, found when they are first asked for."""

    def __init__(self, values: CornerValues, mesh: Mesh) -> None:
        self.rows, self._layout, self._mesh = values.rows, values.layout, mesh

    @cached_property
    def color(self) -> Color | None:
        """Linear grey, or red, green and blue, of all vertices; ``None``: they differ, or are not opaque."""
        colors = self.rows[:, self._layout["color"]]
        if not len(colors) or (colors != colors[:1]).any() or colors[0, 3] != 1:
            return None
        red, green, blue = (np.float32(part) for part in colors[0, :3])
        return (red,) if red == green == blue else (red, green, blue)

    @cached_property
    def normals(self) -> Floats:
        """(3, M) float64 unit normals in world space, a contiguous row for each component."""
        return np.ascontiguousarray(self.rows[:, self._layout["normal"]].T)

    @cached_property
    def unlike_share(self) -> float:
        """Part of the mesh's triangles that have two normals less alike than `ALIKE`.

        The backs of the vertices, if there are rows for them, have the same normals turned round, and cosines alike.
        """
        return float(
            are_unlike([self.normals.take(index, axis=1) for index in self._mesh.triangles.T]).mean()
        )

    @cached_property
    def uv(self) -> Floats:
        """(2, M) float64 texture coordinates, a contiguous row for u and for v."""
        return np.ascontiguousarray(self.rows[:, self._layout["uv"]].T)

    @cached_property
    def farthest_uv(self) -> float:
        """Greatest size of a texture coordinate; NaN if one is."""
        return float(np.abs(self.uv).max(initial=0))


_last: list[VertexFacts] = []


def vertex_facts(values: CornerValues, mesh: Mesh) -> VertexFacts:
    """Return what is known of values at the vertices of a mesh; that of the last array is kept."""
    for known in _last:
        if known.rows is values.rows:
            return known
    made = VertexFacts(values, mesh)
    # Another thread may keep others the next moment.
    _last[:] = [made]
    return made


def are_unlike(corners: Sequence[Floats]) -> Flags:
    """Return (P,) bool: two of three unit vectors (3, P) have a cosine below `ALIKE`; a zero vector is like none."""
    first, second, third = corners
    least = np.minimum(np.minimum(_cosine(first, second), _cosine(second, third)), _cosine(third, first))
    return ~np.asarray(least >= ALIKE)


def _cosine(a: Floats, b: Floats) -> Floats:
    product: Floats = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return product
