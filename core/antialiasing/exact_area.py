"""Exact areas: every pixel that a triangle touches is cut into the pieces that the edges make of it.

A square lies beyond an edge if its corner nearest to the inside does: at the centre the edge function is then below
-(|a| + |b|)/2. A square for which this says nothing may still lie beside a corner of the triangle; its area is then 0.

A piece is to a pixel what a sample is, but that it weighs as much as its area: in drawing order every triangle cuts
the pieces of the pixels it touches, by its edges and where it passes through what they show, is tested for depth and
blended in those inside of it, and the pixel's colour is the sum over its pieces. Depth and attributes are taken at the
centroid of a piece, where a linear function has its mean: the picture of unlit triangles in one colour per corner, and
one w, is the integral over the pixel's square, exact to rounding.

Where rays are cast, pieces are compared at their centroids in float64, whatever the format of depth.

Which pixels the fill tests, the fill rule, and on which side of an edge a centre lies play no part. A wireframe has no
area: it is drawn as without antialiasing. The buffers beside the colour are those of the pixels' centres.

References
----------
E. Catmull, *A hidden-surface algorithm with anti-aliasing*, 1978.
L. Carpenter, *The A-buffer, an antialiased hidden surface method*, 1984.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from core.antialiasing.pixel_pieces import (
    Pieces,
    area_of,
    centroid_of,
    join_pieces,
    split_pieces,
    whole_pixels,
)
from core.coverage.edges import EdgeFunctions, edge_value
from core.coverage.pixel_runs import BEHIND, MIXED, PROJECTED, Boxes, Raster, expand, rows_of
from core.depth.depth import PixelStacks, stack_fragments
from core.interpolation.interpolation import Interpolator, plane_value
from core.records.arrays import Flags, Floats, Integers, Singles
from core.records.frame import StageCount
from core.resolved import resolve
from core.scene import AnyScene
from core.stages.fragment_color import shade_fragments
from core.stages.fragments import depth_at, slopes_at
from core.stages.geometry import Geometry

# Which pixels' squares a triangle touches, wherever their centres lie: what exact areas are computed for.


BATCH = 1 << 20
"""Squares that are looked at in one go, about."""


@dataclass(frozen=True, eq=False)
class SquareFragments:
    """F pairs of a primitive and a pixel whose square it touches, in drawing order."""

    primitive: Integers
    """(F,) int64, index of the primitive."""
    column: Integers
    row: Integers
    is_whole: Flags
    """(F,) bool, the square lies inside as a whole."""
    edge_parts: tuple[Floats, Floats, Floats]
    """(F, 3) float64 each: change of the edge functions per column and per row, and their values at the centre."""


def bound_squares(edges: EdgeFunctions, raster: Raster) -> Boxes:
    """Return the pixels whose squares the bounding box of each triangle touches, by the cases of `bound`."""
    corners = edges.corners
    is_projected = corners.is_projected.all(axis=1)
    case = np.where(is_projected, PROJECTED, MIXED)
    case[(corners.homogeneous[..., 2] <= 0).all(axis=1)] = BEHIND
    bounds = raster.bounds
    box = np.empty((4, len(edges)), np.int64)
    # The square of pixel i reaches from i + center - 1/2 to i + center + 1/2.
    border = raster.center - 0.5
    for axis in range(2):
        along = corners.decided[..., axis]
        low, high = np.floor(along.min(axis=1) - border), np.ceil(along.max(axis=1) - border)
        box[axis] = np.maximum(np.where(is_projected, low, bounds[axis]), bounds[axis])
        box[axis + 2] = np.minimum(np.where(is_projected, high, bounds[axis + 2]), bounds[axis + 2])
    empty = (case == BEHIND) | (edges.doubled_area == 0) | (box[2] <= box[0]) | (box[3] <= box[1])
    box[2:, empty] = box[:2, empty]
    return Boxes(case, *box)


def touched_squares(edges: EdgeFunctions, raster: Raster) -> tuple[SquareFragments, int]:
    """Return the squares that P triangles touch, and how many were looked at."""
    boxes = bound_squares(edges, raster)
    runs = rows_of(boxes, np.arange(len(edges)))
    tested = int(runs.lengths.sum())
    ends = np.flatnonzero(np.diff(np.cumsum(runs.lengths) // BATCH, append=-1)) + 1
    parts = []
    for first, end in zip([0, *ends][:-1], ends, strict=True):
        part = runs.part(int(first), int(end))
        run, place = expand(part.lengths)
        parts.append(_examine(edges, raster, part.triangle[run], part.start[run] + place, part.row[run]))
    return _join(parts), tested


def _examine(
    edges: EdgeFunctions, raster: Raster, primitive: Integers, column: Integers, row: Integers
) -> SquareFragments:
    """Keep of squares (Q,) those that no edge has outside as a whole."""
    x, y = raster.centers(column, row)
    a, b, c = edges.shown_a[primitive], edges.shown_b[primitive], edges.shown_c[primitive]
    # Numbers that overflow a format of few bits touch nothing.
    with np.errstate(over="ignore", invalid="ignore"):
        value = edge_value(a, b, c, x[:, None], y[:, None])
        reach = (np.abs(a) + np.abs(b)) * 0.5
        touches = np.flatnonzero(np.all(value + reach > 0, axis=1))
        is_whole: Flags = np.all(value - reach >= 0, axis=1)
    return SquareFragments(
        primitive[touches],
        column[touches],
        row[touches],
        is_whole[touches],
        (a[touches], b[touches], value[touches]),
    )


def _join(parts: list[SquareFragments]) -> SquareFragments:
    none = np.empty(0, np.int64)
    parts = parts or [SquareFragments(none, none, none, none.astype(bool), (np.empty((0, 3)),) * 3)]
    return SquareFragments(
        np.concatenate([part.primitive for part in parts]),
        np.concatenate([part.column for part in parts]),
        np.concatenate([part.row for part in parts]),
        np.concatenate([part.is_whole for part in parts]),
        tuple(np.concatenate([part.edge_parts[k] for part in parts]) for k in range(3)),  # type: ignore[arg-type]
    )


# Exact areas: every pixel is cut into the pieces that its triangles' edges make of it.


PARALLEL = 2.0**-40
"""Depths that differ by less all over a pixel are those of one plane: rounding must neither cut it nor put another
triangle of the plane in front."""


@dataclass(frozen=True, eq=False)
class DrawnPieces:
    """P pieces of pixels and what they show."""

    pieces: Pieces
    """Their numbers are places of their pixels in the stacks: ``stacks.pixel[number]``."""
    primitive: Integers
    """(P,) int64, what is seen, -1: nothing."""
    color: Singles | None
    """(P, 4) float32; ``None``: opaque, and shaded when all is drawn."""

    def select(self, keep: Flags) -> "DrawnPieces":
        """Return the pieces where ``keep`` (P,) holds."""
        color = None if self.color is None else self.color[keep]
        return DrawnPieces(self.pieces.select(keep), self.primitive[keep], color)

    def take(self, pieces: Pieces) -> "DrawnPieces":
        """Return parts of the pieces with what the wholes show; the parts' numbers (P,) say which they are of."""
        of = pieces.number
        color = None if self.color is None else self.color[of]
        named = replace(pieces, number=self.pieces.number[of])
        return DrawnPieces(named, self.primitive[of], color)


def join_drawn(parts: list[DrawnPieces]) -> DrawnPieces:
    """Return all pieces of some lists, in their order."""
    colors = [part.color for part in parts if part.color is not None]
    return DrawnPieces(
        join_pieces([part.pieces for part in parts]),
        np.concatenate([part.primitive for part in parts]),
        np.concatenate(colors) if colors else None,
    )


class DrawnLayer(NamedTuple):
    """What one layer of the stacks has done."""

    fragment: Integers
    """(n,) int64, which of the squares' fragments was drawn in each of the first n pixels."""
    finished: DrawnPieces
    """Pieces of pixels that have no more fragments: those of the layers before."""
    there: DrawnPieces
    """Pieces of the n pixels, this layer drawn."""


class ColoredPieces(NamedTuple):
    """All pieces of the pixels that triangles touch, when everything is drawn."""

    pixel: Integers
    """(P,) int64, place of each piece's pixel in flattened buffers."""
    area: Floats
    """(P,) float64; those of a pixel add up to 1."""
    primitive: Integers
    """(P,) int64, what is seen, -1: the background."""
    color: Singles
    """(P, 4) float32."""
    touched: Integers
    """(U,) int64, the pixels."""


def draw_pieces(
    scene: AnyScene, geometry: Geometry, raster: Raster, counts: dict[str, StageCount]
) -> ColoredPieces:
    """Cut the pixels of a raster and draw into their pieces."""
    return piece_painter(scene, geometry, raster, counts).draw()


def piece_painter(
    scene: AnyScene, geometry: Geometry, raster: Raster, counts: dict[str, StageCount]
) -> "PiecePainter":
    """Return what draws into the pieces of a raster's pixels, before anything is cut."""
    with counts["raster"]:
        squares, tested = touched_squares(geometry.edges, raster)
        counts["raster"].incoming += tested
        counts["raster"].outgoing += len(squares.primitive)
        stacks = stack_fragments(raster.index(squares.column, squares.row))
    return PiecePainter(scene, geometry, raster, squares, stacks, counts)


def sum_areas(pieces: ColoredPieces, pixel_count: int) -> Singles:
    """Return the sums (H*W, 4) float32 of colours times areas; 0 where nothing is touched."""
    with np.errstate(invalid="ignore", over="ignore"):
        sums = [
            np.bincount(pieces.pixel, pieces.area * pieces.color[:, channel], pixel_count)
            for channel in range(4)
        ]
        return np.stack(sums, axis=1).astype(np.float32)


def piece_sum(areas: Sequence[float], values: Sequence[float]) -> float:
    """Return one channel of a pixel (listing of `sum_areas`)."""
    result = 0.0
    for area, value in zip(areas, values, strict=True):  #: samples
        result += area * value
    return float(np.float32(result))  #: store


class PiecePainter:
    """Draws triangles into the pieces of pixels, one layer of the stacks after another."""

    def __init__(
        self,
        scene: AnyScene,
        geometry: Geometry,
        raster: Raster,
        squares: SquareFragments,
        stacks: PixelStacks,
        counts: dict[str, StageCount],
    ) -> None:
        self._scene, self._geometry, self._resolved = scene, geometry, resolve(geometry.settings)
        self.squares, self.stacks, self._counts = squares, stacks, counts
        self._format = self._resolved.depth_format
        self._interpolator = Interpolator(
            geometry.planes, geometry.primitives.values, *self._resolved.interpolation
        )
        self._center_x, self._center_y = raster.centers(*raster.position(stacks.pixel))

    def draw(self, watch: Callable[[DrawnLayer], None] | None = None) -> ColoredPieces:
        """Draw everything, every layer shown to ``watch``; return the pieces of all pixels that something touches."""
        finished, there = [], self._untouched()
        for layer in self.layers():
            finished.append(layer.finished)
            there = layer.there
            if watch is not None:
                watch(layer)
        return self.colored(join_drawn([*finished, there]))

    def colored(self, drawn: DrawnPieces) -> ColoredPieces:
        """Return all pieces with their colours when everything is drawn."""
        pixel = self.stacks.pixel.take(drawn.pieces.number)
        colors = self.final_colors(drawn)
        return ColoredPieces(pixel, area_of(drawn.pieces), drawn.primitive, colors, self.stacks.pixel)

    def _untouched(self) -> DrawnPieces:
        """Return the squares of all pixels that something touches, the background in them."""
        count = len(self.stacks.pixel)
        color = None
        if self._resolved.is_mixed:
            color = np.empty((count, 4), np.float32)
            color[:] = self._scene.background
        return DrawnPieces(whole_pixels(np.arange(count)), np.full(count, -1), color)

    def layers(self) -> Iterator[DrawnLayer]:
        """Draw layer by layer: the first triangle of every pixel, the second, and so on."""
        there = self._untouched()
        for reached, fragment in self.stacks.layers():
            is_active = there.pieces.number < reached
            finished, there = there.select(~is_active), there.select(is_active)
            there = self._draw_layer(there, fragment.take(there.pieces.number))
            yield DrawnLayer(fragment, finished, there)

    def _draw_layer(self, there: DrawnPieces, fragment: Integers) -> DrawnPieces:
        """Draw one triangle into every piece; ``fragment`` (P,) says which."""
        with self._counts["raster"]:
            every = np.arange(len(there.pieces))
            is_whole = self.squares.is_whole.take(fragment)
            numbered = replace(there.pieces, number=every)
            inside, outside = numbered.select(~is_whole), []
            for k in range(3):
                of = fragment.take(inside.number)
                a, b, value = (values[of, k] for values in self.squares.edge_parts)
                inside, beyond = split_pieces(inside, a, b, value)
                outside.append(there.take(beyond))
            inside = join_pieces([numbered.select(is_whole), inside])
            inside = self._cut_by_depth(inside, there, fragment)
            primitive = self.squares.primitive.take(fragment.take(inside.number))
        drawn = self._paint(there.take(inside), primitive)
        return join_drawn([drawn, *outside])

    def _cut_by_depth(self, inside: Pieces, there: DrawnPieces, fragment: Integers) -> Pieces:
        """Cut pieces where their triangle passes through what they show, and where it leaves the depth range.

        ``inside`` are parts of ``there`` (P,), numbered by it, of the triangles of ``fragment`` (P,).
        """
        depth = self._geometry.depth_plane
        reaches_out = ~self._geometry.is_in_range.take(self.squares.primitive)
        if reaches_out.any():
            for side, limit in ((1.0, 0.0), (-1.0, 1.0)):
                of = fragment.take(inside.number)
                a, b, value = self._plane_at(depth, self.squares.primitive.take(of), there, inside)
                is_cut = reaches_out.take(of)
                parts = (a * side * is_cut, b * side * is_cut, np.where(is_cut, (value - limit) * side, 1.0))
                inside = join_pieces(list(split_pieces(inside, *parts)))
        if not self._geometry.drawing.uses_depth_test:
            return inside
        primitive = self.squares.primitive.take(fragment.take(inside.number))
        shown = there.primitive.take(inside.number)
        new, old = (self._plane_at(depth, of, there, inside) for of in (primitive, np.maximum(shown, 0)))
        a, b, value = (first - second for first, second in zip(new, old, strict=True))
        reach = (np.abs(a) + np.abs(b)) * 0.5
        crosses = (shown >= 0) & (np.abs(value) < reach) & (reach > PARALLEL)
        parts = (np.where(crosses, a, 0.0), np.where(crosses, b, 0.0), np.where(crosses, value, 1.0))
        return join_pieces(list(split_pieces(inside, *parts)))

    def _plane_at(
        self, plane: tuple[Floats, Floats, Floats], primitive: Integers, there: DrawnPieces, pieces: Pieces
    ) -> tuple[Floats, Floats, Floats]:
        """Return a plane's change per column and row, and its value at the centre, for pieces (P,)."""
        pixel = there.pieces.number.take(pieces.number)
        x, y = self._center_x.take(pixel), self._center_y.take(pixel)
        return plane[0].take(primitive), plane[1].take(primitive), plane_value(plane, primitive, x, y)

    def _paint(self, there: DrawnPieces, primitive: Integers) -> DrawnPieces:
        """Test depth in pieces that lie inside of ``primitive`` (P,), and write what passes."""
        with self._counts["depth"]:
            x, y = self.centroids(there)
            _, keeps, stored = depth_at(self._geometry, primitive, x, y, self._format)
            passes = keeps
            drawing = self._geometry.drawing
            if drawing.decides is not None and not drawing.resolves_lists:
                passes = keeps & ((there.primitive < 0) | self._is_nearer(primitive, there.primitive, x, y))
            elif drawing.uses_depth_test:
                # The depth that is there, at this piece's own centroid.
                _, _, old = depth_at(self._geometry, np.maximum(there.primitive, 0), x, y, self._format)
                old = np.where(there.primitive >= 0, old, old.dtype.type(self._format.cleared))
                passes = keeps & self._format.is_nearer(stored, old)
            self._counts["depth"].incoming += len(passes)
            self._counts["depth"].outgoing += int(np.count_nonzero(passes))
            color = there.color
        if color is not None:
            source = self.colors(primitive[passes], x[passes], y[passes])
            with self._counts["blend"]:
                color = color.copy()
                color[passes] = self._resolved.blend_method.function(source, color[passes])
        return DrawnPieces(there.pieces, np.where(passes, primitive, there.primitive), color)

    def _is_nearer(self, new: Integers, old: Integers, x: Floats, y: Floats) -> Flags:
        """Compare primitives (P,) at window positions without rounding to a depth format: the rays of ray casting.

        Triangles of one plane differ by rounding there, and the first of them stays.
        """
        geometry = self._geometry
        by_w = geometry.vertices.view_range is not None
        plane, sign = (geometry.inverse_w_plane, 1.0) if by_w else (geometry.depth_plane, -1.0)
        value, there = (sign * plane_value(plane, of, x, y) for of in (new, np.maximum(old, 0)))
        return value - there > PARALLEL * np.abs(there)

    def centroids(self, drawn: DrawnPieces) -> tuple[Floats, Floats]:
        """Return where in the window the centroids of pieces lie, x and y (P,)."""
        x, y = centroid_of(drawn.pieces)
        number = drawn.pieces.number
        return self._center_x.take(number) + x, self._center_y.take(number) + y

    def colors(self, primitive: Integers, x: Floats, y: Floats) -> Floats:
        """Return the colours (F, 4) of primitives (F,) at window positions (F,)."""
        count = self._counts["interpolate"]
        with count:
            values = self._interpolator.values(primitive, x, y)
            count.incoming += len(primitive)
            count.outgoing += len(primitive)
        count, primitives = self._counts["shade"], self._geometry.primitives
        with count:
            mesh = primitives.mesh.take(primitive)
            slopes = slopes_at(self._geometry, primitive, x, y, values)
            surface = shade_fragments(
                self._scene, self._geometry.settings, primitives.layout, mesh, values, slopes
            )
            count.incoming += len(primitive)
            count.outgoing += len(primitive)
        return surface.color

    def final_colors(self, drawn: DrawnPieces) -> Singles:
        """Return the colours (P, 4) float32 of all pieces when everything is drawn."""
        if drawn.color is not None:
            return drawn.color
        color = np.empty((len(drawn.primitive), 4), np.float32)
        color[:] = self._scene.background
        seen = np.flatnonzero(drawn.primitive >= 0)
        x, y = self.centroids(drawn)
        with np.errstate(over="ignore", invalid="ignore"):
            color[seen] = self.colors(drawn.primitive.take(seen), x.take(seen), y.take(seen))
        return color
