"""The scene of an exercise file, drawn from a seed, and what is read from its pictures."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from core.assembly.depth_tables import table_scene
from core.framebuffer.display import to_display
from core.records.frame import Frame
from core.scene import AnyScene, ClipScene
from core.study.planner.trials import difference
from lessons.depth_tables import depth_table
from lessons.exercises.answers.pixels import Pixels
from lessons.exercises.draws import Draws
from lessons.exercises.fields import Range
from lessons.exercises.numbers import number_text
from lessons.exercises.record import ScenePart
from lessons.slides.scenes import scene_named
from lessons.small_scenes import segment_scene, triangle_scene

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
