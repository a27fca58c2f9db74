"""Points to place: where a clipped segment ends, and a corner that is found again from its pixels."""

from fractions import Fraction

import numpy as np

from core import Settings, clip_lines
from lessons.exercises.answers.places import PlaceAnswer, Places
from lessons.exercises.answers.tables import ENTERS, LEAVES
from lessons.exercises.drawn_scene import DrawnScene
from lessons.exercises.draws import Draws
from lessons.exercises.file_answers import NoQuestionError, corner_answer
from lessons.exercises.question import Draft, Template
from lessons.exercises.templates.clipping import PARAMETERS, SIZE, Ends, parameter_rows
from lessons.exercises.templates.coverage import RULE, twice_area
from lessons.mistakes.shelf import SHELF
from lessons.small_scenes import segment_scene, triangle_scene

TOLERANCE = 0.1


def clipped_places(ends: Ends) -> Places:
    """Return exactly where the part of a segment in the window begins and ends."""
    times: dict[str, list[Fraction]] = {ENTERS: [Fraction(0)], LEAVES: [Fraction(1)]}
    for row in parameter_rows(ends, PARAMETERS):
        crossing = row[2]
        if crossing is not None and crossing[1] is not None:
            times[crossing[0]].append(Fraction(crossing[1]))
    (x0, y0), (x1, y1) = ends
    return tuple((x0 + t * (x1 - x0), y0 + t * (y1 - y0)) for t in (max(times[ENTERS]), min(times[LEAVES])))


def draw_ends(draws: Draws) -> Draft | None:
    """The two ends of a clipped segment."""
    ends = (draws.whole(-6, 2), draws.whole(-5, 2)), (draws.whole(6, 14), draws.whole(4, 11))
    clipped = clip_lines([ends], (0, 0, *SIZE))
    if not clipped.is_kept[0] or (clipped.cut_by < 0).any():
        return None
    right = clipped_places(ends)
    wrong = {}
    for name in ("ends-clamped", "crossings-rounded"):
        method = SHELF[name].change_settings(PARAMETERS).line_clipping
        places = clip_lines([ends], (0, 0, *SIZE), method).segments[0].tolist()
        wrong[name] = tuple((Fraction(x), Fraction(y)) for x, y in places)
    text = (
        "The segment is clipped to the window. Place its two ends that are left: where it enters and where it "
        "leaves. They lie on the line through the given ends."
    )
    hints = (
        "Which borders does the segment cross on its way in, and which on its way out?",
        "Of the crossings on the way in the last one counts, of those on the way out the first.",
        "A crossing lies at start + t (end - start), with t = q/p of its border.",
    )
    answer = PlaceAnswer(SIZE, ("entry", "exit"), right, (right[::-1],), Fraction(1, 4), TOLERANCE)
    given = f"Window 0..{SIZE[0]} x 0..{SIZE[1]}, segment from {ends[0]} to {ends[1]}."
    return Draft(text, given, answer, hints, wrong, segment_scene([ends], SIZE), PARAMETERS)


CORNER_SIZE = (12, 9)


def draw_corner(draws: Draws) -> Draft | None:
    """A corner of a triangle, from the pixels that it covers."""
    quarter = Fraction(1, 4)
    corners = [
        (draws.step(quarter, Fraction(47, 4), quarter), draws.step(quarter, Fraction(35, 4), quarter))
        for _ in range(3)
    ]
    if twice_area(corners) < 24:
        return None
    drawn = DrawnScene(triangle_scene(np.array([corners], float), CORNER_SIZE), (tuple(corners),))
    try:
        answer, given = corner_answer(drawn, (0, draws.whole(0, 2)), Settings(), quarter)
    except NoQuestionError:
        return None
    text = f"Place the corner ? so that triangle 0 covers exactly the pixels A. {RULE}"
    hints = (
        "Draw the side between the two corners that are given.",
        "Each of the other two sides passes between pixels that are covered and pixels that are not.",
        "Prolong both sides from the given corners: they meet in the corner.",
    )
    return Draft(text, given, answer, hints)


TEMPLATES = (
    Template("clip-ends", 1, "Ends of a clipped segment", "raster", 4, draw_ends),
    Template("corner-from-pixels", 1, "The corner behind the pixels", "raster", 3, draw_corner),
)
