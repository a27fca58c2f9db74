"""Polygons: exact pixels by both rules, holes, crossings, and agreement of picture, trace, history and fast path."""

import re
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import STAGES, ClipScene, Settings, assemble, render, trace
from core.coverage.active_edges import fill_listing
from core.coverage.snapping import SUBPIXELS
from core.coverage.traced_polygons import ENTER, LEAVE
from core.explain.steps import account
from core.methods import table
from tests.core.agreement import Case, check_case
from tests.core.strategies import clip_of_window

SIZE = (16, 8)
"""Powers of two: the way to clip space and back is exact."""
SQUARE = [[1, 1], [13, 1], [13, 7], [1, 7]]
HOLE = [[4, 3], [9, 3], [9, 6], [4, 6]]
PENTAGRAM = [[8.0, 7.5], [4.5, 0.5], [13.25, 4.75], [2.75, 4.75], [11.5, 0.5]]
RULES = table.names("polygon_fill")
EIGHTHS = st.tuples(st.integers(-16, 150), st.integers(-16, 80)).map(
    lambda place: (place[0] / 8, place[1] / 8)
)
RINGS = st.lists(st.lists(EIGHTHS, min_size=3, max_size=6), min_size=1, max_size=3).filter(
    lambda rings: sum(map(len, rings)) > 3
)


def polygon(*rings, size=SIZE, **more) -> ClipScene:
    """Return the scene of one polygon with rings (K, 2) in the window."""
    corners = np.concatenate([np.asarray(ring, float) for ring in rings])
    starts = np.cumsum([0, *map(len, rings)])[:-1]
    color = np.tile([0.2, 0.6, 0.4, 1.0], (1, len(corners), 1))
    return ClipScene(clip_of_window(corners[None], size), color, size, kind="polygons", rings=starts, **more)


def drawn(scene: ClipScene, rule: str = "even-odd", **choices) -> list[str]:
    """Return the covered pixels, the top row first."""
    frame = render(scene, Settings(polygon_fill=rule, **choices))
    assert frame.cover_count.max() <= 1
    return ["".join(".#"[int(pixel >= 0)] for pixel in row) for row in frame.primitive[::-1]]


def exact_pixels(rings, rule, center=Fraction(1, 2)) -> list[str]:
    """Return the pixels whose centre, moved a little to the right and less up, is inside, by a ray to the left."""
    rows = []
    for row in range(SIZE[1] - 1, -1, -1):
        y, line = row + center, ""
        for column in range(SIZE[0]):
            x, count, winding = column + center, 0, 0
            for ring in rings:
                places = [
                    tuple(Fraction(round(part * SUBPIXELS), SUBPIXELS) for part in place) for place in ring
                ]
                for (x0, y0), (x1, y1) in zip(places, [*places[1:], places[0]], strict=True):
                    if (y0 <= y) != (y1 <= y) and x0 + (y - y0) * (x1 - x0) / (y1 - y0) <= x:
                        count, winding = count + 1, winding + (1 if y1 > y0 else -1)
            line += ".#"[count % 2 if rule == "even-odd" else winding != 0]
        rows.append(line)
    return rows


@given(rings=RINGS, rule=st.sampled_from(RULES))
def test_pixels_are_those_of_exact_arithmetic(rings, rule):
    assert drawn(polygon(*rings), rule, cull="none") == exact_pixels(rings, rule) or not any(
        (np.array(ring) != ring[0]).any() for ring in rings
    )


def test_a_hole_is_left_out_whichever_way_it_runs():
    wanted = [
        "................",
        ".############...",
        ".###.....####...",
        ".###.....####...",
        ".###.....####...",
        ".############...",
        ".############...",
        "................",
    ]
    assert drawn(polygon(SQUARE, HOLE)) == drawn(polygon(SQUARE, HOLE[::-1])) == wanted
    assert drawn(polygon(SQUARE, HOLE[::-1]), "non-zero") == wanted
    assert drawn(polygon(SQUARE, HOLE), "non-zero") == drawn(polygon(SQUARE))


def test_the_middle_of_a_pentagram_is_what_the_rules_differ_in():
    odd, wound = drawn(polygon(PENTAGRAM)), drawn(polygon(PENTAGRAM), "non-zero")
    assert odd != wound
    assert odd[4][8] == "."
    assert wound[4][8] == "#"


def test_a_ring_outside_of_the_outline_is_an_island():
    far = [[14, 2], [16, 2], [16, 6], [14, 6]]
    alone, together = drawn(polygon(SQUARE)), drawn(polygon(SQUARE, far))
    assert [line[:14] for line in together] == [line[:14] for line in alone]
    assert [line[14:] for line in together].count("##") == 4


@given(corners=st.lists(EIGHTHS, min_size=4, max_size=7))
def test_a_simple_polygon_has_the_pixels_of_its_triangles(corners):
    try:
        clip = clip_of_window(np.array(corners)[None], SIZE)[0]
        triangles = assemble("polygon", clip, size=SIZE)
    except ValueError:
        return
    assert np.array_equal(render(triangles).cover_count, render(polygon(corners)).cover_count)


def test_neighbours_share_no_pixel():
    left = [[0, 0], [6.5, 0], [6.5, 4.5], [3.5, 8], [0, 8]]
    right = [[6.5, 0], [16, 0], [16, 8], [3.5, 8], [6.5, 4.5]]
    corners = np.array([left, right])
    both = ClipScene(clip_of_window(corners, SIZE), np.ones((2, 5, 4)), SIZE, kind="polygons")
    assert (render(both).cover_count == 1).all()
    assert set(np.unique(render(both).primitive)) == {0, 1}


@pytest.mark.parametrize("rule", RULES)
def test_the_listing_fills_the_same_spans(rule):
    rings = [PENTAGRAM, [[6, 3], [7, 5.125], [10.875, 2]]]
    sides = [
        tuple(tuple(map(Fraction, place)) for place in side)
        for ring in rings
        for side in zip(ring, [*ring[1:], ring[0]], strict=True)
    ]
    inside = {
        "even-odd": lambda crossed, winding: crossed % 2 == 1,
        "non-zero": lambda crossed, winding: winding != 0,
    }
    rows = [["."] * SIZE[0] for _ in range(SIZE[1])]
    for row, start, stop in fill_listing(sides, range(SIZE[1]), Fraction(1, 2), inside[rule]):
        rows[row][start:stop] = "#" * (stop - start)
    assert ["".join(row) for row in rows[::-1]] == drawn(polygon(*rings), rule)


def test_an_edge_enters_and_leaves_the_active_edges_once():
    steps = trace(polygon(SQUARE, HOLE, PENTAGRAM)).stage("raster")
    kinds, edges = steps.steps.kind, steps.columns["edge"]
    assert len(set(edges[kinds == ENTER])) == np.count_nonzero(kinds == ENTER) > 0
    assert set(edges[kinds == LEAVE]) <= set(edges[kinds == ENTER])
    x, shift, before = (steps.columns[name] for name in ("crossing", "shift", "crossing_before"))
    moved = np.isfinite(before)
    assert moved.any()
    assert x[moved] == pytest.approx(before[moved] + shift[moved])


@pytest.mark.parametrize(
    "choices",
    [
        {},
        {"polygon_fill": "non-zero", "blend": "over", "pixel_center": "integer"},
        {"antialiasing": "msaa-4", "depth": "fixed-38"},
        {"antialiasing": "ssaa-4", "visibility": "painters"},
        {"antialiasing": "area", "cull": "back", "depth": "reversed-z", "visibility": "ray-casting"},
    ],
)
def test_picture_trace_history_and_fast_path_agree(choices):
    rings = np.array([[*SQUARE, *HOLE], [[0.5, 6], [15.5, 3], [15.5, 7], [3, -4], *reversed(SQUARE)]])
    clip = clip_of_window(rings, SIZE, np.array([[1.0], [2.0]]), np.array([[0.25], [-0.5]]))
    colors = np.array([[1.0, 0.5, 0.25, 0.5], [0.0, 0.5, 1.0, 1.0]])[:, None].repeat(8, axis=1)
    scene = ClipScene(clip, colors, SIZE, kind="polygons", rings=[0, 4])
    check_case(Case(scene, Settings(**choices), [(5, 4), (13, 2), (0, 7)]))


def test_every_stage_steps_and_says_why_it_has_nothing_to_do():
    run = trace(polygon(SQUARE, HOLE))
    counts = {stage: run.stage(stage).steps.row_count for stage in STAGES}
    assert counts["transform"] == 16
    assert counts["edges"] == counts["bin"] == 0
    assert counts["raster"] > counts["interpolate"] == 72 - 15


@pytest.mark.parametrize("rule", RULES)
def test_no_step_speaks_of_triangles(rule):
    said = []
    run = trace(polygon(SQUARE, HOLE[::-1], PENTAGRAM), Settings(polygon_fill=rule))
    for stage in STAGES:
        found = run.stage(stage)
        for position in range(1, min(found.steps.count, 400) + 1):
            explanation = found.explain(position)
            assert explanation is not None
            said.append(account(explanation, 0, None)[0])
    assert not [text for text in said if re.search("triangle|three", text, re.IGNORECASE)]


def test_a_polygon_that_cancels_is_drawn_and_one_without_area_is_not():
    bow = [[2, 1], [6, 5], [6, 1], [2, 5]]
    assert "#" in "".join(drawn(polygon(bow)))
    assert "#" not in "".join(drawn(polygon([[1, 1], [5, 5], [3, 3], [7, 7]])))


@pytest.mark.parametrize("flat", [[[2, 2], [9, 5], [9, 5]], [[2, 2]] * 3, [[2, 2], [5, 2], [9, 2], [3, 2]]])
def test_a_ring_on_one_line_draws_nothing_and_is_named(flat):
    scene = polygon(SQUARE, flat)
    assert drawn(scene) == drawn(polygon(SQUARE))
    stage = trace(scene).stage("cull")
    text, _ = account(stage.explain(stage.steps.count), 0, None)
    assert text.endswith("Ring 1 lies on one line: it encloses nothing.")
    assert render(polygon(flat + flat[-1:])).primitive.max() == -1


def test_a_polygon_of_the_other_side_is_culled_by_all_its_rings():
    assert "#" not in "".join(drawn(polygon(SQUARE[::-1], HOLE), cull="back"))
    assert "#" in "".join(drawn(polygon(SQUARE[::-1], HOLE), cull="front"))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rings": [0, 2]}, "ring 0 must have at least 3 corners, got 2"),
        ({"rings": [0, 6]}, "ring 1 must have at least 3 corners, got 2"),
        ({"rings": [1]}, "rings must begin with corner 0, got [1]"),
        ({"region_rings": [0]}, "region_rings need a clip_region"),
        ({"clip": np.ones((1, 3, 4)), "attributes": None}, "a polygon must have 4 to 1000 corners"),
        ({"kind": "points"}, "clip must be (T, 1, 4)"),
        ({"clip_region": [0, 0, 0, 1]}, "the clip window must have an area"),
    ],
)
def test_what_is_no_polygon_is_refused(change, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        replace(polygon(SQUARE, HOLE), **change)


def test_corners_without_a_place_are_refused():
    scene = polygon(SQUARE, HOLE)
    for w, message in ((-1.0, "all w above 0"), (1 / 64, "within 8 times half the raster")):
        clip = scene.clip.copy()
        clip[0, 3, 3] = w
        with pytest.raises(ValueError, match=message):
            replace(scene, clip=clip)
