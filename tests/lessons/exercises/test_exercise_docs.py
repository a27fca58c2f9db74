"""The page on exercises, followed to the letter."""

import re
from pathlib import Path

from lessons.exercises.answers.pixels import PixelAnswer
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import ask, judge
from lessons.exercises.toml_file import TomlFile

PAGE = Path(__file__).parents[3] / "docs" / "exercises.md"


def test_the_first_exercise_of_the_page_works(tmp_path: Path) -> None:
    exercise, answer = re.findall(r"```toml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    (tmp_path / "triangle.toml").write_text(exercise, encoding="utf-8")
    (tmp_path / "answer.toml").write_text(answer, encoding="utf-8")
    question = ask(read_exercise(tmp_path / "triangle.toml"), 4)
    given = TomlFile(tmp_path / "answer.toml").values["answer"]
    assert isinstance(question.draft.answer, PixelAnswer)
    judgement = judge(question, question.draft.answer.read(given))
    assert judgement.mistakes == ("all-edges-inclusive",), question.draft.answer.text(
        question.draft.answer.reference
    )
