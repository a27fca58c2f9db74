"""Segments and points in the window: outlines, handles, typed ends, words, and steps through all stages."""

import numpy as np
import pytest

from app.session.document import open_document
from app.window.main_window import MainWindow
from core.scene import ClipScene
from lessons.scenes import make_scene


def open_scene(window: MainWindow, name: str) -> ClipScene:
    """Open a built-in scene of segments or points."""
    scene = make_scene(name)
    assert isinstance(scene, ClipScene)
    window.session.open(open_document(scene, name))
    return scene


@pytest.mark.parametrize(("name", "handles"), [("segment", 2), ("points", 1)])
def test_every_end_has_a_handle_that_moves_it(window: MainWindow, name: str, handles: int) -> None:
    scene, grid = open_scene(window, name), window.page.grid
    window.session.go_to(0)
    window.page.grid.grab()
    chosen = [grid.choose_next_vertex() for _ in range(handles + 1)]
    assert len(set(chosen)) == handles
    assert chosen[0] == chosen[-1]
    assert grid.nudge_vertex(1.0, 2.0)
    moved = window.session.document.scene
    assert isinstance(moved, ClipScene)
    assert moved.kind == scene.kind
    assert (moved.clip != scene.clip).any(axis=2).sum() == 1
    assert moved.clip[0, 0, :2] == pytest.approx(scene.clip[0, 0, :2] + 2 * np.array([1.0, 2.0]) / scene.size)
    window.session.undo()
    assert window.session.document.scene is scene
