"""Listings with one wrong line, of several stages, and pictures that a mistake made."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

from core import Settings
from lessons.exercises.answers.listings import LineAnswer
from lessons.exercises.answers.marked import PixelAnswer, Pixels
from lessons.exercises.drafting import DrawnScene, drafted, listed
from lessons.exercises.file_answers import spot_answer
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import RULE, row_hint, twice_area
from lessons.exercises.templates.lines import moves_text
from lessons.lectures.catalogue import printed_listing
from lessons.mistakes.scan_conversion import LECTURE
from lessons.mistakes.shelf import SHELF
from lessons.mistakes.twin import line_pixels
from lessons.small_scenes import pixel_segments, triangle_scene

# Listings with one wrong line, and pictures that a mistake made.


LISTING = (
    *("dx = x1 - x0", "dy = y1 - y0", "yi = 1", "if dy < 0:", "    yi = -1", "    dy = -dy"),
    *("D = 2*dy - dx", "y = y0", "for x = x0 to x1:", "    draw(x, y)", "    if D > 0:"),
    *("        y = y + yi", "        D = D - 2*dx", "    D = D + 2*dy"),
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


# Short listings of several stages, each with one wrong line.


@dataclass(frozen=True)
class Listed:
    """A listing, and lines that are wrong in its place."""

    name: str
    stage: str
    title: str
    asked: str
    """What the listing must do, with the rule that decides, and the hints."""
    text: str
    faults: Mapping[int, tuple[str, ...]]
    """By the number of a line, from 0, what may stand there in its place."""


LISTINGS = (
    Listed(
        "viewport-line",
        "transform",
        "The wrong line from clip space to the window",
        """x, y and w of clip space lead to the pixel: divide, then map [-1, 1] to the window of W x H pixels,
        y up.
        Hint: Follow the point in the middle of the window, and its corners.
        Hint: Where must -1 go, and where 1?
        Hint: (x, y) = (-1, -1) goes to (0, 0), and (1, 1) to (W, H): put them into each line.""",
        """\
x_ndc = x / w
y_ndc = y / w
x_window = (x_ndc + 1) / 2 * W
y_window = (y_ndc + 1) / 2 * H
column = floor(x_window)
row = floor(y_window)""",
        {
            0: ("x_ndc = x",),
            1: ("y_ndc = y * w",),
            2: ("x_window = (x_ndc + 1) / 2 * (W - 1)", "x_window = x_ndc / 2 * W"),
            3: ("y_window = (1 - y_ndc) / 2 * H",),
            5: ("row = ceil(y_window)",),
        },
    ),
    Listed(
        "coverage-line",
        "raster",
        "The wrong line of a coverage test",
        """A pixel is covered where its centre lies inside of all three edges of a counter-clockwise triangle.
        Hint: Which point of a pixel is put into the edge functions?
        Hint: How many of the three values must agree?
        Hint: Put i = 2 and j = 1 into each line: where is the centre of this pixel, and which values must be
        positive?""",
        """\
covered = []
for j in range(rows):
    for i in range(columns):
        x, y = i + 0.5, j + 0.5
        values = [a * x + b * y + c for a, b, c in edges]
        if min(values) > 0:
            covered.append((i, j))""",
        {
            3: ("        x, y = i, j", "        x, y = j + 0.5, i + 0.5"),
            4: ("        values = [a * x - b * y + c for a, b, c in edges]",),
            5: ("        if max(values) > 0:", "        if min(values) < 0:"),
        },
    ),
    Listed(
        "liang-barsky-line",
        "raster",
        "The wrong line of Liang-Barsky",
        """p < 0 enters, p > 0 leaves; the part from t_in to t_out is kept where t_in <= t_out.
        Hint: Of several entries, which one counts?
        Hint: Follow a segment that is parallel to a border.
        Hint: Put p = -1, q = 0 and p = 1, q = 1 into each line, and follow t_in and t_out.""",
        """\
t_in, t_out = 0, 1
outside = False
for p, q in borders:
    if p == 0 and q < 0:
        outside = True
    elif p < 0:
        t_in = max(t_in, q / p)
    elif p > 0:
        t_out = min(t_out, q / p)
kept = not outside and t_in <= t_out""",
        {
            0: ("t_in, t_out = 1, 0",),
            3: ("    if p == 0 and q > 0:",),
            5: ("    elif q < 0:",),
            6: ("        t_in = min(t_in, q / p)", "        t_in = max(t_in, p / q)"),
            8: ("        t_out = max(t_out, q / p)",),
        },
    ),
    Listed(
        "perspective-line",
        "interpolate",
        "The wrong line of perspective interpolation",
        """u at a pixel with the window weights alpha, beta, gamma, with perspective: u/w and 1/w are linear
        there.
        Hint: Put in equal w: what must come out?
        Hint: Which sum is divided by which?
        Hint: u = (alpha u0/w0 + beta u1/w1 + gamma u2/w2) / (alpha/w0 + beta/w1 + gamma/w2).""",
        """\
p = alpha / w0
q = beta / w1
r = gamma / w2
total = p + q + r
u = (p * u0 + q * u1 + r * u2) / total""",
        {
            0: ("p = alpha",),
            1: ("q = beta * w1",),
            3: ("total = 1", "total = w0 + w1 + w2"),
            4: ("u = p * u0 + q * u1 + r * u2", "u = (p * u2 + q * u0 + r * u1) / total"),
        },
    ),
    Listed(
        "depth-line",
        "depth",
        "The wrong line of a depth test",
        """Fragments of one pixel come in any order; the nearest is shown, smaller is nearer, a tie keeps what
        is there.
        Hint: Follow three fragments with a tie among them.
        Hint: What must the buffer hold after a fragment passed?
        Hint: Write stored and shown after every line, with z = 1, z = 2 and z = 1 again.""",
        """\
stored = inf
shown = background
for z, color in fragments:
    if z < stored:
        stored = z
        shown = color""",
        {0: ("stored = 0",), 3: ("    if z > stored:", "    if z <= stored:"), 4: ("        stored = inf",)},
    ),
    Listed(
        "over-line",
        "blend",
        "The wrong line of blending",
        """Layers lie over an opaque background, the first of the list lowest; colours are straight, alpha
        from 0 to 1.
        Hint: What must one layer with alpha 1 give, and one with alpha 0?
        Hint: Which layer hides which?
        Hint: Each layer gives alpha source + (1 - alpha) color: compare this with the lines of the loop.""",
        """\
color = background
for source, alpha in layers:
    kept = 1 - alpha
    color = alpha * source + kept * color
shown = color""",
        {
            0: ("color = 0",),
            1: ("for source, alpha in reversed(layers):",),
            2: ("    kept = alpha", "    kept = 1"),
            3: ("    color = source + kept * color", "    color = kept * source + alpha * color"),
        },
    ),
)


def draw_listing(listed: Listed, draws: Draws) -> Draft:
    """A listing with one of its wrong lines."""
    number = draws.item(tuple(listed.faults))
    wrong = draws.item(listed.faults[number])
    lines = listed.text.split("\n")
    answer = LineAnswer((*lines[:number], wrong, *lines[number + 1 :]), number)
    return drafted(listed.asked, "", answer, behind="One line of this listing is wrong. Which?")


for _listed in LISTINGS:
    template(_listed.name, 1, _listed.title, _listed.stage, 2)(partial(draw_listing, _listed))
