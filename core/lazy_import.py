"""Names of a package that are imported when they are first asked for (PEP 562)."""

from collections.abc import Callable
from importlib import import_module
from typing import Any


def imported(place: str) -> Any:
    """Return what stands at a place, ``module.name``."""
    module, _, name = place.rpartition(".")
    return getattr(import_module(module), name)


def import_on_demand(package: dict[str, Any], **places: str) -> Callable[[str], Any]:
    """Return the ``__getattr__`` of a package.

    Parameters
    ----------
    package : dict
        The package's ``globals()``: what was imported once stands there from then on.
    **places : str
        The module of every name.

    Notes
    -----
    Type checkers do not follow this: give them the same names below ``if TYPE_CHECKING``. A module of the package must
    not be called like one of the names, as importing it would put the module in the name's place.
    """

    def find(name: str) -> Any:
        if name not in places:
            raise AttributeError(f"module {package['__name__']!r} has no attribute {name!r}")
        package[name] = imported(f"{places[name]}.{name}")
        return package[name]

    return find
