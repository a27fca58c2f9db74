"""One edge function at one pixel, operation by operation, in the numbers of a format and in rational arithmetic.

After every operation the rest is done without rounding: so it shows at which operation the decision turns.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from core.raster.number_formats.number_format import LAST, NEXT, CornerPositions, NumberFormat
from core.study.exact.coverage import owns_edge


@dataclass(frozen=True)
class EdgeStep:
    """One operation."""

    operation: str
    """As ``y1 w2`` or ``a = y1 w2 - w1 y2``; ``x1``: the corner as the format has it."""
    value: float
    """What the format makes of it."""
    exact: float
    """The same operation on the same numbers without rounding."""
    is_inside: bool
    """The decision if nothing after this operation were rounded."""


OPERATIONS: tuple[tuple[str, str, str, str], ...] = (
    ("y1 w2", "y1", "*", "w2"),
    ("w1 y2", "w1", "*", "y2"),
    ("a = y1 w2 - w1 y2", "y1 w2", "-", "w1 y2"),
    ("w1 x2", "w1", "*", "x2"),
    ("x1 w2", "x1", "*", "w2"),
    ("b = w1 x2 - x1 w2", "w1 x2", "-", "x1 w2"),
    ("x1 y2", "x1", "*", "y2"),
    ("y1 x2", "y1", "*", "x2"),
    ("c = x1 y2 - y1 x2", "x1 y2", "-", "y1 x2"),
    ("a x", "a = y1 w2 - w1 y2", "*", "x"),
    ("b y", "b = w1 x2 - x1 w2", "*", "y"),
    ("b y + c", "b y", "+", "c = x1 y2 - y1 x2"),
    ("a x + (b y + c)", "a x", "+", "b y + c"),
)
"""Name, first operand, operator and second operand, in the order of the edge set-up and evaluation."""
RULES: dict[str, Callable[[Fraction, Fraction], Fraction]] = {
    "*": lambda first, second: first * second,
    "-": lambda first, second: first - second,
    "+": lambda first, second: first + second,
}
SLOPES = tuple(name for name, *_ in OPERATIONS[:6])
"""Operations in the unit of a and b; the others have that of c and the value."""
CORNERS = ("x1", "y1", "w1", "x2", "y2", "w2")
A, B, VALUE = "a = y1 w2 - w1 y2", "b = w1 x2 - x1 w2", "a x + (b y + c)"


def edge_steps(
    corners: CornerPositions,
    numbers: NumberFormat,
    edge: int,
    exact_corners: list[tuple[Fraction, Fraction, Fraction]],
    turn: int,
    pixel: tuple[int, int],
) -> tuple[EdgeStep, ...]:
    """Evaluate one edge of one triangle at one pixel, operation by operation.

    Parameters
    ----------
    corners : CornerPositions
        Of one triangle, (1, 3, ...).
    numbers : NumberFormat
        Not ``inverse``, whose edges come from an elimination.
    exact_corners : list of three (x, y, w)
        The corners before the format has them.
    turn : {-1, 1}
        What the value is multiplied by so that inside is positive.
    pixel : (column, row)
    """
    ends = NEXT[edge], LAST[edge]
    held = [_held_corner(corners, numbers, number) for number in ends]
    given = dict(zip(CORNERS, [v for k in ends for v in exact_corners[k]], strict=True))
    # Snapped corners are (x/w, y/w, 1): so are the given ones then, scaled by a positive w.
    if numbers.corner_kind == "snapped":
        given = {name: value / given["w" + name[1]] for name, value in given.items()}
    if numbers.held_as is object:
        held = [[given[name] for name in CORNERS[k : k + 3]] for k in (0, 3)]
    known = {"x": Fraction(2 * pixel[0] + 1, 2), "y": Fraction(2 * pixel[1] + 1, 2)} | given
    steps = []
    for name, value in zip(CORNERS, [v for corner in held for v in corner], strict=True):
        exact, known[name] = known[name], value
        steps.append(EdgeStep(name, float(value), float(exact), decide(known, turn)))
    for name, first, operator, second in OPERATIONS:
        exact = RULES[operator](known[first], known[second])
        known[name] = rounded(numbers, name, exact)
        steps.append(EdgeStep(name, float(known[name]), float(exact), decide(known, turn)))
    return tuple(steps)


def _held_corner(corners: CornerPositions, numbers: NumberFormat, corner: int) -> list[Fraction]:
    """Return x, y, w of a corner as the format has it, in pixels."""
    return [Fraction(float(value)) for value in numbers.shown_ends(corners)[0, corner]]


def decide(known: dict[str, Fraction], turn: int) -> bool:
    """Return whether the pixel is inside the edge if all that is not ``known`` were computed without rounding."""
    values = dict(known)
    for name, first, operator, second in OPERATIONS:
        if name not in values:
            values[name] = RULES[operator](values[first], values[second])
    a, b, value = (turn * values[name] for name in (A, B, VALUE))
    return value > 0 or (value == 0 and owns_edge(a, b))


def rounded(numbers: NumberFormat, operation: str, exact: Fraction) -> Fraction:
    """Return what a format makes of the exact result of an operation, in pixels.

    Raises OverflowError if a floating-point format has no such number.
    """
    if numbers.rounding == "wrapped":
        is_slope = operation in SLOPES
        return _wrapped(numbers, numbers.slope_exponent if is_slope else numbers.value_exponent, exact)
    if numbers.held_as is object:
        return exact
    with np.errstate(over="ignore"):
        return Fraction(float(numbers.held_as(float(exact))))


def _wrapped(numbers: NumberFormat, exponent: int, exact: Fraction) -> Fraction:
    """Return a number modulo 2^n units of 2^exponent: two's complement."""
    unit = Fraction(1 << exponent) if exponent >= 0 else Fraction(1, 1 << -exponent)
    span: int = 1 << (8 * np.dtype(numbers.held_as).itemsize)
    units: int = (int(exact / unit) + span // 2) % span - span // 2
    return units * unit
