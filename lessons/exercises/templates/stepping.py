"""Be the rasterizer, one step at a time: a line, depths, a clipped triangle, weights; and what comes next."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial

import numpy as np

from core import Settings, draw_lines, trace
from core.explain.number_text import DIGITS, exact_text
from core.explain.number_text import number_text as explained_number
from core.explain.records import Value as ShownValue
from core.explain.records import Variable
from core.explain.steps import variables
from core.trace.stage_trace import StageTrace
from lessons.exercises.answers.answer import Answer, Entry, Value
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.answers.steps import Run, StepsAnswer, first_tries
from lessons.exercises.drafting import TOLERANCE, WITHIN, drafted, factor_text, listed, window_text
from lessons.exercises.numbers import Draws, NoQuestionError, number_text, reject
from lessons.exercises.question import Draft, row_draft, template
from lessons.exercises.templates.coverage import corner_text, facing_text, twice_area
from lessons.exercises.templates.fragments import (
    COLORS,
    FRAGMENT_PIXELS,
    HALF,
    NAMES,
    again_text,
    card_scene,
    weights_at,
)
from lessons.exercises.templates.lines import RULE, SIZE, TALL, Ends
from lessons.mistakes.scan_conversion import LECTURE
from lessons.mistakes.twin import in_window
from lessons.small_scenes import pixel_segments, triangle_scene

# Be the rasterizer: Bresenham's line, the depth test and a clipped triangle, one step at a time.


def line_values(ends: Ends, twin: str = "") -> list[Value]:
    """Return D before each move and the pixel after it, in turn, by the rule of a twin from the right state."""
    drawn = draw_lines(in_window(pixel_segments([ends], TALL)), *TALL, LECTURE.line)
    (x0, y0), (x1, y1) = ends
    dx, dy = x1 - x0, y1 - y0
    values: list[Value] = []
    following = dy - dx if twin == "start-not-doubled" else 2 * dy - dx
    for number, (D, (column, row)) in enumerate(
        zip(drawn.steps.decision, drawn.pixels.tolist(), strict=True)
    ):
        if number:
            steps_at_tie = twin == "ties-step" and D == 0
            values += [Fraction(following), (column, row + steps_at_tie)]
            is_lowered = D > 0 and twin != "not-corrected"
            following = int(D) + 2 * dy - (2 * dx if is_lowered else 0)
    return values


@template("bresenham-steps", 1, "Be the rasterizer: Bresenham", "raster", 6)
def draw_line(draws: Draws) -> Draft:
    """Bresenham's D and pixels in turn."""
    dx = draws.whole(5, 7)
    x0, y0 = draws.whole(0, 3), draws.whole(0, 2)
    ends = (x0, y0), (x0 + dx, y0 + draws.whole(1, dx - 1))
    steps = []
    for number, value in enumerate(line_values(ends)):
        move = number // 2 + 1
        if number % 2 == 0:
            steps.append(Entry(f"D before move {move}", "number", value))
        else:
            steps.append(Entry(f"the pixel after move {move}", "pixel", value))
    wrong = {
        name: first_tries(line_values(ends, name), steps)
        for name in ("ties-step", "not-corrected", "start-not-doubled")
    }
    (x1, y1) = ends[1]
    asked = f"""Be the rasterizer: give D before each move, then the pixel that is drawn next. {RULE}
        Hint: One step at a time: first D, then the pixel that it chooses.
        Hint: D above 0 steps up; D of 0 or below stays in the row.
        Hint: dx = {x1} - {x0}, dy = {y1} - {y0}."""
    given = f"From pixel {ends[0]}, which is drawn, to pixel {ends[1]}."
    answer = StepsAnswer(tuple(steps), SIZE)
    return drafted(asked, given, answer, wrong, pixel_segments([ends], SIZE), LECTURE)


VERDICTS = ("passes", "fails")
FRAGMENT_COUNT = 8


def depth_verdicts(fragments: list[tuple[int, int]], twin: str = "") -> list[Value]:
    """Return for each fragment whether it passes (0) or fails (1), by the rule of a twin from the right state."""
    stored: dict[int, int] = {}
    verdicts: list[Value] = []
    for pixel, z in fragments:
        held = stored.get(pixel)
        is_nearer = held is None or z < held
        passes = {"farther-wins": held is None or not is_nearer, "no-depth-test": True}.get(twin, is_nearer)
        verdicts.append(int(not passes))
        stored[pixel] = z if is_nearer else stored[pixel]
    return verdicts


@template("depth-test-steps", 1, "Be the depth test", "depth", 4)
def draw_depth(draws: Draws) -> Draft:
    """The depth test of fragments."""
    fragments = [(draws.whole(0, FRAGMENT_PIXELS - 1), draws.whole(10, 99)) for _ in range(FRAGMENT_COUNT)]
    reject(len({z for _, z in fragments}) < FRAGMENT_COUNT)
    right = depth_verdicts(fragments)
    reject(not 3 <= sum(right) <= 5)
    steps = tuple(
        Entry(f"fragment {k}: pixel {pixel}, z = {z}", "choice", verdict, VERDICTS)
        for k, ((pixel, z), verdict) in enumerate(zip(fragments, right, strict=True))
    )
    wrong = {
        name: first_tries(depth_verdicts(fragments, name), steps)
        for name in ("farther-wins", "no-depth-test")
    }
    asked = f"""Be the depth test: does each fragment pass? Smaller is nearer, the buffer begins at infinity,
        and a tie keeps what is there.
        Hint: The first fragment of every pixel passes.
        Hint: A fragment passes only where its z is smaller than what its pixel holds.
        Hint: {again_text(fragments)}"""
    return drafted(asked, "", StepsAnswer(steps), wrong, card_scene(fragments))


OUTPUTS = ("nothing", "the crossing", "the end", "the crossing, then the end")
BORDER = 8


def side_output(start_is_in: bool, end_is_in: bool) -> int:
    """Return which of ``OUTPUTS`` a side puts out."""
    return 2 * end_is_in + (start_is_in != end_is_in)


@template("clip-side-steps", 1, "Be Sutherland-Hodgman", "clip", 4)
def draw_clip(draws: Draws) -> Draft:
    """A triangle that the right border cuts, side by side."""
    corners = [(Fraction(draws.whole(1, 14)), Fraction(draws.whole(0, 8))) for _ in range(3)]
    inside = [x <= BORDER for x, _ in corners]
    reject(twice_area(corners) < 12 or sum(inside) not in (1, 2) or any(x == BORDER for x, _ in corners))
    steps: list[Entry] = []
    for k, ((x0, y0), (x1, y1)) in enumerate(zip(corners, [*corners[1:], corners[0]], strict=True)):
        output = side_output(inside[k], inside[(k + 1) % 3])
        steps.append(Entry(f"side {k}: what is put out", "choice", output, OUTPUTS))
        if inside[k] != inside[(k + 1) % 3]:
            y = y0 + (BORDER - x0) * (y1 - y0) / (x1 - x0)
            steps.append(
                Entry(f"side {k}: the crossing (x, y)", "place", (Fraction(BORDER), y), tolerance=0.05)
            )
    names = ("side 0 from corner 0 to 1", "side 1 from corner 1 to 2", "side 2 from corner 2 to 0")
    given = f"Corners 0, 1, 2: {corner_text(corners)}; {', '.join(names)}."
    cut = next(k for k in range(3) if inside[k] != inside[(k + 1) % 3])
    (x0, y0), (x1, y1) = corners[cut], corners[(cut + 1) % 3]
    asked = f"""Be Sutherland-Hodgman at the border x = {BORDER}: inside is where x is smaller. For each side
        from its start to its end, say what is put out, and where the side crosses the border. Fractions, or
        decimals within 0.05.
        Hint: Only two things matter: is the start inside, and is the end?
        Hint: A side that ends inside puts out its end; a side that changes sides puts out its crossing first.
        Hint: Side {cut} crosses the border at y = {y0} + ({BORDER} - {x0}) ({y1} - {y0}) / ({x1} - {x0})."""
    return drafted(asked, given, StepsAnswer(tuple(steps), (12, 9)))


# Be the rasterizer in numbers: a vertex through the spaces, weights at a pixel, layers one after the other.


def number_steps(names: tuple[str, ...], values: tuple[Fraction, ...]) -> tuple[Entry, ...]:
    """Return a step for each number."""
    return tuple(
        Entry(name, "number", value, tolerance=TOLERANCE) for name, value in zip(names, values, strict=True)
    )


SPACES = ("w", "x in NDC", "y in NDC", "x in the window", "y in the window")
SPACES_SIZE = (8, 6)


def spaces_of(x: Fraction, y: Fraction, z: Fraction) -> tuple[Fraction, ...]:
    """Return w, NDC and window of an eye point, with a field of view of 90 degrees both ways."""
    w = -z
    ndc = x / w, y / w
    return w, *ndc, *((n + 1) / 2 * side for n, side in zip(ndc, SPACES_SIZE, strict=True))


@template("space-steps", 1, "Be the transform", "transform", 4)
def draw_spaces(draws: Draws) -> Draft:
    """A vertex from the eye to the window."""
    d = draws.whole(2, 8)
    x, y = (Fraction(draws.whole(-d + 1, d - 1)) for _ in range(2))
    reject(x == 0 or y == 0)
    right = spaces_of(x, y, Fraction(-d))
    steps = number_steps(SPACES, right)
    down: Run = first_tries((*right[:4], SPACES_SIZE[1] - right[4]), steps)
    no_w: Run = first_tries((Fraction(1), *right[1:]), steps)
    given = f"Eye point ({x}, {y}, -{d}), window of {SPACES_SIZE[0]} x {SPACES_SIZE[1]} pixels."
    asked = f"""Be the transform: give w after the perspective matrix, the point in NDC, and the point in the
        window, y up. The camera looks along -z, 90 degrees wide and high. {WITHIN}
        Hint: With 90 degrees the matrix keeps x and y.
        Hint: NDC is x/w and y/w.
        Hint: w = -(-{d}), x in NDC is {factor_text(x)} / w, and x in the window is (NDC + 1)/2 *
        {SPACES_SIZE[0]}."""
    return drafted(asked, given, StepsAnswer(steps, SPACES_SIZE), {"y-down": down, "w-is-one": no_w})


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


# What comes next: the questions of Predict, asked of a run that is drawn from a seed.


RUN_SIZE = (12, 9)
RUN_SETTINGS = Settings(fill="bounding-box")
ROW_LIMIT = 40
"""Most rows that are tried to find one that is asked about."""
HIDDEN = ("column", "row", "number")
"""Variables that the question names by itself."""
NEXT_HINTS = {
    "transform": (
        "Which space does the step lead to?",
        "A divide is by w; the viewport maps [-1, 1] to W and H.",
        "From {position before} the divide gives x/w and y/w, the viewport (x + 1)/2 * {W} and (y + 1)/2 * {H}.",
    ),
    "edges": (
        "The edge function is a x + b y + c.",
        "a is how much it changes from one pixel to the next.",
        "E is 0 at the edge's start {edge start} and at its end {edge end}: a x + b y + c is 0 with both.",
    ),
    "raster": (
        "Which side of each edge is the centre (i + 1/2, j + 1/2) on?",
        "All three edges must agree.",
        "E0 = {a0} * {x} + {b0} * {y} + {c0}; E1 and E2 likewise.",
    ),
    "interpolate": (
        "Put the centre into the three edge functions.",
        "A weight is its value over their sum.",
        "E0 = {a0} * {x} + {b0} * {y} + {c0}, E1 and E2 likewise; λk = Ek / (E0 + E1 + E2).",
    ),
    "depth": (
        "Compare the depth of the fragment with the depth in the buffer.",
        "Smaller is nearer, and a tie keeps what is there.",
        "Is {z new} smaller than what the buffer holds?",
    ),
}
"""By the stages that are asked about; the last one with variables of the step."""
NEXT_RULES = {
    "transform": "NDC x and y run from -1 to 1; y points up.",
    "edges": "Edge k lies opposite to corner k; every E is made positive inside of the triangle.",
    "raster": "Inside all three E = a x + b y + c are positive; where E is 0, the edge decides: does it own ties?",
    "interpolate": "Edge k lies opposite to corner k, with E = a x + b y + c; all w are 1.",
    "depth": "Smaller is nearer, and a tie keeps what is there.",
}
"""What decides, by stage."""


def _corners(draws: Draws) -> list[tuple[int, int]]:
    return [(draws.whole(0, 11), draws.whole(0, 8)) for _ in range(3)]


def _text(value: ShownValue) -> str:
    if isinstance(value, tuple):
        return f"({', '.join(map(explained_number, value))})"
    return str(value) if value is None or isinstance(value, str | bool) else explained_number(value)


def step_variables(stage: StageTrace, row: int) -> Sequence[Variable]:
    """Return the variables of a row; all that its first operation is the first to show count as changed."""
    explanation = stage.explain(int(stage.steps.starts[row]) + 1)
    if explanation is None:
        return ()
    first = stage.steps.operations[stage.kind_of(row)][0]
    return variables(replace(explanation, changed=first.shows))


def known_text(shown: Sequence[Variable]) -> str:
    """Return what is known before a row."""
    known = [one for one in shown if not one.is_changed() and one.name not in HIDDEN]
    return "\n".join(f"{one.name} = {_text(one.now)}" for one in known)


def hints_with(hints: Sequence[str], shown: Sequence[Variable]) -> tuple[str, ...]:
    """Return hints with the variables that they name, what is negative in brackets."""
    texts = {
        one.name: exact_text(one.now, one.digits.get(one.now, DIGITS))
        if isinstance(one.now, float)
        else _text(one.now)
        for one in shown
    }
    named = {name: f"({text})" if text.startswith("−") else text for name, text in texts.items()}
    return tuple(hint.format_map(named) for hint in hints)


def is_shown(answer: Answer, shown: Sequence[Variable]) -> bool:
    """Return whether a number that is asked for is a coordinate before the step."""
    before = next(one.now for one in shown if one.name == "position before")
    assert isinstance(before, tuple)
    return any(answer.is_same((float(coordinate),), answer.reference) for coordinate in before)


def draw_step(stage_name: str, draws: Draws) -> Draft:
    """A step of a run with two triangles."""
    corners = [_corners(draws), _corners(draws)]
    depths = [[draws.whole(1, 9) / 10 for _ in range(3)] for _ in corners]
    reject(min(abs(np.linalg.det(np.diff(np.array(one, float), axis=0))) for one in corners) < 12)
    # With w = 1 the divide would change nothing, and its result would stand in the question.
    w = [[draws.item((2, 4, 5)) for _ in range(3)] for _ in corners] if stage_name == "transform" else 1.0
    scene = triangle_scene(corners, RUN_SIZE, depth=depths, w=w)
    stage = trace(scene, RUN_SETTINGS).stage(stage_name)
    rows = (draws.whole(0, stage.steps.row_count - 1) for _ in range(ROW_LIMIT))
    asked = ((row, draft) for row in rows if (draft := row_draft(stage, row)) is not None)
    row, draft = next(asked, (-1, None))
    if draft is None:
        raise NoQuestionError(f"nothing is asked about {ROW_LIMIT} rows")
    # Nothing is there yet: every fragment passes.
    reject(isinstance(draft.answer, ChoiceAnswer) and stage_name == "depth" and "holds 1 " in draft.text)
    shown_variables = step_variables(stage, row)
    reject(stage_name == "transform" and is_shown(draft.answer, shown_variables))
    places = listed("Triangle {k}: {}, depth {}", corners, depths)
    # Where the corners lie in the window is what the transform finds.
    shown = [window_text(RUN_SIZE), *([] if stage_name == "transform" else [places])]
    given = "\n".join([NEXT_RULES[stage_name], *shown, "Before the step:", known_text(shown_variables)])
    return Draft(
        draft.text,
        given,
        draft.answer,
        hints_with(NEXT_HINTS[stage_name], shown_variables),
        {},
        None if stage_name == "transform" else scene,
        RUN_SETTINGS,
        draft.pixel,
        draft.reveal,
    )


for _stage in NEXT_HINTS:
    _version = 1 + (_stage == "transform")
    template(f"next-{_stage}", _version, f"What comes next: {_stage}", _stage, 1)(partial(draw_step, _stage))
