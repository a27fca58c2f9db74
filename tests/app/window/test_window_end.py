"""The program ends with its own exit code, whatever is going on, and begins where it ended."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
START = """
import sys
sys.path.insert(0, {root!r})
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
from app.window import main_window
from app.window import start as window_start

def act():
    window = next(w for w in QApplication.topLevelWidgets() if isinstance(w, main_window.MainWindow))
    {act}
    QTimer.singleShot(50, window.close)

QApplication(["rasterscope"])
QTimer.singleShot(300, act)
sys.exit(window_start.run_window({target!r}))
"""


OPENED = ("torus", "window.files.open_path('knot')")
MAPPED = ("single-triangle", "window.pages.show_page('stability'); window.pages.current.start()")
ALONE = [
    ("/nowhere/gone.obj", "pass"),
    OPENED,
    MAPPED,
    ("single-triangle", "window.page.timeline.toggle_play()"),
    ("knot", "window.page.show_view('scene')"),
    ("sphere", "window.session.set_setting('fill', 'brute-force')"),
    ("single-triangle", "window.pages.show_page('compare'); window.pages.current.start()"),
]
WITHOUT_END = "window.files.job.start(lambda progress, is_cancelled: __import__('time').sleep(1000))"


@pytest.mark.slow
@pytest.mark.parametrize(("target", "act"), ALONE)
def test_closing_ends_every_thread(tmp_path: Path, target: str, act: str) -> None:
    assert printed(tmp_path, target, act) == ""
    assert (tmp_path / "preferences.json").is_file()


@pytest.mark.parametrize(
    ("act", "last_page"),
    [(f"{MAPPED[1]}; {OPENED[1]}", "stability"), pytest.param(WITHOUT_END, "step", marks=pytest.mark.slow)],
)
def test_a_scene_given_at_the_start_is_shown_whatever_page_was_shown_last_and_closing_ends_all(
    tmp_path: Path, act: str, last_page: str
) -> None:
    (tmp_path / "preferences.json").write_text(json.dumps({"page": "plan"}))
    collects = "__import__('gc').get_threshold()[0]"  # 0: no thread collects by itself, see `Collecting`
    act = f"print(window.pages.current_name, {collects}); {act}"
    assert printed(tmp_path, "torus", act) == "step 0\n"
    assert json.loads((tmp_path / "preferences.json").read_text())["page"] == last_page


def printed(folder: Path, target: str | None, act: str) -> str:
    """Return what the program says whose window shows ``target``, does ``act`` and is closed; it has to end well."""
    code = START.format(root=str(ROOT), act=act, target=target)
    environment = {**os.environ, "RASTERSCOPE_CONFIG": str(folder), "QT_QPA_PLATFORM": "offscreen"}
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, env=environment
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout
