"""Pictures in other numbers than spans are made for: drawn by the plain path, pixel for pixel as ``render``."""

import numpy as np
import pytest

from core import ClipScene, Settings, draw_picture, render, trace
from core.fast_path.draw import is_drawn_by_spans
from core.framebuffer.display import to_display
from core.methods import table
from core.pixel_history import why
from tests.core.strategies import clip_of_window
from tests.covering import every_nth, in_turn

SIZE = (300, 40)
SPANS = ("snapped", "float64")


def scene() -> ClipScene:
    """Return triangles with long sides, in front of the eye and through it."""
    generator = np.random.default_rng(4)
    points = np.stack([generator.uniform(-20, 320, (12, 3)), generator.uniform(-5, 45, (12, 3))], axis=2)
    clip = clip_of_window(points, SIZE, generator.choice([0.5, 1.0, 3.0], (12, 3)), 0.2)
    clip[::5, 0, 3] = -1
    return ClipScene(clip, generator.random((12, 3, 4)), SIZE)


@pytest.mark.parametrize(
    ("coverage", "fill"), in_turn(table.names("coverage"), ["spans", "incremental", "blocks"])
)
def test_a_picture_is_what_render_draws(coverage: str, fill: str) -> None:
    settings = Settings(coverage=coverage, fill=fill)
    drawn = draw_picture(scene(), settings)
    assert np.array_equal(drawn.pixels, to_display(render(scene(), settings).color).pixels)
    assert is_drawn_by_spans(settings) == (fill == "spans" and coverage in SPANS)
    part = draw_picture(scene(), settings, region=(70, 11, 90, 13))
    assert np.array_equal(part.pixels, drawn.pixels[11:24, 70:160])


@pytest.mark.parametrize("coverage", table.names("coverage"))
def test_a_fill_that_was_replaced_is_named(coverage: str) -> None:
    frame = render(scene(), Settings(coverage=coverage, fill="spans"))
    assert frame.statistics["raster"].note == ("" if coverage in SPANS else "spans")
    assert render(scene(), Settings(coverage=coverage, fill="blocks")).statistics["raster"].note == ""


@pytest.mark.parametrize("coverage", ["fixed-24.8", "int64"])
def test_whole_numbers_have_clipping_inserted_where_a_corner_is_behind_the_eye(coverage: str) -> None:
    frame = render(scene(), Settings(coverage=coverage))
    assert frame.statistics["clip"].note == coverage


@pytest.mark.parametrize("fill", every_nth(["spans", "incremental"], 2))
@pytest.mark.parametrize("coverage", table.names("coverage"))
def test_the_history_of_a_pixel_ends_with_what_the_picture_shows(coverage: str, fill: str) -> None:
    settings = Settings(coverage=coverage, fill=fill)
    frame, source = render(scene(), settings), trace(scene(), settings).source
    for column, row in ((150, 20), (30, 5), (260, 33), (299, 0), (77, 12)):
        history = why(source, column, row)
        shown = [event.after for event in history.events if event.after is not None][-1]
        assert shown.triangle == frame.primitive[row, column]
