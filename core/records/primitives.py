"""What is drawn, as the stages hand it on: primitives with everything to be interpolated, and rings of corners."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from core.methods import table
from core.records.arrays import Flags, Floats, Integers, cached_property, checked

if TYPE_CHECKING:
    from core.records.steps import RowOrder
    from core.visibility.exact_case import Decide

# The records that stages hand on: triangles in clip space with everything that is to be interpolated.


FORMS = ("perspective", "affine", "flat")
"""How values change from pixel to pixel, and along lines: with perspective, linearly in the window, not at all."""


LIT = ("fragments", "vertices", "faces", "nothing")
"""What a method of shading lights."""


def lit_by(shading: str) -> str:
    """Return which of `LIT` a method of the family ``shading`` lights: the ``traits`` of its row."""
    lit: str = table.get("shading", shading).traits
    if lit not in LIT:
        raise ValueError(f"traits of shading {shading} must be one of {', '.join(LIT)}, got {lit}")
    return lit


def interpolation_form(interpolation: str) -> str:
    """Return which of `FORMS` a method of the family ``interpolation`` follows: the ``traits`` of its row."""
    form: str = table.get("interpolation", interpolation).traits
    if form not in FORMS:
        raise ValueError(
            f"traits of interpolation {interpolation} must be one of {', '.join(FORMS)}, got {form}"
        )
    return form


@dataclass(frozen=True, eq=False)
class Primitives:
    """P triangles, or pieces of triangles made by clipping, in drawing order."""

    clip: Floats
    """(P, 3, 4) float64, clip space."""
    varyings: Floats
    """(P, 3, K) float64, values at the corners."""
    triangle: Integers
    """(P,) int64, number of the triangle in drawing order; pieces keep it."""
    mesh: Integers
    """(P,) int64, the mesh it belongs to (0 for triangles given in clip space)."""
    layout: dict[str, slice]
    """Which of the K values are ``color``, ``uv``, ``normal``, ``position``, ``diffuse_light``, ``specular_light``."""

    def __len__(self) -> int:
        return len(self.clip)

    def take(self, index: Integers) -> "Primitives":
        """Return the primitives of ``index`` (Q,), in that order."""
        return replace(
            self,
            clip=self.clip.take(index, axis=0),
            varyings=self.varyings.take(index, axis=0),
            triangle=self.triangle[index],
            mesh=self.mesh[index],
        )

    def select(self, keep: np.ndarray) -> "Primitives":
        """Return the primitives where ``keep`` (P,) bool holds."""
        return self if keep.all() else self.take(np.flatnonzero(keep))


@dataclass(frozen=True, eq=False)
class CornerValues:
    """What is interpolated over P triangles; corners that have the same values share one row."""

    rows: Floats
    """(M, K) float64."""
    layout: dict[str, slice]
    """Which of the K values are what, see ``Primitives``."""
    index: Integers
    """(3, P) int64, the row of every corner."""

    @property
    def at_corners(self) -> Floats:
        """(P, 3, K) float64."""
        return self.rows.take(self.index.T, axis=0)

    def trimmed(self) -> "CornerValues":
        """Return the same values without the rows of other triangles, where these are few among many."""
        if self.index.size > len(self.rows) // 8:
            return self
        used, index = np.unique(self.index, return_inverse=True)
        return CornerValues(self.rows.take(used, axis=0), self.layout, index.reshape(self.index.shape))


@dataclass(frozen=True, eq=False)
class IndexedPrimitives:
    """P primitives whose corners are vertices; what ``Primitives`` holds is gathered when it is first asked for."""

    vertex_clip: Floats
    """(4, M) float64, clip-space x, y, z, w of the vertices."""
    corner: Integers
    """(3, P) int64, the vertices of every primitive."""
    triangle: Integers
    """(P,) int64, see ``Primitives``."""
    mesh: Integers
    """(P,) int64, see ``Primitives``."""
    values_of: Callable[[Integers], CornerValues]
    """The values at the corners of ``source``, or of any part of it."""
    source: Integers
    """(P,) int64, the number by which ``values_of`` knows each primitive."""

    def __len__(self) -> int:
        return len(self.triangle)

    def take(self, index: Integers) -> "IndexedPrimitives":
        """Return the primitives of ``index`` (Q,), in that order; values that are known go with them."""
        taken = replace(
            self,
            corner=self.corner.take(index, axis=1),
            triangle=self.triangle.take(index),
            mesh=self.mesh.take(index),
            source=self.source.take(index),
        )
        known: CornerValues | None = vars(self).get("values")
        if known is not None:
            vars(taken)["values"] = replace(known, index=known.index.take(index, axis=1))
        return taken

    def clip_of(self, index: Integers) -> Floats:
        """Return the clip positions (Q, 3, 4) of primitives (Q,)."""
        return self.vertex_clip.take(self.corner.take(index, axis=1), axis=1).T

    @cached_property
    def clip(self) -> Floats:
        """(P, 3, 4) float64, clip space."""
        return self.vertex_clip.take(self.corner, axis=1).T

    @cached_property
    def values(self) -> CornerValues:
        """What is interpolated, with one row for corners that share it."""
        return self.values_of(self.source)

    @cached_property
    def varyings(self) -> Floats:
        """(P, 3, K) float64, values at the corners."""
        return self.values.at_corners

    @property
    def layout(self) -> dict[str, slice]:
        """Which of the K values are what, see ``Primitives``."""
        return self.values.layout

    def gathered(self) -> Primitives:
        """Return the same primitives, each with its own corners."""
        return Primitives(self.clip, self.varyings, self.triangle, self.mesh, self.layout)


def index_corners(primitives: Primitives) -> IndexedPrimitives:
    """Return the same primitives, every corner a vertex of its own."""
    count = len(primitives)
    rows = primitives.varyings.reshape(3 * count, primitives.varyings.shape[2])

    def values_of(source: Integers) -> CornerValues:
        return CornerValues(rows, primitives.layout, own_corners(source))

    number = np.arange(count)
    vertex_clip = np.ascontiguousarray(primitives.clip.reshape(-1, 4).T)
    return IndexedPrimitives(
        vertex_clip, own_corners(number), primitives.triangle, primitives.mesh, values_of, number
    )


def own_corners(number: Integers, count: int = 3) -> Integers:
    """Return (3, P): the corners of primitives (P,) of which each has ``count`` vertices of its own, in their order.

    A segment's third corner is its second once more, and all of a point's are the same.
    """
    return count * number + np.minimum(np.arange(3), count - 1)[:, None]


@dataclass(frozen=True, eq=False)
class Pieces:
    """Q pieces of triangles, whole ones among them, cut before anything is divided by w."""

    clip: Floats
    """(Q, 3, 4) float64, clip space."""
    shares: Floats
    """(Q, 3, 3) float64, shares of the triangle's three corners in every corner of the piece."""
    number: Integers
    """(Q,) int64, counts the pieces of one triangle in the order in which they were cut; 0: the whole triangle."""

    def take(self, index: Integers) -> "Pieces":
        """Return the pieces of ``index`` (R,), in that order."""
        return Pieces(*(values.take(index, axis=0) for values in vars(self).values()))


@dataclass(frozen=True, eq=False)
class DrawingOrder:
    """In which order primitives are drawn, whether they are cut before, and whether the depth test decides."""

    order: Integers
    """(Q,) int64, the primitives from the first drawn to the last; one that is cut stands there once for each piece."""
    uses_depth_test: bool
    decides: "Decide | None" = None
    """Decides which fragments are kept; ``None``: by what the depth buffer holds, if at all."""
    row_order: "RowOrder | None" = None
    """How the stage depth lists its rows, as `PIXEL_BY_PIXEL`; ``None``: triangle by triangle."""
    asks_all: bool = False
    """Whether the ray of a pixel asks all primitives, so that those that it misses have rows, too."""
    pieces: Pieces | None = None
    """What is drawn in this order; ``None``: the primitives themselves."""
    walks_tree: bool = False
    """Whether rays find the primitives that they ask in a tree of boxes."""
    own_rows: str = ""
    """What puts rows of the order itself before those of the depth test, ``module.function``; empty: it has none."""
    resolves_lists: bool = False
    """Whether what is blended over is resolved from the front of each pixel's list to its back."""

    @property
    def is_as_given(self) -> bool:
        """Whether the primitives are drawn in the order of their numbers."""
        return bool((self.order[1:] > self.order[:-1]).all())


# Rings: closed lines of corners in the window. One is the outline of a polygon, more are its holes or
# islands.


RING_CORNERS = 3
"""Least number of corners of a ring."""


@dataclass(frozen=True, eq=False)
class Rings:
    """The rings of P polygons; one polygon's stand together, in the order of the polygons."""

    corners: Floats
    """(V, 2) float64, pixels; the rings' corners one after the other."""
    starts: Integers
    """(R + 1,) int64: ring k has the corners from ``starts[k]`` to ``starts[k + 1]``."""
    polygon: Integers
    """(R,) int64, the polygon of each ring, not falling."""

    @property
    def following(self) -> Integers:
        """(V,) int64, the corner after each one on its ring."""
        following = np.arange(1, len(self.corners) + 1)
        following[self.starts[1:] - 1] = self.starts[:-1]
        return following

    @property
    def polygon_of_corner(self) -> Integers:
        """(V,) int64."""
        return np.repeat(self.polygon, np.diff(self.starts))

    @property
    def areas(self) -> Floats:
        """(R,) float64, signed area inside each ring, in square pixels: above 0 where it runs counter-clockwise."""
        away = self.corners - np.repeat(self.corners[self.starts[:-1]], np.diff(self.starts), axis=0)
        (x, y), (next_x, next_y) = away.T, away[self.following].T
        return np.add.reduceat(x * next_y - next_x * y, self.starts[:-1]) / 2

    @property
    def are_flat(self) -> Flags:
        """(R,) bool, all corners lie on one line, or at one place: such a ring encloses nothing."""
        first = np.repeat(np.arange(len(self.starts) - 1), np.diff(self.starts))
        away = self.corners - self.corners[self.starts[:-1]][first]
        length = (away**2).sum(axis=1)
        farthest = np.array([at + int(length[at:end].argmax()) for at, end in pairwise(self.starts.tolist())])
        x, y = away[farthest][first].T
        return np.asarray(~np.logical_or.reduceat(x * away[:, 1] != y * away[:, 0], self.starts[:-1]))

    def moved(self, x: float, y: float) -> "Rings":
        """Return the rings ``x`` and ``y`` pixels further."""
        return replace(self, corners=self.corners + np.array([x, y]))

    def ring(self, index: int) -> Floats:
        """Return the corners (K, 2) of one ring."""
        return self.corners[self.starts[index] : self.starts[index + 1]]

    def rings_of(self, polygon: int) -> list[Floats]:
        """Return the rings of one polygon, each (K, 2)."""
        return [self.ring(int(index)) for index in np.flatnonzero(self.polygon == polygon)]


def join_rings(polygons: Sequence[Sequence[ArrayLike]]) -> Rings:
    """Return the rings of polygons, each a sequence of rings (K, 2) in pixels, as one record."""
    rings = [np.asarray(ring, float) for rings in polygons for ring in rings]
    polygon = np.repeat(np.arange(len(polygons)), [len(rings) for rings in polygons])
    starts = np.cumsum([0, *(len(ring) for ring in rings)])
    return Rings(np.concatenate([*rings, np.empty((0, 2))]), starts, polygon)


def checked_rings(name: str, starts: ArrayLike | None, corner_count: int) -> Integers:
    """Return the first corners (R,) of the rings of ``corner_count`` corners; ``None``: one ring.

    Raises
    ------
    ValueError
        Unless they rise from 0 and each ring has at least three corners.
    """
    firsts = checked(name, [0] if starts is None else starts, ("R",), np.int64)
    counts = np.diff([*firsts.tolist(), corner_count])
    if len(firsts) == 0 or firsts[0] != 0:
        raise ValueError(f"{name} must begin with corner 0, got {firsts.tolist()}")
    if (counts < RING_CORNERS).any():
        ring = int(np.argmax(counts < RING_CORNERS))
        raise ValueError(
            f"ring {ring} must have at least {RING_CORNERS} corners, got {max(int(counts[ring]), 0)}"
        )
    return firsts


# What a vertex shader hands on to the fragment shader.


@dataclass(frozen=True, eq=False)
class ShadedVertices:
    """The out variables of N vertices; the fragment shader's in variables are interpolated from them."""

    rows: Floats
    """(N, K) float64, the numbers of float32."""
    layout: dict[str, slice]
    """Which of the K numbers are which variable: ``out`` and its name."""
    flat: tuple[slice, ...]
    """Those that are not interpolated."""
