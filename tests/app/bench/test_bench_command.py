"""``rasterscope bench`` and ``bootstrap.py bench`` as a user types them."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import bootstrap
from app.bench.workloads import WORKLOADS


def run_program(*arguments: str) -> "subprocess.CompletedProcess[str]":
    environment = dict(os.environ, PYTHONPATH=str(bootstrap.ROOT))
    command = [sys.executable, "-P", "-m", "app", "bench", *arguments]
    return subprocess.run(command, capture_output=True, text=True, env=environment, timeout=120)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--workload", "Z"], "workload must be one of A1, A2, B"),
        (["--rounds", "0"], "from 1 to 1000"),
        (["--quick", "--rounds", "3"], "not allowed with --rounds"),
        (["-o", f"{__file__}/results"], "cannot be made: not a directory"),
    ],
)
def test_wrong_usage_is_one_line(arguments: list[str], words: str) -> None:
    done = run_program(*arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert words in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_help_names_every_workload() -> None:
    text = run_program("--help").stdout
    assert [workload.name for workload in WORKLOADS if f" {workload.name}" not in text] == []


def test_threads_are_set_before_numpy_asks() -> None:
    code = (
        "import os, sys, app.cli.bench; assert 'numpy' not in sys.modules; "
        "app.cli.bench.set_threads(); import numpy; app.cli.bench.set_threads(); "
        "os.environ['OMP_NUM_THREADS'] = '7'; app.cli.bench.set_threads()"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=bootstrap.ROOT, timeout=60
    )
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1].endswith("must be set before NumPy is imported")


def test_bootstrap_installs_the_libraries_and_starts_the_command(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    prepared: list[tuple[tuple[str, ...], bool]] = []
    started: list[list[str]] = []

    def start(root: Path, arguments: list[str]) -> int:
        started.append(arguments)
        return 0

    monkeypatch.setattr(bootstrap, "prepare", lambda root, pins, needs_qt: prepared.append((pins, needs_qt)))
    monkeypatch.setattr(bootstrap, "start_program", start)
    assert bootstrap.main(["bench", "--quick"], tmp_path) == 0
    assert prepared == [(bootstrap.BENCH_PINS, True)]
    assert started == [["bench", "--quick"]]


def test_the_folder_for_results_is_made_or_refused_before_anything_is_installed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    prepared: list[bool] = []

    def prepare(root: Path, pins: tuple[str, ...], needs_qt: bool) -> None:
        prepared.append((tmp_path / "new" / "results").is_dir())

    monkeypatch.setattr(bootstrap, "prepare", prepare)
    monkeypatch.setattr(bootstrap, "start_program", lambda root, arguments: 0)
    (tmp_path / "file").write_text("not a folder")
    for option in (["-o", str(tmp_path / "file" / "results")], [f"--output={tmp_path / 'file'}"]):
        assert bootstrap.main(["bench", *option], tmp_path) == bootstrap.Exit.USAGE
    assert prepared == []
    assert capsys.readouterr().err.count("cannot be made: ") == 2
    assert bootstrap.main(["bench", "-o", str(tmp_path / "new" / "results")], tmp_path) == 0
    assert prepared == [True]


def test_the_check_does_not_need_the_libraries() -> None:
    assert "requirements/bench.txt" not in bootstrap.TEST_PINS
    assert not bootstrap.needs_window(["bench", "--quick"])
