"""What Qt needs of a Linux system: libraries, a font, a display."""

import importlib.util
import os
import re
import shutil
import socket
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

import bootstrap
from app.cli.commands import COMMANDS

Start = Callable[..., "subprocess.CompletedProcess[str]"]
pytestmark = pytest.mark.skipif(bootstrap.SYSTEM != "linux", reason="about Linux")
# What every Linux has, or else it could not run Python.
LIBC = {
    "libc.so.6",
    "libm.so.6",
    "libdl.so.2",
    "libpthread.so.0",
    "librt.so.1",
    "libgcc_s.so.1",
    "libresolv.so.2",
}
LOADER = {"ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}


def qt_folder() -> Path:
    spec = importlib.util.find_spec("PySide6")
    assert spec.origin is not None
    return Path(spec.origin).parent


def write_command(folder: Path, name: str, script: str) -> None:
    path = folder / name
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)


@pytest.fixture
def system(new_clone: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A system where Qt lacks two libraries until its apt-get has installed them, after an update."""
    monkeypatch.delenv("CI", raising=False)
    folder = new_clone / ".venv/lib/python3.11/site-packages/PySide6"
    folder.mkdir(parents=True)
    (folder / "QtWidgets.abi3.so").touch()
    commands = new_clone.parent / "bin"
    commands.mkdir()
    state = new_clone.parent
    found = "printf '\\tlibEGL.so.1 => %s\\n\\tlibxcb-cursor.so.0 => %s\\n\\tlibz.so.1 => /lib/libz.so.1\\n'"
    write_command(
        commands, "ldd", f"[ -e {state}/done ] && {found} /a /b || {found} 'not found' 'not found'; exit 1"
    )
    write_command(
        commands,
        "apt-get",
        f"echo $@ >> {state}/apt; [ $1 = update ] && touch {state}/lists && exit\n"
        f"[ -e {state}/lists ] && touch {state}/done && exit; echo 'E: Unable to locate' >&2; exit 100",
    )
    touch = shutil.which("touch")
    assert touch is not None
    (commands / "touch").symlink_to(touch)
    monkeypatch.setenv("PATH", str(commands))
    monkeypatch.setattr(bootstrap, "has_font", lambda: True)
    monkeypatch.setattr(bootstrap, "is_root", lambda: True)
    return new_clone


def test_root_gets_the_libraries_installed(system: Path) -> None:
    assert bootstrap.missing_libraries(system) == ["libEGL.so.1", "libxcb-cursor.so.0"]
    bootstrap.provide_libraries(system, needed=True)
    assert bootstrap.missing_libraries(system) == []
    install = "install -y --no-install-recommends libegl1 libxcb-cursor0"
    assert (system.parent / "apt").read_text().splitlines() == [install, "update", install]


def test_others_are_told_the_one_command(system: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bootstrap, "is_root", lambda: False)
    with pytest.raises(bootstrap.SetupError) as caught:
        bootstrap.provide_libraries(system, needed=True)
    assert caught.value.code == bootstrap.Exit.NO_SYSTEM_LIBRARIES
    assert str(caught.value).endswith(": sudo apt-get install -y libegl1 libxcb-cursor0")
    assert not (system.parent / "apt").exists()


def test_commands_without_a_window_go_on_without_the_libraries(
    system: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bootstrap, "is_root", lambda: False)
    bootstrap.provide_libraries(system, needed=False)


def test_apt_that_fails_is_quoted(system: Path) -> None:
    write_command(system.parent / "bin", "apt-get", "echo 'E: no space left' >&2; exit 100")
    with pytest.raises(bootstrap.SetupError, match=r"E: no space left.*apt-get install -y libegl1") as caught:
        bootstrap.provide_libraries(system, needed=True)
    assert caught.value.code == bootstrap.Exit.NO_SYSTEM_LIBRARIES


def test_other_package_managers_find_a_library_by_its_name(system: Path) -> None:
    (system.parent / "bin" / "apt-get").rename(system.parent / "bin" / "dnf")
    command = bootstrap.install_command(system, ["libEGL.so.1"], font=False)
    assert command == "dnf install -y 'libEGL.so.1()(64bit)' dejavu-sans-fonts"
    (system.parent / "bin" / "dnf").unlink()
    with pytest.raises(bootstrap.SetupError, match=r"libEGL.so.1, .*packages that hold them"):
        bootstrap.provide_libraries(system, needed=True)


def test_missing_font_is_told_but_stops_nothing(
    system: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (system.parent / "done").touch()
    monkeypatch.setattr(bootstrap, "has_font", lambda: False)
    monkeypatch.setattr(bootstrap, "is_root", lambda: False)
    bootstrap.provide_libraries(system, needed=True)
    assert capsys.readouterr().err.endswith("empty boxes: sudo apt-get install -y fonts-dejavu-core\n")


def test_font_is_looked_for_in_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bootstrap, "FONT_FOLDERS", (str(tmp_path / "absent"), str(tmp_path)))
    assert not bootstrap.has_font()
    (tmp_path / "truetype").mkdir()
    (tmp_path / "truetype" / "a.ttf").touch()
    assert bootstrap.has_font()


def test_the_real_loader_is_asked(new_clone: Path) -> None:
    """A copy of a Qt module whose need of libstdc++ was rewritten into one that no system can meet."""
    folder = new_clone / ".venv/lib/python3.11/site-packages/PySide6"
    folder.mkdir(parents=True)
    module = next(qt_folder().glob("QtTest.*.so")).read_bytes()
    assert b"libstdc++.so.6\0" in module
    module = module.replace(b"libstdc++.so.6\0", b"libabsent.so.6\0")
    (folder / "QtTest.abi3.so").write_bytes(module)
    assert "libabsent.so.6" in bootstrap.missing_libraries(new_clone)


def test_every_library_that_qt_asks_for_has_its_package() -> None:
    folder = qt_folder()
    files = [str(path) for pattern in bootstrap.QT_FILES for path in folder.glob(pattern)]
    assert len(files) >= len(bootstrap.QT_FILES)
    environment = dict(os.environ, LD_DEBUG="files", LC_ALL="C")
    done = subprocess.run(["ldd", *files], capture_output=True, text=True, env=environment)
    report = done.stdout + done.stderr
    needs = set(re.findall(rf"file=(\S+) \[0\];\s+needed by {re.escape(str(folder.parent))}/", report))
    wanted = {name for name in needs if not name.startswith(("libQt6", "libicu", "libpyside", "libshiboken"))}
    lines = (bootstrap.ROOT / "requirements" / "debian.txt").read_text().splitlines()
    table = dict(line.split() for line in lines if not line.startswith("#"))
    assert len(wanted) > 20
    assert wanted - set(table) - LIBC - LOADER == set()


@pytest.mark.parametrize(
    ("arguments", "window"),
    [
        ([], True),
        (["model.obj"], True),
        (["model.obj", "--set", "fill=blocks"], True),
        (["model.obj", "--help"], False),
        (["--version"], False),
        (["render", "model.obj", "-o", "out.png"], False),
        (["trace", "model.obj"], False),
        (["methods"], False),
        (["screenshot", "model.obj"], False),
    ],
)
def test_which_commands_need_a_display(arguments: list[str], window: bool) -> None:
    assert bootstrap.needs_window(arguments) is window


@pytest.mark.parametrize(
    "variables", [{}, {"DISPLAY": ":65000"}, {"WAYLAND_DISPLAY": "absent-0"}, {"DISPLAY": "x"}]
)
def test_no_display(new_clone: Path, start: Start, variables: dict[str, str]) -> None:
    done = start(new_clone, "run", "model.obj", **variables)
    assert done.returncode == bootstrap.Exit.NO_DISPLAY
    assert done.stdout == ""
    assert len(done.stderr.splitlines()) == 1
    assert done.stderr.endswith("python3 bootstrap.py run render FILE -o out.png\n")
    assert not (new_clone / ".venv").exists()


def test_display_that_answers(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        number = server.getsockname()[1] - 6000
        assert bootstrap.has_display({"DISPLAY": f"127.0.0.1:{number}.0"})
    assert not bootstrap.has_display({"DISPLAY": f"127.0.0.1:{number}.0"})
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("\0/tmp/.X11-unix/X64999")
        server.listen()
        assert bootstrap.has_display({"DISPLAY": ":64999"})
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(tmp_path / "wayland-0"))
        server.listen()
        assert bootstrap.has_display({"WAYLAND_DISPLAY": "wayland-0", "XDG_RUNTIME_DIR": str(tmp_path)})


def test_every_command_runs_without_a_display() -> None:
    assert set(bootstrap.HEADLESS_COMMANDS) == {command.name for command in COMMANDS}
    assert set(bootstrap.QT_COMMANDS) < set(bootstrap.HEADLESS_COMMANDS)


@pytest.mark.parametrize("platform", ["offscreen", "minimal", "vnc:size=800x600"])
def test_platform_chosen_by_the_user_needs_no_display(platform: str) -> None:
    bootstrap.require_display({"QT_QPA_PLATFORM": platform})
