"""Cells that are shrunk once for all tests, and the tests that the shrinker writes."""

from functools import cache

from core.study.stress import Shrunk, shrink_cell


@cache
def shrunk_of(name: str, method: str, place: tuple[float, ...]) -> Shrunk:
    """Return what is left of a cell."""
    return shrink_cell(name, method, place)


def run_test(text: str) -> None:
    """Run the one test in the text of a file."""
    names: dict[str, object] = {}
    exec(compile(text, "a shrunk test", "exec"), names)
    (test,) = [value for name, value in names.items() if name.startswith("test_")]
    test()
