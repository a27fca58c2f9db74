"""Cases that run as one: all are tried, those that fail are named, and a test that needs more stays alone."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.families import Family, in_families, is_plain


def family(request: pytest.FixtureRequest, law: Any, *numbers: int) -> Family:
    cases: list[Any] = [
        SimpleNamespace(obj=law, callspec=SimpleNamespace(params={"number": number}, id=f"id-{number}"))
        for number in numbers
    ]
    return Family.from_parent(request.node.parent, name="law", cases=cases)


def test_all_cases_are_tried_and_those_that_fail_are_named(request: pytest.FixtureRequest) -> None:
    tried = []

    def is_even(number: int) -> None:
        tried.append(number)
        assert number % 2 == 0
        with pytest.raises(ValueError, match="two"):
            int(
                "two"
            ) if number < 5 else None  # Nothing is raised: pytest has an exception of its own for that.

    family(request, is_even, 2, 4).runtest()
    with pytest.raises(AssertionError) as alone:
        family(request, is_even, 1, 2).runtest()
    assert alone.value.__notes__ == ["This is the case id-1."]
    tried.clear()
    with pytest.raises(BaseExceptionGroup) as several:
        family(request, is_even, 1, 2, 3, 6).runtest()
    assert tried == [1, 2, 3, 6]
    assert [problem.__notes__[-1] for problem in several.value.exceptions] == [
        f"This is the case id-{number}." for number in (1, 3, 6)
    ]


def test_a_family_is_skipped_where_all_its_cases_are(request: pytest.FixtureRequest) -> None:
    def skip_odd(number: int) -> None:
        if number % 2:
            pytest.skip("odd")

    family(request, skip_odd, 1, 2).runtest()
    with pytest.raises(pytest.skip.Exception, match="odd"):
        family(request, skip_odd, 1, 3).runtest()


@pytest.mark.parametrize(("a", "b"), [(1, 1), (2, 4), (3, 9)])
def test_case_of_a_family(a: int, b: int) -> None:
    assert a * a == b


@pytest.mark.parametrize("name", ["a", "b", "c"])
def test_case_that_needs_a_folder(name: str, tmp_path: Path) -> None:
    (tmp_path / name).mkdir()
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.filterwarnings("ignore:this")
@pytest.mark.parametrize("number", [1, 2, 3])
def test_case_with_a_mark_of_its_own(number: int) -> None:
    assert number


def test_what_runs_as_one(request: pytest.FixtureRequest) -> None:
    found = [item for item in request.session.items if item.path == request.path]
    items = [case for item in found for case in (item.cases if isinstance(item, Family) else [item])]
    together = [item for item in in_families(items) if isinstance(item, Family)]
    assert [item.name for item in together] == ["test_case_of_a_family"] * (len(items) > 6)
    assert {item.name.partition("[")[0] for item in items if is_plain(item)} <= {"test_case_of_a_family"}
