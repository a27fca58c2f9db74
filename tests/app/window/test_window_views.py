"""Every main view at every stage of every built-in scene, and scenes that show next to nothing."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import cycle

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.files.open_any import open_any
from app.session.document import focus_on, open_document
from app.views.view_space import fitted_home
from app.window.main_window import MainWindow
from core import STAGES, ClipScene, Settings
from core.records.steps import Level
from lessons.scene_edits import clip_of_window
from lessons.scenes import built_in_scene, scene_names
from tests.core.trace.trace_cases import LEFT_OUT
from tests.covering import in_turn, is_everything
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import DARK, LIGHT, PRESENTER

pytestmark = pytest.mark.shared_window

SIZE = (24, 16)


def typed(*corners: tuple[float, float, float, float]) -> ClipScene:
    """Return one triangle of window corners (x, y, depth, w)."""
    return ClipScene(clip_of_window(np.array([corners], float), SIZE), size=SIZE)


POOR = {
    "a point": typed((5, 5, 0.5, 1), (5, 5, 0.5, 1), (5, 5, 0.5, 1)),
    "a line": typed((2, 2, 0.5, 1), (10, 10, 0.5, 1), (18, 18, 0.5, 1)),
    "clockwise": typed((2, 2, 0.5, 1), (5, 12, 0.5, 1), (20, 3, 0.5, 1)),
    "outside": typed((200, 2, 0.5, 1), (250, 12, 0.5, 1), (220, 30, 0.5, 1)),
    "behind the far plane": typed((2, 2, 3, 1), (20, 3, 3, 1), (5, 12, 3, 1)),
    "behind the eye": ClipScene(np.array([[[0, 0, 0, -1], [1, 0, 0, -1], [0, 1, 0, -1.0]]]), size=SIZE),
    "w = 0": ClipScene(np.array([[[0, 0, 0, 0], [1, 0, 0, 1], [0, 1, 0, 1.0]]]), size=SIZE),
    "nothing": ClipScene(np.zeros((1, 3, 4)), size=SIZE),
    "huge": typed((-1e30, -1e30, 0.5, 1), (1e30, 3, 0.5, 1), (5, 1e30, 0.5, 1)),
}


def look_at_everything(window: MainWindow, turn: Iterator[int], looks: Iterable[tuple[str, str]]) -> None:
    """Go through views at stages, from the first step to the last; pytest-qt fails on what is raised.

    In every second turn there is a pin; with --all each view at each stage has one, and none.
    """
    session = window.session
    first_column, first_row, end_column, end_row = session.trace.source.raster.bounds
    pins = [None, ((first_column + end_column) // 2, (first_row + end_row) // 2)]
    for view, stage in looks:
        window.page.show_view(view)
        assert window.page.current_view() == view
        session.set_stage(stage, 0)
        session.step(1)
        session.go_to(session.stage_trace.steps.count)
        assert window.page.grid.buffer() is not None
        assert window.page.sentence.text()
        for pin in pins if is_everything() else [pins[next(turn)]]:
            session.set_pin(pin)
            QApplication.processEvents()


def test_every_view_at_every_stage_of_every_scene(window: MainWindow) -> None:
    turn = cycle((0, 1))
    window.resize(853, 533)  # Small is painted sooner.
    for number, name in enumerate(scene_names()):
        if name in LEFT_OUT and name != "sphere" and not is_everything():
            continue  # They have no step or view of another kind.
        scene = built_in_scene(name)
        window.session.open(open_document(scene.make(), scene.title))
        looks = in_turn(window.page.view_names(), STAGES)
        look_at_everything(window, turn, looks if is_everything() else looks[number % 10 :: 10])


@pytest.mark.slow
def test_scenes_that_show_next_to_nothing(window: MainWindow) -> None:
    turn = cycle((0, 1))
    window.resize(853, 533)
    for (name, scene), cull in in_turn(POOR.items(), ["none", "back"]):
        window.session.open(replace(open_document(scene, name), settings=Settings(cull=cull)))
        look_at_everything(window, turn, in_turn(("pixels",), ("clip", "bin", "raster", "resolve")))
        look_at_everything(window, turn, in_turn(("scene", "clip", "pyramid"), ("clip", "raster")))


@pytest.mark.slow
def test_all_levels_both_ways(window: MainWindow) -> None:
    session = window.session
    for stage, mode in in_turn(STAGES, ["fill", "wireframe"]):
        session.set_setting("polygon_mode", mode)
        session.set_stage(stage, 0)
        for level in Level:
            session.set_level(level)
            session.go_to(0)
            session.step(1)
            forward = session.cursor
            session.step(1)
            if session.cursor != forward:
                session.step(-1)
            assert session.cursor == forward
            session.step(-1)
            assert session.cursor.position == 0


def test_panes_keep_their_places_from_stage_to_stage(window: MainWindow) -> None:
    found = set()
    for stage in STAGES:
        window.session.set_stage(stage)
        QApplication.processEvents()
        found.add(tuple(window.page.columns.sizes()))
    assert len(found) == 1


@pytest.mark.slow
def test_every_theme_fills_the_window_with_its_ground(window: MainWindow) -> None:
    for theme in (DARK, PRESENTER, LIGHT):
        window.appearance.set_theme(theme.name)
        QApplication.processEvents()
        image = window.grab().toImage()
        ground = image.pixelColor(image.width() - 2, image.height() - 2)
        assert ground.name() == theme.window


def test_the_whole_window_fits_its_smallest_size(window: MainWindow) -> None:
    window.resize(853, 533)
    QApplication.processEvents()
    assert (window.width(), window.height()) == (853, 533)
    bar = window.page.timeline
    right = bar.mapTo(window, bar.rect().topRight()).x()
    assert right <= window.width()


@pytest.mark.slow
def test_dark_and_light_take_turns(window: MainWindow) -> None:
    application = QApplication.instance()
    found = []
    for _ in range(2):
        window.appearance.toggle_theme()
        found.append(window.memory.preferences.theme)
    assert found == ["dark", "light"]
    apply_theme(application, LIGHT)


@pytest.mark.slow
@pytest.mark.own_window
def test_after_a_click_and_another_view_the_arrows_go_on_stepping(window: MainWindow, qtbot: QtBot) -> None:
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    place = window.page.grid.placement().cells_rect(20, 20).center().toPoint()
    qtbot.mouseClick(window.page.grid, Qt.MouseButton.LeftButton, pos=place)
    window.session.go_to(0)
    qtbot.keyClick(window.windowHandle(), Qt.Key.Key_V)
    assert window.page.current_view() == "scene"
    view = window.focusWidget()
    assert view.accessibleName() == "3D scene"
    orbit = view.orbit()
    qtbot.keyClick(window.windowHandle(), Qt.Key.Key_Right)
    assert window.session.cursor.position > 0
    assert view.orbit() == orbit


def test_fitting_to_the_triangle_magnifies_it_in_the_3d_view_that_is_shown(window: MainWindow) -> None:
    scene = window.page.views.scene_presenter
    view = next(widget for name, _, widget in window.page.views.widgets if name == "scene")
    window.session.open(focus_on(open_document(built_in_scene("torus").make(), "Torus"), 700))
    window.page.show_view("scene")
    whole = view.orbit()
    window.page.show_view("pixels")
    window.run_action("fit_region")
    assert view.orbit() == whole
    window.page.show_view("scene")
    window.run_action("fit_region")
    assert view.orbit().extent < whole.extent / 5
    assert np.allclose(view.orbit().target, scene.space.corners(700).mean(axis=0))


def test_every_method_fits_into_the_left_column(window: MainWindow, qtbot: QtBot) -> None:
    """A family's title is not so long that the choices beside it are cut off or must be scrolled."""
    window.page.toggle_pane("methods")
    qtbot.waitUntil(window.page.settings_panel.isVisible)
    area = window.page.side_panes.currentWidget()
    assert area.horizontalScrollBar().maximum() == 0


@pytest.mark.slow
def test_the_first_picture_in_space_fits_its_view(qtbot: QtBot) -> None:
    application = QApplication.instance()
    apply_theme(application, LIGHT)
    opened = open_any("cube")
    cube = MainWindow(opened.document)
    qtbot.addWidget(cube)
    cube.files.show_opened(opened)  # in space, before the view has a size
    cube.resize(1280, 800)
    cube.show()
    cube.page.settle()
    presenter, view = cube.page.views.scene_presenter, cube.page.main_view()
    assert presenter.drawn.shot.size == view.picture_size()
    assert view.chosen_orbit() is None
    width, height = view.picture_size()
    assert presenter.drawn.shot.orbit == fitted_home(presenter.space, width / height)
    cube.close()
