"""Clipping: a line to a rectangle by outcodes or p, q and t; triangles and segments to the view volume."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np

from core import Settings, clip_lines
from core.culling.culling import PLANES
from core.lines.line_clipping import ENTER, LEAVE, ParameterRows
from lessons.exercises.answers.answer import ENTERS, LEAVES, Value
from lessons.exercises.answers.fields import Column, Row, Rows, TableAnswer, empty_rows, followed
from lessons.exercises.drafting import (
    TOLERANCE,
    by_rule,
    drafted,
    factor_text,
    listed,
    one_of,
    place_text,
    run_exactly,
    several,
)
from lessons.exercises.numbers import Draws, Number, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import corner_text
from lessons.exercises.templates.transforms import sketched, wholes
from lessons.mistakes.shelf import RULES, SHELF
from lessons.mistakes.twin import clipped_ends
from lessons.small_scenes import segment_scene

# Clipping a line to a rectangle: outcodes, and p, q and t.


Place = tuple[Number, Number]
Ends = tuple[tuple[int, int], tuple[int, int]]
SIZE = (8, 6)
"""Right and top border of the window; left and bottom are 0."""
BORDERS = (0, SIZE[0], 0, SIZE[1])
"""Left, right, bottom, top."""
PARAMETERS = Settings(line_clipping="liang-barsky")


def parameter_rows(ends: Ends, settings: Settings) -> Rows:
    """Return p, q and t at the four edges, as a clipper finds them."""
    found = clip_lines([ends], (0, 0, *SIZE), settings.line_clipping).rows
    assert isinstance(found, ParameterRows)
    words = {ENTER: ENTERS, LEAVE: LEAVES}
    rows = []
    for edge, case, p, q, t in zip(found.edge, found.case, found.along, found.room, found.t, strict=True):
        if edge >= 0:
            word = words.get(int(case), "none")
            number = None if word == "none" else Fraction(float(t)).limit_denominator(1000)
            rows.append((Fraction(float(p)), Fraction(float(q)), (word, number)))
    return tuple(rows)


def parameter_table(ends: Ends) -> TableAnswer:
    """Return the table of p, q and t, where t follows from the learner's p and q."""
    right = parameter_rows(ends, PARAMETERS)

    def follow(own: Sequence[Row], row: int, mine: Row) -> Value:
        if len(mine) < 2:
            return right[row][len(mine)]
        p, q = mine
        return ("none", None) if p == 0 else (ENTERS if p < 0 else LEAVES, q / p)

    columns = (Column("p"), Column("q"), Column("t", "crossing"))
    return TableAnswer(columns, ("left", "right", "bottom", "top"), right, follow, TOLERANCE)


def code_of(place: Place) -> str:
    """Return the outcode of a point: top, bottom, right, left."""
    x, y = place
    left, right, bottom, top = BORDERS
    return "".join("01"[is_outside] for is_outside in (y > top, y < bottom, x > right, x < left))


def moving_end(codes: str) -> tuple[int, int] | None:
    """Return which end moves, and to which edge (left, right, bottom, top): the first that its outcode names."""
    for end, code in enumerate(codes.split()):
        if "1" in code:
            return end, code[::-1].index("1")
    return None


def crossing(ends: Ends, edge: int) -> Place | None:
    """Return where the line through two points crosses an edge's line; ``None``: it is parallel."""
    (x0, y0), (x1, y1) = ends
    start, along, axis = (x0, y0), (x1 - x0, y1 - y0), edge // 2
    if along[axis] == 0:
        return None
    t = Fraction(BORDERS[edge] - start[axis], along[axis])
    return x0 + t * along[0], y0 + t * along[1]


def outcode_table(ends: Ends, count: int) -> TableAnswer:
    """Return the table of Cohen-Sutherland's first ``count`` cuts: both outcodes, and where the end moves."""

    def follow(own: Sequence[Row], row: int, mine: Row) -> Value:
        places: list[Place] = [(Fraction(x), Fraction(y)) for x, y in ends]
        for codes, x, y in own:
            moved = moving_end(codes) if codes else None
            if moved and x is not None and y is not None:
                places[moved[0]] = (x, y)
        if not mine:
            return f"{code_of(places[0])} {code_of(places[1])}"
        moves = moving_end(mine[0]) if mine[0] else None
        point = crossing(ends, moves[1]) if moves else None
        return None if point is None else point[len(mine) - 1]

    columns = (Column("outcodes", "codes"), Column("x"), Column("y"))
    labels = tuple(f"cut {number}" for number in range(1, count + 1))
    return TableAnswer(columns, labels, followed(follow, empty_rows(count, 3)), follow, TOLERANCE)


def _ends(draws: Draws) -> Ends:
    """Draw a segment that begins on the left or below and ends on the right or above."""
    start = draws.whole(-6, 2), draws.whole(-5, 2)
    return start, (draws.whole(6, 14), draws.whole(4, 11))


def cut_ends(draws: Draws) -> Ends:
    """Draw a segment of which both ends are cut off."""
    ends = _ends(draws)
    clipped = clip_lines([ends], (0, 0, *SIZE))
    reject(not clipped.is_kept[0] or bool((clipped.cut_by < 0).any()))
    return ends


@template("liang-barsky-table", 1, "Liang-Barsky's p, q and t", "raster", 6)
def draw_parameters(draws: Draws) -> Draft:
    """Liang-Barsky's p, q and t."""
    ends = cut_ends(draws)
    names = ("normals-inward", "entries-and-exits", "top-and-bottom")
    wrong = {name: parameter_rows(ends, SHELF[name].change_settings(PARAMETERS)) for name in names}
    x0, x1 = (factor_text(Fraction(x)) for x, _ in ends)
    asked = f"""Fill in p, q and t of Liang-Barsky at each edge. p is how fast the segment runs outward, q how
        much room its first end has, t = q/p. Put {ENTERS} before t where the segment enters (p < 0) and
        {LEAVES} where it leaves; write none where p = 0. Fractions, or decimals within 0.005.
        Hint: dx and dy are the differences of the ends.
        Hint: p is -dx, dx, -dy, dy; q is x0 - left, right - x0, y0 - bottom, top - y0.
        Hint: Left: p = -({x1} - {x0}), q = {x0} - 0, and t = q/p; its word depends on the sign of p."""
    return drafted(
        asked, segment_text(ends), parameter_table(ends), wrong, segment_scene([ends], SIZE), PARAMETERS
    )


@template("cohen-sutherland-table", 1, "Cohen-Sutherland's outcodes", "raster", 6)
def draw_outcodes(draws: Draws) -> Draft:
    """Cohen-Sutherland's cuts."""
    ends = _ends(draws)
    kept, passes = run_exactly("line_clipping", "cohen-sutherland", *ends[0], *ends[1], 0, 0, *SIZE)
    # The last pass only finds that the segment is inside.
    count = len(passes) - 1
    reject(not kept or count < 2)
    (x0, y0), (x1, y1) = ((factor_text(Fraction(c)) for c in place) for place in ends)
    asked = f"""Fill in Cohen-Sutherland's cuts. An outcode has the bits top, bottom, right, left, such as
        0101. Write the outcodes of both ends before each cut; then the first end that is outside moves to the
        first of left, right, bottom, top that it is outside of. A point on a border is inside. Fractions, or
        decimals within 0.005.
        Hint: Begin with the outcodes of the two ends.
        Hint: After each cut the outcodes are computed again: the new end may still be outside.
        Hint: The line through the given ends: y = {y0} + (x - {x0}) ({y1} - {y0}) / ({x1} - {x0})."""
    answer = outcode_table(ends, count)
    settings = Settings(line_clipping="cohen-sutherland")
    return drafted(asked, segment_text(ends), answer, {}, segment_scene([ends], SIZE), settings)


def segment_text(ends: Ends) -> str:
    """Return the window and a segment as a question states them."""
    return f"Window 0..{SIZE[0]} x 0..{SIZE[1]}, segment from {ends[0]} to {ends[1]}."


# Clipping triangles and segments: planes of the view volume, new corners, what is left.


WINDOW = f"Window 0..{SIZE[0]} x 0..{SIZE[1]}"


@template("planes-outside", 1, "Planes of the view volume", "clip", 3)
def draw_planes(draws: Draws) -> Draft:
    """Planes that a clip position lies outside of."""
    clip = (*wholes(draws, 3, -6, 6), Fraction(draws.item((1, 2, 3, 4, -1, -2))))
    rule = RULES["planes-after-divide"]
    right = rule.right(clip)
    z, w = map(factor_text, clip[2:])
    asked = f"""Outside of which planes of the view volume does this clip position lie? Inside is -w <= x, y,
        z <= w, compared before the divide.
        Hint: Do not divide.
        Hint: near: w + z, far: w - z, left: w + x, right: w - x, bottom: w + y, top: w - y.
        Hint: near: {w} + {z}, far: {w} - {z}, and so on: outside of a plane this is negative."""
    # With w > 0 both tests agree: the divide is harmless there.
    wrong = {rule.name: rule.wrong(clip)} if clip[3] < 0 else {}
    return several(asked, f"Clip position: {place_text(clip)}", PLANES, right, wrong)


@template("near-crossing", 1, "A new vertex at the near plane", "clip", 2)
def draw_near(draws: Draws) -> Draft:
    """Where an edge crosses the near plane."""
    inside, outside = draws.whole(1, 8), -draws.whole(1, 8)
    u = [Fraction(draws.whole(10, 99)) for _ in range(2)]
    t = Fraction(inside, inside - outside)
    given = (
        f"End A inside: w + z = {inside}, u = {u[0]}\nEnd B outside: w + z = {outside}, u = {u[1]}\n"
        "t runs from 0 at A to 1 at B."
    )
    asked = f"""An edge crosses the near plane. What is the attribute u of the new vertex?
        Hint: Where is the distance w + z zero?
        Hint: t = a / (a - b) with the distances a and b of the ends.
        Hint: t = {inside} / ({inside} - ({outside}))."""
    return by_rule(asked, given, (u[0], u[1], t), ("attribute-copied",))


@template("triangles-after-clipping", 1, "Triangles after clipping", "clip", 1)
def draw_count(draws: Draws) -> Draft:
    """Triangles that one plane leaves."""
    distances = wholes(draws, 3, -6, 6)
    inside = sum(d > 0 for d in distances)
    reject(not all(distances) or inside in (0, 3))
    given = f"w + z at the three vertices: {place_text(distances)}. Inside is where it is positive."
    asked = f"""How many triangles are drawn after this one is clipped against the near plane?
        Hint: How many vertices does the polygon have that is left?
        Hint: n vertices make n - 2 triangles.
        Hint: Count the positive ones of {place_text(distances)}, and a new vertex for each change of sign
        around it."""
    rule = RULES["quad-as-triangle"]
    right, wrong = int(rule.right(inside)[0]), int(rule.wrong(inside)[0])
    return one_of(asked, given, ("none", "1", "2", "3"), right, {} if wrong == right else {rule.name: wrong})


@template("clipped-area", 1, "What a window leaves of a triangle", "clip", 4)
def draw_area(draws: Draws) -> Draft:
    """What a window leaves of a triangle."""
    left, bottom = draws.whole(1, 4), draws.whole(1, 3)
    wide, high = draws.whole(4, 8), draws.whole(4, 6)
    corners = [(left, bottom), (left + wide, bottom), (left, bottom + high)]
    window = [(0, 0), (draws.whole(4, 6), 0)]
    window = [*window, (window[1][0], 9), (0, 9)]
    rule = RULES["window-clockwise"]
    polygons = [[(float(x), float(y)) for x, y in places] for places in (corners, window)]
    reject(not 0 < rule.right(*polygons)[0] < wide * high / 2)
    given = (
        f"Triangle: {corner_text([(Fraction(x), Fraction(y)) for x, y in corners])}\nWindow, counter-clockwise: "
        f"{corner_text([(Fraction(x), Fraction(y)) for x, y in window])}"
    )
    asked = f"""What is the area that is left of the triangle after it is clipped to the window?
        Hint: Which border does it cross?
        Hint: Find the new corners, then the area of the polygon, or of what is cut off.
        Hint: A part of the level side, {left + wide} - {window[1][0]} long, is cut off, and the slope stays
        the same."""
    return by_rule(asked, given, tuple(polygons), (rule.name,), sketch=sketched({}, corners, window))


VERDICTS = (
    "kept whole",
    "shortened",
    "rejected: t_E > t_L",
    "rejected: parallel to an edge and outside of it",
)


def around(draws: Draws) -> tuple[int, int]:
    """Draw a point in the window or around it."""
    return draws.whole(-6, 14), draws.whole(-5, 11)


def verdict_on(start: tuple[int, int], end: tuple[int, int]) -> int:
    """Return the number of Cyrus-Beck's verdict on a segment."""
    outside = [not 0 <= c <= s for c, s in zip(start, SIZE, strict=True)]
    along = [b - a for a, b in zip(start, end, strict=True)]
    if any(d == 0 and o for d, o in zip(along, outside, strict=True)):
        return 3
    clipped = clip_lines([(start, end)], (0, 0, *SIZE))
    return 2 if not clipped.is_kept[0] else 1 if (clipped.cut_by >= 0).any() else 0


@template("cyrus-beck-verdict", 2, "Cyrus-Beck's verdicts", "raster", 2)
def draw_verdict(draws: Draws) -> Draft:
    """What Cyrus-Beck does with a segment; each verdict is asked for equally often."""
    verdict = 3 - draws.whole(0, 3)
    start = end = (0, 0)
    while start == end or verdict_on(start, end) != verdict:
        start, end = around(draws), around(draws)
        if verdict == 3:
            end = (end[0], start[1])
    scene, settings = segment_scene([(start, end)], SIZE), Settings(line_clipping="liang-barsky")
    kept = clipped_ends(scene, SHELF["parallel-kept"].change_settings(settings))
    wrong = {}
    if verdict == 3:
        wrong["parallel-kept"] = 2 if not kept else 0 if np.array_equal(kept[0], [start, end]) else 1
    given = segment_text((start, end))
    (x0, y0), (x1, y1) = ((factor_text(Fraction(c)) for c in place) for place in (start, end))
    asked = f"""What does Cyrus-Beck do with this segment? t_E is the largest t of the entries and 0, t_L the
        smallest t of the exits and 1; a segment parallel to an edge and outside of it is rejected.
        Hint: Is N . D zero at some edge?
        Hint: N . D < 0 enters, N . D > 0 leaves.
        Hint: D = ({x1} - {x0}, {y1} - {y0}): find N . D and t at each border, then compare the last entry
        with the first exit."""
    # Of the right run, too: where nothing is clipped, the mistake would have no listing to be stepped in.
    return replace(one_of(asked, given, VERDICTS, verdict, wrong, scene), settings=settings)


@template("rejected-at-once", 2, "Segments rejected at once", "raster", 3)
def draw_rejected(draws: Draws) -> Draft:
    """Segments that outcodes reject at once."""
    segments: list[Ends] = [(around(draws), around(draws)) for _ in range(5)]
    reject(any(start == end for start, end in segments))
    codes = [[code_of(place) for place in ends] for ends in segments]
    right = [k for k, (a, b) in enumerate(codes) if any(x == y == "1" for x, y in zip(a, b, strict=True))]
    names = "ABCDE"
    given = f"{WINDOW}.\n" + listed("{}: {} to {}", names, *zip(*segments, strict=True))
    xs, ys = zip(*segments[0], strict=True)
    asked = f"""Which segments does Cohen-Sutherland reject at once? An outcode has a bit for each border that
        an end lies outside of; a segment is rejected where both ends share a bit. A point on a border is
        inside.
        Hint: Write the outcodes of all ends.
        Hint: Two ends outside of different borders share no bit.
        Hint: A has x = {xs[0]} and {xs[1]}, y = {ys[0]} and {ys[1]}: are both ends left of 0, right of
        {SIZE[0]}, below 0 or above {SIZE[1]}?"""
    return several(asked, given, tuple(names), right, scene=segment_scene(segments, SIZE))
