from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor, QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from tests.widgets.showing import shown
from widgets.basics.theme import current_theme
from widgets.space.frame_corner import SizeChoice
from widgets.space.orbit import turned
from widgets.space.scene_view import SceneHandle, SceneMark, ScenePicture, SceneView

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


@pytest.fixture
def view(qtbot) -> SceneView:
    return shown(qtbot, SceneView(), 400, 300)


def picture_of(columns: int, rows: int, **more) -> ScenePicture:
    pixels = np.full((rows, columns, 4), 255, np.uint8)
    pixels[0, 0, :3] = 255, 0, 0
    return ScenePicture(pixels, **more)


def test_row_0_is_at_the_bottom(view):
    view.show_picture(picture_of(4, 3))
    image = view.grab().toImage()
    assert QColor(image.pixel(10, 290)).getRgb()[:3] == (255, 0, 0)
    assert QColor(image.pixel(10, 10)).getRgb()[:3] == (255, 255, 255)


def test_a_click_picks_the_pixel_of_the_picture(view, qtbot):
    view.show_picture(picture_of(4, 3))
    with qtbot.waitSignal(view.picked) as told:
        QTest.mouseClick(view, LEFT, NONE, QPoint(350, 250))
    assert told.args == [3, 0]
    with qtbot.waitSignal(view.picked) as told:
        QTest.mouseClick(view, LEFT, NONE, QPoint(10, 10))
    assert told.args == [0, 2]


def test_a_drag_turns_and_does_not_pick(view, qtbot):
    view.show_picture(picture_of(4, 3))
    with qtbot.assertNotEmitted(view.picked), qtbot.waitSignal(view.view_changed):
        QTest.mousePress(view, LEFT, NONE, QPoint(100, 100))
        QTest.mouseMove(view, QPoint(140, 100))
        QTest.mouseRelease(view, LEFT, NONE, QPoint(140, 100))


def test_a_handle_is_dragged_in_fractions(view, qtbot):
    view.show_picture(picture_of(4, 3, handles=(SceneHandle(2, 0.5, 0.5, 2),)))
    told: list[tuple[int, float, float]] = []
    view.vertex_dragged.connect(lambda *args: told.append(args))
    with qtbot.waitSignal(view.vertex_drag_finished):
        QTest.mousePress(view, LEFT, NONE, QPoint(203, 148))
        QTest.mouseMove(view, QPoint(243, 118))
        QTest.mouseRelease(view, LEFT, NONE, QPoint(243, 118))
    assert told[-1] == (2, pytest.approx(0.6), pytest.approx(0.6))


def test_a_double_click_fits_though_its_first_click_brought_a_handle(view):
    view.show_picture(picture_of(4, 3))
    view.picked.connect(
        lambda *_: view.show_picture(picture_of(4, 3, handles=(SceneHandle(0, 0.5, 0.5, 0),)))
    )
    view.set_orbit(turned(view.orbit(), 30, 0))
    view.set_orbit(replace(view.orbit(), extent=0.25))
    QTest.mouseClick(view, LEFT, NONE, QPoint(200, 150))
    QTest.mouseDClick(view, LEFT, NONE, QPoint(200, 150))
    assert view.orbit().extent == 1
    view.set_orbit(replace(view.orbit(), extent=0.25))
    QTest.mouseClick(view, LEFT, NONE, QPoint(200, 150))
    QTest.mouseDClick(view, LEFT, NONE, QPoint(200, 150))
    assert view.orbit().extent == 0.25


@pytest.mark.parametrize("reason", [Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason])
def test_focus_that_comes_back_after_a_click_has_no_ring(view, qtbot, reason):
    view.activateWindow()
    qtbot.waitUntil(view.isActiveWindow)
    view.show_picture(picture_of(4, 3))
    view.clearFocus()
    view.setFocus(Qt.FocusReason.MouseFocusReason)
    clicked = view.grab().toImage()
    view.clearFocus()
    view.setFocus(reason)
    assert view.grab().toImage() == clicked
    view.clearFocus()
    view.setFocus(Qt.FocusReason.TabFocusReason)
    ringed = view.grab().toImage()
    assert ringed != clicked
    view.clearFocus()
    view.setFocus(reason)
    assert view.grab().toImage() == ringed


def test_the_caption_takes_its_room_from_the_picture(view, qtbot):
    whole = view.picture_size()
    with qtbot.waitSignal(view.size_changed):
        view.set_caption("Some words about the scene. " * 6)
    assert view.picture_size()[0] == whole[0]
    assert view.picture_size()[1] < whole[1]


def test_marks_of_any_coordinates_can_be_drawn(view):
    wild = np.array([[0.1, 0.1], [np.nan, 0.2], [0.5, 1e300], [0.7, 0.7]])
    marks = (SceneMark(wild, label="ray"), SceneMark(wild[::-1], shape="cross"), SceneMark(wild[:2]))
    view.show_picture(picture_of(4, 3, marks=marks, handles=(SceneHandle(0, 1e30, np.nan, 0),)))
    assert not view.grab().isNull()


def test_no_mark_lies_over_a_name(view):
    """Of marks that do not meet, the order makes no difference: names come after all of them."""
    named = SceneMark(np.array([[0.5, 0.5]]), label="bone 0", shape="disc")
    around = [(0.5 + 0.05 * x, 0.5 + 0.05 * y) for x in (-2, -1, 1, 2) for y in (-2, -1, 1, 2)]
    dots = [SceneMark(np.array([place]), shape="disc") for place in around]
    pictures = []
    for marks in ((named, *dots), (*dots, named)):
        view.show_picture(picture_of(4, 4, marks=marks))
        pictures.append(view.grab().toImage())
    assert pictures[0] == pictures[1]


def test_a_picture_of_fixed_size_keeps_its_shape(view, qtbot):
    with qtbot.waitSignal(view.size_changed):
        view.fix_picture_size((4, 2))
    assert view.picture_size() == (4, 2)
    view.show_picture(picture_of(4, 2))
    image = view.grab().toImage()
    # 400 x 300: magnified a hundred times, with a border of 50 above and below.
    assert QColor(image.pixel(5, 245)).getRgb()[:3] == (255, 0, 0)
    assert QColor(image.pixel(95, 155)).getRgb()[:3] == (255, 0, 0)
    assert QColor(image.pixel(105, 245)).getRgb()[:3] == (255, 255, 255)
    assert QColor(image.pixel(5, 255)).name() == current_theme().panel
    with qtbot.waitSignal(view.picked) as told:
        QTest.mouseClick(view, LEFT, NONE, QPoint(395, 55))
    assert told.args == [3, 1]
    with qtbot.assertNotEmitted(view.picked):
        QTest.mouseClick(view, LEFT, NONE, QPoint(200, 20))
    with qtbot.assertNotEmitted(view.size_changed):
        view.resize(420, 310)


def test_a_picture_larger_than_the_view_is_averaged(view):
    view.fix_picture_size((800, 600))
    assert view.pixels_per_point() == 2
    pixels = np.zeros((600, 800, 4), np.uint8)
    pixels[::2] = 200
    view.show_picture(ScenePicture(pixels))
    image = view.grab().toImage()
    assert {QColor(image.pixel(x, y)).red() for x in (5, 100, 390) for y in (5, 6, 7, 290)} == {100}


def test_only_new_pixels_are_told_as_painted(view):
    told: list[float] = []
    view.picture_painted.connect(told.append)
    picture = picture_of(4, 3)
    view.show_picture(picture)
    view.repaint()
    view.show_picture(ScenePicture(picture.pixels, caption="other words over the same pixels"))
    view.repaint()
    assert len(told) == 1
    view.show_picture(picture_of(4, 3))
    view.repaint()
    assert len(told) == 2
    assert told[1] > told[0]


def test_turning_paints_nothing_before_the_next_picture(qtbot):
    painted = []

    class CountingView(SceneView):
        def paintEvent(self, event):
            painted.append(self.orbit())
            super().paintEvent(event)

    view = shown(qtbot, CountingView(), 400, 300)
    view.show_picture(picture_of(4, 3))
    QApplication.processEvents()
    before = len(painted)
    view.set_orbit(turned(view.orbit(), 10, 5))
    QApplication.processEvents()
    assert len(painted) == before
    view.show_picture(picture_of(4, 3))
    QApplication.processEvents()
    assert len(painted) == before + 1


def test_figures_stand_in_the_corner(view):
    assert not view.corner().isVisible()
    view.show_figures("38 frames/s")
    assert view.corner().isVisible()
    assert view.corner().geometry().left() < 10
    assert view.corner().geometry().top() < 10
    view.resize(120, 90)
    assert view.corner().geometry().right() < 120


def test_a_right_click_offers_the_sizes(view):
    view.show_sizes((SizeChoice("view", "Size of the view"),), "view")
    place = QPoint(100, 100)
    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, place, view.mapToGlobal(place))
    QApplication.sendEvent(view, event)
    assert view.corner().menu().isVisible()
    view.corner().menu().close()


def test_an_empty_view_says_why(view):
    view.empty_text = "No scene"
    view.show_picture(None)
    assert view.accessibleDescription() == "No scene"
    assert not view.grab().isNull()


def test_pixels_of_another_shape_are_refused():
    with pytest.raises(ValueError, match=r"pixels must be \(H, W, 4\)"):
        ScenePicture(np.zeros((2, 2, 3), np.uint8))
    with pytest.raises(ValueError, match=r"points must be \(N, 2\)"):
        SceneMark(np.zeros(2))
