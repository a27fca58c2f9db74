"""Mistakes of the order of drawing: sorting after the division, cutting by planes, walking a tree."""

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from core import Settings
from core.records.arrays import Floats
from core.records.primitives import DrawingOrder
from core.visibility.bsp import bsp
from lessons.mistakes.twin import Case, Twin, wrong_rule
from lessons.small_scenes import triangle_scene
from lessons.window_scenes import circle_of_bars


class Node(NamedTuple):
    """A node of a tree of planes, by its name, with its halves; ``None``: nothing is there."""

    name: str
    eye_in_front: bool
    front: "Node | None" = None
    back: "Node | None" = None


def painted_back_to_front(node: Node | None) -> tuple[str, ...]:
    """Return the names from the first painted to the last: the half without the eye, the node, the half with it."""
    if node is None:
        return ()
    near, far = (node.front, node.back) if node.eye_in_front else (node.back, node.front)
    return (*painted_back_to_front(far), node.name, *painted_back_to_front(near))


def sorted_far_to_near(corners: Sequence[Sequence[int]], near: int, far: int) -> tuple[int, ...]:
    """Return the triangles by the mean distance of their corners along the view, far ones first."""
    return tuple(sorted(range(len(corners)), key=lambda k: -sum(corners[k])))


def pieces_of_a_cut(distances: Sequence[int]) -> tuple[int, int]:
    """Return how many triangles lie on the front and the back side of a plane, by the distances of three corners."""
    counts = []
    for sign in (1, -1):
        inside = [sign * d > 0 for d in distances]
        touching = sum(d == 0 for d in distances)
        crossing = sum(inside[k] and sign * distances[k - 1] < 0 for k in range(3))
        crossing += sum(inside[k - 1] and sign * distances[k] < 0 for k in range(3))
        corners = sum(inside) + touching + crossing
        counts.append(max(corners - 2, 0) if any(inside) else 0)
    return counts[0], counts[1]


def bsp_from_the_front(clip: Floats) -> DrawingOrder:
    """Paint the pieces of a tree from front to back."""
    drawing = bsp(clip)
    pieces = drawing.pieces and drawing.pieces.take(np.arange(len(drawing.order))[::-1])
    return DrawingOrder(drawing.order[::-1], False, pieces=pieces)


def painters_after_division(clip: Floats) -> DrawingOrder:
    """Sort by the mean of z/w."""
    with np.errstate(divide="ignore", invalid="ignore"):
        depth = (clip[:, :, 2] / clip[:, :, 3]).sum(axis=1)
    return DrawingOrder(np.argsort(-depth, kind="stable"), False)


def _two(w: Sequence[Sequence[float]]) -> Case:
    """Return two triangles that overlap, with these w of their corners, between planes at 1 and 10."""
    depth = [[10 * (distance - 1) / (9 * distance) for distance in each] for each in w]
    corners = [[(1, 1), (11, 1), (1, 9)], [(0, 2), (11, 2), (5, 9)]]
    colors = [[color] * 3 for color in ((1, 0, 0, 1), (0, 0, 1, 1))]
    return Case(triangle_scene(corners, (12, 10), depth, w, colors), Settings(visibility="painters"))


_IN_TREE = Settings(visibility="bsp")
TWINS = (
    Twin(
        "front-and-back-swapped",
        "The half with the eye was painted first. Paint the half without the eye first: it can hide nothing.",
        Case(circle_of_bars(), _IN_TREE),
        Case(triangle_scene([[(1, 1), (11, 1), (1, 9)]], (12, 10)), _IN_TREE),
        lambda settings: (
            settings.replaced(visibility=bsp_from_the_front) if settings.visibility == "bsp" else settings
        ),
    ),
    Twin(
        "sorted-after-division",
        "Depths were compared after the division, which puts a corner behind the eye beyond all others. Sort by w.",
        _two([[1, 1, 9], [3, 3, 3]]),
        _two([[4, 4, 4], [3, 3, 3]]),
        lambda settings: (
            settings.replaced(visibility=painters_after_division)
            if settings.visibility == "painters"
            else settings
        ),
    ),
)
"""Wrong orders of drawing."""
_SMALL = Node("A", True, Node("B", True), Node("C", False))


@wrong_rule(painted_back_to_front, shows=(_SMALL,), hides=(Node("A", True),), twin=TWINS[0])
def painted_front_to_back(node: Node | None) -> tuple[str, ...]:
    """Paint the half with the eye first."""
    return painted_back_to_front(node)[::-1]


@wrong_rule(
    sorted_far_to_near,
    shows=(((2, 2, -1), (3, 3, 3)), 1, 9),
    hides=(((2, 2, 2), (3, 3, 3)), 1, 9),
    twin=TWINS[1],
)
def sorted_after_division(corners: Sequence[Sequence[int]], near: int, far: int) -> tuple[int, ...]:
    """Sort by the mean of the window depths, which a corner behind the eye has beyond the far plane."""

    def depth(distance: int) -> Fraction:
        return Fraction(far * (distance - near), distance * (far - near))

    return tuple(sorted(range(len(corners)), key=lambda k: -sum(depth(distance) for distance in corners[k])))


@wrong_rule(pieces_of_a_cut, shows=((0, 2, 3),), hides=((-1, 2, 3),))
def corner_in_plane_cuts(distances: Sequence[int]) -> tuple[int, int]:
    """A corner in the plane was counted as one behind it, so that a triangle that only touches the plane was cut."""
    return pieces_of_a_cut([d or -1 for d in distances])
