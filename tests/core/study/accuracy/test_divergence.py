"""Where two settings part ways: the stage, the pixel and the numbers."""

from dataclasses import replace

import numpy as np
import pytest

from core import ClipScene, Settings
from core.methods import table
from core.pipeline import render
from core.study.divergence import diverge, first_divergence
from core.study.workloads import cyclic_triangles, flat_scene, textured_quad
from core.trace import trace
from lessons.scenes import make_scene

SIZE = (24, 24)


@pytest.fixture
def pair() -> ClipScene:
    clip = [
        [[-0.9, -0.8, -0.5, 1.0], [0.9, -0.7, 0.5, 2.0], [-0.2, 0.9, 0.0, 1.5]],
        [[-0.7, 0.8, 0.5, 1.0], [0.8, 0.6, -0.5, 1.0], [0.1, -0.9, 0.0, 1.0]],
    ]
    colors = np.array([[[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]]] * 2, float)
    return ClipScene(np.array(clip), colors, SIZE)


def test_the_same_settings_never_part(pair: ClipScene) -> None:
    assert first_divergence(pair, Settings(), Settings()) is None


@pytest.mark.parametrize("fill", ["hierarchy", "blocks", "brute-force", "scanline", "bounding-box"])
def test_fills_that_cover_the_same_pixels_in_another_order_do_not_part(pair: ClipScene, fill: str) -> None:
    assert first_divergence(pair, Settings(fill="spans"), Settings(fill=fill)) is None


def test_a_fill_that_covers_other_pixels_parts_at_the_first_of_them(pair: ClipScene) -> None:
    found = first_divergence(pair, Settings(), Settings(fill="scanline-lecture"))
    assert (found.stage, found.triangle) == ("raster", 0)
    column, row = found.pixel
    one = ClipScene(pair.clip[:1], size=SIZE)
    drawn = [
        render(one, Settings(fill=fill)).cover_count[row, column] for fill in ("spans", "scanline-lecture")
    ]
    assert sorted(drawn) == [0, 1]
    assert None in found.rows or found.names == ("covered",)


def test_interpolation_parts_at_its_stage_with_the_numbers(pair: ClipScene) -> None:
    found = first_divergence(pair, Settings(), Settings(interpolation="affine"))
    assert (found.stage, found.triangle, found.names) == ("interpolate", 0, ("values",))
    first, second = (np.asarray(values["values"]) for values in found.values)
    assert not np.array_equal(first, second)
    assert found.pixel == (int(found.values[0]["column"]), int(found.values[0]["row"]))


def test_a_depth_test_that_fails_parts_at_the_pixel() -> None:
    scene = flat_scene(cyclic_triangles(SIZE), SIZE)
    found = first_divergence(scene, Settings(), Settings(visibility="last-drawn"))
    assert (found.stage, found.names) == ("depth", ("passes", "after"))
    assert found.values[0]["passes"] != found.values[1]["passes"]


def test_filters_part_at_the_texels_and_a_region_narrows_the_search() -> None:
    from core.study.workloads import checkerboard

    scene = textured_quad(12, 2.0, 1.0, checkerboard(16, 0))
    found = first_divergence(scene, Settings(), Settings(texture_filter="nearest"), region=(4, 4, 3, 3))
    assert found.stage == "shade"
    assert 4 <= found.pixel[0] < 7
    assert 4 <= found.pixel[1] < 7


def test_clipping_parts_where_a_triangle_is_cut() -> None:
    clip = np.array(
        [[[-1, -1, 0, 1], [1, -1, 0, 1], [0, 0.5, 0, 1]], [[-3, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1]]]
    )
    found = first_divergence(
        ClipScene(clip.astype(float), size=SIZE), Settings(), Settings(clipping="sutherland-hodgman")
    )
    assert (found.stage, found.triangle, found.pixel) == ("clip", 1, None)


def test_every_family_can_be_compared(pair: ClipScene) -> None:
    # Whatever the methods, the search ends: at a place that both or one of the traces have, or nowhere.
    for family in (
        "fill",
        "coverage",
        "depth",
        "visibility",
        "interpolation",
        "polygon_mode",
        "blend",
        "cull",
    ):
        for name in table.names(family):
            found = first_divergence(pair, Settings(), Settings(**{family: name}))
            if found is not None:
                assert found.rows != (None, None)
                assert found.names or None in found.rows


def test_outcomes_part_ways_later_than_numbers_on_the_way() -> None:
    scene = make_scene("textured-floor")
    traces = [
        trace(replace(scene, size=(24, 24)), Settings(texture_filter=name))
        for name in ("bilinear", "nearest")
    ]
    rows = [diverge(*traces, by_outcome=by_outcome) for by_outcome in (False, True)]
    assert rows[0] is not None
    assert rows[1] is not None
    assert rows[1].stage == "shade"
    assert rows[1].names == ("color",)
    assert rows[0].rows <= rows[1].rows
