"""The fill ``spans`` covers the pixels of whole numbers and of every other fill, for all triangles at once."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, render
from core.methods import table
from tests.core.exact_reference import exact_coverage
from tests.core.spans.adversarial import LIMIT, PROJECTED, SIZES, drawn, in_whole_numbers, mixed, projected
from tests.core.strategies import clip_of_window, homogeneous_triangles
from tests.covering import is_everything

SEEDS = st.integers(0, 2**32 - 1)
RULES = table.names("fill_rule")
CENTERS = {"half": 1, "integer": 0}


@given(
    SEEDS,
    st.sampled_from(list(PROJECTED)),
    st.sampled_from(SIZES),
    st.sampled_from(RULES),
    st.sampled_from(list(CENTERS)),
)
def test_pixels_are_those_of_whole_numbers(seed: int, family: str, size, rule: str, center: str) -> None:
    corners = projected(np.random.default_rng(seed), 40, size, family)
    expected = in_whole_numbers(corners, size, rule, CENTERS[center])
    found = drawn(clip_of_window(corners, size), size, "spans", fill_rule=rule, pixel_center=center)
    assert np.array_equal(found, expected)


@given(SEEDS, st.sampled_from(SIZES), st.sampled_from(RULES), st.sampled_from(list(CENTERS)), st.booleans())
def test_any_sign_of_w_is_drawn_as_by_the_other_fills(
    seed: int, size, rule: str, center: str, has_region: bool
) -> None:
    generator = np.random.default_rng(seed)
    clip = mixed(generator, 40, size)
    region = tuple(generator.integers(-5, 70, 4).tolist()) if has_region else None
    rules = {"fill_rule": rule, "pixel_center": center, "region": region}
    found = drawn(clip, size, "spans", **rules)
    assert np.array_equal(found, drawn(clip, size, "bounding-box", **rules))
    if size[0] * size[1] < 5000:
        assert np.array_equal(found, drawn(clip, size, "brute-force", **rules))


@given(homogeneous_triangles(12), st.sampled_from(RULES))
def test_many_homogeneous_triangles_at_once_are_exact(case, rule: str) -> None:
    clip, size = case
    found = np.zeros((len(clip), size[1], size[0]), int)
    np.add.at(found, tuple(drawn(clip, size, "spans", fill_rule=rule).T), 1)
    expected = [exact_coverage(triangle, size, rule) for triangle in clip]
    assert np.array_equal(found, np.stack(expected))


@pytest.mark.parametrize("beyond", [-1 / 256, 0.0, 1 / 256, 1.0])
@pytest.mark.parametrize("rule", RULES)
def test_corners_at_the_limit_and_past_it(beyond: float, rule: str) -> None:
    # A power of two, so that the corners come back without rounding.
    size, reach = (32, 16), LIMIT + beyond
    corners = [
        [(reach, 5.5), (3.5, reach), (-reach, 5.5)],
        [(2.5, 2.5), (reach, 2.5), (2.5, reach)],
        [(-reach, -reach), (reach, reach), (reach, reach - 1 / 256)],
        [(-reach, 10.5 - 1 / 256), (reach, 10.5), (reach, 10.5 + 1 / 256)],
        [(-reach, -reach), (20.5, 12.5), (reach, -reach)],
    ]
    clip = clip_of_window(corners, size)
    found = np.zeros((len(clip), size[1], size[0]), bool)
    found[tuple(drawn(clip, size, "spans", fill_rule=rule).T)] = True
    expected = [exact_coverage(triangle, size, rule) for triangle in clip]
    assert np.array_equal(found, np.stack(expected))


@pytest.mark.parametrize(
    "region",
    [
        (0, 0, 0, 0),
        (0, 0, 100, 0),
        (100, 63, 5, 5),
        (-5, -5, 5, 5),
        (-5, -5, 6, 6),
        (99, 62, 9, 9),
        (17, 0, 1, 63),
    ],
)
def test_regions_hold_their_part_of_the_picture(region: tuple[int, int, int, int]) -> None:
    size = (100, 63)
    clip = mixed(np.random.default_rng(3), 60, size)
    whole = drawn(clip, size, "spans")
    column, row, columns, rows = region
    inside = (whole[:, 1] >= row) & (whole[:, 1] < row + rows)
    inside &= (whole[:, 2] >= column) & (whole[:, 2] < column + columns)
    assert np.array_equal(drawn(clip, size, "spans", region=region), whole[inside])


@pytest.mark.parametrize("corner", [(0, 0), (8190, 8190), (16381, 16380)])
def test_a_raster_of_16384_pixels_is_exact(corner: tuple[int, int]) -> None:
    # Diagonals that pass centres closely, and a side that rises by 1/256 pixel over the whole width.
    size, region = (16384, 16384), (*corner, 3, 3)
    x, y = corner
    end = 16383.5 - 1 / 256
    clip = clip_of_window(
        [
            [(0.5, 0.5), (16383.5, end), (0.5, 16383.5)],
            [(0.5, 0.5), (65536, 65536), (-65536, 0)],
            [(-65536, y + 1.5 - 1 / 256), (65536, y + 1.5), (x, y + 40)],
            [(x + 1.5, -65536), (x + 1.5 - 1 / 256, 65536), (x - 40, y)],
        ],
        size,
    )
    expected = np.stack([exact_coverage(triangle, size, region=region) for triangle in clip])
    found = np.zeros(expected.shape, bool)
    primitive, row, column = drawn(clip, size, "spans", region=region).T
    found[primitive, row - corner[1], column - corner[0]] = True
    assert np.array_equal(found, expected)


def test_many_triangles_at_once() -> None:
    generator, size = np.random.default_rng(11), (203, 151)
    count = 50_000 if is_everything() else 4_000
    corners = generator.uniform(-2, np.array(size) + 2, (count, 1, 2)) + generator.normal(0, 2, (count, 3, 2))
    corners[::16] = np.round(corners[::16] * 2) / 2
    some = projected(generator, 600, size)
    corners[generator.choice(count, len(some), replace=False)] = some
    clip = clip_of_window(
        corners, size, generator.uniform(0.5, 3, (count, 3)), generator.uniform(-1, 1, (count, 3))
    )
    assert np.array_equal(drawn(clip, size, "spans"), drawn(clip, size, "bounding-box"))
    scene = ClipScene(clip[::8], size=size)
    for depth in table.names("depth"):
        frame = render(scene, Settings(fill="spans", depth=depth))
        usual = render(scene, Settings(depth=depth))
        assert np.array_equal(frame.primitive, usual.primitive)
        assert np.array_equal(frame.depth, usual.depth)


def test_no_triangles_and_none_with_pixels() -> None:
    size = (7, 5)
    nothing = np.zeros((0, 3, 4))
    point = np.full((3, 3, 4), 0.25) * [1, 1, 1, 4]
    for clip in (nothing, point):
        assert len(drawn(clip, size, "spans")) == 0
