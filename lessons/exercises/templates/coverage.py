"""Which pixels a triangle covers, and which way it faces."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np

from core import Settings, render
from core.scene import ClipScene
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.draws import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.drafting import drafted, factor_text, listed, pictured, place_text
from lessons.mistakes.shelf import SHELF
from lessons.small_scenes import triangle_scene

Corner = tuple[Fraction, Fraction]
SIZE = (12, 9)
RULE = (
    "A pixel is covered where its centre (i + 1/2, j + 1/2) lies inside. A centre on an edge belongs to the triangle "
    "that contains the point moved a tiny step right, then up: left edges and level bottom edges own theirs."
)


def corner_text(corners: Sequence[Corner]) -> str:
    """Return corners as text."""
    return ", ".join(map(place_text, corners))


def twice_area(corners: Sequence[Corner]) -> Fraction:
    """Return the determinant: positive where the corners run counter-clockwise."""
    (x0, y0), (x1, y1), (x2, y2) = corners
    return (x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0)


def crossing_text(start: Corner, end: Corner, y: str = "j + 1/2") -> str:
    """Return the x of a line through two points at a height, as an expression in numbers."""
    (x0, y0), (x1, y1) = (map(factor_text, corner) for corner in (start, end))
    return f"{x0} + ({y} - {y0}) ({x1} - {x0}) / ({y1} - {y0})"


def row_hint(corners: Sequence[Corner], y: str = "j + 1/2") -> str:
    """Say where the highest side crosses the centres of a row."""
    sides = zip(corners, [*corners[1:], corners[0]], strict=True)
    side = max(sides, key=lambda ends: abs(ends[1][1] - ends[0][1]))
    start, end = (corner_text([corner]) for corner in side)
    return f"At y = {y} the side from {start} to {end} is at x = {crossing_text(*side, y)}"


def _covered(corners: list[Corner], asked: str, names: tuple[str, ...]) -> Draft:
    """Ask for the pixels of a triangle that is neither small nor clockwise."""
    reject(twice_area(corners) < 16)
    scene = triangle_scene([corners], SIZE)
    return pictured(asked, f"Triangle A: {corner_text(corners)}", scene, names)


@template("triangle-coverage", 2, "Pixels of a triangle", "raster", 4)
def draw_triangle(draws: Draws) -> Draft:
    """A triangle with corners on half pixels, so that edges meet centres."""
    half = Fraction(1, 2)
    corners = [(draws.step(half, Fraction(11), half), draws.step(half, Fraction(8), half)) for _ in range(3)]
    names = ("corner-for-center", "all-edges-inclusive", "all-edges-exclusive", "y-down", "vertices-rounded")
    asked = f"""Which pixels does triangle A cover? {RULE}
        Hint: Look at one row of centres at a time: y = j + 1/2.
        Hint: In a row, the centres between the crossings of two edges are covered.
        Hint: {row_hint(corners)}. A centre there belongs to the triangle if this is a left edge."""
    return _covered(corners, asked, names)


@template("shared-edge", 2, "Centres on a shared edge", "raster", 4)
def draw_shared_edge(draws: Draws) -> Draft:
    """One of two triangles whose common edge runs through centres."""
    half = Fraction(1, 2)
    left, right = draws.whole(0, 3) + half, draws.whole(7, 10) + half
    low, high = draws.whole(0, 2) + half, draws.whole(5, 7) + half
    is_upper = draws.fraction() < 0.5
    lower = [(left, low), (right, low), (right, high)]
    upper = [(left, low), (right, high), (left, high)]
    mine, other = (upper, lower) if is_upper else (lower, upper)
    # The level edge of the lower triangle is its bottom edge, which owns its centres.
    level = "level-edges-always" if is_upper else "level-edges-never"
    names = ("all-edges-inclusive", "all-edges-exclusive", level)
    asked = f"""Triangles A and B share an edge. Which pixels belong to triangle A? {RULE}
        Hint: Find the centres on the common edge first, then those on the sides.
        Hint: Of the two triangles exactly one owns each of the centres between them.
        Hint: At y = j + 1/2 the common edge is at x = {crossing_text((left, low), (right, high))}: is
        triangle A on its right or on its left?"""
    draft = _covered(mine, asked, names)
    both = triangle_scene([mine, other], SIZE)
    return replace(draft, given=f"{draft.given}\nTriangle B: {corner_text(other)}", outlined=both)


FACES = tuple("ABCD")
FACING_SIZE = (24, 7)


def facing_text(corners: Sequence[Corner]) -> str:
    """Return the determinant as an expression in numbers."""
    (x0, y0), (x1, y1), (x2, y2) = (map(factor_text, corner) for corner in corners)
    return f"({x1} - {x0})({y2} - {y0}) - ({y1} - {y0})({x2} - {x0})"


@template("facing", 1, "Facing by the determinant", "cull", 2)
def draw_facing(draws: Draws) -> Draft:
    """Triangles side by side, of which some face away."""
    triangles = [
        [(Fraction(6 * k + draws.whole(0, 5)), Fraction(draws.whole(0, 6))) for _ in range(3)]
        for k in range(len(FACES))
    ]
    areas = [twice_area(corners) for corners in triangles]
    reject(min(map(abs, areas)) < 5)
    away = frozenset(k for k, area in enumerate(areas) if area < 0)
    reject(not 1 <= len(away) <= 3)
    scene = triangle_scene(triangles, FACING_SIZE)
    settings = Settings(cull="back")
    wrong = culled(SHELF["facing-exchanged"].change_settings(settings), scene)
    given = listed("{}: {}", FACES, triangles)
    asked = f"""Which triangles are back faces? Counter-clockwise corners, y up, are the front: the
        determinant (x1 - x0)(y2 - y0) - (y1 - y0)(x2 - x0) is positive.
        Hint: Sketch each triangle with its corners in order.
        Hint: The sign of the determinant decides, not its size.
        Hint: For A: {facing_text(triangles[0])}."""
    answer = ChoiceAnswer(FACES, away, is_several=True)
    return drafted(asked, given, answer, {"facing-exchanged": wrong}, scene, settings)


def culled(settings: Settings, scene: ClipScene) -> frozenset[int]:
    """Return the triangles of a scene of which no pixel is seen."""
    seen = set(np.unique(render(scene, settings).primitive).tolist())
    return frozenset(range(len(scene.clip))) - seen
