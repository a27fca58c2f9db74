"""What a step computes as one tree of terms, with its printers: in symbols, in numbers, and in plain words."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from core.lanes.nodes import (
    Assign,
    Binary,
    Call,
    Choose,
    Constant,
    Declare,
    Each,
    Expression,
    Field,
    Gather,
    Index,
    Logic,
    Many,
    Name,
    Put,
    Return,
    Star,
    Unary,
)
from core.lanes.program import LaneStep
from core.records.terms import (
    CHOICE,
    LEAF,
    TIGHTNESS,
    Applied,
    Choice,
    Gathered,
    Joined,
    Leaf,
    ListOf,
    Operation,
    Prefix,
    Term,
)

MINUS, TIMES = "\u2212", "\u00b7"
DIGITS = 4
LONGEST_LIST = 4
"""Elements of a list that are written out."""
SHOWN = {"*": TIMES, "-": MINUS}


@dataclass(frozen=True)
class Equality:
    """What a step gives: ``symbol = right = result``; no symbol: a condition, or a value that is put or returned."""

    symbol: str
    right: Term
    result: Any


def _named(target: Expression, now: Mapping[str, Any]) -> str:
    """Print what is given a value: several names stand in brackets, as their values do."""
    return _in_brackets(term_of(target, now))


def _in_brackets(target: Term) -> str:
    if isinstance(target, ListOf):
        return f"({', '.join(map(_in_brackets, target.parts))})"
    return in_symbols(target)


def equalities(step: LaneStep) -> tuple[Equality, ...]:
    """Return what a step computes; of several names on the left of = one for each, where they can be told apart."""
    node = step.statement
    match node:
        case Assign(_, Many(_, targets), Many(_, values)) if _are_paired(targets, values):
            return tuple(
                Equality(_named(target, step.before), term_of(value, step.before), result)
                for target, value, result in zip(targets, values, step.value, strict=True)
            )
        case Assign(_, target, value):
            return (Equality(_named(target, step.before), term_of(value, step.before), step.value),)
        case Declare(_, _, name, value):
            right = Leaf("", step.value) if value is None else term_of(value, step.before)
            return (Equality(name, right, step.value),)
        case Each(_, target):
            return (Equality(_named(target, step.after), Leaf("", step.value), step.value),)
        case Put(_, name, value):
            return (Equality(name, term_of(value, step.before), step.value),)
        case Return(_, None):
            return ()
        case Return(_, Expression() as value):
            return (Equality("", term_of(value, step.before), step.value),)
    return (Equality("", term_of(node.test, step.before), step.value),)  # type: ignore[attr-defined]


def _are_paired(targets: Sequence[Expression], values: Sequence[Expression]) -> bool:
    return len(targets) == len(values) and not any(isinstance(one, Star) for one in (*targets, *values))


def term_of(node: Expression, now: Mapping[str, Any]) -> Term:
    """Return the term of an expression; ``now`` are the variables of the step."""
    match node:
        case Constant(_, value):
            return Leaf("", value)
        case Name(_, name):
            return Leaf(name, now.get(name))
        case Binary(_, operator, left, right):
            return Operation(operator, term_of(left, now), term_of(right, now))
        case Unary(_, operator, operand):
            return Prefix(operator, term_of(operand, now))
        case Logic(_, is_and, parts):
            return Joined(is_and, tuple(term_of(part, now) for part in parts))
        case Choose(_, test, yes, no):
            return Choice(term_of(test, now), term_of(yes, now), term_of(no, now))
        case Many(_, parts):
            return ListOf(tuple(term_of(part, now) for part in parts))
        case Star(_, part):
            return Prefix("*", term_of(part, now))
        case Call(_, function, arguments):
            return Applied(function, tuple(term_of(argument, now) for argument in arguments))
        case Index():
            return _element(node, now)
        case Field(_, whole, name):
            of = term_of(whole, now)
            text = in_symbols(of)
            return Leaf(f"{text if isinstance(of, Leaf | Applied) else f'({text})'}.{name}", None)
        case Gather():
            return _gathered(node, now)
    raise AssertionError(f"{type(node).__name__} is no term")


def _element(node: Index, now: Mapping[str, Any]) -> Term:
    whole, index = term_of(node.whole, now), term_of(node.index, now)
    symbol = f"{in_symbols(whole)}[{in_symbols(index)}]"
    held = whole.value if isinstance(whole, Leaf) else None
    at = index.value if isinstance(index, Leaf) else _worked_out(index)
    if isinstance(held, list) and isinstance(at, int) and -len(held) <= at < len(held):
        return Leaf(symbol, held[at])
    return Leaf(symbol, None)


def _worked_out(term: Term) -> Any:
    """Return a whole number that is a sum or a difference of two, as an index often is."""
    match term:
        case Operation("+" | "-" as operator, Leaf(_, int() as left), Leaf(_, int() as right)):
            return left + right if operator == "+" else left - right
        case Prefix("-", Leaf(_, int() as value)):
            return -value
    return None


def _gathered(node: Gather, now: Mapping[str, Any]) -> Term:
    element, things = term_of(node.element, now), term_of(node.things, now)
    target = _named(node.target, now)
    written: tuple[Term, ...] = ()
    match node:
        case Gather(_, _, Name(_, name), Call(_, "range", (Constant(_, int() as count),)), ()):
            if 0 <= count <= LONGEST_LIST:
                written = tuple(term_of(node.element, {**now, name: k}) for k in range(count))
    return Gathered(element, target, things, written)


def shown(value: Any) -> str:
    """Return a value as it is read: four significant digits, a list up to four elements."""
    if value is None:
        return "nothing"
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    if isinstance(value, list):
        if len(value) > LONGEST_LIST:
            return f"{len(value)} values"
        return "[" + ", ".join(map(shown, value)) + "]"
    if isinstance(value, int):
        return str(value).replace("-", MINUS)
    if isinstance(value, float | np.floating):
        return f"{float(value):.{DIGITS}g}".replace("-", MINUS)
    return str(value)


def in_symbols(term: Term, *, is_glsl: bool = False) -> str:
    """Print a term as it was typed."""
    return _printed(term, False, is_glsl)[0]


def in_numbers(term: Term, *, is_glsl: bool = False) -> str:
    """Print a term with the numbers of its step put in."""
    return _printed(term, True, is_glsl)[0]


def _printed(term: Term, puts_in: bool, is_glsl: bool) -> tuple[str, int]:
    """Return the text of a term, and how tightly it holds together; ``is_glsl``: a shader's choice has ``? :``."""

    def inner(part: Term, least: int) -> str:
        text, tight = _printed(part, puts_in, is_glsl)
        return f"({text})" if tight < least else text

    match term:
        case Leaf(symbol, value):
            is_put_in = not symbol or (puts_in and value is not None and not isinstance(value, list))
            text = shown(value) if is_put_in else symbol
            return text, TIGHTNESS["sign"] if text.startswith(MINUS) else LEAF
        case Operation(operator, left, right):
            tight = TIGHTNESS[operator]
            after = inner(right, tight + 1)
            if after.startswith(MINUS):
                after = f"({after})"
            return f"{inner(left, tight)} {SHOWN.get(operator, operator)} {after}", tight
        case Prefix("not", operand):
            return f"not {inner(operand, TIGHTNESS['not'])}", TIGHTNESS["not"]
        case Prefix(operator, operand):
            sign = MINUS if operator == "-" else operator
            return f"{sign}{inner(operand, LEAF)}", TIGHTNESS["sign"]
        case Joined(is_and, parts):
            word = "and" if is_and else "or"
            tight = TIGHTNESS[word]
            return f" {word} ".join(inner(part, tight + 1) for part in parts), tight
        case Choice(test, yes, no) if is_glsl:
            return f"{inner(test, 1)} ? {inner(yes, 0)} : {inner(no, 0)}", CHOICE
        case Choice(test, yes, no):
            return f"{inner(yes, 1)} if {inner(test, 1)} else {inner(no, 0)}", CHOICE
        case Applied(function, arguments):
            return _applied(function, [inner(argument, 0) for argument in arguments])
        case ListOf(parts):
            return "[" + ", ".join(inner(part, 0) for part in parts) + "]", LEAF
        case Gathered(element, target, things, written):
            if puts_in and written:
                return "[" + ", ".join(inner(part, 0) for part in written) + "]", LEAF
            return f"[{in_symbols(element)} for {target} in {in_symbols(things)}]", LEAF
    raise AssertionError(f"{type(term).__name__} has no printer")


def _applied(function: str, arguments: Sequence[str]) -> tuple[str, int]:
    """Return a call as it was typed."""
    if function == "is None":
        return f"{arguments[0]} is None", TIGHTNESS["=="]
    if function == "in":
        return f"{arguments[0]} in {arguments[1]}", TIGHTNESS["=="]
    if function == "range by":
        return f"{arguments[0]}[::{arguments[1]}]", LEAF
    if function == "slice of":
        first, end = ("" if end == "nothing" else end for end in arguments[1:])
        return f"{arguments[0]}[{first}:{end}]", LEAF
    return f"{function}({', '.join(arguments)})", LEAF


def said(step: LaneStep, *, is_glsl: bool = False) -> str:
    """Return a step in plain words: its line, the line with its numbers, and what came out."""
    return "; ".join(_said(equality, step.kind, is_glsl) for equality in equalities(step))


def _said(equality: Equality, kind: str, is_glsl: bool) -> str:
    right = equality.right
    texts = [in_symbols(right, is_glsl=is_glsl), in_numbers(right, is_glsl=is_glsl), shown(equality.result)]
    parts = [text for k, text in enumerate(texts) if k == 0 or text != texts[k - 1]]
    if kind in ("if", "while"):
        condition = parts if len(parts) == 1 else parts[:-1]
        return f"{': '.join(condition)} is {texts[2]}"
    told = " = ".join(parts)
    if kind == "append":
        return f"{equality.symbol} gets {told}"
    return f"return {told}" if kind == "return" else f"{equality.symbol} = {told}"
