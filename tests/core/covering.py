"""Combinations of choices to test: every pair of values meets in some case; with --all the whole product."""

from collections.abc import Hashable, Iterable, Mapping, Sequence
from itertools import combinations, product
from typing import Any, TypeVar

from hypothesis import settings

First = TypeVar("First")
Second = TypeVar("Second")


def is_everything() -> bool:
    """Return whether the tests run with --all."""
    return settings.get_current_profile_name() == "all"


def in_turn(first: Iterable[First], second: Iterable[Second]) -> list[tuple[First, Second]]:
    """Return pairs that have every value of both at least once; with --all, all pairs."""
    first, second = list(first), list(second)
    if is_everything():
        return list(product(first, second))
    # The longer list goes round the shorter one, and a step further every time.
    rounds = min(len(first), len(second))
    count = max(len(first), len(second))
    turns = [(k + k // rounds) % rounds for k in range(count)]
    if len(first) < len(second):
        return [(first[turn], second[k]) for k, turn in enumerate(turns)]
    return [(first[k], second[turn]) for k, turn in enumerate(turns)]


def covering(factors: Mapping[str, Sequence[Hashable]]) -> list[dict[str, Any]]:
    """Return cases, each a value of every factor, in which every two values of two factors meet.

    References
    ----------
    D. M. Cohen, S. R. Dalal, M. L. Fredman, G. C. Patton, "The AETG System: An Approach to Testing Based on
    Combinatorial Design", IEEE Transactions on Software Engineering 23 (1997): greedy, here without chance.
    """
    names = list(factors)
    missing = {
        ((a, value), (b, other)): None
        for a, b in combinations(names, 2)
        for value in factors[a]
        for other in factors[b]
    }
    cases = []
    while missing:
        case = dict(next(iter(missing)))
        for name in sorted(names, key=lambda name: -len(factors[name])):
            if name not in case:
                gains = [
                    sum(_pair(names, (name, value), each) in missing for each in case.items())
                    for value in factors[name]
                ]
                # A tie goes to another value than in the last case.
                turn = len(cases) % len(gains)
                best = max(range(len(gains)), key=lambda k: (gains[k], (k - turn) % len(gains)))
                case[name] = factors[name][best]
        for pair in combinations([(name, case[name]) for name in names], 2):
            missing.pop(pair, None)
        cases.append({name: case[name] for name in names})
    return cases


def _pair(names: list[str], one: tuple, other: tuple) -> tuple[tuple, tuple]:
    return (one, other) if names.index(one[0]) < names.index(other[0]) else (other, one)
