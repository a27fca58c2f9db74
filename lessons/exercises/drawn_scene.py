"""The scene of an exercise file, drawn from a seed, and what is read from its pictures."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from core.framebuffer.display import to_display
from core.records.frame import Frame
from core.scene import AnyScene, ClipScene
from core.study.planner.trials import difference
from lessons.exercises.answers.pixels import Pixels
from lessons.exercises.draws import Draws
from lessons.exercises.numbers import number_text
from lessons.exercises.record import ScenePart
from lessons.scenes import make_scene
from lessons.small_scenes import segment_scene, triangle_scene

Corner = tuple[Fraction, Fraction]
MARKS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


@dataclass(frozen=True, eq=False)
class DrawnScene:
    """A scene with its numbers."""

    scene: AnyScene
    places: tuple[tuple[Corner, ...], ...] = ()
    """Corners of the triangles or segments in the window; empty: a built-in scene."""
    name: str = ""
    """Of a built-in scene."""

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
        """Return the triangles with one corner at another place."""
        moved = [list(corners) for corners in self.places]
        moved[at[0]][at[1]] = place
        return triangle_scene(np.array(moved, float), self.scene.size)

    def text(self, hidden: Sequence[int] = ()) -> str:
        """Return the numbers as text, but for a corner that is ``hidden``."""
        if not self.places:
            columns, rows = self.scene.size
            return f"Scene {self.name}, {columns} x {rows} pixels."
        lines = [window_text(self.scene.size)]
        for number, corners in enumerate(self.places):
            texts = [
                "?" if [number, k] == list(hidden) else f"({number_text(x)}, {number_text(y)})"
                for k, (x, y) in enumerate(corners)
            ]
            noun = "Triangle" if len(corners) == 3 else "Segment"
            lines.append(f"{noun} {number}: {', '.join(texts)}")
        return "\n".join(lines)


def window_text(size: tuple[int, int]) -> str:
    """Return the columns and rows of a window as a question states them."""
    return f"Window of {size[0]} x {size[1]} pixels, row 0 at the bottom."


def draw_scene(part: ScenePart, draws: Draws) -> DrawnScene:
    """Draw the places of a scene."""
    columns, rows = part.size
    if part.builtin is not None:
        return DrawnScene(replace(make_scene(part.builtin), size=(columns, rows)), name=part.builtin)
    places = tuple(
        tuple((x.draw(draws), y.draw(draws)) for x, y in corners)
        for corners in part.triangles or part.segments
    )
    corners_of = np.array(places, float)
    scene = (
        triangle_scene(corners_of, (columns, rows))
        if part.triangles
        else segment_scene([(tuple(a), tuple(b)) for a, b in corners_of.tolist()], (columns, rows))
    )
    return DrawnScene(scene, places)


def seen_pixels(frame: Frame, triangle: int | None = None) -> Pixels:
    """Return the pixels where anything, or one triangle, is seen."""
    is_seen = frame.primitive >= 0 if triangle is None else frame.primitive == triangle
    return frozenset((column, row) for row, column in np.argwhere(is_seen).tolist())


def different_pixels(one: Frame, other: Frame) -> Pixels:
    """Return the pixels where something else is seen, or a colour channel is more than a byte apart."""
    colors = (to_display(frame.color).pixels[..., :3].astype(np.int64) for frame in (one, other))
    differs = (one.primitive != other.primitive) | (difference(*colors) > 1)
    return frozenset((column, row) for row, column in np.argwhere(differs).tolist())


def frame_art(frame: Frame) -> str:
    """Return what is seen as text, top row first: A for primitive 0, B for 1 ..., ``.`` for nothing."""
    rows = [
        "".join("." if number < 0 else MARKS[number % len(MARKS)] for number in row)
        for row in frame.primitive.tolist()
    ]
    return "\n".join(reversed(rows))
