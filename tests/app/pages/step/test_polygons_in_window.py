"""Polygons in the window: corners dragged and typed, steps and tables, clipping, saved states, refused settings."""

from pathlib import Path

import numpy as np
import pytest

from app.files.state_files import load_state, save_state
from app.pages.step.grid_overlays import polygon_overlays, step_mark
from app.pages.step.scene_values import outline
from app.pages.step.setting_records import settings_records
from app.session.document import STEPPED, open_document
from app.window.main_window import MainWindow
from core import ClipScene
from core.records.steps import Level
from core.setting_texts import settings_from_texts
from lessons.scene_edits import set_value
from lessons.scenes import built_in_scene

pytestmark = pytest.mark.shared_window


def open_scene(window: MainWindow, name: str) -> None:
    """Open a built-in scene with its settings."""
    found = built_in_scene(name)
    window.session.open(
        open_document(found.make(), name, settings=settings_from_texts(found.settings, STEPPED))
    )


def polygon_of(window: MainWindow) -> ClipScene:
    scene = window.session.document.scene
    assert isinstance(scene, ClipScene)
    return scene


@pytest.mark.slow
def test_every_view_shows_a_polygon(window: MainWindow) -> None:
    open_scene(window, "polygon-holes")
    for stage in ("transform", "clip", "raster"):
        window.session.set_stage(stage, 0)
        window.session.step(1)
        for name in window.page.main_area.view_names():
            window.page.main_area.show_view(name)
    assert len(window.page.grids.geometry.focus_vertices) == 14
    assert window.page.grids.geometry.rings == (0, 7, 11)


def test_a_corner_is_dragged_and_typed_and_rings_stay(window: MainWindow) -> None:
    open_scene(window, "polygon-holes")
    window.page.grid.vertex_dragged.emit(8, 20.0, 18.0)
    window.page.grid.vertex_drag_finished.emit(8)
    scene = polygon_of(window)
    assert (scene.clip[0, 8, :2] + 1) * (16, 12) == pytest.approx([20, 18])
    assert scene.rings is not None
    assert scene.rings.tolist() == [0, 7, 11]
    typed = set_value(scene, "corner/0/13/x", 27.0, scene.size)
    assert isinstance(typed, ClipScene)
    assert (typed.clip[0, 13, 0] + 1) * 16 == pytest.approx(27)
    groups = outline(scene, 0, scene.size)
    assert groups[0].title == "Polygon 0"
    assert len(groups[0].rows) == 14


def test_a_polygon_is_saved_with_rings_and_window(window: MainWindow, tmp_path: Path) -> None:
    open_scene(window, "weiler-atherton")
    path = tmp_path / "a.rasterscope"
    save_state(path, window.files.state())
    again, _ = load_state(path)
    scene, saved = polygon_of(window), again.document.scene
    assert isinstance(saved, ClipScene)
    for name in ("clip", "rings", "clip_region", "region_rings"):
        assert np.array_equal(getattr(scene, name), getattr(saved, name))
    assert again.document.settings.polygon_clipping == "weiler-atherton"


def test_clipping_is_marked_step_by_step(window: MainWindow) -> None:
    open_scene(window, "weiler-atherton")
    session = window.session
    session.set_stage("clip", 0)
    assert window.page.main_area.current_view() == "pixels"
    lengths = []
    for _ in range(6):
        session.step(1, Level.PIXEL)
        mark = step_mark(session.moment)
        assert len(mark.lines) or len(mark.points)
        overlays = polygon_overlays(session.moment)
        lengths.append(sum(len(overlay.segments) for overlay in overlays))
    assert lengths == sorted(lengths)
    assert lengths[-1] > lengths[0]


def test_rings_that_cross_are_refused_by_weiler_atherton(window: MainWindow) -> None:
    open_scene(window, "pentagram")
    (record,) = (r for r in settings_records(window.session.document) if r.family == "polygon_clipping")
    (choice,) = (choice for choice in record.choices if choice.refusal)
    assert choice.value == "weiler-atherton"
    assert choice.refusal.startswith("It needs rings that do not cross or touch: side 0 of ring 0")
    with pytest.raises(ValueError, match="weiler-atherton needs rings that do not cross or touch: side 0"):
        window.session.set_setting("polygon_clipping", "weiler-atherton")


def test_a_window_that_is_not_convex_is_refused_by_sutherland_hodgman(window: MainWindow) -> None:
    open_scene(window, "weiler-atherton")
    before = window.session.document
    records = {record.family: record for record in settings_records(before)}
    refused = {choice.value for choice in records["polygon_clipping"].choices if choice.refusal}
    assert refused == {"sutherland-hodgman"}
    assert records["fill"].refusal == "Polygons are filled row by row, from an edge table."
    with pytest.raises(ValueError, match="sutherland-hodgman needs a convex clip window"):
        window.session.set_setting("polygon_clipping", "sutherland-hodgman")
    assert window.session.document is before
