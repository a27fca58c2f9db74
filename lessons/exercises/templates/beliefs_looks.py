"""Beliefs about blending, samples, textures, bytes and drawing order."""

from dataclasses import replace
from fractions import Fraction

import numpy as np

from core import Settings
from core.framebuffer.display import to_display
from core.scene import ClipScene, Texture
from lessons.exercises.draws import Draws
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft, Template
from lessons.exercises.refutation import Refutation
from lessons.exercises.templates.believing import believed
from lessons.small_scenes import EVERYWHERE, rectangle_corners, triangle_scene

BLACK, WHITE = np.array([0.0, 0.0, 0.0, 1.0]), np.array([1.0, 1.0, 1.0, 1.0])


def gray_scene(light: float) -> ClipScene:
    """Return a triangle over the whole window with one grey."""
    return triangle_scene([EVERYWHERE], (4, 4), attributes=[[[light, light, light, 1.0]] * 3])


def draw_inclusive(draws: Draws) -> Draft | None:
    """``>=`` is harmless, nobody sees it."""
    side, quarters = draws.whole(3, 6), draws.whole(1, 3)
    alpha = Fraction(quarters, 4)
    scene = triangle_scene(
        rectangle_corners(0.5, 0.5, 0.5 + side, 0.5 + side),
        (side + 2, side + 2),
        attributes=[[[1.0, 0.0, 0.0, float(alpha)]] * 3] * 2,
    )
    refutation = Refutation(
        "The buffer holds the red of triangle 0 here already, and triangle 1 is blended over it: twice as much.",
        replace(scene, background=BLACK),
        "blend",
        "triangle == 1 and before[0] > 0",
        Settings(fill_rule="inclusive", blend="over", visibility="last-drawn"),
    )
    text = (
        f"Two red triangles with alpha {number_text(alpha)} over black share an edge that runs through centres. "
        "Both are filled where E >= 0. What is seen on the edge?"
    )
    hints = (
        "How many triangles draw a centre on the common edge?",
        "What does blending do with the second one?",
        f"Begin with black, and blend red with alpha {number_text(alpha)} once for each triangle that draws it.",
    )
    right, belief = "a line of another shade: blended twice", "nothing special"
    return believed(draws, text, right, [belief], ["a black line: drawn by neither"], refutation, hints)


def draw_multisampling(draws: Draws) -> Draft | None:
    """Multisampling shades every sample, or scales the colour by coverage when it is written."""
    count = draws.whole(2, 3)
    refutation = Refutation(
        "The pixel is shaded once, and each covered sample takes the full colour; the mean comes with the resolve.",
        triangle_scene([[(1, 1), (7, 2), (3, 6)]], (8, 8)),
        "shade",
        "triangle == 0",
        Settings(antialiasing="msaa-4"),
    )
    text = f"Multisampling with 4 samples, of which a triangle covers {count}. How often is it shaded, what is stored?"
    hints = (
        "What makes multisampling cheaper than supersampling?",
        "When are samples averaged?",
        f"Which happens once a pixel here: shading, or storing in {count} of 4 samples?",
    )
    right = f"once; the full colour in {count} samples"
    beliefs = [f"{count} times, a colour in each sample", f"once; {count}/4 of the colour in the pixel"]
    return believed(draws, text, right, beliefs, ["4 times; the mean in the pixel"], refutation, hints)


def draw_bilinear(draws: Draws) -> Draft | None:
    """Bilinear always mixes texels."""
    width = draws.item((4, 8))
    texel = draws.whole(1, width - 2)
    corners = rectangle_corners(0, 0, width, width)
    texture = Texture(np.linspace(0, 1, width * width).reshape(width, width, 1).astype(np.float32))
    uv = np.array(corners, float) / width
    scene = replace(triangle_scene(corners, (width, width), attributes=uv), texture=texture)
    refutation = Refutation(
        "u w - 1/2 is a whole number at a texel's centre: that texel has the weight 1, its neighbour 0.",
        scene,
        "shade",
        f"column == {texel} and shares[0] == 1",
        Settings(texture_filter="bilinear"),
    )
    text = (
        f"A texture is {width} texels wide. At u = ({texel} + 1/2)/{width}, which weights has bilinear filtering "
        "for the two texels that are next to u?"
    )
    hints = (
        "Where do texels have their centres?",
        "The weights are the fraction of u w - 1/2, and the rest.",
        f"u w = {texel} + 1/2 here: subtract 1/2, and take the fraction.",
    )
    others = ["3/4 and 1/4"]
    return believed(draws, text, "1 and 0", ["1/2 and 1/2"], others, refutation, hints)


def srgb_byte(light: Fraction) -> int:
    """Return the byte that is stored for linear light."""
    shown = to_display(np.array([[[float(light)] * 3 + [1.0]]]))
    return int(shown.pixels[0, 0, 0])


def draw_half_byte(draws: Draws) -> Draft | None:
    """Half the byte is half the light."""
    light = Fraction(draws.whole(1, 3), 4)
    right, belief = srgb_byte(light), int(255 * light + Fraction(1, 2))
    refutation = Refutation(
        f"Bytes are spaced as the eye sees, not as light adds: {number_text(light)} of the light is byte {right}.",
        gray_scene(float(light)),
        "resolve",
        f"bytes[0] == {right}",
    )
    text = (
        f"A pixel is the mean of black and white in linear light, {number_text(light)} of it white. Which sRGB byte is "
        "stored, from 0 to 255?"
    )
    hints = (
        "Is a byte proportional to light?",
        "The curve of sRGB lifts dark values.",
        f"The byte is 255 times the curve at {number_text(light)}, not 255 times {number_text(light)}.",
    )
    return believed(draws, text, right, [belief], [(right + belief) // 2, 255 - right], refutation, hints)


def draw_alphas(draws: Draws) -> Draft | None:
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
    text = (
        f"Two layers with alpha {number_text(first)} and {number_text(second)} are blended over a background. "
        "How much of the background is left?"
    )
    hints = (
        "How much does the first layer leave?",
        "The second layer leaves a part of that, not of the whole.",
        f"(1 - {number_text(first)}) (1 - {number_text(second)}).",
    )
    return believed(draws, text, right, [belief], [1 - right], refutation, hints)


def ring_scene(size: int) -> ClipScene:
    """Return three bars around a ring: each is near where it begins and far where the next one crosses it."""
    angle = np.arange(3) * 2 * np.pi / 3
    around = size / 2 + size / 4 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    along = np.roll(around, -1, axis=0) - around
    start, end = around - 0.3 * along, around + 1.5 * along
    aside = 0.15 * along[:, ::-1] * [-1, 1]
    bars = np.stack([start - aside, start + aside, end], axis=1)
    return triangle_scene(bars, (size, size), depth=[0.2, 0.2, 0.8])


def draw_ring(draws: Draws) -> Draft | None:
    """Sorting by the mean distance is enough."""
    size = draws.whole(16, 24)
    refutation = Refutation(
        "Triangle 2 is hidden by triangle 0 here, which it is drawn after: no order of whole triangles is right.",
        ring_scene(size),
        "depth",
        "triangle == 2 and not passes",
    )
    text = (
        f"Three triangles in a window of {size} x {size} pixels overlap in a ring: A hides part of B, B part of C, "
        "and C part of A. Which does the painter draw first?"
    )
    hints = (
        "Try each of the three as the first.",
        "What could be done with one of them?",
        f"Painted first, A hides B in none of the {size} x {size} pixels: ask the same of B and of C.",
    )
    right, belief = "none is right: one must be split", "the one whose mean distance is largest"
    return believed(
        draws, text, right, [belief], ["the largest one", "any: a ring has no first"], refutation, hints
    )


TEMPLATES = (
    Template("belief-inclusive", 1, "Is E >= 0 harmless?", "blend", 1, draw_inclusive),
    Template("belief-multisampling", 1, "What does multisampling store?", "shade", 1, draw_multisampling),
    Template("belief-bilinear", 1, "Does bilinear always mix?", "shade", 1, draw_bilinear),
    Template("belief-half-byte", 1, "Is half the byte half the light?", "resolve", 1, draw_half_byte),
    Template("belief-alphas-add", 1, "Do alphas add up?", "blend", 1, draw_alphas),
    Template("belief-mean-distance", 1, "Is sorting by distance enough?", "depth", 1, draw_ring),
)
