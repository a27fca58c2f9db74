from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QColor, QRegion
from PySide6.QtWidgets import QApplication

from tests.widgets.showing import shown
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import LIGHT
from widgets.timeline.chapters import Chapter, ChapterRow, ChapterState, Spelling

TITLES = [
    *("Transform", "Cull", "Clip", "Edges", "Bin", "Raster", "Interpolate", "Shade", "Depth"),
    *("Blend", "Resolve"),
]


def chapters(current: int = 5) -> list[Chapter]:
    result = []
    for place, title in enumerate(TITLES):
        state = ChapterState.DONE if place < current else ChapterState.AHEAD
        if place == current:
            state = ChapterState.CURRENT
        words, signs = "1,764 pixels → 816 fragments", "1,764 px → 816 frag"
        result.append(Chapter(title, str((place + 1) % 10), words, signs, "0.4 ms", state))
    result[9] = Chapter("Blend", state=ChapterState.SKIPPED, reason="everything is opaque")
    result[2] = replace(result[2], is_inserted=True, reason="scanline needs w > 0")
    return result


@pytest.fixture
def row(qtbot) -> ChapterRow:
    apply_theme(QApplication.instance(), LIGHT)
    result = ChapterRow()
    result.show_chapters(chapters())
    return shown(qtbot, result, 1264, result.sizeHint().height())


def test_a_click_enters_a_chapter_and_leaves_the_arrow_keys_to_stepping(qtbot, row) -> None:
    seen = []
    row.chapter_chosen.connect(seen.append)
    qtbot.mouseClick(row.buttons()[3], Qt.MouseButton.LeftButton)
    assert seen == [3]
    assert not row.buttons()[3].hasFocus()


@pytest.mark.parametrize("width", [2500, 1264, 600])
def test_what_is_painted_of_a_step_is_what_a_whole_chapter_would_be(row, width) -> None:
    row.resize(width, row.height())
    button = row.buttons()[5]
    row.show_share_done(0.3)
    painted = button.grab()
    updates: list[QRect] = []
    button.update = updates.append
    row.show_share_done(0.7)
    (strip,) = updates
    assert strip.height() < button.height() / 3
    button.render(painted, strip.topLeft(), QRegion(strip))
    assert painted.toImage() == button.grab().toImage()


def test_a_row_writes_what_it_has_room_for_and_never_cuts_text(row) -> None:
    spellings = []
    for width in (2500, 1264, 1000, 600, 340):
        row.resize(width, row.height())
        QApplication.processEvents()
        (spelling,) = {button._spelling for button in row.buttons()}
        spellings.append(spelling)
        for button in row.buttons():
            assert button.width() >= button.wanted_width(spelling)
    assert spellings == sorted(spellings)
    assert (spellings[0], spellings[-1]) == (Spelling.WORDS, Spelling.KEY)


def test_arrows_move_among_the_chapters_and_enter_chooses(qtbot, row) -> None:
    seen = []
    row.chapter_chosen.connect(seen.append)
    buttons = row.buttons()
    buttons[5].setFocus()
    qtbot.keyClick(buttons[5], Qt.Key.Key_Right)
    assert buttons[6].hasFocus()
    qtbot.keyClick(buttons[6], Qt.Key.Key_Left)
    qtbot.keyClick(buttons[5], Qt.Key.Key_Left)
    assert buttons[4].hasFocus()
    assert seen == []
    qtbot.keyClick(buttons[4], Qt.Key.Key_Return)
    qtbot.keyClick(buttons[4], Qt.Key.Key_Home)
    qtbot.keyClick(buttons[0], Qt.Key.Key_Space)
    assert seen == [4, 0]


def test_a_drag_scrubs_and_chooses_nothing(qtbot, row) -> None:
    chosen, scrubbed = [], []
    row.chapter_chosen.connect(chosen.append)
    row.run_scrubbed.connect(lambda place, share: scrubbed.append((place, share)))
    first, last = row.buttons()[4], row.buttons()[7]
    qtbot.mousePress(first, Qt.MouseButton.LeftButton, pos=QPoint(5, 5))
    for share in (0.0, 0.5):
        x = last.x() - first.x() + round(share * last.width())
        qtbot.mouseMove(first, QPoint(x, 5))
    qtbot.mouseRelease(first, Qt.MouseButton.LeftButton, pos=QPoint(5, 5))
    assert [place for place, _ in scrubbed] == [7, 7]
    assert [share for _, share in scrubbed] == pytest.approx([0.0, 0.5], abs=0.02)
    assert chosen == []


def test_the_present_chapter_has_a_shape_of_its_own(row) -> None:
    def is_outlined(place: int) -> bool:
        button = row.buttons()[place]
        picture = button.grab().toImage()
        return picture.pixelColor(1, button.height() // 2) == QColor(LIGHT.accent)

    assert [is_outlined(place) for place in (4, 5, 6)] == [False, True, False]
    row.show_chapters(chapters(current=6))
    assert [is_outlined(place) for place in (4, 5, 6)] == [False, False, True]


def test_strips_show_how_much_of_the_run_is_done(row) -> None:
    def share_done(place: int) -> float:
        button = row.buttons()[place]
        picture = button.grab().toImage()
        colors = [picture.pixelColor(column, button.height() - 2) for column in range(button.width())]
        return sum(color == QColor(LIGHT.muted_text) for color in colors) / (button.width() - 2)

    row.show_share_done(0.5)
    assert [share_done(place) for place in (4, 5, 6)] == pytest.approx([1.0, 0.5, 0.0], abs=0.06)


def test_skipped_and_inserted_stages_say_why(row) -> None:
    blend, clip = row.buttons()[9], row.buttons()[2]
    assert blend.chapter().second_line(Spelling.UNITS) == "not needed"
    assert "not needed: everything is opaque" in blend.toolTip()
    assert "inserted: scanline needs w > 0" in clip.toolTip()
    assert clip.accessibleName() == "Stage Clip"
    assert "1,764 pixels → 816 fragments, 0.4 ms" in clip.accessibleDescription()


def test_other_stages_take_the_place_of_the_first(row) -> None:
    row.show_chapters(chapters()[:4])
    assert [button.chapter().title for button in row.buttons()] == TITLES[:4]
    row.show_chapters([])
    assert row.buttons() == ()


def test_numbers_that_change_move_nothing(row) -> None:
    def places() -> list[int]:
        QApplication.processEvents()
        return [button.x() for button in row.buttons()]

    wide = [replace(chapter, counts="1,234,567 px → 1,234,567 px") for chapter in chapters()[:4]]
    row.show_chapters(wide + chapters()[4:])
    before = places()
    row.show_chapters(chapters())
    assert places() == before
