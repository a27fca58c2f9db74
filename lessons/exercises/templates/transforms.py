"""Matrices, cameras, projections and the window, by hand."""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from core.records.cells import Sketch
from core.transform.matrices import viewport
from lessons.exercises.answers.choices import OrderAnswer
from lessons.exercises.drafting import by_rule, drafted, factor_text, listed, numbers, place_text
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.mistakes.transforms import Turn

TURNS: tuple[Turn, ...] = tuple(
    (Fraction(c, 5), Fraction(s, 5)) for c, s in ((0, 5), (0, -5), (3, 4), (4, 3), (-3, 4), (3, -4))
)
XY, XYZ, XYZW = ("x", "y"), ("x", "y", "z"), ("x", "y", "z", "w")


def wholes(draws: Draws, count: int, low: int, high: int) -> tuple[Any, ...]:
    """Draw whole numbers."""
    return tuple(Fraction(draws.whole(low, high)) for _ in range(count))


def sketched(points: Mapping[str, Any], *outlines: Sequence[Any]) -> Sketch:
    """Return a sketch of named points and of outlines, in the plane or in space."""
    return Sketch(
        tuple((name, tuple(map(float, place))) for name, place in points.items()),
        tuple(tuple(tuple(map(float, place)) for place in outline) for outline in outlines),
    )


def vectors_sketched(vectors: Mapping[str, Any]) -> Sketch:
    """Return a sketch of named vectors from the origin of space."""
    return sketched(vectors, *(((0, 0, 0), vector) for vector in vectors.values()))


def turn_text(turn: Turn) -> str:
    """Return an angle by its cosine and sine."""
    c, s = turn
    return f"cosine {number_text(c)} and sine {number_text(s)}"


@template("turn-and-move", 1, "A point turned and moved", "transform", 2)
def draw_order(draws: Draws) -> Draft:
    """T R p."""
    turn, shift, point = draws.item(TURNS), wholes(draws, 2, -4, 4), wholes(draws, 2, -4, 4)
    given = f"R turns by the angle with {turn_text(turn)}.\nT moves by {place_text(shift)}.\np = {place_text(point)}"
    (c, s), (x, y) = map(factor_text, turn), map(factor_text, point)
    turned = f"{c} * {x} - {s} * {y}"
    asked = f"""Where does p' = T R p lie? Vectors are columns, and a positive angle turns counter-clockwise.
        Hint: Which factor stands next to p?
        Hint: R p = (c x - s y, s x + c y) with the cosine c and the sine s.
        Hint: Turn p first, then add the shift.
        Hint: x' = {turned} + {factor_text(shift[0])}; y' likewise."""
    names, sketch = ("factors-reversed", "turned-clockwise"), sketched({"p": point})
    return by_rule(asked, given, (turn, shift, point), names, XY, sketch=sketch)


@template("turn-about-pivot", 1, "A turn about a point", "transform", 2)
def draw_pivot(draws: Draws) -> Draft:
    """A turn about a point."""
    turn, pivot, point = draws.item(TURNS), wholes(draws, 2, -4, 4), wholes(draws, 2, -4, 4)
    given = f"Angle with {turn_text(turn)}.\nPivot: {place_text(pivot)}\nPoint: {place_text(point)}"
    asked = f"""A point is turned about a pivot, counter-clockwise. Where does it land?
        Hint: Three transforms do it.
        Hint: Move the pivot to the origin, turn, move back.
        Hint: v = {place_text(point)} - {place_text(pivot)}; turn v, then add {place_text(pivot)}."""
    sketch = sketched({"pivot": pivot, "point": point})
    return by_rule(asked, given, (turn, pivot, point), ("pivot-left-out",), XY, sketch=sketch)


@template("turn-by-degrees", 1, "A turn by degrees", "transform", 2)
def draw_degrees(draws: Draws) -> Draft:
    """An angle in degrees."""
    degrees, point = draws.item((30, 45, 60, 90, 120, 135, 150)), wholes(draws, 2, -4, 4)
    given = f"Angle: {degrees} degrees.\nPoint: {place_text(point)}"
    asked = f"""A point is turned about the origin, counter-clockwise. Where does it land?
        Hint: x' = cos x - sin y, y' = sin x + cos y.
        Hint: Does your calculator take degrees?
        Hint: x' = cos({degrees}°) * {factor_text(point[0])} - sin({degrees}°) * {factor_text(point[1])}."""
    arguments, sketch = (degrees, tuple(map(float, point))), sketched({"point": point})
    return by_rule(asked, given, arguments, ("degrees-for-radians",), XY, sketch=sketch)


@template("scale-and-move", 1, "Scaling and moving as a matrix", "transform", 3)
def draw_scaling(draws: Draws) -> Draft:
    """T S as a matrix."""
    scale, shift = wholes(draws, 2, 2, 5), wholes(draws, 2, -4, 4)
    given = f"S scales by {place_text(scale)}.\nT moves by {place_text(shift)}."
    asked = f"""Write T S as a matrix of 3 rows and 3 columns for homogeneous points (x, y, 1) of the plane. S
        acts first. The 9 numbers stand row by row.
        Hint: What happens to the origin?
        Hint: The last column is where the origin goes.
        Hint: x' = {factor_text(scale[0])} x + {factor_text(shift[0])} is the first row times (x, y, 1)."""
    return by_rule(asked, given, (scale, shift), ("scaled-after-moving",), shape=(3, 3))


@template("translation-product", 1, "Translation with four coordinates", "transform", 2)
def draw_translation(draws: Draws) -> Draft:
    """T p with four coordinates."""
    shift, point = wholes(draws, 3, -4, 4), wholes(draws, 3, -4, 4)
    given = f"T moves by {place_text(shift)}.\n(x, y, z) = {place_text(point)}"
    asked = f"""What is T p for the column vector p = (x, y, z, 1)?
        Hint: Write T down with its ones.
        Hint: The shift stands in the last column: row k gives component k.
        Hint: x' = 1 * {factor_text(point[0])} + 0 * y + 0 * z + {factor_text(shift[0])} * 1; y' and z'
        likewise."""
    return by_rule(asked, given, (shift, point), ("matrix-transposed", "ones-missing"), XYZW)


@template("camera-space", 1, "A point in camera space", "transform", 3)
def draw_camera(draws: Draws) -> Draft:
    """C^-1 p."""
    c, s = draws.item(TURNS)
    eye, point = wholes(draws, 3, -4, 4), wholes(draws, 3, -4, 4)
    right, up, backward = (c, Fraction(0), -s), (Fraction(0), Fraction(1), Fraction(0)), (s, Fraction(0), c)
    distance = 5 * draws.whole(1, 2)
    target = tuple(e - distance * b for e, b in zip(eye, backward, strict=True))
    given = (
        f"Eye: {place_text(eye)}, target: {place_text(target)}\nThe camera's axes in the world: right "
        f"{place_text(right)}, up {place_text(up)}, backward {place_text(backward)}\np = {place_text(point)}"
    )
    asked = f"""Where is p in camera space, C^-1 p? The camera looks along -z of its own space.
        Hint: Begin with the vector from the eye to p.
        Hint: Each coordinate is its dot product with one axis.
        Hint: p - eye = {place_text(point)} - {place_text(eye)}."""
    names = ("eye-not-turned", "target-for-eye", "camera-not-inverted")
    arguments = ((right, up, backward), eye, target, point)
    sketch = sketched({"eye": eye, "target": target, "p": point}, (eye, target))
    return by_rule(asked, given, arguments, names, XYZ, sketch=sketch)


@template("clip-position", 1, "The perspective projection", "transform", 4)
def draw_projection(draws: Draws) -> Draft:
    """P p."""
    half = draws.item((Fraction(1, 2), Fraction(1, 3), Fraction(3, 4)))
    aspect = draws.item((Fraction(4, 3), Fraction(3, 2), Fraction(2)))
    near, far = draws.whole(1, 2), draws.item((4, 5, 10))
    point = (*wholes(draws, 2, 1, 5), -Fraction(draws.whole(2, 8)))
    given = (
        f"tan(fov/2) = {number_text(half)}, width over height = {number_text(aspect)}, n = {near}, f = {far}\n"
        f"p in camera space: {place_text(point)}"
    )
    asked = f"""What is the clip position of p under the perspective projection P? w = -z, and z' runs from -w
        at the near plane to w at the far plane: z' = -((f + n) z + 2 f n)/(f - n).
        Hint: The camera looks along -z: what is w?
        Hint: y' = y / tan(fov/2), and x' is divided by the aspect, too.
        Hint: near and far are positive distances.
        Hint: y' = {factor_text(point[1])} / ({factor_text(half)}), and z' has f + n = {far} + {near}."""
    names = ("angle-not-halved", "aspect-inverted", "near-far-signs", "w-is-one")
    return by_rule(asked, given, (half, aspect, near, far, point), names, XYZW)


@template("divide-by-w", 1, "The divide by w", "transform", 2)
def draw_divide(draws: Draws) -> Draft:
    """The divide by w."""
    w = Fraction(draws.item((2, 4, 5, 8)))
    clip = (*(Fraction(draws.whole(-int(w), int(w))) for _ in range(3)), w)
    asked = f"""What are the normalized device coordinates of this clip position?
        Hint: Which of the four numbers divides the others?
        Hint: x/w, y/w and z/w.
        Hint: {factor_text(clip[0])}/{w}, {factor_text(clip[1])}/{w} and {factor_text(clip[2])}/{w}."""
    names = ("clip-for-ndc", "z-not-divided")
    return by_rule(asked, f"Clip position: {place_text(clip)}", (clip,), names, XYZ)


@template("viewport-matrix", 1, "The viewport matrix", "transform", 3)
def draw_matrix(draws: Draws) -> Draft:
    """D, filled in."""
    width, height = draws.whole(3, 20) * 2, draws.whole(3, 20) * 2
    right = [Fraction(float(c)) for c in viewport(width, height).ravel()]
    asked = f"""Fill in the viewport matrix D, 4 rows and 4 columns, for column vectors: x and y of NDC go to
        pixels, z goes from [-1, 1] to [0, 1]. The 16 numbers stand row by row.
        Hint: Each of x, y and z is scaled, then moved.
        Hint: The lower border -1 goes to 0, the upper border 1 to W, H and 1.
        Hint: x: {width}/2 * NDC + {width}/2; y: {height}/2 * NDC + {height}/2; z: 1/2 * NDC + 1/2."""
    return numbers(asked, f"Window of W = {width} and H = {height} pixels.", right, shape=(4, 4))


@template("matrix-of-images", 1, "The matrix from three images", "transform", 3)
def draw_map(draws: Draws) -> Draft:
    """A transform from what it does to three points."""
    origin, first, second = (wholes(draws, 2, -4, 4) for _ in range(3))
    columns = [[a - o for a, o in zip(end, origin, strict=True)] for end in (first, second)] + [list(origin)]
    reject(columns[0][0] * columns[1][1] == columns[0][1] * columns[1][0])
    given = f"(0, 0) -> {place_text(origin)}\n(1, 0) -> {place_text(first)}\n(0, 1) -> {place_text(second)}"
    asked = f"""Which 2 x 3 matrix maps one triangle to the other? It is multiplied with (x, y, 1); row by
        row.
        Hint: Where does the origin go?
        Hint: The other columns are the images of the axes, less that of the origin.
        Hint: The last column is {place_text(origin)}, the first {place_text(first)} -
        {place_text(origin)}."""
    right = [columns[column][row] for row in range(2) for column in range(3)]
    corners = {"of (0, 0)": origin, "of (1, 0)": first, "of (0, 1)": second}
    sketch = sketched(corners, ((0, 0), (1, 0), (0, 1)), (origin, first, second))
    return numbers(asked, given, right, shape=(2, 3), sketch=sketch)


@template("shader-scaling", 1, "A vertex shader that scales", "transform", 2)
def draw_shader(draws: Draws) -> Draft:
    """The scaling vertex shader of the lecture."""
    vertex, shift = wholes(draws, 3, -6, 6), wholes(draws, 3, -6, 6)
    scale = (Fraction(3, 2), Fraction(1, 2), Fraction(2))
    right = [s * c + m for s, c, m in zip(scale, vertex, shift, strict=True)]
    wrong = {"scaled-after-moving": [s * (c + m) for s, c, m in zip(scale, vertex, shift, strict=True)]}
    given = f"position = {place_text(vertex)}\nmodelViewMatrix moves by {place_text(shift)}."
    asked = f"""A vertex shader computes modelViewMatrix * vec4(position.x * 1.5, position.y * 0.5, position.z
        * 2.0, 1.0). What are its x, y and z?
        Hint: What stands inside of vec4 is computed first.
        Hint: Scale each coordinate, then add the shift.
        Hint: x = {factor_text(vertex[0])} * 1.5 + {factor_text(shift[0])}, y and z likewise."""
    return numbers(asked, given, right, wrong, XYZ)


@template("skinning", 1, "Two bones and a vertex", "transform", 2)
def draw_skinning(draws: Draws) -> Draft:
    """Two bones."""
    places = wholes(draws, 2, 10, 60)
    weights = tuple(Fraction(draws.whole(2, 9), 10) for _ in range(2))
    given = listed("Bone {k}: weight {}, x = {}", weights, places)
    products = " + ".join(f"{number_text(w)} * {x}" for w, x in zip(weights, places, strict=True))
    asked = f"""Two bones move a vertex to these places. What is its x? The weights may not sum to 1: divide
        by their sum.
        Hint: Sum the products of weight and x.
        Hint: Divide by the sum of the weights.
        Hint: ({products}) / ({" + ".join(map(number_text, weights))})."""
    return by_rule(asked, given, (weights, places), ("weights-not-normalized",))


@template("equal-sizes", 1, "Sizes that look alike", "transform", 1)
def draw_size(draws: Draws) -> Draft:
    """Sizes that look alike."""
    height, near, times = draws.whole(1, 6), draws.whole(1, 5), draws.whole(2, 5)
    given = f"First pole: {height} m high, at distance {near} m.\nSecond pole: at distance {near * times} m."
    asked = f"""How high must the second pole be to look as high as the first one under perspective?
        Hint: What is constant along a ray from the eye?
        Hint: Size in the picture is height over distance.
        Hint: {height} / {near} must be equal to the height over {near * times}."""
    return numbers(asked, given, [height * times])


def ordered(asked: str, options: tuple[str, ...], draws: Draws) -> Draft:
    """Ask for an order; the question lists the options in another one."""
    shown = draws.shuffled(options)
    return drafted(asked, "", OrderAnswer(options, shown))


def drawn_from(things: tuple[str, ...], draws: Draws) -> tuple[str, ...]:
    """Return four of some things in their order."""
    kept = draws.shuffled(things)[:4]
    return tuple(thing for thing in things if thing in kept)


@template("space-order", 2, "Spaces of a vertex", "transform", 2)
def draw_spaces(draws: Draws) -> Draft:
    """Four of the spaces of a vertex."""
    spaces = drawn_from(("object space", "world space", "camera space", "clip space", "NDC", "window"), draws)
    asked = """In which order does a vertex go through these spaces? First to last.
        Hint: Which space is the model built in?
        Hint: The divide by w leads from clip space to NDC.
        Hint: M, C^-1, P, the divide and D each lead from one space to the next."""
    return ordered(asked, spaces, draws)


@template("factor-order", 2, "What acts first", "transform", 2)
def draw_factors(draws: Draws) -> Draft:
    """What acts on a vertex first."""
    steps = drawn_from(("M", "C^-1", "P", "divide by w", "D"), draws)
    asked = """In which order do these act on a vertex? First to last.
        Hint: In p' = D P C^-1 M p the factor next to p acts first.
        Hint: The divide follows the projection.
        Hint: Read D P C^-1 M p from the right, and put the divide in after P."""
    return ordered(asked, steps, draws)
