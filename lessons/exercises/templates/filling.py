"""Filling row by row: a triangle's flat sides, rows and borders; a polygon's crossings and active edges."""

from fractions import Fraction
from math import atan2, ceil, floor

import numpy as np

from core import Settings, render
from core.records.frame import Frame
from lessons.assembled_scenes import assembled
from lessons.exercises.answers.marked import PixelAnswer
from lessons.exercises.coding.triangles import edge_of
from lessons.exercises.drafting import (
    by_rule,
    drafted,
    factor_text,
    listed,
    numbers,
    one_of,
    pictured,
    place_text,
    several,
    table,
    window_text,
)
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import RULE, SIZE, Corner, corner_text, row_hint, twice_area
from lessons.exercises.templates.transforms import wholes
from lessons.mistakes.shelf import RULES, SHELF
from lessons.small_scenes import triangle_scene
from lessons.window_scenes import polygon_of_rings

# Filling triangles: rows of a scanline fill, flat sides, borders of the window, how often a pixel is drawn.


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


# Filling polygons row by row: crossings, active edges, level sides; and a square that is filled by weights.


@template("star-polygon", 3, "A polygon that crosses itself", "raster", 4)
def draw_star(draws: Draws) -> Draft:
    """A polygon that crosses itself, or turns around a part twice."""
    corners = [(tenths(draws, 0, 12), tenths(draws, 0, 9)) for _ in range(5)]
    around = sorted(corners, key=lambda p: atan2(p[1] - Fraction(9, 2), p[0] - 6))
    star = [around[2 * k % 5] for k in range(5)]
    reject(min(abs(p[0] - 6) + abs(p[1] - Fraction(9, 2)) for p in corners) < 3 or not is_decided(star))
    rule, said = draws.item(
        (
            ("even-odd", "an odd number of edges lies to its left in its row"),
            ("non-zero", "the directions of the edges to its left in its row, up or down, do not cancel"),
        )
    )
    scene, settings = polygon_of_rings([np.array(star, float)], SIZE), Settings(polygon_fill=rule)
    asked = f"""Which pixels does this polygon cover by the {rule} rule? A centre (i + 1/2, j + 1/2) is inside
        if {said}. The polygon is closed, and crosses itself.
        Hint: Sketch the polygon: a star around a middle part.
        Hint: Go along a row from the left, and count what you cross.
        Hint: {row_hint(star)}. The polygon runs around its middle twice: there the rules differ."""
    given = f"Polygon: {', '.join(map(place_text, star))}"
    return pictured(asked, given, scene, ("winding-ignored",), settings)


@template("crossing-count", 1, "Crossings at vertices", "raster", 2)
def draw_crossings(draws: Draws) -> Draft:
    """Crossings of a polygon with a line through its vertices."""
    places = {(draws.whole(0, 9), draws.whole(0, 6)) for _ in range(6)}
    polygon = sorted(places, key=lambda p: (atan2(p[1] - 3, p[0] - 4), p))
    y = draws.item(polygon)[1]
    rule = RULES["both-ends-crossed"]
    right, wrong = (int(count(polygon, y)[0]) for count in (rule.right, rule.wrong))
    options = ("0", "1", "2", "3", "4", "5", "6")
    reject(len(polygon) < 5 or right >= len(options) or not right < wrong < len(options))
    sides = zip(polygon, [*polygon[1:], polygon[0]], strict=True)
    start, end = next(side for side in sides if side[0][1] != side[1][1])
    low, high = sorted((start[1], end[1]))
    asked = f"""How many crossings does a scanline fill count on the line y = {y}? An edge counts where the
        line is at or above its lower end and below its upper end; level edges do not count.
        Hint: Go round the polygon, one edge at a time.
        Hint: A vertex on the line is the lower end of one edge and the upper end of another.
        Hint: The edge from {start} to {end} counts where {low} <= {y} < {high}: ask it of each edge."""
    given = f"Polygon: {', '.join(map(str, polygon))}"
    return one_of(asked, given, options, right, {rule.name: wrong})


EDGES = ("from 0 to 1", "from 1 to 2", "from 2 to 3", "from 3 to 4", "from 4 to 0")


@template("active-edges", 1, "Active edges of a row", "raster", 2)
def draw_active(draws: Draws) -> Draft:
    """The active edges of a row."""
    corners = [(tenths(draws, 0, 12), tenths(draws, 0, 9)) for _ in EDGES]
    polygon = sorted(corners, key=lambda p: atan2(p[1] - Fraction(9, 2), p[0] - 6))
    row = draws.whole(2, 7)
    rule = RULES["edges-leave-late"]
    right, wrong = (count(polygon, row + HALF) for count in (rule.right, rule.wrong))
    reject(not is_decided(polygon))
    low, high = map(number_text, sorted(y for _, y in polygon[:2]))
    asked = f"""A scanline fill keeps an active edge table. Which edges are active while row {row} is drawn,
        at y = {row} + 1/2? An edge enters the table at the first row whose centres are not below its lower
        end, and leaves it before the first row whose centres are not below its upper end.
        Hint: Look at the y of both ends of each edge.
        Hint: Is {row} + 1/2 at or above the lower end, and below the upper end?
        Hint: {EDGES[0].capitalize()}: is {low} <= {row} + 1/2 < {high}? An even number of edges is active."""
    scene = polygon_of_rings([np.array(polygon, float)], SIZE)
    given = f"{WINDOW}\nVertices 0 to 4: {corner_text(polygon)}"
    return several(asked, given, EDGES, right, {rule.name: wrong}, scene)


@template("level-sides", 2, "Level sides with their pixels", "raster", 3)
def draw_level(draws: Draws) -> Draft:
    """A polygon with a level upper side, with all that lies on its border."""
    low, high = draws.whole(0, 2) + HALF, draws.whole(5, 8) + HALF
    (a, b), (c, d) = ((draws.whole(0, 5) + HALF, draws.whole(6, 11) + HALF) for _ in range(2))
    polygon = ((a, low), (b, low), (d, high), (c, high))
    rule = RULES["level-side-dropped"]
    asked = f"""Which pixels does this polygon cover if everything on its border counts? A pixel is drawn
        where its centre (i + 1/2, j + 1/2) lies inside or on the border.
        Hint: Look at one row of centres at a time, from the lowest vertex to the highest.
        Hint: In a row, both ends of the span are drawn where they fall on centres.
        Hint: {row_hint([*polygon])}; the level sides at y = {number_text(low)} and {number_text(high)} are
        drawn, too."""
    # Two triangles draw the same if each of them draws its border.
    scene = triangle_scene(
        np.array([[polygon[k] for k in (0, 1, 2)], [polygon[k] for k in (0, 2, 3)]], float), SIZE
    )
    answer, wrong = PixelAnswer(SIZE, rule.right(polygon)), {rule.name: rule.wrong(polygon)}
    given = f"{WINDOW}\nPolygon: {corner_text(list(polygon))}"
    return drafted(asked, given, answer, wrong, scene, Settings(fill_rule="inclusive"))


@template("float-weights", 1, "Weights on a shared edge", "raster", 2)
def draw_float(draws: Draws) -> Draft:
    """How many pixels two triangles draw whose common edge runs through centres."""
    side, shift = draws.whole(5, 9), Fraction(draws.whole(1, 9), 16384)
    low, high, far = HALF - shift, side - HALF, side - HALF + shift
    halves = (
        draws.shuffled(((HALF, high), (HALF, low), (far, low))),
        draws.shuffled(((far, low), (far, high), (HALF, high))),
    )
    given = listed("Triangle {k}: {}", map(list, halves))
    asked = f"""Two triangles share an edge that runs through pixel centres. A pixel is drawn where alpha,
        beta and gamma at its centre (i + 1/2, j + 1/2) lie in [0, 1] in one of them, ends included. How many
        different pixels are drawn, if nothing is rounded?
        Hint: Sketch both triangles: which shape do they make?
        Hint: A centre on the common edge has a weight of exactly 0 in both triangles.
        Hint: Count the centres i + 1/2 from 1/2 to {factor_text(far)} and j + 1/2 from {factor_text(low)} to
        {number_text(high)}, those on the border, too."""
    return by_rule(asked, given, (halves, side + 1), ("third-weight-rounded",))
