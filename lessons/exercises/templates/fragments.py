"""Weights, perspective, depth and blending at a pixel, and the order of the stages."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np

from core import STAGES, Settings, render
from core.records.frame import Frame
from core.scene import ClipScene
from lessons.exercises.answers.answer import Value
from lessons.exercises.answers.choices import OrderAnswer
from lessons.exercises.answers.fields import (
    Column,
    Follow,
    NearMiss,
    NumberAnswer,
    Numbers,
    Row,
    Rows,
    TableAnswer,
    number_rows,
)
from lessons.exercises.drafting import TOLERANCE, WITHIN, drafted, factor_text, listed
from lessons.exercises.numbers import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import Corner, corner_text, facing_text, twice_area
from lessons.mistakes.shelf import SHELF
from lessons.small_scenes import EVERYWHERE, triangle_scene

HALF = Fraction(1, 2)
NAMES = ("alpha", "beta", "gamma")


def attributes_at(frame: Frame, pixel: tuple[int, int]) -> Numbers:
    """Return the attributes at a pixel."""
    return tuple(float(value) for value in frame.attributes[pixel[1], pixel[0]])


def weights_at(corners: Sequence[Corner], point: Corner) -> tuple[Fraction, ...]:
    """Return alpha, beta and gamma: areas over the area of the triangle."""
    whole = twice_area(corners)
    return tuple(twice_area([point, corners[(k + 1) % 3], corners[(k + 2) % 3]]) / whole for k in range(3))


def triangle_and_pixel(draws: Draws) -> tuple[list[Corner], tuple[int, int], tuple[Fraction, ...]]:
    """Draw a triangle and a pixel inside, with the weights of its centre."""
    corners = [(Fraction(draws.whole(0, 10)), Fraction(draws.whole(0, 8))) for _ in range(3)]
    pixel = draws.whole(2, 8), draws.whole(2, 6)
    reject(twice_area(corners) < 20)
    weights = weights_at(corners, (pixel[0] + HALF, pixel[1] + HALF))
    reject(min(weights) < Fraction(1, 20))
    return corners, pixel, weights


@template("barycentric-weights", 2, "Barycentric weights", "interpolate", 3)
def draw_weights(draws: Draws) -> Draft:
    """Barycentric weights at a centre."""
    corners, pixel, weights = triangle_and_pixel(draws)
    scene = triangle_scene([corners], (11, 9), attributes=np.eye(3)[None])
    wrong = {"weights-permuted": attributes_at(SHELF["weights-permuted"].draw(scene, Settings()), pixel)}
    shifted = SHELF["corner-for-center"].draw(scene, Settings())
    if shifted.primitive[pixel[1], pixel[0]] >= 0:
        wrong["corner-for-center"] = attributes_at(shifted, pixel)
    asked = f"""What are alpha, beta and gamma at the centre of pixel {pixel}? {WITHIN}
        Hint: Each weight is an area over the area of the triangle.
        Hint: alpha belongs to vertex 0: it is the area of the centre with vertices 1 and 2.
        Hint: The three weights sum to 1.
        Hint: The area of the whole triangle is half of {facing_text(corners)}."""
    turns = ((weights[2], *weights[:2]), (*weights[1:], weights[0]))
    turned = NearMiss(
        turns, Fraction(1, 3), "The right weights, moved on by one vertex in either direction, earn a third."
    )
    answer = NumberAnswer(weights, (3,), NAMES, TOLERANCE, (turned,))
    given = f"Vertices 0, 1, 2: {corner_text(corners)}"
    return drafted(asked, given, answer, wrong, scene, pixel=pixel)


@template(
    "perspective-u",
    1,
    "Perspective against affine",
    "interpolate",
    3,
    alike=(frozenset({"affine-for-perspective", "w-overwritten"}),),
)
def draw_perspective(draws: Draws) -> Draft:
    """An attribute under perspective; the weights are given."""
    pixel = draws.whole(1, 6), draws.whole(1, 6)
    beta, gamma = Fraction(pixel[0], 8), Fraction(pixel[1], 8)
    weights = (1 - beta - gamma, beta, gamma)
    reject(weights[0] <= 0)
    w = [Fraction(draws.item((1, 2, 4, 5))) for _ in range(3)]
    u = [Fraction(draws.whole(0, 8)) for _ in range(3)]
    over_w = sum((weight / each for weight, each in zip(weights, w, strict=True)), Fraction(0))
    u_over_w = sum((a * b / c for a, b, c in zip(weights, u, w, strict=True)), Fraction(0))
    corners = [(0.5, 0.5), (8.5, 0.5), (0.5, 8.5)]
    scene = triangle_scene([corners], (10, 10), w=[w], attributes=[[[value] for value in u]])
    names = ("affine-for-perspective", "w-overwritten", "not-divided-back", "multiplied-by-w")
    wrong = {name: attributes_at(SHELF[name].draw(scene, Settings()), pixel) for name in names}
    given = listed("Vertex {k}: {} = {}, u = {}, w = {}", NAMES, weights, u, w)
    lower_sum = " + ".join(f"{factor_text(a)}/{b}" for a, b in zip(weights, w, strict=True))
    asked = f"""What is u at this pixel with perspective? The weights are those of the window. {WITHIN}
        Hint: u is not linear in the window, but two other values are.
        Hint: Interpolate u/w and 1/w with the weights.
        Hint: u = (sum of weight u/w) / (sum of weight 1/w).
        Hint: The lower sum: {lower_sum}."""
    answer = NumberAnswer((u_over_w / over_w,), (), ("u",), TOLERANCE)
    return drafted(asked, given, answer, wrong, scene, pixel=pixel)


Fragment = tuple[int, int]
"""Pixel and hundredths of depth."""
FRAGMENT_COUNT = 7
FRAGMENT_PIXELS = 3
"""In a row, in which the fragments lie."""


def card_scene(fragments: Sequence[Fragment]) -> ClipScene:
    """Return triangles that each cover one pixel of a row."""
    corners = [[(k + 0.25, 0.25), (k + 0.9, 0.25), (k + 0.25, 0.9)] for k, _ in fragments]
    depth = [[z / 100] * 3 for _, z in fragments]
    return triangle_scene(corners, (FRAGMENT_PIXELS, 1), depth=depth)


def stored_depths(fragments: Sequence[Fragment], twin: str = "") -> Rows:
    """Return the hundredths of depth stored after each fragment at its pixel, by drawing one more each time."""
    depths = []
    for count, (pixel, _) in enumerate(fragments, 1):
        scene = card_scene(fragments[:count])
        frame = SHELF[twin].draw(scene, Settings()) if twin else render(scene)
        depths.append([round(100 * float(frame.depth[0, pixel]))])
    return number_rows(depths)


def again_text(fragments: Sequence[Fragment]) -> str:
    """Return the first comparison at a pixel that holds a depth already, as a question."""
    held: dict[int, int] = {}
    for pixel, z in fragments:
        if pixel in held:
            return f"z = {z} comes to pixel {pixel}: is {z} smaller than {held[pixel]}?"
        held[pixel] = z
    raise ValueError(f"expected more fragments than pixels, got {len(fragments)}")


def follow_buffer(
    fragments: Sequence[tuple[int, int | Fraction]], nearer: Callable[[Iterable[Fraction]], Fraction]
) -> Follow:
    """Return the follow-through of a buffer that keeps the ``nearer`` of what it holds and what comes."""

    def follow(own: Sequence[Row], row: int, mine: Row) -> Value:
        pixel, value = fragments[row]
        before = [stored for (stored,), (its, _) in zip(own, fragments, strict=False) if its == pixel]
        return nearer((Fraction(value), *before[-1:]))

    return follow


def depth_table(fragments: Sequence[Fragment]) -> TableAnswer:
    """Return the table of stored depths, with follow-through."""
    labels = tuple(f"pixel {pixel}, z = {z}" for pixel, z in fragments)
    follow = follow_buffer(fragments, min)
    return TableAnswer((Column("stored"),), labels, stored_depths(fragments), follow)


@template("z-buffer-table", 1, "Z-buffer, fragment by fragment", "depth", 4)
def draw_depths(draws: Draws) -> Draft:
    """A z-buffer, fragment by fragment."""
    fragments = [(draws.whole(0, FRAGMENT_PIXELS - 1), draws.whole(10, 99)) for _ in range(FRAGMENT_COUNT)]
    reject(len(set(fragments)) < len(fragments))
    wrong = {name: stored_depths(fragments, name) for name in ("farther-wins", "no-depth-test")}
    asked = f"""These fragments are drawn in order. What does the z-buffer hold at the pixel of each right
        after it was tested? Smaller is nearer, the buffer begins at infinity, and a tie keeps what is there.
        Hint: Follow one pixel at a time.
        Hint: A fragment passes only where its z is smaller than what its pixel holds.
        Hint: {again_text(fragments)} After one that fails, the pixel holds what it held."""
    return drafted(asked, "", depth_table(fragments), wrong, card_scene(fragments))


COLORS = {"red": (1, 0, 0), "green": (0, 1, 0), "blue": (0, 0, 1), "yellow": (1, 1, 0), "white": (1, 1, 1)}


@template("blend-over", 1, "Layers blended in order", "blend", 3)
def draw_blend(draws: Draws) -> Draft:
    """Layers blended in order."""
    names = draws.shuffled(tuple(COLORS))[:2]
    alphas = [Fraction(draws.whole(1, 3), 4) for _ in names]
    color = [Fraction(0)] * 3
    for name, alpha in zip(names, alphas, strict=True):
        color = [alpha * new + (1 - alpha) * old for new, old in zip(COLORS[name], color, strict=True)]
    layers = [[(*COLORS[name], float(alpha))] * 3 for name, alpha in zip(names, alphas, strict=True)]
    scene = replace(
        triangle_scene([EVERYWHERE] * 2, (2, 2), attributes=layers), background=np.array([0.0, 0.0, 0.0, 1.0])
    )
    settings = Settings(blend="over", visibility="last-drawn")
    twins = ("order-reversed", "multiplied-twice", "blended-in-srgb", "factors-exchanged")
    wrong = {
        twin: tuple(float(value) for value in SHELF[twin].draw(scene, settings).color[0, 0, :3])
        for twin in twins
    }
    layers_text = listed("Layer {k}: {} {}, alpha = {}", names, map(COLORS.get, names), alphas)
    given = f"Background: black, opaque.\n{layers_text}"
    asked = f"""The layers are blended with over, layer 0 first. What are red, green and blue, linear?
        {WITHIN}
        Hint: Blend layer 0 over the background first.
        Hint: over: alpha times the new colour plus (1 - alpha) times what is there.
        Hint: Layer 1 weakens everything below it by 1 - alpha.
        Hint: red: {factor_text(alphas[1])} * {COLORS[names[1]][0]} + (1 - {factor_text(alphas[1])}) * the red
        before."""
    answer = NumberAnswer(tuple(color), (3,), ("red", "green", "blue"), TOLERANCE)
    return drafted(asked, given, answer, wrong, scene, settings, pixel=(0, 0))


@template("stage-order", 2, "Order of the stages", "transform", 2)
def draw_stages(draws: Draws) -> Draft:
    """Stages in an order that all pipelines share: others clip before they cull, or test depth before they shade."""
    left_out = {"edges", draws.item(("cull", "clip")), *draws.item((("depth",), ("interpolate", "shade")))}
    mixed = draws.shuffled([stage for stage in STAGES if stage not in left_out])[:6]
    options = tuple(stage for stage in STAGES if stage in mixed)
    shown = draws.shuffled(options)
    asked = f"""Put these stages of the pipeline in order, first to last.
        Hint: What needs triangles comes before what needs pixels.
        Hint: A colour is found before it is blended.
        Hint: Which of {", ".join(shown[:2])} needs the result of the other one?"""
    return drafted(asked, "", OrderAnswer(options, shown))
