import pytest
from PySide6.QtCore import Qt

from core.explain.records import AnswerKind, Question, Verdict
from tests.widgets.showing import shown
from widgets.inspector.prediction import PredictionView

NUMBER = Question("What is the depth? (within 0.01)", AnswerKind.NUMBER)
CHOICE = Question("Is the pixel covered?", AnswerKind.CHOICE)


@pytest.fixture
def view(qtbot) -> PredictionView:
    return shown(qtbot, PredictionView(), 500, 160)


def test_a_typed_number_is_handed_on(qtbot, view) -> None:
    seen = []
    view.answer_given.connect(seen.append)
    view.show_question(NUMBER)
    assert "within 0.01" in view.question.text()
    qtbot.keyClicks(view.field, "3/8")
    qtbot.keyClick(view.field, Qt.Key.Key_Return)
    assert seen == [0.375]


@pytest.mark.parametrize("text", ["", "abc", "1/0"])
def test_what_cannot_be_read_is_not_checked_yet(qtbot, view, text: str) -> None:
    seen = []
    view.answer_given.connect(seen.append)
    view.show_question(NUMBER)
    qtbot.keyClicks(view.field, text)
    qtbot.mouseClick(view.check_button, Qt.MouseButton.LeftButton)
    assert seen == []
    assert view.verdict.text().startswith("Not checked yet")
    qtbot.keyClicks(view.field, "1")
    assert view.verdict.text() == ""


def test_the_verdict_stands_beside_the_answer_and_closes_the_question(qtbot, view) -> None:
    seen = []
    view.answer_given.connect(seen.append)
    view.show_question(NUMBER)
    qtbot.keyClicks(view.field, "0.5")
    qtbot.keyClick(view.field, Qt.Key.Key_Return)
    view.show_verdict(Verdict(False, "the depth is 0.4213."))
    view.show_count(3, 4)
    assert view.verdict.text() == "Wrong: the depth is 0.4213."
    assert view.verdict.property("role") == "bad"
    assert view.count.text() == "3 of 4 right"
    assert view.next_button.isVisible()
    qtbot.keyClick(view.field, Qt.Key.Key_Return)
    assert seen == [0.5]
    view.show_verdict(Verdict(True, "0.4213."))
    assert view.verdict.text().startswith("Right")
    assert view.verdict.property("role") == "good"


def test_choices_are_buttons(qtbot, view) -> None:
    seen = []
    view.answer_given.connect(seen.append)
    view.show_question(CHOICE)
    assert [button.text() for button in view.choice_buttons] == ["Yes", "No"]
    assert not view.field.isVisible()
    qtbot.mouseClick(view.choice_buttons[1], Qt.MouseButton.LeftButton)
    assert seen == [1]
    view.show_verdict(Verdict(True, "it lies outside edge 1."))
    qtbot.mouseClick(view.choice_buttons[0], Qt.MouseButton.LeftButton)
    assert seen == [1]


def test_reveal_and_next_are_asked_for(qtbot, view) -> None:
    view.show_question(Question("Which pixels?", AnswerKind.GRID))
    with qtbot.waitSignal(view.reveal_requested):
        qtbot.mouseClick(view.reveal_button, Qt.MouseButton.LeftButton)
    view.show_verdict(Verdict(True, "12 pixels."))
    with qtbot.waitSignal(view.next_requested):
        qtbot.mouseClick(view.next_button, Qt.MouseButton.LeftButton)


def test_without_a_question_it_says_what_it_is_for(view) -> None:
    view.show_question(None)
    assert "prediction" in view.question.text()
    assert not view.check_button.isVisible()
    assert not view.next_button.isVisible()
