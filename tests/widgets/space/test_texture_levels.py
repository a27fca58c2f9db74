"""One texture view or two, and what is said where there is none."""

import numpy as np
from pytestqt.qtbot import QtBot

from widgets.space.texture_paint import TexturePicture
from widgets.space.texture_view import TextureLevels


def shown(qtbot: QtBot, *sizes: int) -> TextureLevels:
    view = TextureLevels()
    qtbot.addWidget(view)
    view.resize(600, 300)
    view.show_pictures(tuple(TexturePicture(np.ones((n, n, 3), np.float32)) for n in sizes), "No texture.")
    view.show()
    qtbot.waitExposed(view)
    return view


def test_one_texture_has_all_the_room(qtbot: QtBot) -> None:
    view = shown(qtbot, 8)
    first, second = view.views()
    assert first.width() == 600
    assert not second.isVisible()
    assert [picture.size for picture in view.pictures()] == [(8, 8)]


def test_two_levels_share_it(qtbot: QtBot) -> None:
    view = shown(qtbot, 8, 4)
    first, second = view.views()
    assert second.isVisible()
    assert abs(first.width() - second.width()) <= 1
    assert first.geometry().right() < second.geometry().left()
    view.show_pictures((), "No texture.")
    assert view.pictures() == ()
    assert first.empty_text == "No texture."
    assert not second.isVisible()


def test_both_have_a_name_and_the_first_one_gets_the_keys(qtbot: QtBot) -> None:
    view = shown(qtbot, 8, 4)
    first, second = view.views()
    assert view.focusProxy() is first
    assert first.accessibleName() != second.accessibleName()
