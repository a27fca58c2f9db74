"""A listing: the algorithm of a step as a short scalar function that a student can read, and the operations it names.

A line of the function is named by a comment at its end, ``#: name``; a step says the name, the window marks the line.
"""

import ast
import inspect
import re
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from difflib import SequenceMatcher
from functools import cache, lru_cache
from textwrap import dedent
from threading import RLock
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import cached_property

# Text in Python's grammar read to a tree, which is looked at and never executed.


_ALONE = RLock()
"""CPython 3.11 has one count for how deep the trees are that all threads make: two at a time end in a SystemError."""


def read_statements(text: str) -> ast.Module:
    """Return the statements of a text; raises what `ast.parse` raises, without its warnings."""
    with _ALONE, warnings.catch_warnings(action="ignore"):
        return ast.parse(text)


def read_expression(text: str) -> ast.expr:
    """Return the expression that a text is; raises what `ast.parse` raises, without its warnings."""
    with _ALONE, warnings.catch_warnings(action="ignore"):
        return ast.parse(text, mode="eval").body


# A listing: the algorithm of a step as a short scalar function that a student can read and the tests
# execute.


_LABEL = re.compile(r"\s*#: (?P<name>[\w-]+)\s*$")
_CHANGING = frozenset({"append", "remove", "sort"})
"""Methods that change the list that they are called on."""
RETURN = "return"
"""Name of the value of the function, which a line gives that returns what no other line has computed."""


KEPT_TEXTS = 64
"""Texts that were typed last, whose listings are kept."""


@dataclass(frozen=True, eq=False)
class Listing:
    """Source of a scalar function without docstring, labels and types, and the line each label stands on."""

    function: Callable[..., Any]
    source: str
    lines: dict[str, int]
    """Label to line number, counted from 1."""
    purpose: str
    """Its docstring, in one line."""

    @property
    def name(self) -> str:
        """Name of the function."""
        return self.function.__name__

    def assigned(self, line: int) -> frozenset[str]:
        """Return the names that the statement on a line gives a value; ``RETURN`` where it computes what is returned.

        A loop gives its variables a value, a call of ``append`` the list. What has a value already is not given one by
        returning it.
        """
        return self._assigned.get(line, frozenset())

    def begin_of(self, line: int) -> int:
        """Return the first line of the statement that a line belongs to, or the line itself."""
        statement = self._statements.get(line)
        return line if statement is None else statement.lineno

    def decides(self, line: int) -> bool:
        """Return whether the statement on a line gives nothing a value: it tests, goes on, breaks or returns."""
        kinds = (ast.If, ast.While, ast.For, ast.Return, ast.Break, ast.Continue)
        return isinstance(self._statements.get(line), kinds)

    @cached_property
    def everywhere(self) -> frozenset[str]:
        """All names that some line gives a value."""
        return frozenset().union(*self._assigned.values())

    @cached_property
    def _statements(self) -> dict[int, ast.stmt]:
        """The statement of every line; of a compound one, of the lines before its body."""
        found: dict[int, ast.stmt] = {}
        for node in ast.walk(read_statements(self.source)):
            if isinstance(node, ast.stmt):
                body = getattr(node, "body", None)
                end = body[0].lineno if body else (node.end_lineno or node.lineno) + 1
                found |= dict.fromkeys(range(node.lineno, end), node)
        return found

    @cached_property
    def _assigned(self) -> dict[int, frozenset[str]]:
        names = {line: set(_stored(node)) for line, node in self._statements.items()}
        made: set[str] = set().union(*names.values())
        for line, node in self._statements.items():
            if isinstance(node, ast.Return) and node.value is not None:
                parts = node.value.elts if isinstance(node.value, ast.Tuple) else [node.value]
                if not all(isinstance(part, ast.Name) and part.id in made for part in parts):
                    names[line].add(RETURN)
        return {line: frozenset(found) for line, found in names.items()}


def _stored(node: ast.stmt) -> Iterator[str]:
    """Yield the names that a statement gives a value, without those of its body."""
    targets: list[ast.expr] = []
    if isinstance(node, ast.Assign):
        targets = node.targets
    elif isinstance(node, ast.AugAssign | ast.For):
        targets = [node.target]
    elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
        called = node.value.func
        if isinstance(called, ast.Attribute) and called.attr in _CHANGING:
            targets = [called.value]
    for target in targets:
        # Of what stands in brackets, only the list is given a value.
        while isinstance(target, ast.Subscript):
            target = target.value
        for part in ast.walk(target):
            if isinstance(part, ast.Name):
                yield part.id


@dataclass(frozen=True)
class TypedText:
    """A text that a user has typed in place of the listing of a function."""

    of: Callable[..., Any]
    text: str


@dataclass(frozen=True, eq=False)
class EditedListing(Listing):
    """A listing that was edited; its labels stand on the lines that the old ones have become."""

    original: Listing
    given: Mapping[str, Any] = field(default_factory=dict)
    """What it takes beside the numbers of a row, as the texture: by name."""


@dataclass(frozen=True, eq=False)
class ShaderListing(Listing):
    """The source of a shader, whose labels are its lines; what a line sets is known by the step that ran."""

    shader: str
    """Its title."""

    @property
    def name(self) -> str:
        """Title of the shader."""
        return self.shader

    def assigned(self, line: int) -> frozenset[str]:
        """Return nothing: the names are those of the steps."""
        return frozenset()

    def decides(self, line: int) -> bool:
        """Return False: a step says whether it tests."""
        return False

    @property
    def everywhere(self) -> frozenset[str]:
        """No names."""
        return frozenset()


@lru_cache(KEPT_TEXTS)
def edited_listing(of: Callable[..., Any], text: str) -> EditedListing:
    """Return the listing of a function with another source, under the same name."""
    original, source = listing(of), "\n".join(text.splitlines())
    moved = moved_lines(original.source, source)
    lines = {label: moved[line] for label, line in original.lines.items()}
    return EditedListing(of, source, lines, original.purpose, original)


def moved_lines(old: str, new: str) -> dict[int, int]:
    """Return where every line of a text, from 1, stands in a changed one; for one that is gone: the line above."""
    before, after = old.splitlines(), new.splitlines()
    found: dict[int, int] = {}
    for _, first, end, new_first, new_end in SequenceMatcher(None, before, after, False).get_opcodes():
        for k in range(end - first):
            found[first + k + 1] = max(min(new_first + k, new_end - 1), new_first - 1, 0) + 1
    return found


def kept_line(old: str, new: str, line: int) -> int | None:
    """Return where a line of a text, from 1, stands in a changed one, changed or not; ``None``: it is gone."""
    before, after, moved = old.splitlines(), new.splitlines(), moved_lines(old, new)
    at = moved.get(line)
    if at is None or at > len(after):
        return None
    is_alone = sum(other == at for other in moved.values()) == 1
    return at if is_alone or before[line - 1] == after[at - 1] else None


_PRINTED: dict[Callable[..., Any], str] = {}


def print_as(function: Callable[..., Any], text: str) -> None:
    """Let ``text``, whose labels stand behind ``#:``, be shown as the listing of a function, as a book prints it."""
    _PRINTED[function] = text


def without_labels(text: str) -> str:
    """Return a text given to `print_as` without its labels: what the reader sees."""
    return "\n".join(line.partition("#:")[0].rstrip() for line in text.splitlines())


def listing(function: Callable[..., Any] | TypedText) -> Listing:
    """Return what is shown of ``function``: its source, or a text that it is printed as or that was typed."""
    if isinstance(function, TypedText):
        return edited_listing(function.of, function.text)
    return _shown(function)


@cache
def _shown(function: Callable[..., Any]) -> Listing:
    own, text = source_listing(function), _PRINTED.get(function)
    if text is None:
        return own
    lines = enumerate(text.splitlines(), start=1)
    labels = {label: number for number, line in lines for label in line.partition("#:")[2].split()}
    return replace(own, source=without_labels(text), lines=labels)


@cache
def source_listing(function: Callable[..., Any]) -> Listing:
    """Read the source of ``function`` as a textbook prints it: docstring, labels and types are taken out."""
    lines, labels = [], {}
    for number, line in enumerate(_plain_lines(dedent(inspect.getsource(function))), start=1):
        label = _LABEL.search(line)
        if label:
            labels[label["name"]] = number
            line = line[: label.start()]
        lines.append(line)
    return Listing(function, "\n".join(lines), labels, " ".join((inspect.getdoc(function) or "").split()))


def _plain_lines(source: str) -> list[str]:
    """Return the lines of a function: signatures in one line, no docstring, no types, every indent half as wide."""
    lines = source.splitlines()
    tree = read_statements(source)
    typed = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AnnAssign)]
    for node in sorted(typed, key=lambda node: -node.lineno):
        first, indent = node.lineno - 1, " " * node.col_offset
        if isinstance(node, ast.AnnAssign):
            line, end = lines[first], node.annotation.end_col_offset
            lines[first] = line[: node.target.end_col_offset] + line[end:]
            continue
        if ast.get_docstring(node) is not None:
            del lines[node.body[0].lineno - 1 : node.body[0].end_lineno]
        for argument in ast.walk(node.args):
            if isinstance(argument, ast.arg):
                argument.annotation = None
        last = next(k for k in range(first, len(lines)) if lines[k].endswith(":"))
        lines[first : last + 1] = [f"{indent}def {node.name}({ast.unparse(node.args)}):"]
    return [" " * ((len(line) - len(line.lstrip())) // 2) + line.lstrip() for line in lines]


# What a row of a trace does: methods name the operations of their rows, and wait for nothing else that
# steps.


Columns = Mapping[str, NDArray[Any]]
"""Every number of a trace: name to (R, ...) array."""
Labels = Callable[[Columns, Any], NDArray[np.str_]]
"""Takes columns and rows (C,) int64 or a slice; returns (C,) labels, where the outcome decides which line ran."""
Variables = tuple[str, ...] | Mapping[str, str]
"""Columns of the trace; or each column and what the listing calls it, where that is another name."""


@dataclass(frozen=True)
class Operation:
    """One thing that a row does."""

    name: str
    """Key of its sentence and formula, within the kind of its row."""
    label: str | Labels
    """Label of the line of the listing that ran; empty where no line of it did."""
    sets: Variables = ()
    """Variables that its line gives a value."""
    takes: Variables = ()
    """Variables that are shown from now on, though no line of the listing gives them a value."""

    @property
    def shows(self) -> tuple[str, ...]:
        """Columns that have a value once it is done."""
        return *self.sets, *self.takes

    def label_at(self, columns: Columns, row: int) -> str:
        """Return the label of the line that ran in one row."""
        if isinstance(self.label, str):
            return self.label
        return str(self.label(columns, slice(row, row + 1))[0])


@dataclass(frozen=True)
class Either:
    """`Labels` of an operation that does one thing or another, or of a search that finds something or nothing."""

    flag: str
    """The column (R,) that decides: bool, or int64 of what was found, -1 where nothing was."""
    when_set: str
    otherwise: str

    def __call__(self, columns: Columns, rows: Any) -> NDArray[np.str_]:
        """Return the labels (C,) of rows."""
        flag = columns[self.flag][rows]
        is_set = flag if flag.dtype == bool else flag >= 0
        return np.where(is_set, self.when_set, self.otherwise)
