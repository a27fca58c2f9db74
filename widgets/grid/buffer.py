"""What a pixel grid shows: a named array with its kind, unit and range, and its values as text."""

from dataclasses import dataclass, field
from math import copysign, floor, inf, isfinite, isnan, log10
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from core.explain.number_text import full_text, is_short

BufferKind = Literal["scalar", "signed", "color", "weights", "ids", "bool"]
"""How values become colours: see :class:`GridBuffer`."""

KINDS: tuple[BufferKind, ...] = ("scalar", "signed", "color", "weights", "ids", "bool")
MINUS = "\u2212"
NAN = "NaN"
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
    signed: a diverging map with white at zero. color: linear floats, or uint8 that are sRGB already (C = 1,
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
        """Name in :mod:`widgets.basics.colormaps` of the map of its values, one channel each."""
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
