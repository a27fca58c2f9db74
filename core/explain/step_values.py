"""The numbers of one step by name and type, and one row for every kind of step that reads them.

A row is one function under `explains`, in the ``told`` file of its topic. Its key is
``stage.kind.operation``; ``a|b`` stands for both, ``*`` as the kind for every kind of the stage that has no row of its
own. So a new method that uses the operations of others needs no row at all.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product
from typing import TypeVar

import numpy as np

from core.coverage.fill_rule import owns as owns_by_side
from core.depth.fixed_depth import NUMBER_BITS
from core.explain.formulas import Named, upright
from core.explain.records import Asked, Formula
from core.records.arrays import Flags, Integers
from core.records.listing import Columns
from core.records.words import Nouns, nouns
from core.trace.stage_trace import Explanation

# The numbers of one step by name and type, as sentences, formulas and tables read them.


AXES = ("x", "y", "z", "w")
CHANNELS = ("red", "green", "blue", "alpha")
ATTRIBUTES = ("color", "uv", "position", "normal", "diffuse_light", "specular_light")
"""What may be interpolated, by the names of core."""


class StepValues:
    """An explanation with typed access to its values."""

    def __init__(
        self, explanation: Explanation, triangle: int = -1, pixel: tuple[int, int] | None = None
    ) -> None:
        self.explanation = explanation
        self.triangle = triangle
        self.stage, self.kind, self.operation = explanation.key.split(".", 2)
        self._pixel = pixel

    @property
    def edge(self) -> int:
        """Number of the edge that the operation ``edge-0``, ``edge-1`` or ``edge-2`` is about."""
        return int(self.operation.removeprefix("edge-"))

    @property
    def pixel(self) -> tuple[int, int]:
        """Column and row that the step is about."""
        if self._pixel is not None and min(self._pixel) >= 0:
            return self._pixel
        return self.whole("column"), self.whole("row")

    @property
    def pixel_name(self) -> str:
        """The name of the pixel, or of its sample, at the beginning of a sentence."""
        column, row = self.pixel
        if self.has("sample") and self.whole("sample") >= 0:
            return f"Sample {self.whole('sample')} of pixel ({column}, {row})"
        return f"Pixel ({column}, {row})"

    @property
    def nouns(self) -> Nouns:
        """What sentences call the primitive and its parts."""
        return nouns(self.explanation.corner_count)

    @property
    def name(self) -> str:
        """The primitive and its number: ``triangle 5``."""
        return self.named_primitive(self.triangle)

    def named_primitive(self, number: int) -> str:
        """Return what another primitive of the scene is called."""
        return f"{self.nouns.one} {number}"

    @property
    def edge_name(self) -> str:
        """The edge of the primitive that the step is about; a segment and a point have no other."""
        is_own = self.explanation.corner_count in (1, 2)
        return self.name if is_own else f"edge {self.whole('edge')} of {self.name}"

    @property
    def fragment_name(self) -> str:
        """The pixel and the primitive that covers it, at the beginning of a sentence."""
        return f"{self.pixel_name} of {self.name}"

    @property
    def the_pixel(self) -> str:
        """The same inside a sentence."""
        return self.pixel_name[0].lower() + self.pixel_name[1:]

    def has(self, *names: str) -> bool:
        """Return whether the step has all of these numbers."""
        return all(name in self.explanation.values for name in names)

    def number(self, name: str) -> float:
        """Return a real number."""
        return float(np.asarray(self.explanation.values[name]).item())

    def named(self, name: str, symbol: str) -> Named:
        """Return a real number with the symbol that formulas have for it."""
        return Named(symbol, self.number(name))

    def upright(self, name: str) -> Named:
        """Return a number whose symbol is its name, in upright letters."""
        return self.named(name, upright(name))

    @property
    def centre(self) -> tuple[Named, Named]:
        """X and y of the pixel's centre."""
        return self.named("x", "x"), self.named("y", "y")

    def plane(self, k: int) -> list[Named]:
        """Return a, b and c of edge ``k``."""
        return [Named(f"{name}_{k}", self.vector(name)[k]) for name in "abc"]

    def whole(self, name: str) -> int:
        """Return a whole number."""
        return int(np.asarray(self.explanation.values[name]).item())

    def flag(self, name: str) -> bool:
        """Return yes or no."""
        return bool(np.asarray(self.explanation.values[name]).item())

    def text(self, name: str) -> str:
        """Return a word."""
        return str(self.explanation.values[name])

    def vector(self, name: str) -> list[float]:
        """Return a list of numbers."""
        return [float(value) for value in np.asarray(self.explanation.values[name], float).ravel()]

    def flags(self, name: str) -> list[bool]:
        """Return a list of yes and no."""
        return [bool(value) for value in np.asarray(self.explanation.values[name]).ravel()]

    def rows(self, name: str) -> list[list[float]]:
        """Return a list of lists of numbers."""
        return [[float(value) for value in row] for row in np.asarray(self.explanation.values[name], float)]

    def corner_values(self, attribute: str, column: str = "corner_values") -> list[list[float]]:
        """Return the values of an interpolated attribute at the corners, or at the ends of a line."""
        first = 0
        for name in self.explanation.values:
            if name == attribute:
                break
            first += len(self.vector(name)) if name in ATTRIBUTES else 0
        return [row[first : first + len(self.vector(attribute))] for row in self.rows(column)]

    def of_end(self, symbol: str, end: int) -> str:
        """Write the symbol of the first (0) or second (1) end of a line, in the colour of the corner on its side."""
        return rf"\vertex{{{(self.whole('edge') + 1 + end) % 3}}}{{{symbol}_{end}}}"

    def fill_rule(self, edge: int) -> str:
        """Return the name of the fill rule; without a name, the rule that agrees with the answers."""
        if self.has("fill_rule"):
            rule = self.explanation.values["fill_rule"]
            return rule if isinstance(rule, str) else str(rule)  # A changed rule stays one.
        a, b, owns = self.vector("a"), self.vector("b"), self.flags("owns_tie")
        by_side = [owns_by_side(x, y) for x, y in zip(a, b, strict=True)]
        if by_side == owns:
            return "shared-edge"
        return "inclusive" if owns[min(edge, len(owns) - 1)] else "exclusive"


def row_key(key: str) -> str:
    """Return the key of the row of an operation: one for all interpolated values, and one for the three edges."""
    stage, kind, operation = key.split(".", 2)
    for name in ("value", "edge"):
        operation = name if operation.startswith(f"{name}-") else operation
    return f"{stage}.{kind}.{operation}"


def key_fields(key: int) -> tuple[str, str]:
    """Write the fields of a packed key in hexadecimal: the depth, and the number of the triangle plus one below it."""
    return f"0x{key >> NUMBER_BITS:010x}", f"0x{key & ((1 << NUMBER_BITS) - 1):06x}"


def component_names(attribute: str, count: int) -> Sequence[str]:
    """Return what the components of an interpolated attribute are called; one number alone is no colour but ``u``."""
    if attribute == "uv" or count == 1:
        return ("u", "v")[:count]
    return AXES[:count] if attribute in ("position", "normal") else CHANNELS[:count]


# One row for every kind of step and operation: what it says, its formula, and what can be asked about it.


Said = str | tuple[str, Formula | None]
"""A sentence, alone or with its formula."""
Say = TypeVar("Say", bound=Callable[[StepValues], Said])


@dataclass(frozen=True)
class Row:
    """The explanation of one operation."""

    say: Callable[[StepValues], Said]
    """Returns the sentence of a step, with its formula where the step computes something."""
    asks: Callable[[StepValues], Asked | None] | None = None
    """Returns a question about the step, with its answer; ``None`` where this step has none."""
    decides: bool = False
    """Whether it chooses what the later operations of its row do: a step of a whole row says it, too."""


ROWS: dict[str, Row] = {}
"""``stage.kind.operation`` to its row."""
Which = Callable[[Columns, Integers], Flags]
"""Takes columns and rows (R,) of a trace; returns which of these, (R,) bool."""
REMARKS: dict[str, Which] = {}
"""``stage.kind.operation``, ``a|b`` and ``*`` as in keys, to the rows of which larger steps repeat what it says."""


def explains(
    *keys: str, asks: Callable[[StepValues], Asked | None] | None = None, decides: bool = False
) -> Callable[[Say], Say]:
    """Enter a function as the row of these keys; ValueError for a key that has a row already."""

    def enter(say: Say) -> Say:
        for key in keys:
            for parts in product(*(part.split("|") for part in key.split("."))):
                name = ".".join(parts)
                if name in ROWS:
                    raise ValueError(f"{name} has a row already, in {ROWS[name].say.__module__}")
                ROWS[name] = Row(say, asks, decides)
        return say

    return enter


def find_row(key: str) -> Row | None:
    """Return the row of a key: its own, or that of any kind of the stage."""
    stage, _, operation = key.split(".", 2)
    return ROWS.get(key) or ROWS.get(f"{stage}.*.{operation}")
