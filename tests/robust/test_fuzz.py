"""Damaged files of every format: none ends in a traceback, hangs, takes much memory, or reads outside its folder."""

import random
from pathlib import Path

import pytest

from tests.robust.fuzz import Child, fuzz, make_case

CASES = 5000


def test_a_case_is_the_same_again_by_its_number() -> None:
    seeds = [{"a.obj": b"v 0 0 0\nf 1 1 1\n", "a.mtl": b"newmtl a\n"}, {"a.json": b'{"a": [1, 2]}'}]
    cases = [make_case(seeds, number) for number in range(50)]
    assert cases == [make_case(seeds, number) for number in range(50)]
    assert len({str(case) for case in cases}) > 40


@pytest.mark.slow
def test_what_a_case_does_wrong_is_noticed(tmp_path: Path) -> None:
    folder = tmp_path / "files"
    folder.mkdir()
    for name in ("inside", "outside"):
        (folder / name).with_suffix(".obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (folder / "outside.obj").rename(tmp_path / "outside.obj")
    child = Child.started(folder, tmp_path / "errors")
    assert child.problem(folder / "inside.obj") == ""
    assert child.problem(tmp_path / "outside.obj").startswith("outside: ")
    (tmp_path / "errors").write_text("a line of a library")
    assert child.problem(folder / "inside.obj") == "stderr: b'a line of a library'"
    child.end()


@pytest.mark.slow
def test_damaged_files_of_every_format(tmp_path: Path) -> None:
    seed = random.SystemRandom().getrandbits(31)
    print(f"{CASES} cases from --seed {seed}")
    assert fuzz(CASES, seed, tmp_path / "found") == []
