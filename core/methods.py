"""The table of methods: every stage reads its choice here, and so do menus, command line and tests.

A method is added by one function in the file of its idea under one decorator::

    @method("fill", "bounding-box", "Bounding box", source="Zwicker 2016, Binning", exact_for="every triangle")
    def bounding_box(edges, raster, block_size): ...

A new file in the folder of its family is found by itself. The files that `core.settings.Settings` names come first
in the menus, and one of them is imported when the table is first asked for something that may stand in it; the others
when a name stands in none of these, or all names are asked for. So a program that draws one picture waits only for the
methods it uses.
"""

import pkgutil
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from core.records.listing import Operation

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
    """What must hold of the input: names of `core.stages.needs.NEEDS`, which says for which scenes it does not."""
    takes: tuple[str, ...] = ()
    """Other settings that it takes, beside those that every method of its family does: ``block_size``."""
    listing: Callable[..., Any] | None = None
    """The algorithm as a short scalar function that a student can read (`core.records.listing`)."""
    operations: "Mapping[str, tuple[Operation, ...]]" = field(default_factory=dict)
    """What the rows of its own in a trace do, by their kind."""
    traits: Any = None
    """What only methods of its family have: a record of the family's own, as `core.lines.line_method.LineTraits`."""
    edits: tuple[Any, ...] = ()
    """The `core.edits.edit.Edit` that it runs, in the place of listings of the method that has its name."""


class ReplacedName(str):
    """A setting whose method runs another function: it reads as the name of its method, the table returns ``method``.

    Two of them are equal only where function, listing and edits are the same; see `core.settings.Settings.replaced`.
    """

    method: Method

    def __new__(cls, method: Method) -> "ReplacedName":
        """Spell the name of a method that stands in no table."""
        name = super().__new__(cls, method.name)
        name.method = method
        return name

    def __eq__(self, other: object) -> bool:
        if isinstance(other, ReplacedName):
            mine, its = self.method, other.method
            of_mine = mine.family, mine.name, mine.function, mine.listing, mine.edits
            return of_mine == (its.family, its.name, its.function, its.listing, its.edits)
        return str.__eq__(self, other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = str.__hash__

    def __reduce__(self) -> tuple[type["ReplacedName"], tuple[Method]]:
        return ReplacedName, (self.method,)


def is_registered(setting: str, name: str) -> bool:
    """Return whether a setting is the method ``name`` with its own function: only then a closed form may replace it."""
    return setting == name and not isinstance(setting, ReplacedName)


class MethodTable:
    """Methods by family, in the order of their files and in these as they are registered.

    Parameters
    ----------
    files : mapping of str to tuple of str
        The modules that register the methods of a family.
    """

    def __init__(self, files: Mapping[str, tuple[str, ...]]) -> None:
        self._files: dict[str, tuple[str, ...]] = {}
        self._registered: dict[str, dict[str, Method]] = {}
        for family, its_files in files.items():
            self.declare(family, its_files)

    def __iter__(self) -> Iterator[Method]:
        for family in self.families:
            yield from self._all_of(family)

    def declare(self, family: str, files: tuple[str, ...]) -> None:
        """Add a family, the first methods of which stand in ``files``."""
        self._files[family], self._registered[family] = files, {}

    def add(self, method: Method) -> None:
        """Register ``method``; ValueError if its name is taken, or its file is not in its family's folder."""
        methods, file = self._family(method.family), method.function.__module__
        if method.name in methods:
            raise ValueError(f"{method.family} has a method {method.name} already")
        files = self._files[method.family]
        if file not in files and package_of(file) != package_of(files[0]):
            folder = package_of(files[0])
            raise ValueError(
                f"methods of {method.family} must stand in {folder}, got {method.name} in {file}"
            )
        methods[method.name] = method

    @property
    def families(self) -> tuple[str, ...]:
        """Names of the families."""
        return tuple(self._files)

    def names(self, family: str) -> tuple[str, ...]:
        """Names of the methods of ``family``."""
        return tuple(method.name for method in self._all_of(family))

    def get(self, family: str, name: str) -> Method:
        """Return one method, or raise ValueError with the names that there are; a replaced one is not registered."""
        if isinstance(name, ReplacedName) and name.method.family == family:
            return name.method
        methods = self._registered.get(family)
        if methods is None or name not in methods:
            methods = self._family(family)
            self._import_until(family, name)
        if name not in methods:
            raise ValueError(f"{family} must be one of {', '.join(self.names(family))}, got {name}")
        return methods[name]

    def replaced(self, family: str, name: str, function: Callable[..., Any] | Method) -> ReplacedName:
        """Return a value for settings that stands for the method ``name`` with another ``function``, or another row.

        Everything else, such as its listing, is that of the method that it replaces; the table does not change.
        """
        known = self.get(family, str(name))
        if not isinstance(function, Method):
            return ReplacedName(replace(known, function=function, title=f"{known.title} (replaced)"))
        if (function.family, function.name) != (family, known.name):
            raise ValueError(
                f"a method in place of {family} {known.name} must have that family and name, "
                f"got {function.family} {function.name}"
            )
        return ReplacedName(function)

    def _family(self, family: str) -> dict[str, Method]:
        """Return the methods of a family that are registered so far."""
        if family not in self._files:
            raise ValueError(f"setting must be one of {', '.join(self.families)}, got {family}")
        return self._registered[family]

    def _import_until(self, family: str, name: str) -> None:
        """Import the files of a family until one of them has registered ``name``, or all are imported."""
        for file in self._files[family]:
            import_module(file)
            if name in self._registered[family]:
                return
        self._all_of(family)

    def _all_of(self, family: str) -> list[Method]:
        """Return all methods of a family; a file may have been imported before one that stands further up."""
        methods, files = self._family(family), self._files[family]
        files = (*files, *(file for file in modules_in(package_of(files[0])) if file not in files))
        for file in files:
            import_module(file)
        return sorted(methods.values(), key=lambda method: files.index(method.function.__module__))


def package_of(module: str) -> str:
    """Return the folder that a module stands in, as ``core.lines``."""
    return module.rpartition(".")[0]


NO_RULES = ("told", "traced", "measured")
"""How the files of a topic begin that tell, trace or measure what its rules do."""


@cache
def modules_in(package: str, kind: str = "") -> tuple[str, ...]:
    """Return the modules of rules that stand in a folder itself, by name; or those of a ``kind`` of `NO_RULES`."""
    found = [
        module.name for module in pkgutil.iter_modules(import_module(package).__path__) if not module.ispkg
    ]
    wanted = [name for name in found if (name.startswith(kind) if kind else not name.startswith(NO_RULES))]
    return tuple(sorted(f"{package}.{name}" for name in wanted))


table = MethodTable({})
"""All methods of the program; `core.settings` declares the families."""


def method(
    family: str,
    name: str,
    title: str,
    *,
    source: str,
    exact_for: str,
    breaks_where: str = "",
    needs: tuple[str, ...] = (),
    takes: tuple[str, ...] = (),
    listing: Callable[..., Any] | None = None,
    operations: "Mapping[str, tuple[Operation, ...]] | None" = None,
    traits: Any = None,
) -> Callable[[Function], Function]:
    """Register the decorated function in the table."""

    def register(function: Function) -> Function:
        accounts = (title, function, source, exact_for, breaks_where, needs, takes)
        table.add(Method(family, name, *accounts, listing, operations or {}, traits))
        return function

    return register
