"""Texels and needles: what texture filters and samples lose."""

import numpy as np
import pytest

from core.antialiasing.measured import ThinCase, needle
from core.study.record import Outcome
from core.study.stability import experiments
from tests.covering import every_nth

MINIFICATION = experiments.get("minification")
ALIASING = experiments.get("shading-aliasing")
THIN = experiments.get("thin-triangles")
SOURCE = np.random.default_rng(8)


def texture_places(angle: float, densities: tuple[float, float], count: int = 4) -> list[tuple[float, float]]:
    low, high = densities
    density = np.exp(SOURCE.uniform(np.log(low), np.log(high), count))
    return [(float(d), float(a)) for d, a in zip(density, SOURCE.uniform(0, angle, count), strict=True)]


@pytest.mark.parametrize("place", texture_places(85.0, (2.0, 32.0), 3))
def test_filters_without_mipmaps_alias(place: tuple[float, float]) -> None:
    for name in ("nearest", "bilinear"):
        assert MINIFICATION.run(f"texture_filter={name}", place, 2).outcome == Outcome.WRONG_PICTURE


@pytest.mark.parametrize("place", texture_places(45.0, (1.0, 32.0)))
def test_trilinear_holds_seen_from_the_front(place: tuple[float, float]) -> None:
    for seed in (0, 2):
        assert MINIFICATION.run("texture_filter=trilinear", place, seed).outcome == Outcome.RIGHT


def test_trilinear_blurs_long_footprints() -> None:
    for place in ((1.0, 75.0), (1.5, 70.0), (1.0, 80.0)):
        assert MINIFICATION.run("texture_filter=trilinear", place, 2).outcome == Outcome.WRONG_PICTURE


@pytest.mark.parametrize("place", texture_places(85.0, (1.0, 32.0), 3))
def test_msaa_shades_once(place: tuple[float, float]) -> None:
    none, msaa = (ALIASING.run(f"antialiasing={name}", place, 1) for name in ("none", "msaa-4"))
    assert none == msaa
    assert none.outcome == Outcome.WRONG_PICTURE
    area = ALIASING.run("antialiasing=area", place, 1)
    assert area.outcome == Outcome.WRONG_PICTURE
    assert area.severity > 0.9 * none.severity
    assert ALIASING.run("antialiasing=ssaa-16", place, 1).severity < 0.5 * none.severity


@pytest.mark.parametrize("place", texture_places(60.0, (1.0, 4.0), 3))
def test_sixteen_samples_hold_for_a_few_texels(place: tuple[float, float]) -> None:
    assert ALIASING.run("antialiasing=ssaa-16", place, 1).outcome == Outcome.RIGHT


def test_mipmaps_hold_for_many_texels_where_samples_do_not() -> None:
    for place in ((16.0, 20.0), (10.0, 30.0), (16.0, 75.0)):
        assert ALIASING.run("antialiasing=ssaa-4", place, 1).outcome == Outcome.WRONG_PICTURE
        assert ALIASING.run("antialiasing=none texture_filter=trilinear", place, 1).outcome == Outcome.RIGHT


@pytest.mark.parametrize("offset", every_nth([0.0, 0.2, 0.45, 0.99], 2))
def test_needles_are_lost_between_samples(offset: float) -> None:
    for name, widths in (
        ("none", (0.02, 0.4, 0.8)),
        ("ssaa-4", (0.02, 0.2, 0.4)),
        ("msaa-4", (0.02, 0.2)),
        ("ssaa-16", (0.02, 0.2)),
    ):
        for width in widths:
            assert THIN.run(f"antialiasing={name}", (width, offset), 0).outcome == Outcome.HOLE
    for name, first in (("none", 1.06), ("ssaa-4", 0.53), ("msaa-4", 0.27), ("ssaa-16", 0.27)):
        for width in (first, 1.6, 3.0):
            assert THIN.run(f"antialiasing={name}", (width, offset), 0).outcome != Outcome.HOLE
    for width in (0.27, 0.6, 1.0, 1.6, 3.0):
        for name in ("msaa-4", "ssaa-16"):
            assert THIN.run(f"antialiasing={name}", (width, offset), 0).outcome == Outcome.RIGHT
    for width in (0.01, 0.1, 0.5, 1.0, 3.0):
        verdict = THIN.run("antialiasing=area", (width, offset), 0)
        assert verdict.outcome == Outcome.RIGHT
        assert verdict.severity < 1e-6


def test_the_reference_has_the_area_of_the_needle() -> None:
    case = ThinCase(needle(0.5, 0.25))
    # Half a pixel wide at y = -8, nothing at y = 1024: from y = 0 to 32 it is a trapezium.
    widths = [0.5 * (1024 - y) / 1032 for y in (0, 32)]
    assert case.wanted.sum() == pytest.approx(32 * sum(widths) / 2)
