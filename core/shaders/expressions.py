"""Expressions of a shader, read from its tokens."""

import re

import numpy as np

from core.lanes.nodes import Binary, Call, Choose, Constant, Expression, Field, Index, Logic, Name, Unary
from core.lanes.problem import SHADER, Place, Problem
from core.shaders.glsl_types import (
    OTHER_TYPES,
    OTHER_WORDS,
    RESERVED,
    TYPES,
    Scopes,
    Variable,
    proposal,
    typed_name,
)
from core.shaders.words import FUNCTIONS, OTHER_FUNCTIONS, Token, joined_words

LEVELS = (("||",), ("^^",), ("&&",), ("==", "!="), ("<", ">", "<=", ">="), ("+", "-"), ("*", "/", "%"))
"""Operators from the weakest to the strongest."""
STRENGTH = {operator: level for level, operators in enumerate(LEVELS) for operator in operators}
OPERATOR_LIMIT = 250
"""Operators, components and indices of one expression."""
BIT_OPERATORS = ("&", "|", "^", "<<", ">>", "~")


class ExpressionParser:
    """Reads expressions; `core.shaders.parser.Parser` reads the rest."""

    def __init__(self, tokens: list[Token]) -> None:
        self.tokens, self.at = tokens, 0
        self.scopes = Scopes()
        self.signatures: dict[str, tuple[str, tuple[str, ...], tuple[str, ...]]] = {}
        self.variables: dict[str, Variable] = {}
        self.assigned: set[str] = set()
        self.loops = 0
        self._depth = self._expressions = self._operators = 0

    # Tokens.

    @property
    def token(self) -> Token:
        """The next token."""
        return self.tokens[self.at]

    @property
    def text(self) -> str:
        """Its text; empty at the end."""
        return self.token.text

    @property
    def kind(self) -> str:
        """Its kind."""
        return self.token.kind

    @property
    def place(self) -> Place:
        """Its place."""
        return self.token.place

    def peek(self, ahead: int) -> Token:
        """Return a token behind the next one."""
        return self.tokens[min(self.at + ahead, len(self.tokens) - 1)]

    def take(self, wanted: str = "") -> str:
        """Take the next token, which must be ``wanted`` where that is given."""
        if wanted and self.text != wanted:
            raise self.expected(wanted)
        text = self.text
        if self.kind != "end":
            self.at += 1
        return text

    def take_one_of(self, wanted: tuple[str, ...]) -> str:
        """Take the next token, one of several."""
        if self.text not in wanted:
            raise self.expected(joined_words(list(wanted)))
        return self.take()

    def accept(self, text: str) -> bool:
        """Take the next token if it is this."""
        if self.kind == "end" or self.text != text:
            return False
        self.at += 1
        return True

    def expected(self, what: str) -> Problem:
        """Return the problem that something else stands here."""
        return Problem(self.place, f"expected {what}, got {self.text or 'the end of the shader'}")

    def end_statement(self) -> None:
        """Take the semicolon that ends a statement."""
        if self.accept(";"):
            return
        before = self.tokens[max(self.at - 1, 0)]
        place = Place(before.place.line, before.place.column + len(before.text))
        if self.text in BIT_OPERATORS:
            raise Problem(self.place, f"{self.text}: operations on bits are not supported here")
        if self.token.is_first or self.text == "}":
            raise Problem(place, "a ; is missing at the end of this statement")
        if self.text == "=":
            raise Problem(self.place, "= stands where the statement should end: store one value at a time")
        raise Problem(self.place, f"expected ; or an operator, got {self.text}")

    def deeper(self) -> None:
        """Note one more level of nesting."""
        self._depth += 1
        if self._depth > SHADER.brackets:
            raise Problem(self.place, f"this is nested deeper than {SHADER.brackets} levels")

    def shallower(self) -> None:
        """Note that a level has ended."""
        self._depth -= 1

    def type_name(self) -> str:
        """Take a type."""
        if self.text in TYPES:
            return self.take()
        if self.text in OTHER_TYPES:
            raise Problem(self.place, OTHER_TYPES[self.text])
        if re.fullmatch(r"mat\dx\d|uvec\d|[iu]?sampler\w+", self.text):
            raise Problem(self.place, f"{self.text} is not supported here")
        if self.kind == "name":
            raise Problem(self.place, f"expected a type, got {self.text}{self.proposed_type(self.text)}")
        raise self.expected("a type")

    def proposed_type(self, name: str) -> str:
        """Return which type may be meant."""
        return proposal(name, [*TYPES, "void", "uniform", "const", "precision", "return", "discard", "break"])

    def new_name(self) -> Token:
        """Take a name that is to be declared."""
        token = self.token
        if token.kind != "name":
            raise self.expected("a name")
        if token.text in RESERVED:
            raise Problem(token.place, f"{token.text} is a word of GLSL: choose another name")
        if "__" in token.text:
            raise Problem(token.place, "names with __ belong to GLSL: choose another name")
        self.at += 1
        return token

    def check_function_name(self, name: Token) -> None:
        """Refuse a name that GLSL has given to one of its own functions."""
        if name.text in FUNCTIONS:
            raise Problem(name.place, f"{name.text} is a function of GLSL: choose another name")

    def typed(self, name: str) -> str:
        """Return a variable's name as it was typed."""
        return typed_name(name)

    # Expressions.

    def expression(self) -> Expression:
        """Read an expression."""
        if self._expressions == 0:
            self._operators = 0
        self._expressions += 1
        self.deeper()
        place, test = self.place, self._binary(0)
        if self.accept("?"):
            yes = self.expression()
            if self.text != ":":
                raise self.expected(": between the two values of ? :")
            self.take()
            test = Choose(place, test, yes, self.expression())
        self.shallower()
        self._expressions -= 1
        return test

    def _binary(self, weakest: int) -> Expression:
        """Read operators that bind at least as strongly as a level, each with what stands on its two sides."""
        left = self._unary()
        while self.kind == "sign" and STRENGTH.get(self.text, -1) >= weakest:
            place, operator = self.place, self.take()
            self._one_more()
            right = self._binary(STRENGTH[operator] + 1)
            if operator in ("&&", "||"):
                left = Logic(place, operator == "&&", (left, right))
            else:
                left = Binary(place, operator, left, right)
        return left

    def _one_more(self) -> None:
        """Count what an expression is made of: a chain is as deep as it is long."""
        self._operators += 1
        if self._operators > OPERATOR_LIMIT:
            raise Problem(
                self.place, f"an expression may have {OPERATOR_LIMIT} operators: store a part in a variable"
            )

    def _unary(self) -> Expression:
        if self.kind == "sign" and self.text in ("-", "+", "!"):
            self.deeper()
            place, operator = self.place, self.take()
            made = Unary(place, operator, self._unary())
            self.shallower()
            return made
        if self.text in ("++", "--"):
            raise Problem(self.place, f"{self.text} is a statement of its own here: write i{self.text};")
        if self.text in BIT_OPERATORS:
            raise Problem(self.place, f"{self.text}: operations on bits are not supported here")
        return self._behind(self._primary())

    def _primary(self) -> Expression:
        place, text = self.place, self.text
        if self.accept("("):
            inner = self.expression()
            if self.text == ",":
                raise Problem(
                    self.place, "the operator , is not supported here; a vector is vec2(...), vec3(...)"
                )
            self.take(")")
            return inner
        if self.kind == "number":
            self.take()
            return Constant(place, _number(text, place))
        if self.kind == "name":
            return self._named(place, text)
        if text == "." and self.peek(1).kind == "name":
            raise Problem(place, "a name is missing before the point")
        raise self.expected("a value")

    def _named(self, place: Place, text: str) -> Expression:
        if text in ("true", "false"):
            self.take()
            return Constant(place, text == "true")
        if self.peek(1).text == "(" and self.peek(1).kind == "sign":
            return self._call(place, text)
        if text in RESERVED:
            what = (
                f"{text} is a type: write {text}(...)" if text in TYPES else f"expected a value, got {text}"
            )
            raise Problem(place, what)
        self.take()
        variable = self.scopes.find(text, place, dict.fromkeys((*self.signatures, *FUNCTIONS), ""))
        self.variables[variable.name] = variable
        return Name(place, variable.name)

    def _call(self, place: Place, name: str) -> Expression:
        self._check_called(place, name)
        self.take()
        self.take("(")
        arguments: list[Expression] = []
        while not self.accept(")"):
            if arguments and not self.accept(","):
                raise self.expected(f", or ) among the values of {name}(...)")
            if self.text == ")":
                raise Problem(self.place, f"a value is missing behind the , of {name}(...)")
            if self.text == "void":
                raise Problem(self.place, f"a call has no void: write {name}()")
            arguments.append(self.expression())
        return Call(place, name, tuple(arguments))

    def _check_called(self, place: Place, name: str) -> None:
        if name in TYPES or name in self.signatures or name in FUNCTIONS:
            if name == "main":
                raise Problem(place, "main cannot be called")
            return
        if name in OTHER_FUNCTIONS:
            raise Problem(place, OTHER_FUNCTIONS[name])
        if name in OTHER_TYPES or name in OTHER_WORDS:
            raise Problem(place, OTHER_TYPES.get(name) or OTHER_WORDS[name])
        if name in ("if", "for", "while"):
            raise Problem(place, f"{name} is a statement: is a ; missing before it?")
        if name in self.scopes.names():
            raise Problem(
                place, f"{name} is a variable and cannot be called: is a * missing before the bracket?"
            )
        known = [*FUNCTIONS, *self.signatures, *TYPES]
        more = proposal(name, known) or ": write a function before the functions that call it"
        raise Problem(place, f"there is no function {name}{more}")

    def _behind(self, whole: Expression) -> Expression:
        """Read what stands behind a value: components and indices."""
        while self.kind == "sign" and self.text in (".", "["):
            place = self.place
            self._one_more()
            if self.take() == ".":
                if self.text == "length":
                    raise Problem(
                        self.place, "arrays are not supported here; the length of a vector is length(v)"
                    )
                if self.kind != "name":
                    raise self.expected("a component, as x, behind the point")
                whole = Field(place, whole, self.take())
            else:
                whole = Index(place, whole, self.expression())
                self.take("]")
        return whole


def _number(text: str, place: Place) -> object:
    """Return a typed number: an int, or a float32."""
    if re.fullmatch(r"\d+", text):
        if len(text) > 1 and text[0] == "0":
            raise Problem(
                place, f"{text} begins with 0, which means an octal number: write {text.lstrip('0') or 0}"
            )
        if len(text) > 10 or int(text) >= 2**31:
            raise Problem(
                place, f"an int reaches to 2147483647, {text[:20]} is larger: write a float, as 1e10"
            )
        return int(text)
    if re.fullmatch(r"(\d+\.\d*|\.\d+|\d+)([eE][+-]?\d+)?[fF]?", text):
        if re.fullmatch(r"\d+[fF]", text):
            raise Problem(place, f"write {text[:-1]}.0 instead of {text}")
        with np.errstate(over="ignore"):
            number = np.float32(float(text.rstrip("fF")))
        if not np.isfinite(number):
            raise Problem(place, f"a float reaches to 3.4e38, {text[:20]} is larger")
        return number
    if re.fullmatch(r"\d+[uU]", text):
        raise Problem(place, "unsigned numbers are not supported here: write an int without u")
    if re.fullmatch(r"0[xX][0-9a-fA-F]+", text):
        raise Problem(place, "write the number with the digits 0 to 9")
    raise Problem(place, f"{text[:20]} is not a number in GLSL")
