"""Beliefs about spaces: w, the divide, clipping, the viewport, depth, and the order of transforms."""

from dataclasses import replace
from fractions import Fraction

from core.scene import Scene
from lessons.exercises.draws import Draws
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft, Template
from lessons.exercises.refutation import Refutation
from lessons.exercises.templates.believing import believed, eye_scene
from lessons.exercises.templates.transforms import sketched
from lessons.small_scenes import triangle_scene

BASE = ((-1, -1, -3), (1, -1, -3))
"""Two eye points in front of the camera."""
TURN = ((0, -1, 0, 0), (1, 0, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
"""90 degrees, counter-clockwise."""
CAMERA = "A camera at the origin looks along -z, 90 degrees wide"


def _with_point(x: float, y: float, z: float, near: float = 1.0, far: float = 10.0) -> Scene:
    """Return a triangle of which vertex 0 is an eye point."""
    return eye_scene([(x, y, z), *BASE], near, far)


def draw_w(draws: Draws) -> Draft | None:
    """W is always 1."""
    x, y, d = draws.whole(1, 3), draws.whole(1, 3), draws.whole(2, 9)
    refutation = Refutation(
        f"w is the distance in front of the eye, here {d}: the last row of the matrix is (0, 0, -1, 0).",
        _with_point(x, y, -d),
        "transform",
        f'kind == "camera-to-clip" and vertex == 0 and after_w == {d}',
    )
    text = f"{CAMERA}. What is w of the eye point ({x}, {y}, -{d}) after the perspective matrix?"
    hints = (
        "Look at the last row of the perspective matrix.",
        "It copies one coordinate of the eye point to w.",
        f"w = 0 * {x} + 0 * {y} + (-1) * (-{d}) + 0 * 1.",
    )
    return believed(draws, text, d, [1], [-d, 0], refutation, hints)


def draw_divide(draws: Draws) -> Draft | None:
    """The division is part of the matrix."""
    d = draws.whole(3, 9)
    refutation = Refutation(
        f"Here x is {d - 1} and w is {d}: the matrix does not divide, and x lies in [-w, w]. The divide follows.",
        _with_point(d - 1, 0, -d),
        "transform",
        'kind == "camera-to-clip" and after_x > 1 and after_x < after_w',
    )
    text = f"{CAMERA}. The point ({d - 1}, 0, -{d}) is visible. Where does its x lie after the perspective matrix?"
    hints = (
        "Can a matrix divide one coordinate by another?",
        "Multiply it out, and compare x with w.",
        f"90 degrees wide: x stays {d - 1}, and w is the distance {d}.",
    )
    return believed(
        draws, text, "in [-w, w]", ["in [-1, 1]"], ["in [0, W], in pixels", "anywhere"], refutation, hints
    )


def draw_late_clip(draws: Draws) -> Draft | None:
    """Clipping may wait until after the divide."""
    a, b, c = draws.whole(1, 2), draws.whole(1, 2), draws.whole(3, 6)
    refutation = Refutation(
        f"w is -{c}: the point lies behind the eye, and dividing by w hides that. Clip while w still has its sign.",
        _with_point(a, b, c),
        "transform",
        'kind == "camera-to-clip" and vertex == 0 and after_w < 0',
    )
    text = f"{CAMERA}. The point ({a}, {b}, {c}) has x/w = -{a}/{c} and y/w = -{b}/{c}. Is it visible?"
    hints = (
        "On which side of the eye does the point lie?",
        "Two minus signs can cancel.",
        f"The camera looks along -z: is z = {c} in front of it?",
    )
    right, belief = "no: it lies behind the eye", "yes: both lie in [-1, 1]"
    return believed(draws, text, right, [belief], ["no: both are negative"], refutation, hints)


def draw_viewport(draws: Draws) -> Draft | None:
    """The viewport must follow the divide."""
    d = draws.whole(2, 6)
    refutation = Refutation(
        f"D keeps w, here {d}: its translation is multiplied by w, too, and the divide removes w from all alike.",
        _with_point(0, 1, -d),
        "transform",
        f'kind == "camera-to-clip" and vertex == 0 and after_w == {d}',
    )
    text = f"{CAMERA}; w of the point (0, 1, -{d}) is {d}. May the viewport matrix D be applied before the divide?"
    hints = (
        "Write D as a matrix and multiply it with (x, y, z, w).",
        "What does the translation become?",
        f"D makes W/2 * {d} of the translation W/2: what is left of it after the divide by {d}?",
    )
    right, belief = "yes", "no: the points would shrink to (0, 0)"
    return believed(draws, text, right, [belief], ["only where w is 1"], refutation, hints)


def draw_linear_depth(draws: Draws) -> Draft | None:
    """Depth is linear in distance."""
    f, d = draws.item((4, 5, 6, 9, 10, 11)), draws.whole(2, 3)
    right, belief = Fraction(f * (d - 1), (f - 1) * d), Fraction(d - 1, f - 1)
    refutation = Refutation(
        f"Window depth is f (d - n) / ((f - n) d): {number_text(right)} at distance {d}. Most of it is used up near n.",
        _with_point(0, 0, -d, 1, f),
        "transform",
        f'kind == "viewport" and vertex == 0 and after_z > {float(belief)}',
    )
    text = f"n = 1, f = {f}, window depth from 0 to 1: what is it at distance {d}?"
    hints = (
        "Depth is divided by w, too.",
        "What is it at n, and what at f? In between it is linear in 1/d.",
        f"Window depth is f (d - n) / ((f - n) d), with n = 1, f = {f} and d = {d}.",
    )
    return believed(draws, text, right, [belief], [1 - right, Fraction(d, f)], refutation, hints)


def _deep(w: int) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Return depth and w of a triangle from near to far."""
    return (0.0, 1.0, 0.0), (1.0, float(w), 1.0)


WIDE = ((0.5, 0.5), (8.5, 0.5), (0.5, 6.5))
"""A triangle whose bottom edge has its middle at the centre of pixel (4, 0)."""
MIDDLE = "column == 4 and row == 0"


def draw_corrected_depth(draws: Draws) -> Draft | None:
    """Depth, like every attribute, needs the perspective correction."""
    w = draws.whole(3, 10)
    depth, weights = _deep(w)
    refutation = Refutation(
        "Window depth was divided by w already, so it is linear in the window: one half in the middle.",
        triangle_scene([WIDE], (10, 8), depth=[depth], w=[weights]),
        "depth",
        f"{MIDDLE} and z > 0.49 and z < 0.51",
    )
    text = f"An edge runs from window depth 0 (w = 1) to 1 (w = {w}). What is the depth at the pixel in its middle?"
    hints = (
        "Which values are linear in the window?",
        "Is window depth made before the divide, or after it?",
        f"After the divide by w = 1 and w = {w}, is depth linear in the window? If so, both ends count one half: "
        "(0 + 1)/2.",
    )
    return believed(
        draws,
        text,
        Fraction(1, 2),
        [Fraction(1, w + 1)],
        [Fraction(w, w + 1), Fraction(1, w)],
        refutation,
        hints,
    )


def draw_middle(draws: Draws) -> Draft | None:
    """The middle of an edge in space is its middle in the window."""
    w = draws.whole(2, 6)
    depth, weights = _deep(w)
    right = Fraction(1, w + 1)
    refutation = Refutation(
        f"At the middle pixel the far end weighs {number_text(right)}: what is far away takes up less of the window.",
        triangle_scene([WIDE], (10, 8), depth=[depth], w=[weights]),
        "interpolate",
        f"{MIDDLE} and weights[1] > {float(right) - 0.01} and weights[1] < {float(right) + 0.01}",
    )
    text = f"An edge runs from z = -1 to z = -{w}. How far along it from the near end is the point at its middle pixel?"
    hints = (
        "The far half of the edge looks shorter.",
        "1/w is linear in the window: weigh the ends with it.",
        f"With u = 0 at the near end and u = 1 at the far end: (1/{w}) / (1/1 + 1/{w}).",
    )
    return believed(draws, text, right, [Fraction(1, 2)], [1 - right, Fraction(1, w + 2)], refutation, hints)


def draw_behind(draws: Draws) -> Draft | None:
    """Depth order also holds behind the eye."""
    f, d = draws.item((3, 4, 5, 6, 9, 10)), draws.whole(1, 2)
    behind, before = (Fraction(f + 1, f - 1) - Fraction(2 * f, (f - 1) * each) for each in (-d, d))
    refutation = Refutation(
        f"z' is {number_text(behind)} at d = -{d} and {number_text(before)} at d = {d}: behind the eye all of z' is "
        "beyond the far plane.",
        _with_point(0, 0, d, 1, f),
        "transform",
        'kind == "divide" and vertex == 0 and after_z > 1',
    )
    text = (
        f"z' = (f + n - 2 f n / d) / (f - n) with n = 1, f = {f}. Is z' at d = -{d} smaller than at d = {d}?"
    )
    hints = (
        "Put both in.",
        "What sign has 2 f n / d behind the eye?",
        f"Compare 2 * {f} / (-{d}) with 2 * {f} / {d}, each taken away from the same number.",
    )
    right, belief = "no: it is larger", "yes: the order holds on both sides of the eye"
    return believed(draws, text, right, [belief], ["both are equal"], refutation, hints)


def draw_parallel(draws: Draws) -> Draft | None:
    """All parallel lines converge."""
    d = draws.whole(2, 7)
    refutation = Refutation(
        f"All points of both edges have w = {d}, so all are divided alike, and the edges stay parallel.",
        eye_scene([(-1, -1, -d), (1, -1, -d), (-1, 1, -d)]),
        "transform",
        f'kind == "camera-to-clip" and vertex == 2 and after_w == {d}',
    )
    text = f"{CAMERA}. Two parallel edges lie in the plane z = -{d}. Do they meet in the picture?"
    hints = (
        "What is w along each of them?",
        "Edges meet where they run away from the eye.",
        f"w = {d} at every point of both edges: what does the divide do to both?",
    )
    right, belief = "no", "yes: parallel lines converge"
    return believed(draws, text, right, [belief], ["only at the horizon"], refutation, hints)


def draw_far_plane(draws: Draws) -> Draft | None:
    """The far plane decides the precision."""
    n = draws.item((Fraction(1, 10), Fraction(1, 5), Fraction(1, 2)))
    refutation = Refutation(
        "At a distance of 10 n window depth is 0.9 already, however far f is: n decides how fast depth is used up.",
        _with_point(0, 0, float(-10 * n), float(n), 100.0),
        "transform",
        'kind == "viewport" and vertex == 0 and after_z > 0.9',
    )
    text = (
        f"n = {number_text(n)}, f = 100. What costs more precision of far depths: n made 10 times smaller, or f made "
        "10 times larger?"
    )
    hints = (
        "Window depth is f (d - n) / ((f - n) d).",
        "What becomes of it as f grows without limit?",
        f"For large f depth is nearly (d - {number_text(n)}) / d: which of the two numbers is left?",
    )
    return believed(
        draws, text, "n made smaller", ["f made larger"], ["both alike", "neither"], refutation, hints
    )


def draw_larger_z(draws: Draws) -> Draft | None:
    """Larger z is nearer, or farther, always."""
    a = draws.whole(2, 4)
    b = draws.whole(a + 1, 9)
    refutation = Refutation(
        f"The camera looks along -z, so z = -{a} is nearer; only in the window is the smaller value the nearer one.",
        _with_point(0, 0, -a),
        "transform",
        'kind == "world-to-camera" and vertex == 0 and after_z < 0',
    )
    text = f"In camera space, after C^-1, which of z = -{a} and z = -{b} is nearer?"
    hints = (
        "Which way does the camera look?",
        "The rule that smaller is nearer is that of one space alone.",
        f"How far in front of the camera does z = -{a} lie, and how far z = -{b}?",
    )
    return believed(
        draws,
        text,
        f"z = -{a}",
        [f"z = -{b}: the smaller value"],
        ["neither: both lie behind"],
        refutation,
        hints,
    )


def draw_factors(draws: Draws) -> Draft | None:
    """Factors act from left to right."""
    a = draws.whole(2, 4)
    model = [list(row) for row in TURN]
    model[0][3], model[2][3] = a, -5
    refutation = Refutation(
        f"T R p turns first: (1, 0) becomes (0, 1), which then moves to ({a}, 1).",
        eye_scene([(1, 0, 0), (0, 0, 0), (0, -1, 0)], model=model),
        "transform",
        'kind == "object-to-world" and vertex == 0 and after_y > 0.9 and after_y < 1.1',
    )
    text = (
        f"p' = T R p with columns; R turns by 90 degrees, T moves by ({a}, 0), p = (1, 0). Which acts first?"
    )
    hints = (
        "Put brackets where you would begin to multiply.",
        "T (R p): what is multiplied with p?",
        f"Compare T (R p) with R (T p): turn (1, 0) and add {a}, or add {a} and turn.",
    )
    return believed(draws, text, "R", ["T"], ["the order does not matter"], refutation, hints)


def draw_own_center(draws: Draws) -> Draft | None:
    """An object turns about its own centre."""
    a = draws.whole(2, 4)
    model = [list(row) for row in TURN]
    model[2][3] = -5
    refutation = Refutation(
        f"R turns about the origin: ({a}, 0) goes to (0, {a}). To turn in place, move to the origin, turn, move back.",
        eye_scene([(a, 0, 0), (a + 1, -1, 0), (a + 1, 1, 0)], model=model),
        "transform",
        f'kind == "object-to-world" and vertex == 0 and after_y > {a - 0.1}',
    )
    text = f"A square has its centre at ({a}, 0). R turns by 90 degrees counter-clockwise. Where is its centre then?"
    hints = (
        "About which point does a rotation matrix turn?",
        "Apply R to the centre itself.",
        f"R maps (x, y) to (-y, x): put in x = {a} and y = 0.",
    )
    asked = believed(draws, text, f"(0, {a})", [f"({a}, 0)"], [f"(0, -{a})", f"(-{a}, 0)"], refutation, hints)
    square = ((a - 1, -1), (a + 1, -1), (a + 1, 1), (a - 1, 1))
    return None if asked is None else replace(asked, sketch=sketched({"centre": (a, 0)}, square))


TEMPLATES = (
    Template("belief-w-is-one", 1, "Is w always 1?", "transform", 1, draw_w),
    Template("belief-divide-in-matrix", 1, "Does the matrix divide?", "transform", 1, draw_divide),
    Template("belief-clip-later", 1, "May clipping wait?", "clip", 1, draw_late_clip),
    Template(
        "belief-viewport-last", 1, "Must the viewport follow the divide?", "transform", 1, draw_viewport
    ),
    Template("belief-depth-linear", 1, "Is depth linear in distance?", "depth", 1, draw_linear_depth),
    Template("belief-depth-corrected", 1, "Is depth corrected?", "depth", 1, draw_corrected_depth),
    Template("belief-middle-stays", 1, "Does the middle stay the middle?", "interpolate", 1, draw_middle),
    Template("belief-order-behind", 1, "Depth behind the eye", "clip", 1, draw_behind),
    Template("belief-all-converge", 1, "Do all parallels converge?", "transform", 1, draw_parallel),
    Template("belief-far-precision", 1, "What costs precision of depth?", "depth", 1, draw_far_plane),
    Template("belief-larger-z", 1, "Which z is nearer?", "transform", 1, draw_larger_z),
    Template("belief-left-to-right", 1, "Which factor acts first?", "transform", 1, draw_factors),
    Template("belief-own-centre", 1, "About which point does it turn?", "transform", 1, draw_own_center),
)
