"""What is computed, as one tree: variables with their values, and operations on them. It knows no printer."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, replace
from typing import Any


@dataclass(frozen=True)
class Term:
    """A part of what is computed. Python's operators join terms; a plain number counts as a constant."""

    def inside(self) -> tuple["Term", ...]:
        """Return the terms that it is made of."""
        return ()

    def mapped(self, of: Callable[["Term"], "Term"]) -> "Term":
        """Return the same of other terms: ``of`` returns what stands in the place of one inside."""
        changed = {
            field.name: of(value) if isinstance(value, Term) else tuple(map(of, value))
            for field in fields(self)
            if isinstance(value := getattr(self, field.name), Term | tuple)
        }
        return replace(self, **changed)

    def every(self) -> Iterator["Term"]:
        """Yield the term and all that it is made of, to any depth."""
        yield self
        for part in self.inside():
            yield from part.every()

    def __add__(self, other: "Number") -> "Operation":
        return Operation("+", self, term(other))

    def __radd__(self, other: float) -> "Operation":
        return Operation("+", term(other), self)

    def __sub__(self, other: "Number") -> "Operation":
        return Operation("-", self, term(other))

    def __rsub__(self, other: float) -> "Operation":
        return Operation("-", term(other), self)

    def __mul__(self, other: "Number") -> "Operation":
        return Operation("*", self, term(other))

    def __rmul__(self, other: float) -> "Operation":
        return Operation("*", term(other), self)

    def __matmul__(self, other: "Term") -> "Operation":
        """Return a product that has no sign between symbols."""
        return Operation("@", self, other)

    def __truediv__(self, other: "Number") -> "Operation":
        return Operation("/", self, term(other))

    def __rtruediv__(self, other: float) -> "Operation":
        return Operation("/", term(other), self)

    def __pow__(self, other: "Number") -> "Operation":
        return Operation("**", self, term(other))

    def __neg__(self) -> "Prefix":
        return Prefix("-", self)


Number = Term | float
"""A term, or a constant."""


@dataclass(frozen=True)
class Leaf(Term):
    """A variable or an element of a list, and its value in the step; a constant has no symbol."""

    symbol: str
    value: Any


@dataclass(frozen=True)
class Operation(Term):
    """Two terms with an operator between them."""

    operator: str
    left: Term
    right: Term

    def inside(self) -> tuple[Term, ...]:
        """Return both operands."""
        return self.left, self.right


@dataclass(frozen=True)
class Prefix(Term):
    """An operator before a term."""

    operator: str
    operand: Term

    def inside(self) -> tuple[Term, ...]:
        """Return the operand."""
        return (self.operand,)


@dataclass(frozen=True)
class Joined(Term):
    """Conditions with and, or between them."""

    is_and: bool
    parts: tuple[Term, ...]

    def inside(self) -> tuple[Term, ...]:
        """Return the conditions."""
        return self.parts


@dataclass(frozen=True)
class Choice(Term):
    """One of two terms, by a condition."""

    test: Term
    yes: Term
    no: Term

    def inside(self) -> tuple[Term, ...]:
        """Return the condition and both terms."""
        return self.test, self.yes, self.no


@dataclass(frozen=True)
class Applied(Term):
    """A function of terms."""

    function: str
    arguments: tuple[Term, ...]

    def inside(self) -> tuple[Term, ...]:
        """Return the arguments."""
        return self.arguments


@dataclass(frozen=True)
class ListOf(Term):
    """A list; ``is_starred`` parts stand for their elements."""

    parts: tuple[Term, ...]

    def inside(self) -> tuple[Term, ...]:
        """Return the elements."""
        return self.parts


@dataclass(frozen=True)
class Gathered(Term):
    """A list that is told by a rule, and the same written out."""

    element: Term
    target: str
    things: Term
    written: tuple[Term, ...]

    def inside(self) -> tuple[Term, ...]:
        """Return the elements that are written out."""
        return self.written


@dataclass(frozen=True)
class Colored(Term):
    """A term in the colour of a corner."""

    corner: int
    term: Term

    def inside(self) -> tuple[Term, ...]:
        """Return the term."""
        return (self.term,)


def term(value: Number) -> Term:
    """Return a term as it is, and a plain number as a constant."""
    return value if isinstance(value, Term) else Leaf("", value)


TIGHTNESS = {
    "or": 1,
    "and": 2,
    "not": 3,
    **dict.fromkeys(("<", ">", "<=", ">=", "==", "!="), 4),
    "|": 5,
    "^": 6,
    "&": 7,
    **dict.fromkeys(("<<", ">>"), 8),
    **dict.fromkeys(("+", "-"), 9),
    **dict.fromkeys(("*", "@", "×", "/", "÷", "//", "%"), 10),
    "sign": 11,
    "**": 12,
}
"""How tightly operators bind their operands, as in Python."""
CHOICE, LEAF = 0, 20
"""The same of a choice, and of what never needs brackets."""
