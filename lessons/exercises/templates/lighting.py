"""Light: how bright a point is, its normal, and where light is evaluated."""

from fractions import Fraction
from typing import Any

from lessons.exercises.draws import Draws, reject
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.drafting import TOLERANCE, by_rule, factor_text, numbers, one_of, place_text
from lessons.exercises.templates.transforms import XYZ, vectors_sketched, wholes
from lessons.mistakes.shelf import RULES
from lessons.mistakes.transforms import dot

VECTORS: tuple[tuple[Any, ...], ...] = (
    (0, 0, 1),
    (0, 3, 4),
    (3, 0, 4),
    (0, -3, 4),
    (4, 0, 3),
    (2, 1, 2),
    (1, 2, 2),
    (-2, 2, 1),
)


@template("lambert", 2, "Diffuse light", "shade", 2)
def draw_lambert(draws: Draws) -> Draft:
    """Diffuse light at a point that faces the light, and at one that faces away."""
    ambient = Fraction(draws.whole(1, 3), 4)
    facing, away, to_light = (draws.item(VECTORS) for _ in range(3))
    normals = tuple(2 * c for c in facing), tuple(-c for c in away)
    reject(dot(facing, to_light) <= 0 or dot(away, to_light) <= 0 or facing == to_light)
    given = (
        f"a = {number_text(ambient)}\nNormal at P: {place_text(normals[0])}\nNormal at Q: {place_text(normals[1])}\n"
        f"To the light: {place_text(to_light)}"
    )
    asked = f"""How bright are the points P and Q? The light is a + (1 - a) max(0, N . L), with N and L of
        length 1; L points to the light.
        Hint: Make N and L of length 1: N . L is the cosine between them.
        Hint: Which sign does it have at P, and at Q?
        Hint: Light from behind adds nothing, and takes nothing away.
        Hint: At P the light is {factor_text(ambient)} + (1 - {factor_text(ambient)}) max(0, N . L)."""
    places = [(float(ambient), normal, to_light) for normal in normals]
    right = [number for place in places for number in RULES["light-reversed"].right(*place)]
    wrong = {
        name: [number for place in places for number in RULES[name].wrong(*place)]
        for name in ("normal-too-long", "light-unclamped", "light-reversed")
    }
    sketch = vectors_sketched({"N at P": normals[0], "N at Q": normals[1], "L": to_light})
    return numbers(asked, given, right, wrong, ("P", "Q"), sketch=sketch)


@template("normal-between", 1, "An interpolated normal", "shade", 3)
def draw_between(draws: Draws) -> Draft:
    """An interpolated normal."""
    normals = [draws.item(VECTORS), draws.item(VECTORS)]
    units = [
        tuple(Fraction(c, 5 if 0 in n and sum(x * x for x in n) == 25 else 3 if 0 not in n else 1) for c in n)
        for n in normals
    ]
    to_light = draws.item(VECTORS)
    t = Fraction(draws.whole(1, 3), 4)
    given = (
        f"Normals: {place_text(units[0])} at t = 0, {place_text(units[1])} at t = 1; the point: t = {number_text(t)}\n"
        f"To the light: {place_text(to_light)}"
    )
    asked = f"""What is N . L at this point of an edge? N is interpolated between the normals of the ends, L
        the same everywhere; both are made to length 1.
        Hint: (1 - t) N0 + t N1 is shorter than 1.
        Hint: Divide by its length, then take the dot product with L.
        Hint: N is (1 - {number_text(t)}) N0 + {number_text(t)} N1, L is {place_text(to_light)}: each over its
        length."""
    sketch = vectors_sketched({"N0": units[0], "N1": units[1], "L": to_light})
    return by_rule(asked, given, (*units, t, to_light), ("normal-not-renormalized",), sketch=sketch)


@template("highlight", 2, "The highlight", "shade", 3)
def draw_highlight(draws: Draws) -> Draft:
    """Blinn and Phong."""
    normal, to_light, to_eye = (draws.item(VECTORS) for _ in range(3))
    shininess = draws.item((2, 4, 8))
    arguments = (normal, to_light, to_eye, shininess)
    names = ("highlight-at-light", "highlight-at-eye", "shininess-inverted")
    reject(dot(normal, to_light) <= 0 or RULES[names[0]].right(*arguments)[0] < 10 * TOLERANCE)
    given = (
        f"Normal: {place_text(normal)}\nTo the light: {place_text(to_light)}\nTo the eye: {place_text(to_eye)}\n"
        f"s = {shininess}"
    )
    asked = f"""What is the highlight max(0, N . H)^s of Blinn and Phong? H is halfway between L and V; all
        vectors are made to length 1.
        Hint: Make L and V of length 1 before you add them.
        Hint: H = (L + V) / |L + V|.
        Hint: Raise the cosine to the power s.
        Hint: L is {place_text(to_light)} and V is {place_text(to_eye)}, each over its length; s =
        {shininess}."""
    sketch = vectors_sketched({"N": normal, "L": to_light, "V": to_eye})
    return by_rule(asked, given, arguments, names, sketch=sketch)


@template("scaled-normal", 1, "A normal under scaling", "shade", 3)
def draw_normal(draws: Draws) -> Draft:
    """A normal under scaling."""
    scale, shift = wholes(draws, 3, 1, 4), wholes(draws, 3, -3, 3)
    normal = draws.item(VECTORS)
    given = f"Scale: {place_text(scale)}, shift: {place_text(shift)}\nNormal before: {place_text(normal)}"
    asked = f"""An object is scaled, then moved. What is the unit normal afterwards? Normals go with the
        transposed inverse of the matrix.
        Hint: Does the shift matter for a direction?
        Hint: The transposed inverse of a scaling divides by its factors.
        Hint: Make the result of length 1.
        Hint: Before that, x is {factor_text(normal[0])} / {factor_text(scale[0])}; y and z likewise."""
    names = ("normal-as-position", "normal-untransformed", "normal-moved")
    sketch = vectors_sketched({"N": normal})
    return by_rule(asked, given, (scale, shift, normal), names, XYZ, sketch=sketch)


@template("camera-normal", 1, "The matrix of normals", "shade", 2)
def draw_camera_normal(draws: Draws) -> Draft:
    """The matrix of normals."""
    c, s = draws.item(((Fraction(3, 5), Fraction(4, 5)), (Fraction(4, 5), Fraction(-3, 5))))
    model_view = ((c, Fraction(0), -s), (Fraction(0), Fraction(1), Fraction(0)), (s, Fraction(0), c))
    focal = (Fraction(draws.item((2, 3))), Fraction(draws.item((1, 2))), Fraction(1))
    normal = draws.item(VECTORS)
    given = (
        f"Rows of V M: {', '.join(map(place_text, model_view))}\nP scales x and y by {place_text(focal[:2])}.\n"
        f"Normal in object space: {place_text(normal)}"
    )
    asked = f"""Light is computed in camera space. What is the unit normal there? V M is a rotation here,
        given row by row.
        Hint: Which matrices lead to camera space?
        Hint: A rotation is its own transposed inverse.
        Hint: Multiply each row of V M with {place_text(normal)}, then make the result of length 1."""
    arguments, sketch = (model_view, focal, normal), vectors_sketched({"N": normal})
    return by_rule(asked, given, arguments, ("normal-by-projection",), XYZ, sketch=sketch)


@template("light-byte", 2, "A sum of lights as a byte", "shade", 1)
def draw_byte(draws: Draws) -> Draft:
    """A sum of lights."""
    ambient, diffuse = Fraction(draws.whole(15, 60), 100), Fraction(draws.whole(42, 98), 100)
    reject((255 * (ambient + diffuse)).denominator == 2)
    given = f"Ambient: {number_text(ambient)}, diffuse: {number_text(diffuse)}"
    asked = f"""Ambient and diffuse light are added and stored as a byte, 255 for 1, rounded. Which byte is
        it?
        Hint: Is the sum above 1?
        Hint: A byte ends at 255.
        Hint: 255 * min(1, {number_text(ambient)} + {number_text(diffuse)}), rounded."""
    rule, lights = RULES["byte-overflows"], (float(ambient), float(diffuse))
    wrong = {rule.name: rule.wrong(*lights)} if ambient + diffuse > 1 else {}
    return numbers(asked, given, rule.right(*lights), wrong)


@template("light-evaluations", 1, "Where light is evaluated", "shade", 2)
def draw_evaluations(draws: Draws) -> Draft:
    """Where light is evaluated."""
    triangles, fragments = draws.whole(10, 60), draws.whole(300, 900)
    vertices = triangles // 2 + draws.whole(2, 5)
    given = f"{triangles} triangles, {vertices} vertices, {fragments} fragments."
    asked = f"""How often is the light evaluated by flat shading (once a triangle), by Gouraud shading and by
        Phong shading? Every vertex is shared and used once.
        Hint: Gouraud interpolates colours, Phong normals.
        Hint: Where are the vectors known that the light needs?
        Hint: Which of {triangles}, {vertices} and {fragments} counts the places where each of them evaluates
        it?"""
    names = ("flat", "Gouraud", "Phong")
    return by_rule(asked, given, (triangles, vertices, fragments), ("phong-at-vertices",), names)


@template("shading-of-highlight", 1, "Which shading shows it", "shade", 1)
def draw_shading(draws: Draws) -> Draft:
    """What a highlight inside a triangle needs."""
    methods = ("flat", "Gouraud", "Phong")
    seen = draws.item(
        (
            ("inside of one large triangle, away from its vertices", 2),
            ("that is the same all over a facet", 0),
        )
    )
    asked = f"""Which shading shows light {seen[0]}?
        Hint: Where is the light evaluated?
        Hint: What is interpolated: nothing, colours, or normals?
        Hint: The light is seen {seen[0]}: which of the three can show that?"""
    wrong = {"phong-at-vertices": 1} if seen[1] == 2 else {}
    return one_of(asked, "", methods, seen[1], wrong)
