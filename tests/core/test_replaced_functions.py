"""A run takes functions: faulty twins of a tie rule, a depth test and a line method show wherever a run is shown."""

import pickle
from copy import deepcopy
from dataclasses import replace

import numpy as np
import pytest

from app.files.state_files import State, save_state
from app.files.state_scenes import StateFileError
from app.pages.step.ab.pictures import compare
from app.pages.step.ab.side_b import settings_difference
from app.session.document import Document, TeachingRaster
from core import ClipScene, Settings, draw_picture, render, trace
from core.depth.depth import WINDOW_DEPTH, DepthFormat, as_float32
from core.fast_path.workers.band_workers import BandWorkers
from core.framebuffer.display import to_display
from core.lines.bresenham import bresenham
from core.methods import table
from core.pixel_history import why
from tests.core.strategies import clip_of_window
from widgets.grid.compare_view import Side
from widgets.grid.layers import GridBuffer

SIZE = (8, 8)


def owns_all_ties(a, b):
    return np.ones(np.broadcast(a, b).shape, bool)


def keep_the_farther():
    return DepthFormat(WINDOW_DEPTH, "Reversed by mistake.", 0.0, True, as_float32)


def one_row_too_high(segments, last_pixel):
    run = bresenham(segments, last_pixel)
    return replace(run, row=run.row + 1)


def triangles(*corners, z=0.0) -> ClipScene:
    clip = clip_of_window(corners, SIZE, 1.0, 0.0)
    clip[..., 2] = np.broadcast_to(z, len(clip))[:, None]
    colors = np.linspace(0.2, 1.0, 9 * len(clip)).reshape(len(clip), 3, 3)
    return ClipScene(clip, colors, SIZE)


SQUARE = triangles([(1, 1), (7, 1), (7, 7)], [(1, 1), (7, 7), (1, 7)])
"""Its diagonal goes through pixel centres."""
LAYERS = triangles([(1, 1), (7, 1), (1, 7)], [(1, 1), (7, 1), (1, 7)], z=(-0.5, 0.5))
ROOF = triangles([(1.5, 1.5), (6.5, 1.5), (4.5, 5.5)])
TWINS = {
    "fill_rule": (SQUARE, Settings(), owns_all_ties),
    "depth": (LAYERS, Settings(), keep_the_farther),
    "line": (ROOF, Settings(polygon_mode="wireframe"), one_row_too_high),
}


@pytest.fixture(params=TWINS)
def twin(request):
    """Scene, settings, the settings that run the twin; the table must not have changed after."""
    before = [(method.family, method.name, method.function) for method in table]
    scene, settings, function = TWINS[request.param]
    yield scene, settings, settings.replaced(**{request.param: function})
    assert [(method.family, method.name, method.function) for method in table] == before


def test_a_twin_is_seen_in_the_picture_and_in_the_difference(twin):
    scene, settings, faulty = twin
    right, wrong = render(scene, settings), render(scene, faulty)
    assert not np.array_equal(right.cover_count, wrong.cover_count) or not np.array_equal(
        right.primitive, wrong.primitive
    )
    buffer = "primitive" if (right.primitive != wrong.primitive).any() else "cover_count"
    sides = [
        Side(name, "", buffer=GridBuffer(buffer, getattr(frame, buffer), "ids"))
        for name, frame in (("A", right), ("B", wrong))
    ]
    assert not compare(*sides)[2].sentence.startswith("0 of")
    assert settings_difference(settings, faulty).endswith("(replaced)")
    assert not settings_difference(faulty, faulty)


def test_the_trace_of_a_twin_ends_at_its_picture(twin):
    scene, settings, faulty = twin
    found, rows = render(scene, faulty), trace(scene, faulty)
    for stage, track, buffer in (("depth", "depth", found.depth), ("raster", "overdraw", found.cover_count)):
        traced = rows.stage(stage)
        shown = traced.state(traced.steps.count)[track]
        np.testing.assert_array_equal(shown, buffer)
    usual = trace(scene, settings)
    assert any(not _have_same_rows(usual.stage(stage), rows.stage(stage)) for stage in ("raster", "depth"))
    assert rows.stage("raster").method == usual.stage("raster").method


def _have_same_rows(first, second) -> bool:
    return all(
        np.array_equal(first.columns[name], second.columns[name], equal_nan=True) for name in first.columns
    )


def test_the_history_of_every_pixel_is_that_of_the_twin(twin):
    scene, settings, faulty = twin
    found = render(scene, faulty)
    source = trace(scene, faulty).source
    differs = (found.primitive != render(scene, settings).primitive) | (
        found.cover_count != render(scene, settings).cover_count
    )
    assert differs.any()
    for row, column in np.argwhere(differs).tolist():
        history = why(source, column, row)
        assert history.cover_count == found.cover_count[row, column]
        last = [event for event in history.fragments if not event.is_rejected]
        assert (last[-1].triangle if last else -1) == found.primitive[row, column]


def test_fast_paths_draw_what_the_twin_draws(twin):
    scene, _, faulty = twin
    pixels = to_display(render(scene, faulty).color).pixels
    np.testing.assert_array_equal(draw_picture(scene, faulty).pixels, pixels)
    for antialiasing in ("ssaa-4", "msaa-4"):
        smooth = replace(faulty, antialiasing=antialiasing)
        np.testing.assert_array_equal(
            draw_picture(scene, smooth).pixels, to_display(render(scene, smooth).color).pixels
        )
    with BandWorkers(2, always=True) as workers:
        np.testing.assert_array_equal(workers.draw(scene, faulty).pixels, pixels)
        assert workers.sharing.reason == "a replaced function stays in this process"


def test_two_functions_are_two_settings(twin):
    _, settings, faulty = twin
    (family, method), *_ = faulty.replacements.items()
    assert getattr(faulty, family) == getattr(settings, family)
    assert faulty != settings
    assert settings != faulty
    assert len({faulty, settings, deepcopy(faulty)}) == 2
    assert faulty == settings.replaced(**{family: method.function}) == pickle.loads(pickle.dumps(faulty))
    assert faulty != settings.replaced(**{family: lambda *_: None})
    assert replace(faulty, **{family: getattr(settings, family)}) == settings
    assert method.needs == table.get(family, method.name).needs


def test_a_twin_is_not_saved(twin, tmp_path):
    scene, _, faulty = twin
    with pytest.raises(StateFileError, match="runs a replaced function"):
        save_state(tmp_path / "state.rscope", State(Document(scene, TeachingRaster(*SIZE), settings=faulty)))


def test_a_row_in_the_place_of_a_method_has_its_name():
    row = table.get("line", "dda")
    with pytest.raises(ValueError, match="must have that family and name"):
        Settings().replaced(line=row)
    mine = replace(table.get("line", "bresenham"), function=one_row_too_high, title="Mine")
    assert table.get("line", Settings().replaced(line=mine).line) is mine


def test_a_closed_form_does_not_stand_in_for_an_opaque_twin():
    def half(source, there):
        return (source + there) / 2

    scene = LAYERS
    mixed = render(scene, Settings().replaced(blend=half)).color
    assert not np.array_equal(mixed, render(scene).color)
    np.testing.assert_array_equal(mixed, trace(scene, Settings().replaced(blend=half)).source.picture.color)
