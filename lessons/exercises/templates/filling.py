"""Filling triangles: rows of a scanline fill, flat sides, borders of the window, how often a pixel is drawn."""

from fractions import Fraction
from math import atan2, ceil, floor

import numpy as np

from core import Settings, render
from core.records.frame import Frame
from lessons.exercises.coding.triangles import edge_of
from lessons.exercises.drawn_scene import window_text
from lessons.exercises.draws import Draws, reject
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import RULE, SIZE, Corner, corner_text, row_hint, twice_area
from lessons.exercises.templates.drafting import numbers, pictured, place_text, table
from lessons.exercises.templates.transforms import wholes
from lessons.mistakes.shelf import RULES, SHELF
from lessons.scenes import assembled
from lessons.small_scenes import triangle_scene

HALF = Fraction(1, 2)
WINDOW = window_text(SIZE)
SORTED_EDGES = ((0, 1), (1, 2), (0, 2))
"""Of vertices sorted by y: the two short edges, and the long one."""


def is_decided(corners: list[Corner]) -> bool:
    """Return whether no centre is so near to a side that snapping the corners to 1/256 pixel moves it across."""
    if all(256 % c.denominator == 0 for place in corners for c in place):
        return True
    sides = [edge_of(corners[k - 1], corner) for k, corner in enumerate(corners)]
    return all(
        abs(a * (i + HALF) + b * (j + HALF) + c) > (abs(a) + abs(b)) / 256
        for a, b, c in sides
        for i in range(SIZE[0])
        for j in range(SIZE[1])
    )


def of_triangle(corners: list[Corner], asked: str, names: tuple[str, ...]) -> Draft:
    """Ask for the pixels of one triangle."""
    reject(abs(twice_area(corners)) < 8 or not is_decided(corners))
    scene = triangle_scene([corners], SIZE)
    return pictured(asked, f"Triangle: {corner_text(corners)}", scene, names)


def tenths(draws: Draws, low: int, high: int) -> Fraction:
    """Draw a coordinate in tenths of a pixel."""
    return Fraction(draws.whole(10 * low, 10 * high), 10)


@template("flat-side", 2, "A triangle with a level side", "raster", 4)
def draw_flat(draws: Draws) -> Draft:
    """A triangle with a level side."""
    level, other = draws.shuffled((draws.whole(1, 3), draws.whole(5, 8)))
    left, right = draws.whole(0, 4) + HALF, draws.whole(7, 11) + HALF
    corners = [(left, level + HALF), (right, level + HALF), (draws.whole(0, 11) + HALF, other + HALF)]
    names = ("flat-sides-lost", "right-end-drawn")
    asked = f"""Which pixels does this triangle with a level side cover? {RULE}
        Hint: Is the level side at the bottom or at the top?
        Hint: A level bottom edge owns its centres, a level top edge does not.
        Hint: {row_hint(corners)}. In a row, the left end is drawn, the right end is not."""
    return of_triangle(corners, asked, names)


@template("thin-triangle", 3, "A thin triangle", "raster", 4)
def draw_thin(draws: Draws) -> Draft:
    """A thin triangle."""
    x = tenths(draws, 2, 8)
    corners = [
        (x, tenths(draws, 0, 2)),
        (x + Fraction(draws.whole(8, 20), 10), tenths(draws, 0, 2)),
        (x + Fraction(draws.whole(-30, 30), 10), tenths(draws, 7, 9)),
    ]
    names = ("vertices-rounded", "rows-rounded")
    asked = f"""Which pixels does this thin triangle cover? {RULE}
        Hint: Look at one row of centres at a time.
        Hint: The vertices keep their fractions.
        Hint: {row_hint(corners)}; the other sides likewise. Two crossings may have no centre between them."""
    return of_triangle(corners, asked, names)


@template("right-border", 3, "Beyond the right border", "raster", 3)
def draw_border(draws: Draws) -> Draft:
    """A triangle across the right border."""
    corners = [
        (tenths(draws, 5, 9), tenths(draws, 0, 3)),
        (tenths(draws, 13, 18), tenths(draws, 1, 7)),
        (tenths(draws, 5, 10), tenths(draws, 6, 9)),
    ]
    asked = f"""A triangle reaches beyond the right border. Which pixels of the window does it cover? {RULE}
        Hint: The window ends before column W.
        Hint: Only the part inside of the window is drawn.
        Hint: {row_hint(corners)}; the last column is {SIZE[0]} - 1."""
    return of_triangle(corners, asked, ("column-wrapped", "corner-for-center"))


@template("point-pixels", 2, "Pixels of points", "raster", 3)
def draw_points(draws: Draws) -> Draft:
    """Points, some of them left of the window."""
    places = [(Fraction(draws.whole(-9, 115), 10), tenths(draws, 0, 9)) for _ in range(6)]
    places.append((-Fraction(draws.whole(1, 9), 10), tenths(draws, 1, 8)))
    reject(any(c.denominator == 1 for place in places for c in place))
    x, y = np.array(places, float).T
    scene = assembled("points", x, y, SIZE)
    asked = f"""Which pixels do these points light? Pixel (i, j) reaches from i to i + 1 and from j to j + 1.
        Hint: The column of a point is floor(x).
        Hint: What is floor(x) for x between -1 and 0?
        Hint: The first point lies at (floor({number_text(places[0][0])}),
        floor({number_text(places[0][1])}))."""
    return pictured(asked, ", ".join(map(place_text, places)), scene, ("truncated-to-zero",))


@template("row-ends", 1, "First and last pixel of a row", "raster", 2)
def draw_ends(draws: Draws) -> Draft:
    """First and last pixel of a row."""
    corners = [(draws.whole(0, 11) + HALF, draws.whole(0, 8) + HALF) for _ in range(3)]
    row = draws.whole(2, 6)
    reject(abs(twice_area(corners)) < 16)
    scene = triangle_scene([corners], SIZE)

    def ends(frame: Frame) -> list[int]:
        columns = np.flatnonzero(frame.primitive[row] >= 0).tolist()
        return [*columns[:1], *columns[-1:]]

    right = ends(render(scene))
    names = ("right-end-drawn", "all-edges-exclusive", "corner-for-center")
    wrong = {name: ends(SHELF[name].draw(scene, Settings())) for name in names}
    reject(len({*right}) < 2)
    shown = {name: response for name, response in wrong.items() if response not in ([], right)}
    reject(not shown)
    asked = f"""Which are the first and the last column that this triangle covers in row {row}? {RULE}
        Hint: The centres of the row lie at y = {row} + 1/2.
        Hint: Where do the edges cross this line?
        Hint: {row_hint(corners, f"{row} + 1/2")}; a crossing on a centre belongs to the triangle on its
        right."""
    given = f"{WINDOW}\nTriangle: {corner_text(corners)}"
    return numbers(asked, given, right, shown, ("first", "last"), scene=scene)


@template("row-crossings", 1, "Where edges cross rows", "raster", 4)
def draw_rows(draws: Draws) -> Draft:
    """Left and right x of rows."""
    corners = sorted(((tenths(draws, 0, 11), tenths(draws, 0, 9)) for _ in range(3)), key=lambda c: c[1])
    heights = [corners[b][1] - corners[a][1] for a, b in SORTED_EDGES]
    reject(min(heights) < 1 or abs(twice_area(corners)) < 20)
    rows = range(ceil(corners[0][1] - HALF), floor(corners[2][1] - HALF) + 1)[:5]

    def crossings(rule: str, is_right: bool = False) -> list[list[Fraction]]:
        cross = RULES[rule].right if is_right else RULES[rule].wrong
        found = []
        for row in rows:
            spanned = [
                (corners[a], corners[b])
                for a, b in SORTED_EDGES
                if corners[a][1] <= row + HALF < corners[b][1]
            ]
            found.append(sorted(cross(*edge, row)[0] for edge in spanned))
        return found

    names = ("crossing-from-vertex", "height-plus-one")
    right = crossings(names[0], is_right=True)
    reject(any(len(row) != 2 or row[0] == row[1] for row in right))
    asked = f"""Where do the edges cross the centres of these rows, y = j + 1/2: left x and right x?
        Hint: Which two edges does each row cross?
        Hint: x = x0 + (y - y0)(x1 - x0)/(y1 - y0).
        Hint: {row_hint(corners, f"{rows[0]} + 1/2")}."""
    scene = triangle_scene([corners], SIZE)
    labels = [f"row {row}" for row in rows]
    wrong = {name: crossings(name) for name in names}
    given = f"Triangle: {corner_text(corners)}"
    settings = Settings(fill="scanline")
    return table(asked, given, ("left", "right"), labels, right, wrong, scene=scene, settings=settings)


@template("fourth-vertex", 1, "The vertex that splits a triangle", "raster", 2)
def draw_fourth(draws: Draws) -> Draft:
    """The point on the long edge that splits a triangle."""
    corners = [wholes(draws, 2, 0, 12) for _ in range(3)]
    v1, v2, v3 = sorted(corners, key=lambda c: -c[1])
    reject(len({v[1] for v in corners}) < 3)
    x = v1[0] + (v2[1] - v1[1]) / (v3[1] - v1[1]) * (v3[0] - v1[0])
    (x1, y1), (x3, y3) = (map(number_text, end) for end in (v1, v3))
    line_text = f"{x1} + ({number_text(v2[1])} - {y1}) / ({y3} - {y1}) * ({x3} - {x1})"
    asked = f"""A scanline fill splits a triangle at the height of its middle vertex. Where on the long edge,
        x and y, does the new vertex v4 lie?
        Hint: Sort the vertices by y.
        Hint: v4 has the y of the middle vertex, and lies between the other two.
        Hint: y = {number_text(v2[1])}, x = {line_text}."""
    scene = triangle_scene([corners], (13, 13))
    given = f"Triangle: {corner_text(corners)}"
    return numbers(asked, given, [x, v2[1]], names=("x", "y"), scene=scene)


@template("fan-count", 1, "How often a centre is drawn", "raster", 2)
def draw_fan(draws: Draws) -> Draft:
    """How often triangles around a pixel centre draw it."""
    center = (draws.whole(3, 8) + HALF, draws.whole(3, 5) + HALF)
    around = sorted(
        ((tenths(draws, 0, 12), tenths(draws, 0, 9)) for _ in range(draws.whole(4, 6))),
        key=lambda p: atan2(p[1] - center[1], p[0] - center[0]),
    )
    triangles = [[center, a, b] for a, b in zip(around, [*around[1:], around[0]], strict=True)]
    reject(min(twice_area(corners) for corners in triangles) < 1)
    scene = triangle_scene(triangles, SIZE)
    counts = [
        int(render(scene, Settings(fill_rule=rule)).cover_count[int(center[1]), int(center[0])])
        for rule in ("shared-edge", "inclusive", "exclusive")
    ]
    asked = f"""Triangles meet in a pixel centre. How often is this pixel drawn with the rule of shared edges
        (right, then up), with E >= 0 on all edges, and with E > 0 on all edges?
        Hint: For how many of the triangles is E = 0 on two edges there?
        Hint: The rule of shared edges moves the centre into exactly one of them.
        Hint: {place_text(center)} is a corner of each triangle: does each draw it with E >= 0, and with E >
        0?"""
    given = f"Centre {place_text(center)}; around it, counter-clockwise, lie {', '.join(map(place_text, around))}."
    return numbers(asked, given, counts, names=("shared edges", ">=", ">"), scene=scene)
