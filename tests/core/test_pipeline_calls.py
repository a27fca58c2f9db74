"""One triangle goes through the pipeline in few steps, so that a reader with a debugger can follow them."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

import pytest

import core
from core import ClipScene, render
from core.resolved import resolve

ROOT = str(Path(core.__file__).parent)
CLIP = [[[-0.8, -0.7, 0, 1], [0.9, -0.5, 0, 1], [-0.1, 0.8, 0, 1]]]
COLORS = [[[1, 0, 0], [0, 1, 0], [0, 0, 1]]]


@pytest.fixture(autouse=True)
def only_these_settings() -> None:
    """Forget settings of other tests: those that are equal but not the same are compared at every look-up."""
    resolve.cache_clear()


@contextmanager
def counted_calls() -> Iterator[list[str]]:
    """Collect the file of every function of the core that is called in the block."""
    files: list[str] = []

    def watch(frame: FrameType, event: str, _: object) -> None:
        code = frame.f_code
        # Comprehensions are calls of their own only before Python 3.12.
        if event == "call" and code.co_filename.startswith(ROOT) and not code.co_name.endswith("comp>"):
            files.append(code.co_filename)

    before = sys.getprofile()
    sys.setprofile(watch)
    try:
        yield files
    finally:
        sys.setprofile(before)


def test_a_triangle_is_drawn_again_in_under_135_calls_of_25_files() -> None:
    scene = ClipScene(CLIP, COLORS, size=(64, 64))
    render(scene)
    with counted_calls() as files:
        render(scene)
    assert len(files) < 135
    assert len(set(files)) <= 25


def test_a_new_triangle_is_drawn_in_under_210_calls_of_32_files() -> None:
    render(ClipScene(CLIP, COLORS, size=(64, 64)))
    scene = ClipScene(CLIP, COLORS, size=(64, 64))
    with counted_calls() as files:
        render(scene)
    assert len(files) < 210
    assert len(set(files)) <= 32
