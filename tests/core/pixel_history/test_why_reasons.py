"""Every reason for which a triangle has no fragment at a pixel, on the smallest case that has it."""

import numpy as np
import pytest

from core import ClipScene, Settings
from core.pixel_history import PixelHistory, why
from core.pixel_history.events import LISTED_LIMIT
from core.trace.source import TraceSource
from tests.core.strategies import clip_of_window

SIZE = (16, 12)


def window_scene(*triangles: list[tuple[float, float]], z=0.0, w=1.0, colors=None) -> ClipScene:
    return ClipScene(clip_of_window(triangles, SIZE, w, z), colors, SIZE)


def ask(scene: ClipScene, column: int, row: int, triangle: int | None = None, **choice) -> PixelHistory:
    return why(TraceSource(scene, Settings(**choice)), column, row, triangle)


LOWER_LEFT = [(2, 2), (10, 2), (2, 10)]


@pytest.mark.parametrize("fill", ["bounding-box", "brute-force", "scanline"])
def test_missed_by_a_distance(fill):
    history = ask(window_scene(LOWER_LEFT), 7, 6, fill=fill)
    assert history.verdict.key == "all-missed"
    link = history.verdict.values["reason"]
    assert (link.stage, link.key) == ("raster", "missed-edge")
    # The side x + y = 12 lies opposite corner 0; the centre is (7.5, 6.5).
    assert link.values["edge"] == 0
    assert link.values["distance"] == pytest.approx(-2 / np.sqrt(2), rel=1e-15)
    assert link.values["subpixels"] == 256 * link.values["distance"]
    assert link.values["is_exact"]
    assert link.values["value"] == -16
    if fill == "scanline":
        assert (link.values["start"], link.values["stop"]) == (2, 5)


def test_a_tie_that_is_not_owned():
    history = ask(window_scene(LOWER_LEFT), 5, 6, fill="bounding-box", triangle=0)
    reason = history.verdict.values["reason"]
    assert (history.verdict.key, reason.key) == ("triangle-absent", "tie-not-owned")
    assert reason.values["edge"] == 0
    assert reason.values["distance"] == reason.values["ulps"] == 0
    owner = ask(window_scene([(11, 2), (11, 11), (2, 11)]), 7, 5, fill="bounding-box")
    assert owner.fragments[0].link("raster").key == "covered-on-edge"


def test_outside_a_block():
    history = ask(window_scene([(0, 0), (15, 0), (0, 11)]), 13, 10, fill="blocks", block_size=4)
    link = history.events[2].reason
    assert (link.stage, link.key) == ("bin", "outside-block")
    assert link.values["block"] == (3, 2)
    assert link.values["rejected_by"] == link.values["edge"] == 0
    assert link.values["high"][0] < 0
    assert link.values["distance"] < 0


def test_inside_a_block():
    history = ask(window_scene([(-40, -40), (60, -40), (0, 60)]), 5, 5, fill="hierarchy", block_size=2)
    event = history.fragments[0]
    assert (event.link("bin").key, event.link("raster").key) == ("inside-block", "accepted")
    assert event.link("bin").values["block_size"] == 8


def test_outside_its_box_is_only_counted_unless_asked_for():
    scene = window_scene(LOWER_LEFT)
    history = ask(scene, 14, 10)
    assert history.verdict.key == "nothing-near"
    assert history.counts == {"outside-box": 1}
    assert len(history.events) == 2
    asked = ask(scene, 14, 10, 0)
    reason = asked.verdict.values["reason"]
    assert (reason.stage, reason.key) == ("bin", "outside-box")
    assert reason.values["box"] == (2, 2, 10, 10)
    assert reason.values["distance"] == pytest.approx(-(14.5 + 10.5 - 12) / np.sqrt(2))
    assert asked.counts == {}


def test_culled_faces_say_whether_they_would_have_been_here():
    scene = window_scene(LOWER_LEFT, LOWER_LEFT[::-1])
    for cull, triangle, key in (("back", 1, "back-facing"), ("front", 0, "front-facing")):
        inside, beside = (ask(scene, *pixel, cull=cull) for pixel in ((3, 3), (8, 8)))
        for history, would in ((inside, True), (beside, False)):
            event = next(e for e in history.events if e.kind == "culled")
            assert (event.triangle, event.reason.key) == (triangle, key)
            assert event.reason.values["would_cover"] is would
    alone = ask(window_scene(LOWER_LEFT[::-1]), 3, 3, cull="back")
    assert alone.verdict.key == "all-rejected"
    assert ask(scene, 15, 11, cull="back").counts == {"back-facing": 1, "outside-box": 1}


def test_degenerate_behind_the_eye_and_outside():
    clip = clip_of_window(
        [[(1, 1), (5, 5), (9, 9)], LOWER_LEFT, [(20, 2), (30, 2), (20, 9)], LOWER_LEFT], SIZE
    )
    clip[1] *= -1
    clip[3, :, 2] = 3
    scene = ClipScene(clip, size=SIZE)
    history = ask(scene, 4, 4)
    reasons = {event.triangle: event.reason for event in history.events[2:]}
    assert {triangle: reason.key for triangle, reason in reasons.items()} == {
        0: "degenerate",
        3: "outside-plane",
    }
    assert reasons[3].values["plane"] == "far"
    assert reasons[3].values["would_cover"]
    assert history.counts == {"behind-eye": 1, "outside-plane": 1}
    behind = ask(scene, 4, 4, 1)
    assert behind.verdict.values["reason"].key == "behind-eye"
    assert behind.events[3].link("transform").values["behind"] == (0, 1, 2)


def test_clipped_to_a_quad():
    clip = [[[-0.9, -0.9, 0, 1], [0.9, -0.9, 0, 1], [0, 0.5, -2, 1]]]
    history = ask(ClipScene(clip, size=SIZE), 8, 1, clipping="sutherland-hodgman")
    link = history.fragments[0].link("clip")
    assert link.key == "clipped"
    assert link.values["outside"] == (("near", (2,)),)
    assert (link.values["corner_count"], link.values["piece_count"]) == (4, 2)
    assert link.values["inserted_for"] == ""
    top = ask(ClipScene(clip, size=SIZE), 8, 8, 0, clipping="sutherland-hodgman")
    assert top.events[2].link("clip").key == "clipped"
    assert top.verdict.key == "triangle-absent"


def test_clipping_that_another_method_asked_for():
    clip = [[[-0.5, -0.5, 0, 1], [0.5, -0.5, 0, 1], [0, 0.9, 0, -1]]]
    history = ask(ClipScene(clip, size=SIZE), 8, 1, 0, interpolation="affine")
    assert history.events[2].link("clip").values["inserted_for"] == "affine"
    assert history.events[2].link("transform").key == "crosses-eye"
    assert history.events[2].link("transform").values["behind"] == (2,)


def test_clipped_away():
    # Outside of two planes, each corner inside of one of them.
    clip = [[[-3, 0.5, 0, 1], [-0.5, 3, 0, 1], [-3, 3, 0, 1.0]]]
    history = ask(ClipScene(clip, size=SIZE), 1, 10, 0, clipping="sutherland-hodgman")
    event = history.events[2]
    assert (event.kind, event.reason.stage, event.reason.key) == ("clipped", "clip", "clipped-away")
    assert event.reason.values["piece_count"] == 0
    assert not event.reason.values["would_cover"]
    assert ask(ClipScene(clip, size=SIZE), 9, 3, clipping="sutherland-hodgman").counts == {"clipped-away": 1}


@pytest.mark.parametrize("clipping", ["after-divide", "project-first"])
def test_divided_before_it_is_clipped(clipping):
    clip = np.array([[[-0.5, -0.5, 0, 1], [0.5, -0.5, 0, 1], [0, 0.9, 0, -1.0]]])
    link = ask(ClipScene(clip, size=SIZE), 8, 1, 0, clipping=clipping).events[2].link("clip")
    assert (link.key, link.values["division"]) == ("clipped", "mirrored")
    clip[0, 2, 3] = 0
    link = ask(ClipScene(clip, size=SIZE), 8, 1, 0, clipping=clipping).events[2].link("clip")
    assert (link.key, link.values["division"]) == ("clipped-away", "undefined")


def test_through_the_eye_there_is_no_box():
    clip = [[[-0.5, -0.5, 0, 1], [0.5, -0.5, 0, 1], [0, 0.9, 0, -1]]]
    history = ask(ClipScene(clip, size=SIZE), 8, 8, fill="bounding-box")
    assert history.events[2].link("bin").key == "whole-image"


def test_no_area_after_snapping():
    # A triangle 1/2000 pixel high faces the eye, but its snapped corners are in a line.
    scene = window_scene([(2, 5.5), (10, 5.5), (6, 5.5005)])
    history = ask(scene, 6, 5, 0)
    assert history.verdict.values["reason"].key == "degenerate"


@pytest.mark.parametrize(("depth", "key"), [(-0.25, "before-near"), (1.25, "behind-far")])
def test_out_of_depth_range(depth, key):
    # One corner in range, so that the triangle is not culled as a whole.
    z = [[2 * depth - 1, 2 * depth - 1, 0.0]]
    history = ask(window_scene([(0, 0), (16, 0), (8, 12)], z=z), 8, 0)
    event = history.fragments[0]
    assert event.is_rejected
    assert event.reason.key == key
    assert not 0 <= event.reason.values["depth"] <= 1
    assert history.cover_count == 0
    assert history.verdict.key == "all-rejected"


def test_depth_failed_tied_and_passed():
    colors = np.ones((4, 3, 4))
    z = np.array([[0.0] * 3, [0.5] * 3, [0.0] * 3, [-0.5] * 3])
    scene = window_scene(LOWER_LEFT, LOWER_LEFT, LOWER_LEFT, LOWER_LEFT, z=z, colors=colors)
    history = ask(scene, 3, 3)
    links = [event.link("depth") for event in history.fragments]
    assert [link.key for link in links] == ["passed", "failed", "tied", "passed"]
    assert [link.values["against"] for link in links] == [-1, 0, 0, 0]
    assert [event.reason.key for event in history.fragments] == ["overwritten", "failed", "tied", "written"]
    assert history.fragments[0].reason.values["by"] == 3
    assert history.verdict.key == "seen-over"
    assert (history.verdict.values["passed_count"], history.verdict.values["overwritten_count"]) == (2, 1)
    wanted = ["triangle-overwritten", "triangle-rejected", "triangle-rejected", "triangle-seen"]
    assert [ask(scene, 3, 3, k).verdict.key for k in range(4)] == wanted
    untested = ask(scene, 3, 3, visibility="last-drawn")
    assert [event.link("depth").key for event in untested.fragments] == ["not-tested"] * 4


def test_blended_until_something_opaque_lies_over_it():
    colors = np.ones((3, 3, 4))
    colors[:, :, 3] = np.array([0.5, 1, 0.25])[:, None]
    scene = window_scene(LOWER_LEFT, LOWER_LEFT, LOWER_LEFT, colors=colors)
    history = ask(scene, 3, 3, visibility="last-drawn", blend="over")
    assert [event.reason.key for event in history.fragments] == ["overwritten", "blended", "blended"]
    assert history.verdict.key == "blended"
    assert ask(scene, 3, 3, 1, visibility="last-drawn", blend="over").verdict.key == "triangle-blended"


def test_outside_a_printed_span_and_in_one_against_the_edges():
    scene = window_scene(LOWER_LEFT)
    beside = ask(scene, 8, 8, 0, fill="scanline-lecture")
    assert beside.verdict.values["reason"].key == "outside-span"
    values = beside.verdict.values["reason"].values
    assert values["stop"] <= 8
    # Rounded up, corner 2 gets a row of its own above the triangle.
    wrong = ask(scene, 2, 10, fill="scanline-lecture")
    event = wrong.fragments[0]
    assert event.link("raster").key == "accepted"
    assert not event.link("raster").values["inside"].all()
    level = ask(window_scene([(2, 2), (6, 8), (10, 2)]), 6, 3, 0, fill="scanline-lecture")
    assert level.verdict.values["reason"].key == "row-not-drawn"


def test_an_outline_and_beside_it():
    scene = window_scene(LOWER_LEFT)
    history = ask(scene, 6, 6, polygon_mode="wireframe")
    event = history.fragments[0]
    assert event.link("raster").key == "on-outline"
    assert event.link("raster").values["edge"] == 0
    assert event.link("raster").values["distance"] <= 0.75
    reason = ask(scene, 4, 4, 0, polygon_mode="wireframe").verdict.values["reason"]
    assert reason.key == "off-outline"
    assert reason.values["edge"] == 0
    assert reason.values["distance"] == pytest.approx(-3 / np.sqrt(2))
    beyond = ask(scene, 14, 2, 0, polygon_mode="wireframe").verdict.values["reason"]
    assert beyond.values["distance"] == pytest.approx(-np.hypot(4.5, 0.5))


def test_a_triangle_in_front_is_not_clipped_for_one_that_crosses_the_eye():
    crosses = [[-0.5, -0.5, 0, 1], [0.5, -0.5, 0, 1], [0, 0.9, 0, -1]]
    in_front = [[-0.5, -0.5, -2, 1], [0.5, -0.5, 0, 1], [0, 0.9, 0, 1]]
    history = ask(ClipScene([crosses, in_front], size=SIZE), 9, 4, 1, interpolation="affine")
    event = next(event for event in history.events if event.triangle == 1)
    assert event.link("clip").key == "no-clipping"


def test_an_unsnapped_edge_has_ulps():
    scene = window_scene([(0.1, 0.1), (12.3, 0.7), (3.3, 9.9)], w=[[1.0, 1.7, 2.9]])
    reason = ask(scene, 11, 8, 0, coverage="float64", fill="bounding-box").verdict.values["reason"]
    assert reason.key == "missed-edge"
    assert not reason.values["is_exact"]
    edge = reason.values["edge"]
    assert reason.values["ulps"] == reason.values["values"][edge] / np.spacing(
        _largest_term(scene, edge, 11.5, 8.5)
    )


def _largest_term(scene: ClipScene, edge: int, x: float, y: float) -> float:
    edges = TraceSource(scene, Settings(coverage="float64")).geometry.edges
    return max(abs(edges.a[0, edge] * x), abs(edges.b[0, edge] * y), abs(edges.c[0, edge]))


def test_many_triangles_around_a_pixel_are_listed_up_to_a_limit():
    steps = np.linspace(0, 3, 1000)
    triangles = [[(0, 0), (16, 0 + s), (16, 12)] for s in steps]
    scene = window_scene(*triangles)
    history = ask(scene, 2, 9, fill="bounding-box")
    missed = [event for event in history.events if event.kind == "missed"]
    assert len(missed) == LISTED_LIMIT
    assert history.counts == {"missed": 1000 - LISTED_LIMIT}
    asked = ask(scene, 2, 9, 999, fill="bounding-box")
    assert 999 in [event.triangle for event in asked.events]


def test_drawing_order_with_culled_triangles_among_the_others():
    scene = window_scene(LOWER_LEFT, LOWER_LEFT[::-1], LOWER_LEFT)
    history = ask(scene, 3, 3, cull="back")
    assert [event.triangle for event in history.events] == [-1, -1, 0, 1, 2]
    z = np.array([[-0.5] * 3, [0.0] * 3, [0.5] * 3])
    painted = ask(
        window_scene(LOWER_LEFT, LOWER_LEFT[::-1], LOWER_LEFT, z=z), 3, 3, cull="back", visibility="painters"
    )
    assert [event.triangle for event in painted.events] == [-1, -1, 1, 2, 0]


@pytest.mark.parametrize(
    ("pixel", "triangle", "message"),
    [
        ((16, 0), None, r"pixel must be inside the 16x12 image, got \(16, 0\)"),
        ((0, -1), None, "pixel must be inside"),
        ((0, 0), 1, "triangle must be 0 to 0, got 1"),
        ((0, 0), -1, "triangle must be 0 to 0, got -1"),
    ],
)
def test_errors(pixel, triangle, message):
    with pytest.raises(ValueError, match=message):
        ask(window_scene(LOWER_LEFT), *pixel, triangle)


def test_an_empty_scene():
    history = ask(ClipScene(np.empty((0, 3, 4)), size=SIZE), 0, 0)
    assert history.verdict.key == "nothing-near"
    assert history.final.triangle == -1
    assert history.counts == {}
