"""The words of a shader, each with its place."""

import re
from dataclasses import dataclass

from core.lanes.limits import SHADER
from core.lanes.problem import Place, Problem

_TOKEN = re.compile(
    r"(?P<space>[ \t\r\f\v]+|//[^\n]*)|(?P<newline>\n)|(?P<comment>/\*.*?\*/)"
    r"|(?P<number>(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?\w*)|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<sign>\+\+|--|<<=|>>=|<<|>>|[-+*/%&|^]=|==|!=|<=|>=|&&|\|\||\^\^|[-+*/%<>=!?:;,.(){}\[\]&|^~#])",
    re.DOTALL,
)
_DIRECTIVE = re.compile(r"[ \t]*#[ \t]*(?P<word>\w*)(?P<rest>[^\n]*)")
BRACKETS = {"(": ")", "[": "]", "{": "}"}


@dataclass(frozen=True, slots=True)
class Token:
    """A word of a shader: its kind is ``number``, ``name``, ``sign`` or ``end``."""

    kind: str
    text: str
    place: Place
    is_first: bool = False
    """Whether it is the first of its line."""


def read_tokens(source: str) -> tuple[list[Token], list[str]]:
    """Split a shader into its tokens, the last of kind ``end``, and say what was read and ignored.

    Raises
    ------
    Problem
        A character that GLSL does not have, a directive other than ``#version 300 es``, or a limit of the text.
    """
    if len(source) > SHADER.characters:
        raise Problem(
            Place(1), f"a shader may have {SHADER.characters:,} characters, this one has {len(source):,}"
        )
    tokens: list[Token] = []
    notes: list[str] = []
    at, line, begin, is_first = 0, 1, 0, True
    while at < len(source):
        place = Place(line, at - begin + 1)
        if is_first and (directive := _DIRECTIVE.match(source, at)):
            _check_directive(directive["word"], directive["rest"], place)
            at = directive.end()
            continue
        found = _TOKEN.match(source, at)
        if source.startswith("/*", at) and (found is None or found.lastgroup != "comment"):
            raise Problem(place, "this comment never ends: write */ behind it")
        if found is None:
            raise Problem(place, f"GLSL has no character {source[at]!r}")
        text = found[0]
        if found.lastgroup == "newline" or (found.lastgroup == "comment" and "\n" in text):
            line, begin, is_first = line + text.count("\n"), at + text.rindex("\n") + 1, True
        elif found.lastgroup in ("number", "name", "sign"):
            tokens.append(Token(found.lastgroup or "", text, place, is_first))
            is_first = False
        at = found.end()
    if not source.lstrip().startswith("#version"):
        notes.append("The first line should be #version 300 es.")
    tokens.append(Token("end", "", Place(line, max(at - begin, 0) + 1), True))
    _check_brackets(tokens)
    return tokens, notes


def _check_directive(word: str, rest: str, place: Place) -> None:
    if word == "version":
        if rest.split() != ["300", "es"]:
            raise Problem(place, f"this is GLSL ES 3.00: write #version 300 es, not #version{rest.rstrip()}")
        if place.line > 1:
            raise Problem(place, "#version 300 es must be the first line")
    elif word == "define":
        raise Problem(place, "#define is not supported here: write const float NAME = 1.0; instead")
    else:
        raise Problem(place, f"#{word} is not supported here: of the directives only #version 300 es is")


def _check_brackets(tokens: list[Token]) -> None:
    """Say which bracket has no partner, and where brackets are nested too deep."""
    opened: list[Token] = []
    for token in tokens:
        if token.kind != "sign":
            continue
        if token.text in BRACKETS:
            opened.append(token)
            if len(opened) > SHADER.brackets:
                raise Problem(token.place, f"brackets may be nested {SHADER.brackets} deep")
        elif token.text in BRACKETS.values():
            if not opened:
                raise Problem(token.place, f"this {token.text} closes nothing: no bracket is open here")
            last = opened.pop()
            if BRACKETS[last.text] != token.text:
                raise Problem(
                    last.place if last.place.line < token.place.line and last.text != "{" else token.place,
                    f"the {last.text} of line {last.place.line} must be closed by {BRACKETS[last.text]}, "
                    f"here comes {token.text} in line {token.place.line}",
                )
    if opened:
        last = opened[-1]
        raise Problem(last.place, f"this {last.text} is never closed: {BRACKETS[last.text]} is missing")


def joined_words(words: list[str]) -> str:
    """Return ``a, b or c``."""
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))
