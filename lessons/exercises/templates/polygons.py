"""Clipping triangles and segments: planes of the view volume, new corners, what is left."""

from dataclasses import replace
from fractions import Fraction

import numpy as np

from core import Settings, clip_lines
from core.geometry.culling import PLANES
from lessons.exercises.draws import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.clipping import SIZE, Ends, code_of, segment_text
from lessons.exercises.templates.coverage import corner_text
from lessons.exercises.templates.drafting import by_rule, factor_text, listed, one_of, place_text, several
from lessons.exercises.templates.transforms import sketched, wholes
from lessons.mistakes.shelf import RULES, SHELF
from lessons.mistakes.twin import clipped_ends
from lessons.small_scenes import segment_scene

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
    reject(u[0] == u[1])
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
