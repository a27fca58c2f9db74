from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QApplication

from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import LIGHT
from widgets.timeline.pipeline_rail import PipelineRail, StageEntry, StageState

NAMES = [
    "Transform",
    "Cull",
    "Clip",
    "Edge functions",
    "Bin",
    "Raster",
    "Interpolate",
    "Shade",
    "Depth",
    "Blend",
    "Resolve",
]


UNITS = ["triangles"] * 4 + ["pixels"] + ["fragments"] * 5 + ["pixels"]


def entries(current: int = 5) -> list[StageEntry]:
    result = []
    for place, name in enumerate(NAMES):
        state = StageState.CURRENT if place == current else StageState.DONE
        result.append(StageEntry(name, str((place + 1) % 10), "12 → 8", UNITS[place], "0.4 ms", state))
    result[9] = StageEntry("Blend", "", "", "", "", StageState.SKIPPED, reason="everything is opaque")
    result[2] = StageEntry(
        "Clip", "3", "12 → 14", "triangles", "0.1 ms", is_inserted=True, reason="scanline needs w > 0"
    )
    return result


@pytest.fixture
def rail(qtbot) -> PipelineRail:
    apply_theme(QApplication.instance(), LIGHT)
    result = PipelineRail()
    qtbot.addWidget(result)
    result.show_stages(entries())
    result.resize(1264, result.sizeHint().height())
    result.show()
    qtbot.waitExposed(result)
    return result


def test_a_click_chooses_a_stage(qtbot, rail) -> None:
    seen = []
    rail.stage_chosen.connect(seen.append)
    qtbot.mouseClick(rail.buttons()[3], Qt.MouseButton.LeftButton)
    assert seen == [3]


def test_all_stages_fit_a_small_window_without_clipped_text(rail) -> None:
    assert rail.sizeHint().width() <= 1264
    for button in rail.buttons():
        assert button.width() >= button.sizeHint().width()
        assert button.geometry().right() < 1264


def test_arrows_move_among_the_stages_and_enter_chooses(qtbot, rail) -> None:
    seen = []
    rail.stage_chosen.connect(seen.append)
    buttons = rail.buttons()
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


def test_a_click_does_not_take_the_arrow_keys_from_stepping(qtbot, rail) -> None:
    qtbot.mouseClick(rail.buttons()[3], Qt.MouseButton.LeftButton)
    assert not rail.buttons()[3].hasFocus()


def test_the_present_stage_is_marked_and_the_others_are_not(rail) -> None:
    accent = QColor(LIGHT.accent)

    def has_accent(place: int) -> bool:
        button = rail.buttons()[place]
        picture = button.grab().toImage()
        return picture.pixelColor(button.width() // 2, button.height() - 3) == accent

    assert [has_accent(place) for place in (4, 5, 6)] == [False, True, False]
    rail.show_stages(entries(current=6))
    assert [has_accent(place) for place in (4, 5, 6)] == [False, False, True]


def test_skipped_and_inserted_stages_say_why(rail) -> None:
    assert "not needed: everything is opaque" in rail.buttons()[9].toolTip()
    assert "inserted: scanline needs w > 0" in rail.buttons()[2].toolTip()
    assert rail.buttons()[2].accessibleName() == "Stage Clip"
    assert "12 → 14" in rail.buttons()[2].accessibleDescription()


def test_other_stages_take_the_place_of_the_first(rail) -> None:
    rail.show_stages(entries()[:4])
    assert [button.entry().name for button in rail.buttons()] == NAMES[:4]
    rail.show_stages([])
    assert rail.buttons() == ()


def test_a_bar_is_as_long_as_the_share_of_the_time(rail) -> None:
    shares = (0.0, 0.25, 1.0, None)
    shown = [StageEntry("Raster", "", "12 → 8", "triangles", "0.4 ms", share=share) for share in shares]
    rail.show_stages(shown)

    def bar_length(place: int) -> float:
        button = rail.buttons()[place]
        picture = button.grab().toImage()
        row = [picture.pixelColor(column, button.height() - 8) for column in range(button.width())]
        return sum(color == QColor(LIGHT.muted_text) for color in row) / (button.width() - 14)

    assert [bar_length(place) for place in range(4)] == pytest.approx([0, 0.25, 1, 0], abs=0.02)


def test_the_share_is_told(rail) -> None:
    entry = StageEntry("Raster", "6", "12 → 8", "triangles", "0.4 ms", share=0.237)
    rail.show_stages([entry])
    assert "12 → 8 triangles in 0.4 ms, 24 % of all stages" in rail.buttons()[0].toolTip()
    assert "24 % of all stages" in rail.buttons()[0].accessibleDescription()


def test_numbers_that_change_move_nothing(rail) -> None:
    def places() -> list[int]:
        QApplication.processEvents()
        return [button.x() for button in rail.buttons()]

    wide = [replace(entry, counts="1,234,567 → 1,234,567") for entry in entries()[:4]]
    rail.show_stages(wide + entries()[4:])
    before = places()
    rail.show_stages(entries())
    assert places() == before
