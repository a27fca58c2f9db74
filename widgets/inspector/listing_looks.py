"""The looks of code: what each token of a listing is, and the colours of vertices 0, 1 and 2 in it."""

import io
import keyword
import re
import tokenize
from bisect import bisect_right
from contextlib import suppress
from functools import lru_cache

from PySide6.QtGui import QColor, QFont, QTextCharFormat, QTextCursor, QTextDocument

from widgets.basics.theme import current_theme

_VERTEX_NAME = re.compile(r"^[A-Za-z]+_?([012])$")
KINDS_OF_VECTORS = ("vec", "ivec", "bvec", "mat")
_GLSL = re.compile(
    r"^\s*#version|^\s*(?:void|float|int|bool|[bi]?vec[2-4]|mat[2-4])\s+\w+\s*\(", re.MULTILINE
)
_GLSL_TOKEN = re.compile(
    r"(?P<comment>//[^\n]*|/\*.*?\*/|#[^\n]*)|(?P<number>\b\d[\w.]*|\.\d\w*)|(?P<word>[A-Za-z_]\w*)",
    re.DOTALL,
)
_GLSL_WORDS = frozenset(
    (
        *(
            "in",
            "out",
            "uniform",
            "const",
            "flat",
            "precision",
            "highp",
            "mediump",
            "lowp",
            "layout",
            "true",
            "false",
        ),
        *(
            "void",
            "float",
            "int",
            "bool",
            "sampler2D",
            *(f"{kind}{n}" for kind in KINDS_OF_VECTORS for n in (2, 3, 4)),
        ),
        *("if", "else", "for", "while", "return", "break", "continue", "discard"),
    )
)
_EDGE_NAMES = {"alpha": 0, "beta": 1, "gamma": 2}


@lru_cache(maxsize=64)
def token_formats(source: str) -> tuple[tuple[int, int, int, int, str], ...]:
    """Return where each token that has a look of its own begins and ends.

    Returns
    -------
    tuple of (int, int, int, int, str)
        First line (from 1), first column, last line, last column, and one of ``keyword``, ``comment``,
        ``string``, ``number``, ``vertex0``, ``vertex1``, ``vertex2``.
    """
    if _GLSL.search(source):
        return _glsl_formats(source)
    tokens: list[tokenize.TokenInfo] = []
    with suppress(tokenize.TokenError, SyntaxError):  # What stands before is coloured.
        tokens.extend(tokenize.generate_tokens(io.StringIO(source).readline))
    kinds = [_token_kind(token) for token in tokens]
    return tuple((*token.start, *token.end, kind) for token, kind in zip(tokens, kinds, strict=True) if kind)


def _glsl_formats(source: str) -> tuple[tuple[int, int, int, int, str], ...]:
    """Return the same of a shader."""
    begins = [0, *(found.end() for found in re.finditer("\n", source))]
    found = []
    for token in _GLSL_TOKEN.finditer(source):
        kind = token.lastgroup or ""
        if kind == "word":
            kind = "keyword" if token[0] in _GLSL_WORDS else ""
        if kind:
            first, last = (bisect_right(begins, at) for at in (token.start(), token.end()))
            found.append(
                (first, token.start() - begins[first - 1], last, token.end() - begins[last - 1], kind)
            )
    return tuple(found)


def _token_kind(token: tokenize.TokenInfo) -> str:
    if token.type == tokenize.NAME:
        if keyword.iskeyword(token.string):
            return "keyword"
        if token.string in _EDGE_NAMES:
            return f"vertex{_EDGE_NAMES[token.string]}"
        found = _VERTEX_NAME.match(token.string)
        return f"vertex{found[1]}" if found else ""
    return {tokenize.COMMENT: "comment", tokenize.STRING: "string", tokenize.NUMBER: "number"}.get(
        token.type, ""
    )


def token_looks() -> dict[str, QTextCharFormat]:
    """Return the look of each kind of token; of all others that of the empty kind."""
    theme = current_theme()
    looks = {f"vertex{k}": _look(theme.vertex_text[k]) for k in range(3)}
    looks |= {"keyword": _look(theme.text, is_bold=True), "comment": _look(theme.muted_text, is_italic=True)}
    return looks | {"string": _look(theme.muted_text), "number": _look(theme.text), "": _look(theme.text)}


def color_tokens(document: QTextDocument) -> None:
    """Give the tokens of a document their looks."""
    looks = token_looks()
    everything = QTextCursor(document)
    everything.beginEditBlock()  # The text is laid out once, at its end.
    everything.select(QTextCursor.SelectionType.Document)
    everything.setCharFormat(looks[""])
    for first_line, first_column, last_line, last_column, kind in token_formats(document.toPlainText()):
        cursor = QTextCursor(document)
        cursor.setPosition(document.findBlockByNumber(first_line - 1).position() + first_column)
        end = document.findBlockByNumber(last_line - 1).position() + last_column
        cursor.setPosition(end, QTextCursor.MoveMode.KeepAnchor)
        cursor.setCharFormat(looks[kind])
    everything.endEditBlock()


def _look(color: str, *, is_bold: bool = False, is_italic: bool = False) -> QTextCharFormat:
    look = QTextCharFormat()
    look.setForeground(QColor(color))
    look.setFontItalic(is_italic)
    if is_bold:
        look.setFontWeight(QFont.Weight.Bold)
    return look
