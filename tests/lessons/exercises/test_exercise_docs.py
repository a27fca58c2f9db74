"""The page on exercises, followed to the letter."""

import re
from pathlib import Path

import pytest

from lessons.exercises.coding.task import LIMITS
from lessons.exercises.exercise_file import read_exercise
from lessons.help import guide
from lessons.mistakes.shelf import SHELF
from tests.app.cli.cli_runs import run_program

PAGE = Path(__file__).parents[3] / "docs" / "exercises.md"


def test_the_first_exercise_of_the_page_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path))
    text = PAGE.read_text(encoding="utf-8").split("## What a file holds")[0]
    exercise, answer = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    folder = Path(run_program("exercise", "folders").stdout.strip())
    folder.mkdir()
    (folder / "triangle.toml").write_text(exercise, encoding="utf-8")
    (folder / "../answer.toml").write_text(answer, encoding="utf-8")
    said = {}
    for command in re.findall(r"^ +rasterscope (.*)$", text, re.MULTILINE):
        done = run_program(*command.split(), cwd=folder)
        assert (done.returncode, done.stderr) == (0, ""), command
        said[command.split()[1]] = done.stdout
    assert list(said) == ["validate", "show", "check"]
    assert said["validate"].startswith("triangle.toml: valid: ")
    (mark,) = re.findall(r"`(triangle \d+, seed 4)`", text)
    assert f"({mark})" in said["show"]
    assert all(
        part in said["show"] for part in ("Right answer:", "corner-for-center:", "all-edges-inclusive:")
    )
    assert SHELF["all-edges-inclusive"].sentence in said["check"]
    steps = guide("own_exercise")
    assert steps[0].listing == exercise, "Help shows the same file"
    assert mark in " ".join(step.text for step in steps)


def test_the_listing_of_the_page_is_checked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path))
    text = (
        PAGE.read_text(encoding="utf-8").split("A `code` is a listing")[1].split("Numbers may be written")[0]
    )
    for name, mark in (("octants.toml", "```toml\n"), ("answer.toml", "```toml answer\n")):
        (tmp_path / name).write_text(text.split(mark)[1].split("```")[0], encoding="utf-8")
    said = {}
    for command in re.findall(r"^    rasterscope (.*)$", text, re.MULTILINE):
        done = run_program(*command.split(), cwd=tmp_path)
        assert (done.returncode, done.stderr) == (0, ""), command
        said[command.split()[1]] = done.stdout
    assert list(said) == ["validate", "show", "check"]
    assert "start-not-doubled:" in said["show"]
    assert SHELF["start-not-doubled"].sentence in said["check"]
    limits = [
        f"{limit:,}"
        for limit in (LIMITS.characters, LIMITS.line_length, LIMITS.rounds, round(LIMITS.seconds))
    ]
    assert all(f" {limit} " in text.replace("\n", " ") for limit in limits)


def test_every_other_file_of_the_page_is_an_exercise(tmp_path: Path) -> None:
    text = PAGE.read_text(encoding="utf-8").split("## What a file holds")[1]
    for number, exercise in enumerate(re.findall(r"```toml\n(.*?)```", text, re.DOTALL)):
        path = tmp_path / f"{number}.toml"
        path.write_text(exercise, encoding="utf-8")
        assert read_exercise(path).title
