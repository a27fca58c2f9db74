"""Beliefs about spaces: w, the divide, clipping, the viewport, depth, and the order of transforms."""

from dataclasses import replace
from fractions import Fraction

from core.scene import Scene
from lessons.exercises.drafting import believed, eye_scene
from lessons.exercises.numbers import Draws, number_text
from lessons.exercises.question import Draft, Refutation, template
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


@template("belief-w-is-one", 1, "Is w always 1?", "transform", 1)
def draw_w(draws: Draws) -> Draft:
    """W is always 1."""
    x, y, d = draws.whole(1, 3), draws.whole(1, 3), draws.whole(2, 9)
    refutation = Refutation(
        f"w is the distance in front of the eye, here {d}: the last row of the matrix is (0, 0, -1, 0).",
        _with_point(x, y, -d),
        "transform",
        f'kind == "camera-to-clip" and vertex == 0 and after_w == {d}',
    )
    asked = f"""{CAMERA}. What is w of the eye point ({x}, {y}, -{d}) after the perspective matrix?
        Hint: Look at the last row of the perspective matrix.
        Hint: It copies one coordinate of the eye point to w.
        Hint: w = 0 * {x} + 0 * {y} + (-1) * (-{d}) + 0 * 1."""
    return believed(draws, asked, d, [1], [-d, 0], refutation)


RANGES = ("in [-w, w]", "in [-1, 1]", "in [0, W], in pixels")
"""Of a visible x after the perspective matrix, the divide and the viewport."""


@template("belief-divide-in-matrix", 2, "Does the matrix divide?", "transform", 1)
def draw_divide(draws: Draws) -> Draft:
    """The division is part of the matrix."""
    d, done = draws.whole(3, 9), draws.whole(0, 2)
    step, sentence, condition, belief = (
        (
            "perspective matrix",
            f"Here x is {d - 1} and w is {d}: the matrix does not divide, and x lies in [-w, w]. The divide follows.",
            'kind == "camera-to-clip" and after_x > 1 and after_x < after_w',
            RANGES[1],
        ),
        (
            "divide",
            f"x was {d - 1} and w {d}: the divide leaves x in [-1, 1]. Pixels come with the viewport.",
            'kind == "divide" and vertex == 0 and after_x > 0 and after_x < 1',
            RANGES[2],
        ),
        (
            "viewport",
            "The viewport is what stretches [-1, 1] over the W pixels of the window.",
            'kind == "viewport" and vertex == 0 and after_x > 1',
            RANGES[1],
        ),
    )[done]
    refutation = Refutation(sentence, _with_point(d - 1, 0, -d), "transform", condition)
    asked = f"""{CAMERA}. The point ({d - 1}, 0, -{d}) is visible. Where does its x lie after the {step}?
        Hint: Can a matrix divide one coordinate by another?
        Hint: Three things follow each other: the matrix, the divide by w, the viewport.
        Hint: 90 degrees wide: the matrix leaves x at {d - 1} and makes w the distance {d}. What comes of it
        then?"""
    others = [each for each in RANGES if each not in (RANGES[done], belief)]
    return believed(draws, asked, RANGES[done], [belief], [*others, "anywhere"], refutation)


@template("belief-clip-later", 2, "May clipping wait?", "clip", 1)
def draw_late_clip(draws: Draws) -> Draft:
    """Clipping may wait until after the divide: two points have the same quotients, one lies behind the eye."""
    a, b, c = draws.whole(1, 2), draws.whole(1, 2), draws.whole(3, 6)
    side = draws.item((1, -1))
    behind = "no: it lies behind the eye"
    visible = "yes: both lie in [-1, 1]"
    negative = "no: both are negative"
    if side > 0:
        right, belief, other = behind, visible, negative
        sentence = (
            f"w is -{c}: the point lies behind the eye, and dividing by w hides that. Clip before the divide."
        )
    else:
        right, belief, other = visible, negative, behind
        sentence = f"w is {c}, so the point lies in front of the eye; from -1 to 0 is the left or lower half."
    refutation = Refutation(
        sentence,
        _with_point(side * a, side * b, side * c),
        "transform",
        f'kind == "camera-to-clip" and vertex == 0 and after_w * {side} < 0',
    )
    asked = f"""{CAMERA}. The point ({side * a}, {side * b}, {side * c}) has x/w = -{a}/{c} and y/w =
        -{b}/{c}. It is not beyond the far plane. Is it visible?
        Hint: On which side of the eye does the point lie?
        Hint: Two minus signs can cancel.
        Hint: The camera looks along -z: is z = {side * c} in front of it?"""
    return believed(draws, asked, right, [belief], [other], refutation)


@template("belief-viewport-last", 2, "Must the viewport follow the divide?", "transform", 1)
def draw_viewport(draws: Draws) -> Draft:
    """The viewport must follow the divide."""
    d, is_matrix = draws.whole(2, 6), draws.whole(0, 1)
    answers = ("no: the result is another one", "yes: the result is the same")
    sentence, what = (
        (
            f"W/2 as a plain number is not multiplied by w = {d}, so the divide would shrink it. The matrix D "
            "multiplies it by w first.",
            "x W/2 + W/2 and y H/2 + H/2 be computed",
        ),
        (
            f"D keeps w, here {d}: its translation is multiplied by w, too, and the divide removes w from all alike.",
            "the viewport matrix D be applied",
        ),
    )[is_matrix]
    refutation = Refutation(
        sentence,
        _with_point(0, 1, -d),
        "transform",
        f'kind == "camera-to-clip" and vertex == 0 and after_w == {d}',
    )
    asked = f"""{CAMERA}; w of the point (0, 1, -{d}) is {d}. May {what} before the divide by w, instead of
        after it?
        Hint: Compute x of the window in both orders.
        Hint: What does the divide make of the added W/2?
        Hint: D makes W/2 * {d} of its translation W/2; a plain number stays W/2. What is left after the
        divide by {d}?"""
    right, belief = answers[is_matrix], answers[1 - is_matrix]
    return believed(draws, asked, right, [belief], ["only on the left half of the window"], refutation)


@template("belief-depth-linear", 1, "Is depth linear in distance?", "depth", 1)
def draw_linear_depth(draws: Draws) -> Draft:
    """Depth is linear in distance."""
    f, d = draws.item((4, 5, 6, 9, 10, 11)), draws.whole(2, 3)
    right, belief = Fraction(f * (d - 1), (f - 1) * d), Fraction(d - 1, f - 1)
    refutation = Refutation(
        f"Window depth is f (d - n) / ((f - n) d): {number_text(right)} at distance {d}. Most of it is used up near n.",
        _with_point(0, 0, -d, 1, f),
        "transform",
        f'kind == "viewport" and vertex == 0 and after_z > {float(belief)}',
    )
    asked = f"""n = 1, f = {f}, window depth from 0 to 1: what is it at distance {d}?
        Hint: Depth is divided by w, too.
        Hint: What is it at n, and what at f? In between it is linear in 1/d.
        Hint: Window depth is f (d - n) / ((f - n) d), with n = 1, f = {f} and d = {d}."""
    return believed(draws, asked, right, [belief], [1 - right, Fraction(d, f)], refutation)


def _deep(
    w: int, depth: tuple[Fraction, Fraction] = (Fraction(0), Fraction(1))
) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Return depth and w of a triangle from near to far, by the depths of both."""
    near, far = map(float, depth)
    return (near, far, near), (1.0, float(w), 1.0)


WIDE = ((0.5, 0.5), (8.5, 0.5), (0.5, 6.5))
"""A triangle whose bottom edge has its middle at the centre of pixel (4, 0)."""
MIDDLE = "column == 4 and row == 0"


@template("belief-depth-corrected", 2, "Is depth corrected?", "depth", 1)
def draw_corrected_depth(draws: Draws) -> Draft:
    """Depth, like every attribute, needs the perspective correction."""
    w = draws.whole(3, 10)
    near, far = ends = draws.item(
        [(Fraction(a, 4), Fraction(b, 4)) for a, b in ((0, 4), (0, 2), (2, 4), (0, 3))]
    )
    depth, weights = _deep(w, ends)
    right = (near + far) / 2
    refutation = Refutation(
        "Window depth was divided by w already, so it is linear in the window: half of both ends in the middle.",
        triangle_scene([WIDE], (10, 8), depth=[depth], w=[weights]),
        "depth",
        f"{MIDDLE} and z > {float(right) - 0.01} and z < {float(right) + 0.01}",
    )
    first, last = number_text(near), number_text(far)
    asked = f"""An edge runs from window depth {first} (w = 1) to {last} (w = {w}). What is the depth at the
        pixel in its middle?
        Hint: Which values are linear in the window?
        Hint: Is window depth made before the divide, or after it?
        Hint: After the divide by w = 1 and w = {w}, is depth linear in the window? If so, both ends count one
        half: ({first} + {last})/2."""
    belief, turned = (near * w + far) / (w + 1), (near + far * w) / (w + 1)
    return believed(draws, asked, right, [belief], [turned, near + (far - near) / w], refutation)


@template("belief-middle-stays", 1, "Does the middle stay the middle?", "interpolate", 1)
def draw_middle(draws: Draws) -> Draft:
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
    asked = f"""An edge runs from z = -1 to z = -{w}. How far along it from the near end is the point at its
        middle pixel?
        Hint: The far half of the edge looks shorter.
        Hint: 1/w is linear in the window: weigh the ends with it.
        Hint: With u = 0 at the near end and u = 1 at the far end: (1/{w}) / (1/1 + 1/{w})."""
    return believed(draws, asked, right, [Fraction(1, 2)], [1 - right, Fraction(1, w + 2)], refutation)


@template("belief-order-behind", 2, "Depth behind the eye", "clip", 1)
def draw_behind(draws: Draws) -> Draft:
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
    sides = draws.shuffled((-d, d))
    asked = f"""z' = (f + n - 2 f n / d) / (f - n) with n = 1, f = {f}. Is z' at d = {sides[0]} smaller or
        larger than at d = {sides[1]}?
        Hint: Put both in.
        Hint: What is the sign of 2 f n / d behind the eye?
        Hint: Compare 2 * {f} / (-{d}) with 2 * {f} / {d}, each taken away from the same number."""
    right, belief = ("larger", "smaller") if sides[0] < 0 else ("smaller", "larger")
    return believed(draws, asked, right, [belief], ["equal"], refutation)


@template("belief-all-converge", 2, "Do all parallels converge?", "transform", 1)
def draw_parallel(draws: Draws) -> Draft:
    """All parallel lines converge; or none do."""
    d, is_level = draws.whole(2, 7), draws.whole(0, 1)
    stay, meet = "no: they stay parallel", "yes: prolonged, they meet in one point"
    if is_level:
        end, where = d, f"lie in the plane z = -{d}"
        sentence = (
            f"All points of both edges have w = {d}, so all are divided alike, and the edges stay parallel."
        )
        along = f"w = {d} at every point of both edges"
    else:
        end, where = d + 2, f"run straight away from the camera, from z = -{d} to z = -{d + 2}"
        sentence = (
            f"w grows from {d} to {end} along both: the divide pulls both edges towards the same point."
        )
        along = f"w = {d} at one end of both edges and {end} at the other"
    refutation = Refutation(
        sentence,
        eye_scene([(-1, -1, -d), (1, -1, -d), (-1, 1 if is_level else -1, -end)]),
        "transform",
        f'kind == "camera-to-clip" and vertex == 2 and after_w == {end}',
    )
    asked = f"""{CAMERA}. Two parallel edges {where}. Do they meet in the picture?
        Hint: What is w along each of them?
        Hint: Edges meet where they run away from the eye.
        Hint: {along}: what does the divide do to both?"""
    right, belief = (stay, meet) if is_level else (meet, stay)
    return believed(draws, asked, right, [belief], ["only where both are equally long"], refutation)


@template("belief-far-precision", 2, "What costs precision of depth?", "depth", 1)
def draw_far_plane(draws: Draws) -> Draft:
    """The far plane decides the precision."""
    n = draws.item((Fraction(1, 10), Fraction(1, 5), Fraction(1, 2)))
    verb, near, far = draws.item((("costs", "smaller", "larger"), ("gains", "larger", "smaller")))
    is_most = draws.whole(0, 1)
    refutation = Refutation(
        "At a distance of 10 n window depth is 0.9 already, however far f is: n decides how fast depth is used up.",
        _with_point(0, 0, float(-10 * n), float(n), 100.0),
        "transform",
        'kind == "viewport" and vertex == 0 and after_z > 0.9',
    )
    asked = f"""n = {number_text(n)}, f = 100. What {verb} {("less", "more")[is_most]} precision of far
        depths: n made 10 times {near}, or f made 10 times {far}?
        Hint: Window depth is f (d - n) / ((f - n) d).
        Hint: What becomes of it as f grows without limit?
        Hint: For large f depth is nearly (d - {number_text(n)}) / d: which of the two numbers is left?"""
    planes = (f"f made {far}", f"n made {near}")
    right, belief = planes[is_most], planes[1 - is_most]
    return believed(draws, asked, right, [belief], ["both alike", "neither"], refutation)


@template("belief-larger-z", 1, "Which z is nearer?", "transform", 1)
def draw_larger_z(draws: Draws) -> Draft:
    """Larger z is nearer, or farther, always."""
    a = draws.whole(2, 4)
    b = draws.whole(a + 1, 9)
    refutation = Refutation(
        f"The camera looks along -z, so z = -{a} is nearer; only in the window is the smaller value the nearer one.",
        _with_point(0, 0, -a),
        "transform",
        'kind == "world-to-camera" and vertex == 0 and after_z < 0',
    )
    asked = f"""In camera space, after C^-1, which of z = -{a} and z = -{b} is nearer?
        Hint: Which way does the camera look?
        Hint: The rule that smaller is nearer is that of one space alone.
        Hint: How far in front of the camera does z = -{a} lie, and how far z = -{b}?"""
    right, belief, other = f"z = -{a}", f"z = -{b}: the smaller value", "neither: both lie behind"
    return believed(draws, asked, right, [belief], [other], refutation)


@template("belief-left-to-right", 2, "Which factor acts first?", "transform", 1)
def draw_factors(draws: Draws) -> Draft:
    """Factors act from left to right."""
    a, first = draws.whole(2, 4), draws.item("RT")
    model = [list(row) for row in TURN]
    model[2][3] = -5
    if first == "R":
        product, last, height = "T R p", "T", 1
        model[0][3] = a
        sentence = f"T R p turns first: (1, 0) becomes (0, 1), which then moves to ({a}, 1)."
    else:
        product, last, height = "R T p", "R", a + 1
        model[1][3] = a
        sentence = f"R T p moves first: (1, 0) becomes ({a} + 1, 0), which then turns to (0, {a} + 1)."
    refutation = Refutation(
        sentence,
        eye_scene([(1, 0, 0), (0, 0, 0), (0, -1, 0)], model=model),
        "transform",
        f'kind == "object-to-world" and vertex == 0 and after_y > {height - 0.1} and after_y < {height + 0.1}',
    )
    asked = f"""p' = {product} with columns; R turns by 90 degrees, T moves by ({a}, 0), p = (1, 0). Which
        acts first?
        Hint: Put brackets where you would begin to multiply.
        Hint: {last} ({first} p): what is multiplied with p?
        Hint: Compare T (R p) with R (T p): turn (1, 0) and add {a}, or add {a} and turn."""
    return believed(draws, asked, first, [last], ["the order does not matter"], refutation)


@template("belief-own-centre", 1, "About which point does it turn?", "transform", 1)
def draw_own_center(draws: Draws) -> Draft:
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
    asked = f"""A square has its centre at ({a}, 0). R turns by 90 degrees counter-clockwise. Where is its
        centre then?
        Hint: About which point does a rotation matrix turn?
        Hint: Apply R to the centre itself.
        Hint: R maps (x, y) to (-y, x): put in x = {a} and y = 0."""
    draft = believed(draws, asked, f"(0, {a})", [f"({a}, 0)"], [f"(0, -{a})", f"(-{a}, 0)"], refutation)
    square = ((a - 1, -1), (a + 1, -1), (a + 1, 1), (a - 1, 1))
    return replace(draft, sketch=sketched({"centre": (a, 0)}, square))
