"""``rasterscope lesson``: lessons are listed, shown and checked, own folders too, and every slide is accounted for."""

from datetime import UTC, datetime
from pathlib import Path

import pytest

from app.files.user_folders import attempt_file
from lessons.attempts.record import lesson_attempt
from lessons.course.catalogue import read_lesson, shipped
from tests.app.cli.cli_runs import refused, run_program
from tests.lessons.course.lesson_texts import GOOD


def test_lessons_are_listed_shown_and_checked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path / "data"))
    folder = tmp_path / "class"
    folder.mkdir()
    path = folder / "whose-pixel.toml"
    path.write_text(GOOD)
    (folder / "broken.toml").write_text(GOOD.replace("minutes = 5", "minutes = 0"))
    added = run_program("lesson", "folders", "--add", folder)
    assert added.stdout.endswith(f"{folder}\n")
    listed = run_program("lesson", "list")
    names = [line.split()[0] for line in listed.stdout.splitlines() if line.startswith("  ")]
    assert names == [*shipped().lessons, "whose-pixel"]
    assert listed.stdout.count(" 0 of ") == len(names)
    done = lesson_attempt("Ada", read_lesson(path), 1, datetime.now(UTC), score=1)
    attempt_file().add(done)
    mine, hers = (run_program("lesson", "list", *user).stdout for user in ((), ("--user", "Ada")))
    assert mine == listed.stdout
    assert "whose-pixel             5 min  2 of 4  Whose pixel?: Who draws" in hers
    assert listed.stderr.count("warning: skipped: ") == 1
    assert "broken.toml: line 4: minutes: expected" in listed.stderr
    shown = run_program("lesson", "show", "whose-pixel").stdout
    assert shown.startswith("Whose pixel? (5 minutes)\nWho draws the pixels of a diagonal?\n")
    for said in (
        "[Fan of shared edges, 64 x 48, raster, at end, pixel (32, 24)]",
        "Right: 16",
        "25: That would",
    ):
        assert f"   {said}" in shown
    assert "4 steps: all that it says holds" in run_program("lesson", "validate", path).stdout
    path.write_text(GOOD.replace("twice == 185", "twice == 186"))
    said = refused(1, "lesson", "validate", path)
    assert "line 19: step.0.check.1: expected twice == 186, but twice is 185" in said
    covered = run_program("lesson", "coverage").stdout
    assert covered.startswith("188 slides: ")
    assert covered.splitlines()[0].endswith(", 0 open")
