"""``rasterscope exercise``: a question is shown, answered in a file, and its mistake named."""

from pathlib import Path

import pytest

from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import ask
from lessons.mistakes.shelf import SHELF
from tests.app.cli.cli_runs import refused, run_program


def answered(folder: Path, text: str) -> Path:
    path = folder / "answer.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_exercises_are_listed_shown_and_checked(tmp_path: Path) -> None:
    listed = run_program("exercise", "list")
    assert [line.split()[0] for line in listed.stdout.splitlines()] == list(TEMPLATES)
    shown = run_program("exercise", "show", "triangle-coverage", "--seed", "7", "--hints")
    draft = ask(TEMPLATES["triangle-coverage"], 7).draft
    assert shown.stdout.startswith("Pixels of a triangle (triangle-coverage 2, seed 7)\n\n")
    assert all(text in shown.stdout for text in (draft.given, draft.answer.credit, "Hint 3 of 3: "))

    answers = run_program("exercise", "show", "triangle-coverage", "--seed", "7", "--answers").stdout
    assert f"Right answer:\n{draft.answer.text(draft.answer.reference)}\n" in answers
    assert all(f"\n{name}:\n{draft.answer.text(one)}" in answers for name, one in draft.mistakes.items())
    mistakes = run_program("exercise", "mistakes").stdout.splitlines()
    assert [line.split()[0] for line in mistakes] == list(SHELF)

    wrong = draft.mistakes["all-edges-exclusive"]
    path = answered(tmp_path, f"answer = '''\n{draft.answer.text(wrong)}\n'''\n")
    checked = run_program("exercise", "check", "triangle-coverage", "--seed", "7", path)
    assert checked.returncode == 0, checked.stderr
    assert draft.answer.text(wrong) in checked.stdout
    assert " of 4 points: " in checked.stdout
    sentences = SHELF["all-edges-exclusive"].sentence, draft.answer.first_wrong(wrong)
    assert checked.stdout.endswith("\n".join((*sentences, "")))


def test_a_teachers_file_is_validated_and_asked(tmp_path: Path) -> None:
    path = tmp_path / "own.toml"
    head = 'version = 1\ntitle = "Own"\nstage = "depth"\nquestion = "1/2 of 4?"\n'
    path.write_text(f'{head}[answer]\ntype = "numbers"\nvalues = [2]\n')
    assert run_program("exercise", "validate", path).stdout == f"{path}: valid: Own; numbers, 1 point\n"
    assert ", seed 0)" in run_program("exercise", "show", path).stdout
    checked = run_program("exercise", "check", path, answered(tmp_path, 'answer = "4/2"\n'))
    assert checked.stdout == "Understood:\n2\n1 of 1 point: right\n"


def test_attempts_of_a_user_are_kept_exported_and_imported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path / "data"))
    path = answered(tmp_path, 'answer = "1/7"\n')
    check = ("exercise", "check", "perspective-u", "--seed", "3", path, "--user")
    assert run_program(*check, "Zoë").returncode == 0
    assert run_program(*check, "'; DROP TABLE attempts").returncode == 0
    assert "expected a name without control characters" in refused(2, *check, "a\nb")
    practice = run_program("exercise", "practice", "--user", "Zoë").stdout.splitlines()
    assert practice[0] == "This one is new.", "one miss is no third of a day's questions"
    assert "rasterscope exercise show vertex-pixels --seed " in practice[2]
    reached = run_program("exercise", "progress", "--user", "Zoë").stdout.splitlines()
    assert reached[0] == "0 points"
    assert "    affine-for-perspective        0 of 1" in reached
    out = tmp_path / "class.json"
    assert run_program("exercise", "export", out, "--user", "Zoë").stdout == f"{out}: 1 attempt\n"
    assert run_program("exercise", "export", out).stdout == f"{out}: 2 attempts\n"
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path / "other"))
    taken = [run_program("exercise", "import", out).stdout for _ in range(2)]
    assert taken == [
        f"{out}: {said}\n2 answers judged again.\n"
        for said in ("2 attempts added, 0 known before", "0 attempts added, 2 known before")
    ]
    assert "is no file of attempts" in refused(1, "exercise", "import", path)
    (tmp_path / "other" / "attempts.sqlite").write_bytes(b"not a database")
    checked = run_program(*check, "Zoë")
    assert checked.returncode == 0
    assert "It is kept as attempts.sqlite.broken-1" in checked.stderr


def test_where_nothing_can_be_kept_the_verdict_is_given_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nobody, not even root, can make a folder below a file."""
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path / "file" / "data"))
    path = answered(tmp_path, 'answer = "1/7"\n')
    done = run_program("exercise", "check", "perspective-u", "--seed", "3", path, "--user", "Zoë")
    assert done.returncode == 1
    assert done.stdout.startswith("Understood:\nu = 1/7 (0.1429)\n0 of 3 points")
    assert done.stderr.startswith("rasterscope exercise: the attempt is not kept: ")
    assert done.stderr.endswith("not a directory\n")


@pytest.mark.parametrize(
    ("code", "arguments", "answer", "wanted"),
    [
        (2, [], "", "arguments are required: ACTION"),
        (2, ["show", "facing", "--seed", "-1"], "", "--seed"),
        (2, ["show", "facing", "--seed", "\u0661"], "", "a whole number from 0"),
        (2, ["selftest", "--seeds", "0"], "", "must be 1 or more"),
        (1, ["show", "'; DROP TABLE"], "", "expected a .toml file or an exercise such as"),
        (1, ["validate", "missing.toml"], "", "missing.toml cannot be read or written"),
        (1, ["check", "perspective-u"], 'answer = ""', "not checked yet: "),
        (1, ["check", "perspective-u"], "answer = nan", "line 1: answer: expected a number such as"),
        (1, ["check", "perspective-u"], "\nanswer = 1e400", "line 2: answer: expected a number up to 1e300"),
        (1, ["check", "perspective-u"], "anwser = 1", "expected answer here, which is missing"),
        (1, ["check", "perspective-u"], "answer = 1\nmore = 2", "line 2: more: unknown 'more'"),
        (1, ["check", "facing"], "answer = ['E; DROP TABLE']", "expected one of A, B, C, D"),
    ],
)
def test_bad_input_is_one_sentence(
    code: int, arguments: list[str], answer: str, wanted: str, tmp_path: Path
) -> None:
    paths = [answered(tmp_path, answer)] if answer else []
    assert wanted in refused(code, "exercise", *arguments, *paths, cwd=tmp_path)


@pytest.mark.slow  # test_templates holds the same of every template
def test_the_selftest_passes_for_one_seed() -> None:
    tested = run_program("exercise", "selftest", "--seeds", "1")
    assert tested.returncode == 0, tested.stdout
    *of_templates, asking, naming = tested.stdout.splitlines()
    assert len(of_templates) == len(TEMPLATES)
    assert asking.startswith("a question and its check: ")
    assert naming.endswith(" at most (processor time)")
