"""Tables of depths: a plain loop over cells leaves what render, trace and history have; bad cells are refused."""

from dataclasses import replace

import numpy as np
import pytest

from core import Settings, render, trace
from core.depth.whole_depths import table_scene
from core.fast_path.draw import draw_picture
from core.framebuffer.display import to_display
from core.pixel_history import why
from core.pixel_history.told import verdict_sentence
from core.records.depth_table import (
    DEPTH_TESTS,
    MOST_DEPTH,
    DepthTable,
    depth_of_text,
    depth_text,
    depths_of_text,
    text_of_depths,
)
from core.scene import ClipScene
from core.stages.declared import STAGES
from core.trace.source import TraceSource
from lessons.window_scenes import LEVEL, SLOPING, depth_table, two_triangles, two_triangles_turned

COMPARE = {"<": float.__lt__, "≤": float.__le__, ">": float.__gt__, "≥": float.__ge__}


def drawn_by_hand(table: DepthTable) -> tuple[np.ndarray, np.ndarray]:
    """Return the buffer and the patch seen in it, by the plain loop of the lectures."""
    buffer = np.full(table.depths.shape[1:], table.cleared)
    seen = np.full(buffer.shape, -1)
    for patch, cells in enumerate(table.depths.tolist()):
        for row, line in enumerate(cells):
            for column, depth in enumerate(line):
                is_there = depth == depth
                if is_there and COMPARE[DEPTH_TESTS[table.test]](depth, float(buffer[row, column])):
                    buffer[row, column], seen[row, column] = depth, patch
    return buffer, seen


def random_table(seed: int, test: str) -> DepthTable:
    random = np.random.default_rng(seed)
    depths = random.integers(0, 6, (4, 5, 7)).astype(float)
    depths[random.random(depths.shape) < 0.3] = np.nan
    depths[random.random(depths.shape) < 0.1] = np.inf
    depths[0, 0, 0] = MOST_DEPTH
    return DepthTable(depths, random.random((4, 4)), test)


@pytest.mark.parametrize("test", list(DEPTH_TESTS))
@pytest.mark.parametrize("seed", [0, 1])
def test_picture_trace_and_history_are_those_of_the_plain_loop(test, seed):
    table = random_table(seed, test)
    scene, (buffer, seen) = table_scene(table), drawn_by_hand(table)
    frame = render(scene)
    assert np.array_equal(frame.depth, buffer)
    assert np.array_equal(frame.primitive, seen)
    assert np.array_equal(draw_picture(scene).pixels, to_display(frame.color).pixels)
    found = trace(scene).stage("depth")
    state = found.state(found.steps.count)
    assert np.array_equal(state["depth"], buffer)
    assert np.array_equal(state["primitive"], seen)
    after = found.columns["after"].tolist()
    for row, (new, old) in enumerate(zip(found.columns["stored"], found.columns["before"], strict=True)):
        explanation = found.explain(found.steps.position_after(row))
        assert explanation.listing.function(new, old) == (after[row], bool(found.columns["passes"][row]))
    history = why(TraceSource(scene, Settings()), 0, 0)
    assert (history.final.depth, history.final.triangle) == (buffer[0, 0], seen[0, 0])


@pytest.mark.parametrize("cells", ["- 4", "4 -", "4- -- --", "-- -- -3"])
def test_a_patch_without_a_fragment_is_drawn_stepped_and_explained(cells):
    scene = table_scene(depth_table(*("\t".join(patch) for patch in cells.split())))
    buffer, seen = drawn_by_hand(scene.table)
    assert np.array_equal(render(scene).depth, buffer)
    for patch in (None, *range(len(scene.table.depths))):
        traced = trace(scene, triangle=patch)
        for stage in STAGES:
            traced.stage(stage)
        for column in range(scene.size[0]):
            history = why(traced.source, column, 0, patch)
            assert verdict_sentence(history)
            assert history.final.triangle == seen[0, column]


def test_the_painters_algorithm_draws_whole_patches_by_their_mean_depth():
    table = depth_table("1 5 5", "4 2 2", "9 9 -")
    scene, settings = table_scene(table), Settings(visibility="painters")
    assert render(scene, settings).primitive.tolist() == [[1, 1, 1]], (
        "means 11/3, 8/3 and 9: the second is last"
    )
    for column in range(3):
        assert why(TraceSource(scene, settings), column, 0).final.triangle == 1
    found = trace(scene, settings, triangle=0).stage("depth")
    assert found.state(0)["primitive"].tolist() == [[2, 2, -1]]


def test_one_patch_is_stepped_over_what_the_earlier_ones_left():
    scene = two_triangles()
    found = trace(scene, triangle=1).stage("depth")
    assert set(found.triangle.tolist()) == {1}
    assert np.array_equal(found.state(0)["depth"], drawn_by_hand(depth_table(LEVEL))[0])
    assert np.array_equal(found.state(found.steps.count)["depth"], render(scene).depth)


def test_settings_of_triangles_and_of_samples_change_nothing():
    scene = two_triangles()
    choice = Settings(antialiasing="ssaa-4", depth="inverse-w", pixel_center="integer")
    for settings in (choice, replace(choice, antialiasing="msaa-4", clipping="after-divide")):
        assert np.array_equal(render(scene, settings).color, render(scene).color)
        assert np.array_equal(draw_picture(scene, settings).pixels, draw_picture(scene).pixels)
        assert np.array_equal(trace(scene, settings).source.picture.depth, render(scene).depth)


def test_drawn_in_order_without_a_test_the_last_patch_stays():
    frame = render(two_triangles(), Settings(visibility="last-drawn"))
    table = depth_table(LEVEL, SLOPING)
    wanted = np.where(np.isnan(table.depths[1]), table.depths[0], table.depths[1])
    assert np.array_equal(frame.depth, np.where(np.isnan(wanted), np.inf, wanted))


def test_hidden_surfaces_do_not_depend_on_the_order():
    assert np.array_equal(render(two_triangles()).depth, render(two_triangles_turned()).depth)


def test_a_table_is_read_and_written_as_it_is_printed():
    cells = depths_of_text(SLOPING)
    assert np.array_equal(depths_of_text(text_of_depths(cells)), cells, equal_nan=True)
    assert depths_of_text("1 2\n3 inf")[0].tolist() == [3.0, np.inf], "the last line is row 0"
    assert [depth_text(depth_of_text(text)) for text in ("7", " ∞", "INF", "", "-")] == [
        "7",
        "∞",
        "∞",
        "–",
        "–",
    ]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 2\n3", "row 2 has 1 cell, row 1 has 2"),
        ("1 2\n3 x", "row 2, cell 2: expected a whole number from 0 to 9999"),
        ("1 nan", "row 1, cell 2: expected"),
        ("1 -inf", "row 1, cell 2: expected"),
        ("1.5", "row 1, cell 1: expected"),
        ("10000", "row 1, cell 1: expected"),
        ("²", "row 1, cell 1: expected"),
        ("  \n ", "at least one row"),
    ],
)
def test_what_is_no_table_is_refused_with_its_place(text, message):
    with pytest.raises(ValueError, match=message):
        depths_of_text(text)


@pytest.mark.parametrize(
    ("depths", "test", "message"),
    [
        ([[[1.5]]], "less", "a depth must be a whole number"),
        ([[[-np.inf]]], "less", "a depth must be a whole number"),
        ([[[np.nan]]], "less", "at least one depth"),
        ([[1.0]], "less", r"depths must be \(P, H, W\)"),
        ([[[1.0]]], "equal", "the depth test must be one of less"),
        (np.ones((1, 33, 1)), "less", "at most 16 patches of 32 x 32 cells"),
    ],
)
def test_a_table_says_what_it_needs(depths, test, message):
    with pytest.raises(ValueError, match=message):
        DepthTable(depths, np.ones((1, 4)), test)


def test_fragments_and_no_other_kind_have_a_table():
    with pytest.raises(ValueError, match="needs a table"):
        ClipScene(np.zeros((1, 1, 4)), kind="fragments")
