import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from widgets.space.frame_corner import FrameCorner, SizeChoice
from widgets.space.scene_view import SceneView

CHOICES = (SizeChoice("view", "Size of the view"), SizeChoice("64x48", "64 × 48"))


@pytest.fixture
def corner(qtbot) -> FrameCorner:
    room = QWidget()
    qtbot.addWidget(room)
    room.resize(400, 300)
    corner = FrameCorner(room)
    corner.set_most_width(390)
    room.show()
    qtbot.waitExposed(room)
    corner.room = room  # kept alive with it
    return corner


def test_nothing_is_seen_before_there_is_something_to_say(corner):
    assert not corner.isVisible()
    corner.show_figures("26.1 ms")
    assert corner.isVisible()
    corner.show_figures("")
    assert not corner.isVisible()


def test_it_is_as_wide_as_its_line_and_never_wider_than_its_room(corner):
    corner.show_figures("26.1 ms")
    short = corner.width()
    corner.show_figures("26.1 ms · 1024 × 1024")
    assert corner.width() > short
    corner.show_figures("26.1 ms · 1024 × 1024" * 20)
    assert corner.width() == 390
    corner.set_most_width(100)
    assert corner.width() == 100
    assert not corner.grab().isNull()


def test_a_line_that_has_room_is_not_cut(corner):
    for figures in ("37 frames/s", "4.1 frames/s", "1,204 ms", "51.2 ms", "600 × 306", "1 triangle"):
        corner.show_figures(f"{figures} · 6,320 triangles")
        width = corner.width() - 20  # without the arrow
        as_it_is = corner.grab().toImage().copy(4, 4, width - 4, corner.height() - 8)
        corner.resize(corner.width() + 50, corner.height())
        assert corner.grab().toImage().copy(4, 4, width - 4, corner.height() - 8) == as_it_is


def test_how_the_picture_was_drawn_is_said_under_the_mouse(corner):
    plain = corner.toolTip()
    corner.show_details("Drawn by 2 processes.")
    assert corner.toolTip() == f"{plain}\n\nDrawn by 2 processes."
    corner.show_details("")
    assert corner.toolTip() == plain


def test_the_menu_shows_and_tells_the_choice(corner, qtbot):
    corner.show_sizes(CHOICES, "view")
    actions = corner.menu().actions()
    assert [action.text() for action in actions] == ["Size of the view", "64 × 48"]
    assert [action.isChecked() for action in actions] == [True, False]
    with qtbot.waitSignal(corner.size_chosen) as told:
        actions[1].trigger()
    assert told.args == ["64x48"]
    corner.show_sizes(CHOICES, "64x48")
    assert [action.isChecked() for action in corner.menu().actions()] == [False, True]


@pytest.mark.parametrize("key", [Qt.Key.Key_Space, Qt.Key.Key_Return, Qt.Key.Key_Down])
def test_keys_open_the_menu(corner, qtbot, key):
    corner.show_figures("26.1 ms")
    corner.show_sizes(CHOICES, "view")
    qtbot.keyClick(corner, key)
    assert corner.menu().isVisible()
    corner.menu().close()


def test_a_click_opens_the_menu(corner, qtbot):
    corner.show_figures("26.1 ms")
    corner.show_sizes(CHOICES, "view")
    qtbot.mouseClick(corner, Qt.MouseButton.LeftButton)
    assert corner.menu().isVisible()
    corner.menu().close()


def test_a_caption_that_is_left_out_leaves_its_room_to_the_picture(qtbot) -> None:
    view = SceneView()
    qtbot.addWidget(view)
    view.resize(400, 300)
    view.set_caption("Two triangles in clip space.")
    heights = []
    for is_shown in (True, False, True):
        view.show_caption(is_shown)
        heights.append(view.picture_size()[1])
    assert heights[0] == heights[2] < heights[1]
