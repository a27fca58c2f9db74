"""The nodes of a shader, one after the other, and how much they do."""

from collections.abc import Iterator
from typing import Any

from core.lanes.nodes import Loop, Node, Statement
from core.lanes.problem import Place

ROUNDS = 16
"""Rounds of a loop, for a guess."""


def walk(node: Any) -> Any:
    """Yield a node and all that are part of it."""
    yield node
    for part in _parts(node):
        yield from walk(part)


def _parts(node: Any) -> Iterator[Node]:
    for name in type(node).__dataclass_fields__:
        value = getattr(node, name)
        for part in value if isinstance(value, tuple) and not isinstance(value, Place) else (value,):
            if isinstance(part, Node):
                yield part


def weight_of(node: Node) -> int:
    """Return how many statements a node runs, roughly."""
    inner = sum(map(weight_of, _parts(node)))
    return isinstance(node, Statement) + inner * (ROUNDS if isinstance(node, Loop) else 1)
