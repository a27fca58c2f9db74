"""A program over lanes: its functions, compiled once, their runs with the steps of one lane, and listings as programs.

Checking is a run on no lanes that visits both branches of every ``if``, and the body of every loop once.
"""

import ast
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from core.lanes.nodes import Assign, Declare, Each, Function, If, Loop, Put, Return, Statement
from core.lanes.problem import LISTING, Limits, Place, Problem
from core.lanes.python_dialect import PythonDialect
from core.lanes.python_messages import check_text, problem_of
from core.lanes.python_syntax import Reader
from core.lanes.python_values import Log, at_lane
from core.lanes.run import UNSET, Dialect, Frame, Nobody, Run, Some, Stop, Value, Watch
from core.lanes.statements import Statements
from core.records.listing import read_statements

# A program over lanes: its functions, compiled once, and their runs.


Accept = Callable[[Value, Place], Value]
NOT_COMPUTED = (ArithmeticError, ValueError, TypeError, MemoryError, RecursionError, LookupError)
"""What NumPy and Python say where a rule has not said it better; it ends in a message, too."""


class Program:
    """Compiled functions of one dialect.

    Parameters
    ----------
    functions : sequence of Function
        The first is the one that runs.
    helpers : mapping of str to Program
        Programs whose functions may be called by the name of the key.
    """

    compiler: type[Statements] = Statements
    """What compiles the statements of a language."""

    def __init__(
        self, dialect: Dialect, functions: Sequence[Function], helpers: "Mapping[str, Program] | None" = None
    ) -> None:
        self.dialect, self.helpers = dialect, helpers or {}
        self.functions = {function.name: function for function in functions}
        statements = self.compiler(dialect, self)
        self._bodies = {function.name: statements.body(function.body) for function in functions}

    @property
    def name(self) -> str:
        """Name of the function that runs."""
        return next(iter(self.functions))

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of its parameters."""
        return self.functions[self.name].parameters

    def names(self) -> Sequence[str]:
        """Return the names of all functions that may be called."""
        return (*self.functions, *self.helpers)

    def run(
        self,
        values: Sequence[Any],
        lanes: int,
        *,
        name: str | None = None,
        limits: Limits = LISTING,
        watch: Watch | None = None,
        stop: Stop | None = None,
        accept: Accept | None = None,
    ) -> Value:
        """Run a function, the first if none is named, on L lanes and return its value.

        Parameters
        ----------
        values : sequence
            Of its parameters: a number, an array (L,), or a list of these.
        stop : callable, optional
            Is asked now and then: True ends the run.
        accept : callable, optional
            Of what was returned and its place: what is given back, or `Problem`.

        Raises
        ------
        Problem
            With its place, whatever goes wrong.
        """
        return self._run(Run(lanes, limits, watch, stop=stop), values, name, accept)

    def check(
        self,
        values: Sequence[Any],
        *,
        name: str | None = None,
        limits: Limits = LISTING,
        accept: Accept | None = None,
    ) -> Value:
        """Run on no lanes, through every branch, and return the value; arrays of ``values`` are (0,)."""
        return self._run(Run(0, limits, is_checking=True), values, name, accept)

    def _run(self, run: Run, values: Sequence[Any], name: str | None, accept: Accept | None) -> Value:
        function = self.functions[name or self.name]
        run.place = function.place
        try:
            with np.errstate(all="ignore"):
                found = self._called(run, function, values, None, function.place, 0)
                if found is not UNSET and accept is not None:
                    found = accept(found, run.place)
        except Problem:
            raise
        except NOT_COMPUTED as problem:
            raise Problem(run.place, f"this cannot be computed ({type(problem).__name__})") from None
        if found is UNSET:
            raise Problem(
                function.place, f"{function.name} never returns anything: its last line must be return ..."
            )
        return found

    def call_named(self, name: str, values: Sequence[Value], mask: Some, place: Place, frame: Frame) -> Value:
        """Return what a function of this program, or a helper, gives; the mask is (L,)."""
        owner = self if name in self.functions else self.helpers[name]
        function = owner.functions[name]
        given = self.dialect.arguments(name, function.parameters, values, place)
        found = owner._called(frame.run, function, given, mask, place, frame.depth)
        return self.dialect.nothing if found is UNSET else found

    def _called(
        self, run: Run, function: Function, values: Sequence[Value], mask: Some, place: Place, depth: int
    ) -> Value:
        if depth >= run.limits.calls:
            raise Problem(place, f"{function.name} calls itself, or calls go deeper than {run.limits.calls}")
        given = zip(function.parameters, values, strict=True)
        frame = Frame(run, {**self.dialect.names(), **dict(given)}, depth + 1)
        left = self._bodies[function.name](frame, mask)
        goes_on = not isinstance(left, Nobody) and frame.value is not UNSET
        if goes_on and not run.is_checking and not function.is_void:
            raise Problem(function.place, f"{function.name} ends without return{run.some(left)}")
        return frame.value


# The steps of a run on one lane: each line that ran, with all variables before and after it.


KINDS: dict[type[Statement], str] = {
    Assign: "set",
    Declare: "set",
    Put: "append",
    If: "if",
    Loop: "while",
    Each: "for",
    Return: "return",
}


@dataclass(frozen=True, eq=False)
class LaneStep:
    """One line that ran."""

    statement: Statement
    before: Mapping[str, Any]
    """Variables by name, as plain numbers and lists."""
    after: Mapping[str, Any]
    value: Any
    """What was stored, put, tested or returned."""
    depth: int
    """In how many calls it stands; 1: in the listing itself."""
    unset: tuple[str, ...] = ()
    """Variables that it has read before they had a value, where the language allows that."""

    @property
    def kind(self) -> str:
        """What it does: ``set``, ``append``, ``if``, ``while``, ``for`` or ``return``."""
        return KINDS[type(self.statement)]

    @property
    def line(self) -> int:
        """Its line, from 1."""
        return self.statement.place.line

    @property
    def set(self) -> tuple[str, ...]:
        """Names of the variables that it gave another value."""
        missing = object()
        return tuple(
            name for name, value in self.after.items() if self.before.get(name, missing) is not value
        )


class _Recorder:
    """Notes what a run on one lane does."""

    def __init__(self, limits: Limits, hidden: Mapping[str, Any]) -> None:
        self.steps: list[LaneStep] = []
        self._limits, self._hidden = limits, hidden
        self._before: dict[int, dict[str, Any]] = {}
        self._plain: dict[int, tuple[Any, int, Any]] = {}

    def begin(self, statement: Statement, mask: Some, frame: Frame) -> None:
        """Keep the variables before a statement."""
        self._before[frame.depth] = self._variables(frame)

    def end(self, statement: Statement, mask: Some, frame: Frame, value: Any) -> None:
        """Keep the step."""
        if len(self.steps) >= self._limits.steps:
            raise Problem(statement.place, f"this takes more than {self._limits.steps:,} steps: stopped here")
        after, before = self._variables(frame), self._before[frame.depth]
        self.steps.append(LaneStep(statement, before, after, at_lane(value, 0), frame.depth))

    def _variables(self, frame: Frame) -> dict[str, Any]:
        return {name: self._kept(value) for name, value in frame.names.items() if name not in self._hidden}

    def _kept(self, value: Any) -> Any:
        """Return the plain value; of the same one as before the same object."""
        if not isinstance(value, list | Log):
            return value
        length = len(value.entries if isinstance(value, Log) else value)
        known = self._plain.get(id(value))
        if known is None or known[0] is not value or known[1] != length:
            known = self._plain[id(value)] = (value, length, at_lane(value, 0))
        return known[2]


def steps_until_problem(
    program: Program, values: Sequence[Any], *, limits: Limits = LISTING
) -> tuple[tuple[LaneStep, ...], Problem | None]:
    """Return the steps of a run on one lane, and what ended it; ``None``: it came to its end."""
    recorder = _Recorder(limits, program.dialect.names())
    try:
        program.run(values, 1, limits=limits, watch=recorder)
    except Problem as problem:
        return tuple(recorder.steps), problem
    return tuple(recorder.steps), None


# A listing as a program over lanes: the one way from a text to something that runs.


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
