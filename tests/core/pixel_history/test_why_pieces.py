"""The history of a pixel of exact areas: its areas and colours are those of the picture."""

import numpy as np
import pytest

from core import ClipScene, Settings, render
from core.pixel_history.fragments import pixel_pieces
from core.trace.source import TraceSource
from tests.covering import in_turns

AREA = Settings(antialiasing="area")


def random_scene(seed: int) -> ClipScene:
    source = np.random.default_rng(seed)
    clip = source.uniform(-1.5, 1.5, (5, 3, 4))
    clip[..., 2] *= 0.5
    clip[..., 3] = source.uniform(0.5, 1.5, (5, 3))
    colors = np.concatenate([source.uniform(0, 1, (5, 3, 3)), np.full((5, 3, 1), 0.5)], axis=2)
    return ClipScene(clip, colors, size=(6, 5))


@in_turns(
    settings=[
        AREA,
        Settings(antialiasing="area", blend="over"),
        Settings(antialiasing="area", visibility="last-drawn"),
        Settings(antialiasing="area", clipping="sutherland-hodgman"),
    ],
    seed=range(4),
)
def test_the_last_colour_is_that_of_the_picture(seed: int, settings: Settings) -> None:
    scene = random_scene(seed)
    color = render(scene, settings).color
    source = TraceSource(scene, settings)
    for row in range(5):
        for column in range(6):
            found = pixel_pieces(source, column, row)
            shown = found.events[-1].after if found.events else found.background_color
            assert (shown == color[row, column]).all()
            assert found.background + sum(event.seen for event in found.events) == pytest.approx(1)
            for event in found.events:
                assert -1e-12 <= event.seen <= event.passed + 1e-12
                assert event.passed <= event.area + 1e-12
                assert event.area <= 1 + 1e-12
                assert np.isfinite(event.color).all() == (event.passed > 0)
            touching = {event.triangle for event in found.events}
            assert found.untouching_count == len(scene.clip) - len(touching)


def test_one_triangle_has_the_area_that_it_covers() -> None:
    # The left half of pixel (0, 0), in front of all of it.
    half = [[-1, -1, 0, 1], [-0.5, -1, 0, 1], [-0.5, 3, 0, 1]]
    left = [[-1, -1, 0, 1], [-0.5, 3, 0, 1], [-1, 3, 0, 1]]
    behind = [[-1, -1, 0.5, 1], [3, -1, 0.5, 1], [-1, 3, 0.5, 1]]
    scene = ClipScene([half, left, behind], size=(2, 2))
    found = pixel_pieces(TraceSource(scene, AREA), 0, 0)
    first, second, last = found.events
    assert first.area + second.area == pytest.approx(0.5)
    assert (last.area, last.passed, last.seen) == pytest.approx((1.0, 0.5, 0.5))
    assert found.background == pytest.approx(0)
    assert found.untouching_count == 0


def test_outlines_have_no_pieces_and_bad_pixels_are_told() -> None:
    scene = random_scene(0)
    outlined = Settings(antialiasing="area", polygon_mode="wireframe")
    assert pixel_pieces(TraceSource(scene, outlined), 0, 0) is None
    with pytest.raises(ValueError, match=r"inside the 6x5 image, got \(6, 0\)"):
        pixel_pieces(TraceSource(scene, AREA), 6, 0)
