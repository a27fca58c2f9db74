"""Attempts are on the disk at once, and nothing that happens to the process, the disk or the file loses one."""

import csv
import errno
import io
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path
from typing import NoReturn

import pytest
from pydantic import ValidationError

from lessons.attempts.record import attempt_of, attempts_json, exported_attempts, read_attempts_json
from lessons.attempts.store import FILE_NAME, AttemptFile, AttemptFileError
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import ask, judge
from tests.lessons.attempts.made_attempts import attempt

ROOT = Path(__file__).parents[3]
EARLIER = Path(__file__).parent / "earlier"
INJECTION = "Robert'); DROP TABLE attempts;--"


@pytest.fixture
def file(tmp_path: Path) -> AttemptFile:
    return AttemptFile(tmp_path / "data" / FILE_NAME)


def test_attempts_are_kept_by_user(file: AttemptFile) -> None:
    assert (file.attempts(), file.users()) == ((), ())
    kept = [attempt(0), attempt(1, user=INJECTION, mistakes=("y-down",)), attempt(2, is_slip=True)]
    assert [file.add(one) for one in reversed(kept)] == ["", "", ""]
    assert file.attempts() == tuple(kept)
    assert file.attempts("me") == (kept[0], kept[2])
    assert file.attempts(INJECTION) == (kept[1],)
    assert file.users() == (INJECTION, "me")
    assert file.check() == ""
    file.add(kept[0])
    assert len(file.attempts()) == 3, "the same attempt twice is one"


def test_an_attempt_says_what_came_of_an_answer(file: AttemptFile) -> None:
    question = ask(TEMPLATES["triangle-coverage"], 7)
    wrong = question.draft.mistakes["all-edges-exclusive"]
    at = datetime(2026, 11, 23, 9, tzinfo=timezone(timedelta(hours=14)))
    made = attempt_of("me", question, wrong, judge(question, wrong), 30, at)
    file.add(made)
    (kept,) = file.attempts()
    assert kept == made
    assert (kept.template, kept.seed, kept.stage, kept.most) == ("triangle-coverage", 7, "raster", 4)
    assert kept.mistakes == ("all-edges-exclusive",)
    assert set(kept.mistakes) < set(kept.asked)
    assert kept.at == at
    assert kept.answer == question.draft.answer.text(wrong)


def test_a_table_has_one_attempt_a_row_and_no_formula() -> None:
    """A spreadsheet would run a name such as ``=1+1``; numbers with a sign remain numbers."""
    kept = [attempt(0), attempt(1, user='=HYPERLINK("x")', answer="-2, 4", mistakes=("y-down", "affine"))]
    text = exported_attempts(kept, "Answers.CSV").decode("utf-8-sig")
    first, second = csv.DictReader(io.StringIO(text, newline=""))
    assert first["at"] == "2026-11-23T08:00:00.000000Z"
    assert (first["answer"], first["points"], first["is_slip"]) == ("..#\n.##", "2.0", "False")
    assert (second["user"], second["answer"]) == ('\'=HYPERLINK("x")', "-2, 4")
    assert second["mistakes"] == "y-down affine"
    assert exported_attempts(kept, "answers.json") == attempts_json(kept)


def test_a_file_of_version_1_opens(tmp_path: Path) -> None:
    file = AttemptFile(Path(shutil.copy(EARLIER / "attempts-1.sqlite", tmp_path)))
    assert file.check() == ""
    assert file.users() == (INJECTION, "Zoë 李", "me")
    assert [(one.user, one.score, one.seed) for one in file.attempts("me")] == [
        ("me", 0.5, 0),
        ("me", 1.0, 1),
    ]
    assert file.attempts("Zoë 李")[0].is_slip
    file.add(attempt(9))
    assert len(file.attempts()) == 5


def test_a_later_version_is_refused_and_left_alone(file: AttemptFile) -> None:
    file.add(attempt())
    with sqlite3.connect(file.path) as connection:
        connection.execute("PRAGMA user_version = 2")
    connection.close()
    before = file.path.read_bytes()
    for use in (file.check, file.attempts, file.users, lambda: file.add(attempt(1))):
        with pytest.raises(AttemptFileError, match="later version of the program: its version is 2"):
            use()
    assert file.path.read_bytes() == before


def truncated(path: Path) -> None:
    os.truncate(path, path.stat().st_size // 2)


def emptied(path: Path) -> None:
    os.truncate(path, 0)


def scribbled(path: Path) -> None:
    content = path.read_bytes()
    path.write_bytes(content[:4096] + b"\xff" * 4096 + content[8192:])


def other_content(path: Path) -> None:
    path.write_bytes(b"[answer]\n" * 4000)


def other_tables(path: Path) -> None:
    with sqlite3.connect(path) as connection:
        connection.execute("CREATE TRIGGER lose AFTER INSERT ON attempts BEGIN DELETE FROM attempts; END")
    connection.close()


@pytest.mark.parametrize("damage", [truncated, emptied, scribbled, other_content, other_tables])
def test_a_damaged_file_is_set_aside(damage, file: AttemptFile) -> None:
    file.add_all(attempt(number, answer="#" * 300) for number in range(60))
    damage(file.path)
    damaged = file.path.read_bytes()
    told = file.check()
    kept = file.path.with_name(f"{FILE_NAME}.broken-1")
    assert (
        told == f"{file.path} was truncated or altered. It is kept as {kept.name}, and a new file was begun."
    )
    assert kept.read_bytes() == damaged
    assert file.attempts() == ()
    assert file.add(attempt()) == ""
    other_content(file.path)
    assert "broken-2" in file.add(attempt(1)), "damage is met while saving, too"
    assert file.attempts() == (attempt(1),)
    assert kept.read_bytes() == damaged


def test_a_row_that_cannot_be_read_costs_no_other_answer(file: AttemptFile) -> None:
    file.add_all(attempt(number) for number in range(6))
    altered = ("score = 'all', asked = x'ff'", "user = CAST(x'ff41' AS TEXT)", "user = x'ff'", "at = -1")
    with sqlite3.connect(file.path) as connection:
        for seed, change in enumerate(altered):
            connection.execute(f"UPDATE attempts SET {change} WHERE seed = {seed}")
    connection.close()
    assert [one.seed for one in file.attempts()] == [4, 5]
    assert file.users() == ("me",)
    said = f"{file.path}: 4 answers cannot be read and are left out. The others are unchanged."
    assert file.check() == file.left_out() == said
    assert file.add(attempt(7)) == ""
    assert [one.seed for one in file.attempts("me")] == [4, 5, 7]


@pytest.mark.parametrize(
    ("code", "wanted"), [(errno.EROFS, "read-only file system"), (errno.EACCES, "permission is denied")]
)
def test_the_reason_is_that_of_the_system(
    code: int, wanted: str, file: AttemptFile, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A disk that is read-only is none that somebody else owns."""

    def refuse(*_: object, **__: object) -> NoReturn:
        raise OSError(code, os.strerror(code))

    file.add(attempt())
    monkeypatch.setattr(Path, "touch", refuse)
    with pytest.raises(AttemptFileError) as problem:
        file.add(attempt(1))
    assert str(problem.value) == f"{file.path} cannot be written: {wanted}"
    assert file.attempts() == (attempt(),), "what was kept can still be read"


def test_the_journal_of_a_lost_file_is_not_played_back(file: AttemptFile) -> None:
    file.path.parent.mkdir()
    journal = file.path.with_name(f"{FILE_NAME}-journal")
    journal.write_bytes(b"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7" + bytes(1000))
    file.add(attempt())
    assert file.attempts() == (attempt(),)
    assert file.path.with_name(f"{FILE_NAME}.broken-1-journal").exists()


CHILD = """
import sys
from pathlib import Path
from lessons.attempts.store import AttemptFile, AttemptFileError
from tests.lessons.attempts.made_attempts import attempt
file = AttemptFile(Path(sys.argv[1]))
"""


def child(file: AttemptFile, code: str) -> "subprocess.Popen[str]":
    """Run ``code`` on the file in another process."""
    return subprocess.Popen(
        [sys.executable, "-P", "-c", CHILD + code, file.path],
        env=dict(os.environ, PYTHONPATH=str(ROOT)),
        stdout=subprocess.PIPE,
        text=True,
    )


SAVE_ON = """
for number in range(1000):
    file.add(attempt(number))
    print(number, flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no process is killed in this way")
def test_a_killed_process_loses_nothing_that_was_confirmed(file: AttemptFile) -> None:
    with child(file, SAVE_ON) as saving:
        confirmed = [int(saving.stdout.readline()) for _ in range(20)]
        file.add(attempt(2000, user="other window"))
        saving.send_signal(signal.SIGKILL)
        confirmed += [int(line) for line in saving.stdout]
    assert file.check() == ""
    kept = [one.seed for one in file.attempts("me")]
    assert kept == list(range(len(kept)))
    assert len(kept) >= len(confirmed) >= 20
    assert file.attempts("other window") == (attempt(2000, user="other window"),)


ON_A_FULL_DISK = """
import resource
saved = 0
while True:
    resource.setrlimit(resource.RLIMIT_FSIZE, (60000, resource.RLIM_INFINITY))
    try:
        file.add(attempt(saved, answer="#" * 3000))
    except AttemptFileError as problem:
        print(saved, problem)
        break
    saved += 1
resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
file.add(attempt(saved))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="the room of files is not limited in this way")
def test_without_room_it_says_so_and_keeps_what_was_saved(file: AttemptFile) -> None:
    with child(file, ON_A_FULL_DISK) as saving:
        said, _ = saving.communicate()
    saved, _, sentence = said.strip().partition(" ")
    assert saving.returncode == 0
    assert sentence.startswith(f"{file.path} cannot be read or written: ")
    assert file.check() == ""
    assert [one.seed for one in file.attempts()] == list(range(int(saved) + 1))


def test_where_nothing_can_be_written_it_says_so(tmp_path: Path) -> None:
    (tmp_path / "data").write_text("a file")
    with pytest.raises(AttemptFileError, match="cannot be"):
        AttemptFile(tmp_path / "data" / FILE_NAME).add(attempt())
    (tmp_path / FILE_NAME).mkdir()
    with pytest.raises(AttemptFileError, match="cannot be"):
        AttemptFile(tmp_path / FILE_NAME).attempts()


@pytest.mark.parametrize(
    "changes",
    [
        {"user": ""},
        {"user": "a\nb"},
        {"user": "\ud800"},
        {"user": "x" * 201},
        {"score": float("nan")},
        {"points": float("inf")},
        {"seconds": -1},
        {"at": datetime(2026, 1, 1)},
        {"at": datetime(1969, 1, 1, tzinfo=UTC)},
        {"at": datetime(9999, 12, 31, 23, tzinfo=timezone(timedelta(hours=-14)))},
        {"mistakes": ("two words",)},
        {"seed": 10**400},
        {"answer": "#" * (1 << 17)},
    ],
)
def test_what_is_no_attempt_is_not_kept(changes: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        attempt(**changes)


def test_attempts_are_exported_and_imported_once(file: AttemptFile, tmp_path: Path) -> None:
    for number in range(3):
        file.add(attempt(number, user=INJECTION))
    content = attempts_json(file.attempts())
    other = AttemptFile(tmp_path / "other.sqlite")
    other.add(attempt(1, user=INJECTION))
    given = read_attempts_json(content, "class.json")
    assert other.add_all(given) == 2
    assert other.add_all(given) == 0
    assert other.attempts() == file.attempts()


@pytest.mark.parametrize(
    ("old", "new", "wanted"),
    [
        (b'"version": 1', b'"version": 2', "written by a later version of the program: its version is 2"),
        (b"rasterscope attempts", b"other", "is no file of attempts: format: "),
        (b'"score": 0.5', b'"score": 1e400', "is no file of attempts: attempts.0.score: "),
        (b'"score": 0.5', b'"score": NaN', "is no file of attempts: "),
        (b'"seed": 0', b'"seed": "\xd9\xa1"', "is no file of attempts: attempts.0.seed: "),
        (b'"user": "me"', b'"user": "\xff"', "is no file of attempts: "),
        (b"}\n", b"", "is no file of attempts: "),
    ],
)
def test_what_is_no_export_is_refused(old: bytes, new: bytes, wanted: str) -> None:
    content = attempts_json([attempt()]).replace(old, new)
    with pytest.raises(ValueError, match=wanted) as problem:
        read_attempts_json(content, "class.json")
    assert str(problem.value).startswith("class.json ")
    assert "\n" not in str(problem.value)
