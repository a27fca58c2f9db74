"""A picture shows the same triangle at every pixel, at the same depth, as the buffers of ``render``."""

import re

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from core import Settings, draw_picture
from core.methods import table
from core.spans.bands import BIG_AREA
from tests.core.fast_path.numbered import assert_same, numbered
from tests.core.spans.adversarial import SIZES, mixed, projected
from tests.core.strategies import clip_of_window
from tests.covering import every_pair, in_turns

SEEDS = st.integers(0, 2**32 - 1)
DEPTHS = st.sampled_from(table.names("depth"))


def in_view(generator: np.random.Generator, count: int, size: tuple[int, int]) -> np.ndarray:
    """Return clip positions (count, 3, 4), w > 0, of every family; depths from plane to plane, with ties."""
    z = generator.choice([-1.0, -0.5, 0.0, 0.25, 0.9999999, 1.0], (count, 3))
    level = generator.random(count) < 0.3
    z[level] = z[level, :1]
    corners = projected(generator, count, size)
    copied = generator.integers(0, count, count // 8)
    corners[copied], z[copied] = corners[copied - 1], z[copied - 1]
    return clip_of_window(corners, size, generator.choice([0.5, 1.0, 3.0], (count, 3)), z)


@example(2**32 - 1, (1, 1), 40, True, "z-float32", "bsp", "none", "homogeneous", "shared-edge", "half")
@example(901, (3, 257), 40, True, "z-float32", "ray-casting", "none", "homogeneous", "shared-edge", "half")
@given(
    SEEDS,
    st.sampled_from(SIZES),
    st.sampled_from([1, 2, 40]),
    st.booleans(),
    DEPTHS,
    st.sampled_from(table.names("visibility")),
    st.sampled_from(table.names("cull")),
    st.sampled_from(table.names("clipping")),
    st.sampled_from(table.names("fill_rule")),
    st.sampled_from(table.names("pixel_center")),
)
def test_picture_shows_what_the_buffers_hold(
    seed: int,
    size: tuple[int, int],
    count: int,
    is_mixed: bool,
    depth: str,
    visibility: str,
    cull: str,
    clipping: str,
    fill_rule: str,
    pixel_center: str,
) -> None:
    clip = (mixed if is_mixed else in_view)(np.random.default_rng(seed), count, size)
    chosen = Settings(
        depth=depth,
        visibility=visibility,
        cull=cull,
        clipping=clipping,
        fill_rule=fill_rule,
        pixel_center=pixel_center,
    )
    try:
        assert_same(clip, size, chosen)
    except ValueError as refusal:  # More pieces than may be drawn: the picture says the same.
        assert visibility == "bsp"
        with pytest.raises(ValueError, match=re.escape(str(refusal))):
            draw_picture(numbered(clip, size), chosen)


@given(
    SEEDS,
    st.tuples(st.integers(0, 99), st.integers(0, 62)),
    st.tuples(st.integers(0, 110), st.integers(0, 70)),
    st.booleans(),
    DEPTHS,
    st.sampled_from(table.names("visibility")),
)
def test_a_region_is_cut_out_of_the_whole_picture(
    seed: int, corner, extent, is_mixed: bool, depth: str, visibility: str
) -> None:
    clip = (mixed if is_mixed else in_view)(np.random.default_rng(seed), 30, (100, 63))
    assert_same(clip, (100, 63), Settings(depth=depth, visibility=visibility), (*corner, *extent))


@given(SEEDS, DEPTHS)
def test_the_order_of_triangles_changes_nothing_where_no_depths_tie(seed: int, depth: str) -> None:
    generator, size, count = np.random.default_rng(seed), (90, 70), 300
    corners = generator.uniform(-5, np.array(size) + 5, (count, 3, 2))
    clip = clip_of_window(
        corners, size, generator.uniform(1, 2, (count, 3)), generator.uniform(-0.9, 0.9, (count, 3))
    )
    order = generator.permutation(count)
    frame = assert_same(clip, size, Settings(depth=depth))
    shuffled = assert_same(clip[order], size, Settings(depth=depth))
    assert np.array_equal(shuffled.depth, frame.depth)
    same = np.append(order, -1)[shuffled.primitive] == frame.primitive
    if depth == "fixed-38":
        assert same.all()
    else:
        # Two float32 may tie where triangles meet: hardly ever.
        assert (~same).sum() <= 2


@every_pair(depth=table.names("depth"), visibility=["z-buffer", "last-drawn"], turned=[1, -1])
def test_a_tie_keeps_the_triangle_drawn_first(depth: str, visibility: str, turned: int) -> None:
    # The same triangle three times over, one of them the other way round.
    corners = [[(2.5, 1.5), (40, 3), (9, 30.5)]] * 3
    clip = clip_of_window(corners, (32, 32), 1.0, 0.3)
    clip[1] = clip[1, ::turned]
    frame = assert_same(clip, (32, 32), Settings(depth=depth, visibility=visibility))
    seen = frame.primitive[frame.primitive >= 0]
    assert (seen == (0 if visibility == "z-buffer" else 2)).all()


def with_area(area: float, at: np.ndarray, slant: float) -> np.ndarray:
    """Return the corners (3, 2) of a triangle of ``area`` pixels."""
    width = 300.0
    return at + np.array([[0.0, 0.0], [width, 0.0], [slant, 2 * area / width]])


@in_turns(depth=table.names("depth"), area=[BIG_AREA - 0.25, BIG_AREA, 3 * BIG_AREA])
def test_triangles_just_below_and_above_the_area_of_bands(depth: str, area: float) -> None:
    size = (310, 233)
    corners = [
        with_area(area, np.array([3.5, 2.5]), 0.0),
        with_area(area, np.array([5.25, 1.5]), 300.0),
        with_area(area, np.array([-90.0, -40.0]), 120.0),
        with_area(area, np.array([200.5, 100.5]), 7.0)[::-1],
    ]
    z = [[-0.5, 0.5, 0.2], [0.5, -0.5, 0.1], [0.0, 0.1, 0.2], [-0.1, 0.3, 0.0]]
    clip = clip_of_window(corners, size, [[1.0, 1.5, 0.5]], z)
    chosen = Settings(depth=depth)
    assert_same(clip, size, chosen)
    assert_same(clip, size, chosen, (37, 19, 101, 83))
    assert_same(clip[:1], size, chosen)


@pytest.mark.slow
@given(SEEDS, DEPTHS, st.booleans())
def test_large_ragged_triangles(seed: int, depth: str, has_region: bool) -> None:
    # Larger than the area of bands and often less than a pixel wide: rows without pixels in between.
    generator, size, count = np.random.default_rng(seed), (500, 400), 12
    direction = generator.normal(size=(count, 2))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    middle = generator.uniform(0, np.array(size), (count, 2))
    start, end = middle - 60_000 * direction, middle + generator.uniform(100, 60_000, (count, 1)) * direction
    side = direction[:, ::-1] * [1, -1] * generator.choice([0.4, 1.2, 3.0, 300.0], (count, 1))
    clip = clip_of_window(
        np.stack([start, end, middle + side], axis=1), size, 1.0, generator.uniform(-1, 1, (count, 3))
    )
    assert_same(clip, size, Settings(depth=depth), (50, 60, 333, 222) if has_region else None)


@pytest.mark.slow
def test_twenty_thousand_triangles() -> None:
    # More than walk together at a time; a few of them of every awkward kind.
    generator, size, count = np.random.default_rng(5), (151, 103), 20_000
    corners = generator.uniform(-2, np.array(size) + 2, (count, 1, 2)) + generator.normal(0, 2, (count, 3, 2))
    clip = clip_of_window(
        corners, size, generator.uniform(0.5, 2, (count, 3)), generator.uniform(-1, 1, (count, 3))
    )
    clip[::100], clip[50::100] = in_view(generator, 200, size), mixed(generator, 200, size)
    for depth in table.names("depth"):
        assert_same(clip, size, Settings(depth=depth))
