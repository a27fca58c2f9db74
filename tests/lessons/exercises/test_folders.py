"""Exercises of teachers are found beside ours; a broken file is named and skipped, and nothing runs as code."""

import errno
import os
from pathlib import Path

import pytest

from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.exercise_file import read_folders
from tests.app.cli.cli_runs import refused, run_program

GOOD = """
version = 1
title = "Half"
stage = "depth"
question = "1/2 of 4?"
[answer]
type = "numbers"
values = [2]
"""
BROKEN = {
    "syntax": GOOD + "= 3",
    "missing": GOOD.replace('title = "Half"\n', ""),
    "type": GOOD.replace('"Half"', "7"),
    "mistake": "mistakes = ['__import__(\"os\")']" + GOOD,
    "large": GOOD.replace("[2]", "[1e400]"),
    "digits": GOOD.replace("[2]", "['٢']"),
    "nan": GOOD.replace("[2]", "[nan]"),
    "huge": GOOD + "#" * 100_000,
    "later": GOOD.replace("version = 1", "version = 2"),
    "facing": GOOD,
    "delete\x7f": GOOD,
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / "class"
    folder.mkdir()
    for name, text in BROKEN.items() | {("half", GOOD), ("zebra", GOOD.replace("1/2", "2/4"))}:
        (folder / f"{name}.toml").write_text(text, encoding="utf-8")
    (folder / "template.py").write_text("raise SystemExit('this must not run')")
    (folder / "inner.toml").mkdir()
    return folder


def test_good_files_are_found_and_broken_ones_named(folder: Path) -> None:
    found, skipped = read_folders([folder, folder.parent / "gone"], TEMPLATES)
    assert list(found) == ["half", "zebra"]
    assert len(skipped) == len(BROKEN) + 2
    assert all("expected" in sentence and "\n" not in sentence for sentence in skipped)
    named = {Path(sentence.split(".toml")[0]).name for sentence in skipped}
    assert {"syntax", "digits", "huge", "facing", "inner"} < named
    assert f"{folder / 'facing.toml'}: expected another name: there is an exercise facing already" in skipped
    gone = os.strerror(errno.ENOENT).lower()
    assert skipped[-1] == f"{folder.parent / 'gone'}: expected a folder of exercises: {gone}"
    _, twice = read_folders([folder, folder], TEMPLATES)
    assert sum("there is an exercise half already" in sentence for sentence in twice) == 1


def test_the_command_line_finds_own_and_added_folders(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    data = tmp_path / "data"
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(data))
    own = data / "exercises"
    own.mkdir(parents=True)
    (own / "mine.toml").write_text(GOOD)
    assert run_program("exercise", "folders").stdout == f"{own}\n"
    assert run_program("exercise", "folders", "--add", folder).stdout == f"{own}\n{folder}\n"
    assert run_program("exercise", "folders", "--add", folder).stdout == f"{own}\n{folder}\n"
    listed = run_program("exercise", "list")
    names = [line.split()[0] for line in listed.stdout.splitlines()]
    assert names == [*TEMPLATES, "mine", "half", "zebra"]
    assert listed.stderr.count("warning: skipped: ") == len(BROKEN) + 1
    assert "1/2 of 4?" in run_program("exercise", "show", "half").stdout
    assert "got 'none'" in run_program("exercise", "show", "none").stderr
    assert run_program("exercise", "folders", "--remove", folder).stdout == f"{own}\n"
    assert (folder / "half.toml").exists()
    assert "expected a folder that was added" in refused(1, "exercise", "folders", "--remove", folder)
    assert "expected a folder of exercises" in refused(1, "exercise", "folders", "--add", tmp_path / "none")
