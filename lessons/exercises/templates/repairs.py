"""Listings to repair or to write: a wrong line, a missing line, a function, and a picture to be drawn."""

from functools import partial

from core.scene import ClipScene
from lessons.exercises.answers.code import CodeAnswer, head_alone, with_line
from lessons.exercises.coding.task import SIDE, Task
from lessons.exercises.coding.tasks import TASKS
from lessons.exercises.drawn_scene import frame_art
from lessons.exercises.draws import Draws
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.drafting import drafted
from lessons.small_scenes import pixel_segments, triangle_scene

REPAIRED = (
    "tie-rule",
    "inside-test",
    "bresenham-lecture",
    "bresenham",
    "midpoint",
    "dda",
    "perspective",
    "affine",
    "depth-test",
    "over",
    "vertex-shader",
    "scaling-shader",
    "diffuse-shader",
    "highlight",
    "texture-shader",
    "alpha-test-shader",
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
    "edge-function",
    "tie-rule",
    "inside-test",
    "bresenham-step",
    "dda",
    "bilinear",
    "depth-test",
    "over",
    "clip-position",
    "lambert",
    "highlight",
    "checker",
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
