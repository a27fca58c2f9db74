"""Affine interpolation strays as far as its closed form says, and perspective does not."""

from fractions import Fraction

import numpy as np
import pytest

from core.interpolation.corrected_affine import largest_affine_error
from core.interpolation.measured import HALF_TEXEL, StripCase, leaning_strip
from core.study.record import Outcome
from core.study.stability import experiments
from tests.covering import in_turn

AFFINE = experiments.get("affine-w-ratio")
PLACES = [
    (float(ratio), float(width))
    for ratio, width in zip(
        np.exp(np.random.default_rng(5).uniform(np.log(1.05), np.log(20), 8)),
        (64, 97, 128, 200) * 2,
        strict=True,
    )
]


def closed_form(ratio: float) -> float:
    return float(largest_affine_error(np.array([ratio]))[0])


@pytest.mark.parametrize("place", PLACES)
def test_affine_strays_by_the_closed_form(place: tuple[float, float]) -> None:
    verdict = AFFINE.run("interpolation=affine", place, 0)
    ratio, width = place
    # The largest error lies between two pixel centres; around it, it falls off with the square.
    curvature = 2 * ratio**2
    assert closed_form(ratio) - curvature / width**2 <= verdict.severity <= closed_form(ratio) + 1e-7
    assert verdict.outcome == (Outcome.WRONG_PICTURE if closed_form(ratio) > HALF_TEXEL else Outcome.RIGHT)


@pytest.mark.parametrize(("place", "interval"), in_turn(PLACES, [64, 16, 4, 1]))
def test_corrected_affine_strays_by_the_ratio_within_an_interval(
    place: tuple[float, float], interval: int
) -> None:
    method = f"interpolation=affine-n correction_interval={interval}"
    ratio, width = place
    within = min(1 + (ratio - 1) * interval / width, ratio)
    verdict = AFFINE.run(method, place, 0)
    assert verdict.severity <= (closed_form(within) if interval > 1 else 0.0) + 1e-7
    assert verdict.severity < AFFINE.run("interpolation=affine", place, 0).severity


@pytest.mark.parametrize("place", PLACES)
def test_perspective_holds(place: tuple[float, float]) -> None:
    verdict = AFFINE.run("interpolation=perspective", place, 0)
    assert verdict.outcome == Outcome.RIGHT
    assert verdict.severity < 1e-7


def test_affine_is_right_where_w_is_one() -> None:
    assert AFFINE.run("interpolation=affine", (1.0, 64.0), 0).severity < 1e-7


def test_the_reference_is_the_formula_of_the_strip() -> None:
    case = StripCase(leaning_strip(4.0, 16))
    assert case.wanted.shape == (2, 4, 16)
    for column, wanted in enumerate(case.wanted.transpose(2, 0, 1)):
        t = Fraction(2 * column + 1, 32)
        assert (wanted == float(t / (4 - 3 * t))).all()
