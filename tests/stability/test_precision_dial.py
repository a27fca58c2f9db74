"""The precision dial: one pixel in every format, and the operation that turns its decision."""

from fractions import Fraction

import numpy as np
import pytest

from core import ClipScene, Settings, render
from core.coverage.measured_cover import as_given
from core.coverage.measured_pixel import AREA, ELIMINATION, OVERFLOW, DialReading, precision_dial
from core.coverage.measured_triangles import FORMATS, far_corners, sliver

CENTER = (41, 35)
"""A pixel whose centre lies just inside the long side of `sliver`."""


def reading(scene: ClipScene, pixel: tuple[int, int], coverage: str) -> DialReading:
    return next(each for each in precision_dial(scene, pixel) if each.coverage == coverage)


def random_scene(seed: int) -> ClipScene:
    source = np.random.default_rng(seed)
    clip = source.uniform(-1.5, 1.5, (1, 3, 4))
    clip[..., 3] = source.uniform(0.3, 2.0, (1, 3))
    return ClipScene(clip, size=(16, 16))


@pytest.mark.parametrize("seed", range(8))
def test_every_reading_is_what_the_picture_shows(seed: int) -> None:
    scene = random_scene(seed)
    covered = as_given(scene, Settings())
    pictures = {
        method: render(scene, Settings(fill="bounding-box", coverage=method.partition("=")[2])).cover_count
        for method in FORMATS
    }
    for pixel in [(3, 4), (8, 8), (11, 6), (14, 15)]:
        readings = precision_dial(scene, pixel)
        assert [f"coverage={each.coverage}" for each in readings] == list(FORMATS)
        for method, each in zip(FORMATS, readings, strict=True):
            assert each.is_covered == bool(pictures[method][pixel[1], pixel[0]])
            assert each.is_right == (each.is_covered == covered[pixel[1], pixel[0]])
            assert bool(each.flipped_by) == (not each.is_right)


@pytest.mark.parametrize("seed", range(8))
def test_the_operations_end_in_the_value_of_the_format(seed: int) -> None:
    scene = random_scene(seed)
    for each in precision_dial(scene, (8, 8)):
        if not each.steps:
            assert each.coverage in ("inverse", "float16")
            continue
        assert abs(each.steps[-1].value) == abs(each.values[each.edge])


def test_the_first_operation_that_turns_the_decision_is_named() -> None:
    scene = sliver((1.0, 2.0**-12), 0)
    snapped = reading(scene, CENTER, "snapped")
    # Snapping moves the end of the side by less than half a step: from there on the centre lies on the side.
    assert snapped.flipped_by == "y2"
    assert snapped.values[snapped.edge] == 0
    assert not snapped.is_covered
    half = reading(scene, CENTER, "float16")
    assert half.flipped_by == "y1 x2"
    at = [step.operation for step in half.steps].index("y1 x2")
    assert half.steps[at].value != half.steps[at].exact
    assert half.steps[at - 1].is_inside
    assert not any(step.is_inside for step in half.steps[at:])
    assert reading(scene, CENTER, "float32").is_right


def test_bits_and_exact_values_are_shown() -> None:
    scene = sliver((1.0, 2.0**-4), 0)
    assert reading(scene, CENTER, "float16").bits == "0 10000 0000000000"
    assert reading(scene, CENTER, "fixed-24.8").bits == "0000000000000001.1011000000000000"
    assert reading(scene, CENTER, "exact").bits == ""
    assert {each.exact_value for each in precision_dial(scene, CENTER)} == {1.6875}
    assert reading(scene, CENTER, "float32").values[2] == 1.6875


def test_overflow_and_elimination_have_names() -> None:
    far = far_corners((2.0**12, 4.0), 0)
    wrapped = reading(far, (32, 32), "fixed-24.8")
    assert not wrapped.is_right
    assert wrapped.flipped_by
    assert abs(wrapped.values[wrapped.edge]) < 2**15
    assert reading(far, (32, 32), "float16").flipped_by == OVERFLOW
    assert reading(sliver((1.0, 2.0**-48), 0), (32, 32), "inverse").flipped_by == ELIMINATION


def test_a_triangle_that_snapping_flattens_is_lost_as_a_whole() -> None:
    flat = reading(sliver((2.0**-19, 2.0**-21), 0), (47, 37), "snapped")
    assert not flat.is_covered
    assert not flat.is_right
    assert flat.flipped_by == AREA
    assert flat.values == (0.0, 0.0, 0.0)


def test_the_exact_format_is_right_and_its_steps_round_nothing() -> None:
    scene = sliver((1.0, 2.0**-48), 0)
    exact = reading(scene, CENTER, "exact")
    assert exact.is_right
    assert all(step.is_inside for step in exact.steps)
    assert exact.steps[-1].value == float(Fraction(exact.exact_value))


def test_a_triangle_that_is_not_there_is_named() -> None:
    with pytest.raises(ValueError, match="triangle must be from 0 to 0, got 3"):
        precision_dial(sliver((1.0, 0.5), 0), CENTER, 3)
