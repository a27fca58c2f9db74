"""Beliefs about blending, samples, textures, bytes and drawing order."""

from dataclasses import replace
from fractions import Fraction

import numpy as np

from core import Settings
from core.framebuffer.display import srgb_byte
from core.scene import ClipScene, Texture
from lessons.exercises.drafting import believed
from lessons.exercises.numbers import Draws, number_text
from lessons.exercises.question import Draft, Refutation, template
from lessons.small_scenes import EVERYWHERE, rectangle_corners, triangle_scene

BLACK, WHITE = np.array([0.0, 0.0, 0.0, 1.0]), np.array([1.0, 1.0, 1.0, 1.0])


def gray_scene(light: float) -> ClipScene:
    """Return a triangle over the whole window with one grey."""
    return triangle_scene([EVERYWHERE], (4, 4), attributes=[[[light, light, light, 1.0]] * 3])


TWICE = "a line of another shade: blended twice"
NOTHING = "nothing special"
NEITHER = "a black line: drawn by neither"
ON_TIE = "(tie[0] or tie[1] or tie[2])"


@template("belief-inclusive", 2, "Is E >= 0 harmless?", "blend", 1)
def draw_inclusive(draws: Draws) -> Draft:
    """``>=`` is harmless, nobody sees it."""
    side, quarters = draws.whole(3, 6), draws.whole(1, 3)
    alpha = Fraction(quarters, 4)
    scene = triangle_scene(
        rectangle_corners(0.5, 0.5, 0.5 + side, 0.5 + side),
        (side + 2, side + 2),
        attributes=[[[1.0, 0.0, 0.0, float(alpha)]] * 3] * 2,
    )
    rule, filled, right, belief, sentence, stage, condition = draws.item(
        (
            (
                "inclusive",
                "where E >= 0",
                TWICE,
                NOTHING,
                "The buffer holds the red of triangle 0 already, and triangle 1 is blended over it: twice as much.",
                "blend",
                "triangle == 1 and before[0] > 0",
            ),
            (
                "exclusive",
                "where E > 0",
                NEITHER,
                NOTHING,
                "E is 0 here for the common edge, so neither triangle draws the pixel.",
                "raster",
                f"{ON_TIE} and not covered",
            ),
            (
                "shared-edge",
                "where E > 0, and where E = 0 on edges that own their ties",
                NOTHING,
                TWICE,
                "E is 0 here, and one of the two triangles owns the edge: it alone draws the pixel.",
                "raster",
                f"{ON_TIE} and covered",
            ),
        )
    )
    refutation = Refutation(
        sentence,
        replace(scene, background=BLACK),
        stage,
        condition,
        Settings(fill="bounding-box", fill_rule=rule, blend="over", visibility="last-drawn"),
    )
    asked = f"""Two red triangles with alpha {number_text(alpha)} over black share an edge that runs through
        centres. Both are filled {filled}. What is seen on the edge?
        Hint: How many triangles draw a centre on the common edge?
        Hint: What does blending do with the second one?
        Hint: Begin with black, and blend red with alpha {number_text(alpha)} once for each triangle that
        draws it."""
    (other,) = {TWICE, NOTHING, NEITHER} - {right, belief}
    return believed(draws, asked, right, [belief], [other], refutation)


@template("belief-multisampling", 1, "What does multisampling store?", "shade", 1)
def draw_multisampling(draws: Draws) -> Draft:
    """Multisampling shades every sample, or scales the colour by coverage when it is written."""
    count = draws.whole(2, 3)
    refutation = Refutation(
        "The pixel is shaded once, and each covered sample takes the full colour; the mean comes with the resolve.",
        triangle_scene([[(1, 1), (7, 2), (3, 6)]], (8, 8)),
        "shade",
        "triangle == 0",
        Settings(antialiasing="msaa-4"),
    )
    asked = f"""Multisampling with 4 samples, of which a triangle covers {count}. How often is it shaded, what
        is stored?
        Hint: What makes multisampling cheaper than supersampling?
        Hint: When are samples averaged?
        Hint: Which happens once a pixel here: shading, or storing in {count} of 4 samples?"""
    right = f"once; the full colour in {count} samples"
    beliefs = [f"{count} times, a colour in each sample", f"once; {count}/4 of the colour in the pixel"]
    return believed(draws, asked, right, beliefs, ["4 times; the mean in the pixel"], refutation)


@template("belief-bilinear", 2, "Does bilinear always mix?", "shade", 1)
def draw_bilinear(draws: Draws) -> Draft:
    """Bilinear always mixes texels evenly."""
    width = draws.item((4, 8))
    texel = draws.whole(1, width - 2)
    part, right, belief, other, sentence = draws.item(
        (
            (
                Fraction(1, 2),
                "1 and 0",
                "1/2 and 1/2",
                "3/4 and 1/4",
                "u w - 1/2 is a whole number at a texel's centre: that texel has the weight 1, its neighbour 0.",
            ),
            (
                Fraction(1),
                "1/2 and 1/2",
                "1 and 0",
                "3/4 and 1/4",
                "u w - 1/2 ends with 1/2 at the border of two texels: both are equally near.",
            ),
            (
                Fraction(3, 4),
                "3/4 and 1/4",
                "1/2 and 1/2",
                "1 and 0",
                "u w - 1/2 ends with 1/4 here: the next texel has this weight, the texel itself the rest.",
            ),
        )
    )
    corners = rectangle_corners(0, 0, width, width)
    texture = Texture(np.linspace(0, 1, width * width).reshape(width, width, 1).astype(np.float32))
    uv = np.array(corners, float) / width + [float(part - Fraction(1, 2)) / width, 0]
    scene = replace(triangle_scene(corners, (width, width), attributes=uv), texture=texture)
    weight = Fraction(3, 2) - part
    refutation = Refutation(
        sentence,
        scene,
        "shade",
        f"column == {texel} and shares[0] > {float(weight) - 0.01} and shares[0] < {float(weight) + 0.01}",
        Settings(texture_filter="bilinear"),
    )
    asked = f"""A texture is {width} texels wide. At u = ({texel} + {part})/{width}, which weights does
        bilinear filtering give the two texels that are next to u, the nearer or the left one first?
        Hint: Where do texels have their centres?
        Hint: The weights are the fraction of u w - 1/2, and the rest.
        Hint: u w = {texel} + {part} here: subtract 1/2, and take the fraction."""
    return believed(draws, asked, right, [belief], [other], refutation)


@template("belief-half-byte", 1, "Is half the byte half the light?", "resolve", 1)
def draw_half_byte(draws: Draws) -> Draft:
    """Half the byte is half the light."""
    light = Fraction(draws.whole(1, 3), 4)
    right, belief = srgb_byte(float(light)), int(255 * light + Fraction(1, 2))
    refutation = Refutation(
        f"Bytes are spaced as the eye sees, not as light adds: {number_text(light)} of the light is byte {right}.",
        gray_scene(float(light)),
        "resolve",
        f"bytes[0] == {right}",
    )
    asked = f"""A pixel is the mean of black and white in linear light, {number_text(light)} of it white.
        Which sRGB byte is stored, from 0 to 255?
        Hint: Is a byte proportional to light?
        Hint: The curve of sRGB lifts dark values.
        Hint: The byte is 255 times the curve at {number_text(light)}, not 255 times {number_text(light)}."""
    return believed(draws, asked, right, [belief], [(right + belief) // 2, 255 - right], refutation)


@template("belief-alphas-add", 1, "Do alphas add up?", "blend", 1)
def draw_alphas(draws: Draws) -> Draft:
    """Alpha values add up."""
    first, second = (Fraction(draws.whole(1, 3), 4) for _ in range(2))
    right, belief = (1 - first) * (1 - second), max(Fraction(0), 1 - first - second)
    layers = [[[0.0, 0.0, 0.0, float(alpha)]] * 3 for alpha in (first, second)]
    scene = triangle_scene([EVERYWHERE] * 2, (2, 2), attributes=layers)
    refutation = Refutation(
        f"Each layer leaves 1 - alpha of what is below it: together {number_text(right)}.",
        replace(scene, background=WHITE),
        "blend",
        f"triangle == 1 and after[0] > {float(belief)}",
        Settings(blend="over", visibility="last-drawn"),
    )
    asked = f"""Two layers with alpha {number_text(first)} and {number_text(second)} are blended over a
        background. How much of the background is left?
        Hint: How much does the first layer leave?
        Hint: The second layer leaves a part of that, not of the whole.
        Hint: (1 - {number_text(first)}) (1 - {number_text(second)})."""
    return believed(draws, asked, right, [belief], [1 - right], refutation)


def ring_scene(size: int) -> ClipScene:
    """Return three bars around a ring: each is near where it begins and far where the next one crosses it."""
    angle = np.arange(3) * 2 * np.pi / 3
    around = size / 2 + size / 4 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    along = np.roll(around, -1, axis=0) - around
    start, end = around - 0.3 * along, around + 1.5 * along
    aside = 0.15 * along[:, ::-1] * [-1, 1]
    bars = np.stack([start - aside, start + aside, end], axis=1)
    return triangle_scene(bars, (size, size), depth=[0.2, 0.2, 0.8])


CHAIN = triangle_scene(
    [[(7, 3), (9, 3), (8, 8)], [(6, 5), (16, 2), (16, 8)], [(0, 2), (0, 8), (10, 5)]],
    (18, 10),
    depth=[[0.05] * 3, [0.3, 0.9, 0.9], [0.1, 0.1, 0.7]],
)
"""Three triangles, each hidden by those before it; the middle of the last one is nearer than that of the second one."""


@template("belief-mean-distance", 2, "Is sorting by distance enough?", "depth", 1)
def draw_ring(draws: Draws) -> Draft:
    """Sorting by the mean distance is enough."""
    size, is_ring = draws.whole(16, 24), draws.whole(0, 1)
    front, middle, back = draws.shuffled("ABC")
    split, by_mean = "none is right: one must be split", "the one whose mean distance is largest"
    if is_ring:
        right, other, last = split, back, f"{back} part of {front}"
        sentence = (
            "Triangle 0 hides triangle 2 here, which is drawn later: no order of whole triangles is right."
        )
    else:
        right, other, last = back, split, f"{front} part of {back}"
        sentence = "The triangle behind is hidden by another one here, although its mean distance is the smaller one."
    refutation = Refutation(
        sentence, ring_scene(size) if is_ring else CHAIN, "depth", "triangle == 2 and not passes"
    )
    asked = f"""Three triangles in a window of {size} x {size} pixels overlap: {front} hides part of {middle},
        {middle} part of {back}, and {last}. Which does the painter draw first?
        Hint: Try each of the three as the first.
        Hint: What is drawn first can hide nothing.
        Hint: Painted first, {front} hides {middle} in none of the {size} x {size} pixels: ask the same of
        {middle} and of {back}."""
    return believed(draws, asked, right, [by_mean], [other, "any of the three"], refutation)
