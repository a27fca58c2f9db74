"""Triangles in clip space made smaller: fewer of them, a smaller picture, fewer digits of corners and of values.

Corners that lie in the same place stay together, so that shared edges stay shared; values that are the same at the
three corners of a triangle stay the same.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from core.geometry.vertex_stage import transform_vertices
from core.records.arrays import Floats, Integers
from core.scene import AnyScene, ClipScene, Texture
from core.study.accuracy.workloads import flat_scene
from core.study.stability.minimization.kind import Kind, counted_triangles
from core.study.stability.minimization.numbers import digit_count, simpler_numbers
from core.study.stability.minimization.search import without_parts


@dataclass(frozen=True, eq=False)
class Triangles:
    """Triangles whose common corners are one vertex."""

    vertices: Floats
    """(N, 4) float64, clip space."""
    corners: Integers
    """(T, 3) int64."""
    size: tuple[int, int]
    values: Floats
    """(T, 3, K) float64, colours or texture coordinates."""
    texture: Texture | None
    background: Floats
    """(4,) float64, what the picture is cleared to."""

    def keep(self, index: Integers) -> "Triangles":
        """Return the triangles ``index`` (Q,) alone, with the vertices that they have."""
        used, corners = np.unique(self.corners[index], return_inverse=True)
        corners = corners.reshape(-1, 3).astype(np.int64)
        return replace(self, vertices=self.vertices[used], corners=corners, values=self.values[index])


def in_clip_space(scene: AnyScene) -> ClipScene:
    """Return the triangles of a scene after projection; one that is in clip space stays as it is."""
    if isinstance(scene, ClipScene):
        return scene
    vertices = transform_vertices(scene)
    return flat_scene(vertices.clip[vertices.corners], scene.size)


def take_apart(scene: AnyScene) -> Triangles:
    """Take a scene apart."""
    given = in_clip_space(scene)
    vertices, corners = np.unique(given.clip.reshape(-1, 4), axis=0, return_inverse=True)
    assert given.attributes is not None
    return Triangles(
        vertices,
        corners.reshape(-1, 3).astype(np.int64),
        given.size,
        given.attributes,
        given.texture,
        given.background,
    )


def put_together(triangles: Triangles) -> ClipScene:
    """Put the scene together."""
    return ClipScene(
        triangles.vertices[triangles.corners],
        triangles.values,
        triangles.size,
        triangles.texture,
        triangles.background,
        triangles.corners,
    )


def with_fewer_triangles(triangles: Triangles) -> Iterator[Triangles]:
    """Yield the triangles without a half, a quarter, an eighth ... of them."""
    for left in without_parts(len(triangles.corners)):
        yield triangles.keep(left)


def with_smaller_picture(triangles: Triangles) -> Iterator[Triangles]:
    """Yield the same with one half of the picture cut off, or at half the scale."""
    width, height = triangles.size
    for axis, side in enumerate(triangles.size):
        if side < 2:
            continue
        kept = side // 2
        size = (kept, height) if axis == 0 else (width, kept)
        for first in (0, side - kept):
            # The place in pixels, (x + w) side / 2, moves by ``first``.
            vertices = triangles.vertices.copy()
            w = vertices[:, 3]
            vertices[:, axis] = ((vertices[:, axis] + w) * side - 2 * first * w) / kept - w
            yield replace(triangles, vertices=vertices, size=size)
        yield replace(triangles, size=size)


def with_simpler_corners(triangles: Triangles) -> Iterator[Triangles]:
    """Yield the same with one coordinate written in fewer digits, those with the most digits first."""
    counts = [(-digit_count(value), k) for k, value in enumerate(triangles.vertices.ravel().tolist())]
    for negative, place in sorted(counts):
        vertex, axis = divmod(place, 4)
        value = float(triangles.vertices[vertex, axis])
        for simpler in simpler_numbers(value, 1.0 if axis == 3 else 0.0, -negative):
            vertices = triangles.vertices.copy()
            vertices[vertex, axis] = simpler
            yield replace(triangles, vertices=vertices)


def with_simpler_values(triangles: Triangles) -> Iterator[Triangles]:
    """Yield the same with one value of a corner, or the one that all three have, written in fewer digits."""
    places: list[tuple[int, int, slice, int]] = []
    for number, channel in np.ndindex(len(triangles.values), triangles.values.shape[2]):
        of_corners = triangles.values[number, :, channel].tolist()
        is_one = len(set(of_corners)) == 1
        for corner, value in enumerate(of_corners[:1] if is_one else of_corners):
            where = slice(None) if is_one else slice(corner, corner + 1)
            places.append((-digit_count(value), number, where, channel))
    for negative, number, where, channel in sorted(places, key=lambda place: place[0]):
        value = float(triangles.values[number, where, channel][0])
        for simpler in simpler_numbers(value, 0.0, -negative):
            values = triangles.values.copy()
            values[number, where, channel] = simpler
            yield replace(triangles, values=values)


def in_words(triangles: Triangles) -> str:
    """Return how many triangles there are in how large a picture."""
    return counted_triangles(len(triangles.corners), triangles.size)


_SHAPE = (with_fewer_triangles, with_smaller_picture, with_simpler_corners)
TRIANGLES = Kind(take_apart, put_together, _SHAPE, in_words)
"""Triangles of which only the shape matters; their colours stay."""
VALUED_TRIANGLES = Kind(take_apart, put_together, (*_SHAPE, with_simpler_values), in_words)
"""Triangles of which the values at the corners matter too."""
