"""Mistakes in transforms, cameras and projections, as wrong formulas; all exact where their numbers are."""

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import cos, radians, sin
from typing import Any

from lessons.mistakes.twin import WrongRule

Vector = tuple[Any, ...]
Matrix = tuple[Vector, ...]
Turn = tuple[Fraction, Fraction]
"""Cosine and sine of an angle: 3/5 and 4/5 make a turn whose numbers are exact."""

QUARTER = (Fraction(0), Fraction(1))


def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    """Return a . b."""
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


def image(matrix: Matrix, point: Vector) -> Vector:
    """Return the product of a matrix, row by row, and a column vector."""
    return tuple(dot(row, point) for row in matrix)


def product(first: Matrix, second: Matrix) -> Matrix:
    """Return ``first second``: the second acts first."""
    return tuple(image(tuple(zip(*second, strict=True)), row) for row in first)


def turned(turn: Turn, point: Vector) -> Vector:
    """Turn a point of the plane about the origin, counter-clockwise."""
    c, s = turn
    return c * point[0] - s * point[1], s * point[0] + c * point[1]


def shifted(shift: Vector, point: Vector) -> Vector:
    """Move a point."""
    return tuple(a + b for a, b in zip(point, shift, strict=True))


def turn_and_move(turn: Turn, shift: Vector, point: Vector) -> Vector:
    """Return T R p."""
    return shifted(shift, turned(turn, point))


def move_and_turn(turn: Turn, shift: Vector, point: Vector) -> Vector:
    """Return R T p."""
    return turned(turn, shifted(shift, point))


def scale_and_move(scale: Vector, shift: Vector) -> Vector:
    """Return T S, a (3, 3) matrix for homogeneous points of the plane, row by row."""
    return (
        scale[0],
        Fraction(0),
        shift[0],
        Fraction(0),
        scale[1],
        shift[1],
        Fraction(0),
        Fraction(0),
        Fraction(1),
    )


def about_pivot(turn: Turn, pivot: Vector, point: Vector) -> Vector:
    """Turn a point about a pivot."""
    return turn_and_move(turn, pivot, shifted(tuple(-c for c in pivot), point))


def turned_by(degrees: int, point: Vector, in_radians: Callable[[float], float] = radians) -> Vector:
    """Turn a point by an angle in degrees."""
    angle = in_radians(degrees)
    return cos(angle) * point[0] - sin(angle) * point[1], sin(angle) * point[0] + cos(angle) * point[1]


def translated(shift: Vector, point: Vector) -> Vector:
    """Return T (x, y, z, 1)."""
    return (*shifted(shift, point), Fraction(1))


def translated_by_transpose(shift: Vector, point: Vector) -> Vector:
    """Return T^T (x, y, z, 1)."""
    return (*point, dot(shift, point) + 1)


def in_camera(axes: Matrix, eye: Vector, target: Vector, point: Vector) -> Vector:
    """Return C^-1 p: the point from the eye, along the camera's right, up and backward axes (one a row)."""
    return image(axes, shifted(tuple(-c for c in eye), point))


def projected(half: Fraction, aspect: Fraction, near: int, far: int, point: Vector) -> Vector:
    """Return the clip position of a camera-space point; ``half`` is tan(fov/2), aspect is width over height."""
    x, y, z = point
    depth = (-(far + near) * z - 2 * far * near) / Fraction(far - near)
    return x / (half * aspect), y / half, depth, -z


def divided(clip: Vector) -> Vector:
    """Return NDC."""
    return tuple(c / clip[3] for c in clip[:3])


def not_divided(clip: Vector) -> Vector:
    """Take clip coordinates for NDC."""
    return clip[:3]


def skinned(weights: Vector, places: Vector) -> Vector:
    """Return the mean of places with weights that need not sum to 1."""
    return (dot(weights, places) / sum(weights),)


F = Fraction
AXES = ((F(3, 5), F(0), F(-4, 5)), (F(0), F(1), F(0)), (F(4, 5), F(0), F(3, 5)))
SEEN = (AXES, (4, 2, 3), (0, 2, 0), (1, 1, 1))
STRAIGHT = (((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0, 0, 0), (0, 0, 0), (1, 1, 1))
VIEW = (F(1, 2), F(4, 3), 1, 10, (F(1), F(2), F(-4)))

RULES = (
    WrongRule(
        "factors-reversed",
        "The factors are in the other order. In T R p the one next to the point acts first: R, then T.",
        turn_and_move,
        move_and_turn,
        (QUARTER, (2, 0), (1, 1)),
        (QUARTER, (0, 0), (1, 1)),
    ),
    WrongRule(
        "turned-clockwise",
        "The turn went clockwise: the signs of the sines are exchanged. A positive angle turns counter-clockwise.",
        turn_and_move,
        lambda turn, shift, point: shifted(shift, turned((turn[0], -turn[1]), point)),
        (QUARTER, (2, 0), (1, 1)),
        ((F(-1), F(0)), (2, 0), (1, 1)),
    ),
    WrongRule(
        "scaled-after-moving",
        "The shift was scaled, too: that is S T. In T S the scaling acts first.",
        scale_and_move,
        lambda scale, shift: scale_and_move(scale, (scale[0] * shift[0], scale[1] * shift[1])),
        ((2, 3), (1, 1)),
        ((2, 3), (0, 0)),
    ),
    WrongRule(
        "pivot-left-out",
        "The point was turned about the origin. Move the pivot to the origin, turn, and move back.",
        about_pivot,
        lambda turn, _pivot, point: turned(turn, point),
        (QUARTER, (2, 0), (3, 0)),
        (QUARTER, (0, 0), (3, 0)),
    ),
    WrongRule(
        "degrees-for-radians",
        "The angle in degrees was taken for radians. Multiply by pi/180 first.",
        turned_by,
        lambda degrees, point: turned_by(degrees, point, float),
        (90, (1, 0)),
        (0, (1, 0)),
    ),
    WrongRule(
        "matrix-transposed",
        "Rows were read as columns, so the translation landed in w. The shift stands in the last column.",
        translated,
        translated_by_transpose,
        ((2, 0, 0), (1, 1, 1)),
        ((0, 0, 0), (1, 1, 1)),
    ),
    WrongRule(
        "ones-missing",
        "The diagonal of the translation has no ones, so every point falls on one place.",
        translated,
        lambda shift, _point: (*shift, Fraction(1)),
        ((1, 0, 0), (1, 1, 1)),
        ((1, 0, 0), (0, 0, 0)),
    ),
    WrongRule(
        "eye-not-turned",
        "The eye was subtracted after the rotation. The translation of the view is -R eye, not -eye.",
        in_camera,
        lambda axes, eye, _target, point: shifted(tuple(-c for c in eye), image(axes, point)),
        SEEN,
        STRAIGHT,
    ),
    WrongRule(
        "target-for-eye",
        "The point was measured from the target. Camera space begins at the eye.",
        in_camera,
        lambda axes, eye, target, point: in_camera(axes, target, eye, point),
        SEEN,
        STRAIGHT,
    ),
    WrongRule(
        "camera-not-inverted",
        "The camera's own matrix was applied. Points go to camera space by its inverse.",
        in_camera,
        lambda axes, eye, _target, point: shifted(eye, image(tuple(zip(*axes, strict=True)), point)),
        SEEN,
        STRAIGHT,
    ),
    WrongRule(
        "angle-not-halved",
        "tan(fov) was taken. Half of the opening angle lies on each side of the axis: tan(fov/2).",
        projected,
        lambda half, aspect, near, far, point: projected(
            2 * half / (1 - half * half), aspect, near, far, point
        ),
        VIEW,
        (*VIEW[:4], (F(0), F(0), F(-4))),
    ),
    WrongRule(
        "aspect-inverted",
        "The aspect is inverted: it is width over height, and divides x.",
        projected,
        lambda half, aspect, near, far, point: projected(half, 1 / aspect, near, far, point),
        VIEW,
        (F(1, 2), F(1), *VIEW[2:]),
    ),
    WrongRule(
        "near-far-signs",
        "near and far have the wrong sign: they are positive distances, while z in front of the eye is negative.",
        projected,
        lambda half, aspect, near, far, point: projected(half, aspect, -near, -far, point),
        VIEW,
        (*VIEW[:2], 0, 10, VIEW[4]),
    ),
    WrongRule(
        "w-is-one",
        "w stayed 1. Perspective puts the distance -z into w.",
        projected,
        lambda half, aspect, near, far, point: (*projected(half, aspect, near, far, point)[:3], Fraction(1)),
        VIEW,
        (*VIEW[:4], (F(1), F(2), F(-1))),
    ),
    WrongRule(
        "clip-for-ndc",
        "x, y and z were not divided by w.",
        divided,
        not_divided,
        ((F(2), F(1), F(1), F(4)),),
        ((F(2), F(1), F(1), F(1)),),
    ),
    WrongRule(
        "z-not-divided",
        "z was not divided by w: all three coordinates are.",
        divided,
        lambda clip: (*divided(clip)[:2], clip[2]),
        ((F(2), F(1), F(1), F(4)),),
        ((F(2), F(1), F(1), F(1)),),
    ),
    WrongRule(
        "weights-not-normalized",
        "The weights do not sum to 1. Divide by their sum, or the vertex moves towards the origin.",
        skinned,
        lambda weights, places: (dot(weights, places),),
        ((F(1, 2), F(12, 25)), (100, 100)),
        ((F(1, 2), F(1, 2)), (100, 100)),
    ),
)
