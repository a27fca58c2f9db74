"""Be the rasterizer in numbers: a vertex through the spaces, weights at a pixel, layers one after the other."""

from fractions import Fraction

from lessons.exercises.answers.cells import Entry
from lessons.exercises.answers.steps import Run, StepsAnswer, first_tries
from lessons.exercises.draws import Draws, reject
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import corner_text, facing_text, twice_area
from lessons.exercises.templates.drafting import TOLERANCE, WITHIN, drafted, factor_text, listed
from lessons.exercises.templates.fragments import COLORS, HALF, NAMES, weights_at
from lessons.small_scenes import triangle_scene


def number_steps(names: tuple[str, ...], values: tuple[Fraction, ...]) -> tuple[Entry, ...]:
    """Return a step for each number."""
    return tuple(
        Entry(name, "number", value, tolerance=TOLERANCE) for name, value in zip(names, values, strict=True)
    )


SPACES = ("w", "x in NDC", "y in NDC", "x in the window", "y in the window")
SIZE = (8, 6)


def spaces_of(x: Fraction, y: Fraction, z: Fraction) -> tuple[Fraction, ...]:
    """Return w, NDC and window of an eye point, with a field of view of 90 degrees both ways."""
    w = -z
    ndc = x / w, y / w
    return w, *ndc, *((n + 1) / 2 * side for n, side in zip(ndc, SIZE, strict=True))


@template("space-steps", 1, "Be the transform", "transform", 4)
def draw_spaces(draws: Draws) -> Draft:
    """A vertex from the eye to the window."""
    d = draws.whole(2, 8)
    x, y = (Fraction(draws.whole(-d + 1, d - 1)) for _ in range(2))
    reject(x == 0 or y == 0)
    right = spaces_of(x, y, Fraction(-d))
    steps = number_steps(SPACES, right)
    down: Run = first_tries((*right[:4], SIZE[1] - right[4]), steps)
    no_w: Run = first_tries((Fraction(1), *right[1:]), steps)
    given = f"Eye point ({x}, {y}, -{d}), window of {SIZE[0]} x {SIZE[1]} pixels."
    asked = f"""Be the transform: give w after the perspective matrix, the point in NDC, and the point in the
        window, y up. The camera looks along -z, 90 degrees wide and high. {WITHIN}
        Hint: With 90 degrees the matrix keeps x and y.
        Hint: NDC is x/w and y/w.
        Hint: w = -(-{d}), x in NDC is {factor_text(x)} / w, and x in the window is (NDC + 1)/2 *
        {SIZE[0]}."""
    return drafted(asked, given, StepsAnswer(steps, SIZE), {"y-down": down, "w-is-one": no_w})


@template("weight-steps", 1, "Be the interpolation", "interpolate", 4)
def draw_weights(draws: Draws) -> Draft:
    """Edge functions and weights at a centre."""
    corners = [(Fraction(draws.whole(0, 10)), Fraction(draws.whole(0, 8))) for _ in range(3)]
    pixel = draws.whole(2, 8), draws.whole(2, 6)
    area = twice_area(corners)
    reject(area < 20)
    weights = weights_at(corners, (pixel[0] + HALF, pixel[1] + HALF))
    reject(min(weights) <= 0)
    names = ("twice the area", "E0", "E1", "E2", *NAMES)
    right = (area, *(weight * area for weight in weights), *weights)
    steps = number_steps(names, right)
    turned = first_tries((*right[:4], *right[5:], right[4]), steps)
    asked = f"""Be the interpolation at the centre of pixel {pixel}: twice the area of the triangle, then
        twice the area of the centre with the edge opposite to each vertex, then the weights. {WITHIN}
        Hint: The determinant (x1 - x0)(y2 - y0) - (y1 - y0)(x2 - x0) is twice the area.
        Hint: E0 belongs to the edge from vertex 1 to vertex 2.
        Hint: Twice the area is {facing_text(corners)}; each weight is its E over it."""
    scene = triangle_scene([corners], (11, 9))
    given = f"Vertices 0, 1, 2: {corner_text(corners)}"
    return drafted(
        asked, given, StepsAnswer(steps, (11, 9)), {"weights-permuted": turned}, scene, pixel=pixel
    )


@template("layer-steps", 1, "Be the blending", "blend", 3)
def draw_layers(draws: Draws) -> Draft:
    """Red after each of four layers."""
    names = [draws.item(tuple(COLORS)) for _ in range(4)]
    alphas = [Fraction(draws.whole(1, 3), 4) for _ in names]
    red, values, exchanged = Fraction(0), [], []
    for name, alpha in zip(names, alphas, strict=True):
        new = Fraction(COLORS[name][0])
        exchanged.append((1 - alpha) * new + alpha * red)
        red = alpha * new + (1 - alpha) * red
        values.append(red)
    reject(len(set(values)) < 3)
    steps = number_steps(tuple(f"red after layer {k}" for k in range(4)), tuple(values))
    given = "Background: black, opaque.\n" + listed("Layer {k}: {}, alpha = {}", names, alphas)
    asked = f"""Be the blending: each layer is blended with over on what is there. What is the red of the
        pixel after each, linear? Red, yellow and white have red 1, green and blue have red 0. {WITHIN}
        Hint: over: alpha times the new red plus (1 - alpha) times what is there.
        Hint: A layer without red only weakens what is there.
        Hint: Layer 0: {number_text(alphas[0])} * {COLORS[names[0]][0]} + (1 - {number_text(alphas[0])}) *
        0."""
    wrong = {"factors-exchanged": first_tries(exchanged, steps)}
    return drafted(asked, given, StepsAnswer(steps), wrong)
