"""FXAA: its listings give the trace, and the trace the picture; it changes edges alone, and turns with the picture."""

import numpy as np
import pytest

from core import Settings, render, trace
from core.antialiasing.fxaa import DETAIL_SHARE, edge_pixel, mixed_byte, smooth_edges, steps_to_end
from core.coverage.pixel_runs import Raster
from core.framebuffer.display import linear_light, srgb, to_display
from core.pipeline import draw
from lessons.scenes import make_scene

FXAA = Settings(antialiasing="fxaa")


def grey(shown: np.ndarray) -> np.ndarray:
    """Return the picture (h, w, 4) that shows sRGB values (h, w)."""
    linear = linear_light(shown).astype(np.float32)
    return np.dstack([linear, linear, linear, np.ones_like(linear)])


def filtered(shown: np.ndarray) -> np.ndarray:
    return srgb(smooth_edges(grey(shown)).color[..., 0].astype(float))


def test_the_listings_give_the_rows_and_the_rows_the_picture() -> None:
    scene = make_scene("single-triangle")
    found = trace(scene, FXAA).stage("resolve")
    frame, c = render(scene, FXAA), found.columns
    assert np.array_equal(found.state(found.steps.count)["display"], to_display(frame.color).pixels)
    for row in range(found.steps.row_count):
        is_edge = found.kind_of(row) == "smoothed"
        back, forth = c["back"][row].tolist(), c["forth"][row].tolist()
        horizontal, side, offset = edge_pixel(c["around"][row].tolist(), back, forth)
        assert (horizontal, side, offset) == (c["is_horizontal"][row], c["side"][row], c["offset"][row])
        assert is_edge == (side != 0)
        if is_edge:
            pair, step = float(c["pair"][row]), float(c["step"][row])
            assert steps_to_end(back, pair, step) == c["steps_back"][row]
            assert steps_to_end(forth, pair, step) == c["steps_forth"][row]
            channels = zip(c["encoded"][row].tolist(), c["other"][row].tolist(), strict=False)
            assert [mixed_byte(own, other, offset) for own, other in channels] == c["bytes"][row, :3].tolist()


def test_a_part_of_the_picture_is_that_of_the_whole() -> None:
    scene = make_scene("single-triangle")
    whole = render(scene, FXAA)
    part = draw(scene, FXAA, Raster(*scene.size, 0.5, region=(20, 10, 9, 7)))
    assert np.array_equal(part.color, whole.color[10:17, 20:29])
    assert np.array_equal(part.primitive, whole.primitive[10:17, 20:29])


def test_only_edges_change_and_a_ramp_is_none() -> None:
    ramp = np.tile(np.linspace(0.2, 0.8, 32), (8, 1))
    assert np.array_equal(smooth_edges(grey(ramp)).color, grey(ramp))
    blocks = np.kron(np.random.default_rng(1).random((6, 6)), np.ones((5, 5)))
    found = smooth_edges(grey(blocks))
    is_changed = (found.color != grey(blocks)).any(axis=2)
    assert is_changed.any()
    assert set(np.flatnonzero(is_changed)) <= set(found.edges.place)
    assert (found.contrast >= found.threshold).ravel()[found.edges.place].all()


def test_it_turns_with_the_picture() -> None:
    blocks = np.kron(np.random.default_rng(2).random((5, 5)), np.ones((4, 4)))
    turned = np.rot90(filtered(np.rot90(blocks)), -1)
    assert np.abs(turned - filtered(blocks)).max() < 1e-6


@pytest.mark.parametrize(("slope", "beats"), [(1 / 16, True), (1 / 2, False)])
def test_it_beats_four_samples_on_an_edge_that_is_nearly_level(slope: float, beats: bool) -> None:
    """As the shares of both colours that the screen shows, against the exact share."""
    size = 48
    fine = (np.arange(16) + 0.5) / 16

    def half_plane(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        xs, ys = np.meshgrid(np.arange(size)[:, None] + x, np.arange(size)[:, None] + y)
        return (ys < 20.3 + slope * xs).astype(float)

    def mean_of(places: np.ndarray) -> np.ndarray:
        covered = half_plane(places, places)
        n = len(places)
        return covered.reshape(size, n, size, n).mean(axis=(1, 3))

    exact, one, four = mean_of(fine), mean_of(np.array([0.5])), mean_of(np.array([0.25, 0.75]))
    inner = np.s_[4:-4, 14:-14]

    def error(picture: np.ndarray) -> float:
        return float(np.sqrt(((picture - exact)[inner] ** 2).sum()))

    assert (error(filtered(one)) < error(four)) == beats
    assert error(filtered(one)) < error(one)


def test_it_destroys_detail_of_one_pixel() -> None:
    dot = np.zeros((9, 9))
    dot[4, 4] = 1
    assert abs(filtered(dot)[4, 4] - (1 - DETAIL_SHARE)) < 1e-6
    board = np.indices((12, 12)).sum(axis=0) % 2 * 1.0
    assert np.ptp(filtered(board)[3:-3, 3:-3]) < 0.2


def test_green_counts_most_blue_least_and_what_is_no_number_counts_as_0() -> None:
    picture = np.zeros((3, 4, 4), np.float32)
    picture[1, :3, :3] = np.eye(3)
    picture[..., 3] = 1
    np.testing.assert_allclose(smooth_edges(picture).luma[1], [0.299, 0.587, 0.114, 0], atol=1e-9)
    odd = picture.copy()
    odd[1, 3, 0] = np.nan
    assert np.array_equal(smooth_edges(odd).luma, smooth_edges(picture).luma)
