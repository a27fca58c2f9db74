"""A lesson is walked in large type in a small window: its buttons stay in sight, and what takes keys has a name."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QApplication, QWidget

from app.window.main_window import MainWindow
from app.window.unattended import hidden_window, play
from lessons.course.catalogue import shipped
from widgets.basics.accessibility import tab_stops


@pytest.fixture
def window(qapp: QApplication, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[MainWindow]:
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path))
    with hidden_window((1280, 800), "light") as made:
        made.appearance.set_text_size(200)
        yield made
        made.appearance.set_text_size(100)


def is_seen(widget: QWidget) -> bool:
    """Return whether a widget is seen whole; one that is not there is not missed."""
    return not widget.isVisible() or widget.visibleRegion().boundingRect().size() == widget.size()


@pytest.mark.slow
def test_the_buttons_of_a_lesson_stay_in_sight(window: MainWindow) -> None:
    unseen, scrolled, nameless, cut = [], [], [], []

    def look(step: str) -> None:
        walk = window.page.lessons.walk
        stops = map(QAccessible.queryAccessibleInterface, tab_stops([walk.view]))
        nameless.extend(step for stop in stops if not stop.text(QAccessible.Text.Name))
        sentence = window.page.sentence
        if sentence.isVisible() and sentence.height() < sentence.heightForWidth(sentence.width()):
            cut.append(step)
        bar, view = walk.task.scroll.verticalScrollBar(), walk.view
        scrolled.append(bar.maximum() > 0)
        for place in (bar.value(), bar.minimum(), bar.maximum()):
            bar.setValue(place)
            buttons = (view.check_button, view.reveal_button, view.back_button, view.next_button)
            unseen.extend((step, place, button.text()) for button in buttons if not is_seen(button))

    play(window, shipped().lessons["shared-edges"], look)
    assert any(scrolled)
    assert unseen == nameless == cut == []
