"""Starting: the first time, the second time, and everything that can stand in the way."""

import ast
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

import bootstrap

Start = Callable[..., "subprocess.CompletedProcess[str]"]
NO_INDEX = {"PIP_INDEX_URL": "http://127.0.0.1:9/simple"}
POSIX = pytest.mark.skipif(os.name == "nt", reason="about files and users as POSIX knows them")


def assert_one_sentence(done: "subprocess.CompletedProcess[str]", code: bootstrap.Exit, *words: str) -> None:
    assert done.returncode == code, done.stderr
    assert done.stdout == ""
    assert len(done.stderr.splitlines()) == 1
    assert "Traceback" not in done.stderr
    assert [word for word in words if word not in done.stderr] == []


def test_second_start_needs_no_network(used_clone: Path, start: Start) -> None:
    begin = time.perf_counter()
    second = start(used_clone, "run", "--version", **NO_INDEX)
    whole = time.perf_counter() - begin
    assert (second.returncode, second.stderr) == (0, "")
    python = bootstrap.venv_python(used_clone)
    begin = time.perf_counter()
    environment = dict(os.environ, PYTHONPATH=str(used_clone))
    subprocess.run([python, "-P", "-m", "app"], check=True, capture_output=True, env=environment)
    print(f"a second start adds {whole - (time.perf_counter() - begin):.3f} s")  # pytest -rP shows it


def test_program_gets_arguments_folder_and_gives_its_exit_code(used_clone: Path, start: Start) -> None:
    done = start(used_clone, "run", "render", "a b.obj", "--size", "4x3", "fail")
    assert done.returncode == 7
    assert done.stdout == f"toy {used_clone.parent} render a b.obj --size 4x3 fail\n"


def test_a_folder_named_core_where_the_user_stands_is_not_ours(used_clone: Path, start: Start) -> None:
    decoy = used_clone.parent / "app"
    decoy.mkdir()
    (decoy / "__main__.py").write_text("print('decoy')")
    done = start(used_clone, "run", "methods", PYTHONPATH=str(used_clone.parent))
    shutil.rmtree(decoy)
    assert done.stdout.startswith("toy ")


def test_changed_pins_are_installed_again(used_clone: Path, start: Start) -> None:
    pins = used_clone / "requirements" / "run.txt"
    before = pins.read_text()
    pins.write_text(before + "absent-toy==2.0\n")
    done = start(used_clone, "run", "--version", PIP_NO_INDEX="1")
    pins.write_text(before)
    assert_one_sentence(done, bootstrap.Exit.INSTALL_FAILED, "absent-toy", "install.log")
    assert start(used_clone, "run", "--version", **NO_INDEX).returncode == 0


def test_environment_of_an_old_or_removed_python_is_made_anew(used_clone: Path) -> None:
    assert bootstrap.has_environment(used_clone)
    settings = used_clone / ".venv" / "pyvenv.cfg"
    before = settings.read_text()
    settings.write_text("home = /usr/bin\nversion = 3.9.18\n")
    assert not bootstrap.has_environment(used_clone)
    settings.write_text(before)
    python = bootstrap.venv_python(used_clone)
    away = python.rename(python.with_name("away"))
    assert not bootstrap.has_environment(used_clone)
    away.rename(python)
    assert bootstrap.has_environment(used_clone)


def test_environment_whose_making_was_interrupted_is_made_anew(new_clone: Path) -> None:
    command = [sys.executable, "-m", "venv", "--without-pip", str(new_clone / ".venv")]
    subprocess.run(command, check=True, capture_output=True)
    assert bootstrap.venv_python(new_clone).exists()
    assert not bootstrap.has_environment(new_clone)


def test_no_network(used_clone: Path, start: Start) -> None:
    pins = used_clone / "requirements" / "run.txt"
    before = pins.read_text()
    pins.write_text("absent-toy==2.0\n")
    done = start(used_clone, "run", "--version", **NO_INDEX)
    assert not bootstrap.is_stamped(used_clone, "requirements/run.txt")
    pins.write_text(before)
    assert_one_sentence(done, bootstrap.Exit.NO_NETWORK, "network", "install.log")
    assert "absent-toy==2.0" in (used_clone / ".venv" / "install.log").read_text()


@pytest.mark.parametrize("module", ["venv", "ensurepip"])
def test_no_venv(new_clone: Path, start: Start, module: str) -> None:
    done = start(new_clone, "run", "--version", before=f"sys.modules[{module!r}] = None")
    assert_one_sentence(done, bootstrap.Exit.NO_VENV, "venv", "apt-get install")
    assert not (new_clone / ".venv").exists()


def test_ensurepip_that_is_there_but_fails(new_clone: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(command: list[str], **_: object) -> "subprocess.CompletedProcess[str]":
        Path(command[-1]).mkdir()
        return subprocess.CompletedProcess(command, 1, "ensurepip is not available", "")

    monkeypatch.setattr(subprocess, "run", fail)
    with pytest.raises(bootstrap.SetupError, match="cannot make environments") as caught:
        bootstrap.make_environment(new_clone)
    assert caught.value.code == bootstrap.Exit.NO_VENV
    assert not (new_clone / ".venv").exists()


@pytest.mark.parametrize("version", [(3, 6, 15), (3, 9, 18), (3, 10, 0)])
def test_old_python(new_clone: Path, start: Start, version: tuple[int, int, int]) -> None:
    done = start(new_clone, "run", before=f"sys.version_info = {version}")
    assert_one_sentence(done, bootstrap.Exit.OLD_PYTHON, f"Python 3.{version[1]}:", "3.11")


def test_old_python_can_read_the_file() -> None:
    source = (bootstrap.ROOT / "bootstrap.py").read_text(encoding="utf-8")
    ast.parse(source, feature_version=(3, 7))
    imported = [line for line in source.split("if sys.version_info")[0].splitlines() if "import" in line]
    assert imported == ["import sys", "from enum import IntEnum"]


@pytest.mark.slow
def test_a_real_old_python_says_so() -> None:
    candidates = [shutil.which(f"python3.{minor}") for minor in range(6, 11)]
    old = [path for path in candidates if path and subprocess.run([path, "-c", ""]).returncode == 0]
    if not old:
        pytest.skip("no Python older than 3.11 on this machine")
    for path in old:
        done = subprocess.run([path, bootstrap.ROOT / "bootstrap.py"], capture_output=True, text=True)
        assert_one_sentence(done, bootstrap.Exit.OLD_PYTHON, "needs Python 3.11")


@POSIX
def test_folder_that_cannot_be_written(new_clone: Path, start: Start) -> None:
    (new_clone / ".venv").write_text("a file where the environment should be")
    done = start(new_clone, "run", "--version")
    assert_one_sentence(done, bootstrap.Exit.NOT_WRITABLE, ".venv")


def test_only_the_standard_library_is_imported() -> None:
    tree = ast.parse((bootstrap.ROOT / "bootstrap.py").read_text(encoding="utf-8"))
    names = [alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names]
    names += [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    assert {name.split(".")[0] for name in names} <= set(sys.stdlib_module_names)


def test_exit_codes_differ() -> None:
    codes = [int(code) for code in bootstrap.Exit.__members__.values()]
    assert len(codes) == len(set(codes))
    assert 0 not in codes


@pytest.mark.parametrize(
    ("arguments", "code"), [([], 2), (["fly"], 2), (["--help"], 0), (["-h"], 0), (["--version"], 0)]
)
def test_usage(arguments: list[str], code: int, capsys: pytest.CaptureFixture[str]) -> None:
    assert bootstrap.main(arguments) == code
    output = capsys.readouterr()
    assert (output.err if code else output.out) == bootstrap.USAGE
    assert (output.out if code else output.err) == ""


def test_interrupt_is_no_traceback(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(root: Path, arguments: list[str]) -> int:
        raise KeyboardInterrupt

    monkeypatch.setitem(bootstrap.COMMANDS, "run", interrupt)
    assert bootstrap.main(["run"]) == bootstrap.Exit.INTERRUPTED
