"""Filling polygons row by row: crossings, active edges, level sides; and a square that is filled by weights."""

from fractions import Fraction
from math import atan2

import numpy as np

from core import Settings
from lessons.exercises.answers.pixels import PixelAnswer
from lessons.exercises.draws import Draws, reject
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import SIZE, corner_text, row_hint
from lessons.exercises.templates.drafting import (
    by_rule,
    drafted,
    factor_text,
    listed,
    one_of,
    pictured,
    place_text,
    several,
)
from lessons.exercises.templates.filling import HALF, WINDOW, is_decided, tenths
from lessons.mistakes.shelf import RULES
from lessons.polygons import polygon_of_rings
from lessons.small_scenes import triangle_scene


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
