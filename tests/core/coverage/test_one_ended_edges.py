"""Edges with one end behind the eye or too far away: snapping moves them by sqrt(2)/512 pixel and turns none."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from core import ClipScene, Settings, draw_picture, render, trace
from core.coverage.edges import set_up_per_edge
from core.coverage.measured_exactly import exact_spans
from core.coverage.snapping import FARTHEST, place_corners, whole_direction
from core.framebuffer.display import to_display
from core.pixel_history import why
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace
from tests.core.drawing import TESTING_FILLS, cover_each
from tests.core.exact_reference import homogeneous_window, line_through
from tests.core.one_ended import one_ended_triangles
from tests.core.trace.geometry_listings import check_edges

SQUARED_BOUND = Fraction(2, 512**2)
"""Square of how far snapping moves a corner, in square pixels."""


def squared_distance(corners: np.ndarray, size: tuple[int, int], column: int, row: int) -> Fraction:
    """Return the square of the distance of a pixel's centre from the nearest edge, unsnapped, in square pixels."""
    placed = [homogeneous_window(corner, size) for corner in corners]
    lines = [line_through(placed[k - 2], placed[k - 1]) for k in range(3)]
    x, y = Fraction(2 * column + 1, 2), Fraction(2 * row + 1, 2)
    return min(Fraction(a * x + b * y + c) ** 2 / (a * a + b * b) for a, b, c in lines if a or b)


def assert_within_the_bound(clip: np.ndarray, size: tuple[int, int]) -> None:
    """Compare with exact coverage: what differs lies no farther from an edge than snapping moves a corner."""
    ours, exact = cover_each(clip, size), cover_each(clip, size, coverage="exact")
    for triangle, row, column in np.argwhere(ours != exact).tolist():
        assert squared_distance(clip[triangle], size, column, row) <= SQUARED_BOUND, (triangle, row, column)


def test_an_edge_aimed_from_its_snapped_end_turned_by_444_pixels() -> None:
    corners = [
        [-0.8425715, -0.8410074, 0, 1],
        [0.84418344, 0.8421102, 0, -1],
        [-1.2836984, -0.19621398, 0, 1],
    ]
    clip = np.array([corners], np.float32).astype(float)
    size = (512, 512)
    differing = cover_each(clip, size) != cover_each(clip, size, coverage="exact")
    assert differing.sum() <= 2
    assert_within_the_bound(clip, size)


def test_no_pixel_farther_from_an_edge_than_a_corner_is_snapped_is_decided_against_it() -> None:
    for seed in range(3):
        assert_within_the_bound(one_ended_triangles(seed, 120, (48, 40)), (48, 40))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("size", [(48, 40), (333, 97), (512, 512)])
def test_the_bound_on_many_triangles(seed: int, size: tuple[int, int]) -> None:
    assert_within_the_bound(one_ended_triangles(seed + 100, 100, size), size)


def test_every_edge_is_decided_as_rational_arithmetic_decides_it() -> None:
    size = (24, 20)
    clip = one_ended_triangles(9, 200, size)
    triangle, column, row = exact_spans(clip, size).pixels()
    expected = np.zeros((len(clip), size[1], size[0]), int)
    expected[triangle, row, column] = 1
    assert np.array_equal(cover_each(clip, size), expected)


@pytest.mark.parametrize("scale", [1.0, 1e-40, 1e90])
def test_whole_numbers_decide_all_vectors_of_the_grid_alike(scale: float) -> None:
    generator = np.random.default_rng(2)
    a, b = generator.normal(size=(2, 300)) * scale
    a[:100] *= np.exp(generator.uniform(-25, 25, 100))
    a[100:150], b[100:150] = generator.integers(-9, 10, (2, 50))  # Many grid points on the edge.
    whole_a, whole_b = whole_direction(a, b)
    assert np.array_equal(np.sign([whole_a, whole_b]), np.sign([a, b]))
    assert np.abs([whole_a, whole_b]).max() <= 2 * FARTHEST
    for given, found in zip(
        np.stack([a, b], 1).tolist(), np.stack([whole_a, whole_b], 1).tolist(), strict=True
    ):
        smaller, larger = sorted(abs(Fraction(value)) for value in given)
        # The slope of the grid point closest to the edge, and one beside it.
        slope = (smaller / larger).limit_denominator(FARTHEST)
        for p in (slope.numerator, slope.numerator + 1):
            for x, y in ((p, slope.denominator), (slope.denominator, p), (-p, slope.denominator)):
                value = Fraction(given[0]) * x + Fraction(given[1]) * y
                if value == 0 or abs(value) > Fraction(2.0**-60) * larger * max(abs(x), abs(y)):
                    assert sign_of(int(found[0]) * x + int(found[1]) * y) == sign_of(value)


def sign_of(value: Fraction | int) -> int:
    return (value > 0) - (value < 0)


def test_the_ends_of_an_edge_may_change_places() -> None:
    corners = place_corners(one_ended_triangles(4, 100, (24, 20)), (24, 20), "snapped")
    turned = replace(
        corners.take(np.arange(100)),
        **{
            name: getattr(corners, name)[:, [0, 2, 1]]
            for name in ("homogeneous", "window", "decided", "is_projected", "clip")
        },
    )
    there, back = set_up_per_edge(corners), set_up_per_edge(turned)
    for coefficient, reversed_coefficient in zip(there[:3], back[:3], strict=True):
        sign, turned_sign = np.sign(there[3])[:, None], np.sign(back[3])[:, None]
        assert np.array_equal(sign * coefficient, -turned_sign * reversed_coefficient[:, [0, 2, 1]])


@pytest.mark.parametrize("fill", TESTING_FILLS)
def test_every_fill_covers_the_same_pixels(fill: str) -> None:
    clip = one_ended_triangles(7, 60, (24, 20))
    assert np.array_equal(cover_each(clip, (24, 20), fill), cover_each(clip, (24, 20)))


def test_picture_trace_and_history_agree() -> None:
    size = (17, 13)
    generator = np.random.default_rng(6)
    clip = one_ended_triangles(6, 30, size, gaps=(0.01, 10.0), sizes=(0.0001, 0.1))
    clip[..., 2] = clip[..., 3] * generator.uniform(-0.9, 0.9, (30, 1))
    scene = ClipScene(clip, generator.random((30, 3, 3)).astype(np.float32), size)
    frame = render(scene, Settings())
    for fill in ("spans", "blocks", "scanline"):
        settings = Settings(fill=fill)
        traced = trace(scene, settings)
        check_edges(traced)
        found = traced.stage("depth")
        assert {"anchored-edge", "left-out-edge"} <= kinds_of(traced.stage("edges"))
        track = next(track for track in found.buffers if track.name == "primitive")
        assert np.array_equal(track.at(found.steps.row_count), frame.primitive)
        shown = draw_picture(scene, settings).pixels.astype(int)
        assert np.abs(shown - to_display(frame.color).pixels).max() <= 1
    source = TraceSource(scene, Settings())
    for row, column in np.ndindex(size[1] // 3, size[0] // 3):
        history = why(source, 3 * column, 3 * row)
        assert history.final.triangle == frame.primitive[3 * row, 3 * column]
        assert history.cover_count == frame.cover_count[3 * row, 3 * column]


def kinds_of(found: StageTrace) -> set[str]:
    return {found.steps.kinds[kind] for kind in found.steps.kind}
