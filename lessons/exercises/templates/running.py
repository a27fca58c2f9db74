"""Judged by running: listings to repair or to write, weak methods to break, no more chosen than needed."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import partial

import numpy as np

from core import Settings, render
from core.scene import AnyScene, ClipScene
from lessons.exercises.answers.answer import Dial
from lessons.exercises.answers.listings import CodeAnswer, head_alone, with_line
from lessons.exercises.answers.trials import BreakAnswer, CheapestAnswer, Family, Values
from lessons.exercises.coding.task import SIDE, Task
from lessons.exercises.coding.tasks import TASKS
from lessons.exercises.drafting import Corner, drafted, frame_art, window_text
from lessons.exercises.file_answers import FAILS, byte_error, is_drawn_twice
from lessons.exercises.numbers import Draws, NoQuestionError, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import SIZE, corner_text
from lessons.scenes import make_scene
from lessons.small_scenes import EVERYWHERE, pixel_segments, triangle_scene

# Break a weak method, and choose no more than needed: judged by running.


SEARCH_LIMIT = 200
"""Most values of the dials that are tried to find some that break the weak method."""
Fails = Callable[[ClipScene, Settings], bool]


def breaking(
    draws: Draws,
    dials: tuple[Dial, ...],
    start: Values,
    scene_of: Callable[[Values], ClipScene],
    weak: Settings,
    robust: Settings,
    fails: Fails,
    rule: str,
) -> BreakAnswer:
    """Return the answer: the weak method fails not from the start, but for values that are tried."""

    def breaks(values: Values) -> bool:
        scene = scene_of(values)
        return fails(scene, weak) and not fails(scene, robust)

    reject(breaks(start))
    for _ in range(SEARCH_LIMIT):
        values = tuple(draws.step(dial.low, dial.high, dial.step) for dial in dials)
        if breaks(values):
            return BreakAnswer(dials, start, values, scene_of, weak, robust, fails, rule)
    raise NoQuestionError(f"none of {SEARCH_LIMIT} values breaks the weak method")


def cheapest(
    costs: Mapping[str, Mapping[str, int]], limit: Fraction, scene: AnyScene, base: Settings
) -> CheapestAnswer:
    """Return the answer: the cheapest methods within the tolerance are neither of the ends."""
    families = tuple(Family(name, tuple(of), tuple(map(Fraction, of.values()))) for name, of in costs.items())
    try:
        return CheapestAnswer(families, limit, byte_error(scene, base), base)
    except ValueError as problem:
        raise NoQuestionError(str(problem)) from None


@template("break-inclusive", 1, "Break the rule E >= 0", "raster", 3)
def draw_shared_corner(draws: Draws) -> Draft:
    """The common corner of two triangles."""
    quarter, half = Fraction(1, 4), Fraction(1, 2)
    left = (quarter, draws.whole(2, 5) + quarter)
    right = (Fraction(47, 4), draws.whole(2, 5) + quarter)
    top = (draws.whole(4, 7) + half, Fraction(35, 4))
    start = (draws.whole(3, 8) + quarter, Fraction(1) + quarter)
    dials = (
        Dial("x", low=Fraction(3), high=Fraction(9), step=quarter, corner=(0, 1, 0)),
        Dial("y", high=Fraction(2), step=quarter, corner=(0, 1, 1)),
    )

    def corners_of(values: Values) -> list[list[Corner]]:
        moved = (values[0], values[1])
        return [[left, moved, top], [moved, right, top]]

    def scene_of(values: Values) -> ClipScene:
        return triangle_scene(np.array(corners_of(values), float), SIZE)

    weak, robust = Settings(fill_rule="inclusive"), Settings()
    answer = breaking(draws, dials, start, scene_of, weak, robust, is_drawn_twice, FAILS["twice"])
    first, second = corners_of(start)
    given = f"{window_text(SIZE)} Triangle A: {corner_text(first)}. Triangle B: {corner_text(second)}."
    asked = f"""Two triangles share an edge. Move its lower corner so that the rule E >= 0 on all edges draws
        a pixel twice, and the rule that gives each centre to one triangle does not.
        Hint: Only centres that lie exactly on the common edge are in both triangles.
        Hint: Where must both ends of an edge lie so that it runs through centres?
        Hint: The upper end is {corner_text([top])}. Which edges from there meet a centre (i + 1/2, j +
        1/2)?"""
    return drafted(asked, given, answer, {}, scene_of(start), robust)


PLACES = ((0.5, 0.5), (11.5, 0.5), (0.5, 8.5))


def attribute_error(scene: ClipScene, settings: Settings) -> float:
    """Return how far an attribute is from perspective, at the pixel where it is farthest."""
    right, frame = (render(scene, one) for one in (Settings(), settings))
    return float(np.abs(frame.attributes - right.attributes).max(initial=0))


def is_farther(limit: Fraction, scene: ClipScene, settings: Settings) -> bool:
    """Return whether an attribute is off by more than ``limit``."""
    return attribute_error(scene, settings) > limit


@template("break-affine", 1, "Break affine interpolation", "interpolate", 3)
def draw_affine(draws: Draws) -> Draft:
    """The w of a vertex."""
    span = draws.item((8, 16, 32))
    limit = Fraction(draws.whole(3, 5) * span, 64)
    dials = (Dial("w of vertex 1", low=Fraction(1), high=Fraction(8), step=Fraction(1, 4)),)

    def scene_of(values: Values) -> ClipScene:
        w = np.array([[1, float(values[0]), 1]])
        return triangle_scene([PLACES], SIZE, w=w, attributes=np.array([[[0.0], [span], [0.0]]]))

    weak = Settings(interpolation="affine")
    robust = Settings(interpolation="affine-n", correction_interval=8)
    rule = f"u is wrong by more than {number_text(limit)} at a pixel"
    answer = breaking(draws, dials, (Fraction(1),), scene_of, weak, robust, partial(is_farther, limit), rule)
    given = f"u is {span} at vertex 1 and 0 at the others, whose w is 1."
    asked = f"""Choose w of vertex 1 so that affine interpolation fails and affine interpolation that is
        corrected every 8 pixels does not. Both are compared with perspective, and fail where {rule}.
        Hint: With equal w nothing is wrong.
        Hint: The farther the values of w are apart, the larger is the error of both.
        Hint: Half way from vertex 0 to 1, affine gives {span}/2 and perspective ({span}/w) / (1 + 1/w).
        Corrected every 8 pixels, the error is that of a short part: find a w between too small and too
        large."""
    return drafted(asked, given, answer, {}, scene_of((Fraction(1),)), robust)


OPERATIONS = {"flat": 0, "affine": 5, "affine-n": 6, "perspective": 12}
"""Arithmetic operations at a pixel: three products and two sums; for perspective twice, a division, a reciprocal."""
BYTES = {"z-16": 2, "z-24": 3, "z-float32": 4}
"""Of the depth at a pixel."""


@template("cheapest-methods", 1, "No more than needed", "interpolate", 4)
def draw_cheapest(draws: Draws) -> Draft:
    """Interpolation and the number format of depth."""
    columns = draws.whole(12, 24)
    scene = replace(make_scene("near-plane"), size=(columns, columns * 3 // 4))
    limit = Fraction(draws.whole(2, 20) * 5)
    base = Settings()
    answer = cheapest({"interpolation": OPERATIONS, "depth": BYTES}, limit, scene, base)
    given = f"Scene near-plane, {columns} x {scene.size[1]} pixels. Costs: operations, and bytes of depth, at a pixel."
    asked = f"""Choose the cheapest methods with which no colour channel of any pixel is off by more than
        {number_text(limit)} of 255 from the reference picture (perspective, float32 depth).
        Hint: What does each family change in this scene: colours, or what is seen?
        Hint: Begin with the cheapest of all, and make dearer what the error comes from.
        Hint: Which interpolation stays within {number_text(limit)} of 255? Only one surface is seen at each
        pixel here: how fine must its depth be?"""
    return drafted(asked, given, answer, {}, scene, base)


def hides_nearer(scene: ClipScene, settings: Settings) -> bool:
    """Return whether triangle 0, the farther one, is seen where triangle 1 is nearer."""
    return bool((render(scene, settings).primitive == 0).any())


@template("break-depth-format", 1, "Break 16 bits of depth", "depth", 3)
def draw_depth_format(draws: Draws) -> Draft:
    """Two depths that a format cannot tell apart."""
    base = Fraction(draws.whole(20, 80), 100)
    step = Fraction(1, 400_000)
    dials = (Dial("gap", high=20 * step, step=step),)

    def scene_of(values: Values) -> ClipScene:
        depth = [[float(base)] * 3, [float(base - values[0])] * 3]
        return triangle_scene([EVERYWHERE] * 2, (2, 2), depth=depth)

    weak, robust = Settings(depth="z-16"), Settings()
    rule = "triangle 0 is seen"
    start = (dials[0].high,)
    answer = breaking(draws, dials, start, scene_of, weak, robust, hides_nearer, rule)
    given = (
        f"Depth of triangle 0: {number_text(base)}; of triangle 1: that less the gap. "
        "16 bits hold whole multiples of 1/65535."
    )
    asked = f"""Two triangles cover the window. Triangle 0 is drawn first; triangle 1 is nearer by a gap.
        Choose the gap so that a depth buffer of 16 bits shows the wrong triangle and one of float32 the right
        one.
        Hint: When do both depths round to one multiple?
        Hint: With a gap of 0 both formats see a tie, which keeps triangle 0.
        Hint: The buffer holds {number_text(base)} * 65535, rounded: for which gap is ({number_text(base)} -
        gap) * 65535 rounded to the same number?"""
    return drafted(asked, given, answer, {}, None, robust)


SAMPLES = {"none": 2, "msaa-4": 5, "ssaa-4": 8, "ssaa-16": 32}
"""Coverage tests and shader runs at a pixel."""


@template("cheapest-samples", 1, "No more samples than needed", "resolve", 3)
def draw_samples(draws: Draws) -> Draft:
    """Samples of a pixel."""
    corners = [(draws.whole(1, 44) / 4, draws.whole(1, 32) / 4) for _ in range(3)]
    reject(abs(np.linalg.det(np.diff(np.array(corners), axis=0))) < 24)
    scene = triangle_scene([corners], SIZE, attributes=[[[1.0, 1.0, 1.0, 1.0]] * 3])
    limit, base = Fraction(draws.whole(6, 30) * 5), Settings(antialiasing="ssaa-16")
    answer = cheapest({"antialiasing": SAMPLES}, limit, scene, base)
    places = ", ".join(f"({x:g}, {y:g})" for x, y in corners)
    given = f"{window_text(SIZE)} Corners: {places}.\nCosts: coverage tests and shader runs at a pixel."
    asked = f"""Choose the cheapest antialiasing with which no pixel of this white triangle on black is off by
        more than {number_text(limit)} of 255 from 16 samples.
        Hint: Only pixels on the rim differ.
        Hint: One sample is all or nothing: how far is it off at a pixel that is half covered?
        Hint: Is an error of a quarter of the light more than {number_text(limit)} of 255? Bytes are sRGB: it
        is more than a quarter of the byte."""
    return drafted(asked, given, answer, {}, scene, base)


# Listings to repair or to write: a wrong line, a missing line, a function, and a picture to be drawn.


REPAIRED = (
    *("tie-rule", "inside-test", "bresenham-lecture", "bresenham", "midpoint", "dda", "perspective"),
    *("affine", "depth-test", "over", "vertex-shader", "scaling-shader", "diffuse-shader", "highlight"),
    *("texture-shader", "alpha-test-shader"),
)
COMPLETED = (
    "inside-test",
    "bresenham-lecture",
    "dda",
    "perspective",
    "over",
    "vertex-shader",
    "diffuse-shader",
)
WRITTEN = (
    *("edge-function", "tie-rule", "inside-test", "bresenham-step", "dda", "bilinear", "depth-test"),
    *("over", "clip-position", "lambert", "highlight", "checker"),
)
DRAWN = ("dashes", "open-ends", "thick-line", "stripes", "around")
LINES = pixel_segments([((1, 1), (10, 4)), ((2, 10), (10, 7)), ((0, 4), (3, 10))], (SIDE, SIDE))
TRIANGLE = triangle_scene([[(1.5, 1.0), (10.5, 2.5), (5.0, 11.0)]], (SIDE, SIDE))


def code_draft(task: Task, behind: str, start: str, scene: ClipScene | None = None) -> Draft:
    """Ask for a listing; the mistakes are the task's wrong lines that the shelf names."""
    answer = CodeAnswer(task, start, scene)
    given = "" if answer.picture is None else frame_art(answer.picture)
    return drafted(task.asked, given, answer, answer.named_mistakes, behind=behind)


def draw_repair(task: Task, draws: Draws) -> Draft:
    """A listing with one of its wrong lines."""
    start = task.with_fault(draws.item(task.faults))
    return code_draft(task, "One line of this listing is wrong. Repair it.", start)


def draw_missing(task: Task, draws: Draws) -> Draft:
    """A listing without one of its lines."""
    lines = [line.strip() for line in task.text.split("\n")]
    asked = list(dict.fromkeys(fault.line for fault in task.faults))
    start = with_line(task, lines.index(draws.item(asked)) + 1, None)
    return code_draft(task, "One line of this listing is missing. Write it.", start)


def draw_function(task: Task, draws: Draws) -> Draft:
    """The head of a function."""
    return code_draft(task, "Write the function.", head_alone(task))


def draw_picture(task: Task, draws: Draws) -> Draft:
    """The listing of a plain method, and the picture that it must draw."""
    is_line = task.stage == "raster" and task.shape == "list"
    plain = TASKS["bresenham-lecture" if is_line else "inside-test"]
    behind = "Change this listing so that it draws this picture, and others of its kind."
    return code_draft(task, behind, plain.text, LINES if is_line else TRIANGLE)


for _make, _names, _kind, _title, _points, _is_fixed in (
    (draw_repair, REPAIRED, "repair", "Repair", 3, False),
    (draw_missing, COMPLETED, "missing", "The missing line of", 3, False),
    (draw_function, WRITTEN, "write", "Write", 4, True),
    (draw_picture, DRAWN, "draw", "Draw", 4, True),
):
    for _task in (TASKS[name] for name in _names):
        template(
            f"{_kind}-{_task.name}", 1, f"{_title} {_task.title}", _task.stage, _points, is_fixed=_is_fixed
        )(partial(_make, _task))
