"""Textures: which texels are read, with which weights, and which level."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import floor

from core import Settings
from core.fragments.textures import sample_texture, wrapped_index
from core.scene import ClipScene, Texture
from lessons.exercises.draws import Draws, reject
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.drafting import factor_text, numbers, place_text, table
from lessons.mistakes.shelf import RULES, SHELF
from lessons.mistakes.textures import repeat_mirrored, strip

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
    reject(below == right[0][0])
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
    scene, settings = (
        strip([float(texel) for texel in texels], start, 1.0),
        Settings(texture_filter="nearest"),
    )
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
    reject(right in (one_less, flipped))
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
