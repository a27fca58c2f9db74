import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest

from widgets.scene_view import SceneHandle, SceneMark, ScenePicture, SceneView

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


@pytest.fixture
def view(qtbot) -> SceneView:
    widget = SceneView()
    qtbot.addWidget(widget)
    widget.resize(400, 300)
    widget.show()
    qtbot.waitExposed(widget)
    return widget


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
    view.show_picture(picture_of(4, 3, handles=(SceneHandle(2, 0.5, 0.5),)))
    told: list[tuple[int, float, float]] = []
    view.vertex_dragged.connect(lambda *args: told.append(args))
    with qtbot.waitSignals([view.vertex_drag_started, view.vertex_drag_finished]):
        QTest.mousePress(view, LEFT, NONE, QPoint(203, 148))
        QTest.mouseMove(view, QPoint(243, 118))
        QTest.mouseRelease(view, LEFT, NONE, QPoint(243, 118))
    assert told[-1] == (2, pytest.approx(0.6), pytest.approx(0.6))


def test_the_caption_takes_its_room_from_the_picture(view, qtbot):
    whole = view.picture_size()
    with qtbot.waitSignal(view.size_changed):
        view.set_caption("Some words about the scene. " * 6)
    assert view.picture_size()[0] == whole[0]
    assert view.picture_size()[1] < whole[1]


def test_marks_of_any_coordinates_can_be_drawn(view):
    wild = np.array([[0.1, 0.1], [np.nan, 0.2], [0.5, 1e300], [0.7, 0.7]])
    marks = (SceneMark(wild, label="ray"), SceneMark(wild[::-1], shape="cross"), SceneMark(wild[:2]))
    view.show_picture(picture_of(4, 3, marks=marks, handles=(SceneHandle(0, 1e30, np.nan),)))
    assert not view.grab().isNull()


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
