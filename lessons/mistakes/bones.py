"""Mistakes with bones: the inverse bind, the order of the two matrices, and the width of a bent joint."""

from math import cos, radians

from lessons.mistakes.twin import wrong_rule

Place = tuple[int, int]


def turned_about(point: Place, head: Place) -> Place:
    """Return a point after a bone whose joint is at ``head`` is turned by 90 degrees, counter-clockwise."""
    x, y = point[0] - head[0], point[1] - head[1]
    return head[0] - y, head[1] + x


def width_kept(degrees: float) -> tuple[float]:
    """Return the percentage of its width that a joint bent by an angle keeps where both weights are 1/2."""
    return (100 * abs(cos(radians(degrees) / 2)),)


@wrong_rule(turned_about, shows=((6, 1), (4, 0)), hides=((0, 0), (0, 0)))
def no_inverse_bind(point: Place, head: Place) -> Place:
    """The position was turned as if the joint were its origin. The inverse bind first takes it to the bone's space."""
    return head[0] - point[1], head[1] + point[0]


@wrong_rule(turned_about, shows=((6, 1), (4, 0)), hides=((0, 0), (0, 0)))
def pose_before_bind(point: Place, head: Place) -> Place:
    """The pose came before the inverse bind. The matrix nearest to the point works first: that is the inverse bind."""
    x, y = no_inverse_bind(point, head)
    return x - head[0], y - head[1]


@wrong_rule(width_kept, shows=(60.0,), hides=(0.0,))
def width_of_whole_angle(degrees: float) -> tuple[float]:
    """The cosine of the whole angle was taken. Both halves of the bend turn by half of it from the middle."""
    return (100 * abs(cos(radians(degrees))),)


@wrong_rule(width_kept, shows=(60.0,), hides=(0.0,))
def width_in_proportion(degrees: float) -> tuple[float]:
    """The width fell in proportion to the angle. The mixed point lies on a chord, and its distance is a cosine."""
    return (100 * (1 - degrees / 180),)
