"""A window under random keys, clicks, drags, pages and files: no exception, no stall, no memory that stays."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from app.session.document import open_document
from app.window.main_window import MainWindow
from lessons.scenes import built_in_scene
from tests.app.files.mesh_writing import SQUARE, ply_binary
from tests.core.meshes import torus
from tests.robust.monkey import Monkey

SEED = 20
OPENED_MESHES, GROWN_WINDOW = (
    Path(__file__).with_name(name) for name in ("opened_meshes.py", "grown_window.py")
)
MOST_BYTES = 200 << 20
"""By which the memory after thirty meshes may be larger than after three."""
MOST_GROWN = 200
"""Objects of one kind of Qt by which a window may hold more after 12,000 random steps than after 4,000."""
MOST_HELD = 128 << 20
"""Bytes of arrays that it may hold at rest: those of undo, and of what is open."""


@pytest.fixture
def files(tmp_path: Path) -> list[Path]:
    """Return meshes that open, and one that does not."""
    small, broken = tmp_path / "square.obj", tmp_path / "broken.obj"
    small.write_text(SQUARE + "f 1 2 3 4\n")
    broken.write_text("v 0 0 nan\nf 1 1 9\n")
    ring = tmp_path / "ring.ply"
    positions, triangles = torus(96, 48)
    ring.write_bytes(ply_binary(positions, triangles.tolist()))
    return [small, broken, ring]


def is_busy(window: MainWindow) -> bool:
    return window.files.progress.is_busy or window.page.views.is_drawing


def test_a_short_monkey(
    window: MainWindow, qtbot: QtBot, files: list[Path], capfd: pytest.CaptureFixture[str]
) -> None:
    monkey = Monkey(window, SEED, files)
    for _ in range(20):
        monkey.step()
        qtbot.waitUntil(lambda: not is_busy(window), timeout=60000)
    assert capfd.readouterr().err == ""


def test_a_picture_that_comes_after_another_scene_was_opened_is_dropped(
    window: MainWindow, qtbot: QtBot
) -> None:
    window.page.show_view("scene")
    assert window.page.views.is_drawing
    window.page.show_view("pixels")
    sphere = built_in_scene("sphere")
    window.session.open(replace(open_document(sphere.make(), sphere.title), triangle=1399))
    qtbot.waitUntil(lambda: not window.page.views.is_drawing, timeout=60000)
    assert window.page.views.scene_presenter.drawn is None


@pytest.mark.slow
def test_a_long_monkey(window: MainWindow, files: list[Path], capfd: pytest.CaptureFixture[str]) -> None:
    window.memory.autosave.begin(None)
    monkey = Monkey(window, SEED, files)
    for _ in range(5000):
        monkey.step()
        problems = capfd.readouterr().err
        assert problems == "", f"seed {SEED}, step {monkey.number}, after {monkey.steps[-5:]}"
    assert list(monkey.told()) == []


@pytest.mark.slow
@pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="the memory of a process is asked elsewhere otherwise"
)
def test_thirty_meshes_leave_no_more_than_three(tmp_path: Path) -> None:
    run = subprocess.run(
        [sys.executable, OPENED_MESHES, "30", tmp_path],
        env=os.environ | {"RASTERSCOPE_CONFIG": str(tmp_path / "config")},
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert (run.returncode, run.stderr) == (0, "")
    used = [int(line) for line in run.stdout.split()]
    assert used[-1] - used[2] < MOST_BYTES, [found >> 20 for found in used]


@pytest.mark.slow
def test_what_a_window_holds_grows_no_more(tmp_path: Path) -> None:
    run = subprocess.run(
        [sys.executable, GROWN_WINDOW, tmp_path, "4000", "12000"],
        env=os.environ | {"RASTERSCOPE_CONFIG": str(tmp_path / "config")},
        stdout=subprocess.PIPE,
        timeout=900,
        check=True,
    )
    first, last = map(json.loads, run.stdout.splitlines())
    grown = {kind: count - first["qt"].get(kind, 0) for kind, count in last["qt"].items()}
    assert {kind: more for kind, more in grown.items() if more > MOST_GROWN} == {}
    before, after = (sum(found["python"].values()) for found in (first, last))
    assert after <= 1.2 * before, {
        kind: (count, first["python"].get(kind, 0)) for kind, count in last["python"].items()
    }
    assert last["bytes"] < MOST_HELD
