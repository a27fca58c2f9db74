"""Text in Python's grammar read to a tree, which is looked at and never executed."""

import ast
import warnings
from threading import RLock

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
