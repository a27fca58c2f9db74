"""What the window imports before Qt, and what neither the window nor a first picture waits for."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from app.cli.commands import BEFORE_QT

ROOT = Path(__file__).resolve().parents[2]


def imported_by(code: str) -> set[str]:
    """Run Python code in an interpreter of its own, and return the packages and modules that it has imported."""
    done = subprocess.run(
        [sys.executable, "-P", "-c", f"{code}\nimport sys\nprint(*sys.modules, sep='\\n')"],
        env=dict(os.environ, PYTHONPATH=str(ROOT)),
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return set(done.stdout.split())


def test_what_is_imported_before_qt_needs_no_qt_and_a_scene_opens_without_pillow_and_trimesh() -> None:
    imported = imported_by(
        f"import {', '.join(BEFORE_QT)}; from app.files.open_any import open_any; open_any('cube')"
    )
    assert {*BEFORE_QT, "app.files.mesh_files", "app.files.mesh_formats.images"} <= imported
    assert not {"PySide6", "shiboken6", "pyqtgraph"} & imported
    assert not {"PIL", "trimesh", "app.files.mesh_formats.gltf_buffers", "core.pixel_history"} & imported


def test_no_garbage_is_looked_for_while_the_window_is_imported() -> None:
    said = imported_by(
        "import gc, sys, types; from app.cli.commands import run; passes = []; "
        "gc.callbacks.append(lambda *_: passes.append('passed')); "
        "sys.modules['app.window.start'] = types.SimpleNamespace(run_window=lambda *_: "
        "print(*passes, 'kept' if gc.get_freeze_count() > 50_000 else '', gc.isenabled())); run(None)"
    )
    assert {"kept", "True"} <= said
    assert "passed" not in said


def test_the_process_of_the_first_picture_imports_little() -> None:
    imported = imported_by("import app.bench.first_picture")
    assert "app.bench.records" in imported
    assert not {"core", "subprocess", "tempfile", "zipfile"} & imported


def test_neither_the_window_nor_a_colour_map_waits_for_a_typesetter_chart_or_other_page() -> None:
    code = (
        "import app.window.start; from app.window.main_window import MainWindow; "
        "from app.window.appearance import the_application; from app.files.open_any import open_any; "
        "from widgets.basics.image import colormap_table; "
        "import threading, app.pages.step.inspector_presenter as later; later._load = threading.Event().wait; "
        "the_application(); window = MainWindow(open_any('cube').document); window.show(); colormap_table('viridis')"
    )
    imported = imported_by(code)
    assert "app.pages.step.page" in imported
    pages = ("compare", "stability", "plan", "exercises")
    assert not {"ziamath", "pyqtgraph", "PIL", "trimesh", "fsrs", "sqlite3"} & imported
    assert [
        name for name in sorted(imported) if name.startswith(tuple(f"app.pages.{page}" for page in pages))
    ] == []
    assert not {"core.study.planner", "core.study.families", "core.study.record"} & imported
    # What is loaded in the background, which this window never gets, keeps the window waiting for nothing.
    assert (
        not {
            "core.pixel_history",
            "numpy.ma",
            "core.shaders.linking",
            "core.lanes.nodes",
            "core.trees.levels",
        }
        & imported
    )


def test_the_list_of_lessons_waits_for_nothing_that_only_an_open_lesson_needs() -> None:
    imported = imported_by("from app.pages.lessons.lesson_list import read_lessons; read_lessons()")
    assert "lessons.course.catalogue" in imported
    assert not {"lessons.course.record", "lessons.mistakes.shelf", "lessons.exercises.toml_values"} & imported


def test_opening_a_lesson_waits_for_no_study_and_for_no_exercise_that_is_not_asked() -> None:
    imported = imported_by(
        "from app.pages.lessons.presenter import found_lesson; found_lesson('pixel-centres', None)"
    )
    assert "app.pages.lessons.walk" in imported
    assert not {"lessons.course.validation", "core.study.families", "lessons.exercises.catalogue"} & imported


def test_what_is_loaded_behind_an_open_window_leaves_out_the_language_and_the_lectures_listings() -> None:
    imported = imported_by("import app.pages.step.inspector_presenter as later; later._load()")
    assert {"app.session.listing_runs", "core.pixel_history"} <= imported
    assert not {"core.lanes.program", "core.edits.typed", "lessons.lectures.catalogue", "numpy.ma"} & imported


def test_a_window_that_begins_on_the_start_page_lays_out_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path))
    said = imported_by(
        "import app.window.start as start; from PySide6.QtWidgets import QApplication; "
        "from app.pages.page_bar import Page; shown = Page.showEvent; "
        "Page.showEvent = lambda page, event: (print('shown:', type(page).__name__), shown(page, event)); "
        "QApplication.exec = lambda *_: print(*(type(window.focusWidget()).__name__ "
        "for window in QApplication.topLevelWidgets() if window.isVisible())) or 0; "
        "start.run_window()"
    )
    assert {"StartPage", "QPushButton"} <= said
    assert "StepPage" not in said
