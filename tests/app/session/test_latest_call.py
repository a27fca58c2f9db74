"""Of the moves that wait, the last is made."""

from pytestqt.qtbot import QtBot

from app.session.document_edits import LatestCall


def test_the_first_call_is_made_at_once_and_of_those_that_wait_the_last(qtbot: QtBot) -> None:
    made: list[tuple[object, ...]] = []
    moves = LatestCall(lambda *place: made.append(place))
    for x in range(4):
        moves.call(x, 0)
    assert made == [(0, 0)]
    qtbot.waitUntil(lambda: len(made) == 2)
    assert made == [(0, 0), (3, 0)]
    qtbot.wait(1)
    moves.call(5, 0)
    moves.call(6, 0)
    moves.flush()
    assert made[2:] == [(5, 0), (6, 0)]
