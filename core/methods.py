"""The table of methods: every stage reads its choice here, and so do menus, command line and tests.

A method is added by one function in the file of its idea under one decorator::

    @method("fill", "bounding-box", "Bounding box", source="Zwicker 2016, Binning", exact_for="every triangle")
    def bounding_box(edges, raster, block_size): ...
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])


@dataclass(frozen=True, eq=False)
class Method:
    """One row of the table."""

    family: str
    """The setting that chooses among methods of this kind, as ``fill``."""
    name: str
    """The value of the setting, as ``bounding-box``: the spelling of files, command line and API."""
    title: str
    """What a person reads in a menu."""
    function: Callable[..., Any]
    source: str
    """Author, title, year, or the lecture it is from."""
    exact_for: str
    """Where its result equals the family's exact reference."""
    breaks_where: str = ""
    """Where it does not; empty: nowhere."""
    needs: tuple[str, ...] = ()
    """What must hold of the input: ``positive-w``, ``projected``, ``perspective``, ``float64-edges``."""


class MethodTable:
    """Methods by family, in the order of registration."""

    def __init__(self) -> None:
        self._families: dict[str, dict[str, Method]] = {}

    def __iter__(self) -> Iterator[Method]:
        for methods in self._families.values():
            yield from methods.values()

    def add(self, method: Method) -> None:
        """Register ``method``; a name that is taken is refused with ValueError."""
        methods = self._families.setdefault(method.family, {})
        if method.name in methods:
            raise ValueError(f"{method.family} has a method {method.name} already")
        methods[method.name] = method

    @property
    def families(self) -> tuple[str, ...]:
        """Names of the families."""
        return tuple(self._families)

    def names(self, family: str) -> tuple[str, ...]:
        """Names of the methods of ``family``."""
        return tuple(self._family(family))

    def get(self, family: str, name: str) -> Method:
        """Return one method, or raise ValueError with the names that there are."""
        methods = self._family(family)
        if name not in methods:
            raise ValueError(f"{family} must be one of {', '.join(methods)}, got {name}")
        return methods[name]

    def _family(self, family: str) -> dict[str, Method]:
        if family not in self._families:
            raise ValueError(f"setting must be one of {', '.join(self._families)}, got {family}")
        return self._families[family]


table = MethodTable()
"""All methods of the program."""


def method(
    family: str,
    name: str,
    title: str,
    *,
    source: str,
    exact_for: str,
    breaks_where: str = "",
    needs: tuple[str, ...] = (),
) -> Callable[[Function], Function]:
    """Register the decorated function in the table."""

    def register(function: Function) -> Function:
        table.add(Method(family, name, title, function, source, exact_for, breaks_where, needs))
        return function

    return register
