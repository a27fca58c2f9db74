"""The walkthroughs of docs/extending.md: every diff applies to the program, and what it adds works."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
SECTIONS = re.findall(
    r"^## (.+?)$.*?^```diff\n(.*?)^```$",
    (ROOT / "docs" / "extending.md").read_text(encoding="utf-8"),
    re.MULTILINE | re.DOTALL,
)
FAMILY = {"A line method": "line", "A depth format": "depth", "A method of visibility": "visibility"}
"""Sections that add a method, and its family."""
COMPLETE = "tests/core/test_methods_are_complete.py::test_methods_are_complete"


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """Return a copy of the program without its tests, but for those that the new ones need."""
    if shutil.which("git") is None:
        pytest.skip("git applies the diffs")
    ignored = shutil.ignore_patterns("__pycache__")
    for folder in ("app", "core", "lessons", "widgets"):
        shutil.copytree(ROOT / folder, tmp_path / folder, ignore=ignored)
    for name in ("pyproject.toml", "bootstrap.py"):
        shutil.copy(ROOT / name, tmp_path)
    shutil.copytree(ROOT / "tests", tmp_path / "tests", ignore=ignored)
    return tmp_path


def run(copy: Path, *command: str, text: str = "") -> None:
    """Run a command in the copy; its output is the message where it fails."""
    environment = dict(
        os.environ, PYTHONPATH=str(copy), QT_QPA_PLATFORM="offscreen", GIT_CEILING_DIRECTORIES="/"
    )
    done = subprocess.run(command, cwd=copy, env=environment, input=text, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]


def changed_files(diff: str) -> list[str]:
    """Return the files that a diff adds or changes."""
    return re.findall(r"^\+\+\+ b/(\S+)$", diff, re.MULTILINE)


def test_a_method_takes_two_files_at_most() -> None:
    assert [title for title, _ in SECTIONS] == [
        "A line method",
        "A depth format",
        "A method of visibility",
        "A view of a stage",
        "An action",
        "A pane",
        "A page",
    ]
    for title, diff in SECTIONS:
        sources = [file for file in changed_files(diff) if not file.startswith("tests/")]
        assert len(sources) <= (2 if title in FAMILY else 3), title


def test_all_walkthroughs_apply(copy: Path) -> None:
    for _, diff in SECTIONS:
        run(copy, "git", "apply", "-", text=diff)


@pytest.mark.parametrize(
    ("title", "diff"),
    [
        pytest.param(title, diff, id=title, marks=() if title == "A line method" else pytest.mark.slow)
        for title, diff in SECTIONS
    ],
)
def test_a_walkthrough_works(title: str, diff: str, copy: Path) -> None:
    run(copy, "git", "apply", "-", text=diff)
    tests = [file for file in changed_files(diff) if file.startswith("tests/")]
    extra = [f"{COMPLETE}[{FAMILY[title]}]"] if title in FAMILY else []
    python = (sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider")
    run(copy, *python, *tests, *extra)
