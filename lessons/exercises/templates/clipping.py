"""Clipping a line to a rectangle: outcodes, and p, q and t."""

from collections.abc import Sequence
from fractions import Fraction

from core import Settings, clip_lines
from core.geometry.line_clipping.records import ENTER, LEAVE, ParameterRows
from lessons.exercises.answers.cells import ENTERS, LEAVES, Value
from lessons.exercises.answers.fields import Column, Row, Rows, TableAnswer, empty_rows, followed
from lessons.exercises.draws import Draws, reject
from lessons.exercises.numbers import Number
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.drafting import TOLERANCE, drafted, factor_text, run_exactly
from lessons.mistakes.shelf import SHELF
from lessons.small_scenes import segment_scene

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
