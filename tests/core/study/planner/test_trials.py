"""Trials: pixels that are drawn in bands are those of the whole picture, and counts are those of its size."""

from dataclasses import replace

import numpy as np
import pytest

from core.scene import ClipScene
from core.study.planner.planning import plan
from core.study.planner.records import Tolerance
from core.study.planner.reference_settings import reference_settings
from core.study.planner.trials import PIXELS, Costs, Trials, bands, difference, shown
from core.study.workloads import sphere_scene


@pytest.mark.parametrize("size", [(1, 1), (128, 128), (129, 128), (640, 480), (20000, 3), (3, 20000)])
def test_bands_lie_in_the_picture_and_are_few(size: tuple[int, int]) -> None:
    regions = bands(*size)
    rows = [row for _, first, _, count in regions for row in range(first, first + count)]
    assert len(set(rows)) == len(rows)
    assert min(rows) == 0
    assert max(rows) == size[1] - 1
    assert all((column, columns) == (0, size[0]) for column, _, columns, _ in regions)
    assert len(rows) * size[0] <= PIXELS or all(count == 1 for *_, count in regions)


def test_what_is_tried_are_pixels_of_the_whole_picture() -> None:
    scene, tolerance = replace(sphere_scene(6, 64), size=(200, 150)), Tolerance(2, 900)
    everything = reference_settings(scene)
    one = replace(everything, antialiasing="none")
    trials = Trials(scene, tolerance)
    trial = trials.compare(one, everything)
    assert trials.rows < 150
    whole = difference(shown(scene, one), shown(scene, everything))
    tried = np.concatenate([whole[first : first + count] for _, first, _, count in trials.regions])
    assert trial.largest == tried.max()
    assert trial.beyond == round(np.count_nonzero(tried > 2) * 150 / trials.rows)
    assert trial.beyond == pytest.approx(np.count_nonzero(whole > 2), rel=0.3)
    assert trial.is_within == (trial.beyond <= 900)
    # One byte more is predicted where rows were left out, but no more than the tolerance allows.
    same = trials.compare(everything, everything)
    assert (same.largest, same.error, same.pixels) == (0, 1, 0)
    assert Trials(scene, Tolerance.exact()).compare(everything, everything).error == 0


def test_cut_edges_keep_their_clipping_where_rows_are_left_out() -> None:
    clip = np.random.default_rng(4).normal(size=(20, 3, 4))
    scene = ClipScene(clip, np.full((20, 3, 4), 0.5), (200, 150))
    decision = next(each for each in plan(scene, costs=Costs()).decisions if each.setting == "clipping")
    assert (decision.chosen, decision.is_needed) == ("sutherland-hodgman", True)
    assert "may change a pixel on a cut edge between the rows that were tried" in decision.reason
