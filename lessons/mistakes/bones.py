"""Mistakes with bones: the inverse bind, the order of the two matrices, and the width of a bent joint."""

from math import cos, radians

from lessons.mistakes.twin import WrongRule

Place = tuple[int, int]


def turned_about(point: Place, head: Place) -> Place:
    """Return a point after a bone whose joint is at ``head`` is turned by 90 degrees, counter-clockwise."""
    x, y = point[0] - head[0], point[1] - head[1]
    return head[0] - y, head[1] + x


def without_inverse_bind(point: Place, head: Place) -> Place:
    """Turn the point as if it were given from the joint, and put it there."""
    return head[0] - point[1], head[1] + point[0]


def pose_first(point: Place, head: Place) -> Place:
    """Apply the pose (turn, then move to the joint) first, and the inverse bind (move from the joint) after it."""
    x, y = without_inverse_bind(point, head)
    return x - head[0], y - head[1]


def width_kept(degrees: float) -> tuple[float]:
    """Return the percentage of its width that a joint bent by an angle keeps where both weights are 1/2."""
    return (100 * abs(cos(radians(degrees) / 2)),)


RULES = (
    WrongRule(
        "no-inverse-bind",
        "The position was turned as if the joint were its origin. The inverse bind first takes it to the bone's space.",
        turned_about,
        without_inverse_bind,
        ((6, 1), (4, 0)),
        ((0, 0), (0, 0)),
    ),
    WrongRule(
        "pose-before-bind",
        "The pose came before the inverse bind. The matrix nearest to the point works first: that is the inverse bind.",
        turned_about,
        pose_first,
        ((6, 1), (4, 0)),
        ((0, 0), (0, 0)),
    ),
    WrongRule(
        "width-of-whole-angle",
        "The cosine of the whole angle was taken. Both halves of the bend turn by half of it from the middle.",
        width_kept,
        lambda degrees: (100 * abs(cos(radians(degrees))),),
        (60.0,),
        (0.0,),
    ),
    WrongRule(
        "width-in-proportion",
        "The width fell in proportion to the angle. The mixed point lies on a chord, and its distance is a cosine.",
        width_kept,
        lambda degrees: (100 * (1 - degrees / 180),),
        (60.0,),
        (0.0,),
    ),
)
