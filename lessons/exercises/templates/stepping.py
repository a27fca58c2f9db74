"""Be the rasterizer: Bresenham's line, the depth test and a clipped triangle, one step at a time."""

from fractions import Fraction

from core import draw_lines
from lessons.exercises.answers.cells import Entry, Value
from lessons.exercises.answers.steps import StepsAnswer, first_tries
from lessons.exercises.draws import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import corner_text, twice_area
from lessons.exercises.templates.drafting import drafted
from lessons.exercises.templates.fragments import FRAGMENT_PIXELS, again_text, card_scene
from lessons.exercises.templates.lines import RULE, SIZE, TALL, Ends
from lessons.mistakes.lines import LECTURE
from lessons.mistakes.twin import segment_ends
from lessons.small_scenes import pixel_segments


def line_values(ends: Ends, twin: str = "") -> list[Value]:
    """Return D before each move and the pixel after it, in turn, by the rule of a twin from the right state."""
    drawn = draw_lines(segment_ends(pixel_segments([ends], TALL)), *TALL, LECTURE.line)
    (x0, y0), (x1, y1) = ends
    dx, dy = x1 - x0, y1 - y0
    values: list[Value] = []
    following = dy - dx if twin == "start-not-doubled" else 2 * dy - dx
    for number, (D, (column, row)) in enumerate(
        zip(drawn.steps.decision, drawn.pixels.tolist(), strict=True)
    ):
        if number:
            steps_at_tie = twin == "ties-step" and D == 0
            values += [Fraction(following), (column, row + steps_at_tie)]
            is_lowered = D > 0 and twin != "not-corrected"
            following = int(D) + 2 * dy - (2 * dx if is_lowered else 0)
    return values


@template("bresenham-steps", 1, "Be the rasterizer: Bresenham", "raster", 6)
def draw_line(draws: Draws) -> Draft:
    """Bresenham's D and pixels in turn."""
    dx = draws.whole(5, 7)
    x0, y0 = draws.whole(0, 3), draws.whole(0, 2)
    ends = (x0, y0), (x0 + dx, y0 + draws.whole(1, dx - 1))
    steps = []
    for number, value in enumerate(line_values(ends)):
        move = number // 2 + 1
        if number % 2 == 0:
            steps.append(Entry(f"D before move {move}", "number", value))
        else:
            steps.append(Entry(f"the pixel after move {move}", "pixel", value))
    wrong = {
        name: first_tries(line_values(ends, name), steps)
        for name in ("ties-step", "not-corrected", "start-not-doubled")
    }
    (x1, y1) = ends[1]
    asked = f"""Be the rasterizer: give D before each move, then the pixel that is drawn next. {RULE}
        Hint: One step at a time: first D, then the pixel that it chooses.
        Hint: D above 0 steps up; D of 0 or below stays in the row.
        Hint: dx = {x1} - {x0}, dy = {y1} - {y0}."""
    given = f"From pixel {ends[0]}, which is drawn, to pixel {ends[1]}."
    answer = StepsAnswer(tuple(steps), SIZE)
    return drafted(asked, given, answer, wrong, pixel_segments([ends], SIZE), LECTURE)


VERDICTS = ("passes", "fails")
FRAGMENT_COUNT = 8


def depth_verdicts(fragments: list[tuple[int, int]], twin: str = "") -> list[Value]:
    """Return for each fragment whether it passes (0) or fails (1), by the rule of a twin from the right state."""
    stored: dict[int, int] = {}
    verdicts: list[Value] = []
    for pixel, z in fragments:
        held = stored.get(pixel)
        is_nearer = held is None or z < held
        passes = {"farther-wins": held is None or not is_nearer, "no-depth-test": True}.get(twin, is_nearer)
        verdicts.append(int(not passes))
        stored[pixel] = z if is_nearer else stored[pixel]
    return verdicts


@template("depth-test-steps", 1, "Be the depth test", "depth", 4)
def draw_depth(draws: Draws) -> Draft:
    """The depth test of fragments."""
    fragments = [(draws.whole(0, FRAGMENT_PIXELS - 1), draws.whole(10, 99)) for _ in range(FRAGMENT_COUNT)]
    reject(len({z for _, z in fragments}) < FRAGMENT_COUNT)
    right = depth_verdicts(fragments)
    reject(not 3 <= sum(right) <= 5)
    steps = tuple(
        Entry(f"fragment {k}: pixel {pixel}, z = {z}", "choice", verdict, VERDICTS)
        for k, ((pixel, z), verdict) in enumerate(zip(fragments, right, strict=True))
    )
    wrong = {
        name: first_tries(depth_verdicts(fragments, name), steps)
        for name in ("farther-wins", "no-depth-test")
    }
    asked = f"""Be the depth test: does each fragment pass? Smaller is nearer, the buffer begins at infinity,
        and a tie keeps what is there.
        Hint: The first fragment of every pixel passes.
        Hint: A fragment passes only where its z is smaller than what its pixel holds.
        Hint: {again_text(fragments)}"""
    return drafted(asked, "", StepsAnswer(steps), wrong, card_scene(fragments))


OUTPUTS = ("nothing", "the crossing", "the end", "the crossing, then the end")
BORDER = 8


def side_output(start_is_in: bool, end_is_in: bool) -> int:
    """Return which of ``OUTPUTS`` a side puts out."""
    return 2 * end_is_in + (start_is_in != end_is_in)


@template("clip-side-steps", 1, "Be Sutherland-Hodgman", "clip", 4)
def draw_clip(draws: Draws) -> Draft:
    """A triangle that the right border cuts, side by side."""
    corners = [(Fraction(draws.whole(1, 14)), Fraction(draws.whole(0, 8))) for _ in range(3)]
    inside = [x <= BORDER for x, _ in corners]
    reject(twice_area(corners) < 12 or sum(inside) not in (1, 2) or any(x == BORDER for x, _ in corners))
    steps: list[Entry] = []
    for k, ((x0, y0), (x1, y1)) in enumerate(zip(corners, [*corners[1:], corners[0]], strict=True)):
        output = side_output(inside[k], inside[(k + 1) % 3])
        steps.append(Entry(f"side {k}: what is put out", "choice", output, OUTPUTS))
        if inside[k] != inside[(k + 1) % 3]:
            y = y0 + (BORDER - x0) * (y1 - y0) / (x1 - x0)
            steps.append(
                Entry(f"side {k}: the crossing (x, y)", "place", (Fraction(BORDER), y), tolerance=0.05)
            )
    names = ("side 0 from corner 0 to 1", "side 1 from corner 1 to 2", "side 2 from corner 2 to 0")
    given = f"Corners 0, 1, 2: {corner_text(corners)}; {', '.join(names)}."
    cut = next(k for k in range(3) if inside[k] != inside[(k + 1) % 3])
    (x0, y0), (x1, y1) = corners[cut], corners[(cut + 1) % 3]
    asked = f"""Be Sutherland-Hodgman at the border x = {BORDER}: inside is where x is smaller. For each side
        from its start to its end, say what is put out, and where the side crosses the border. Fractions, or
        decimals within 0.05.
        Hint: Only two things matter: is the start inside, and is the end?
        Hint: A side that ends inside puts out its end; a side that changes sides puts out its crossing first.
        Hint: Side {cut} crosses the border at y = {y0} + ({BORDER} - {x0}) ({y1} - {y0}) / ({x1} - {x0})."""
    return drafted(asked, given, StepsAnswer(tuple(steps), (12, 9)))
