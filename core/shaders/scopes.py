"""The names of a shader: what is declared where, and what is said of one that is not.

Every variable gets a name of its own, ``x·2`` where another is called ``x``, so that a function's variables need no
frame: GLSL has no recursion.
"""

from dataclasses import dataclass
from difflib import get_close_matches

from core.lanes.problem import Place, Problem
from core.shaders.other_words import OTHER_WORDS

MARK = "·"
"""Between the typed name and a number, where several variables have it."""


@dataclass(frozen=True, slots=True)
class Variable:
    """A declared variable."""

    name: str
    """Its own, which no other has."""
    of: str
    """Its type."""
    read_only: str = ""
    """Why it cannot be assigned to: ``in``, ``uniform``, ``const``; empty: it can."""


def typed_name(name: str) -> str:
    """Return a variable's name as it was typed."""
    return name.partition(MARK)[0]


class Scopes:
    """The scopes that are open, the outermost first."""

    def __init__(self) -> None:
        self._open: list[dict[str, Variable]] = [{}]
        self._taken: dict[str, int] = {}
        self.declared_elsewhere: dict[str, str] = {}
        """Names that only ShaderMaterial declares, with their declarations."""
        self.predeclared: frozenset[str] = frozenset()

    def begin(self) -> None:
        """Open a scope."""
        self._open.append({})

    def end(self) -> None:
        """Close the innermost one."""
        self._open.pop()

    @property
    def is_global(self) -> bool:
        """Whether no function's scope is open."""
        return len(self._open) == 1

    def declare(self, name: str, of: str, place: Place, read_only: str = "") -> Variable:
        """Declare a variable in the innermost scope."""
        if name in self._open[-1]:
            if self.is_global and name in self.predeclared:
                raise Problem(
                    place,
                    f"ShaderMaterial declares {name} already: delete this line, or switch to RawShaderMaterial",
                )
            raise Problem(place, f"{name} is declared twice")
        number = self._taken[name] = self._taken.get(name, 0) + 1
        own = name if number == 1 else f"{name}{MARK}{number}"
        variable = self._open[-1][name] = Variable(own, of, read_only)
        return variable

    def find(self, name: str, place: Place, functions: dict[str, str]) -> Variable:
        """Return the variable of a name; ``functions`` are those that would be proposed beside variables."""
        for scope in reversed(self._open):
            if name in scope:
                return scope[name]
        if name in OTHER_WORDS:
            raise Problem(place, OTHER_WORDS[name])
        if name in self.declared_elsewhere:
            declaration = self.declared_elsewhere[name]
            raise Problem(
                place,
                f"{name} is not declared: only ShaderMaterial declares it. Switch to it, or write {declaration};",
            )
        if name in functions:
            other = proposal(name, self.names()).removeprefix(": did you mean ").removesuffix("?")
            more = f", or did you mean {other}?" if other else ""
            raise Problem(place, f"{name} is a function: write {name}(...){more}")
        raise Problem(place, f"{name} is not declared{proposal(name, self.names())}")

    def names(self) -> list[str]:
        """Return all names that are declared here."""
        return [name for scope in self._open for name in scope]


def proposal(name: str, known: list[str]) -> str:
    """Return ``: did you mean ...?`` where a known name is close, else nothing."""
    same = [other for other in known if other.lower() == name.lower() and other != name]
    close = same or (get_close_matches(name, known, 1, 0.7) if len(name) > 2 else [])
    return f": did you mean {close[0]}?" if close else ""
