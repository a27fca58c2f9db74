"""A test that waits in vain says for what."""

import pytest
from pytestqt.exceptions import TimeoutError
from pytestqt.qtbot import QtBot


def test_what_has_not_come_is_told(qtbot: QtBot) -> None:
    drawn: list[int] = []
    with pytest.raises(TimeoutError) as told:
        qtbot.waitUntil(lambda: len(drawn) == 2, timeout=1)
    assert "lambda: len(drawn) == 2" in told.value.__notes__[0]
    with pytest.raises(TimeoutError) as told:
        qtbot.waitUntil(drawn.__len__, timeout=1)
    assert "__len__" in told.value.__notes__[0]
