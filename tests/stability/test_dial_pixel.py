"""A pixel in every number format: the triangles that decide it, how often it is covered, and the picture around it."""

import numpy as np
import pytest

from core import ClipScene, Settings
from core.coverage.measured_cover import CoverageExperiment, as_given
from core.coverage.measured_formats import (
    FormatAtPixel,
    PixelInFormats,
    covering_triangles,
    pixel_in_formats,
    settings_in,
)
from core.coverage.measured_pixel import FILL_RULE
from core.coverage.measured_triangles import FORMATS, sliver
from core.methods import table
from core.study.record import Outcome, StudyCancelledError
from core.study.stability import experiments
from core.study.workloads import flat_scene
from tests.covering import is_everything
from tests.stability.failing_cells import FAILING_CELLS


def looked_at(name: str, method: str, place: tuple[float, ...]) -> PixelInFormats:
    experiment = experiments.get(name)
    opened = experiment.opening(method, place, 0)
    assert opened.pixel is not None
    return pixel_in_formats(opened.scene, opened.settings, opened.pixel, experiment.wanted)


def of(found: PixelInFormats, coverage: str) -> FormatAtPixel:
    return next(each for each in found.formats if each.coverage == coverage)


COVERAGE_CELLS = [cell for cell in FAILING_CELLS if isinstance(experiments.get(cell[0]), CoverageExperiment)]


@pytest.mark.parametrize(
    ("name", "method", "place"),
    COVERAGE_CELLS if is_everything() else list({cell[0]: cell for cell in COVERAGE_CELLS}.values())[::3],
)
def test_the_table_agrees_with_the_map(name: str, method: str, place: tuple[float, ...]) -> None:
    experiment = experiments.get(name)
    found = looked_at(name, method, place)
    assert found.run_count != found.run_wanted, "the pixel that opens is wrong"
    for each in found.formats:
        assert (each.wrong_count == 0) == (each.first_wrong is None)
        assert each.count == each.wanted or each.wrong_count
        key = f"coverage={each.coverage}"
        if key in experiment.info.methods and found.fill_rule == "shared-edge":
            is_right = experiment.run(key, place, 0).outcome is Outcome.RIGHT
            assert is_right == (each.wrong_count == 0)
        if not found.left_out:
            kept = zip(each.readings, found.is_culled, strict=True)
            assert each.count == sum(reading.is_covered and not is_culled for reading, is_culled in kept)


def test_a_format_may_be_right_here_and_wrong_elsewhere() -> None:
    found = looked_at("precision-dial", "coverage=float32", (2.0**-18,))
    assert (found.pixel, found.triangles, found.run_wanted, found.run_count) == ((32, 32), (0,), 0, 1)
    for name in ("float16", "snapped"):
        each = of(found, name)
        assert each.count == each.wanted == 0
        assert each.readings[0].is_right
        assert each.first_wrong == (35, 33)
    assert of(found, "float64").wrong_count == 0


def test_both_triangles_of_a_shared_edge_are_read() -> None:
    # The diagonal of a square passes through every centre of it.
    corners = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    window = corners[[[0, 1, 2], [0, 2, 3]]]
    clip = np.concatenate([window / 2 - 1, np.zeros((2, 3, 1)), np.ones((2, 3, 1))], axis=2)
    scene = flat_scene(clip, (4, 4))
    experiment = experiments.get("shared-edges")
    for rule, count in (("exclusive", 0), ("inclusive", 2), ("shared-edge", 1)):
        settings = render_settings(rule)
        found = pixel_in_formats(scene, settings, (1, 1), experiment.wanted)
        assert found.triangles == (0, 1)
        assert found.left_out == 0
        assert (found.run_count, found.run_wanted) == (count, 1)
        exact = of(found, "exact")
        assert exact.count == count
        assert [reading.exact_value for reading in exact.readings] == [0.0, 0.0]
        flipped = [reading.flipped_by for reading in exact.readings if reading.flipped_by]
        assert flipped == ([] if count == 1 else [FILL_RULE])


def render_settings(rule: str):
    return settings_in(
        experiments.get("shared-edges").case(f"fill_rule={rule}", (1.0, 4.0), 0)[1], FORMATS[-1]
    )


def test_a_pixel_that_nothing_covers_names_the_nearest_triangle() -> None:
    left = sliver((1.0, 0.5), 0).clip
    scene = flat_scene(np.concatenate([left - [0.5, 0, 0, 0], left]), (64, 64))
    found = pixel_in_formats(scene, render_settings("shared-edge"), (63, 40), as_given)
    assert not found.is_touched
    assert found.triangles == (1,)
    assert (found.run_count, found.run_wanted) == (0, 0)


def test_pieces_that_clipping_made_are_told_from_the_triangle() -> None:
    differ = set()
    for seed in range(140, 160) if is_everything() else (140, 151):
        source = np.random.default_rng(seed)
        clip = source.uniform(-2, 2, (3, 3, 4)) * [1, 1, 0, 1]
        pixel = (int(source.integers(8)), int(source.integers(8)))
        found = pixel_in_formats(flat_scene(clip, (8, 8)), render_settings("shared-edge"), pixel, as_given)
        for each in found.formats:
            assert found.left_out or sum(each.is_drawn) == each.count
            if tuple(reading.is_covered for reading in each.readings) != each.is_drawn:
                differ.add(each.coverage)
    assert differ
    assert all("projected" in table.get("coverage", coverage).needs for coverage in differ)


def test_bad_pixels_empty_scenes_and_cancelling_are_told() -> None:
    scene = sliver((1.0, 0.5), 0)
    settings = render_settings("shared-edge")
    with pytest.raises(ValueError, match=r"within 64 x 64, got \(64, 0\)"):
        pixel_in_formats(scene, settings, (64, 0), as_given)
    with pytest.raises(ValueError, match="got one without any"):
        pixel_in_formats(flat_scene(np.empty((0, 3, 4)), (4, 4)), settings, (0, 0), as_given)
    with pytest.raises(StudyCancelledError):
        pixel_in_formats(scene, settings, (1, 1), as_given, lambda: True)


@pytest.mark.parametrize(("pixel_center", "count"), [("half", 0), ("integer", 1)])
def test_a_pixel_is_covered_where_its_centre_is(pixel_center: str, count: int) -> None:
    """A triangle around the corner (4, 4) of pixel (4, 4) holds its centre only where centres are whole numbers."""
    corners = (np.array([(3.7, 3.7), (4.3, 3.7), (4.0, 4.4)]) / 4 - 1).tolist()
    clip = np.array([[[*corner, 0.0, 1.0] for corner in corners]])
    scene = ClipScene(clip, np.eye(3)[None], (8, 8))
    assert len(covering_triangles(scene, Settings(pixel_center=pixel_center), (4, 4))) == count
