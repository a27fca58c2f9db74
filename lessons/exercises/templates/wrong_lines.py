"""Short listings of several stages, each with one wrong line."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

from lessons.exercises.answers.listings import LineAnswer
from lessons.exercises.draws import Draws
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.drafting import drafted


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
