"""Questions about what is on the screen: a step of a run, or the value of a pixel, named so that anybody can ask it.

The name of such a template says which built-in scene is stepped, with which settings and up to where:
``ask/shared-edge/16x12/fill=blocks/raster/step=12``. Corners that were moved follow the scene, as ``~0.1=9.25,4.5``.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from core import STAGES, Settings, trace
from core.coverage.snapping import window_position
from core.scene import AnyScene, ClipScene
from core.setting_texts import settings_from_texts, settings_record
from core.stages.declared import stage_of
from core.trace.stage_trace import BufferTrack, StageTrace
from lessons.exercises.answers.answer import Answer
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.answers.fields import NumberAnswer
from lessons.exercises.drafting import window_text
from lessons.exercises.numbers import Draws, NoQuestionError
from lessons.exercises.question import TOLERANCE, Draft, Template, row_draft
from lessons.exercises.templates.stepping import known_text, step_variables
from lessons.lectures.scenes import ALL_SCENES

PREFIX = "ask/"
VERSION = 1
LONGEST = 190
"""Characters of a name: attempts keep no longer one."""
MOVES = 8
"""Quarters of a pixel that corners move by at most, to each side, at seeds other than 0."""
CHANNELS = ("red", "green", "blue", "alpha")
CORNERS = 1e-9
"""Pixels by which corners may differ that count as the same."""


@dataclass(frozen=True)
class Screen:
    """What is on the screen, in words that a line can hold."""

    scene: str
    """Name of a built-in scene, and the corners of it that were moved."""
    size: tuple[int, int]
    settings: Mapping[str, str]
    """Those that are not the defaults."""
    stage: str
    row: int = -1
    """The row that is asked about; -1: a value is."""
    buffer: str = ""
    pixel: tuple[int, int] = (0, 0)
    rows_done: int = 0
    """After how many rows the value is read."""

    @property
    def name(self) -> str:
        """The name of the template."""
        chosen = ",".join(f"{name}={value}" for name, value in self.settings.items()) or "-"
        column, row = self.pixel
        what = f"step={self.row}" if self.row >= 0 else f"value={self.buffer},{column},{row},{self.rows_done}"
        return f"{PREFIX}{self.scene}/{self.size[0]}x{self.size[1]}/{chosen}/{self.stage}/{what}".replace(
            " ", "_"
        )


def scene_name(scene: AnyScene, title: str) -> str:
    """Return the name of a scene that is open under a title; ValueError where it has none.

    It is a built-in scene, or one of which corners were moved in the window.
    """
    known = next((each for each in ALL_SCENES.values() if each.title == title), None)
    base = None if known is None else known.make()
    if known is None or base is None or not is_alike(scene, base):
        raise ValueError("only a built-in scene can be asked about, also with corners that were moved")
    if not isinstance(scene, ClipScene) or not isinstance(base, ClipScene):
        return known.name
    mine, its = (np.asarray(window_position(each.clip, base.size)) for each in (scene, base))
    moved = [known.name]
    for primitive, corner in np.argwhere(np.abs(mine - its).max(axis=-1) > CORNERS).tolist():
        x, y = (f"{value:.12g}" for value in mine[primitive, corner])
        moved.append(f"{primitive}.{corner}={x},{y}")
    return "~".join(moved)


def is_alike(one: AnyScene, other: AnyScene) -> bool:
    """Return whether two scenes draw the same, but for the places of corners in the window and the raster."""
    if isinstance(one, ClipScene) and isinstance(other, ClipScene):
        return (
            one.kind == other.kind
            and one.clip.shape == other.clip.shape
            and bool(np.allclose(one.clip[..., 2:], other.clip[..., 2:]))
            and bool((one.clip[..., 3] > 0).all())
            and _is_same(one.attributes, other.attributes)
            and _is_same(one.clip_region, other.clip_region)
        )
    if isinstance(one, ClipScene) or isinstance(other, ClipScene) or len(one.meshes) != len(other.meshes):
        return False
    mine, its = vars(one.camera), vars(other.camera)
    return all(_is_same(mine[name], its[name]) for name in mine) and all(
        _is_same(a.positions, b.positions) for a, b in zip(one.meshes, other.meshes, strict=True)
    )


def _is_same(one: Any, other: Any) -> bool:
    if one is None or other is None:
        return one is other
    return bool(np.shape(one) == np.shape(other) and np.array_equal(np.asarray(one), np.asarray(other)))


def settings_of(settings: Settings) -> dict[str, str]:
    """Return the settings that are not the defaults as texts; ValueError where a function was replaced."""
    defaults = settings_record(Settings())
    return {name: str(value) for name, value in settings_record(settings).items() if value != defaults[name]}


def screen_of(name: str) -> Screen:
    """Return what a name says; ValueError with a sentence where it is none."""
    wanted = "expected a name such as ask/shared-edge/16x12/-/raster/step=12"
    parts = name.removeprefix(PREFIX).split("/", 4)
    if not name.startswith(PREFIX) or len(parts) != 5 or len(name) > LONGEST:
        raise ValueError(f"{wanted}, got {name!r:.60}")
    scene, size, chosen, stage, what = parts
    try:
        columns, rows = map(int, size.split("x"))
        settings = {} if chosen == "-" else dict(one.split("=") for one in chosen.split(","))
        kind, _, place = what.partition("=")
        if kind == "step":
            return Screen(scene, (columns, rows), settings, stage, int(place))
        buffer, column, row, done = place.split(",")
        return Screen(
            scene,
            (columns, rows),
            settings,
            stage,
            -1,
            buffer.replace("_", " "),
            (int(column), int(row)),
            int(done),
        )
    except ValueError:
        raise ValueError(f"{wanted}, got {name!r:.60}") from None


def screen_template(name: str) -> Template:
    """Return the template of a name; ValueError with a sentence where nothing is asked by it."""
    screen = screen_of(name)
    known = ALL_SCENES.get(screen.scene.split("~")[0])
    if screen.stage not in STAGES or known is None:
        raise ValueError(f"expected a built-in scene and a stage, got {name!r:.60}")
    if not all(1 <= side <= 128 for side in screen.size):
        raise ValueError(
            f"expected a raster of 1 to 128 pixels each way, got {screen.size[0]} x {screen.size[1]}"
        )
    scene = replace(_moved(known.make(), screen.scene), size=screen.size)
    settings = settings_from_texts(screen.settings)
    title = f"{known.title}: {'step' if screen.row >= 0 else 'value'} in {stage_of(screen.stage).short_title}"
    make = partial(_draw, screen, scene, settings)
    return Template(name, VERSION, title, screen.stage, 1, make, is_fixed=not isinstance(scene, ClipScene))


def _moved(scene: AnyScene, name: str) -> AnyScene:
    """Return a scene with the corners of its name at other places in the window."""
    _, *moves = name.split("~")
    if not moves:
        return scene
    if not isinstance(scene, ClipScene):
        raise ValueError("expected a scene that is typed in the window where corners are moved")
    places = np.array(window_position(scene.clip, scene.size), float)
    try:
        for move in moves:
            corner, _, place = move.partition("=")
            primitive, number = map(int, corner.split("."))
            places[primitive, number] = [float(value) for value in place.split(",")]
    except (ValueError, IndexError):
        raise ValueError(f"expected corners such as 0.1=9.25,4.5, got {name!r:.60}") from None
    return _at(scene, places)


def _at(scene: ClipScene, places: np.ndarray) -> ClipScene:
    clip = scene.clip.copy()
    clip[..., :2] = (2 * places / scene.size - 1) * clip[..., 3:]
    return replace(scene, clip=clip)


def _varied(scene: AnyScene, draws: Draws) -> AnyScene:
    """Return the scene of a seed: at 0 as it is on the screen, else with corners moved; those of one place together."""
    if draws.seed == 0 or not isinstance(scene, ClipScene):
        return scene
    places = np.array(window_position(scene.clip, scene.size), float, order="C")
    moves: dict[tuple[float, ...], list[float]] = {}
    for place in places.reshape(-1, 2):
        key = tuple(np.round(place, 6).tolist())
        if key not in moves:
            moves[key] = [draws.whole(-MOVES, MOVES) / 4 for _ in range(2)]
        place += moves[key]
    return _at(scene, places)


def _draw(screen: Screen, scene: AnyScene, settings: Settings, draws: Draws) -> Draft:
    """Ask about the step or the value."""
    varied = _varied(scene, draws)
    run = trace(varied, settings)
    stage = run.stage(screen.stage)
    if screen.row < 0:
        asked = _value_draft(screen, stage)
    else:
        asked = row_draft(stage, screen.row) if screen.row < stage.steps.row_count else None
    if asked is None:
        kind = NoQuestionError if draws.seed else ValueError
        raise kind("nothing can be asked about this step or value")
    known = known_text(step_variables(stage, screen.row)) if screen.row >= 0 else ""
    given = "\n".join(filter(None, (_corners_text(varied), known)))
    hints = ("Step the scene up to here: the Step page hides what comes next.",)
    return replace(asked, given=given, hints=hints, scene=varied, settings=settings)


def _corners_text(scene: AnyScene) -> str:
    lines = [window_text(scene.size)]
    if isinstance(scene, ClipScene) and len(scene.clip) <= 4 and scene.corner_count <= 3:
        places = np.asarray(window_position(scene.clip, scene.size))
        for number, corners in enumerate(places.tolist()):
            lines.append(f"{number}: {', '.join(f'({x:.6g}, {y:.6g})' for x, y in corners)}")
    return "\n".join(lines)


def _value_draft(screen: Screen, stage: StageTrace) -> Draft | None:
    """Ask what a buffer holds at a pixel; ``None``: it holds nothing there."""
    track = next((each for each in stage.buffers if each.name == screen.buffer), None)
    column, row = screen.pixel
    if track is None or not (0 <= column < screen.size[0] and 0 <= row < screen.size[1]):
        return None
    if not track.known_at(screen.rows_done)[row, column]:
        return None
    answer = _value_answer(track, np.atleast_1d(track.at(screen.rows_done)[row, column]))
    if answer is None:
        return None
    done, all_rows = screen.rows_done, stage.steps.row_count
    when = (
        "is done" if done >= all_rows else f"has done step {stage.steps.starts[done]} of {stage.steps.count}"
    )
    noun = screen.buffer.replace("color", "colour")
    text = f"What is the {noun} at pixel {screen.pixel} once {stage_of(screen.stage).short_title} {when}?"
    within = (
        f" Numbers within {TOLERANCE:.0%}.".replace("%", " %") if isinstance(answer, NumberAnswer) else ""
    )
    return Draft(text + within, "", answer, pixel=screen.pixel)


def _value_answer(track: BufferTrack, values: np.ndarray) -> Answer | None:
    if track.kind == "flags":
        return ChoiceAnswer(("yes", "no"), frozenset({0 if values[0] > 0 else 1}))
    if not np.isfinite(values.astype(float)).all():
        return None
    numbers = tuple(Fraction(float(value)) for value in values)
    tolerance = (
        0.0 if track.kind in ("ids", "count", "bytes") else max(TOLERANCE * max(map(abs, numbers)), 1e-9)
    )
    names = CHANNELS[: len(numbers)] if len(numbers) > 1 else ()
    return NumberAnswer(numbers, (len(numbers),) if len(numbers) > 1 else (), names, float(tolerance))
