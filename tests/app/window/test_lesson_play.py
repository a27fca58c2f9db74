"""Lessons are played by their keys alone, each step to its end; the command makes a picture of every step."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication

from app.files.user_folders import attempt_file
from app.window.main_window import MainWindow
from app.window.unattended import hidden_window, play
from lessons.course.catalogue import shipped
from tests.app.cli.cli_runs import run_program
from tests.lessons.course.lesson_texts import GOOD

EVERYDAY = ("pixel-centres",)
"""Marked pixels, dragged corners and A | B."""


@pytest.fixture(scope="module")
def stage(qapp: QApplication, tmp_path_factory: pytest.TempPathFactory) -> Iterator[MainWindow]:
    """Return the window in which all lessons are played."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RASTERSCOPE_CONFIG", str(tmp_path_factory.mktemp("config")))
        with hidden_window((1280, 800), "light") as made:
            yield made


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=() if name in EVERYDAY else pytest.mark.slow) for name in shipped().lessons],
)
def test_a_lesson_is_played_to_its_end_without_scrolling(stage: MainWindow, name: str) -> None:
    """Every answer, right and wrong, and every solution; the pane shows all that it says, and nothing is kept."""
    lesson, scrolling = shipped().lessons[name], []

    def look(step: str) -> None:
        walk = stage.page.lessons.walk
        if walk is None or walk.task.scroll.verticalScrollBar().maximum() > 0:
            scrolling.append(step)

    play(stage, lesson, look, tries_wrong=True)
    # A whole listing is read line by line, also where it is typed.
    types_code = any(step.answer is not None and step.answer.type == "code" for step in lesson.steps)
    assert scrolling == [] or types_code
    assert not attempt_file().path.exists()


def test_the_command_makes_a_picture_of_each_step(tmp_path: Path) -> None:
    path = tmp_path / "whose-pixel.toml"
    path.write_text(GOOD, encoding="utf-8")
    done = run_program("lesson", "play", path, "-o", tmp_path / "pictures", "--size", "1000x700")
    assert done.stdout == "whose-pixel: 4 steps played\n"
    steps = [f"{step}-asked" for step in range(1, 5)] + [f"{step}-done" for step in range(2, 5)] + ["end"]
    pictures = {picture.stem: QImage(str(picture)) for picture in (tmp_path / "pictures").iterdir()}
    assert sorted(pictures) == sorted(f"whose-pixel-{step}" for step in steps)
    assert {(picture.width(), picture.height()) for picture in pictures.values()} == {(1000, 700)}
