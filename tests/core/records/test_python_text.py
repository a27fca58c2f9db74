"""Texts are read in several threads at once."""

import ast
import gc
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import core
from core.records.listing import read_expression, read_statements

DEEP = "x = " + "(" * 20 + "1" + " + 1)" * 20 + "\n"


class Slow:
    """Garbage that lets another thread run when it is collected, as objects of Qt do."""

    def __init__(self) -> None:
        self.itself = self

    def __del__(self) -> None:
        time.sleep(0)


@pytest.fixture
def eager_collector() -> Iterator[None]:
    before = gc.get_threshold()
    gc.set_threshold(30)
    yield
    gc.set_threshold(*before)


@pytest.mark.usefixtures("eager_collector")
def test_threads_read_at_once() -> None:
    def read(number: int) -> ast.AST:
        Slow()
        return read_expression(DEEP[4:]) if number % 2 else read_statements(DEEP)

    with ThreadPoolExecutor(4) as threads:
        assert len(set(map(ast.dump, threads.map(read, range(400))))) == 2


def test_nothing_else_parses() -> None:
    root = Path(core.__file__).parents[1]
    files = [
        path for folder in ("core", "lessons", "widgets", "app") for path in (root / folder).rglob("*.py")
    ]
    parsing = {path.name for path in files if "ast.parse(" in path.read_text(encoding="utf-8")}
    assert parsing == {"listing.py"}
