import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QImage, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from tests.widgets.showing import shown
from widgets.space.texture_paint import TexelFootprint, TexturePicture, outside_image
from widgets.space.texture_view import TextureView

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
PIXELS = np.zeros((20, 40, 3), np.float32)
PIXELS[:5, :5] = 1, 0, 0
PIXELS[15:, 35:] = 0, 1, 0
FOOTPRINT = TexelFootprint(
    corners=np.array([[2.1, 1.2], [3.2, 1.1], [3.4, 2.3], [2.2, 2.1]]),
    center=np.array([2.7, 1.7]),
    reads=np.array([[2, 1], [3, 1], [2, 2], [3, 2]]),
    texels=np.array([[2, 1], [3, 1], [2, 2], [3, 2]]),
    shares=np.array([0.6, 0.2, 0.1, 0.1]),
    label="(5, 6)",
    is_pinned=True,
)


@pytest.fixture
def view(qtbot) -> TextureView:
    widget = TextureView()
    widget.show_picture(TexturePicture(PIXELS, footprints=(FOOTPRINT,)))
    return shown(qtbot, widget, 500, 300)


def color_at(view: TextureView, x: float, y: float) -> tuple[int, ...]:
    place = view.placement().to_widget(x, y).toPoint()
    return QColor(view.grab().toImage().pixel(place)).getRgb()[:3]


def test_the_origin_is_the_lower_left_texel(view):
    view.show_picture(TexturePicture(PIXELS))
    assert color_at(view, 2.5, 3.5) == (255, 0, 0)
    assert color_at(view, 37.5, 17.5) == (0, 255, 0)


@pytest.mark.parametrize(
    ("period", "place", "is_red"),
    [
        (1, (42.5, 2.5), True),
        (1, (2.5, 22.3), True),
        (2, (42.5, 2.5), False),
        (2, (-2.4, 2.3), True),
        (2, (2.4, -1.3), True),
        (0, (-2.6, 2.3), True),
        (0, (42.4, 2.5), False),
    ],
)
def test_what_is_outside_is_wrapped_and_faint(view, period, place, is_red):
    view.show_picture(TexturePicture(PIXELS, period))
    red, green, _ = color_at(view, *place)
    assert (red > green + 40) == is_red
    assert (red, green) != (255, 0)


def test_mirror_images_stand_beside_the_texture():
    image = QImage(2, 1, QImage.Format.Format_ARGB32)
    image.setPixelColor(0, 0, QColor("red"))
    image.setPixelColor(1, 0, QColor("blue"))
    four = outside_image(image, 2)
    names = [[four.pixelColor(x, y).name() for x in range(4)] for y in range(2)]
    assert names == [["#ff0000", "#0000ff", "#0000ff", "#ff0000"]] * 2


def test_a_double_click_shows_the_footprint_and_then_the_whole(view, qtbot):
    whole = view.placement().scale
    with qtbot.waitSignal(view.view_changed):
        QTest.mouseDClick(view, LEFT, NONE, QPoint(100, 100))
    near = view.placement()
    assert near.scale > 1.5 * whole
    assert near.area.contains(near.to_widget(2, 1))
    assert near.area.contains(near.to_widget(4, 3))
    QTest.mouseDClick(view, LEFT, NONE, QPoint(100, 100))
    assert view.placement().scale == whole


def test_the_footprint_is_followed(view):
    view.fit_footprint()
    moved = TexelFootprint(
        FOOTPRINT.corners + np.array([3, 0]),
        FOOTPRINT.center + np.array([3, 0]),
        FOOTPRINT.reads + np.array([3, 0]),
        FOOTPRINT.texels + np.array([3, 0]),
        FOOTPRINT.shares,
    )
    before = view.placement()
    view.show_picture(TexturePicture(PIXELS, footprints=(moved,)))
    after = view.placement()
    assert before.left - after.left == pytest.approx(3 * after.scale)


def test_drag_pans_and_the_wheel_keeps_its_place(view):
    before = view.placement()
    QTest.mousePress(view, LEFT, NONE, QPoint(100, 100))
    QTest.mouseMove(view, QPoint(140, 90))
    QTest.mouseRelease(view, LEFT, NONE, QPoint(140, 90))
    after = view.placement()
    assert (after.left - before.left, after.bottom - before.bottom) == pytest.approx((40, -10))
    at = QPointF(210, 70)
    texel = after.to_texels(at)
    event = QWheelEvent(
        at,
        QPointF(view.mapToGlobal(at.toPoint())),
        QPoint(),
        QPoint(0, 120),
        Qt.MouseButton.NoButton,
        NONE,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(view, event)
    assert view.placement().scale > after.scale
    assert view.placement().to_texels(at) == pytest.approx(texel)


def test_keys_pan_magnify_and_show_the_whole(view):
    whole = view.placement()
    QTest.keyClick(view, Qt.Key.Key_Plus)
    QTest.keyClick(view, Qt.Key.Key_Right)
    assert view.placement() != whole
    QTest.keyClick(view, Qt.Key.Key_Home)
    assert view.placement() == whole


def test_a_texel_is_read_under_the_pointer(view):
    text = view._texel_text(view.placement().to_widget(0.5, 0.5))
    assert text.startswith("Texel (0, 0), u = 0.0125, v = 0.025")
    assert "(1, 0, 0), linear" in text
    assert view._texel_text(view.placement().to_widget(-0.5, 0.5)) == ""


def test_any_footprint_can_be_drawn(view):
    nowhere = TexelFootprint(
        np.full((4, 2), np.nan), np.array([np.inf, 0.0]), np.array([[0, 0]]), np.array([[7, 3]]), np.ones(1)
    )
    far = TexelFootprint(
        FOOTPRINT.corners * 1e12, FOOTPRINT.center, FOOTPRINT.reads, FOOTPRINT.texels, FOOTPRINT.shares
    )
    triangle = np.array([[np.nan, 0], [1e300, 2], [3, 3]])
    view.show_picture(TexturePicture(PIXELS, triangle=triangle, footprints=(nowhere, far)))
    view.fit_footprint()
    assert not view.grab().isNull()


def test_an_empty_view_says_why(view):
    view.empty_text = "No texture"
    view.show_picture(None)
    assert view.accessibleDescription() == "No texture"
    assert not view.grab().isNull()


def test_other_shapes_are_refused():
    with pytest.raises(ValueError, match="pixels must be"):
        TexturePicture(np.zeros((2, 2), np.float32))
    with pytest.raises(ValueError, match="triangle must be"):
        TexturePicture(PIXELS, triangle=np.zeros(3))
    with pytest.raises(ValueError, match="reads and texels"):
        TexelFootprint(
            np.zeros((4, 2)), np.zeros(2), np.zeros((1, 2), int), np.zeros((1, 2), int), np.ones(2)
        )


def test_shift_and_arrows_read_texel_by_texel(view, monkeypatch):
    shown = []
    monkeypatch.setattr("widgets.space.texture_view.QToolTip.showText", lambda *args: shown.append(args[1]))
    before = view.placement()
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Up):
        QTest.keyClick(view, key, Qt.KeyboardModifier.ShiftModifier)
    places = [text.split(",  ")[0].split("), ")[0] for text in shown]
    assert all(text.startswith("Texel (") and "linear" in text for text in shown)
    assert len(set(places)) == 3
    assert view.placement() == before
