"""Blending, and several samples a pixel."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np

from core import Settings
from core.antialiasing.resolve import tent
from core.framebuffer.display import srgb_byte
from lessons.exercises.drafting import by_rule, listed, numbers
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.mistakes.depths import Layer, cards
from lessons.mistakes.shelf import SHELF
from lessons.small_scenes import EVERYWHERE, triangle_scene

BLENDED = Settings(blend="over", visibility="last-drawn")


@template("result-alpha", 1, "The alpha of the result", "blend", 2)
def draw_alpha(draws: Draws) -> Draft:
    """The alpha of the result."""
    alphas = [Fraction(draws.whole(1, 4), 5) for _ in range(2)]
    layers = [[(1, 1, 1, float(alpha))] * 3 for alpha in alphas]
    scene = triangle_scene([EVERYWHERE] * 2, (2, 2), attributes=layers)
    twins = ("alpha-of-source", "alpha-squared", "alpha-kept")
    wrong = {twin: [float(SHELF[twin].draw(scene, BLENDED).color[0, 0, 3])] for twin in twins}
    given = f"Layer 0: alpha = {number_text(alphas[0])}\nLayer 1: alpha = {number_text(alphas[1])}"
    asked = f"""Two layers are blended with over on a clear background (alpha 0). What is the alpha of the
        result?
        Hint: How much of the background is still seen?
        Hint: a + (1 - a) times the alpha that is there.
        Hint: {number_text(alphas[1])} + (1 - {number_text(alphas[1])}) * {number_text(alphas[0])}."""
    right = 1 - (1 - alphas[0]) * (1 - alphas[1])
    return numbers(asked, given, [right], wrong, scene=scene, settings=BLENDED, pixel=(0, 0))


@template("straight-color", 1, "A straight colour", "blend", 2)
def draw_straight(draws: Draws) -> Draft:
    """A straight colour over another."""
    alpha, color, there = (Fraction(draws.whole(1, 9), 10) for _ in range(3))
    scene = triangle_scene([EVERYWHERE], (2, 2), attributes=[[(*[float(color)] * 3, float(alpha))] * 3])
    scene = replace(scene, background=np.array([*[float(there)] * 3, 1.0]))
    twins = ("multiplied-twice", "not-multiplied", "factors-exchanged")
    wrong = {twin: [float(SHELF[twin].draw(scene, BLENDED).color[0, 0, 0])] for twin in twins}
    given = f"Layer: {number_text(color)}, alpha = {number_text(alpha)}\nBackground: {number_text(there)}"
    asked = f"""A grey layer lies over an opaque grey background. What is the grey value of the result,
        linear? The colour is straight: not yet multiplied by alpha.
        Hint: How much does each of them count?
        Hint: alpha times the new one, 1 - alpha times what is there.
        Hint: {number_text(alpha)} * {number_text(color)} + (1 - {number_text(alpha)}) *
        {number_text(there)}."""
    right = alpha * color + (1 - alpha) * there
    return numbers(asked, given, [right], wrong, scene=scene, settings=BLENDED, pixel=(0, 0))


@template("panes-of-glass", 1, "Glass that is drawn too early", "blend", 2)
def draw_panes(draws: Draws) -> Draft:
    """Two panes of glass, the nearer one first."""
    alpha, red, blue = (Fraction(draws.whole(1, 3), 4) for _ in range(3))
    scene = cards([0.25] * 3, [0.75] * 3)
    colors = [[(float(red), 0, 0, float(alpha))] * 3, [(0, 0, float(blue), float(alpha))] * 3]
    scene = replace(scene, attributes=np.array(colors), background=np.array([0.0, 0.0, 0.0, 1.0]))
    given = (
        f"Near pane, drawn first: red {number_text(red)}\nFar pane: blue {number_text(blue)}\nalpha of both: "
    )
    given += number_text(alpha)
    wrong = {
        name: SHELF[name].draw(scene, BLENDED).color[0, 0, [0, 2]].tolist()
        for name in ("glass-writes-depth", "order-reversed")
    }
    asked = f"""Two panes of glass are drawn over black with over, the nearer one first. Glass is tested
        against the depth buffer, but does not write its depth. What are red and blue of the result, linear?
        Hint: Does the far pane pass the depth test?
        Hint: What is drawn last lies on top, wherever it stands.
        Hint: red: (1 - {number_text(alpha)}) * {number_text(alpha)} * {number_text(red)}; blue: what the last
        pane adds."""
    right = [(1 - alpha) * alpha * red, alpha * blue]
    return numbers(asked, given, right, wrong, ("red", "blue"), scene=scene, settings=BLENDED)


@template("additive-layers", 1, "Lights that add up", "blend", 1)
def draw_additive(draws: Draws) -> Draft:
    """Lights that add up."""
    values = [(Fraction(draws.whole(1, 9), 10), Fraction(draws.whole(1, 4), 4)) for _ in range(2)]
    given = listed("Layer {k}: {}, alpha = {}", *zip(*values, strict=True))
    asked = f"""Two layers are blended additively over black: each adds alpha times its colour. What is the
        sum, linear?
        Hint: Does the order matter?
        Hint: Does the upper layer hide anything?
        Hint: {" + ".join((f"{number_text(a)} * {number_text(c)}" for c, a in values)) + "."}"""
    right = sum((c * a for c, a in values), Fraction(0))
    wrong = {"not-multiplied": [sum((c for c, _ in values), Fraction(0))]}
    return numbers(asked, given, [right], wrong if wrong["not-multiplied"] != [right] else {})


SAMPLES = 4


def layers_text(layers: Sequence[Layer]) -> str:
    """Return layers as text, in drawing order."""
    return "\n".join(
        f"Triangle {k}: depth {layer.depth}, grey {layer.grey}, covers samples "
        f"{', '.join(map(str, sorted(layer.samples)))}"
        for k, layer in enumerate(layers)
    )


@template("samples-of-two", 1, "Two triangles in a pixel", "resolve", 3)
def draw_samples(draws: Draws) -> Draft:
    """Two triangles in one pixel."""
    near = frozenset(draws.shuffled(range(SAMPLES))[: draws.whole(1, 3)])
    layers = (
        Layer(near, draws.whole(1, 4), draws.whole(10, 60) * 4),
        Layer(frozenset(range(SAMPLES)), draws.whole(5, 9), draws.whole(10, 60) * 4),
    )
    asked = f"""Two triangles are drawn in this order into a pixel with 4 samples, black before. Which grey
        value does the mean of the samples give? Each sample has a depth of its own, the smaller one is
        nearer.
        Hint: What does each sample show?
        Hint: The second triangle fills the samples that the first one left.
        Hint: The mean of {SAMPLES} values: {layers[0].grey} in the samples of triangle 0, {layers[1].grey} in
        the others."""
    names = ("one-depth-a-pixel", "one-sample-filled") if 0 in near else ("one-depth-a-pixel",)
    return by_rule(asked, layers_text(layers), (layers, SAMPLES), names)


@template("box-filter", 1, "The box filter", "resolve", 1)
def draw_coverage(draws: Draws) -> Draft:
    """A pixel half covered."""
    side = draws.whole(2, 4)
    covered = draws.whole(2, side * side - 1)
    grey = draws.whole(3, 15) * side * side
    layer = (Layer(frozenset(range(covered)), 1, grey),)
    given = f"A triangle of grey {grey} covers {covered} of the samples."
    asked = f"""A pixel has {side} x {side} samples, black before. Which grey value does the box filter leave?
        Hint: The box filter takes the mean.
        Hint: Samples that are not covered stay black.
        Hint: {covered} * {grey} / ({side} * {side})."""
    return by_rule(asked, given, (layer, side * side), ("one-sample-filled",))


@template("line-samples", 1, "A line and its samples", "resolve", 1)
def draw_line_samples(draws: Draws) -> Draft:
    """A line with more and more samples a pixel."""
    grey = draws.whole(3, 15) * 16
    asked = f"""A grey line over black is as wide as a pixel. It is drawn with 1, 4 and 16 samples a pixel.
        What is the grey value, the mean of the samples, of one of its pixels?
        Hint: How many of its samples does the line cover?
        Hint: Should a line fade where there are more samples?
        Hint: With 4 samples: the sum of 4 greys over 4, each {grey} where the line covers the sample."""
    names = ("1 sample", "4 samples", "16 samples")
    return by_rule(asked, f"Grey: {grey}", (grey, (1, 4, 16)), ("line-in-one-sample",), names)


@template("tent-filter", 1, "The tent filter", "resolve", 1)
def draw_tent(draws: Draws) -> Draft:
    """The tent filter."""
    side = 4
    place = Fraction(2 * draws.whole(0, side - 1) + 1, 2 * side)
    distance = abs(place - Fraction(1, 2))
    other = Fraction(2 * draws.whole(0, side - 1) + 1, 2 * side)
    right = [Fraction(float(tent(np.array([float(distance)]))[0])) * (1 - abs(other - Fraction(1, 2)))]
    given = f"Sample at ({number_text(place)}, {number_text(other)}) of the pixel."
    asked = f"""The tent filter weighs a sample by 1 - d in each direction, d its distance from the pixel's
        centre in pixels. What is the weight of this sample, before all are made to sum to 1?
        Hint: How far is it from the centre, in x and in y?
        Hint: Multiply the weights of both directions.
        Hint: (1 - |{number_text(place)} - 1/2|) (1 - |{number_text(other)} - 1/2|)."""
    return numbers(asked, given, right)


@template("luma-contrast", 1, "Is an edge here?", "resolve", 1)
def draw_contrast(draws: Draws) -> Draft:
    """The contrast that FXAA looks at."""
    lumas = [Fraction(draws.whole(5, 95), 100) for _ in range(5)]
    reject(lumas[0] in (min(lumas), max(lumas)))
    names = ("pixel", "above", "below", "left", "right")
    given = "\n".join(f"Luma, {name}: {number_text(luma)}" for name, luma in zip(names, lumas, strict=True))
    asked = f"""FXAA looks for edges in the finished picture. What is the contrast at this pixel, which decides
        whether an edge is here?
        Hint: How far apart do the five lumas lie?
        Hint: It is the range of all five: the largest less the smallest.
        Hint: {number_text(max(lumas))} - {number_text(min(lumas))}."""
    return by_rule(asked, given, (lumas,), ("contrast-to-center",))


@template("stair-end", 1, "How far a stair is smoothed", "resolve", 2)
def draw_stair(draws: Draws) -> Draft:
    """How far FXAA moves a colour."""
    back, forth = draws.whole(1, 9), draws.whole(1, 9)
    near = min(back, forth)
    reject(back == forth or back + forth == 4 * near)
    given = f"Ends: {back} pixels to the left, {forth} to the right"
    asked = f"""FXAA has found a level edge beside a pixel, and walked along it to both ends of its stair. At the
        nearer end both sides turn to the colour of the other side. How far does this end move the pixel's
        colour across the edge, in pixels?
        Hint: At the end of a stair a colour moves by half a pixel, in the middle by nothing.
        Hint: It is 1/2 less the share of the stair that lies between the pixel and the nearer end.
        Hint: 1/2 - {near} / ({back} + {forth})."""
    return by_rule(asked, given, (back, forth), ("moved-in-the-middle", "stair-of-one-side"))


@template("mean-of-bytes", 1, "The mean of two bytes", "resolve", 2)
def draw_mean(draws: Draws) -> Draft:
    """The mean of two bytes."""
    black, white = draws.shuffled((0, draws.whole(180, 255)))
    encoded = max(black, white) / 255
    linear = ((encoded + 0.055) / 1.055) ** 2.4
    right = srgb_byte(linear / 2)
    asked = f"""Half of a pixel shows one grey, half the other; both are sRGB bytes. Which byte shows as much
        light? Decode with ((c + 0.055)/1.055)^2.4, take the mean, encode with 1.055 x^(1/2.4) - 0.055; c and
        x run to 1.
        Hint: Is half the byte half the light?
        Hint: The mean is taken of linear values.
        Hint: A byte over the largest one is c: decode those of {black} and {white}, take the mean, and encode
        it."""
    wrong = {"blended-in-srgb": [int((black + white) / 2 + 0.5)]}
    return numbers(asked, f"Bytes: {black} and {white}", [right], wrong)


@template("multisampling-cost", 1, "What multisampling costs", "resolve", 2)
def draw_cost(draws: Draws) -> Draft:
    """What multisampling costs."""
    count, inside, edge = draws.item((2, 4, 8)), draws.whole(100, 400), draws.whole(20, 90)
    half = count // 2
    given = f"{count} samples a pixel.\n{inside} pixels are covered whole, {edge} by half of their samples."
    asked = f"""A triangle is drawn with MSAA. How often does the fragment shader run, and how many depths are
        compared? Each touched pixel is shaded once; depth is tested at every covered sample.
        Hint: What is done once a pixel?
        Hint: Depth and colour are stored for each sample.
        Hint: Shader runs: {inside} + {edge}; depth tests: {count} * {inside} + {count}/2 * {edge}."""
    right = [inside + edge, count * inside + half * edge]
    return numbers(asked, given, right, names=("shader runs", "depth tests"))
