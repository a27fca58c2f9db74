r"""Reads the line of numbers of a formula back, as someone does who checks it from what is shown.

A line is cut into statements at ``\quad``, ``\land`` and ``\Rightarrow``. Sides that are no arithmetic (names, codes,
words) leave their statement unread.
"""

import math
import re
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction

from core.explain.formulas import Chain
from core.explain.latex import split_cells
from core.explain.term_latex import in_full, is_arithmetic, work_out
from core.records.terms import Applied, Leaf, ListOf, Operation, Prefix, Term

RELATIONS = ("=", "<", ">", r"\le", r"\ge", r"\ne", r"\approx", r"\equiv")
MODULUS = r"(\mathrm{mod}"
"""How the modulus of a congruence begins."""
BREAKS = (r"\quad", r"\land", r"\lor", r"\Rightarrow")
"""What stands between statements."""
_TOKEN = re.compile(r"\s+|\\[,;! ]|(?P<number>\d+\.?\d*|\.\d+)|(?P<word>\\[A-Za-z]+)|(?P<sign>.)")
_SCRIPTED = re.compile(r"\\mathrm\{([a-z][a-z0-9]*)\}|\\log_(?:\{\{2\}\}|\{2\}|2)")


class UnreadError(ValueError):
    """A side is no arithmetic."""


def read(text: str) -> Term:
    """Read arithmetic in LaTeX; UnreadError for anything else."""
    reader = _Reader(text)
    found = reader.sum()
    if reader.place < len(reader.tokens) or isinstance(found, ListOf) or not is_arithmetic(found):
        raise UnreadError(text)
    return found


@dataclass(frozen=True)
class ReadNumber(Leaf):
    """A number that was read, and its significant digits."""

    digits: int


class _Reader:
    """Reads tokens from left to right; every method takes what belongs to it."""

    def __init__(self, text: str) -> None:
        named = _SCRIPTED.sub(lambda found: rf"\{(found[1] or 'log').rstrip('0123456789')} ", text)
        self.tokens = [m for m in _TOKEN.finditer(named) if m.lastgroup is not None]
        self.place = 0

    def next(self) -> str:
        """Return the next token without taking it; at the end an empty text."""
        return self.tokens[self.place][0] if self.place < len(self.tokens) else ""

    def take(self, wanted: str = "") -> str:
        found = self.next()
        if not found or (wanted and found != wanted):
            raise UnreadError(found)
        self.place += 1
        return found

    def sum(self) -> Term:
        found = self.product()
        while self.next() in ("+", "-"):
            found = Operation(self.take(), found, self.product())
        return found

    def product(self) -> Term:
        found = self.power()
        while True:
            if self.next() in (r"\cdot", r"\times"):
                self.take()
                found = found * self.power()
            elif self.next() == "/":
                self.take()
                found = found / self.power()
            elif self.next() in ("(", r"\frac", r"\lfloor", r"\sqrt"):
                found = found * self.power()
            else:
                return found

    def power(self) -> Term:
        if self.next() == "-":
            self.take()
            return -self.power()
        found = self.one()
        if self.next() == "^":
            self.take()
            found = found ** self.one()
        return found

    def one(self) -> Term:
        start = self.place
        token = self.take()
        if self.tokens[start].lastgroup == "number":
            number = ReadNumber("", Fraction(token), len(token.replace(".", "").lstrip("0")))
            # A mixed fraction stands without a space: 382 250/256.
            if self.next() == r"\frac" and self.tokens[self.place].start() == self.tokens[start].end():
                return number + self.one()
            return number
        match token:
            case "(":
                return self.bracketed(")")
            case "{":
                return _with_power_of_ten(self.bracketed("}"))
            case "|":
                found = self.sum()
                self.take("|")
                return Applied("abs", (found,))
            case r"\frac":
                return self.one() / self.one()
            case r"\lfloor" | r"\lceil":
                found = self.sum()
                self.take(rf"\r{token[2:]}")
                return Applied(token[2:], (found,))
            case r"\infty":
                return Leaf("", math.inf)
            case r"\vertex":
                self.one()
                return self.one()
            case r"\min" | r"\max" | r"\sqrt" | r"\round" | r"\sign" | r"\log" | r"\float":
                found = self.power()
                name = {"log": "log2", "float": "float32"}.get(token[1:], token[1:])
                return Applied(name, found.parts if isinstance(found, ListOf) else (found,))
        raise UnreadError(token)

    def bracketed(self, end: str) -> Term:
        parts = [self.sum()]
        while self.next() == ",":
            self.take()
            parts.append(self.sum())
        self.take(end)
        return parts[0] if len(parts) == 1 else ListOf(tuple(parts))


def _with_power_of_ten(found: Term) -> Term:
    r"""Return a term, or the number that is written as ``{1.5 \cdot 10^{-3}}``."""
    match found:
        case Operation("*", Leaf() | Prefix() as mantissa, Operation("**", Leaf(_, 10), _)):
            value = Fraction(work_out(found)[0])
            digits = max(part.digits for part in mantissa.every() if isinstance(part, ReadNumber))
            number = ReadNumber("", abs(value), digits)
            return -number if isinstance(mantissa, Prefix) else number
    return found


def statements(line: str) -> list[Chain]:
    """Return the statements of a line of numbers that can be read as arithmetic."""
    found: list[Chain] = []
    sides: list[list[str]] = [[]]
    signs: list[str] = []
    for cell in (*split_cells(line), r"\quad"):
        if cell in RELATIONS:
            signs.append(cell)
            sides.append([])
        elif cell not in BREAKS:
            sides[-1].append(cell)
        elif sides[0] and sides[0][0].startswith(MODULUS):
            modulus, _ = work_out(read(sides[0][0][len(MODULUS) : -1]))
            found[-1] = replace(found[-1], modulus=round(math.log2(modulus)))
            sides = [[]]
        else:
            with suppress(UnreadError):
                read_sides = tuple(read(" ".join(side)) for side in sides)
                found += [Chain(read_sides, tuple(signs))] if signs else []
            sides, signs = [[]], []
    return found


def holds(statement: Chain) -> bool:
    """Return whether a statement that was read holds for the digits that it shows."""
    return statement.holds(in_full, digits_shown)


def digits_shown(number: Leaf) -> int:
    """Return the significant digits of a number that was read."""
    return number.digits if isinstance(number, ReadNumber) else 0
