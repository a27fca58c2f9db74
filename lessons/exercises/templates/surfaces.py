"""Surfaces: which texels are read with which weights, how bright a point is, and where light is evaluated."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import floor
from typing import Any

from core import Settings
from core.scene import ClipScene, Texture
from core.textures.look_up import sample_texture, wrapped_index
from lessons.exercises.drafting import TOLERANCE, by_rule, factor_text, numbers, one_of, place_text, table
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.transforms import XYZ, vectors_sketched, wholes
from lessons.mistakes.shelf import RULES, SHELF
from lessons.mistakes.surfaces import repeat_mirrored, strip
from lessons.mistakes.transforms import dot

# Textures: which texels are read, with which weights, and which level.


LEVELS = 8
"""Grey values of texels are eighths."""


def looked_up(scene: ClipScene, u: float, settings: Settings, v: float = 0.5) -> float:
    """Return the grey value at (u, v)."""
    assert scene.texture is not None
    found = sample_texture(scene.texture, [[u, v]], settings.texture_filter, settings.wrap)  # type: ignore[arg-type]
    return float(found.color[0, 0])


def of_strip(
    asked: str, texels: Sequence[Fraction], u: Fraction, settings: Settings, names: Sequence[str]
) -> Draft:
    """Ask for a look-up in one row of texels."""
    scene = strip([float(texel) for texel in texels])
    right = Fraction(looked_up(scene, float(u), settings)).limit_denominator(1000)
    wrong = {name: [looked_up(scene, float(u), SHELF[name].change_settings(settings))] for name in names}
    given = (
        f"Texture of {len(texels)} x 1 texels, from u = 0 to u = 1: {', '.join(map(number_text, texels))}\n"
        f"u = {number_text(u)}"
    )
    return numbers(asked, given, [right], wrong, scene=scene, settings=settings)


def drawn_texels(draws: Draws, count: int) -> list[Fraction]:
    """Draw grey values that all differ."""
    return [Fraction(value, LEVELS) for value in draws.shuffled(range(1, LEVELS))[:count]]


@template("texel-nearest", 1, "The nearest texel", "shade", 2)
def draw_nearest(draws: Draws) -> Draft:
    """The texel that contains u."""
    count = draws.whole(4, 6)
    u = Fraction(2 * draws.whole(0, 4 * count - 1) + 1, 8 * count)
    asked = f"""Which value does the nearest texel give? Texel i reaches from i to i + 1 in units of texels.
        Hint: Multiply u by the number of texels.
        Hint: The texel is floor(u w), with w texels.
        Hint: floor({factor_text(u)} * {count}), counted from 0."""
    settings = Settings(texture_filter="nearest", wrap="clamp")
    names = ("texels-of-one-less", "texel-rounded")
    return of_strip(asked, drawn_texels(draws, count), u, settings, names)


@template("texels-linear", 1, "Between two texels", "shade", 3)
def draw_bilinear(draws: Draws) -> Draft:
    """Between two texel centres."""
    count = draws.whole(4, 6)
    u = Fraction(draws.whole(5, 4 * count - 5), 4 * count)
    asked = f"""Which value does the linear filter give? The centre of texel i lies at i + 1/2 in units of
        texels.
        Hint: Multiply u by the number of texels.
        Hint: Subtract 1/2: the whole part is the left texel, the rest the weight of the right one.
        Hint: c = c0 (1 - w_u) + c1 w_u.
        Hint: {factor_text(u)} * {count} - 1/2 holds both: the left texel and w_u."""
    settings = Settings(texture_filter="bilinear", wrap="clamp")
    return of_strip(
        asked, drawn_texels(draws, count), u, settings, ("half-texel-missing", "half-texel-added")
    )


@template("texel-border", 1, "The filter at the border", "shade", 3)
def draw_border(draws: Draws) -> Draft:
    """The filter at the border."""
    count = draws.whole(3, 5)
    u = Fraction(draws.item((1, 3, 8 * count - 1, 8 * count - 3)), 8 * count)
    asked = f"""Which value does the linear filter give with the wrap mode clamp, which repeats the border
        texel? The centre of texel i lies at i + 1/2 in units of texels.
        Hint: Which two texels lie beside u?
        Hint: Beyond the border there is the border texel again.
        Hint: {factor_text(u)} * {count} - 1/2: the whole part is the left texel, the rest the weight of the
        right one."""
    settings = Settings(texture_filter="bilinear", wrap="clamp")
    return of_strip(asked, drawn_texels(draws, count), u, settings, ("border-repeated",))


@template("texel-wrap", 1, "Texels beyond the border", "shade", 3)
def draw_wrap(draws: Draws) -> Draft:
    """Texels beyond the border."""
    size = draws.whole(4, 7)
    indices = [draws.whole(-2 * size + 1, -1), draws.whole(0, size - 1), draws.whole(size, 2 * size - 1)]
    modes = ("repeat", "clamp", "mirror")
    right = [[wrapped_index(index, size, mode) for mode in modes] for index in indices]
    below = int(repeat_mirrored(indices[0], size))  # type: ignore[arg-type]
    wrong = {"negative-repeat": [[below, *right[0][1:]], *right[1:]]}
    given = f"Texels 0 to {size - 1}."
    asked = f"""Which texel is read for each index, with the wrap modes repeat (start again), clamp (repeat
        the border texel) and mirror (every second repetition runs backwards)?
        Hint: An index inside is itself.
        Hint: repeat: the remainder, never negative. clamp: the nearest border.
        Hint: repeat: add {size - 1} + 1 to {indices[0]} until it is inside. mirror: 0 to {size - 1}, then
        {size - 1} to 0, and so on."""
    labels = [f"index {index}" for index in indices]
    return table(asked, given, modes, labels, right, wrong)


@template("texture-repeated", 1, "A texture that repeats", "shade", 3)
def draw_repeated(draws: Draws) -> Draft:
    """A texture that repeats across the window."""
    texels, start = drawn_texels(draws, 4), -draws.whole(1, 2)
    pixel = draws.whole(0, 7), 0
    scene = strip([float(texel) for texel in texels], start, 1.0)
    settings = Settings(texture_filter="nearest")
    u = start + Fraction(2 * pixel[0] + 1, 16) * (1 - start)
    wrong = {
        name: [float(SHELF[name].draw(scene, settings).color[0, pixel[0], 0])]
        for name in ("window-for-uv", "negative-repeat")
    }
    given = (
        f"Texture of 4 x 1 texels: {', '.join(map(number_text, texels))}\nWindow of 8 pixels: u grows evenly from "
        f"{start} at its left border to 1 at its right border."
    )
    asked = f"""What is the value of pixel {pixel}? The texture is repeated, and the nearest texel is read at
        the pixel's centre.
        Hint: What is u at the centre of the pixel?
        Hint: Repeat takes u - floor(u).
        Hint: Texel i reaches from i to i + 1.
        Hint: u = {start} + ({pixel[0]} + 1/2) / 8 * (1 - ({start}))."""
    right = texels[floor((u - floor(u)) * 4)]
    return numbers(asked, given, [right], wrong, scene=scene, settings=settings, pixel=pixel)


@template("texel-place", 1, "Column and row of a texel", "shade", 2)
def draw_upside(draws: Draws) -> Draft:
    """Column and row of a texel."""
    size = draws.whole(4, 8), draws.whole(4, 8)
    uv = tuple(Fraction(draws.whole(0, 15) * 2 + 1, 32) for _ in range(2))
    right = [floor(c * s) for c, s in zip(uv, size, strict=True)]
    one_less = [floor(c * (s - 1)) for c, s in zip(uv, size, strict=True)]
    flipped = [right[0], floor((1 - uv[1]) * size[1])]
    given = f"Texture of {size[0]} x {size[1]} texels.\n(u, v) = {place_text(uv)}"
    asked = f"""Which texel, column and row, does the nearest filter read? (0, 0) is the bottom left corner;
        row 0 is the lowest.
        Hint: In which direction does v grow?
        Hint: floor(u w) and floor(v h).
        Hint: floor({factor_text(uv[0])} * {size[0]}) and floor({factor_text(uv[1])} * {size[1]})."""
    wrong = {"texture-upside-down": flipped, "texels-of-one-less": one_less}
    return numbers(asked, given, right, wrong, ("column", "row"))


@template("texels-bilinear", 1, "Between four texels", "shade", 3)
def draw_square(draws: Draws) -> Draft:
    """Four texels."""
    c = [Fraction(draws.whole(0, 8), 8) for _ in range(4)]
    w_u, w_v = (Fraction(draws.whole(1, 3), 4) for _ in range(2))
    low, high = (c[k] * (1 - w_u) + c[k + 1] * w_u for k in (0, 2))
    texels = [[[float(c[0])], [float(c[1])]], [[float(c[2])], [float(c[3])]]]
    scene = replace(strip([0.0]), texture=Texture(texels))  # type: ignore[arg-type]
    given = (
        f"tex(u0, v0) = {number_text(c[0])}, tex(u1, v0) = {number_text(c[1])}\n"
        f"tex(u0, v1) = {number_text(c[2])}, tex(u1, v1) = {number_text(c[3])}\n"
        f"w_u = {number_text(w_u)}, w_v = {number_text(w_v)}"
    )
    asked = f"""What is the colour c of the bilinear filter between these four texels?
        Hint: First between the columns, in both rows.
        Hint: c = c_b (1 - w_v) + c_t w_v.
        Hint: c_b = {number_text(c[0])} (1 - {number_text(w_u)}) + {number_text(c[1])} * {number_text(w_u)},
        c_t likewise."""
    return numbers(asked, given, [low * (1 - w_v) + high * w_v], scene=scene)


@template("mip-level", 1, "The mipmap level", "shade", 2)
def draw_level(draws: Draws) -> Draft:
    """The mipmap level."""
    texels, level = 2 ** draws.whole(5, 9), draws.whole(1, 4)
    step = Fraction(2**level, texels)
    given = f"Texture of {texels} x {texels} texels, step in u: {number_text(step)}"
    asked = f"""How many texels does a pixel step over, and which mipmap level is read? From one pixel to the
        next, u grows by the given step; v stays. Level 0 is the full texture.
        Hint: Multiply the step by the size of the texture.
        Hint: The level is log2 of the texels per pixel.
        Hint: {number_text(step)} * {texels} texels; the level is log2 of it."""
    wrong = {
        "level-without-size": [step, *RULES["level-without-size"].wrong(texels, float(step))],
        "level-of-area": [2**level, *RULES["level-of-area"].wrong(texels, float(step))],
    }
    return numbers(asked, given, [2**level, level], wrong, ("texels", "level"))


# Light: how bright a point is, its normal, and where light is evaluated.


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
