"""Listings of triangles: edge function, tie rule, inside test, and interpolation, at pixels of every class."""

from collections.abc import Iterator
from typing import Any

from core import Settings
from core.edits.edit import original
from lessons.exercises.coding.task import SIDE, Case, Fault, Shown, Task, in_classes
from lessons.small_scenes import triangle_scene

Point = tuple[float, float]
Corners = tuple[Point, Point, Point]
TRIANGLES: tuple[Corners, ...] = (
    ((1.5, 1.5), (5.5, 1.5), (1.5, 5.5)),
    ((5.5, 1.5), (5.5, 5.5), (1.5, 5.5)),
    ((2.0, 1.0), (8.5, 2.5), (4.5, 7.5)),
    ((1.5, 8.5), (6.5, 3.5), (9.5, 8.5)),
    ((2.5, 2.5), (9.5, 3.5), (3.5, 3.0)),
)
"""Counter-clockwise: two that share an edge through centres, two others, and a thin one."""
_COVERS, _OWNS = original("fill", "bounding-box"), original("fill_rule", "shared-edge")


def edge_of(p: Any, q: Any) -> tuple[Any, Any, Any]:
    """Return a, b, c of the edge function that is positive to the left of the way from p to q."""
    a, b = p[1] - q[1], q[0] - p[0]
    return a, b, -(a * p[0] + b * p[1])


def edges_of(corners: Corners) -> tuple[tuple[float, ...], ...]:
    """Return a, b and c (3,) of the three edges, each opposite to its corner."""
    p, q, r = corners
    rows = [edge_of(q, r), edge_of(r, p), edge_of(p, q)]
    return tuple(zip(*rows, strict=True))


def pixels_of_triangles() -> Iterator[tuple[Corners, int, int]]:
    """Yield every triangle with the column and row of each pixel around it."""
    for corners in TRIANGLES:
        for row in range(10):
            for column in range(11):
                yield corners, column, row


def corners_text(corners: Corners) -> str:
    """Return corners in words."""
    return ", ".join(f"({x:g}, {y:g})" for x, y in corners)


def inside_cases() -> Iterator[tuple[str, Case]]:
    """Yield edges and a centre by where it lies."""
    for corners, column, row in pixels_of_triangles():
        a, b, c = edges_of(corners)
        owns = tuple(map(_OWNS.function, a, b))
        x, y = column + 0.5, row + 0.5
        values = [a[k] * x + b[k] * y + c[k] for k in range(3)]
        on = [k for k in range(3) if values[k] == 0]
        negative = sum(value < 0 for value in values)
        if negative:
            name = "outside of one edge" if negative == 1 else "outside of two edges"
        elif not on:
            name = "inside"
        elif len(on) == 2:
            name = "on a corner"
        else:
            name = "on an edge that owns its centres" if owns[on[0]] else "on an edge that does not own them"
        said = f"triangle {corners_text(corners)}, centre ({x:g}, {y:g})"
        # Outside of its box a triangle is not tested.
        is_beside = not all(
            min(side) <= place <= max(side)
            for side, place in zip(zip(*corners, strict=True), (x, y), strict=True)
        )
        yield name, Case((a, b, c, owns, x, y), said, (corners, (column, row)), size=float(is_beside))


def number_text(number: float) -> str:
    """Return a number with at most four digits behind the point."""
    return f"{round(number, 4) + 0.0:g}"


def numbers_text(numbers: list[float]) -> str:
    """Return numbers in words."""
    return ", ".join(map(number_text, numbers))


def _inside_text(value: Any) -> str:
    values, covered = value
    return f"{numbers_text(values)}: {'covered' if covered else 'not covered'}"


def _inside_shown(case: Case) -> Shown:
    corners, pixel = case.about
    return Shown(
        triangle_scene([corners], (SIDE, SIDE)),
        Settings(fill="bounding-box"),
        "fill",
        "bounding-box",
        "raster",
        pixel,
    )


TEST = "inside.append(bool(value > 0 or (value == 0 and owns_tie[k])))"
INSIDE = Task(
    "inside-test",
    "raster",
    "the inside test",
    """covers is given a, b and c of the three edge functions a x + b y + c, whether each edge owns the
    centres on it, and a centre (x, y). It returns the three values, and whether the centre is covered: every
    value is positive, or 0 on an edge that owns it.
    Hint: Take a centre inside, one outside, and one on each edge: which of them is wrong?
    Hint: How many of the three edges must agree? What decides where a value is 0?
    Hint: Put a = 1, b = 0, c = -2 and x = 2 into the lines: the value is 0, and owns_tie decides.""",
    _COVERS.source,
    in_classes(inside_cases(), 24),
    (
        Fault("value = a[k] * x + (b[k] * y + c[k])", "value = a[k] * x - (b[k] * y + c[k])"),
        Fault("value = a[k] * x + (b[k] * y + c[k])", "value = a[k] * y + (b[k] * x + c[k])"),
        Fault(TEST, "inside.append(value >= 0)", "all-edges-inclusive"),
        Fault(TEST, "inside.append(value > 0)", "all-edges-exclusive"),
        Fault(TEST, "inside.append(bool(value > 0 or owns_tie[k]))"),
        Fault("return values, all(inside)", "return values, any(inside)"),
    ),
    ("[0, 0, 0], True", "[0, 0, 0], False", "[1, 1, 1], True"),
    (("number",) * 3, "flag"),
    "the three values, and whether the pixel is covered",
    _inside_text,
    _COVERS.function,
    shown=_inside_shown,
)


def tie_cases() -> Iterator[tuple[str, Case]]:
    """Yield directions of edges by what they are."""
    for a in range(-3, 4):
        for b in range(-3, 4):
            if (a, b) == (0, 0):
                continue
            side = "left" if a > 0 else "right"
            lean = "upright" if b == 0 else "rising" if (a > 0) != (b > 0) else "falling"
            name = f"{lean} {side} edges" if a else "level edges"
            yield name, Case((a, b), f"a = {a}, b = {b}", (a, b), size=abs(a) + abs(b))


def _tie_shown(case: Case) -> Shown:
    """Return two triangles with the edge between them."""
    a, b = case.about
    p, q = (5.5, 5.5), (5.5 + b, 5.5 - a)
    left, right = (p[0] + a, p[1] + b), (q[0] - a, q[1] - b)
    scene = triangle_scene([(p, q, left), (q, p, right)], (SIDE, SIDE))
    return Shown(scene, Settings(fill="bounding-box"), "fill_rule", "shared-edge", "raster")


TIE_RULE = Task(
    "tie-rule",
    "edges",
    "the tie rule",
    """owns is given a and b of an edge function a x + b y + c of a counter-clockwise triangle, y up. It
    returns whether the edge owns the centres on it: a left edge does (a > 0), and a level edge where it is
    the bottom edge (b > 0).
    Hint: Which edges have a = 0?
    Hint: Go around a square: which two of its edges own their centres?
    Hint: Of a square, a is 1 on the left, -1 on the right and 0 on level edges; b is 1 at the bottom.""",
    _OWNS.source,
    in_classes(tie_cases()),
    (
        Fault("if a != 0:", "if b != 0:"),
        Fault("return a > 0", "return a < 0"),
        Fault("return a > 0", "return a >= 0 or b > 0"),
        Fault("return b > 0", "return b < 0"),
        Fault("return b > 0", "return a != b", "level-edges-always"),
        Fault("return b > 0", "return b == 0", "level-edges-never"),
    ),
    ("True", "False", "b > a"),
    "flag",
    "whether the edge owns the centres on it",
    lambda value: "owns them" if value else "does not own them",
    _OWNS.function,
    shown=_tie_shown,
)


def _edge_cases() -> Iterator[tuple[str, Case]]:
    """Yield two corners and a point by the side on which it lies."""
    for p, q in (((1, 1), (4, 1)), ((4, 1), (4, 4)), ((4, 4), (1, 1)), ((2, 5), (1, 2)), ((5, 3), (2, 3))):
        for x in range(6):
            for y in range(6):
                a, b, c = edge_of(p, q)
                value = a * x + b * y + c
                name = "on the edge" if value == 0 else "to its left" if value > 0 else "to its right"
                said = f"from ({p[0]}, {p[1]}) to ({q[0]}, {q[1]}), point ({x}, {y})"
                yield name, Case((*map(float, (*p, *q, x, y)),), said)


EDGE = Task(
    "edge-function",
    "edges",
    "the edge function",
    """edge is given two corners and a point (x, y), y up. It returns (x1 - x0) (y - y0) - (y1 - y0) (x - x0):
    twice the area of the triangle of the three, positive where the point lies to the left of the way from
    corner 0 to corner 1.
    Hint: What must come out for a point on the edge, as corner 0 itself?
    Hint: To the left of the way to the right lies what is above: y > y0.
    Hint: With corners (0, 0) and (1, 0), the point (0, 1) gives 1, and (1, 0) gives 0.""",
    "def edge(x0, y0, x1, y1, x, y):\n  dx, dy = x1 - x0, y1 - y0\n  return dx * (y - y0) - dy * (x - x0)",
    in_classes(_edge_cases()),
    (
        Fault("return dx * (y - y0) - dy * (x - x0)", "return dy * (x - x0) - dx * (y - y0)"),
        Fault("return dx * (y - y0) - dy * (x - x0)", "return dx * (y - y0) + dy * (x - x0)"),
    ),
    ("0", "1", "x - x0"),
    "number",
    "the value of the edge function",
    number_text,
)


TASKS = (EDGE, TIE_RULE, INSIDE)
