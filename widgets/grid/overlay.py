"""Overlays of a pixel grid: frozen records that stack over the cells, each with a name for the legend.

Nothing depends on colour alone: every mark has a fill, hatch, ring, glyph or outline of its own.
"""

from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from core.records.alike import is_alike


class Mark(Enum):
    """What a masked pixel means, and so how it is drawn."""

    COVERED = "covered"
    """A translucent fill."""
    EDGE_0 = "edge 0"
    """Horizontal hatch in blue."""
    EDGE_1 = "edge 1"
    """Vertical hatch in orange."""
    EDGE_2 = "edge 2"
    """Rising hatch in green."""
    TIE = "tie"
    """A ring."""
    REJECTED = "rejected"
    """Falling hatch."""
    DEPTH_PASSED = "depth passed"
    """A filled arrowhead that points up: nearer."""
    DEPTH_FAILED = "depth failed"
    """A cross."""
    NAN = "NaN"
    """A fine checker."""
    DIFFERENCE = "difference"
    """A filled corner."""
    RIGHT = "right"
    """A tick."""
    MISSING = "missing"
    """A hollow square."""
    EXTRA = "extra"
    """A large cross."""
    DOUBLE = "double"
    """Two bars."""


EDGE_MARKS = (Mark.EDGE_0, Mark.EDGE_1, Mark.EDGE_2)
"""The marks of edges 0, 1, 2."""


class BlockState(Enum):
    """What was found out about a block of pixels."""

    REJECTED = "rejected"
    """Solid outline, falling hatch."""
    ACCEPTED = "accepted"
    """Solid outline, translucent fill."""
    SPLIT = "split"
    """Dashed outline."""
    LEAF = "leaf"
    """Dotted outline: tested pixel by pixel."""


@dataclass(frozen=True, eq=False)
class NamedOverlay:
    """What every kind of overlay has."""

    key: str
    """Identifies the overlay in the legend and from one step to the next."""
    title: str = field(default="", kw_only=True)
    """Name in the legend."""

    @property
    def label(self) -> str:
        """Name in the legend."""
        return self.title


@dataclass(frozen=True, eq=False)
class MaskOverlay(NamedOverlay):
    """A mark on every pixel of a mask; without a title its name is that of the mark."""

    mark: Mark
    mask: NDArray[np.bool_] = field(repr=False)
    """(H, W) bool, row 0 at the bottom."""

    def __post_init__(self) -> None:
        if self.mask.ndim != 2:
            raise ValueError(f"mask must be (H, W), got {self.mask.shape}")
        if self.mask.dtype != np.bool_:
            raise ValueError(f"mask must be bool, got {self.mask.dtype}")

    @property
    def label(self) -> str:
        """Name in the legend."""
        return self.title or self.mark.value


@dataclass(frozen=True, eq=False)
class CountOverlay(NamedOverlay):
    """How often each pixel was drawn: a tint that grows with the count, and numbers in large cells."""

    counts: NDArray[np.integer] = field(repr=False)
    """(H, W) integers, row 0 at the bottom."""
    title: str = field(default="overdraw", kw_only=True)

    def __post_init__(self) -> None:
        if self.counts.ndim != 2:
            raise ValueError(f"counts must be (H, W), got {self.counts.shape}")
        if self.counts.dtype.kind not in "ui":
            raise ValueError(f"counts must be integers, got {self.counts.dtype}")


@dataclass(frozen=True, eq=False)
class BlockOverlay(NamedOverlay):
    """Outlined rectangles of pixels: bins, blocks of a hierarchy, bounding boxes."""

    blocks: NDArray[np.integer] = field(repr=False)
    """(N, 4) integers: column, row of the lower left pixel, columns, rows."""
    states: tuple[BlockState, ...] = field(repr=False)
    """What was found out about each."""
    labels: tuple[str, ...] = field(default=(), repr=False)
    """A short text in the upper left corner of each; empty: none."""
    edges: tuple[int, ...] = field(default=(), repr=False)
    """The edge 0, 1, 2 that rejected each, which gives it its colour, or -1; empty: none."""
    title: str = field(default="blocks", kw_only=True)

    def __post_init__(self) -> None:
        if self.blocks.ndim != 2 or self.blocks.shape[1] != 4:
            raise ValueError(f"blocks must be (N, 4), got {self.blocks.shape}")
        for name, given in (("states", self.states), ("labels", self.labels), ("edges", self.edges)):
            if len(given) != len(self.blocks) and (given or name == "states"):
                raise ValueError(
                    f"{name} must have one entry per block ({len(self.blocks)}), got {len(given)}"
                )


@dataclass(frozen=True, eq=False)
class SpanOverlay(NamedOverlay):
    """Horizontal runs of pixels, drawn as a bar with two ends through the middle of the row."""

    spans: NDArray[np.integer] = field(repr=False)
    """(N, 3) integers: row, first column, end column (excluded)."""
    title: str = field(default="spans", kw_only=True)

    def __post_init__(self) -> None:
        if self.spans.ndim != 2 or self.spans.shape[1] != 3:
            raise ValueError(f"spans must be (N, 3), got {self.spans.shape}")


@dataclass(frozen=True, eq=False)
class SegmentOverlay(NamedOverlay):
    """Exact thin lines in window coordinates."""

    segments: NDArray[np.float64] = field(repr=False)
    """(N, 2, 2) float64: both ends (x, y) in window coordinates; may be far away, infinite or NaN."""
    edges: tuple[int, ...] = ()
    """The edge 0, 1, 2 that gives each its colour, or -1 for a neutral line; empty: neutral."""
    extended: bool = False
    """Whether the whole line through both ends is drawn, dashed."""
    title: str = field(default="lines", kw_only=True)
    is_polygon: bool = False
    """Whether they are the sides of one polygon in order, whose inside is tinted."""
    tag: str = ""
    """Written where they begin, at their upper left."""

    def __post_init__(self) -> None:
        if self.segments.ndim != 3 or self.segments.shape[1:] != (2, 2):
            raise ValueError(f"segments must be (N, 2, 2), got {self.segments.shape}")
        if self.edges and len(self.edges) != len(self.segments):
            raise ValueError(
                f"edges must have one entry per segment ({len(self.segments)}), got {len(self.edges)}"
            )


@dataclass(frozen=True, eq=False)
class CenterOverlay(NamedOverlay):
    """Rulers that have the coordinates of the pixels' centres, as 0.5, in place of the numbers of columns and rows."""

    title: str = field(default="centres on the axes", kw_only=True)


Overlay = MaskOverlay | CountOverlay | BlockOverlay | SpanOverlay | SegmentOverlay | CenterOverlay
"""Anything that a grid can lay over its cells."""


def changed_cells(
    before: tuple[Overlay, ...], after: tuple[Overlay, ...]
) -> tuple[int, int, int, int] | None:
    """Return the cells that look different with ``after`` instead of ``before``.

    Returns
    -------
    tuple of int or None
        column0, row0, column1, row1 (upper ends excluded; all 0 if nothing changed); None: anything may
        have changed.
    """
    if len(before) != len(after):
        return None
    changed = (0, 0, 0, 0)
    for old, new in zip(before, after, strict=True):
        if old is new:
            continue
        if (
            isinstance(old, MaskOverlay)
            and isinstance(new, MaskOverlay)
            and (old.key, old.mark, old.mask.shape) == (new.key, new.mark, new.mask.shape)
        ):
            changed = union(changed, bounds(old.mask != new.mask))
        elif not is_alike(old, new):
            return None
    return changed


def bounds(mask: NDArray[np.bool_]) -> tuple[int, int, int, int]:
    """Return column0, row0, column1, row1 of what is true in an (H, W) mask; all 0 if nothing is."""
    rows = np.flatnonzero(mask.any(axis=1))
    if rows.size == 0:
        return 0, 0, 0, 0
    columns = np.flatnonzero(mask.any(axis=0))
    return int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1


def union(first: tuple[int, int, int, int], second: tuple[int, int, int, int]) -> tuple[int, int, int, int]:
    """Return the smallest block of cells that holds both; an empty one adds nothing."""
    if first[0] >= first[2] or first[1] >= first[3]:
        return second
    if second[0] >= second[2] or second[1] >= second[3]:
        return first
    return (
        min(first[0], second[0]),
        min(first[1], second[1]),
        max(first[2], second[2]),
        max(first[3], second[3]),
    )
