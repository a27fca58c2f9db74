"""The tree of a program, whatever language it was typed in: statements and expressions with their places."""

from dataclasses import dataclass
from typing import Any

from core.lanes.problem import Place


@dataclass(frozen=True, slots=True)
class Node:
    """What stands at a place."""

    place: Place


@dataclass(frozen=True, slots=True)
class Expression(Node):
    """What has a value."""


@dataclass(frozen=True, slots=True)
class Constant(Expression):
    """A number, a flag, a text or None."""

    value: Any


@dataclass(frozen=True, slots=True)
class Name(Expression):
    """A variable."""

    name: str


@dataclass(frozen=True, slots=True)
class Binary(Expression):
    """``left operator right``, also comparisons."""

    operator: str
    left: Expression
    right: Expression


@dataclass(frozen=True, slots=True)
class Unary(Expression):
    """``operator operand``."""

    operator: str
    operand: Expression


@dataclass(frozen=True, slots=True)
class Logic(Expression):
    """``and``, else ``or``, of two parts or more: the next is looked at only where it still matters."""

    is_and: bool
    parts: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Choose(Expression):
    """One of two values."""

    test: Expression
    yes: Expression
    no: Expression


@dataclass(frozen=True, slots=True)
class Index(Expression):
    """``whole[index]``."""

    whole: Expression
    index: Expression


@dataclass(frozen=True, slots=True)
class Field(Expression):
    """``whole.name``."""

    whole: Expression
    name: str


@dataclass(frozen=True, slots=True)
class Star(Expression):
    """The elements of a list among the parts of another."""

    part: Expression


@dataclass(frozen=True, slots=True)
class Many(Expression):
    """A list or a tuple."""

    parts: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Gather(Expression):
    """A list with an element for each of some things, where all tests hold."""

    element: Expression
    target: Expression
    things: Expression
    tests: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Call(Expression):
    """A function of the program, of the language, or of another listing."""

    function: str
    arguments: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Statement(Node):
    """What is done."""


@dataclass(frozen=True, slots=True)
class Nothing(Statement):
    """Nothing is done."""


@dataclass(frozen=True, slots=True)
class Block(Statement):
    """One statement after the other."""

    body: tuple[Statement, ...]


@dataclass(frozen=True, slots=True)
class Assign(Statement):
    """A value is stored in a variable, in a part of one, or in several."""

    target: Expression
    value: Expression


@dataclass(frozen=True, slots=True)
class Declare(Statement):
    """A variable of a type begins, with a value or without."""

    of: Any
    name: str
    value: Expression | None


@dataclass(frozen=True, slots=True)
class Put(Statement):
    """A value is put at the end of a list."""

    name: str
    value: Expression


@dataclass(frozen=True, slots=True)
class Evaluate(Statement):
    """A value is computed and dropped."""

    value: Expression


@dataclass(frozen=True, slots=True)
class If(Statement):
    """One of two branches."""

    test: Expression
    yes: tuple[Statement, ...]
    no: tuple[Statement, ...]


@dataclass(frozen=True, slots=True)
class Loop(Statement):
    """As long as a test holds; ``step`` follows each round, also one that ``continue`` has ended."""

    test: Expression
    body: tuple[Statement, ...]
    step: Statement | None = None


@dataclass(frozen=True, slots=True)
class Each(Statement):
    """Once for each of some things."""

    target: Expression
    things: Expression
    body: tuple[Statement, ...]


@dataclass(frozen=True, slots=True)
class Break(Statement):
    """Leave the loop."""


@dataclass(frozen=True, slots=True)
class Continue(Statement):
    """Go on with the loop's next round."""


@dataclass(frozen=True, slots=True)
class Return(Statement):
    """Leave the function with a value."""

    value: Expression | None


@dataclass(frozen=True, slots=True)
class Discard(Statement):
    """End the lane; it stays as a helper of its neighbours."""


@dataclass(frozen=True, slots=True)
class Function(Node):
    """A function of a program."""

    name: str
    parameters: tuple[str, ...]
    body: tuple[Statement, ...]
    is_void: bool = False
    """Whether it may end without a return."""
