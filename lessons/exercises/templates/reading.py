"""Listings with one wrong line, and pictures that a mistake made."""

from fractions import Fraction

from core import Settings
from lessons.exercises.answers.listings import LineAnswer
from lessons.exercises.answers.pixels import PixelAnswer, Pixels
from lessons.exercises.drawn_scene import DrawnScene
from lessons.exercises.draws import Draws, reject
from lessons.exercises.file_answers import spot_answer
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import RULE, row_hint, twice_area
from lessons.exercises.templates.drafting import drafted, listed
from lessons.exercises.templates.lines import moves_text
from lessons.mistakes.lines import LECTURE
from lessons.mistakes.shelf import SHELF
from lessons.mistakes.twin import line_pixels
from lessons.printed.catalogue import printed_listing
from lessons.small_scenes import pixel_segments, triangle_scene

LISTING = (
    "dx = x1 - x0",
    "dy = y1 - y0",
    "yi = 1",
    "if dy < 0:",
    "    yi = -1",
    "    dy = -dy",
    "D = 2*dy - dx",
    "y = y0",
    "for x = x0 to x1:",
    "    draw(x, y)",
    "    if D > 0:",
    "        y = y + yi",
    "        D = D - 2*dx",
    "    D = D + 2*dy",
)
"""Bresenham's line for x0 < x1 and slopes from -1 to 1, the last pixel drawn."""
FAULTS = {
    "ties-step": (10, "    if D >= 0:"),
    "start-not-doubled": (6, "D = dy - dx"),
    "slope-always-up": (11, "        y = y + 1"),
    "last-pixel-lost": (8, "for x = x0 to x1 - 1:"),
}
"""By the name of a twin, the number of its line from 0, and that line."""
SIZE = (14, 9)


def listed_pixels(fault: str, ends: tuple[tuple[int, int], tuple[int, int]]) -> Pixels:
    """Return the pixels that the listing with a fault draws in the window."""
    return line_pixels(pixel_segments([ends], SIZE), SHELF[fault].change_settings(LECTURE))


@template("wrong-line", 1, "The wrong line of Bresenham", "raster", 2)
def draw_line(draws: Draws) -> Draft:
    """Bresenham's listing with the line of a twin."""
    fault = draws.item(tuple(FAULTS))
    dx = draws.whole(6, 10)
    dy = draws.whole(1, min(dx - 1, 5))
    x0, low = draws.whole(0, 3), draws.whole(0, 2)
    ends = (
        ((x0, low + dy), (x0 + dx, low)) if fault == "slope-always-up" else ((x0, low), (x0 + dx, low + dy))
    )
    right = line_pixels(pixel_segments([ends], SIZE), LECTURE)
    drawn = listed_pixels(fault, ends)
    reject(drawn == right)
    number, wrong = FAULTS[fault]
    answer = LineAnswer((*LISTING[:number], wrong, *LISTING[number + 1 :]), number)
    art = PixelAnswer(SIZE, right).text(drawn)
    given = f"From pixel {ends[0]} to pixel {ends[1]} the listing draws:\n{art}"
    asked = f"""This listing should draw Bresenham's line: D begins at 2 dy - dx, a tie (D = 0) stays in the
        row, and the last pixel is drawn. One line is wrong. Which?
        Hint: Where does the drawn line first leave the right one?
        Hint: Follow D by hand for the first pixels, and compare with the listing.
        Hint: {moves_text(*ends)}: D takes 2 dy with every pixel and loses 2 dx with every step of y."""
    return drafted(asked, given, answer, {}, pixel_segments([ends], SIZE), LECTURE)


RISING = "the line from (0, 0) to (2, 1)"
SLIPS = (
    ("lmu-common-steps", "v += 1", "the pixel (x, y) is to be drawn next", RISING),
    ("lmu-with-d", "D=2*dy-x", "D is the part of 2 e dx + 2 dy - dx that stays the same", RISING),
    ("lmu-final", "D = 2*dx", "a step of y lowers D by 2 dx", RISING),
    (
        "lmu-falling",
        "D=2*dy-dx",
        "dy is below 0, and D begins at 2 |dy| - dx",
        "the line from (0, 1) to (2, 0)",
    ),
    (
        "jubair-cyrus-beck",
        "if Ni . D != 0 then",
        "a segment parallel to an edge and outside of it is rejected",
        "a segment with Ni . D = 0, outside of edge 1,",
    ),
)
"""Printed listings, what their wrong line holds, what must hold instead, and a case to follow."""


@template("lecture-slip", 1, "A slip in a lecture's listing", "raster", 2)
def draw_slip(draws: Draws) -> Draft:
    """A listing as a lecture prints it."""
    name, slip, rule, case = draws.item(SLIPS)
    printed = printed_listing(name)
    lines = tuple(printed.text.split("\n"))
    answer = LineAnswer(lines, next(k for k, line in enumerate(lines) if slip in line))
    asked = f"""{printed.title}, as a lecture prints it. One line is a slip: {rule}. Which line?
        Hint: Ask of every line what it changes, and whether that is declared.
        Hint: Which line has to care that {rule}?
        Hint: Follow {case} by hand: after which line is a value not what it must be?"""
    return drafted(asked, "", answer)


PICTURES = (
    "corner-for-center",
    "all-edges-inclusive",
    "all-edges-exclusive",
    "vertices-rounded",
    "y-down",
    "rows-and-columns",
    "box-truncated",
)


@template("wrong-picture", 1, "What is wrong with this picture", "raster", 4)
def draw_picture(draws: Draws) -> Draft:
    """The picture of a triangle with one of several mistakes."""
    half = Fraction(1, 2)
    corners = [(draws.step(half, Fraction(11), half), draws.step(half, Fraction(8), half)) for _ in range(3)]
    names = draws.shuffled(PICTURES)[:4]
    reject(twice_area(corners) < 16)
    drawn = DrawnScene(triangle_scene([corners], (12, 9)), (tuple(corners),))
    answer, given = spot_answer(names, drawn, Settings(), draws)
    asked = f"""What is wrong with this picture? Click where, and say which mistake made it. {RULE}
        Hint: Find a row in which the edges of the triangle do not fit to the pixels.
        Hint: Look at the lowest and the highest row, and at centres that lie on edges.
        Hint: {row_hint(corners)}: do the pixels of that row begin or end there?"""
    return drafted(asked, given, answer, {}, drawn.scene)


DEPTH_PICTURES = ("farther-wins", "no-depth-test", "painted-by-mean", "last-wins-ties")


@template("wrong-depth-picture", 1, "What is wrong with what is seen", "depth", 4)
def draw_depth_picture(draws: Draws) -> Draft:
    """The picture of three triangles with a mistake in what is seen."""
    corners = [[(draws.whole(0, 11), draws.whole(0, 8)) for _ in range(3)] for _ in range(3)]
    depth = [[Fraction(draws.whole(1, 9), 10) for _ in range(3)] for _ in corners]
    places = tuple(tuple((Fraction(x), Fraction(y)) for x, y in one) for one in corners)
    reject(min(abs(twice_area(list(one))) for one in places) < 24)
    scene = triangle_scene(corners, (12, 9), depth=depth)
    names = draws.shuffled(DEPTH_PICTURES)[:3]
    answer, given = spot_answer(names, DrawnScene(scene, places), Settings(), draws)
    depths = listed("Depths of triangle {k}: {}", depth)
    asked = f"""What is wrong with this picture? Click where, and say which mistake made it. A, B and C are
        triangles 0, 1 and 2, drawn in this order; the nearest is seen, and smaller is nearer.
        Hint: Only pixels that lie in two triangles can be wrong.
        Hint: Compare the depths there: which triangle should be seen?
        Hint: The mean depth of triangle 0 is a third of {" + ".join(map(number_text, depth[0]))}. Is the
        wrong one always the farther one, always the later one, or the one with the nearer middle?"""
    return drafted(asked, f"{given}\n{depths}", answer, {}, scene)
