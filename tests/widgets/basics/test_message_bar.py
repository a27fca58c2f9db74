import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QVBoxLayout, QWidget

from widgets.basics.message_bar import Message, MessageBar, MessageKind, Progress


@pytest.fixture
def bar(qtbot) -> MessageBar:
    page = QWidget()
    qtbot.addWidget(page)
    layout = QVBoxLayout(page)
    result = MessageBar(page)
    layout.addWidget(result)
    page.resize(500, 120)
    page.show()
    qtbot.waitExposed(page)
    result.page = page
    return result


def test_it_takes_no_room_until_it_has_something_to_say(bar) -> None:
    assert not bar.isVisible()
    bar.show_message(Message(MessageKind.WARNING, "The texture was not found."))
    assert bar.isVisible()
    assert not bar.action_button.isVisible()
    assert not bar.details_button.isVisible()
    bar.show_message(None)
    assert not bar.isVisible()


def test_a_message_is_dismissed_by_click_and_by_escape(qtbot, bar) -> None:
    bar.show_message(Message(MessageKind.ERROR, "The file ends too early."))
    assert bar.accessibleName() == "error: The file ends too early."
    qtbot.mouseClick(bar.dismiss_button, Qt.MouseButton.LeftButton)
    assert not bar.isVisible()
    bar.show_message(Message(MessageKind.INFORMATION, "Saved."))
    qtbot.keyClick(bar, Qt.Key.Key_Escape)
    assert not bar.isVisible()


def test_details_and_action(qtbot, bar) -> None:
    bar.show_message(Message(MessageKind.WARNING, "No texture.", "Looked in meshes/.", "Choose a file…"))
    assert not bar.details.isVisible()
    qtbot.mouseClick(bar.details_button, Qt.MouseButton.LeftButton)
    assert bar.details.isVisible()
    assert bar.details.text() == "Looked in meshes/."
    assert bar.action_button.text() == "Choose a file…"
    with qtbot.waitSignal(bar.action_requested):
        qtbot.mouseClick(bar.action_button, Qt.MouseButton.LeftButton)


@pytest.mark.parametrize("kind", list(MessageKind))
def test_each_kind_has_a_shape(bar, kind: MessageKind) -> None:
    bar.show_message(Message(kind, "text"))
    assert bar._icon.isVisible()
    assert not bar._icon.pixmap().isNull()


def test_the_shapes_of_the_kinds_differ_without_their_colours(bar) -> None:
    outlines = set()
    for kind in MessageKind:
        bar.show_message(Message(kind, "text"))
        picture = bar._icon.pixmap().toImage()
        side = range(picture.width())
        alphas = tuple(picture.pixelColor(x, y).alpha() > 128 for y in side for x in side)
        outlines.add(alphas)
    assert len(outlines) == 3


def test_progress_counts_and_can_be_cancelled_once(qtbot, bar) -> None:
    seen = []
    bar.cancel_requested.connect(lambda: seen.append("cancel"))
    bar.show_progress(Progress("Reading knot.ply", 3, 10))
    assert (bar.progress.value(), bar.progress.maximum()) == (3, 10)
    assert not bar.dismiss_button.isVisible()
    qtbot.mouseClick(bar.cancel_button, Qt.MouseButton.LeftButton)
    assert seen == ["cancel"]
    assert not bar.cancel_button.isEnabled()
    bar.show_progress(Progress("Reading knot.ply", 4, 10))
    assert not bar.cancel_button.isEnabled()
    bar.show_progress(None)
    assert not bar.isVisible()
    bar.show_progress(Progress("Reading torus.ply", 0, 0))
    assert bar.cancel_button.isEnabled()
    assert seen == ["cancel"]
