"""Statements of a shader, read from its tokens."""

from core.lanes.nodes import (
    Assign,
    Binary,
    Block,
    Break,
    Constant,
    Continue,
    Declare,
    Discard,
    Evaluate,
    Expression,
    If,
    Index,
    Loop,
    Name,
    Nothing,
    Return,
    Statement,
)
from core.lanes.nodes import Field as Component
from core.lanes.problem import Place, Problem
from core.shaders.expressions import ExpressionParser
from core.shaders.glsl_types import OTHER_TYPES, TYPES, component_count
from core.shaders.words import Token

VARIABLE_LIMIT = 1_024
"""Numbers that all variables of a shader have together, for one lane."""
UNSUPPORTED = {
    "struct": "struct is not supported here: use one variable for each part",
    "switch": "switch is not supported here: write if and else",
    "do": "do is not supported here: write for or while",
    "invariant": "invariant is not supported here: every run computes the same anyway",
}
COMPOUND = ("+=", "-=", "*=", "/=", "%=")


class StatementParser(ExpressionParser):
    """Reads statements; ``stage`` is ``vertex`` or ``fragment``."""

    def __init__(self, tokens: list[Token], stage: str) -> None:
        super().__init__(tokens)
        self.stage = stage
        self.in_function = ""
        """Name of the function whose body is read."""
        self.returns: dict[Place, str] = {}
        self.types: list[str] = []
        """Of all variables that were declared."""
        self._numbers = 0

    def declared(self, of: str, name: Token, read_only: str = "") -> str:
        """Declare a variable, and return its own name."""
        self._numbers += component_count(of)
        self.types.append(of)
        if self._numbers > VARIABLE_LIMIT:
            raise Problem(
                name.place, f"the variables of a shader may have {VARIABLE_LIMIT:,} numbers together"
            )
        if name.text.startswith("gl_"):
            raise Problem(
                name.place, f"names that begin with gl_ belong to GLSL: choose another for {name.text}"
            )
        return self.scopes.declare(name.text, of, name.place, read_only).name

    def braced(self) -> tuple[Statement, ...]:
        """Read statements in braces, in the scope that is open."""
        place = self.place
        self.take("{")
        body: list[Statement] = []
        while not self.accept("}"):
            body.append(self._statement())
        return tuple(body) or (Nothing(place),)

    def _scoped(self) -> tuple[Statement, ...]:
        """Read one statement, or several in braces, in a scope of their own."""
        self.scopes.begin()
        if self.text == "{":
            body = self.braced()
        else:
            body = (self._statement(),)
        self.scopes.end()
        return body

    def refuse_unsupported(self) -> None:
        """Say that a word of GLSL is not supported here."""
        if self.text in UNSUPPORTED:
            raise Problem(self.place, UNSUPPORTED[self.text])

    def _statement(self) -> Statement:
        self.deeper()
        place, word = self.place, self.text
        self.refuse_unsupported()
        made: Statement
        if word == "{":
            made = Block(place, self._scoped())
        elif word == ";":
            self.take()
            made = Nothing(place)
        elif word == "if":
            made = self._if()
        elif word == "for":
            made = self._for()
        elif word == "while":
            self.take()
            test = self._condition()
            self.loops += 1
            made = Loop(place, test, self._scoped())
            self.loops -= 1
        elif word == "else":
            raise Problem(place, "this else has no if before it")
        elif word == "return":
            made = self._return()
        elif word == "discard":
            self.take()
            if self.stage != "fragment":
                raise Problem(place, "only a fragment can be discarded: a vertex shader has no discard")
            self.end_statement()
            made = Discard(place)
        elif word in ("break", "continue"):
            self.take()
            self.end_statement()
            if not self.loops:
                raise Problem(place, f"{word} stands outside of a loop")
            made = Break(place) if word == "break" else Continue(place)
        else:
            made = self._simple()
            self.end_statement()
        self.shallower()
        return made

    def _condition(self) -> Expression:
        if self.text != "(":
            raise self.expected("( before the condition")
        self.take("(")
        test = self.expression()
        if self.text == "=":
            raise Problem(self.place, "= stores a value: to compare write ==")
        self.take(")")
        return test

    def _if(self) -> Statement:
        place = self.place
        self.take()
        test = self._condition()
        yes = self._scoped()
        no = self._scoped() if self.accept("else") else ()
        return If(place, test, yes, no)

    def _for(self) -> Statement:
        place = self.place
        self.take()
        if self.text != "(":
            raise self.expected("( after for")
        self.take("(")
        self.scopes.begin()
        begin = Nothing(place) if self.text == ";" else self._simple()
        self._loop_part()
        test: Expression = Constant(place, True) if self.text == ";" else self.expression()
        self._loop_part()
        step = None if self.text == ")" else self._simple()
        self.take(")")
        self.loops += 1
        body = self._scoped()
        self.loops -= 1
        self.scopes.end()
        return Block(place, (begin, Loop(place, test, body, step)))

    def _loop_part(self) -> None:
        if self.text == ",":
            raise Problem(self.place, "one statement in each part of a loop's head: , is not supported here")
        if self.text != ";":
            raise self.expected("; between the parts of a loop's head (for (int i = 0; i < 4; i++))")
        self.take()

    def _return(self) -> Statement:
        place = self.place
        self.take()
        of = self.signatures[self.in_function][0]
        value = None if self.text == ";" else self.expression()
        self.end_statement()
        if of == "void" and value is not None:
            raise Problem(place, f"{self.in_function} is void: it returns nothing, write return;")
        if of != "void" and value is None:
            raise Problem(place, f"{self.in_function} gives {of}: write return with a value")
        self.returns[place] = self.in_function
        return Return(place, value)

    def _simple(self) -> Statement:
        """Read a declaration, an assignment or a call, without the semicolon behind it."""
        place = self.place
        is_const = self.accept("const")
        while self.text in ("highp", "mediump", "lowp"):
            self.take()
        if self.text in ("in", "out", "uniform"):
            raise Problem(place, f"{self.text} variables are declared outside of all functions")
        if self.text in TYPES and self.peek(1).kind == "name":
            return self._declaration(is_const)
        if is_const:
            raise self.expected("a type after const")
        if self.text in ("++", "--"):
            raise Problem(place, f"write it behind the name: i{self.text}")
        if self.kind == "name" and self.peek(1).kind == "name":
            if self.text in OTHER_TYPES:
                raise Problem(place, OTHER_TYPES[self.text])
            raise Problem(place, f"{self.text} is no type{self.proposed_type(self.text)}")
        left = self.expression()
        if self.text == "=":
            self.take()
            return Assign(place, self._target(left), self.expression())
        if self.text in COMPOUND:
            operator = self.take()[0]
            operand = self.expression()
            return Assign(place, self._target(left), Binary(place, operator, left, operand))
        if self.text in ("++", "--"):
            operator = self.take()
            return Assign(place, self._target(left), Binary(place, operator, left, Constant(place, 1)))
        if self.text in ("&=", "|=", "^=", "<<=", ">>="):
            raise Problem(self.place, f"{self.text}: operations on bits are not supported here")
        if isinstance(left, Binary) and left.operator == "==" and isinstance(left.left, Name):
            raise Problem(left.place, "== compares: to store a value write =")
        return Evaluate(place, left)

    def _declaration(self, is_const: bool) -> Statement:
        of, made = self.type_name(), []
        if of == "sampler2D":
            raise Problem(self.place, "a sampler2D must be uniform, outside of all functions")
        while True:
            name = self.new_name()
            if self.text == "[":
                raise Problem(
                    self.place, "arrays are not supported here: use vectors, or one variable for each"
                )
            if self.text == "(":
                raise Problem(
                    name.place, "a function cannot stand inside of another: is a } missing before it?"
                )
            value = self.expression() if self.accept("=") else None
            if is_const and value is None:
                raise Problem(name.place, f"a const needs its value: write const {of} {name.text} = ...;")
            own = self.declared(of, name, "const" if is_const else "")
            made.append(Declare(name.place, of, own, value))
            if not self.accept(","):
                break
        return made[0] if len(made) == 1 else Block(made[0].place, tuple(made))

    def _target(self, left: Expression) -> Expression:
        """Return what is assigned to; a component by one letter of a column becomes an index."""
        node, depth = left, 0
        while isinstance(node, Component | Index):
            node, depth = node.whole, depth + 1
        if not isinstance(node, Name):
            raise Problem(left.place, "nothing can be stored here: the left side of = must be a variable")
        variable = self.variables[node.name]
        if variable.read_only:
            typed = self.typed(node.name)
            why = {
                "in": f"{typed} is an in variable: it can only be read",
                "uniform": f"{typed} is a uniform: a shader can only read it",
                "const": f"{typed} is const: it keeps its value",
            }[variable.read_only]
            raise Problem(left.place, why)
        self.assigned.add(node.name)
        if depth > 2:
            raise Problem(left.place, "store in a variable, in one part of it, or in one number of a column")
        if depth == 2 and isinstance(left, Component):
            if not isinstance(left.whole, Index):
                raise Problem(
                    left.place, f"write one selection of components on the left side, not .{left.name} again"
                )
            if len(left.name) > 1:
                raise Problem(
                    left.place, "store in a whole column, as m[0] = ..., or in one number, as m[0].x = ..."
                )
            letters = next((each for each in ("xyzw", "rgba", "stpq") if left.name in each), "")
            if not letters:
                raise Problem(left.place, f".{left.name} is no component: a vector has x, y, z, w")
            return Index(left.place, left.whole, Constant(left.place, letters.index(left.name)))
        if depth == 2 and isinstance(left, Index) and isinstance(left.whole, Component):
            raise Problem(left.place, "write the component's letter on the left side, as v.y = ...")
        return left
