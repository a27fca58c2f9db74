"""Mistakes in transforms, cameras and projections, as wrong formulas; all exact where their numbers are."""

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import cos, radians, sin
from typing import Any

from lessons.mistakes.twin import wrong_rule

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


def skinned(weights: Vector, places: Vector) -> Vector:
    """Return the mean of places with weights that need not sum to 1."""
    return (dot(weights, places) / sum(weights),)


F = Fraction
AXES = ((F(3, 5), F(0), F(-4, 5)), (F(0), F(1), F(0)), (F(4, 5), F(0), F(3, 5)))
SEEN = (AXES, (4, 2, 3), (0, 2, 0), (1, 1, 1))
STRAIGHT = (((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0, 0, 0), (0, 0, 0), (1, 1, 1))
VIEW = (F(1, 2), F(4, 3), 1, 10, (F(1), F(2), F(-4)))


@wrong_rule(turn_and_move, shows=(QUARTER, (2, 0), (1, 1)), hides=(QUARTER, (0, 0), (1, 1)))
def factors_reversed(turn: Turn, shift: Vector, point: Vector) -> Vector:
    """The factors are in the other order. In T R p the one next to the point acts first: R, then T."""
    return turned(turn, shifted(shift, point))


@wrong_rule(turn_and_move, shows=(QUARTER, (2, 0), (1, 1)), hides=((F(-1), F(0)), (2, 0), (1, 1)))
def turned_clockwise(turn: Turn, shift: Vector, point: Vector) -> Vector:
    """The turn went clockwise: the signs of the sines are exchanged. A positive angle turns counter-clockwise."""
    return shifted(shift, turned((turn[0], -turn[1]), point))


@wrong_rule(scale_and_move, shows=((2, 3), (1, 1)), hides=((2, 3), (0, 0)))
def scaled_after_moving(scale: Vector, shift: Vector) -> Vector:
    """The shift was scaled, too: that is S T. In T S the scaling acts first."""
    return scale_and_move(scale, (scale[0] * shift[0], scale[1] * shift[1]))


@wrong_rule(about_pivot, shows=(QUARTER, (2, 0), (3, 0)), hides=(QUARTER, (0, 0), (3, 0)))
def pivot_left_out(turn: Turn, pivot: Vector, point: Vector) -> Vector:
    """The point was turned about the origin. Move the pivot to the origin, turn, and move back."""
    return turned(turn, point)


@wrong_rule(turned_by, shows=(90, (1, 0)), hides=(0, (1, 0)))
def degrees_for_radians(degrees: int, point: Vector) -> Vector:
    """The angle in degrees was taken for radians. Multiply by pi/180 first."""
    return turned_by(degrees, point, float)


@wrong_rule(translated, shows=((2, 0, 0), (1, 1, 1)), hides=((0, 0, 0), (1, 1, 1)))
def matrix_transposed(shift: Vector, point: Vector) -> Vector:
    """Rows were read as columns, so the translation landed in w. The shift stands in the last column."""
    return (*point, dot(shift, point) + 1)


@wrong_rule(translated, shows=((1, 0, 0), (1, 1, 1)), hides=((1, 0, 0), (0, 0, 0)))
def ones_missing(shift: Vector, point: Vector) -> Vector:
    """The diagonal of the translation has no ones, so every point falls on one place."""
    return (*shift, Fraction(1))


@wrong_rule(in_camera, shows=SEEN, hides=STRAIGHT)
def eye_not_turned(axes: Matrix, eye: Vector, target: Vector, point: Vector) -> Vector:
    """The eye was subtracted after the rotation. The translation of the view is -R eye, not -eye."""
    return shifted(tuple(-c for c in eye), image(axes, point))


@wrong_rule(in_camera, shows=SEEN, hides=STRAIGHT)
def target_for_eye(axes: Matrix, eye: Vector, target: Vector, point: Vector) -> Vector:
    """The point was measured from the target. Camera space begins at the eye."""
    return in_camera(axes, target, eye, point)


@wrong_rule(in_camera, shows=SEEN, hides=STRAIGHT)
def camera_not_inverted(axes: Matrix, eye: Vector, target: Vector, point: Vector) -> Vector:
    """The camera's own matrix was applied. Points go to camera space by its inverse."""
    return shifted(eye, image(tuple(zip(*axes, strict=True)), point))


@wrong_rule(projected, shows=VIEW, hides=(*VIEW[:4], (F(0), F(0), F(-4))))
def angle_not_halved(half: Fraction, aspect: Fraction, near: int, far: int, point: Vector) -> Vector:
    """tan(fov) was taken. Half of the opening angle lies on each side of the axis: tan(fov/2)."""
    return projected(2 * half / (1 - half * half), aspect, near, far, point)


@wrong_rule(projected, shows=VIEW, hides=(F(1, 2), F(1), *VIEW[2:]))
def aspect_inverted(half: Fraction, aspect: Fraction, near: int, far: int, point: Vector) -> Vector:
    """The aspect is inverted: it is width over height, and divides x."""
    return projected(half, 1 / aspect, near, far, point)


@wrong_rule(projected, shows=VIEW, hides=(*VIEW[:2], 0, 10, VIEW[4]))
def near_far_signs(half: Fraction, aspect: Fraction, near: int, far: int, point: Vector) -> Vector:
    """near and far have the wrong sign: they are positive distances, while z in front of the eye is negative."""
    return projected(half, aspect, -near, -far, point)


@wrong_rule(projected, shows=VIEW, hides=(*VIEW[:4], (F(1), F(2), F(-1))))
def w_is_one(half: Fraction, aspect: Fraction, near: int, far: int, point: Vector) -> Vector:
    """w stayed 1. Perspective puts the distance -z into w."""
    return (*projected(half, aspect, near, far, point)[:3], Fraction(1))


@wrong_rule(divided, shows=((F(2), F(1), F(1), F(4)),), hides=((F(2), F(1), F(1), F(1)),))
def clip_for_ndc(clip: Vector) -> Vector:
    """x, y and z were not divided by w."""
    return clip[:3]


@wrong_rule(divided, shows=((F(2), F(1), F(1), F(4)),), hides=((F(2), F(1), F(1), F(1)),))
def z_not_divided(clip: Vector) -> Vector:
    """z was not divided by w: all three coordinates are."""
    return (*divided(clip)[:2], clip[2])


@wrong_rule(skinned, shows=((F(1, 2), F(12, 25)), (100, 100)), hides=((F(1, 2), F(1, 2)), (100, 100)))
def weights_not_normalized(weights: Vector, places: Vector) -> Vector:
    """The weights do not sum to 1. Divide by their sum, or the vertex moves towards the origin."""
    return (dot(weights, places),)
