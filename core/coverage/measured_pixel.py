"""One pixel in every number format: an edge function operation by operation, and a triangle along a dial.

After every operation the rest is done without rounding: so it shows at which operation the decision turns.

For every format: the values of the three edge functions, the decision, the bits of the value nearest to 0, and the
operation from which on the decision is another one: the first k operations are done in the format and the others
without rounding, for every k.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from core.coverage.edges import EdgeFunctions, set_up_edges
from core.coverage.measured_cover import CoverageExperiment
from core.coverage.measured_exactly import Corner, facing, homogeneous_corner, owns_edge
from core.coverage.measured_triangles import FORMATS, powers, sliver
from core.coverage.number_formats import FIXED, LAST, NEXT, CornerPositions, NumberFormat, bit_pattern
from core.coverage.pixel_runs import half
from core.coverage.snapping import place_corners
from core.records.arrays import Flags, Floats
from core.scene import ClipScene
from core.study.record import Axis

# One edge function at one pixel, operation by operation, in the numbers of a format and in rational
# arithmetic.


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
    held = [[Fraction(float(value)) for value in numbers.shown_ends(corners)[0, number]] for number in ends]
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


# The precision dial: one triangle and one pixel in every number format, from float16 to exact.


INVERSE = "inverse"
"""The format whose edges come from an elimination, not from products of two corners."""
AREA = "sign of the doubled area"
"""What turns the decision where all operations of the edge leave it right: the triangle is turned over, or lost."""
ELIMINATION = "elimination"
ANCHORED = "direction of the edge"
OVERFLOW = "overflow"
SHARED_EDGE = "shared-edge"
FILL_RULE = "fill rule"
"""What turns the decision where the centre lies exactly on the edge, and the fill rule is another than shared-edge."""


@dataclass(frozen=True)
class DialReading:
    """What one format makes of one pixel."""

    coverage: str
    """Name of the format, a method of the family ``coverage``."""
    is_covered: bool
    values: tuple[float, float, float]
    """Edge functions at the pixel's centre, as float64; of ``inverse`` they are divided by the determinant."""
    edge: int
    """The edge that decides: where the decision is wrong, the one whose side is wrong; else the value nearest to 0."""
    bits: str
    """Bit pattern of that edge's value; empty: the format has no fixed length, or the number is not finite."""
    exact_value: float
    """The edge function in exact arithmetic, corners as they are given, as the nearest float64."""
    is_right: bool
    """Whether the decision is that of exact arithmetic."""
    flipped_by: str
    """The operation after which the decision is another one, see `EdgeStep`; empty where it is right."""
    steps: tuple[EdgeStep, ...]
    """All operations of that edge at this pixel; none where its coefficients are not made so."""


def precision_dial(
    scene: ClipScene, pixel: tuple[int, int], triangle: int = 0, fill_rule: str = SHARED_EDGE
) -> tuple[DialReading, ...]:
    """Evaluate one triangle at one pixel in every number format.

    Parameters
    ----------
    pixel : (column, row)
    fill_rule : str
        That of the formats; what is right is always who owns the centre by ``shared-edge``.

    Returns
    -------
    tuple of DialReading
        In the order of ``FORMATS``.

    Raises
    ------
    ValueError
        If there is no such triangle, or a format does not take it.
    """
    return tuple(
        read_format(method.partition("=")[2], scene, pixel, triangle, fill_rule) for method in FORMATS
    )


def read_format(
    coverage: str, scene: ClipScene, pixel: tuple[int, int], triangle: int = 0, fill_rule: str = SHARED_EDGE
) -> DialReading:
    """Evaluate one triangle at one pixel in one number format, see ``precision_dial``."""
    if not 0 <= triangle < len(scene.clip):
        raise ValueError(f"triangle must be from 0 to {len(scene.clip) - 1}, got {triangle}")
    return _read(coverage, _exact_case(scene, triangle, pixel), fill_rule)


@dataclass(frozen=True, eq=False)
class _Case:
    """One triangle and one pixel, and what is right there."""

    clip: Floats
    """(1, 3, 4) float64."""
    size: tuple[int, int]
    pixel: tuple[int, int]
    placed: list[Corner]
    turn: int
    values: tuple[Fraction, ...]
    sides: Flags
    """(3,) bool, inside each edge."""

    @property
    def is_covered(self) -> bool:
        """Whether the pixel belongs to the triangle."""
        return self.turn != 0 and bool(self.sides.all())


def _exact_case(scene: ClipScene, triangle: int, pixel: tuple[int, int]) -> _Case:
    placed = [homogeneous_corner(corner, scene.size) for corner in scene.clip[triangle]]
    turn = facing(placed)
    x, y = (Fraction(2 * index + 1, 2) for index in pixel)
    values, sides = [], []
    for k in range(3):
        (x1, y1, w1), (x2, y2, w2) = placed[k - 2], placed[k - 1]
        a, b, c = turn * (y1 * w2 - w1 * y2), turn * (w1 * x2 - x1 * w2), turn * (x1 * y2 - y1 * x2)
        values.append(a * x + b * y + c)
        sides.append(values[k] > 0 or (values[k] == 0 and owns_edge(a, b)))
    return _Case(scene.clip[[triangle]], scene.size, pixel, placed, turn, tuple(values), np.array(sides))


def _read(name: str, case: _Case, fill_rule: str) -> DialReading:
    """Return what one format makes of the pixel."""
    edges = set_up_edges(place_corners(case.clip, case.size, name), fill_rule)
    numbers = edges.numbers
    held, sides = edges.decide(np.zeros(1, np.int64), *(np.array([index + half()]) for index in case.pixel))
    inside = sides[0]
    values = numbers.shown_values(held)[0]
    is_covered = bool(inside.all()) and bool(edges.doubled_area[0] != 0)
    is_right = is_covered == case.is_covered
    wrong = np.flatnonzero(inside != case.sides)
    edge = int(wrong[0]) if len(wrong) and not is_right else int(np.argmin(np.nan_to_num(np.abs(values))))
    steps = _steps(edges, edge, case)
    return DialReading(
        coverage=name,
        is_covered=is_covered,
        values=(float(values[0]), float(values[1]), float(values[2])),
        edge=edge,
        bits=_bits(float(values[edge]), numbers),
        exact_value=float(case.values[edge]),
        is_right=is_right,
        flipped_by="" if is_right else _flipped_by(name, steps, case, edge, fill_rule),
        steps=steps,
    )


def _steps(edges: EdgeFunctions, edge: int, case: _Case) -> tuple[EdgeStep, ...]:
    """Return the operations of one edge; none where it comes from elsewhere, or a number is infinite."""
    numbers, corners = edges.numbers, edges.corners
    is_anchored = numbers.corner_kind == "snapped" and not corners.is_projected.all()
    if numbers.name == INVERSE or is_anchored or not np.isfinite(numbers.shown_ends(corners)).all():
        return ()
    try:
        return edge_steps(corners, numbers, edge, case.placed, case.turn, case.pixel)
    except OverflowError:
        # Infinity is no fraction: the bits of the value say it.
        return ()


def _flipped_by(name: str, steps: tuple[EdgeStep, ...], case: _Case, edge: int, fill_rule: str) -> str:
    """Return the operation after which the decision stays wrong, whatever else is exact."""
    if fill_rule != SHARED_EDGE and _read(name, case, SHARED_EDGE).is_right:
        return FILL_RULE
    if name == INVERSE:
        return ELIMINATION
    if not steps:
        return ANCHORED if name == "snapped" else OVERFLOW
    turning = AREA
    for step in reversed(steps):
        if step.is_inside == bool(case.sides[edge]):
            break
        turning = step.operation
    return turning


def _bits(value: float, numbers: NumberFormat) -> str:
    if not numbers.value_layout or (FIXED.fullmatch(numbers.value_layout) and not np.isfinite(value)):
        return ""
    return bit_pattern(value, numbers.value_layout)


DIAL = CoverageExperiment(
    "precision-dial",
    "The precision dial",
    "A pixel centre moves closer and closer to an edge. Which format stays correct longest?",
    (Axis("offset", "Distance of the centre from the edge", "pixels", powers(-50, -1), True),),
    FORMATS,
    "Every format agrees with exact arithmetic until the distance falls below its spacing: 1/256 pixel for "
    "snapped corners, then float32, then float64. Whole numbers of any length are always right.",
    lambda place, seed: sliver((1.0, *place), seed),
)
EXPERIMENTS = (DIAL,)
