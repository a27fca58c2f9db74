"""Depth and visibility: what a buffer stores, which surface is seen."""

from fractions import Fraction
from math import inf, isinf

import numpy as np

from core import Settings, render
from core.depth.formats import unsigned_depth
from core.depth.whole_depths import table_scene
from core.records.arrays import Floats
from core.records.depth_table import DepthTable, text_of_depths
from core.scene import ClipScene
from lessons.exercises.answers.choices import OrderAnswer
from lessons.exercises.answers.fields import Column, Rows, TableAnswer, empty_rows, followed
from lessons.exercises.drafting import by_rule, drafted, listed, numbers, one_of, place_text, several, table
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.fragments import follow_buffer
from lessons.mistakes.depths import cards
from lessons.mistakes.shelf import RULES, SHELF

NAMES = tuple("ABCD")


@template("window-depth", 1, "Window depth at a distance", "depth", 2)
def draw_window_depth(draws: Draws) -> Draft:
    """Window depth at a distance."""
    near, far = draws.whole(1, 2), draws.item((5, 9, 10, 20))
    distance = draws.whole(near + 1, far - 1)
    given = f"n = {near}, f = {far}, d = {distance}"
    asked = f"""What is the window depth, from 0 at the near plane to 1 at the far plane, of a surface at this
        distance? Perspective: z = f (d - n) / (d (f - n)).
        Hint: Is depth linear in the distance?
        Hint: It is linear in 1/d: 0 at n, 1 at f.
        Hint: z = {far} ({distance} - {near}) / ({distance} ({far} - {near}))."""
    return by_rule(asked, given, (near, far, distance), ("depth-linear", "near-plane-tiny"))


@template("depth-steps", 1, "A depth buffer of 16 bits", "depth", 2)
def draw_steps(draws: Draws) -> Draft:
    """Whole steps of a 16-bit buffer between two surfaces."""
    near, far = 1, draws.item((100, 1000))
    distance = draws.whole(10, 90)
    depths = [RULES["depth-linear"].right(near, far, d)[0] for d in (distance, distance + 1)]
    right = [Fraction(unsigned_depth(float(z), 2**16 - 1)) for z in depths]
    linear = [RULES["depth-linear"].wrong(near, far, d)[0] for d in (distance, distance + 1)]
    wrong = [Fraction(unsigned_depth(float(z), 2**16 - 1)) for z in linear]
    given = f"n = {near}, f = {far}\nDistances: {distance} and {distance + 1}"
    asked = f"""A depth buffer of 16 bits stores round(65535 z) of the window depth z = f (d - n) / (d (f -
        n)). Which two whole numbers does it store for surfaces at these distances?
        Hint: Find z of both.
        Hint: Multiply by 65535 and round.
        Hint: Equal numbers would fight.
        Hint: The first: 65535 * {far} ({distance} - {near}) / ({distance} ({far} - {near}))."""
    return numbers(asked, given, right, {"depth-linear": wrong}, ("first", "second"))


@template("fighting-pairs", 1, "Surfaces that fight", "depth", 3)
def draw_fighting(draws: Draws) -> Draft:
    """Pairs of surfaces that a 16-bit buffer cannot tell apart."""
    near, far = 1, 1000
    gap = Fraction(draws.item((1, 2, 5)), 10)
    distances = sorted({draws.whole(2, 60) for _ in range(4)} | {draws.whole(300, 900)})[-4:]
    reject(len(distances) < 4)
    depth = RULES["depth-linear"].right
    stored = [
        [unsigned_depth(float(depth(near, far, d + shift)[0]), 2**16 - 1) for shift in (0, gap)]
        for d in distances
    ]
    right = [k for k, (first, second) in enumerate(stored) if first == second]
    pairs = [f"{d} and {number_text(d + gap)}" for d in distances]
    asked = f"""Which pairs of surfaces does a depth buffer of 16 bits store as equal? It stores round(65535
        z) of the window depth z = f (d - n) / (d (f - n)).
        Hint: Where are the steps of depth widest?
        Hint: z changes by about f n gap / (d d (f - n)).
        Hint: It is less than one of 65535 steps where d d is larger than about 65535 * {near} *
        {number_text(gap)}."""
    return several(asked, f"n = {near}, f = {far}", pairs, right)


@template("inverse-w-table", 2, "A buffer of 1/w", "depth", 4)
def draw_inverse(draws: Draws) -> Draft:
    """A buffer of 1/w, fragment by fragment."""
    fragments = [(draws.whole(0, 1), Fraction(1, draws.whole(2, 20))) for _ in range(6)]
    reject(len(set(fragments)) < len(fragments))
    asked = f"""These fragments are drawn in order. What does the buffer hold at the pixel of each right after
        it was tested? It stores 1/w, begins at 0, and keeps the larger value.
        Hint: Is a surface with a larger 1/w nearer or farther?
        Hint: Follow one pixel at a time.
        Hint: The first fragment leaves 1/{1 / fragments[0][1]} at its pixel: only a larger 1/w replaces it
        there."""
    labels = [f"pixel {pixel}, w = {1 / value}" for pixel, value in fragments]
    follow, farther = (follow_buffer(fragments, nearer) for nearer in (max, min))
    right, wins = (followed(each, empty_rows(len(fragments), 1)) for each in (follow, farther))
    wrong = {"farther-wins": wins, "no-depth-test": [[value] for _, value in fragments]}
    settings = Settings(depth="inverse-w")
    # 1/19 and 1/20 are 0.0026 apart.
    return table(asked, "", ("1/w",), labels, right, wrong, follow, None, settings, None, 0.001)


GRID = 4


@template("z-buffer-grid", 1, "A z-buffer of whole numbers", "depth", 4)
def draw_grid(draws: Draws) -> Draft:
    """A z-buffer of whole numbers, cell by cell."""
    empty = float("nan")
    first = [[float(draws.whole(3, 6)) if i + j < GRID else empty for i in range(GRID)] for j in range(GRID)]
    second = [[float(draws.whole(1, 9)) if i >= j else empty for i in range(GRID)] for j in range(GRID)]
    both = np.array([first, second])
    scene = table_scene(DepthTable(both, np.ones((2, 4))))
    drawn = ~np.isnan(both)

    def cells(found: Floats) -> Rows:
        rows = [[inf if isinf(z) else Fraction(z) for z in row] for row in found.tolist()]
        return tuple(tuple(row) for row in rows[::-1])

    last = np.where(drawn[1], both[1], np.where(drawn[0], both[0], inf))
    farthest = np.where(drawn.any(axis=0), np.where(drawn, both, -inf).max(axis=0), inf)
    right = np.where(drawn, both, inf).min(axis=0)
    wrong = {"no-depth-test": cells(last), "farther-wins": cells(farthest)}
    columns = tuple(Column(f"column {i}") for i in range(GRID))
    labels = tuple(f"row {j}" for j in reversed(range(GRID)))
    grids = [text_of_depths(patch).replace("\t", "  ") for patch in both]
    given = f"First triangle, top row first (– where it has no fragment):\n{grids[0]}\nSecond triangle:\n{grids[1]}"
    row, column = np.argwhere(drawn.all(axis=0))[0].tolist()
    asked = f"""Two triangles of whole-number depths are drawn, one after the other. What does the z-buffer
        hold then? It begins with inf in every cell, smaller is nearer, and a tie keeps what is there. Write
        inf for infinity.
        Hint: Take one cell at a time.
        Hint: Where neither has a fragment, nothing changes.
        Hint: Row {row}, column {column}: which of {both[0, row, column]:g} and {both[1, row, column]:g}
        stays?"""
    return drafted(asked, given, TableAnswer(columns, labels, cells(right)), wrong, scene)


@template("painter-order", 1, "A painter's order", "depth", 2)
def draw_painter(draws: Draws) -> Draft:
    """An order by the farthest vertex."""
    depths = [tuple(draws.whole(1, 30) for _ in range(3)) for _ in NAMES]
    reject(len({max(d) for d in depths}) < 4 or len({sum(d) for d in depths}) < 4)
    rule = RULES["sorted-by-mean"]
    order = rule.right(depths)
    options = tuple(NAMES[k] for k in order)
    given = listed("{}: depths {}", NAMES, depths)
    asked = f"""In which order does a painter's algorithm paint these triangles, first to last, if it sorts by
        the farthest vertex?
        Hint: What is painted first is painted over.
        Hint: Only the largest depth of each counts here.
        Hint: The farthest vertex of A lies at max{place_text(depths[0])}; the farthest triangle is painted
        first."""
    wrong = {rule.name: tuple(order.index(k) for k in rule.wrong(depths))}
    return drafted(asked, given, OrderAnswer(options, draws.shuffled(NAMES)), wrong)


def card_seen(scene: ClipScene, settings: Settings) -> int:
    """Return which card is seen, the number of cards where none is."""
    seen = int(render(scene, settings).primitive[0, 0])
    return seen if seen >= 0 else len(scene.clip)


CARDS = ("red", "blue", "green", "the background")


@template("equal-depths", 1, "Cards at equal depths", "depth", 1)
def draw_ties(draws: Draws) -> Draft:
    """Cards at equal depths."""
    first, second = Fraction(draws.whole(1, 4), 8), Fraction(draws.whole(5, 7), 8)
    depths = draws.shuffled((first, first, second))
    scene = cards(*([float(d)] * 3 for d in depths))
    names = ("last-wins-ties", "farther-wins", "cleared-to-near")
    right, settings = card_seen(scene, Settings()), Settings()
    wrong = {}
    for name in names:
        twin = SHELF[name]
        seen = card_seen(twin.change_scene(scene), twin.change_settings(settings))
        if seen != right:
            wrong[name] = seen
    given = listed("{}: z = {}", CARDS, depths)
    asked = f"""Three cards cover the window, drawn in this order. Which one is seen? The smaller depth is
        nearer, a tie keeps what is there.
        Hint: Which depth is the smallest?
        Hint: Of two equal ones, which is tested against the other?
        Hint: The nearest is at {number_text(first)}: does a fragment pass against the same depth?"""
    return one_of(asked, given, CARDS, right, wrong, scene)
