"""What a pixel grid shows, as frozen records: a buffer with its kind, unit and range, and overlays over its cells.

Nothing depends on colour alone: every mark has a fill, hatch, ring, glyph or outline of its own.
"""

from dataclasses import dataclass, field
from enum import Enum
from math import copysign, floor, inf, isfinite, isnan, log10
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from core.explain.number_text import full_text, is_remainder, is_short
from core.records.arrays import is_alike

# What a pixel grid shows: a named array with its kind, unit and range, and its values as text.


BufferKind = Literal["scalar", "signed", "color", "weights", "ids", "bool"]
"""How values become colours: see :class:`GridBuffer`."""

KINDS: tuple[BufferKind, ...] = ("scalar", "signed", "color", "weights", "ids", "bool")
MINUS = "\u2212"
NAN = "NaN"
ABOUT_ZERO = "≈0"
NO_VALUE = "\u2013"
"""What stands for the value of a pixel that has none."""


@dataclass(frozen=True, eq=False)
class GridBuffer:
    """A buffer of the frame as a pixel grid shows it."""

    name: str
    """Key of the buffer, unique among the grids that stand side by side."""
    values: NDArray[np.generic] = field(repr=False)
    """(H, W) or (H, W, C) array of bool, integers or floats; row 0 is the bottom row."""
    kind: BufferKind = "scalar"
    """scalar: a colormap over the range (C > 1: the first three channels as red, green, blue over the range).
    signed: a diverging map, at zero as the page. color: linear floats, or uint8 that are sRGB already (C = 1,
    3, 4). weights: (H, W, 3), a mix of the colours of vertices 0, 1, 2. ids: distinct colours, negative is
    none. bool: empty or covered."""
    unit: str = ""
    range: tuple[float, float] | None = None
    """Values at the two ends of the colormap; None: those of the finite values."""
    title: str = ""
    """What the user reads; empty: the name."""
    description: str = ""
    """One sentence for the tooltip."""
    origin: tuple[int, int] = (0, 0)
    """Column and row in the picture of the lower left pixel: the rulers count from there."""
    known: NDArray[np.bool_] | None = field(default=None, repr=False)
    """(H, W) bool, where there is a value yet; other cells are empty. None: everywhere."""
    has_centres: bool = True
    """Whether the values belong to the centres of the cells, which are marked; not where a cell stands for several."""
    is_weight: bool = False
    """Whether it adds up to 1 with others: in its cells, what only rounding keeps from 0 is said to be about 0."""

    def __post_init__(self) -> None:
        shape = self.values.shape
        if len(shape) not in (2, 3) or shape[0] == 0 or shape[1] == 0 or (len(shape) == 3 and shape[2] == 0):
            raise ValueError(f"values must be (H, W) or (H, W, C) with at least one pixel, got {shape}")
        if self.values.dtype.kind not in "buif":
            raise ValueError(f"values must be bool, integers or floats, got {self.values.dtype}")
        if self.kind not in KINDS:
            raise ValueError(f"kind must be one of {', '.join(KINDS)}, got {self.kind!r}")
        wanted = {"color": (1, 3, 4), "weights": (3,), "ids": (1,), "bool": (1,), "signed": (1,)}.get(
            self.kind
        )
        if wanted and self.channels not in wanted:
            counts = " or ".join(str(count) for count in wanted)
            raise ValueError(f"{self.kind} values must have {counts} channels, got {self.channels}")
        if self.known is not None and self.known.shape != shape[:2]:
            raise ValueError(f"known must be {shape[:2]}, got {self.known.shape}")
        if self.kind == "ids" and self.values.dtype.kind not in "ui":
            raise ValueError(f"ids must be integers, got {self.values.dtype}")

    @property
    def rows(self) -> int:
        """H."""
        return int(self.values.shape[0])

    @property
    def columns(self) -> int:
        """W."""
        return int(self.values.shape[1])

    @property
    def channels(self) -> int:
        """C; 1 for an (H, W) array."""
        return int(self.values.shape[2]) if self.values.ndim == 3 else 1

    @property
    def label(self) -> str:
        """The title, or else the name."""
        return self.title or self.name

    def is_known(self, column: int, row: int) -> bool:
        """Return whether the pixel has a value yet."""
        return self.known is None or bool(self.known[row, column])

    def is_cleared(self, column: int, row: int) -> bool:
        """Return whether a pixel of a picture has no colour: its alpha is 0."""
        return self.kind == "color" and self.channels == 4 and bool(self.values[row, column, 3] == 0)

    def lines_at(self, column: int, row: int, digits: int = 4, width: int | None = None) -> list[str]:
        """Return the value of a pixel as text, one line per channel; see :func:`number_text`."""
        if not self.is_known(column, row):
            return []
        value = self.values[row, column].tolist()
        items = value if isinstance(value, list) else [value]
        if self.kind == "ids" and items[0] < 0:
            return [MINUS]
        if self.is_weight and width is not None and is_remainder(items[0]):
            return [ABOUT_ZERO]
        return [number_text(item, digits, width) for item in items]

    def text_at(self, column: int, row: int, digits: int = 4) -> str:
        """Return the value of a pixel on one line, with its unit; ``digits`` 0 gives full precision."""
        lines = self.lines_at(column, row, digits)
        if not lines:
            return NO_VALUE
        text = lines[0] if len(lines) == 1 else "(" + ", ".join(lines) + ")"
        return f"{text} {self.unit}" if self.unit else text

    @property
    def colormap(self) -> str:
        """Name in :mod:`widgets.basics.image` of the map of its values, one channel each."""
        return "grey" if self.channels > 1 else "diverging" if self.kind == "signed" else "viridis"


def number_text(value: bool | int | float, digits: int = 4, width: int | None = None) -> str:
    """Return a number as people read it: in full where that is short, else four significant digits, a true minus.

    Parameters
    ----------
    value : bool, int or float
    digits : int
        Significant digits of a float; 0 for the shortest text that reads back as the same float64.
    width : int, optional
        Most characters; digits are dropped, down to one, until it fits (whole digits before the point are
        kept).

    Returns
    -------
    str
        For example ``0.3333``, ``-1.25e-7`` with U+2212 as minus, ``NaN``, ``∞``.
    """
    if isinstance(value, bool):
        return "1" if value else "0"
    if isinstance(value, int):
        return str(value).replace("-", MINUS)
    if isnan(value):
        return NAN
    if not isfinite(value):
        return "∞" if value == inf else MINUS + "∞"
    if digits == 0:
        return _tidy(repr(value))
    if value and is_short(value):
        text = full_text(value)
        if width is None or len(text) <= width:
            return text
    text = _significant(value, digits)
    while width is not None and len(text) > width and digits > 1:
        digits -= 1
        text = _significant(value, digits)
    return text


def _significant(value: float, digits: int) -> str:
    """Return ``value`` with ``digits`` significant digits, plain from 1e-4 up to 10^max(digits, 5)."""
    if value == 0.0:
        return MINUS + "0" if copysign(1.0, value) < 0 else "0"
    exponent = floor(log10(abs(value)))
    if -4 <= exponent < max(digits, 5):
        text = f"{value:.{max(digits - 1 - exponent, 0)}f}"
    else:
        text = f"{value:.{digits - 1}e}"
    if "." in text and "e" not in text:
        text = text.rstrip("0").rstrip(".")
    return _tidy(text)


def _tidy(text: str) -> str:
    """Drop the zeros of an exponent and its plus, and write a true minus."""
    mantissa, mark, exponent = text.partition("e")
    if mark:
        if "." in mantissa:
            mantissa = mantissa.rstrip("0").rstrip(".")
        text = f"{mantissa}e{int(exponent)}"
    elif text.endswith(".0"):
        text = text[:-2]
    return text.replace("-", MINUS)


# Overlays of a pixel grid: frozen records that stack over the cells, each with a name for the legend.


class CellMark(Enum):
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


EDGE_MARKS = (CellMark.EDGE_0, CellMark.EDGE_1, CellMark.EDGE_2)
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

    mark: CellMark
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
    width: float = 1.5
    """Of the lines, in logical pixels: wider ones are seen over others in the same place."""

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
