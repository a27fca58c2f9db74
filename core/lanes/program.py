"""A program over lanes: its functions, compiled once, and their runs.

Checking is a run on no lanes that visits both branches of every ``if``, and the body of every loop once.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from core.lanes.dialect import Dialect, Value
from core.lanes.limits import LISTING, Limits
from core.lanes.masks import Nobody, Some
from core.lanes.nodes import Function
from core.lanes.problem import Place, Problem
from core.lanes.run import UNSET, Frame, Run, Stop, Watch
from core.lanes.statements import Statements

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
        self,
        run: Run,
        function: Function,
        values: Sequence[Value],
        mask: Some,
        place: Place,
        depth: int,
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
