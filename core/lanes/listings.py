"""A listing as a program over lanes: the one way from a text to something that runs."""

import ast
from collections.abc import Mapping
from typing import Any

from core.lanes.limits import LISTING, Limits
from core.lanes.problem import Place, Problem
from core.lanes.program import Program
from core.lanes.python_dialect import PythonDialect
from core.lanes.python_messages import check_text, problem_of
from core.lanes.python_syntax import Reader
from core.records.python_text import read_statements


def compile_listing(
    text: str,
    constants: Mapping[str, Any] | None = None,
    helpers: Mapping[str, Program] | None = None,
    limits: Limits = LISTING,
) -> Program:
    """Read a listing and compile its functions; nothing runs yet.

    Parameters
    ----------
    text : str
        One function, or several that call each other; the first is the one that runs.
    constants : mapping of str to value, optional
        Numbers, and lists of numbers, that the listing knows by name.
    helpers : mapping of str to Program, optional
        Other listings that it may call.

    Raises
    ------
    Problem
        For a text that cannot be read, is larger than the limits, or uses what is not in the language of listings.
    """
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    check_text(text, limits)
    try:
        tree = read_statements(text)
    except SyntaxError as error:
        raise problem_of(error, text) from None
    except (ValueError, RecursionError, MemoryError):
        raise Problem(Place(1), "this text cannot be read") from None
    reader, functions = Reader(text.split("\n")), []
    for node in tree.body:
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            continue
        if not isinstance(node, ast.FunctionDef):
            raise Problem(reader.place(node), "a listing is one function: nothing stands outside of it")
        functions.append(reader.function(node))
        if node.name in [function.name for function in functions[:-1]]:
            raise Problem(reader.place(node), f"there are two functions {node.name}")
    if not functions:
        raise Problem(Place(1), "there is no function: the first line must be def ...:")
    try:
        return Program(PythonDialect(constants), functions, helpers)
    except RecursionError:
        raise Problem(Place(1), "too much stands in each other here") from None
