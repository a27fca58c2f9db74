"""Texts that mean harm, or grow: each ends in a message, soon, and takes little memory. None is executed as Python."""

import ast
import re
import tracemalloc
from dataclasses import replace
from pathlib import Path
from time import thread_time

import numpy as np
import pytest

import core.lanes
from core.lanes.problem import LIMIT_NAMES, LISTING, SHADER, Limits, Problem, line_rounds
from core.lanes.program import compile_listing
from core.lanes.python_dialect import PythonDialect
from core.lanes.run import bounded

MEMORY = 24_000_000
"""Bytes that a run may take at its peak: 20 MB, and what reading the text takes."""
BRIEF = replace(LISTING, seconds=0.3)
SECONDS = 30
"""What ends later hangs; how fast the machine is does not matter."""


def program_of(*lines: str):
    """Return a program of four numbers from the lines of its body."""
    text = "\n".join(f"  {line}" for part in lines for line in part.split("\n"))
    return compile_listing(f"def f(x0, y0, x1, flag):\n{text}\n  return x0\n")


def run(*lines: str, lanes: int = 12):
    """Run a body on lanes of whole numbers, a flag beside."""
    values = [np.arange(lanes), np.arange(lanes)[::-1].copy(), np.full(lanes, 3), np.arange(lanes) % 2 == 0]
    return program_of(*lines).run(values, lanes, limits=BRIEF)


TOO_LARGE = "up to 2 to the power 53"
HOSTILE = {
    "list times a number": ("a = [0] * 10**9", "a list \\* a whole number"),
    "text times a number": ("a = 'a' * 10**9", "a text \\*"),
    "tower of powers": ("a = 10**10**10", "an exponent must be"),
    "power": ("a = x0 ** 1000000", "an exponent must be"),
    "power by lanes": ("a = x0 ** y0", "an exponent must be"),
    "literal": ("a = " + "9" * 250, TOO_LARGE),
    "shift": ("a = 1 << 10**9", "shifts by 0 to 52"),
    "shift of lanes": ("a = (x0 + 1) << 52", TOO_LARGE),
    "range as a list": ("a = [k for k in range(10**12)]", "at most 4,096 numbers"),
    "list of lists": ("a = [[k for k in range(4000)] for j in range(4000)]", "stopped|at most"),
    "list of everything": ("a = list(range(10**9))", "at most 4,096 numbers"),
    "endless append": ("a = []\nwhile True:\n  a.append((1, 1))", "does it ever end"),
    "doubling list": ("a = [1]\nfor k in range(60):\n  a = [*a, *a]", "at most 4,096 numbers"),
    "doubling tuple": ("a = 1, 1\nfor k in range(60):\n  a = a, a", "at most 8 deep"),
    "doubling under a mask": ("a = 1, 1\nfor k in range(60):\n  if x0 > 4:\n    a = a, a", "elsewhere"),
    "lists in each other": ("a = [1]\nfor k in range(900):\n  a = [a]", "at most 8 deep"),
    "lists put in each other": (
        "a = [1]\nb = [1]\nfor k in range(900):\n  b = [2]\n  b.append(a)\n  a = b",
        "at most 8 deep",
    ),
    "growing list of lists": ("a = [0]\nfor k in range(9000):\n  a.append((k, k, k))", "numbers|rounds"),
    "growing product": ("a = 3\nfor k in range(1000):\n  a = a * a", TOO_LARGE),
    "growing sum": ("a = 4503599627370496\nfor k in range(1000):\n  a = a + a", TOO_LARGE),
    "growing sum of lanes": ("a = x0 + 4503599627370496\nfor k in range(1000):\n  a = a + a", TOO_LARGE),
    "falling sum of lanes": ("a = x0 - 4503599627370496\nfor k in range(1000):\n  a = a + a", TOO_LARGE),
    "product of lanes": ("a = (x0 + 4503599627370496) * (y0 + 4503599627370496)", TOO_LARGE),
    "many lists": ("\n".join(f"v{k} = [x0 for j in range(4000)]" for k in range(150)), "stopped"),
    "attribute": ("a = x0.__class__.__bases__", "not in the language"),
    "method of a text": ("a = ''.join('a')", "not in the language"),
    "import by a call": ("a = __import__('os').system('x')", "not in the language"),
    "import by name": ("a = __import__('os')", "no function __import__"),
    "eval": ("a = eval('1')", "no function eval"),
    "exec": ("exec('x')", "no function exec"),
    "compile": ("a = compile('x', 'x', 'exec')", "no function compile"),
    "open": ("a = open('/etc/passwd')", "no function open"),
    "getattr": ("a = getattr(x0, 'shape')", "no function getattr"),
    "type": ("a = type(x0)", "no function type"),
    "print": ("print(x0)", "no function print"),
    "numpy": ("a = np.load('x')", "not in the language"),
    "globals": ("a = globals()", "no function globals"),
    "f-string": ("a = f'{x0:>999999999}'", "an f-string"),
    "format": ("a = '%999999999d' % 1", "a text %"),
    "lambda": ("a = (lambda: 0)()", "called by its name"),
    "walrus": ("a = (y := 1)", ":="),
    "import": ("import os", "import is not"),
    "from": ("from os import path", "import is not"),
    "with": ("with x0:\n  pass", "with is not"),
    "try": ("try:\n  pass\nfinally:\n  pass", "try is not"),
    "class": ("class A:\n  pass", "class is not"),
    "function inside": ("def g():\n  return 1", "inside of a function"),
    "global": ("global x0", "global is not"),
    "yield": ("yield x0", "yield is not"),
    "await": ("await x0", "await is not"),
    "assert": ("assert x0", "assert is not"),
    "delete": ("del x0[0]", "delete is not"),
    "match": ("match x0:\n  case 1:\n    pass", "match is not"),
    "decorator": ("return x0\n@x\ndef g():\n  pass", "inside of a function|plain parameters"),
    "brackets": ("a = " + "(" * 200 + "1" + ")" * 200, "32 deep|300 characters"),
    "open brackets": ("a = " + "[" * 33, "32 deep"),
    "minus signs": ("a = " + "-" * 280 + "1", "in each other"),
    "nots": ("a = " + "not " * 70 + "flag", "in each other"),
    "conditions": ("a = " + "1 if flag else " * 19 + "1", ""),
    "conditions over lines": ("a = (\n" + "1 if flag else\n  " * 300 + "1)", "in each other"),
    "sums over lines": ("a = (\n" + "x0 +\n  " * 400 + "1)", "in each other"),
    "long line": ("a = " + "x0 + " * 70 + "1", "300 characters"),
    "long text": ("x0 = x0 + 1\n" * 3000, "6,000 characters"),
    "nested loops": (
        "for a in range(900):\n  for b in range(900):\n    for c in range(900):\n      x0 += 1",
        "longer than 0.3 s",
    ),
    "deep loops": (
        "".join("  " * k + f"for a{k} in range(9):\n" for k in range(18)) + "  " * 18 + "x0 = 1",
        "longer than 0.3 s",
    ),
    "deep blocks": ("".join(" " * k + "if flag:\n" for k in range(90)) + " " * 90 + "x0 = 1", ""),
    "recursion": ("a = f(x0, y0, x1, flag)", "calls itself"),
    "list in itself": ("a = []\na.append(a)", "cannot be put into a list"),
    "list with a value in itself": ("a = [1]\na.append(a)", "not itself"),
    "bytes": ("a = b'x'", "not in the language"),
    "complex": ("a = 3j", "not in the language"),
    "dictionary": ("a = {1: 2}", "a dictionary"),
    "set": ("a = {1, 2}", "a set"),
    "ellipsis": ("a = ...", "not in the language"),
    "matrix product": ("a = x0 @ y0", "@ is not"),
    "invert": ("a = ~x0", "write not"),
    "surrogate": ("a = '\ud800'", ""),
    "text of NUL": ("a = '\0'", "cannot be read|quotation|character"),
    "infinite to whole": ("a = int(1e308 * 10)", "not finite"),
    "float power": ("a = 1e300 ** 16", ""),
    "power as a function": ("a = pow(10, 10**15) + pow(-1, 0.5) + pow(10**15, 10**15)", ""),
    "step of 0": ("for k in range(0, 5, 0):\n  x0 = 1", "step of a range cannot be 0"),
    "step of 0 in a lane": ("for k in range(0, 5, x0):\n  y0 = 1", "step of a range cannot be 0"),
    "division by 0": ("a = 1 // (x0 - x0)", "division by 0"),
    "remainder of 0": ("a = x0 % 0", "division by 0"),
    "unpacking a number": ("a, b = x0", "2 names on the left"),
    "index of lanes": ("t = [1, 2]\na = t[x0]", "outside of 0 to 1"),
    "index": ("t = [1, 2]\na = t[-3]", "outside of 0 to 1"),
    "star": ("a, *b, *c = [1, 2]", "something|cannot|left|this"),
    "break": ("break", "outside of a loop|this cannot be read"),
    "long range": ("for k in range(10**15):\n  x0 = 1", "does it ever end"),
    "frexp": ("a = ldexp(1.0, 10**15)", ""),
    "sorted texts": ("a = sorted(['b', 'a'])", "numbers only"),
    "sum of a million": ("a = sum(range(10**6))", "at most 4,096"),
    "escape": ("a = 1 \\\n  + 2", "this character is not"),
    "joined": ("a = 1if flag else 2", "a blank is missing"),
    "long names": ("a" * 280 + " = 1", ""),
}
"""By name: a body, and what is said of it; nothing: it runs, or says anything."""


@pytest.mark.parametrize("name", HOSTILE)
@pytest.mark.parametrize("lanes", [12, pytest.param(1, marks=pytest.mark.slow)])
def test_a_hostile_text_ends_in_a_message_soon_and_in_little_memory(name, lanes):
    body, words = HOSTILE[name]
    tracemalloc.start()
    started = thread_time()
    said = ""
    try:
        run(body, lanes=lanes)
    except Problem as problem:
        said = str(problem)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    # One lane may have none of the numbers that are refused, and a slow machine reaches the limit of time first.
    assert re.search(f"{words}|longer than 0.3 seconds", said) or (lanes == 1 and not said)
    assert thread_time() - started < SECONDS
    assert peak < MEMORY


def test_memory_of_many_lanes_is_limited_too():
    body = "\n".join(f"v{k} = x0 * 1.5 + {k}" for k in range(190))
    tracemalloc.start()
    with pytest.raises(Problem, match="variables and lists have more than 1,500,000 numbers"):
        run(body, lanes=16_384)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < MEMORY


@pytest.mark.parametrize(
    ("limits", "body", "words"),
    [
        (Limits(characters=80), "a = 1\n" * 12, "at most 80 characters"),
        (Limits(brackets=2), "a = (((1)))", "at most 2 deep"),
        (Limits(line_length=40), "a = " + "1 + " * 12 + "1", "at most 40 characters"),
        (Limits(rounds=7), "while True:\n  a = 1", "after 7 rounds"),
        (Limits(numbers=5), "a = [1, 2, 3, 4, 5, 6]", "at most 5 numbers"),
        (Limits(calls=0), "a = 1", "deeper than 0"),
        (Limits(stored=3), "a = [1, 2, 3, 4]", "more than 3 numbers"),
        (Limits(seconds=0.0), "for k in range(99):\n  a = 1", "longer than 0 seconds"),
    ],
)
def test_each_limit_is_one(limits, body, words):
    lines = "\n".join(f"  {line}" for line in body.split("\n"))
    with pytest.raises(Problem, match=words):
        compile_listing(f"def f(x):\n{lines}\n  return x\n", limits=limits).run([1], 1, limits=limits)


def test_the_limits_are_those_of_the_table():
    assert {name: getattr(LISTING, name) for name in LIMIT_NAMES} == {
        "characters": 6_000,
        "brackets": 32,
        "line_length": 300,
        "rounds": 1_000,
        "numbers": 4_096,
        "calls": 8,
        "stored": 1_500_000,
        "steps": 20_000,
        "seconds": 3.0,
    }
    assert (SHADER.characters, SHADER.brackets, line_rounds(64, 48)) == (20_000, 64, 448)


def test_a_run_is_stopped_by_whoever_waits_for_it():
    asked = []

    def stop() -> bool:
        asked.append(1)
        return len(asked) > 3

    with bounded(60, stop), pytest.raises(Problem, match="stopped"):
        run("for a in range(900):\n  for b in range(900):\n    x1 = 1")
    assert len(asked) == 4
    # A run within two bounds keeps the outer one: its end and who stops it.
    for outer in (bounded(0.05), bounded(60, lambda: True)):
        with outer, bounded(30), pytest.raises(Problem, match=r"longer than 0.05 seconds|: stopped$"):
            run("for a in range(900):\n  for b in range(900):\n    x1 = 1")


def test_calls_eight_deep_run_and_nine_do_not():
    def chain(count: int) -> str:
        calls = [f"def f{k}(x):\n  return f{k + 1}(x)\n" for k in range(count)]
        return "".join(calls) + f"def f{count}(x):\n  return x\n"

    assert compile_listing(chain(7)).run([5], 1) == 5
    with pytest.raises(Problem, match="calls go deeper than 8"):
        compile_listing(chain(8)).run([5], 1)


def test_the_evaluator_executes_no_text():
    """Nothing in the package calls what would run a text, or looks an attribute up by a typed name."""
    forbidden = {"eval", "exec", "compile", "__import__", "getattr", "setattr", "globals", "locals", "open"}
    for file in Path(core.lanes.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                assert node.func.id not in forbidden or is_reading_places(file.name, node), (
                    file.name,
                    node.lineno,
                )


def is_reading_places(name: str, node: ast.Call) -> bool:
    """Return whether a call reads a field that is written out, of a node of Python's own tree."""
    field = node.args[1]
    return (
        name == "python_syntax.py"
        and isinstance(field, ast.Constant)
        and field.value in ("lineno", "col_offset")
    )


def test_the_functions_of_listings_are_those_of_the_table():
    typed = set(PythonDialect().functions)
    assert typed == {
        *("abs", "all", "any", "bool", "ceil", "enumerate", "float", "float32", "floor", "frexp", "int"),
        *(
            *("isfinite", "isnan", "isqrt", "ldexp", "len", "list", "max", "min", "pairwise", "pow"),
            *("range", "reversed"),
        ),
        *("rint", "round", "sorted", "sqrt", "sum", "tuple", "zip"),
    }


def test_the_document_has_the_limits_and_the_functions_of_the_language():
    document = (Path(core.lanes.__file__).parents[2] / "docs" / "listings.md").read_text(encoding="utf-8")
    for name in LIMIT_NAMES:
        assert f"| {getattr(LISTING, name):,g}" in document or f"| {getattr(LISTING, name):,}" in document, (
            name
        )
    named = {"float32", *re.findall(r"[a-z]+", re.search(r"10\. `([^`]*)`", document)[1])}
    assert named == set(PythonDialect().functions)
