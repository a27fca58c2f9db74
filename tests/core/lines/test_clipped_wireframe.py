"""Wireframes whose lines are clipped: values stay those of the whole edge, the border's pixels are there."""

import numpy as np
import pytest

from core import Settings, draw_triangles
from core.methods import table
from tests.core.strategies import clip_of_window
from tests.covering import every_pair

SIZE = (16, 11)
CLIPPERS = table.names("line_clipping")[1:]
CORNERS = [(-3.5, 4.5), (11.5, -2.5), (20.5, 14.25)]


def frame(corners, clipper: str, line: str = "bresenham", **choices):
    clip = clip_of_window([corners], SIZE)
    clip[0, :, :] *= np.array([1.0, 2.0, 3.0])[:, None]
    values = np.array([[[0.0, 1.0], [0.5, 0.0], [1.0, 0.25]]])
    settings = Settings(polygon_mode="wireframe", line=line, line_clipping=clipper, **choices)
    return draw_triangles(clip, *SIZE, attributes=values, settings=settings)


@every_pair(
    interpolation=["perspective", "affine"], line=["bresenham", "dda", "diamond-exit"], clipper=CLIPPERS
)
def test_values_and_depth_are_those_of_the_whole_edge(clipper: str, line: str, interpolation: str) -> None:
    whole = frame(CORNERS, "none", line, interpolation=interpolation)
    cut = frame(CORNERS, clipper, line, interpolation=interpolation)
    both = (whole.cover_count == 1) & (cut.cover_count == 1)
    assert both.sum() >= 12
    assert np.array_equal(whole.depth[both], cut.depth[both])
    assert np.array_equal(whole.attributes[both], cut.attributes[both])


@pytest.mark.parametrize("pixel_center", table.names("pixel_center"))
@pytest.mark.parametrize("clipper", CLIPPERS)
def test_an_edge_that_leaves_is_drawn_up_to_the_border(clipper: str, pixel_center: str) -> None:
    found = frame(
        [(8.25, 5.25), (-20.0, 5.25), (8.25, -30.0)], clipper, pixel_center=pixel_center
    ).cover_count
    row = 5
    assert found[row, 0] == 1
    assert (found[row, :8] == 1).all()


def test_a_clipped_bresenham_line_may_choose_other_pixels() -> None:
    whole, cut = (frame(CORNERS, clipper).cover_count > 0 for clipper in ("none", "liang-barsky"))
    assert (whole != cut).any()
    # By no more than a pixel: each lies beside one of the other line.
    near = np.pad(whole, 1)
    beside = [near[r : r + SIZE[1], c : c + SIZE[0]] for r in range(3) for c in range(3)]
    assert not (cut & ~np.any(beside, axis=0)).any()


@pytest.mark.parametrize("clipper", CLIPPERS)
def test_edges_inside_are_drawn_as_ever(clipper: str) -> None:
    inside = [(1.25, 1.75), (13.5, 3.25), (5.75, 9.5)]
    whole, cut = frame(inside, "none"), frame(inside, clipper)
    assert np.array_equal(whole.color, cut.color)
    assert np.array_equal(whole.cover_count, cut.cover_count)
