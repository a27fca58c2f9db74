"""Which pixels a triangle covers, which way it faces, and what is culled before: planes, boxes, determinants."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import permutations

import numpy as np

from core import Settings, render
from core.culling.culling import plane_distances
from core.scene import ClipScene
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.drafting import drafted, factor_text, listed, numbers, pictured, place_text, several
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.transforms import wholes
from lessons.mistakes.coverage import dropped_at_border
from lessons.mistakes.shelf import RULES, SHELF
from lessons.small_scenes import triangle_scene

# Which pixels a triangle covers, and which way it faces.


Corner = tuple[Fraction, Fraction]
SIZE = (12, 9)
RULE = (
    "A pixel is covered where its centre (i + 1/2, j + 1/2) lies inside. A centre on an edge belongs to the triangle "
    "that contains the point moved a tiny step right, then up: left edges and level bottom edges own theirs."
)


def corner_text(corners: Sequence[Corner]) -> str:
    """Return corners as text."""
    return ", ".join(map(place_text, corners))


def twice_area(corners: Sequence[Corner]) -> Fraction:
    """Return the determinant: positive where the corners run counter-clockwise."""
    (x0, y0), (x1, y1), (x2, y2) = corners
    return (x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0)


def crossing_text(start: Corner, end: Corner, y: str = "j + 1/2") -> str:
    """Return the x of a line through two points at a height, as an expression in numbers."""
    (x0, y0), (x1, y1) = (map(factor_text, corner) for corner in (start, end))
    return f"{x0} + ({y} - {y0}) ({x1} - {x0}) / ({y1} - {y0})"


def row_hint(corners: Sequence[Corner], y: str = "j + 1/2") -> str:
    """Say where the highest side crosses the centres of a row."""
    sides = zip(corners, [*corners[1:], corners[0]], strict=True)
    side = max(sides, key=lambda ends: abs(ends[1][1] - ends[0][1]))
    start, end = (corner_text([corner]) for corner in side)
    return f"At y = {y} the side from {start} to {end} is at x = {crossing_text(*side, y)}"


def _covered(corners: list[Corner], asked: str, names: tuple[str, ...]) -> Draft:
    """Ask for the pixels of a triangle that is neither small nor clockwise."""
    reject(twice_area(corners) < 16)
    scene = triangle_scene([corners], SIZE)
    return pictured(asked, f"Triangle A: {corner_text(corners)}", scene, names)


@template("triangle-coverage", 2, "Pixels of a triangle", "raster", 4)
def draw_triangle(draws: Draws) -> Draft:
    """A triangle with corners on half pixels, so that edges meet centres."""
    half = Fraction(1, 2)
    corners = [(draws.step(half, Fraction(11), half), draws.step(half, Fraction(8), half)) for _ in range(3)]
    names = ("corner-for-center", "all-edges-inclusive", "all-edges-exclusive", "y-down", "vertices-rounded")
    asked = f"""Which pixels does triangle A cover? {RULE}
        Hint: Look at one row of centres at a time: y = j + 1/2.
        Hint: In a row, the centres between the crossings of two edges are covered.
        Hint: {row_hint(corners)}. A centre there belongs to the triangle if this is a left edge."""
    return _covered(corners, asked, names)


@template("shared-edge", 2, "Centres on a shared edge", "raster", 4)
def draw_shared_edge(draws: Draws) -> Draft:
    """One of two triangles whose common edge runs through centres."""
    half = Fraction(1, 2)
    left, right = draws.whole(0, 3) + half, draws.whole(7, 10) + half
    low, high = draws.whole(0, 2) + half, draws.whole(5, 7) + half
    is_upper = draws.fraction() < 0.5
    lower = [(left, low), (right, low), (right, high)]
    upper = [(left, low), (right, high), (left, high)]
    mine, other = (upper, lower) if is_upper else (lower, upper)
    # The level edge of the lower triangle is its bottom edge, which owns its centres.
    level = "level-edges-always" if is_upper else "level-edges-never"
    names = ("all-edges-inclusive", "all-edges-exclusive", level)
    asked = f"""Triangles A and B share an edge. Which pixels belong to triangle A? {RULE}
        Hint: Find the centres on the common edge first, then those on the sides.
        Hint: Of the two triangles exactly one owns each of the centres between them.
        Hint: At y = j + 1/2 the common edge is at x = {crossing_text((left, low), (right, high))}: is
        triangle A on its right or on its left?"""
    draft = _covered(mine, asked, names)
    both = triangle_scene([mine, other], SIZE)
    return replace(draft, given=f"{draft.given}\nTriangle B: {corner_text(other)}", outlined=both)


FACES = tuple("ABCD")
FACING_SIZE = (24, 7)


def facing_text(corners: Sequence[Corner]) -> str:
    """Return the determinant as an expression in numbers."""
    (x0, y0), (x1, y1), (x2, y2) = (map(factor_text, corner) for corner in corners)
    return f"({x1} - {x0})({y2} - {y0}) - ({y1} - {y0})({x2} - {x0})"


@template("facing", 1, "Facing by the determinant", "cull", 2)
def draw_facing(draws: Draws) -> Draft:
    """Triangles side by side, of which some face away."""
    triangles = [
        [(Fraction(6 * k + draws.whole(0, 5)), Fraction(draws.whole(0, 6))) for _ in range(3)]
        for k in range(len(FACES))
    ]
    areas = [twice_area(corners) for corners in triangles]
    reject(min(map(abs, areas)) < 5)
    away = frozenset(k for k, area in enumerate(areas) if area < 0)
    reject(not 1 <= len(away) <= 3)
    scene = triangle_scene(triangles, FACING_SIZE)
    settings = Settings(cull="back")
    wrong = culled(SHELF["facing-exchanged"].change_settings(settings), scene)
    given = listed("{}: {}", FACES, triangles)
    asked = f"""Which triangles are back faces? Counter-clockwise corners, y up, are the front: the
        determinant (x1 - x0)(y2 - y0) - (y1 - y0)(x2 - x0) is positive.
        Hint: Sketch each triangle with its corners in order.
        Hint: The sign of the determinant decides, not its size.
        Hint: For A: {facing_text(triangles[0])}."""
    answer = ChoiceAnswer(FACES, away, is_several=True)
    return drafted(asked, given, answer, {"facing-exchanged": wrong}, scene, settings)


def culled(settings: Settings, scene: ClipScene) -> frozenset[int]:
    """Return the triangles of a scene of which no pixel is seen."""
    seen = set(np.unique(render(scene, settings).primitive).tolist())
    return frozenset(range(len(scene.clip))) - seen


# Culling: by the eye, by the view volume, by the order of the vertices; boxes around triangles.


@template("face-order", 1, "Vertex orders that face away", "cull", 2)
def draw_order(draws: Draws) -> Draft:
    """Vertex orders that face the camera."""
    corners = [(Fraction(draws.whole(0, 5)), Fraction(draws.whole(0, 5))) for _ in range(3)]
    reject(abs(twice_area(corners)) < 5)
    orders = list(permutations(range(3)))
    placed = [[(corners[k][0] + 6 * n, corners[k][1]) for k in order] for n, order in enumerate(orders)]
    scene, settings = triangle_scene(placed, (36, 6)), Settings(cull="back")
    back = culled(settings, scene)
    wrong = culled(SHELF["facing-exchanged"].change_settings(settings), scene)
    given = listed("Vertex {k}: {}", corners)
    asked = f"""A face lists the three vertices in some order. For which orders is it culled as a back face?
        The camera looks at the page, x to the right, y up; counter-clockwise is the front.
        Hint: Sketch the vertices and go round in one of the orders.
        Hint: Turning the list by one changes nothing; exchanging two of it changes the facing.
        Hint: For the order 0, 1, 2: {facing_text(corners)}."""
    options = [", ".join(map(str, order)) for order in orders]
    return several(asked, given, options, back, {"facing-exchanged": wrong})


@template("faces-from-eye", 1, "Faces that face away from the eye", "cull", 3)
def draw_eye(draws: Draws) -> Draft:
    """N . V for faces seen in perspective."""
    eye = wholes(draws, 3, -2, 2)
    faces = [
        (wholes(draws, 3, -3, 3), (*wholes(draws, 2, -9, 9), Fraction(-draws.whole(3, 9)))) for _ in FACES
    ]
    rays = [[p - e for p, e in zip(point, eye, strict=True)] for _, point in faces]
    cosines = [
        sum(n * r for n, r in zip(face[0], ray, strict=True)) for face, ray in zip(faces, rays, strict=True)
    ]
    reject(not all(cosines) or not all(normal[2] for normal, _ in faces))
    given = f"Eye: {place_text(eye)}\n" + listed("{}: N = {}, point {}", FACES, *zip(*faces, strict=True))
    axes = zip(*faces[0], eye, strict=True)
    dot = " + ".join("{} ({} - {})".format(*map(factor_text, axis)) for axis in axes)
    asked = f"""Which faces are culled? N points outward, V from the eye to a point of the face: a face is
        culled where N . V > 0.
        Hint: V is another one for each face.
        Hint: V = point - eye.
        Hint: For A: N . V = {dot}. Only its sign counts."""
    rule = RULES["view-direction-fixed"]
    wrong = {rule.name: rule.wrong(faces, eye)}
    return several(asked, given, FACES, rule.right(faces, eye), wrong)


WINDOW = (8, 6)


@template("outside-one-border", 1, "Triangles outside of one border", "cull", 3)
def draw_outside(draws: Draws) -> Draft:
    """Triangles outside of one border."""
    triangles = [
        [(Fraction(draws.whole(-4, 12)), Fraction(draws.whole(-4, 10))) for _ in range(3)] for _ in FACES
    ]
    reject(min(abs(twice_area(corners)) for corners in triangles) < 5)
    scene = triangle_scene(triangles, WINDOW)
    outside = np.asarray(plane_distances(scene.clip) < 0)
    dropped = np.flatnonzero(np.any(np.all(outside, axis=1), axis=1)).tolist()
    collapsed = (dropped_at_border(scene).clip != scene.clip).any(axis=(1, 2))
    given = f"Window 0..{WINDOW[0]} x 0..{WINDOW[1]}.\n" + listed("{}: {}", FACES, triangles)
    xs, ys = zip(*triangles[0], strict=True)
    asked = f"""Which triangles are dropped because all three vertices lie outside of one border of the
        window? A point on a border is inside.
        Hint: Test one border at a time.
        Hint: A triangle with vertices outside of two borders may still reach into the window.
        Hint: A has x = {place_text(xs)}: all below 0, or all above {WINDOW[0]}? y = {place_text(ys)}: all
        below 0, or all above {WINDOW[1]}?"""
    wrong = {"dropped-at-border": np.flatnonzero(collapsed).tolist()}
    return several(asked, given, FACES, dropped, wrong, scene)


@template("bounding-box", 1, "An axis-aligned bounding box", "cull", 1)
def draw_box(draws: Draws) -> Draft:
    """An axis-aligned bounding box."""
    corners = [wholes(draws, 3, -9, 9) for _ in range(3)]
    right = [pick(corner[axis] for corner in corners) for pick in (min, max) for axis in range(3)]
    xs = ", ".join(number_text(corner[0]) for corner in corners)
    asked = f"""What is the axis-aligned bounding box of this triangle: the least x, y and z, then the
        greatest?
        Hint: Look at one coordinate at a time.
        Hint: Least and greatest of the three vertices.
        Hint: min({xs}) to max({xs}) in x, and so on."""
    names = [f"{kind} {axis}" for kind in ("least", "greatest") for axis in "xyz"]
    return numbers(asked, "\n".join(map(place_text, corners)), right, names=names)


@template("homogeneous-determinant", 1, "The determinant of (x, y, w)", "cull", 3)
def draw_determinant(draws: Draws) -> Draft:
    """The determinant of (x, y, w)."""
    rows = [(*wholes(draws, 2, -4, 4), Fraction(draws.item((1, 2, 3, -1)))) for _ in range(3)]
    (a, b, c), (d, e, f), (g, h, i) = rows
    determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    reject(not determinant)
    given = listed("Vertex {k}: {}", rows)
    (x0, _, _), (_, y1, w1), (_, y2, w2) = (map(factor_text, row) for row in rows)
    first = f"The first product is {x0} ({y1} * {w2} - {w1} * {y2})."
    asked = f"""What is the determinant of the matrix whose rows are (x, y, w) of the vertices? It is negative
        for a back face, whatever the signs of w, and 0 where there is nothing to draw.
        Hint: Nothing is divided by w.
        Hint: Expand along one row: three products with 2 x 2 determinants.
        Hint: {first}"""
    return numbers(asked, given, [determinant])
