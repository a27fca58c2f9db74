"""The page on lessons, followed to the letter; it names every key and function that there is."""

import re
from pathlib import Path

import pytest
from pydantic import BaseModel

from lessons.course import record
from lessons.course.quoted import CALLED, COUNTS
from tests.app.cli.cli_runs import run_program

PAGE = Path(__file__).parents[3] / "docs" / "lessons.md"
TEXT = PAGE.read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_first_lesson_of_the_page_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path))
    text = TEXT.split("## How the course does it")[0]
    (lesson,) = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    folder = Path(run_program("lesson", "folders").stdout.strip())
    folder.mkdir()
    (folder / "half-a-pixel.toml").write_text(lesson, encoding="utf-8")
    said = {}
    for command in re.findall(r"^ +rasterscope (.*)$", text, re.MULTILINE):
        done = run_program(*command.split(), cwd=folder)
        assert (done.returncode, done.stderr) == (0, ""), command
        said[command.split()[1]] = done.stdout
    assert list(said) == ["validate", "show", "play"]
    assert said["validate"] == "half-a-pixel.toml: Half a pixel, 4 steps: all that it says holds\n"
    assert "   Right: 10\n" in said["show"]
    assert len([*folder.glob("half-a-pixel-*.png")]) > 4


@pytest.mark.parametrize(
    "part",
    [
        record.LessonPart,
        record.StepPart,
        record.StatePart,
        record.UntilPart,
        record.SolutionPart,
        record.WrongPart,
        record.FailsPart,
        record.NextPart,
        record.CameraPart,
        record.MaterialPart,
    ],
)
def test_every_key_stands_on_the_page(part: type[BaseModel]) -> None:
    assert [name for name in part.model_fields if f"`{name}`" not in TEXT] == []


def test_every_name_stands_on_the_page() -> None:
    names = (*CALLED, *COUNTS)
    assert [name for name in names if not re.search(rf"`{name}\W", TEXT)] == []
    assert [name for name in (*record.KEPT, *record.PANES) if f"`{name}`" not in TEXT] == []
