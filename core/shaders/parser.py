"""The parser: tokens of a shader to the nodes of `core.lanes.nodes`, by recursive descent; and the walk over these.

Names are resolved while parsing, as GLSL declares everything before it is used.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from core.lanes.nodes import Declare, Function, Loop, Node, Statement
from core.lanes.problem import Place, Problem
from core.shaders.statements import StatementParser
from core.shaders.words import Token, read_tokens

# The nodes of a shader, one after the other, and how much they do.


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


# The parser: tokens of a shader to the nodes of `core.lanes.nodes`, by recursive descent.


QUALIFIERS = (
    "in",
    "out",
    "uniform",
    "const",
    "flat",
    "smooth",
    "centroid",
    "highp",
    "mediump",
    "lowp",
    "inout",
)


@dataclass(frozen=True)
class GlobalVariable:
    """A variable of the whole shader."""

    name: str
    of: str
    qualifier: str
    """``in``, ``out``, ``uniform``, ``const`` or empty."""
    is_flat: bool
    place: Place


@dataclass(frozen=True)
class Signature:
    """What a function takes and gives."""

    of: str
    """Type of its value; ``void``."""
    types: tuple[str, ...]
    parameters: tuple[str, ...]


@dataclass(frozen=True)
class Syntax:
    """A shader that was read."""

    variables: tuple[GlobalVariable, ...]
    prelude: tuple[Statement, ...]
    """The declarations of global variables that are no input."""
    functions: dict[str, Function]
    signatures: dict[str, Signature]
    returns: dict[Place, str]
    """Place of each return to the name of its function."""
    notes: tuple[str, ...]
    assigned: frozenset[str]
    """Names of variables that some line gives a value."""
    types: tuple[str, ...]
    """The type of every variable."""


class Parser(StatementParser):
    """Reads one shader; ``stage`` is ``vertex`` or ``fragment``."""

    def __init__(self, source: str, stage: str, builtins: tuple[GlobalVariable, ...], material: bool) -> None:
        tokens, notes = read_tokens(source)
        super().__init__(tokens, stage)
        self._notes = notes
        self._variables: list[GlobalVariable] = list(builtins)
        self._prelude: list[Statement] = []
        self._functions: dict[str, Function] = {}
        for variable in builtins:
            self.scopes.declare(variable.name, variable.of, Place(1), _read_only(variable.qualifier))
            if variable.qualifier == "out":
                self._prelude.append(Declare(Place(1), variable.of, variable.name, None))
        if material:
            self.scopes.predeclared = frozenset(
                variable.name for variable in builtins if not variable.name.startswith("gl_")
            )

    def read(self) -> Syntax:
        """Read the whole shader."""
        while self.kind != "end":
            self._global()
        if "main" not in self._functions:
            raise Problem(self.token.place, "there is no function main: write void main() { ... }")
        return Syntax(
            tuple(self._variables),
            tuple(self._prelude),
            self._functions,
            {name: Signature(*parts) for name, parts in self.signatures.items()},
            self.returns,
            tuple(self._notes),
            frozenset(self.assigned),
            tuple(self.types),
        )

    # Global declarations.

    def _global(self) -> None:
        if self.accept(";"):
            return
        if self.accept("precision"):
            self._precision()
            return
        self.refuse_unsupported()
        start = self.token
        if self.accept("layout"):
            self._layout()
        qualifiers = []
        while self.text in QUALIFIERS:
            qualifiers.append(self.take())
        is_void = self.text == "void"
        of = self.take() if is_void else self.type_name()
        name = self.new_name()
        if self.text == "(":
            if set(qualifiers) - {"highp", "mediump", "lowp"}:
                raise Problem(start.place, f"a function has no {qualifiers[0]}")
            self._function(of, name)
            return
        if is_void:
            raise Problem(start.place, f"a variable cannot be void: write a type before {name.text}")
        self._global_variables(of, name, qualifiers, start)

    def _precision(self) -> None:
        self.take_one_of(("highp", "mediump", "lowp"))
        if self.text not in ("float", "int", "sampler2D"):
            raise Problem(self.place, "a precision is that of float, int or sampler2D")
        word = self.tokens[self.at - 1].text
        of = self.take()
        if word != "highp":
            self._notes.append(f"precision {word} {of} was read: everything is computed in highp here.")
        self.end_statement()

    def _layout(self) -> None:
        self.take("(")
        while self.text not in (")", ""):
            if self.text == "std140":
                raise Problem(
                    self.place, "uniform blocks are not supported here: declare each uniform by itself"
                )
            self.take()
        self.take(")")

    def _global_variables(self, of: str, name: Token, qualifiers: list[str], start: Token) -> None:
        storage = [word for word in qualifiers if word in ("in", "out", "uniform", "const", "inout")]
        if len(storage) > 1 or "inout" in storage:
            raise Problem(
                start.place, f"{' '.join(storage)} does not go together: write one of in, out, uniform"
            )
        qualifier = storage[0] if storage else ""
        is_flat = "flat" in qualifiers
        between = (self.stage == "vertex" and qualifier == "out") or (
            self.stage == "fragment" and qualifier == "in"
        )
        if between and of in ("int", "ivec2", "ivec3", "ivec4") and not is_flat:
            raise Problem(start.place, f"whole numbers are not interpolated: write flat {qualifier} {of}")
        if of.startswith("b") and qualifier in ("in", "out"):
            raise Problem(start.place, f"{of} cannot be {qualifier}: use float or int")
        if of == "sampler2D" and qualifier != "uniform":
            raise Problem(start.place, f"a sampler2D must be uniform: write uniform sampler2D {name.text};")
        while True:
            variable = self.declared(of, name, _read_only(qualifier))
            if self.text == "[":
                raise Problem(
                    self.place, "arrays are not supported here: use vectors, or one variable for each"
                )
            value = None
            if self.text == "=":
                if qualifier in ("in", "out", "uniform"):
                    raise Problem(self.place, f"{qualifier} {name.text} cannot have a value here")
                self.take()
                value = self.expression()
            elif qualifier == "const":
                raise Problem(name.place, f"a const needs its value: write const {of} {name.text} = ...;")
            self._variables.append(GlobalVariable(variable, of, qualifier, is_flat, name.place))
            if qualifier not in ("in", "uniform"):
                self._prelude.append(Declare(name.place, of, variable, value))
            if not self.accept(","):
                break
            name = self.new_name()
        self.end_statement()

    # Functions.

    def _function(self, of: str, name: Token) -> None:
        self.check_function_name(name)
        self.take("(")
        self.scopes.begin()
        types: list[str] = []
        parameters: list[str] = []
        while not self.accept(")"):
            if parameters:
                self.take(",")
            if self.text == "void" and self.peek(1).text == ")":
                self.take()
                continue
            self.accept("const")
            if self.text in ("out", "inout"):
                raise Problem(
                    self.place, f"{self.text} parameters are not supported here: return the value instead"
                )
            self.accept("in")
            while self.text in ("highp", "mediump", "lowp"):
                self.take()
            types.append(self.type_name())
            if self.kind == "name":
                parameters.append(self.declared(types[-1], self.new_name()))
            else:
                parameters.append("")
            if self.text == "[":
                raise Problem(
                    self.place, "arrays are not supported here: use vectors, or one variable for each"
                )
        if self.accept(";"):
            self.scopes.end()
            self._begin_function(of, name, types, parameters)
            return
        if "" in parameters:
            raise Problem(name.place, f"a parameter of {name.text} has no name")
        if name.text == "main" and (of != "void" or types):
            raise Problem(name.place, "main takes nothing and gives nothing: write void main() { ... }")
        if name.text in self._functions:
            raise Problem(
                name.place,
                f"{name.text} is there twice: overloading is not supported here, choose another name",
            )
        self._begin_function(of, name, types, parameters)
        self.in_function = name.text
        if self.text != "{":
            raise self.expected("{ to begin the function")
        body = self.braced()
        self.in_function = ""
        self.scopes.end()
        self._functions[name.text] = Function(name.place, name.text, tuple(parameters), body, of == "void")

    def _begin_function(self, of: str, name: Token, types: list[str], parameters: list[str]) -> None:
        known = self.signatures.get(name.text)
        if known is not None and (known[0] != of or known[1] != tuple(types)):
            raise Problem(
                name.place, f"{name.text} was declared with other types: overloading is not supported here"
            )
        self.signatures[name.text] = (of, tuple(types), tuple(parameters))


def _read_only(qualifier: str) -> str:
    return qualifier if qualifier in ("in", "uniform", "const") else ""
