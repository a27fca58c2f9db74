"""Points to place: where a clipped segment ends, and a corner that is found again from its pixels."""

from fractions import Fraction

from core import Settings, clip_lines
from lessons.exercises.answers.marked import PlaceAnswer
from lessons.exercises.drafting import DrawnScene, drafted, factor_text, run_exactly, window_text
from lessons.exercises.file_answers import corner_answer
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.clipping import PARAMETERS, SIZE, cut_ends, segment_text
from lessons.exercises.templates.coverage import RULE, corner_text, twice_area
from lessons.exercises.templates.fragments import NAMES
from lessons.mistakes.shelf import RULES, SHELF
from lessons.mistakes.transforms import dot
from lessons.small_scenes import segment_scene, triangle_scene

TOLERANCE = 0.15
"""In pixels: more than half a step of 1/4, so that the nearest place that the mouse can reach counts."""
WEIGHT_TOLERANCE = 0.25


@template("clip-ends", 2, "Ends of a clipped segment", "raster", 4)
def draw_ends(draws: Draws) -> Draft:
    """The two ends of a clipped segment."""
    ends = cut_ends(draws)
    left, _ = run_exactly("line_clipping", "cohen-sutherland", *ends[0], *ends[1], 0, 0, *SIZE)
    right = tuple(map(tuple, left))
    wrong = {}
    for name in ("ends-clamped", "crossings-rounded", "cut-once"):
        method = SHELF[name].change_settings(PARAMETERS).line_clipping
        places = clip_lines([ends], (0, 0, *SIZE), method).segments[0].tolist()
        # One cut may leave an end outside, where no point can be placed.
        if all(0 <= x <= SIZE[0] and 0 <= y <= SIZE[1] for x, y in places):
            wrong[name] = tuple((Fraction(x), Fraction(y)) for x, y in places)
    x0, x1 = (factor_text(Fraction(x)) for x, _ in ends)
    asked = f"""The segment is clipped to the window. Place its two ends that are left: where it enters and
        where it leaves. They lie on the line through the given ends.
        Hint: Which borders does the segment cross on its way in, and which on its way out?
        Hint: Of the crossings on the way in the last one counts, of those on the way out the first.
        Hint: Left border: t = (0 - {x0}) / ({x1} - {x0}), and the crossing lies at start + t (end -
        start)."""
    answer = PlaceAnswer(SIZE, ("entry", "exit"), right, (right[::-1],), Fraction(1, 4), TOLERANCE)
    return drafted(asked, segment_text(ends), answer, wrong, segment_scene([ends], SIZE), PARAMETERS)


CORNER_SIZE = (12, 9)


@template("corner-from-pixels", 1, "The corner behind the pixels", "raster", 3)
def draw_corner(draws: Draws) -> Draft:
    """A corner of a triangle, from the pixels that it covers."""
    quarter = Fraction(1, 4)
    corners = [
        (draws.step(quarter, Fraction(47, 4), quarter), draws.step(quarter, Fraction(35, 4), quarter))
        for _ in range(3)
    ]
    reject(twice_area(corners) < 24)
    drawn = DrawnScene(triangle_scene([corners], CORNER_SIZE), (tuple(corners),))
    hidden = draws.whole(0, 2)
    known = [corner for k, corner in enumerate(corners) if k != hidden]
    answer, given = corner_answer(drawn, (0, hidden), Settings(), quarter)
    asked = f"""Place the corner ? so that triangle 0 covers exactly the pixels A. {RULE}
        Hint: Draw the side between the two corners that are given.
        Hint: Each of the other two sides passes between pixels that are covered and pixels that are not.
        Hint: Prolong both sides from the given corners {corner_text(known)}: they meet in the corner."""
    return drafted(asked, given, answer)


@template("place-ndc", 2, "Points of NDC in the window", "transform", 2)
def draw_ndc(draws: Draws) -> Draft:
    """Three points of NDC in the window."""
    points = [(Fraction(draws.whole(-4, 4), 4), Fraction(draws.whole(-4, 4), 4)) for _ in range(3)]
    reject(len({y for _, y in points}) < 3 or any(y == 0 for _, y in points))
    columns, rows = SIZE
    right = tuple(((x + 1) / 2 * columns, (y + 1) / 2 * rows) for x, y in points)
    wrong = {
        "y-down": tuple((x, rows - y) for x, y in right),
        "window-one-less": tuple(((x + 1) / 2 * (columns - 1), (y + 1) / 2 * (rows - 1)) for x, y in points),
    }
    given = f"{window_text(SIZE)} " + ", ".join(
        f"{name}: {corner_text([point])}" for name, point in zip("ABC", points, strict=True)
    )
    asked = f"""Place these points of NDC in the window.
        Hint: -1 is the left and the lower border, 1 the right and the upper one.
        Hint: The window is (NDC + 1)/2.
        Hint: A: x = ({factor_text(points[0][0])} + 1)/2 * {columns}, y = ({factor_text(points[0][1])} + 1)/2
        * {rows}."""
    answer = PlaceAnswer(SIZE, tuple("ABC"), right, step=Fraction(1, 4), tolerance=TOLERANCE)
    return drafted(asked, given, answer, wrong)


@template("place-weights", 1, "The point behind the weights", "interpolate", 2)
def draw_weights(draws: Draws) -> Draft:
    """The point that some weights mean."""
    corners = [(Fraction(draws.whole(0, 12)), Fraction(draws.whole(0, 9))) for _ in range(3)]
    beta, gamma = Fraction(draws.whole(1, 5), 8), Fraction(draws.whole(1, 5), 8)
    weights = (1 - beta - gamma, beta, gamma)
    reject(twice_area(corners) < 24 or weights[0] <= 0 or len(set(weights)) < 2)
    x, y = zip(*corners, strict=True)
    place, turned = ((dot(order, x), dot(order, y)) for order in (weights, (*weights[1:], weights[0])))
    shown = ", ".join(f"{name} = {number_text(weight)}" for name, weight in zip(NAMES, weights, strict=True))
    given = f"{window_text(CORNER_SIZE)}\nVertices 0, 1, 2: {corner_text(corners)}\n{shown}"
    sum_text = " + ".join(
        f"{number_text(weight)} * {number_text(x)}" for weight, (x, _) in zip(weights, corners, strict=True)
    )
    asked = f"""Place the point with these barycentric weights; alpha belongs to vertex 0.
        Hint: With equal weights the point is in the middle; it moves towards the vertex that weighs more.
        Hint: The point is the sum of weight times vertex.
        Hint: x = {sum_text}, and y likewise."""
    answer = PlaceAnswer(CORNER_SIZE, ("point",), (place,), step=Fraction(1, 4), tolerance=WEIGHT_TOLERANCE)
    scene = triangle_scene([corners], CORNER_SIZE)
    return drafted(asked, given, answer, {"weights-permuted": (turned,)}, scene)


BORDER = 8


@template("new-corners", 1, "New corners at a border", "clip", 3)
def draw_new_corners(draws: Draws) -> Draft:
    """The two corners that a border makes of a triangle with one vertex inside."""
    corners = [
        (draws.whole(0, 6), draws.whole(0, 9)),
        *((draws.whole(9, 12), draws.whole(0, 9)) for _ in "BC"),
    ]
    exact = [(Fraction(x), Fraction(y)) for x, y in corners]
    rule = RULES["clipped-in-place"]
    reject(twice_area(exact) < 12)
    (x0, y0), (x1, y1) = corners[:2]
    asked = f"""A triangle is clipped at the border x = {BORDER}: only vertex 0, on the left of it, is inside.
        Place the two new corners, where the sides from 0 to 1 and from 2 to 0 cross the border.
        Hint: What is x of both corners?
        Hint: t = ({BORDER} - x0) / (x - x0) of each side, from vertex 0 to its other end.
        Hint: On side 0 to 1, from {corners[0]} to {corners[1]}: t = ({BORDER} - {x0}) / ({x1} - {x0}), y =
        {y0} + t ({y1} - {y0})."""
    names = ("on side 0 to 1", "on side 2 to 0")
    answer = PlaceAnswer(CORNER_SIZE, names, rule.right(exact, BORDER), (), Fraction(1, 4), TOLERANCE)
    given = f"{window_text(CORNER_SIZE)}\nVertices 0, 1, 2: {corner_text(exact)}"
    scene = triangle_scene([corners], CORNER_SIZE)
    return drafted(asked, given, answer, {rule.name: rule.wrong(exact, BORDER)}, scene)
