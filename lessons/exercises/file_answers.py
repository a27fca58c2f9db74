"""The answer of an exercise file: what it says, or what the pipeline draws of its scene."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial

from core import Settings, render
from core.scene import AnyScene, ClipScene
from core.setting_texts import settings_from_texts
from core.study.planner.trials import difference, shown
from lessons.exercises import record
from lessons.exercises.answers.answer import Answer, Dial, Entry, NotCheckedError
from lessons.exercises.answers.choices import ChoiceAnswer, OrderAnswer
from lessons.exercises.answers.fields import Column, NumberAnswer, TableAnswer
from lessons.exercises.answers.listings import CodeAnswer, LineAnswer, head_alone, with_line
from lessons.exercises.answers.marked import PixelAnswer, PlaceAnswer, Places, read_art
from lessons.exercises.answers.spot import SpotAnswer
from lessons.exercises.answers.steps import StepsAnswer
from lessons.exercises.answers.trials import BreakAnswer, CheapestAnswer, Family, Values
from lessons.exercises.coding.tasks import task_named
from lessons.exercises.drafting import DrawnScene, different_pixels, frame_art, seen_pixels
from lessons.exercises.numbers import Draws, NoQuestionError
from lessons.mistakes.shelf import SHELF

SEARCH_LIMIT = 400
"""Most places that are tried to find one that breaks a method."""
SCENES_SEARCHED = 3
"""Scenes of one question in which such a place is looked for in vain before its file is refused."""
FAILS = {"differs": "the picture differs from the right one", "twice": "a pixel is drawn twice"}


def answer_of(
    part: record.AnswerPart, drawn: DrawnScene | None, settings: Settings, draws: Draws
) -> tuple[Answer, str]:
    """Return the answer and what the question shows of the scene.

    Raises ValueError if the file does not say what is needed, `NoQuestionError` if only this draw does not give it.
    """
    given = "" if drawn is None else drawn.text()
    if isinstance(part, record.NumberPart):
        count = len(part.values)
        shape = (part.rows, count // part.rows) if part.rows > 1 else (count,) if count > 1 else ()
        return NumberAnswer(tuple(part.values), shape, tuple(part.names), part.tolerance), given
    if isinstance(part, record.TablePart):
        cells = tuple(map(tuple, part.cells))
        heads = tuple(map(Column, part.columns))
        return TableAnswer(heads, tuple(part.labels), cells, tolerance=part.tolerance), given
    if isinstance(part, record.OrderPart):
        drawn_items = set(draws.shuffled(part.items)[: part.count])
        items = tuple(item for item in part.items if item in drawn_items)
        return OrderAnswer(items, draws.shuffled(items)), given
    if isinstance(part, record.LinePart):
        lines, also = part.listing.strip("\n").split("\n"), frozenset(line - 1 for line in part.also)
        return LineAnswer(tuple(lines), part.wrong - 1, also), given
    if isinstance(part, record.CodePart):
        return code_answer(part), given
    if isinstance(part, record.StepsPart):
        size = (1, 1) if drawn is None else drawn.scene.size
        return StepsAnswer(tuple(map(_step, part.steps)), size), given
    if isinstance(part, record.PixelPart):
        return pixel_answer(part, drawn, settings), given
    if isinstance(part, record.PlacePart) and part.places:
        places: Places = tuple((x, y) for x, y in part.places)
        columns, rows = part.size if drawn is None else drawn.scene.size
        return PlaceAnswer((columns, rows), tuple(part.names), places, (), part.step, part.tolerance), given
    if isinstance(part, record.ChoicePart):
        return choice_answer(part, part.right, draws), given
    if drawn is None:
        raise ValueError("expected a scene to draw")
    if isinstance(part, record.PlacePart):
        return corner_answer(drawn, part.corner, settings, part.step)
    if isinstance(part, record.SpotPart):
        return spot_answer((part.mistake, *part.others), drawn, settings, draws)
    if isinstance(part, record.BreakPart):
        return _break_answer(part, drawn, settings, draws), given
    return _cheapest_answer(part, drawn.scene, settings), given


def code_answer(part: record.CodePart) -> CodeAnswer:
    """Return a listing of a task: with another line, without one, the head alone, or as the part has it."""
    task = task_named(part.task)
    if part.right is not None:
        task = replace(task, text=part.right.strip("\n").rstrip(), faults=(), draws_other=True)
    count = len(task.text.split("\n"))
    if part.line is not None and not 2 <= part.line <= count:
        raise ValueError(f"expected a line from 2 to {count} of the listing of {task.name}, got {part.line}")
    if part.line is not None:
        start = with_line(task, part.line, part.wrong)
    else:
        start = head_alone(task) if part.listing is None else part.listing.strip("\n").rstrip()
    try:
        return CodeAnswer(task, start)
    except NotCheckedError as problem:
        raise ValueError(f"the right listing cannot run: {problem}") from None


def choice_answer(part: record.ChoicePart, right: Sequence[str], draws: Draws) -> ChoiceAnswer:
    """Return the options in an order that is drawn; some of them where the part says how many."""
    options = draws.shuffled(part.options)
    if part.count is not None:
        wrong = [option for option in options if option not in right]
        mixed = [option for option in options if option in right]
        low, high = max(1, part.count - len(wrong)), min(len(mixed), part.count - 1)
        count = draws.whole(low, high)
        options = draws.shuffled([*mixed[:count], *wrong[: part.count - count]])
    chosen = frozenset(k for k, option in enumerate(options) if option in right)
    notes = tuple(part.notes.get(option, "") for option in options)
    return ChoiceAnswer(options, chosen, part.several, notes)


def pixel_answer(part: record.PixelPart, drawn: DrawnScene | None, settings: Settings) -> PixelAnswer:
    """Return pixels from text art, or by drawing the scene."""
    if part.art is None:
        if drawn is None:
            raise ValueError("expected art, or a scene to draw")
        if drawn.places and part.triangle is not None and part.triangle >= len(drawn.places):
            raise ValueError(f"expected a triangle from 0 to {len(drawn.places) - 1}, got {part.triangle}")
        right = seen_pixels(render(drawn.scene, settings), part.triangle)
        return PixelAnswer(drawn.scene.size, right, direction=drawn.direction)
    marks = read_art(part.art)
    columns, rows = (1 + max(place) for place in zip(*marks, strict=True))
    of = {mark: frozenset(pixel for pixel, its in marks.items() if its == mark) for mark in "#?"}
    return PixelAnswer((columns, rows), of["#"], of["?"], part.noun)


def _step(part: record.StepPart) -> Entry:
    if part.number is not None:
        return Entry(part.ask, "number", part.number, tolerance=part.tolerance)
    if part.pixel:
        return Entry(part.ask, "pixel", tuple(part.pixel))
    if part.place:
        return Entry(part.ask, "place", tuple(part.place), tolerance=part.tolerance)
    assert part.right is not None
    return Entry(part.ask, "choice", part.options.index(part.right), tuple(part.options))


def corner_answer(
    drawn: DrawnScene, at: Sequence[int], settings: Settings, step: Fraction
) -> tuple[PlaceAnswer, str]:
    """Hide a corner and ask for a place from which the triangles cover the same."""
    place = drawn.corner(at)
    frame = render(drawn.with_corner(at, place), settings)
    right = seen_pixels(frame)
    columns, rows = drawn.scene.size
    if not (right and 0 <= place[0] <= columns and 0 <= place[1] <= rows):
        raise NoQuestionError("expected a corner in the window, of a triangle that covers pixels")

    def scene_of(places: Places) -> ClipScene:
        x, y = places[0]
        return drawn.with_corner(at, (Fraction(x), Fraction(y)))

    def covers_the_same(places: Places) -> bool:
        return seen_pixels(render(scene_of(places), settings)) == right

    answer = PlaceAnswer(
        drawn.scene.size,
        ("corner",),
        (place,),
        step=step,
        is_right=covers_the_same,
        rule="the same pixels are covered",
        scene_of=scene_of,
    )
    return answer, f"{drawn.text(at)}\n{frame_art(frame)}"


def spot_answer(
    names: Sequence[str], drawn: DrawnScene, settings: Settings, draws: Draws
) -> tuple[SpotAnswer, str]:
    """Show what the first of some mistakes makes of the scene; all are there to choose from."""
    scene, mistake = drawn.scene, names[0]
    if not isinstance(scene, ClipScene):
        raise ValueError("expected triangles or segments in the window, got a mesh")
    right = render(scene, settings)
    frames = {name: SHELF[name].draw(scene, settings) for name in names}
    wrong = different_pixels(right, frames[mistake])
    if not 0 < len(wrong) < right.primitive.size:
        raise NoQuestionError(f"{mistake} does not show in some pixels and hide in others")
    for name in names[1:]:
        if not different_pixels(frames[name], frames[mistake]):
            raise NoQuestionError(f"{name} and {mistake} make the same picture")
    mixed = draws.shuffled(names) if len(names) > 1 else ()
    options = tuple(name.replace("-", " ") for name in mixed)
    number = mixed.index(mistake) if mixed else 0
    answer = SpotAnswer(scene.size, frames[mistake], wrong, options, number)
    return answer, f"{drawn.text()}\n{frame_art(frames[mistake])}"


def is_drawn_twice(scene: ClipScene, settings: Settings) -> bool:
    """Return whether a pixel is drawn by two triangles."""
    return bool((render(scene, settings).cover_count > 1).any())


def _differs(reference: Settings, scene: ClipScene, settings: Settings) -> bool:
    return bool(different_pixels(render(scene, settings), render(scene, reference)))


def _break_answer(part: record.BreakPart, drawn: DrawnScene, settings: Settings, draws: Draws) -> BreakAnswer:
    """Search for a place of the corner at which the weak method alone fails."""
    start = drawn.corner(part.corner)
    columns, rows = drawn.scene.size
    dials = tuple(
        Dial(name, high=Fraction(side), step=part.step, corner=(part.corner[0], part.corner[1], axis))
        for axis, (name, side) in enumerate(zip("xy", (columns, rows), strict=True))
    )
    weak, robust = (settings_from_texts(texts, settings) for texts in (part.weak, part.robust))
    fails: Callable[[ClipScene, Settings], bool] = (
        is_drawn_twice if part.fails == "twice" else partial(_differs, settings)
    )

    def scene_of(values: Values) -> ClipScene:
        return drawn.with_corner(part.corner, (values[0], values[1]))

    def breaks(values: Values) -> bool:
        scene = scene_of(values)
        return fails(scene, weak) and not fails(scene, robust)

    if breaks(start):
        raise NoQuestionError("the weak method alone fails from the start")
    x, y = dials
    places = [(x.value(i), y.value(j)) for i in range(x.count) for j in range(y.count)]
    for place in Draws(0).shuffled(places)[:SEARCH_LIMIT]:
        if breaks(place):
            return BreakAnswer(dials, start, place, scene_of, weak, robust, fails, FAILS[part.fails])
    draws.vain_searches += 1
    reason = f"no place of {SEARCH_LIMIT} makes the weak method alone fail"
    if draws.vain_searches >= SCENES_SEARCHED:
        raise ValueError(f"{reason}, in each of {SCENES_SEARCHED} scenes")
    raise NoQuestionError(reason)


def _cheapest_answer(part: record.CheapestPart, scene: AnyScene, settings: Settings) -> CheapestAnswer:
    """Compare pictures with that of the settings, in bytes."""
    families = tuple(
        Family(family, tuple(costs), tuple(costs.values())) for family, costs in part.costs.items()
    )
    return CheapestAnswer(families, part.tolerance, byte_error(scene, settings), settings)


def byte_error(scene: AnyScene, reference: Settings) -> Callable[[Settings], Fraction]:
    """Return what finds how far a channel is off at most, of 255, with settings other than ``reference``."""
    right = shown(scene, reference)
    return lambda settings: Fraction(int(difference(shown(scene, settings), right).max(initial=0)))
