"""Polygons clipped by Weiler-Atherton and Sutherland-Hodgman: areas against shapely, touching cases, refusals."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from core import ClipScene, Settings, render, trace
from core.clipping.rings import clip_side_listing, meeting_sides, sutherland_hodgman, whole_rings
from core.clipping.weiler_atherton import weiler_atherton
from core.coverage.measured_exactly import exact_cover
from core.methods import table
from core.records.clip_region import region_of_window
from core.records.primitives import Rings, join_rings
from lessons.scenes import make_scene
from tests.core.agreement import Case, check_case
from tests.core.strategies import clip_of_window

SQUARE = [[2, 2], [8, 2], [8, 8], [2, 8]]
HOLE = [[4, 4], [6, 4], [6, 6], [4, 6]]
COMB = [[1, 1], [9, 1], [9, 9], [7, 9], [7, 3], [3, 3], [3, 9], [1, 9]]


def rings_of(*rings):
    return [np.array(ring, float) for ring in rings]


def meeting(rings) -> str:
    """Return which sides meet."""
    return meeting_sides(whole_rings([rings])[0][0], "polygon")


def signed(rings) -> float:
    """Return the area inside rings, of which holes run the other way."""
    return float(join_rings([rings]).areas.sum()) if rings else 0.0


def area_of(rings) -> shapely.Geometry:
    """Return rings as shapely has them, by the even-odd rule."""
    found = shapely.Polygon()
    for ring in rings:
        found = found.symmetric_difference(shapely.Polygon(ring))
    return found


def star(generator, count, low, high, middle, steps):
    """Return a ring around a place; on a grid of 1/steps where that is given."""
    angle, radius = np.sort(generator.uniform(0, 2 * np.pi, count)), generator.uniform(low, high, count)
    ring = middle + radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return np.round(ring * steps) / steps if steps else ring


def random_polygon(generator, steps):
    """Return an outline and, mostly, a hole."""
    middle = generator.uniform(6, 10, 2)
    rings = [star(generator, int(generator.integers(3, 9)), 4, 7, middle, steps)]
    if generator.random() < 0.7:
        rings.append(star(generator, int(generator.integers(3, 6)), 1, 3, middle, steps))
    return rings


def check_areas(seeds) -> int:
    """Compare areas with shapely's, also of polygons on a coarse grid, which touch often; return how many."""
    compared = 0
    for seed in seeds:
        generator = np.random.default_rng(seed)
        polygon, region = (random_polygon(generator, (None, 1, 2)[seed % 3]) for _ in range(2))
        if meeting(polygon) or meeting(region):
            continue
        left = weiler_atherton(polygon, region).rings
        compared += 1
        wanted = area_of(polygon).intersection(area_of(region))
        assert signed(left) == pytest.approx(wanted.area, abs=1e-9), seed
        # Of a ring that touches itself shapely computes no differences.
        if all(shapely.Polygon(ring).is_valid for ring in left):
            assert area_of(left).symmetric_difference(wanted).area < 1e-9, seed
    return compared


def test_areas_are_those_of_shapely():
    assert check_areas(range(120)) > 40


@pytest.mark.slow
def test_many_areas_are_those_of_shapely():
    assert check_areas(range(120, 6000)) > 2500


@pytest.mark.parametrize(
    ("polygon", "region", "area", "count"),
    [
        pytest.param([SQUARE], [SQUARE], 36, 1, id="equal"),
        pytest.param([SQUARE[::-1]], [SQUARE], 36, 1, id="wound the other way"),
        pytest.param([HOLE], [SQUARE], 4, 1, id="inside"),
        pytest.param([SQUARE], [HOLE[::-1]], 4, 1, id="around"),
        pytest.param([SQUARE, HOLE], [HOLE], 0, 0, id="the hole itself"),
        pytest.param([SQUARE, HOLE], [SQUARE, HOLE[::-1]], 32, 2, id="equal, with holes"),
        pytest.param([SQUARE], [[[8, 2], [12, 2], [12, 8], [8, 8]]], 0, 0, id="a common side, beside it"),
        pytest.param([SQUARE], [[[8, 8], [12, 8], [12, 12], [8, 12]]], 0, 0, id="a common corner"),
        pytest.param([SQUARE], [[[2, 2], [5, 2], [5, 8], [2, 8]]], 18, 1, id="common sides, inside it"),
        pytest.param([SQUARE], [[[5, 2], [8, 5], [5, 8], [2, 5]]], 18, 1, id="corners on sides"),
        pytest.param([SQUARE], [[[0, 0], [10, 10], [10, 0]]], 18, 1, id="a side through corners"),
        pytest.param([SQUARE], [[[20, 20], [30, 20], [30, 30]]], 0, 0, id="nowhere"),
        pytest.param(
            [SQUARE, [[9, 9], [12, 9], [12, 12]]],
            [[[0, 0], [20, 0], [20, 20], [0, 20]]],
            40.5,
            2,
            id="island",
        ),
        pytest.param([COMB], [[[0, 5], [10, 5], [10, 10], [0, 10]]], 16, 2, id="falls apart"),
        pytest.param(
            [[[2, 2], [5, 2], [5, 2], [8, 2], [8, 8], [2, 8]]], [SQUARE], 36, 1, id="equal corners in turn"
        ),
    ],
)
def test_touching_polygons(polygon, region, area, count):
    left = weiler_atherton(rings_of(*polygon), rings_of(*region)).rings
    assert (signed(left), len(left)) == (area, count)


@pytest.mark.parametrize(
    ("rings", "message"),
    [
        ([[[2, 2], [8, 8], [8, 2], [2, 8]]], "side 0 of ring 0 of the polygon meets side 2 of ring 0"),
        ([SQUARE, [[6, 4], [12, 4], [12, 6]]], "side 1 of ring 0 of the polygon meets side 0 of ring 1"),
        ([SQUARE, [[8, 2], [8, 8], [12, 5]]], "side 0 of ring 0 of the polygon meets side 0 of ring 1"),
        (
            [[[5, 7], [5, 6], [7, 7], [7, 8], [8, 7]]],
            "side 1 of ring 0 of the polygon meets side 4 of ring 0",
        ),
    ],
)
def test_rings_that_cross_or_touch_are_found(rings, message):
    assert meeting(rings_of(*rings)) == message


def test_a_window_without_area_is_refused():
    region = region_of_window(np.array([[3.0, 3], [7, 3], [5, 3]]), (12, 12))
    scene = replace(make_scene("weiler-atherton"), clip_region=region, region_rings=None)
    with pytest.raises(ValueError, match="side 0 of ring 0 of the clip window meets side 1 of ring 0"):
        render(scene, Settings(polygon_clipping="weiler-atherton"))


def test_the_comb_stays_joined_by_edges_of_sutherland_hodgman():
    window = rings_of([[0, 5], [10, 5], [10, 10], [0, 10]])
    joined = sutherland_hodgman(rings_of(COMB), window).rings
    apart = weiler_atherton(rings_of(COMB), window).rings
    assert (len(joined), len(apart)) == (1, 2)
    assert signed(joined) == signed(apart) == 16
    lengths = [
        sum(np.hypot(*(ring - np.roll(ring, 1, axis=0)).T).sum() for ring in rings)
        for rings in (joined, apart)
    ]
    # From tooth to tooth there and back, along the window's border.
    assert lengths == [24 + 2 * 4, 24]


@pytest.mark.parametrize("seed", range(6))
def test_both_leave_the_same_area_in_a_convex_window(seed):
    generator = np.random.default_rng(seed)
    polygon = [star(generator, 9, 2, 7, np.array([8, 8]), None)]
    window = rings_of([[3, 5], [11, 3], [13, 9], [6, 12]])
    both = [clip(polygon, window).rings for clip in (weiler_atherton, sutherland_hodgman)]
    assert signed(both[0]) == pytest.approx(abs(signed(both[1])))
    turned = sutherland_hodgman(polygon, [window[0][::-1]]).rings
    assert signed(turned) == pytest.approx(signed(both[1]))


@pytest.mark.parametrize(
    ("region", "message"),
    [
        ([COMB], "window must be convex and counter-clockwise, got corner"),
        ([SQUARE, HOLE], "sutherland-hodgman needs a convex clip window, got one with holes"),
        ([[[1, 1], [5, 5], [3, 3]]], "window must have an area"),
    ],
)
def test_sutherland_hodgman_refuses_what_is_not_convex(region, message):
    with pytest.raises(ValueError, match=message):
        sutherland_hodgman(rings_of(SQUARE), rings_of(*region))


def test_the_listing_of_a_side_cuts_a_square():
    left = clip_side_listing([(2, 2), (8, 2), (8, 8), (2, 8)], (5, 0), (5, 10))
    assert [tuple(map(float, place)) for place in left] == [(2, 2), (5, 2), (5, 8), (2, 8)]


@pytest.mark.parametrize("name", ["weiler-atherton", "connecting-edges"])
@pytest.mark.parametrize("clipper", table.names("polygon_clipping")[1:])
def test_pixels_are_those_of_what_is_left(name, clipper):
    scene = make_scene(name)
    if (name, clipper) == ("weiler-atherton", "sutherland-hodgman"):
        with pytest.raises(ValueError, match="needs a convex clip window"):
            render(scene, Settings(polygon_clipping=clipper))
        return
    settings = Settings(polygon_clipping=clipper)
    clip = trace(scene, settings).source.geometry.polygon_clip
    covered = render(scene, settings).primitive >= 0
    whole, region = clip.whole, join_rings([clip.region])
    wanted = exact_cover(whole, 0, scene.size, True) & exact_cover(region, 0, scene.size, True)
    # New corners are snapped: an edge may turn by 1/256 pixel.
    assert np.count_nonzero(covered != wanted) <= 2
    check_case(Case(scene, settings, [(12, 12), (25, 9), (0, 0)]))


def test_a_polygon_outside_of_its_window_is_gone():
    clip = clip_of_window(np.array([[*SQUARE, *HOLE]], float), (16, 16))
    scene = ClipScene(clip, size=(16, 16), kind="polygons", rings=[0, 4], clip_region=[0.5, 0.5, 0.9, 0.9])
    settings = Settings(polygon_clipping="weiler-atherton")
    assert (render(scene, settings).primitive < 0).all()
    check_case(Case(scene, settings, [(4, 4)]))


def test_the_walk_goes_from_crossing_to_crossing():
    steps = trace(make_scene("weiler-atherton"), Settings(polygon_clipping="weiler-atherton")).stage("clip")
    kinds = [steps.kind_of(row) for row in range(steps.steps.row_count)]
    assert kinds.count("wa-start") == kinds.count("wa-close") > 0
    entering = steps.columns["is_entering"][[kind == "wa-crossing" for kind in kinds]]
    assert entering.sum() * 2 == len(entering)
    switches = [row for row, kind in enumerate(kinds) if kind == "wa-switch"]
    assert [bool(entering[steps.columns["crossing"][row]]) for row in switches] == [
        bool(steps.columns["on_region"][row]) for row in switches
    ]


def test_rings_know_their_areas_and_sides():
    rings = Rings(np.array([*SQUARE, *HOLE[::-1]], float), np.array([0, 4, 8]), np.zeros(2, int))
    assert rings.areas.tolist() == [36, -4]
    assert rings.following.tolist() == [1, 2, 3, 0, 5, 6, 7, 4]
