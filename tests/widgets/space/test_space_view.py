from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, QRect, QRectF, QSizeF, Qt
from PySide6.QtGui import QImage, QPaintEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from tests.widgets.showing import shown
from widgets.basics.drawing import LabelPlaces
from widgets.space.diagram import Diagram, Patch, Spot, Stroke, Word, clip_polygon
from widgets.space.view import SpaceView

SQUARE = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
DIAGRAM = Diagram(
    patches=(Patch(SQUARE, "vertex 0", 0.5),),
    strokes=(Stroke(SQUARE, "text", 2.0, "dash", is_closed=True),),
    spots=(Spot(np.array([0.5, 0.5, 0.0]), "vertex 1", label="1"),),
    words=(Word(np.array([-1.0, 1.0, 0.0]), "corner"),),
    caption="A square with a point that can be dragged.",
)


@pytest.fixture
def view(qtbot) -> SpaceView:
    widget = SpaceView()
    widget.show_diagram(DIAGRAM)
    return shown(qtbot, widget, 500, 400)


def picture(widget: QWidget) -> QImage:
    return widget.grab().toImage()


def drag(
    widget, start: QPoint, end: QPoint, button=Qt.MouseButton.LeftButton, keys=Qt.KeyboardModifier.NoModifier
):
    QTest.mousePress(widget, button, keys, start)
    QTest.mouseMove(widget, (start + end) / 2)
    QTest.mouseMove(widget, end)
    QTest.mouseRelease(widget, button, keys, end)


def test_left_drag_turns(view, qtbot):
    before, image = view.orbit(), picture(view)
    with qtbot.waitSignal(view.view_changed):
        drag(view, QPoint(100, 300), QPoint(160, 320))
    assert view.orbit().azimuth != before.azimuth
    assert view.orbit().target == before.target
    assert picture(view) != image


@pytest.mark.parametrize(
    ("button", "keys"),
    [
        (Qt.MouseButton.MiddleButton, Qt.KeyboardModifier.NoModifier),
        (Qt.MouseButton.LeftButton, Qt.KeyboardModifier.ShiftModifier),
    ],
)
def test_middle_and_shift_drag_move(view, button, keys):
    before = view.orbit()
    place = view.projection().place(np.zeros(3))
    drag(view, QPoint(100, 300), QPoint(160, 280), button, keys)
    assert view.orbit().azimuth == before.azimuth
    moved = view.projection().place(np.zeros(3)) - place
    assert (moved.x(), moved.y()) == pytest.approx((60, -20))


def test_the_wheel_magnifies(view):
    before = view.orbit().extent
    event = QWheelEvent(
        QPointF(80, 90),
        QPointF(view.mapToGlobal(QPoint(80, 90))),
        QPoint(),
        QPoint(0, 240),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(view, event)
    assert view.orbit().extent == pytest.approx(before / 1.44)


def test_keys_turn_magnify_and_go_home(view):
    home = view.orbit()
    QTest.keyClick(view, Qt.Key.Key_Right)
    assert view.orbit().azimuth != home.azimuth
    QTest.keyClick(view, Qt.Key.Key_Plus)
    assert view.orbit().extent < home.extent
    QTest.keyClick(view, Qt.Key.Key_Home)
    assert view.orbit() == home


def test_a_double_click_fits_from_the_present_direction(view):
    drag(view, QPoint(100, 300), QPoint(190, 320))
    drag(view, QPoint(100, 300), QPoint(400, 20), Qt.MouseButton.MiddleButton)
    turned_to = view.orbit()
    QTest.mouseDClick(view, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, QPoint(20, 20))
    assert view.orbit().azimuth == turned_to.azimuth
    assert view.orbit().target != turned_to.target


def test_another_diagram_keeps_a_view_that_was_chosen(view):
    drag(view, QPoint(100, 300), QPoint(160, 320))
    chosen = view.orbit()
    view.show_diagram(Diagram(patches=DIAGRAM.patches, frame=5 * SQUARE))
    assert view.orbit() == chosen


def test_setting_a_view_emits_nothing(view, qtbot):
    with qtbot.assertNotEmitted(view.view_changed):
        view.set_orbit(view.orbit().__class__(0.1, 0.2))
        view.show_diagram(DIAGRAM)


def test_any_coordinates_can_be_drawn(view):
    wild = np.array([[np.nan, 0, 0], [np.inf, 1, 1], [1e300, -1e300, 5], [0, 0, 0], [1e9, 2, 3], [1, 1, 1]])
    view.show_diagram(
        Diagram(
            patches=(Patch(wild), Patch(wild[3:]), Patch(SQUARE * 1e15)),
            strokes=(Stroke(wild, "vertex 2", dash="dash"), Stroke(wild[3:], dash="dot", is_closed=True)),
            spots=tuple(Spot(point, label="p") for point in wild),
            words=tuple(Word(point, "word") for point in wild),
        )
    )
    assert not picture(view).isNull()


def test_an_empty_view_says_why(view):
    view.empty_text = "There is no texture"
    view.show_diagram(None)
    assert view.accessibleDescription() == "There is no texture"
    first = picture(view)
    view.empty_text = ""
    view.update()
    assert picture(view) != first


class PaintedParts(QObject):
    def __init__(self) -> None:
        super().__init__()
        self.parts: list[QRect] = []

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if isinstance(event, QPaintEvent):
            self.parts.append(event.rect())
        return False


def test_a_step_paints_no_more_than_what_differs(view):
    long = "A sentence that takes a few lines below the drawing, because it goes on and on. " * 3
    other = replace(DIAGRAM, caption="Short.", spots=(replace(DIAGRAM.spots[0], label="2"),))
    view.show_diagram(replace(DIAGRAM, caption=long))
    QApplication.processEvents()
    painted = PaintedParts()
    view.installEventFilter(painted)
    below = view.rect().adjusted(0, int(view._room().bottom()), 0, 0)
    for diagram, part in (
        (replace(DIAGRAM, caption=long, strokes=tuple(map(replace, DIAGRAM.strokes))), None),
        (replace(DIAGRAM, caption="Short."), below),
        (other, view.rect()),
        (replace(other, caption=long), below),
        (None, view.rect()),
    ):
        painted.parts.clear()
        view.show_diagram(diagram)
        QApplication.processEvents()
        assert painted.parts == ([part] if part is not None else [])
        assert view.screen().grabWindow(view.winId()).toImage() == picture(view)


def test_words_do_not_overlap():
    places = LabelPlaces(QRectF(0, 0, 400, 300))
    found = [places.find(QPointF(200, 150), QSizeF(40, 16), 4.0) for _ in range(12)]
    boxes = [box for box in found if box is not None]
    assert len(boxes) >= 6
    assert not any(a.intersects(b) for k, a in enumerate(boxes) for b in boxes[:k])
    assert places.find(QPointF(500, 150), QSizeF(40, 16), 4.0) is None


def test_polygons_are_cut_to_a_box():
    cut = clip_polygon(np.array([[-10.0, -10], [30, -10], [-10, 30]]), (0, 0, 4, 3))
    x, y = cut.T
    assert cut.min() >= 0
    assert x.max() <= 4
    assert y.max() <= 3
    area = 0.5 * abs((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
    assert area == pytest.approx(12.0)
    assert len(clip_polygon(np.array([[9.0, 9], [10, 9], [9, 10]]), (0, 0, 4, 3))) == 0


@pytest.mark.parametrize(
    "make",
    [
        lambda: Stroke(np.zeros((2, 2))),
        lambda: Patch(np.zeros(3)),
        lambda: Spot(np.zeros(2)),
        lambda: Word(np.zeros((1, 3)), ""),
    ],
)
def test_shapes_of_another_shape_are_refused(make):
    with pytest.raises(ValueError, match="must be"):
        make()
