import pytest
from PySide6.QtCore import Qt

from core.explain.records import StageCard
from tests.widgets.showing import shown
from widgets.timeline.stage_cards import StageCardView

CARD = StageCard(
    "Clip", "Triangles in clip space", "Triangles in front", "Cuts off what lies behind.", "Zwicker 2016"
)


@pytest.fixture
def view(qtbot) -> StageCardView:
    return shown(qtbot, StageCardView(), 300, 200)


def test_it_says_what_the_stage_gets_gives_and_is_for(view) -> None:
    view.show_card(CARD)
    assert view.fold_button.text() == "Clip"
    texts = [text.text() for text in view._texts if text.isVisible()]
    assert texts == [CARD.purpose, CARD.gets, CARD.gives, CARD.source]


def test_a_missing_source_takes_no_room(view) -> None:
    view.show_card(StageCard("Cull", "a", "b", "c"))
    assert [text.isVisible() for text in view._texts] == [True, True, True, False]


def test_the_title_folds_it_away(qtbot, view) -> None:
    seen = []
    view.card_folded.connect(seen.append)
    view.show_card(CARD)
    tall = view.sizeHint().height()
    qtbot.mouseClick(view.fold_button, Qt.MouseButton.LeftButton)
    assert seen == [True]
    assert view.is_folded()
    assert view.sizeHint().height() < tall
    view.fold_button.setFocus()
    qtbot.keyClick(view.fold_button, Qt.Key.Key_Space)
    assert seen == [True, False]
    view.show_folded(True)
    assert seen == [True, False]


def test_an_empty_card_says_what_it_is_for(view) -> None:
    view.show_card(None)
    assert "purpose, input and output" in view._texts[0].text()
