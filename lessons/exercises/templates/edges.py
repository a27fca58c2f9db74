"""Edge functions, who owns an edge, and the part of the raster that a triangle may touch."""

from fractions import Fraction
from math import floor
from typing import Any

import numpy as np

from core import Settings, render
from core.coverage.fill_rule import shared_edge
from core.coverage.snapping import snap_one
from lessons.exercises.answers.marked import PixelAnswer
from lessons.exercises.coding.triangles import edge_of
from lessons.exercises.drafting import (
    by_rule,
    drafted,
    factor_text,
    listed,
    numbers,
    one_of,
    place_text,
    several,
    table,
    window_text,
)
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import Corner, corner_text, twice_area
from lessons.exercises.templates.transforms import sketched, wholes
from lessons.mistakes.coverage import owns_level, owns_slanted
from lessons.mistakes.shelf import RULES
from lessons.small_scenes import triangle_scene

NAMES = ("E2, from 0 to 1", "E0, from 1 to 2", "E1, from 2 to 0")
"""Of the edges as the picture names them: each is opposite to the vertex of its number."""
SIZE = (12, 9)
INWARD = "E(x, y) = a x + b y + c is positive on the left of an edge that runs from one vertex to the next."


def edges_of(corners: list[Corner]) -> list[tuple[Any, Any, Any]]:
    """Return the three edge functions of a counter-clockwise triangle."""
    return [edge_of(corners[k], corners[(k + 1) % 3]) for k in range(3)]


def first_edge(corners: list[Corner]) -> str:
    """Return a and b of the first edge as expressions in numbers."""
    (x0, y0), (x1, y1) = (map(factor_text, corner) for corner in corners[:2])
    return f"The edge from 0 to 1 has a = {y0} - {y1}, b = {x1} - {x0}"


def triangle(draws: Draws, size: tuple[int, int] = SIZE, least: int = 16) -> list[Corner]:
    """Draw a counter-clockwise triangle with whole corners, none that is small."""
    corners = [(Fraction(draws.whole(0, size[0])), Fraction(draws.whole(0, size[1]))) for _ in range(3)]
    area = twice_area(corners)
    reject(abs(area) < least)
    return corners if area > 0 else corners[::-1]


@template("edge-coefficients", 1, "Coefficients of an edge", "edges", 2)
def draw_coefficients(draws: Draws) -> Draft:
    """a, b and c of an edge."""
    start, end = wholes(draws, 2, 0, 9), wholes(draws, 2, 0, 9)
    reject(start == end)
    asked = f"""What are a, b and c of this edge function? {INWARD} Take whole numbers with a = y0 - y1.
        Hint: It is zero at both ends.
        Hint: a = y0 - y1 and b = x1 - x0.
        Hint: c follows from E = 0 at the first end.
        Hint: a = {factor_text(start[1])} - {factor_text(end[1])}, b = {factor_text(end[0])} -
        {factor_text(start[0])}."""
    given = f"Edge from {place_text(start)} to {place_text(end)}."
    sketch = sketched({"start": start, "end": end}, (start, end))
    return numbers(asked, given, edge_of(start, end), names=("a", "b", "c"), sketch=sketch)


@template("edge-values", 1, "Edge functions at a pixel", "edges", 3)
def draw_values(draws: Draws) -> Draft:
    """The three edge functions at a pixel."""
    corners = triangle(draws)
    pixel = draws.whole(1, 9), draws.whole(1, 7)

    def values(shift: Fraction) -> list[list[Any]]:
        x, y = (c + shift for c in pixel)
        return [[a * x + b * y + c] for a, b, c in edges_of(corners)]

    scene = triangle_scene([corners], SIZE)
    asked = f"""What are the three edge functions at the centre (i + 1/2, j + 1/2) of pixel {pixel}? {INWARD}
        Hint: Where is the centre?
        Hint: E = (y0 - y1)(x - x0) + (x1 - x0)(y - y0).
        Hint: The signs tell on which side of each edge it lies.
        Hint: The centre is ({pixel[0]} + 1/2, {pixel[1]} + 1/2). {first_edge(corners)}."""
    wrong = {"corner-for-center": values(Fraction(0))}
    right = values(Fraction(1, 2))
    given = f"Vertices 0, 1, 2: {corner_text(corners)}"
    return table(asked, given, ("E",), NAMES, right, wrong, scene=scene, pixel=pixel)


@template("edge-stepping", 1, "An edge function along a row", "edges", 3)
def draw_stepped(draws: Draws) -> Draft:
    """An edge function along a row, by adding a."""
    start, end = wholes(draws, 2, 0, 9), wholes(draws, 2, 0, 9)
    reject(start[1] == end[1])
    a, b, c = edge_of(start, end)
    first, row = draws.whole(0, 4), draws.whole(0, 6)
    columns = range(first, first + 6)
    right = [[a * (x + Fraction(1, 2)) + b * (row + Fraction(1, 2)) + c] for x in columns]
    asked = f"""Fill in E at the centres (i + 1/2, j + 1/2) of these pixels of row {row}. {INWARD}
        {WITHIN_ROW}
        Hint: Compute the first one.
        Hint: From one column to the next, E grows by a.
        Hint: a = y0 - y1.
        Hint: a = {factor_text(start[1])} - {factor_text(end[1])}; the first centre is ({first} + 1/2, {row} +
        1/2)."""

    def follow(own: Any, number: int, mine: Any) -> Any:
        return own[-1][0] + a if number else right[0][0]

    given = f"Edge from {place_text(start)} to {place_text(end)}."
    return table(asked, given, ("E",), [f"column {x}" for x in columns], right, follow=follow)


WITHIN_ROW = "Each cell is computed from the one before."


@template("edge-matrix", 1, "Edge functions by a matrix", "edges", 4)
def draw_inverse(draws: Draws) -> Draft:
    """The matrix of all coefficients, by inversion."""
    rows = [(*wholes(draws, 2, -2, 3), Fraction(draws.whole(1, 2))) for _ in range(3)]
    (x0, y0, w0), (x1, y1, w1), (x2, y2, w2) = rows
    adjugate = [
        [y1 * w2 - w1 * y2, w0 * y2 - y0 * w2, y0 * w1 - w0 * y1],
        [w1 * x2 - x1 * w2, x0 * w2 - w0 * x2, w0 * x1 - x0 * w1],
        [x1 * y2 - y1 * x2, y0 * x2 - x0 * y2, x0 * y1 - y0 * x1],
    ]
    determinant = x0 * adjugate[0][0] + y0 * adjugate[1][0] + w0 * adjugate[2][0]
    reject(abs(determinant) not in (1, 2, 3, 4))
    given = listed("Vertex {k}: (x, y, w) = {}", rows)
    second, third = ([factor_text(number) for number in row] for row in rows[1:])
    asked = f"""Which matrix holds the coefficients of the edge functions alpha, beta, gamma? Its columns are
        theirs, its rows are a, b and c: it is the inverse of the matrix whose rows are (x, y, w) of the
        vertices. Row by row.
        Hint: alpha is 1 at vertex 0 and 0 at the other two.
        Hint: The inverse is the adjugate over the determinant.
        Hint: The adjugate begins with {second[1]} * {third[2]} - {second[2]} * {third[1]}; multiply back to
        check."""
    right = [cell / determinant for row in adjugate for cell in row]
    return numbers(asked, given, right, shape=(3, 3))


@template(
    "owned-edges",
    2,
    "Edges that own their centres",
    "edges",
    2,
    alike=(frozenset({"leftmost-vertex", "level-edges-always"}),),
)
def draw_owned(draws: Draws) -> Draft:
    """Edges that own the centres on them."""
    corners = triangle(draws)
    if draws.fraction() < 0.5:
        level = min(corners[0][1], corners[1][1])
        corners = [(corners[0][0], level), (corners[1][0], level), corners[2]]
        reject(twice_area(corners) < 16)
    a, b, _ = np.array(edges_of(corners), float).T
    rules = {"level-edges-never": owns_slanted, "level-edges-always": owns_level}
    right = np.flatnonzero(shared_edge(a, b)).tolist()
    wrong = {name: np.flatnonzero(rule(a, b)).tolist() for name, rule in rules.items()}
    asked = f"""Which edges of this triangle own the pixel centres that lie exactly on them? A centre on an
        edge belongs to the triangle that contains the point moved a tiny step right, then up.
        Hint: Move a point on each edge a little to the right: is it inside?
        Hint: On a level edge only the step up decides.
        Hint: {first_edge(corners)}. An edge owns its centres where a > 0, or a = 0 and b > 0."""
    given = f"Vertices 0, 1, 2: {corner_text(corners)}"
    rule = RULES["leftmost-vertex"]
    assert frozenset(right) == rule.right(corners)
    wrong["leftmost-vertex"] = sorted(rule.wrong(corners))
    shown = {"all-edges-inclusive": [0, 1, 2]} | {name: r for name, r in wrong.items() if r and r != right}
    return several(asked, given, NAMES, right, shown, triangle_scene([corners], SIZE))


@template("snapped-vertex", 1, "A vertex in 256ths", "edges", 1)
def draw_snapped(draws: Draws) -> Draft:
    """A vertex on the grid of 1/256 pixel."""
    x = Fraction(draws.whole(100, 900), 100)
    right = Fraction(snap_one(float(x))) * 256
    asked = f"""Vertices are snapped to the nearest multiple of 1/256 pixel before coverage is decided. How
        many 256ths is this x?
        Hint: Multiply by 256.
        Hint: Round to the nearest whole number.
        Hint: {float(x)} * 256, rounded."""
    wrong = {"vertices-rounded": [256 * floor(x + Fraction(1, 2))]}
    return numbers(asked, f"x = {float(x)} pixels", [right], wrong)


@template("area-in-bits", 1, "An area in 64 bits", "edges", 2)
def draw_bits(draws: Draws) -> Draft:
    """A product that does not fit."""
    width, height = draws.whole(190, 250), draws.whole(190, 250)
    given = f"Legs of {width} and {height} pixels; each pixel has 256 units."
    asked = f"""A right triangle has legs along x and y. What is twice its area in units of 1/256 x 1/256
        pixel? The number is kept in 64 bits, so nothing is lost.
        Hint: Put both lengths into units first.
        Hint: Twice the area is the product of the legs.
        Hint: ({width} * 256) ({height} * 256)."""
    return by_rule(asked, given, (width, height), ("product-overflows",))


CASES = (
    "project it and take its bounding box",
    "do not draw it: it lies behind the eye",
    "do not project it; test all pixels of the image",
)


@template("binning-case", 1, "The three cases of binning", "bin", 1)
def draw_case(draws: Draws) -> Draft:
    """The three cases of binning."""
    wanted = draws.whole(0, 2)
    signs = ((1, 1, 1), (-1, -1, -1), draws.item(((1, 1, -1), (1, -1, -1), (-1, 1, 1), (-1, 1, -1))))[wanted]
    corners = [(*wholes(draws, 2, -9, 9), Fraction(sign * draws.whole(1, 9))) for sign in signs]
    given = listed("Vertex {k}: (x, y, w) = {}", corners)
    asked = f"""Which case of binning is this triangle? w > 0 is in front of the eye.
        Hint: Look at w alone.
        Hint: Where signs differ, the projected vertices do not bound the triangle.
        Hint: The three w are {place_text(corner[2] for corner in corners)}: how many of them are
        positive?"""
    return one_of(asked, given, CASES, wanted)


BLOCK, BLOCKS = 4, 8
LEAST = 20
"""Blocks that must be marked, and that must not: with fewer, guesses earn too much."""


@template("blocks-discarded", 2, "Blocks that are discarded", "bin", 4)
def draw_blocks(draws: Draws) -> Draft:
    """Blocks that are discarded."""
    side = BLOCK * BLOCKS
    corners = triangle(draws, (side, side), 150)
    scene = triangle_scene([corners], (side, side))
    edges = [(float(a), float(b), float(c), a > 0 or (a == 0 and b > 0)) for a, b, c in edges_of(corners)]
    rule = RULES["block-by-one-corner"]
    right = rule.right(edges, BLOCKS, BLOCK)
    reject(not LEAST <= len(right) <= BLOCKS * BLOCKS - LEAST)
    answer = PixelAnswer((BLOCKS, BLOCKS), right, noun="blocks")
    asked = f"""The window is divided into blocks of {BLOCK} x {BLOCK} pixels. Mark the blocks that are
        discarded because all their pixel centres lie outside of one edge. Left edges and level bottom edges
        own the centres on them.
        Hint: Take one edge at a time.
        Hint: Only one pixel of a block has to be tested: the one where E is largest.
        Hint: {first_edge(corners)}: E is largest on the right where a > 0, and at the top where b > 0."""
    given = f"{window_text((side, side))}\nTriangle: {corner_text(corners)}"
    wrong = {rule.name: rule.wrong(edges, BLOCKS, BLOCK)}
    return drafted(asked, given, answer, wrong, scene, Settings(fill="blocks", block_size=BLOCK))


CORNERS = ("lower left", "lower right", "upper left", "upper right")


@template("deciding-corner", 1, "The corner that decides", "bin", 1)
def draw_corner(draws: Draws) -> Draft:
    """The pixel of a block that decides."""
    a, b, c = draws.whole(-9, 9), draws.whole(-9, 9), draws.whole(-40, 40)
    reject(not a or not b)
    right = 2 * (b > 0) + (a > 0)
    asked = f"""Which pixel of a block decides whether the whole block is outside of this edge? Outside is
        where E = a x + b y + c is negative.
        Hint: Which pixel is the last one to be outside?
        Hint: Where is E largest?
        Hint: To the right E changes by {number_text(Fraction(a))} a pixel, upwards by
        {number_text(Fraction(b))}."""
    wrong = {"block-by-one-corner": 0} if right else {}
    given = (
        f"E(x, y) = {number_text(Fraction(a))} x + {number_text(Fraction(b))} y + {number_text(Fraction(c))}"
    )
    return one_of(asked, given.replace("+ -", "- "), CORNERS, right, wrong)


@template("pixels-tested", 1, "Pixels that are tested", "bin", 2)
def draw_tests(draws: Draws) -> Draft:
    """Pixels that are tested."""
    corners = triangle(draws)
    scene = triangle_scene([corners], SIZE)
    right = [
        render(scene, Settings(fill=fill)).statistics["bin"].outgoing
        for fill in ("brute-force", "bounding-box")
    ]
    low, high = ([pick(corner[axis] for corner in corners) for axis in range(2)] for pick in (min, max))
    asked = f"""How many pixels are tested for this triangle by brute force, and with its bounding box? A
        pixel belongs to the box where its centre (i + 1/2, j + 1/2) does.
        Hint: Brute force asks every pixel of the window.
        Hint: The box has columns times rows.
        Hint: {SIZE[0]} * {SIZE[1]}; and whole i with i + 1/2 from {low[0]} to {high[0]}, j with j + 1/2 from
        {low[1]} to {high[1]}."""
    given = f"{window_text(SIZE)}\nTriangle: {corner_text(corners)}"
    names = ("brute force", "bounding box")
    return numbers(asked, given, right, names=names, scene=scene, settings=Settings(fill="bounding-box"))
