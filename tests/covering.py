"""Combinations of choices to test: a few every day in which all choices meet, with --all every combination."""

import inspect
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from functools import wraps
from itertools import chain, combinations, product
from typing import Any, TypeVar

import pytest
from hypothesis import settings
from hypothesis.errors import HypothesisException

First = TypeVar("First")
Second = TypeVar("Second")
Law = TypeVar("Law", bound=Callable[..., None])


def is_everything() -> bool:
    """Return whether the tests run with --all."""
    return settings.get_current_profile_name() == "all"


def every_nth(cases: Iterable[First], step: int) -> list[First]:
    """Return every ``step``-th case, from the first on; with --all, all."""
    return list(cases)[:: 1 if is_everything() else step]


def in_turn(first: Iterable[First], second: Iterable[Second]) -> list[tuple[First, Second]]:
    """Return pairs that have every value of both at least once; with --all, all pairs."""
    first, second = list(first), list(second)
    if is_everything():
        return list(product(first, second))
    # The longer list goes round the shorter one, and a step further every time.
    rounds, count = sorted((len(first), len(second)))
    if not rounds:
        return []
    turns = [(k + k // rounds) % rounds for k in range(count)]
    if len(first) < len(second):
        return [(first[turn], second[k]) for k, turn in enumerate(turns)]
    return [(first[k], second[turn]) for k, turn in enumerate(turns)]


def in_turns(**factors: Sequence[Any]) -> pytest.MarkDecorator:
    """Parametrize a test so that every value of each factor occurs; with --all, all combinations."""
    values = list(factors.values())
    count = max(map(len, values))
    # Every factor goes round and round, and a step further every time.
    cases = [tuple(each[(k + k // len(each)) % len(each)] for each in values) for k in range(count)]
    return pytest.mark.parametrize(tuple(factors), list(product(*values)) if is_everything() else cases)


def every_pair(**factors: Sequence[Any]) -> pytest.MarkDecorator:
    """Parametrize a test so that every two values of two factors meet; with --all, all combinations."""
    if is_everything():
        return pytest.mark.parametrize(tuple(factors), list(product(*factors.values())))
    return pytest.mark.parametrize(tuple(factors), [tuple(case.values()) for case in covering(factors)])


def fewest(parts: Mapping[str, Iterable[Hashable]]) -> list[str]:
    """Return names whose parts together are all parts: each time the name with the most new ones, the first by name."""
    missing, found = set(chain(*parts.values())), []
    every = {name: set(parts[name]) for name in sorted(parts)}
    while missing:
        found.append(max(every, key=lambda name: len(every[name] & missing)))
        missing -= every[found[-1]]
    return found


def in_one(**factor: Sequence[Any]) -> Callable[[Law], Law]:
    """Let one test go through all values of a factor, each with the same drawn examples, and name those that fail.

    For laws of which a case takes less than it takes to draw its examples, or to run a test at all.
    """
    ((name, values),) = factor.items()

    def of_all(law: Law) -> Law:
        signature = inspect.signature(law)
        drawn = signature.replace(
            parameters=[each for each in signature.parameters.values() if each.name != name]
        )

        @wraps(law)
        def tried(*arguments: Any, **options: Any) -> None:
            given = drawn.bind(*arguments, **options).arguments
            failed = []
            for value in values:
                try:
                    law(**given, **{name: value})
                except HypothesisException:
                    raise  # not a failure: this example is not one
                except Exception as problem:
                    problem.add_note(f"{name} = {value!r}")
                    failed.append(problem)
            if failed:
                raise failed[0] if len(failed) == 1 else ExceptionGroup("several cases fail", failed)

        tried.__signature__ = drawn  # type: ignore[attr-defined]
        return tried  # type: ignore[return-value]

    return of_all


def covering(factors: Mapping[str, Sequence[Any]]) -> list[dict[str, Any]]:
    """Return cases, each a value of every factor, in which every two values of two factors meet.

    References
    ----------
    D. M. Cohen, S. R. Dalal, M. L. Fredman, G. C. Patton, "The AETG System: An Approach to Testing Based on
    Combinatorial Design", IEEE Transactions on Software Engineering 23 (1997): greedy, here without chance.
    """
    values = list(factors.values())
    numbers = range(len(values))
    missing = {
        ((a, i), (b, j)): None
        for a, b in combinations(numbers, 2)
        for i in range(len(values[a]))
        for j in range(len(values[b]))
    }
    cases: list[dict[int, int]] = []
    while missing:
        case = dict(next(iter(missing)))
        for factor in sorted(numbers, key=lambda factor: -len(values[factor])):
            if factor not in case:
                gains = [
                    sum(tuple(sorted(((factor, value), each))) in missing for each in case.items())
                    for value in range(len(values[factor]))
                ]
                # A tie goes to another value than in the last case.
                turn = len(cases) % len(gains)
                case[factor] = max(range(len(gains)), key=lambda k: (gains[k], (k - turn) % len(gains)))
        for pair in combinations(sorted(case.items()), 2):
            missing.pop(pair, None)
        cases.append(case)
    return [{name: factors[name][case[number]] for number, name in enumerate(factors)} for case in cases]
