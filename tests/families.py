"""Many cases of a test run as one where all tests are run: to set each up takes longer than most of them do."""

from itertools import groupby
from typing import Any

import pytest

FEWEST = 3
"""Cases that are worth it."""


class Family(pytest.Item):
    """The cases of a test that differ in their parameters only; all are tried, and those that fail are named."""

    def __init__(self, *, cases: list[pytest.Function], **given: Any) -> None:
        super().__init__(**given)
        self.cases = cases

    def runtest(self) -> None:
        failed, skipped = [], []
        for case in self.cases:
            try:
                case.obj(**case.callspec.params)
            except pytest.skip.Exception as reason:
                skipped.append(reason)
            except (Exception, pytest.fail.Exception) as problem:
                problem.add_note(f"This is the case {case.callspec.id}.")
                failed.append(problem)
        if failed:
            raise failed[0] if len(failed) == 1 else BaseExceptionGroup("several cases fail", failed)
        if len(skipped) == len(self.cases):
            raise skipped[0]

    def reportinfo(self) -> tuple[Any, int | None, str]:
        return self.cases[0].reportinfo()


def is_plain(item: pytest.Item) -> bool:
    """Return whether a test needs nothing but its parameters."""
    if not (isinstance(item, pytest.Function) and hasattr(item, "callspec")):
        return False
    marks = list(item.iter_markers())
    names = [mark.args[0] for mark in marks if mark.name == "parametrize"]
    given = {name.strip() for each in names for name in (each.split(",") if isinstance(each, str) else each)}
    return {mark.name for mark in marks} <= {"parametrize", "hypothesis"} and {*item.fixturenames} <= given


def in_families(items: list[pytest.Item]) -> list[pytest.Item]:
    """Return the tests, plain cases of one test in a row as a family."""
    found: list[pytest.Item] = []
    for _, run in groupby(items, key=lambda item: (getattr(item, "function", item), is_plain(item))):
        cases = list(run)
        if len(cases) >= FEWEST and is_plain(cases[0]):
            cases = [Family.from_parent(cases[0].parent, name=cases[0].originalname, cases=cases)]
        found += cases
    return found
