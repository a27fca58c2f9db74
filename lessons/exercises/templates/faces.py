"""Culling: by the eye, by the view volume, by the order of the vertices; boxes around triangles."""

from fractions import Fraction
from itertools import permutations

import numpy as np

from core import Settings
from core.geometry.culling import plane_distances
from lessons.exercises.draws import Draws, reject
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import FACES, culled, facing_text, twice_area
from lessons.exercises.templates.drafting import factor_text, listed, numbers, place_text, several
from lessons.exercises.templates.transforms import wholes
from lessons.mistakes.coverage import dropped_at_border
from lessons.mistakes.shelf import RULES, SHELF
from lessons.small_scenes import triangle_scene


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
