"""Which pixels a fill looks at, and in what order: runs of pixels in rows, blocks, and what is known without a run.

A fill is a schedule; whether a pixel is covered is the same rule for all of them (``edge_functions``). The picture
evaluates the runs in batches, the trace lists them one pixel at a time.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.coverage.edges import PixelRule, covers
from core.methods import method, table
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import TypedText

# What is known of a fill without running it.


@dataclass(frozen=True)
class FillTraits:
    """How a fill differs from looking at the pixels of a triangle's box."""

    looks_everywhere: bool = False
    """Whether it tests every pixel of the raster for every triangle."""
    has_lanes: bool = False
    """Whether it sets all rows of a triangle up in one lane, and draws rows of the same length of all triangles."""
    group_label: str = "Row"
    """What a step between a pixel and a triangle is, on a button."""
    rule: PixelRule | None = None
    """What decides on a pixel, where it is not the inside test."""
    test_listing: Callable[..., Any] | TypedText = covers
    """The decision on one pixel."""


def fill_traits(fill: str) -> FillTraits:
    """Return what is known of a method of the family ``fill``."""
    traits: FillTraits | None = table.get("fill", fill).traits
    return traits or FillTraits()


# Which pixels a fill looks at, and in what order: runs of pixels in rows, and the blocks they came from.


@dataclass(frozen=True)
class Raster:
    """The pixels that are drawn: the whole image, or a region of it."""

    width: int
    height: int
    center: float = 0.5
    """Offset of a pixel's centre from its column and row number."""
    region: tuple[int, int, int, int] | None = None
    """(first column, first row, columns, rows); ``None``: the whole image."""

    bounds: tuple[int, int, int, int] = field(init=False, repr=False, compare=False)
    """First column, first row, end column, end row (ends excluded), within the image."""
    shape: tuple[int, int] = field(init=False, repr=False, compare=False)
    """Rows and columns of the buffers."""
    place_of_origin: int = field(init=False, repr=False, compare=False)
    """Where column 0, row 0 of the image would stand in flattened buffers: 0, or before a region."""

    def __post_init__(self) -> None:
        first_column, first_row, columns, rows = self.region or (0, 0, self.width, self.height)
        end_column = min(max(first_column + columns, 0), self.width)
        end_row = min(max(first_row + rows, 0), self.height)
        first_column, first_row = min(max(first_column, 0), self.width), min(max(first_row, 0), self.height)
        columns, rows = end_column - first_column, end_row - first_row
        known = {
            "bounds": (first_column, first_row, end_column, end_row),
            "shape": (rows, columns),
            "place_of_origin": -(first_row * columns + first_column),
        }
        vars(self).update(known)

    def centers(self, column: Integers, row: Integers) -> tuple[Floats, Floats]:
        """Return x and y (F,) of the centres of pixels."""
        return column + np.float64(self.center), row + np.float64(self.center)

    def along(self, index: Integers) -> Floats:
        """Return x of columns, or y of rows (F,): where their pixels' centres lie along that axis."""
        return index + np.float64(self.center)

    def index(self, column: Integers, row: Integers) -> Integers:
        """Return the place of pixels (F,) in flattened buffers."""
        return row * self.shape[1] + (column + self.place_of_origin)

    def position(self, index: Integers) -> tuple[Integers, Integers]:
        """Return column and row (F,) of places in flattened buffers."""
        first_column, first_row, end_column, _ = self.bounds
        columns = end_column - first_column
        row = index // columns
        # Faster than the rest of a division.
        column = row * -columns
        column += index
        if first_column or first_row:
            column += first_column
            row += first_row
        return column, row


@method(
    "pixel_center",
    "half",
    "At (i + 1/2, j + 1/2)",
    source="Zwicker 2016, Where is the center of a pixel?",
    exact_for="OpenGL's convention",
)
def half() -> float:
    """Return the offset of a pixel's centre."""
    return 0.5


@method(
    "pixel_center",
    "integer",
    "At (i, j)",
    source="Pellacini, rasterization: pixel centered at integer coordinates",
    exact_for="its own convention",
    breaks_where="pictures compared with OpenGL: everything moves by half a pixel",
)
def integer() -> float:
    """Return the offset of a pixel's centre."""
    return 0.0


def make_raster(
    size: tuple[int, int], pixel_center: str, region: tuple[int, int, int, int] | None = None
) -> Raster:
    """Return the raster of a picture of ``size`` (width, height)."""
    return Raster(size[0], size[1], table.get("pixel_center", pixel_center).function(), region)


class Boxes(NamedTuple):
    """Pixels that P triangles may touch, by the lecture's three cases. All (P,) int64."""

    case: Integers
    """``PROJECTED``, ``BEHIND`` or ``MIXED``."""
    column: Integers
    row: Integers
    column_end: Integers
    row_end: Integers


PROJECTED, BEHIND, MIXED = 0, 1, 2
OUTSIDE, INSIDE, SPLIT, LEAF = 0, 1, 2, 3


@dataclass(frozen=True, eq=False)
class Blocks:
    """Nodes of the block test in pre-order, triangle by triangle."""

    triangle: Integers
    """(N,) int64, index of the primitive."""
    column: Integers
    row: Integers
    size: Integers
    """(N,) int64, pixels on a side (a node reaches over the raster's border; its pixels there do not exist)."""
    parent: Integers
    """(N,) int64, node index, -1 for a node of the top level."""
    subtree_end: Integers
    """(N,) int64, the node after the last one inside this node."""
    low: Floats
    """(N, 3) float64, least value of each edge function at the node's pixels."""
    high: Floats
    """(N, 3) float64, greatest value."""
    verdict: Integers
    """(N,) int64, ``OUTSIDE``, ``INSIDE``, ``SPLIT`` or ``LEAF`` (its pixels are tested)."""
    rejected_by: Integers
    """(N,) int64, the first edge whose greatest value is outside, else -1."""


EVALUATED, ADDED_B, ADDED_A = 0, 1, 2


@dataclass(frozen=True, eq=False)
class Stepping:
    """Values of edge functions at the first pixels of R runs, by additions; see ``incremental``."""

    value: NDArray[Any]
    """(R, 3) in the edges' numbers."""
    before: NDArray[Any]
    """(R, 3), what the last addition started from."""
    added: Integers
    """(R,) int64, what was added to it: ``ADDED_A`` (from the left), ``ADDED_B`` (from below), or ``EVALUATED``."""

    def take(self, at: Integers | slice) -> "Stepping":
        """Return the values of the runs ``at`` (Q,)."""
        return Stepping(self.value[at], self.before[at], self.added[at])


@dataclass(frozen=True, eq=False)
class SideWalk:
    """R rows of pixels of triangles, in the order in which the printed program draws them."""

    triangle: Integers
    """(R,) int64, index among the triangles."""
    row: Integers
    """(R,) int64."""
    sides: Floats
    """(2, R) float64, x of both sides of the triangle in the row, at pixel centres."""
    before: Floats
    """(2, R) float64, the same in the row before, to which the slopes are added; NaN in a first row."""
    slope: Floats
    """(2, R) float64, how far each side goes to the right from one row to the next one above."""
    width: Floats
    """(2, R) float64, of each side, from its lower to its upper end."""
    height: Floats
    """(2, R) float64."""
    is_upper: Flags
    """(R,) bool, the part above a level side, which is walked downwards; the other one is walked upwards."""
    is_first: Flags
    """(R,) bool, the first row of its part in the picture."""
    corner: Floats
    """(2, R) float64, x and y of the corner at which the part begins."""

    def __len__(self) -> int:
        return len(self.row)

    def take(self, at: Integers | slice) -> "SideWalk":
        """Return chosen rows (C,)."""
        return replace(self, **{field.name: getattr(self, field.name)[..., at] for field in fields(self)})


@dataclass(frozen=True, eq=False)
class Runs:
    """R stretches of pixels, each in one row of one triangle, in drawing order."""

    triangle: Integers
    """(R,) int64, index of the primitive."""
    row: Integers
    """(R,) int64."""
    start: Integers
    """(R,) int64, first column."""
    stop: Integers
    """(R,) int64, column after the last."""
    accepted: Flags
    """(R,) bool, covered without a test of every pixel."""
    group: Integers
    """(R,) int64, not decreasing: runs of one group are one block or one row of a triangle."""
    blocks: Blocks | None = None
    crossings: Floats | None = None
    """(R, 3) float64, x where the row crosses each edge; ``None``: the fill has no spans.

    NaN in lanes of the fill ``spans``, which has them as fractions."""
    stepping: Stepping | None = None
    """Where the fill adds from pixel to pixel; ``None``: edge functions are evaluated at every pixel."""
    walk: SideWalk | None = None
    """Where the fill adds slopes from row to row."""

    def __len__(self) -> int:
        return len(self.triangle)

    @property
    def lengths(self) -> Integers:
        """(R,) int64, pixels in every run."""
        return self.stop - self.start

    def part(self, first: int, end: int) -> "Runs":
        """Return runs ``first`` to ``end``, without their blocks."""
        return self.take(slice(first, end))

    def take(self, at: Integers | slice) -> "Runs":
        """Return the runs ``at`` (Q,), without their blocks."""
        return Runs(
            self.triangle[at],
            self.row[at],
            self.start[at],
            self.stop[at],
            self.accepted[at],
            self.group[at],
            crossings=None if self.crossings is None else self.crossings[at],
            stepping=None if self.stepping is None else self.stepping.take(at),
            walk=None if self.walk is None else self.walk.take(at),
        )


def expand(count: Integers) -> tuple[Integers, Integers]:
    """Return for ``count[k]`` copies of each k: which k (Q,), and its place among the copies (Q,)."""
    which = np.repeat(np.arange(len(count)), count)
    place = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
    return which, place


def rows_of(boxes: Boxes, chosen: Integers) -> Runs:
    """Return one run a row of the boxes of the ``chosen`` (C,) triangles."""
    height = np.maximum(boxes.row_end - boxes.row, 0)[chosen]
    height[(boxes.column_end <= boxes.column)[chosen]] = 0
    which, place = expand(height)
    triangle = chosen[which]
    return Runs(
        triangle=triangle,
        row=boxes.row[triangle] + place,
        start=boxes.column[triangle],
        stop=boxes.column_end[triangle],
        accepted=np.zeros(len(triangle), bool),
        group=np.arange(len(triangle)),
    )
