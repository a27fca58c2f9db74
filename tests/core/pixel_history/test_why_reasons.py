"""What a history lists, counts and refuses, and how far a pixel is from an edge that is not snapped."""

import numpy as np
import pytest

from core import ClipScene, Settings
from core.pixel_history import why
from core.pixel_history.events import LISTED_LIMIT
from core.pixel_history.fragments import PixelHistory
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


def test_pieces_are_counted_as_they_are_drawn_and_a_division_mirrors_where_any_w_is_below_0():
    # One corner behind the eye: two pieces are left. Divided by w first, the part behind it is mirrored.
    clip = np.array([[[-0.9, -0.8, 0, 1], [0.9, -0.7, 0, 1], [0.1, 0.9, 0.2, -0.5]]])
    for clipping in ("sutherland-hodgman", "after-divide"):
        scene = ClipScene(clip, None, SIZE)
        source = TraceSource(scene, Settings(clipping=clipping, cull="none"))
        drawn = source.geometry.primitives.triangle
        frame = source.picture.primitive
        assert (frame == 0).any()
        row, column = np.argwhere(frame == 0)[0].tolist()
        link = why(source, column, row).fragments[0].link("clip")
        assert link.values["piece_count"] == (drawn == 0).sum()
        assert link.values["division"] == ("mirrored" if clipping != "sutherland-hodgman" else "")


def test_the_block_of_a_missed_pixel_is_the_smallest_that_was_looked_at():
    found = (
        ask(window_scene(LOWER_LEFT), 6, 6, 0, fill="hierarchy", block_size=2).verdict.values["reason"].values
    )
    assert (found["block_size"], found["block"]) == (2, (3, 3))
