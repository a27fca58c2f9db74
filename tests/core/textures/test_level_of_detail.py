"""Slopes against exact derivatives, the level of detail, and pictures minified by mipmaps."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from core import ClipScene, Settings, Texture, render
from core.coverage.fills import Fragments
from core.coverage.pixel_runs import make_raster
from core.coverage.snapping import place_corners
from core.interpolation.interpolation import interpolate, set_up_planes
from core.methods import table
from core.records.frame import StageCount
from core.records.primitives import CornerValues, own_corners
from core.stages.declared import STAGES
from core.stages.fragments import texture_slopes
from core.stages.vertices import process_geometry
from core.textures.footprints import footprint_means, uv_slopes
from core.textures.look_up import texture_colors
from core.textures.mipmaps import choose_levels, mipmap_colors, mipmap_levels, sample_mipmaps
from core.trace.source import TraceSource
from tests.core.exact_reference import determinant, homogeneous_window
from tests.core.strategies import perspective_triangles
from tests.core.textures.test_footprint_mean import slope_footprint

MIPMAPPED = ["trilinear", "mipmap-nearest"]
UV = np.array([[0.25, 0.0], [1.5, 0.125], [0.0, 2.0]])
RANDOM = Texture(np.random.default_rng(4).random((24, 32, 3)).astype(np.float32))


def corner_values(uv: np.ndarray) -> CornerValues:
    return CornerValues(uv.reshape(-1, 2), {"uv": slice(0, 2)}, own_corners(np.arange(len(uv) // 3)))


def slopes_at(
    homogeneous: np.ndarray, x: np.ndarray, y: np.ndarray, mode: str, uv: np.ndarray = UV
) -> np.ndarray:
    planes, primitive = set_up_planes(homogeneous[None]), np.zeros(len(x), np.int64)
    _, values = interpolate(planes, uv[None], primitive, x, y, mode, "last")
    return uv_slopes(planes, corner_values(uv), primitive, x, y, values, mode)


def exact_slopes(corners, uv, x: Fraction, y: Fraction, is_affine: bool) -> list[Fraction]:
    """Return du/dx, dv/dx, du/dy, dv/dy by the quotient rule, in fractions."""
    pixel = (x, y, Fraction(1))
    right = (Fraction(1), Fraction(0), Fraction(0))
    up = (Fraction(0), Fraction(1), Fraction(0))

    def parts(point):
        scale = [corner[2] if is_affine else Fraction(1) for corner in corners]
        return [scale[k] * determinant(*corners[:k], point, *corners[k + 1 :]) for k in range(3)]

    n, rises = parts(pixel), (parts(right), parts(up))
    slopes = []
    for rise in rises:
        for axis in range(2):
            value = [Fraction(float(corner[axis])) for corner in uv]
            top, whole = sum(a * b for a, b in zip(n, value, strict=True)), sum(n)
            d_top, d_whole = sum(a * b for a, b in zip(rise, value, strict=True)), sum(rise)
            slopes.append((d_top * whole - top * d_whole) / whole**2)
    return slopes


@given(
    perspective_triangles(1),
    st.integers(0, 15),
    st.integers(0, 15),
    st.sampled_from(["perspective", "affine"]),
)
def test_slopes_are_the_derivatives(case, column, row, mode) -> None:
    clip, size = case
    corners = [homogeneous_window(corner, size) for corner in clip[0]]
    assume(abs(determinant(*corners)) > Fraction(1, 10))
    x, y = Fraction(2 * column + 1, 2), Fraction(2 * row + 1, 2)
    whole = determinant(*corners)
    inverse_w = (
        sum(determinant(*corners[:k], (x, y, Fraction(1)), *corners[k + 1 :]) for k in range(3)) / whole
    )
    assume(abs(inverse_w) > Fraction(1, 100))
    homogeneous = place_corners(clip, size, "snapped").homogeneous[0]
    found = slopes_at(homogeneous, np.array([float(x)]), np.array([float(y)]), mode)[:, 0]
    expected = np.array([float(value) for value in exact_slopes(corners, UV, x, y, mode == "affine")])
    assert np.allclose(found, expected, rtol=1e-7, atol=1e-7 * max(np.abs(expected).max(), 1))


TILTED = np.array([[0.0, 0, 1], [40, 4, 2], [30, 120, 4]])


def test_slopes_of_one_w_are_those_of_the_plane() -> None:
    flat_on = np.array([[0.0, 0, 1], [16, 0, 1], [0, 8, 1]])
    uv = np.array([[0.0, 0], [1, 0], [0, 1]])
    x, y = np.array([1.5, 3.5]), np.array([0.5, 2.5])
    for mode in ("perspective", "affine", "affine-n"):
        assert np.allclose(
            slopes_at(flat_on, x, y, mode, uv).T, [1 / 16, 0, 0, 1 / 8], rtol=1e-14, atol=1e-17
        )


def test_one_corners_value_has_no_slope_and_reads_the_texture_itself() -> None:
    slopes = slopes_at(TILTED, np.array([20.5]), np.array([30.5]), "flat")
    assert not slopes.any()
    choice = choose_levels(slopes, (32, 24), 6, "trilinear")
    assert choice.lod[0] == -np.inf
    assert (choice.level[0], choice.near[0], choice.fraction[0]) == (0, 0, 0)


@pytest.mark.parametrize("mode", ["perspective", "affine", "affine-n", "flat"])
def test_slopes_do_not_depend_on_the_batch(mode) -> None:
    generator = np.random.default_rng(2)
    x, y = generator.integers(0, 40, (2, 20000)) + 0.5
    together = slopes_at(TILTED, x, y, mode)
    for k in (0, 1, 777, 8191, 8192, 19999):
        assert np.array_equal(together[:, k], slopes_at(TILTED, x[k : k + 1], y[k : k + 1], mode)[:, 0])
    lengths = choose_levels(together, (32, 24), 6, "trilinear")
    alone = choose_levels(together[:, 5:6], (32, 24), 6, "trilinear")
    assert lengths.lod[5] == alone.lod[0]


def test_levels_of_detail_by_hand() -> None:
    # A pixel to the right leads 2, 3 or 1/2 texels on, one up less.
    slopes = np.array([[2.0, 3, 0.5, 0, np.inf, np.nan], [0.0] * 6, [0.0] * 6, [0.1] * 5 + [0.0]]) / 8
    slopes[:, 3] = 0
    choice = choose_levels(slopes, (8, 8), 4, "trilinear")
    assert choice.lod[:3].tolist() == [1.0, np.log2(3.0), -1.0]
    assert choice.near.tolist() == [1, 1, 0, 0, 3, 0]
    assert choice.far.tolist() == [2, 2, 1, 1, 3, 1]
    assert choice.fraction.tolist() == [0, np.log2(3.0) - 1, 0, 0, 0, 0]


def test_the_nearest_level_is_the_finer_one_halfway() -> None:
    lod = np.array([0.0, 0.5, 0.5001, 1.4999, 1.5, 1.6, 2.5, 3.0])
    slopes = np.zeros((4, len(lod)))
    slopes[2] = 2.0**lod / 8
    near = choose_levels(slopes, (8, 8), 4, "mipmap-nearest").near
    assert near.tolist() == [0, 0, 1, 1, 1, 2, 2, 3]


@pytest.mark.parametrize("texture_filter", MIPMAPPED)
def test_where_nothing_is_made_smaller_it_is_bilinear(texture_filter) -> None:
    uv = np.random.default_rng(1).uniform(-2, 3, (500, 2))
    slopes = np.full((4, 500), 1 / 64)
    found = mipmap_colors(RANDOM, uv, slopes, texture_filter, "mirror")
    assert np.array_equal(found, texture_colors(RANDOM, uv, "bilinear", "mirror"))


def test_between_two_levels_both_are_mixed() -> None:
    uv, slopes = np.random.default_rng(1).uniform(-2, 3, (300, 2)), np.zeros((4, 300))
    slopes[0] = 2.0**1.25 / 32
    levels = mipmap_levels(RANDOM)
    fine, coarse = (texture_colors(level, uv, "bilinear", "repeat") for level in levels[1:3])
    choice = choose_levels(slopes, (32, 24), len(levels), "trilinear")
    share = choice.fraction[:, None]
    assert np.allclose(share, 0.25, atol=1e-15)
    assert np.array_equal(mipmap_colors(RANDOM, uv, slopes), fine * (1 - share) + coarse * share)


@pytest.mark.parametrize("texture_filter", MIPMAPPED)
def test_the_record_is_that_of_the_colours(texture_filter) -> None:
    generator = np.random.default_rng(3)
    uv, slopes = generator.uniform(-1, 2, (20000, 2)), generator.uniform(-0.3, 0.3, (4, 20000)) ** 3
    read = sample_mipmaps(RANDOM, uv, slopes, texture_filter, "clamp")
    colors = mipmap_colors(RANDOM, uv, slopes, texture_filter, "clamp")
    assert np.array_equal(read.color, colors)
    share = read.choice.fraction[:, None]
    assert np.array_equal(colors, read.near.samples.color * (1 - share) + read.far.samples.color * share)
    for k in (0, 9000, 19999):
        alone = mipmap_colors(RANDOM, uv[k : k + 1], slopes[:, k : k + 1], texture_filter, "clamp")
        assert np.array_equal(colors[k : k + 1], alone)


def test_an_even_texture_stays_even() -> None:
    even = Texture(np.full((9, 5, 1), 0.3, np.float32))
    generator = np.random.default_rng(3)
    colors = mipmap_colors(even, generator.uniform(-1, 2, (500, 2)), generator.uniform(-2, 2, (4, 500)))
    assert np.allclose(colors[:, 0], 0.3, rtol=1e-6)


def test_filters_are_told_apart() -> None:
    uv, slopes = np.zeros((1, 2)), np.zeros((4, 1))
    for name in MIPMAPPED:
        with pytest.raises(
            ValueError, match=rf"^texture_filter must be one that reads the texture itself, got {name}$"
        ):
            texture_colors(RANDOM, uv, name)
    with pytest.raises(ValueError, match=r"^texture_filter must be one that reads mipmaps, got nearest$"):
        mipmap_colors(RANDOM, uv, slopes, "nearest")
    assert mipmap_colors(RANDOM, np.empty((0, 2)), np.empty((4, 0))).shape == (0, 4)
    assert sample_mipmaps(RANDOM, np.empty((0, 2)), np.empty((4, 0))).color.shape == (0, 4)


def fragments_and_slopes(scene: ClipScene, **chosen):
    source = TraceSource(scene, Settings(texture_filter="trilinear", **chosen))
    return source, source.uv_slopes


@pytest.mark.parametrize("chosen", [{}, {"polygon_mode": "wireframe"}, {"clipping": "sutherland-hodgman"}])
def test_through_the_eye_levels_stay_within_the_pyramid(chosen) -> None:
    clip = [
        [[-1, -1, 0, 1], [1, -1, 0, 1], [0, -0.4, 0, -0.2]],
        [[-1, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 0]],
    ]
    scene = ClipScene(clip, np.tile(UV, (2, 1, 1)), (16, 12), RANDOM)
    source, slopes = fragments_and_slopes(scene, **chosen)
    assert slopes is not None
    choice = choose_levels(slopes, (32, 24), 6, "trilinear")
    assert ((choice.level >= 0) & (choice.level <= 5)).all()
    assert np.isfinite(render(scene, source.settings).color).all()


@pytest.mark.parametrize("interpolation", ["perspective", "affine"])
def test_slopes_along_a_line_are_differences_of_neighbours(interpolation) -> None:
    clip = [[[-0.9, -0.8, 0, 1], [2.7, -2.1, 0, 3], [0.4, 1.8, 0, 2]]]
    scene = ClipScene(clip, UV[None], (400, 300), RANDOM)
    source, slopes = fragments_and_slopes(scene, polygon_mode="wireframe", interpolation=interpolation)
    fragments, uv = source.fragments, source.interpolated[1]
    checked = 0
    for k in range(2, len(fragments) - 2):
        # The first and the last pixel of a segment may take the value of its end.
        if fragments.segment[k - 2] != fragments.segment[k + 2]:
            continue
        steps = fragments.column[k + 1] - fragments.column[k - 1], fragments.row[k + 1] - fragments.row[k - 1]
        major = (
            int(abs(steps[1]) > abs(steps[0]))
            if abs(steps[0]) != abs(steps[1])
            else int(np.any(slopes[2:, k]))
        )
        assert not slopes[2 - 2 * major : 4 - 2 * major, k].any()
        difference = (uv[k + 1] - uv[k - 1]) / steps[major]
        assert np.allclose(slopes[2 * major : 2 * major + 2, k], difference, rtol=2e-2, atol=1e-5)
        checked += 1
    assert checked > 500


def checkered_floor(size: tuple[int, int] = (120, 90)) -> ClipScene:
    """Return a checkered floor that reaches far away, 128 by 128 texels, in two triangles."""
    board = np.indices((128, 128)).sum(axis=0) % 2
    texture = Texture(board[..., None].astype(np.float32))
    near, far, low = 1.0, 40.0, 0.9
    corners = np.array([[-1, -low, 0, near], [1, -low, 0, near], [far, -low, 0, far], [-far, -low, 0, far]])
    uv = np.array([[0.0, 0], [1, 0], [1, 4], [0, 4]])
    order = [[0, 1, 2], [0, 2, 3]]
    return ClipScene(corners[order], uv[order], size, texture)


def test_minified_trilinear_is_nearer_to_the_mean_over_the_footprint_than_bilinear() -> None:
    scene = checkered_floor()
    source, slopes = fragments_and_slopes(scene)
    assert slopes is not None
    assert scene.texture is not None
    uv = source.interpolated[1][:, :2]
    means = footprint_means(scene.texture, slope_footprint(uv * 128, slopes * 128))[:, 0]
    minified = choose_levels(slopes, (128, 128), 8, "trilinear").lod > 1
    assert minified.sum() > 1000
    error = {}
    for name in table.names("texture_filter"):
        color = render(scene, Settings(texture_filter=name)).color[..., 0]
        found = color[source.fragments.row, source.fragments.column]
        error[name] = np.abs(found - means)[minified].mean()
    assert error["trilinear"] < 0.05
    assert error["mipmap-nearest"] < 0.05
    assert error["bilinear"] > 5 * error["trilinear"]
    assert error["nearest"] > 5 * error["trilinear"]


def test_without_mipmaps_or_a_texture_no_slopes_are_computed() -> None:
    scene = checkered_floor((8, 6))
    for settings, of_scene in (
        (Settings(), scene),
        (Settings(texture_filter="trilinear"), ClipScene(scene.clip, scene.attributes, (8, 6))),
    ):
        geometry = process_geometry(of_scene, settings, {stage: StageCount() for stage in STAGES})
        raster = make_raster((8, 6), "half")
        place = np.array([0]), np.array([4]), np.array([1])
        assert texture_slopes(geometry, raster, Fragments(*place), np.zeros((1, 4))) is None
