"""What questions are drafted from: a scene with its pictures, numbers by a formula, a belief among the choices."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import pi
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from core import Settings, render
from core.depth.whole_depths import table_scene
from core.framebuffer.display import to_display
from core.methods import table as table_of_methods
from core.records.cells import Sketch
from core.records.frame import Frame
from core.scene import AnyScene, Camera, ClipScene, Mesh, Scene
from core.settings import DEFAULTS
from core.study.planner.trials import difference
from lessons.exercises.answers.answer import Answer, Response
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.answers.fields import Column, Follow, NumberAnswer, Numbers, TableAnswer, number_rows
from lessons.exercises.answers.marked import PixelAnswer, Pixels
from lessons.exercises.asked_text import parts_of
from lessons.exercises.numbers import Draws, Number, number_text, reject
from lessons.exercises.question import Draft, Refutation
from lessons.exercises.record import ScenePart
from lessons.exercises.toml_values import Range
from lessons.lectures.scenes import scene_named
from lessons.mistakes.shelf import RULES, SHELF
from lessons.small_scenes import segment_scene, triangle_scene
from lessons.window_scenes import depth_table

# The scene of an exercise file, drawn from a seed, and what is read from its pictures.


Corner = tuple[Fraction, Fraction]
FLAT = Fraction(1, 2), Fraction(1)
"""Depth and w of a corner that is given by x and y alone."""
MARKS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


@dataclass(frozen=True, eq=False)
class DrawnScene:
    """A scene with its numbers."""

    scene: AnyScene
    places: tuple[tuple[Corner, ...], ...] = ()
    """Corners of the triangles or segments in the window; empty: a built-in scene."""
    name: str = ""
    """Of a built-in scene."""
    more: tuple[str, ...] = ()
    """What a question says of the corners beside their places, a line each."""

    @property
    def direction(self) -> tuple[float, float] | None:
        """From the start to the end of the one segment; ``None``: the scene is another one."""
        if len(self.places) != 1 or len(self.places[0]) != 2:
            return None
        (x0, y0), (x1, y1) = self.places[0]
        return float(x1 - x0), float(y1 - y0)

    def corner(self, at: Sequence[int]) -> Corner:
        """Return a corner by the numbers of its triangle and itself; ValueError where there is none."""
        primitive, corner = at
        if primitive >= len(self.places) or corner >= len(self.places[primitive]):
            raise ValueError(f"expected a corner of the triangles of the scene, got {list(at)}")
        return self.places[primitive][corner]

    def with_corner(self, at: Sequence[int], place: Corner) -> ClipScene:
        """Return the triangles with one corner at another place; all else of it stays."""
        assert isinstance(self.scene, ClipScene)
        clip = self.scene.clip.copy()
        corner = clip[at[0], at[1]]
        corner[:2] = (2 * np.array(place, float) / self.scene.size - 1) * corner[3]
        return replace(self.scene, clip=clip)

    def text(self, hidden: Sequence[int] = ()) -> str:
        """Return the numbers as text, but for a corner that is ``hidden``."""
        if not self.places:
            columns, rows = self.scene.size
            return "\n".join([f"Scene {self.name}, {columns} x {rows} pixels.", *self.more])
        lines = [window_text(self.scene.size)]
        for number, corners in enumerate(self.places):
            texts = [
                "?" if [number, k] == list(hidden) else f"({number_text(x)}, {number_text(y)})"
                for k, (x, y) in enumerate(corners)
            ]
            noun = "Triangle" if len(corners) == 3 else "Segment"
            lines.append(f"{noun} {number}: {', '.join(texts)}")
        return "\n".join([*lines, *self.more])


def window_text(size: tuple[int, int]) -> str:
    """Return the columns and rows of a window as a question states them."""
    return f"Window of {size[0]} x {size[1]} pixels, row 0 at the bottom."


def draw_scene(part: ScenePart, draws: Draws) -> DrawnScene:
    """Draw the numbers of a scene."""

    def drawn(rows: Sequence[Sequence[Sequence[Range]]]) -> list[list[list[Fraction]]]:
        return [[[one.draw(draws) for one in corner] for corner in row] for row in rows]

    columns, rows = part.size
    given = drawn(part.triangles or part.segments)
    corners = [[[*corner, *FLAT[len(corner) - 2 :]] for corner in row] for row in given]
    values, alpha = drawn(part.values), drawn([[[one] for one in row] for row in part.alpha])
    depths = [[corner[2:] for corner in row] for row in corners]
    more = [
        *_told("depth and w", depths if any(len(corner) > 2 for row in given for corner in row) else []),
        *_told("values", values),
        *_told("alpha", alpha),
    ]
    places = tuple(tuple((x, y) for x, y, *_ in row) for row in corners)
    if part.builtin is not None:
        scene: AnyScene = replace(scene_named(part.builtin).make(), size=(columns, rows))
    elif part.patches:
        scene = table_scene(depth_table(*part.patches, test=part.test))
        more.extend(f"Patch {number}:\n{patch.strip()}" for number, patch in enumerate(part.patches))
    elif part.segments:
        ends = [(tuple(a), tuple(b)) for a, b in np.array(places, float).tolist()]
        scene = segment_scene(ends, (columns, rows))
    else:
        whole = np.array(corners, float)
        colors = np.array(values, float) if values else np.zeros((*whole.shape[:2], 3))
        with_alpha = np.concatenate([colors, np.array(alpha, float)], axis=2) if alpha else colors
        attributes = with_alpha if values or alpha else None
        scene = triangle_scene(whole[..., :2], (columns, rows), whole[..., 2], whole[..., 3], attributes)
    if part.background is not None:
        background = [one.draw(draws) for one in part.background]
        more.append(f"Background: {', '.join(map(number_text, background))} (red, green, blue, alpha).")
        scene = replace(scene, background=np.array(background, float))
    return DrawnScene(scene, places, part.builtin or "", tuple(more))


def _told(name: str, rows: Sequence[Sequence[Sequence[Fraction]]]) -> list[str]:
    """Return what a question says of the corners of each triangle, where they have it."""
    told = []
    for number, row in enumerate(rows):
        texts = [f"({', '.join(map(number_text, corner))})" for corner in row]
        told.append(f"Triangle {number}, {name} of its corners: {', '.join(texts)}")
    return told


def seen_pixels(frame: Frame, triangle: int | None = None) -> Pixels:
    """Return the pixels where anything, or one triangle, is seen."""
    is_seen = frame.primitive >= 0 if triangle is None else frame.primitive == triangle
    return frozenset((column, row) for row, column in np.argwhere(is_seen).tolist())


def different_pixels(one: Frame, other: Frame, most: int = 1) -> Pixels:
    """Return the pixels where something else is seen, or a colour channel is more than ``most`` of 255 apart."""
    colors = (to_display(frame.color).pixels[..., :3].astype(np.int64) for frame in (one, other))
    differs = (one.primitive != other.primitive) | (difference(*colors) > most)
    return frozenset((column, row) for row, column in np.argwhere(differs).tolist())


def frame_art(frame: Frame) -> str:
    """Return what is seen as text, top row first: A for primitive 0, B for 1 ..., ``.`` for nothing."""
    rows = [
        "".join("." if number < 0 else MARKS[number % len(MARKS)] for number in row)
        for row in frame.primitive.tolist()
    ]
    return "\n".join(reversed(rows))


# What most templates need: numbers by a formula, their mistakes, and numbers as text.


TOLERANCE = 0.005
WITHIN = "Fractions, or decimals within 0.005."


def place_text(place: Iterable[Any]) -> str:
    """Return numbers in brackets."""
    return f"({', '.join(number_text(as_number(c)) for c in place)})"


def words(value: Any) -> str:
    """Return a number, a place (a tuple), or several things (a list) as text; text stays."""
    if isinstance(value, str):
        return value
    if isinstance(value, list):
        return ", ".join(map(words, value))
    return place_text(value) if isinstance(value, tuple) else number_text(as_number(value))


def listed(line: str, *columns: Iterable[Any]) -> str:
    """Return a line for each row of some columns; ``{k}`` stands for its number."""
    rows = enumerate(zip(*columns, strict=False))
    return "\n".join(line.format(*map(words, row), k=k) for k, row in rows)


def factor_text(value: Number) -> str:
    """Return a number as it stands in an expression: a fraction without its decimals, what is negative in brackets."""
    text = number_text(value).partition(" (")[0]
    return f"({text})" if value < 0 else text


def run_exactly(family: str, name: str, *numbers: int | Fraction) -> Any:
    """Return what the listing of a method gives for exact numbers, whole ones as fractions."""
    listing = table_of_methods.get(family, name).listing
    assert listing is not None
    return listing(*map(Fraction, numbers))


def as_number(value: Any) -> Number:
    """Return whole numbers and fractions exactly, and floats without the rounding of their last digits."""
    return round(float(value), 12) + 0.0 if isinstance(value, float) else Fraction(value)


def as_numbers(values: Iterable[Any]) -> Numbers:
    """Return numbers of an answer."""
    return tuple(as_number(value) for value in values)


def drafted(
    asked: str,
    given: str,
    answer: Answer,
    mistakes: Mapping[str, Response] | None = None,
    scene: AnyScene | None = None,
    settings: Settings = DEFAULTS,
    behind: str = "",
    **more: Any,
) -> Draft:
    """Return a draft of a question and its hints in one block of text; ``more``: other fields of `Draft`.

    ``behind`` stands behind the question: how near a number must be, or what to do with a listing.
    """
    text, hints = parts_of(asked)
    return Draft(f"{text} {behind}".strip(), given, answer, hints, mistakes or {}, scene, settings, **more)


def numbers(
    asked: str,
    given: str,
    values: Iterable[Any],
    wrong: Mapping[str, Iterable[Any]] | None = None,
    names: Sequence[str] = (),
    shape: tuple[int, ...] | None = None,
    scene: AnyScene | None = None,
    settings: Settings = DEFAULTS,
    pixel: tuple[int, int] | None = None,
    sketch: Sketch | None = None,
) -> Draft:
    """Ask for numbers; ``shape`` is that of a matrix, without it a number or a vector is asked for."""
    right = as_numbers(values)
    if shape is None:
        shape = () if len(right) == 1 else (len(right),)
    mistakes = {name: as_numbers(response) for name, response in (wrong or {}).items()}
    # Runs give floats, which must be recognised when they are typed as whole numbers.
    every = [number for response in (right, *mistakes.values()) for number in response]
    is_whole = all(isinstance(number, Fraction) and number.denominator == 1 for number in every)
    answer = NumberAnswer(right, shape, tuple(names), 0.0 if is_whole else TOLERANCE)
    within = "" if is_whole else WITHIN
    return drafted(asked, given, answer, mistakes, scene, settings, within, pixel=pixel, sketch=sketch)


def by_rule(
    asked: str,
    given: str,
    arguments: tuple[Any, ...],
    mistakes: Sequence[str],
    names: Sequence[str] = (),
    shape: tuple[int, ...] | None = None,
    sketch: Sketch | None = None,
) -> Draft:
    """Ask for the numbers that a formula gives; the mistakes are wrong formulas of the same arguments."""
    wrong = {name: RULES[name].wrong(*arguments) for name in mistakes}
    right = RULES[mistakes[0]].right(*arguments)
    return numbers(asked, given, right, wrong, names, shape, sketch=sketch)


def pictured(
    asked: str,
    given: str,
    scene: ClipScene,
    names: Sequence[str],
    settings: Settings = DEFAULTS,
    read: Callable[[Frame], Pixels] = seen_pixels,
) -> Draft:
    """Ask for the pixels that are read from the picture of a scene; the mistakes draw it, too."""
    answer = PixelAnswer(scene.size, read(render(scene, settings)))
    wrong = {name: read(SHELF[name].draw(scene, settings)) for name in names}
    return drafted(asked, f"{window_text(scene.size)}\n{given}", answer, wrong, scene, settings)


def several(
    asked: str,
    given: str,
    options: Sequence[str],
    right: Iterable[int],
    wrong: Mapping[str, Iterable[int]] | None = None,
    scene: AnyScene | None = None,
    settings: Settings = DEFAULTS,
) -> Draft:
    """Ask which of several options hold: neither all, nor none."""
    chosen = frozenset(right)
    reject(not 0 < len(chosen) < len(options))
    mistakes = {name: frozenset(response) for name, response in (wrong or {}).items()}
    answer = ChoiceAnswer(tuple(options), chosen, is_several=True)
    return drafted(asked, given, answer, mistakes, scene, settings)


def one_of(
    asked: str,
    given: str,
    options: Sequence[str],
    right: int,
    wrong: Mapping[str, int] | None = None,
    scene: AnyScene | None = None,
) -> Draft:
    """Ask which one option holds."""
    mistakes = {name: frozenset({response}) for name, response in (wrong or {}).items()}
    answer = ChoiceAnswer(tuple(options), frozenset({right}))
    return drafted(asked, given, answer, mistakes, scene)


def table(
    asked: str,
    given: str,
    columns: Sequence[str],
    labels: Sequence[str],
    rows: Sequence[Sequence[Any]],
    wrong: Mapping[str, Sequence[Sequence[Any]]] | None = None,
    follow: Follow | None = None,
    scene: AnyScene | None = None,
    settings: Settings = DEFAULTS,
    pixel: tuple[int, int] | None = None,
    tolerance: float = TOLERANCE,
) -> Draft:
    """Ask for a table of numbers."""
    mistakes = {name: number_rows(cells) for name, cells in (wrong or {}).items()}
    is_whole = all(Fraction(cell).denominator == 1 for row in rows for cell in row)
    answer = TableAnswer(
        tuple(Column(name) for name in columns),
        tuple(labels),
        number_rows(rows),
        follow,
        0.0 if is_whole else tolerance,
    )
    within = "" if is_whole else f"Fractions, or decimals within {tolerance:g}."
    return drafted(asked, given, answer, mistakes, scene, settings, within, pixel=pixel)


# Questions that uncover a belief: it is among the choices, and choosing it is answered by what refutes it.


Choice = str | int | Fraction


def choice_text(choice: Choice) -> str:
    """Return a choice as text."""
    return choice if isinstance(choice, str) else number_text(Fraction(choice))


def believed(
    draws: Draws,
    asked: str,
    right: Choice,
    beliefs: Sequence[Choice],
    others: Sequence[Choice],
    refutation: Refutation,
) -> Draft:
    """Ask for one of several choices that all differ."""
    wrong = [choice_text(belief) for belief in beliefs]
    options = draws.shuffled((choice_text(right), *wrong, *map(choice_text, others)))
    reject(len(set(options)) < len(options))
    answer = ChoiceAnswer(options, frozenset({options.index(choice_text(right))}))
    refutations = {frozenset({options.index(belief)}): refutation for belief in wrong}
    return drafted(asked, "", answer, reveal=refutation.sentence, refutations=refutations)


def eye_scene(
    points: ArrayLike, near: float = 1.0, far: float = 10.0, model: ArrayLike | None = None
) -> Scene:
    """Return a triangle (3, 3) before a camera at the origin that looks along -z, 90 degrees wide, 8 x 8 pixels."""
    transform = np.eye(4) if model is None else np.array(model, float)
    mesh = Mesh(positions=np.array(points, float), triangles=np.array([[0, 1, 2]]), transform=transform)
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]), field_of_view=pi / 2, near=near, far=far)
    return Scene((mesh,), camera, (), (8, 8))
