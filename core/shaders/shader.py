"""One shader, read and checked with what is declared for it, and its run on lanes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, cast

import numpy as np

from core.lanes.expressions import Expressions
from core.lanes.nodes import Break, Call, Continue, Discard, Evaluate, Expression, Function, Name, Statement
from core.lanes.problem import SHADER, Limits, Place, Problem
from core.lanes.program import NOT_COMPUTED, Program
from core.lanes.run import NOBODY, UNSET, Dialect, Frame, Mask, Nobody, Run, Some, Stop, Watch
from core.lanes.statements import Statements, Step
from core.records.arrays import Flags, cached_property
from core.shaders.dialect import GlslDialect
from core.shaders.glsl_types import GlslValue, component_count, zero_of
from core.shaders.parser import GlobalVariable, Parser, Syntax, walk, weight_of
from core.shaders.record import DIALECTS
from core.shaders.words import DERIVATIVES

# What is declared for a shader: GLSL's own variables, and those that three.js adds.


ATTRIBUTES = {"position": "vec3", "normal": "vec3", "uv": "vec2", "color": "vec3"}
"""What a mesh gives its vertices; ``color`` may be declared vec4, too."""
UNIFORMS = {
    "modelMatrix": "mat4",
    "modelViewMatrix": "mat4",
    "projectionMatrix": "mat4",
    "viewMatrix": "mat4",
    "normalMatrix": "mat3",
    "cameraPosition": "vec3",
    "isOrthographic": "bool",
}
"""What the scene gives a shader."""
_OWN = {
    "vertex": (("gl_Position", "vec4", "out"), ("gl_VertexID", "int", "in")),
    "fragment": (("gl_FragCoord", "vec4", "in"), ("gl_FrontFacing", "bool", "in")),
}
_MATERIAL = {
    "vertex": (
        *((name, of, "in") for name, of in ATTRIBUTES.items()),
        *((name, of, "uniform") for name, of in UNIFORMS.items()),
    ),
    "fragment": tuple(
        (name, UNIFORMS[name], "uniform") for name in ("viewMatrix", "cameraPosition", "isOrthographic")
    ),
}


def declared_for(stage: str, dialect: str) -> tuple[GlobalVariable, ...]:
    """Return the variables that a shader of a stage finds declared."""
    rows = _OWN[stage] + (_MATERIAL[stage] if dialect == "shader-material" else ())
    return tuple(GlobalVariable(name, of, qualifier, False, Place(1)) for name, of, qualifier in rows)


def declared_elsewhere(stage: str, dialect: str) -> dict[str, str]:
    """Return names that only ShaderMaterial declares, with the declarations that a shader may write itself."""
    if dialect == "shader-material":
        return {}
    return {name: f"{qualifier} {of} {name}" for name, of, qualifier in _MATERIAL[stage]}


# One shader, read and checked, and its run on lanes.


STAGES = ("vertex", "fragment")
BLOCK = 16_384
"""Lanes that run at once, whole quads: their numbers stay in the processor's cache."""
NUMBERS = 1 << 22
"""Numbers that all variables of such lanes have together: 16 MB."""
SECONDS = 5.0
"""Seconds that a shader may run for one picture."""
LIMITS = replace(SHADER, seconds=SECONDS)


class ShaderRun(Run):
    """A run whose calls share their variables: each has a name of its own, and no function calls itself."""

    def __init__(
        self,
        lanes: int,
        limits: Limits,
        names: dict[str, GlslValue],
        watch: Watch | None = None,
        is_checking: bool = False,
        stop: Stop | None = None,
    ) -> None:
        super().__init__(lanes, limits, watch, is_checking, stop)
        self.names = names
        self.given: dict[str, Any] = {}


class ShaderExpressions(Expressions):
    """Compiles the expressions of a shader: a variable that was declared without a value can be read, and is 0."""

    def look(self, frame: Frame, mask: Some, name: str, place: Place) -> Any:
        """Return the value of a variable, and note where a lane of the mask (L,) has given it none."""
        given, run = frame.given.get(name), frame.run
        if given is not None and run.watch is not None:
            missing = ~given if mask is None else mask & ~given
            if missing.any():
                run.unset.append((name, missing))
        return frame.names[name]

    def whole(self, frame: Frame, mask: Some, name: str, place: Place) -> Any:
        """Return the value of a variable of which a part is about to be stored, for any mask (L,)."""
        return frame.names[name]


class ShaderStatements(Statements):
    """Compiles the statements of a shader, whose lanes may be discarded within a call."""

    expressions = ShaderExpressions

    def __init__(self, dialect: Dialect, functions: Program) -> None:
        super().__init__(dialect, functions)
        self._functions = functions.functions

    def statement(self, node: Statement) -> Step:
        """Compile a statement; one that calls a function which may discard lanes goes on without these."""
        step = super().statement(node)
        if isinstance(node, Break | Continue | Discard | Evaluate):
            step = _watched(node, step)
        if not self._may_discard_within(node):
            return step

        def run_step(frame: Frame, mask: Some) -> Mask:
            here = _without(mask, frame.run.dead, frame.run.lanes)
            if isinstance(here, Nobody):
                return NOBODY
            after = step(frame, here)
            return after if frame.run.is_checking else _without(after, frame.run.dead, frame.run.lanes)

        return run_step

    def _may_discard_within(self, node: Statement) -> bool:
        return any(
            isinstance(each, Call)
            and each.function in self._functions
            and any(isinstance(inner, Discard) for inner in walk(self._functions[each.function]))
            for each in walk(node)
        )


class ShaderFunctions(Program):
    """The functions of a shader over lanes."""

    compiler = ShaderStatements

    def _called(
        self, run: Run, function: Function, values: Sequence[Any], mask: Some, place: Place, depth: int
    ) -> Any:
        assert isinstance(run, ShaderRun)
        if depth >= run.limits.calls:
            raise Problem(place, f"calls go deeper than {run.limits.calls}")
        run.names.update(zip(function.parameters, values, strict=True))
        frame = Frame(run, run.names, depth + 1)
        frame.given = run.given
        left = self._bodies[function.name](frame, mask)
        goes_on = not isinstance(left, Nobody) and not function.is_void
        if goes_on and (frame.value is UNSET or not run.is_checking):
            raise Problem(function.place, f"{function.name} ends without return{run.some(left)}")
        return frame.value

    def run_main(self, run: ShaderRun, name: str = "main") -> None:
        """Run main, or in a check another function, in all lanes, with what the run's names hold."""
        function = self.functions[name]
        run.place = function.place
        try:
            with np.errstate(all="ignore"):
                self._called(
                    run, function, [run.names[each] for each in function.parameters], None, run.place, 0
                )
        except Problem:
            raise
        except NOT_COMPUTED as problem:
            raise Problem(run.place, f"this cannot be computed ({type(problem).__name__})") from None


def _watched(node: Statement, step: Any) -> Any:
    """Let what looks on see a statement that stores nothing."""

    def run_watched(frame: Frame, mask: Some) -> Mask:
        watch = frame.run.watch
        if watch is None:
            return cast(Mask, step(frame, mask))
        watch.begin(node, mask, frame)
        after: Mask = step(frame, mask)
        watch.end(node, mask, frame, None)
        return after

    return run_watched


def _without(mask: Mask, dead: Mask, lanes: int) -> Mask:
    """Return the lanes of a mask that were not discarded."""
    if isinstance(mask, Nobody) or isinstance(dead, Nobody):
        return mask
    if dead is None:
        return NOBODY
    left = ~dead if mask is None else mask & ~dead
    return left if left.any() else NOBODY


@dataclass(frozen=True, eq=False)
class Outcome:
    """What a run of a shader on L lanes gave."""

    values: Mapping[str, GlslValue]
    """Every variable at the end, by its own name."""
    discarded: Flags
    """(L,) bool."""


class Shader:
    """A vertex or fragment shader that was read and checked; see `compile_shader`."""

    def __init__(self, source: str, stage: str, dialect: str) -> None:
        if stage not in STAGES:
            raise ValueError(f"stage must be vertex or fragment, got {stage}")
        if dialect not in DIALECTS:
            raise ValueError(f"dialect must be one of {', '.join(DIALECTS)}, got {dialect}")
        self.source, self.stage, self.dialect = source, stage, dialect
        parser = Parser(source, stage, declared_for(stage, dialect), dialect == "shader-material")
        parser.scopes.declared_elsewhere = declared_elsewhere(stage, dialect)
        try:
            self.syntax: Syntax = parser.read()
        except RecursionError:
            raise Problem(Place(1), "this is nested too deep") from None
        self._check_calls()
        functions = self.syntax.functions
        main = functions["main"]
        body = self.syntax.prelude + main.body
        ordered = [Function(main.place, "main", (), body, True)]
        ordered += [function for name, function in functions.items() if name != "main"]
        glsl = GlslDialect(self.syntax.signatures, self.syntax.returns)
        self._functions = ShaderFunctions(glsl, ordered)
        self._check()

    @property
    def inputs(self) -> tuple[GlobalVariable, ...]:
        """Its in variables and uniforms, GLSL's own among them."""
        return tuple(v for v in self.syntax.variables if v.qualifier in ("in", "uniform"))

    @property
    def outputs(self) -> tuple[GlobalVariable, ...]:
        """Its out variables without GLSL's own."""
        return tuple(
            v for v in self.syntax.variables if v.qualifier == "out" and not v.name.startswith("gl_")
        )

    @property
    def block(self) -> int:
        """How many lanes run at once: the more variables, the fewer."""
        numbers = sum(component_count(of) for of in self.syntax.types) or 1
        return max(1024, min(BLOCK, NUMBERS // numbers // 4 * 4))

    @cached_property
    def weight(self) -> int:
        """How many statements a lane runs, roughly: see `weight_of`."""
        return sum(map(weight_of, self.syntax.functions.values()))

    @cached_property
    def mentioned(self) -> frozenset[str]:
        """Own names of the variables that its functions read or store."""
        nodes = (node for function in self.syntax.functions.values() for node in walk(function))
        return frozenset(node.name for node in nodes if isinstance(node, Name))

    @cached_property
    def discards(self) -> bool:
        """Whether some line discards fragments."""
        return self._has(lambda node: isinstance(node, Discard))

    @cached_property
    def needs_quads(self) -> bool:
        """Whether it looks at the lanes beside each: derivatives, and textures."""
        return self._has(lambda node: isinstance(node, Call) and node.function in (*DERIVATIVES, "texture"))

    @property
    def notes(self) -> tuple[str, ...]:
        """What is worth a sentence although it runs."""
        found = list(self.syntax.notes)
        if self.stage == "vertex" and "gl_Position" not in self.syntax.assigned:
            found.append(
                "gl_Position is never written: every vertex lands at (0, 0, 0, 0), and nothing is drawn."
            )
        return tuple(found)

    def run(
        self,
        given: Mapping[str, GlslValue],
        lanes: int,
        *,
        limits: Limits = LIMITS,
        watch: Watch | None = None,
        stop: Stop | None = None,
    ) -> Outcome:
        """Run on L lanes at once; what ``given`` lacks of the inputs is 0.

        Raises
        ------
        Problem
            With its place: an endless loop, a function that ends without return, too much time.
        """
        names = {v.name: given.get(v.name) or zero_of(v.of) for v in self.inputs}
        for variable in self.inputs:
            value = names[variable.name]
            if value.of != variable.of:
                raise Problem(
                    variable.place, f"{variable.name} is declared {variable.of}, it is given as {value.of}"
                )
        run = ShaderRun(lanes, limits, names, watch, stop=stop)
        self._functions.run_main(run)
        dead = run.dead
        discarded = np.zeros(lanes, bool) if isinstance(dead, Nobody) else np.ones(lanes, bool)
        if not isinstance(dead, Nobody) and dead is not None:
            discarded = dead
        return Outcome(run.names, discarded)

    def _has(self, wanted: Any) -> bool:
        return any(wanted(node) for function in self.syntax.functions.values() for node in walk(function))

    def _check_calls(self) -> None:
        """Refuse recursion, and calls of functions that are declared and never written."""
        functions = self.syntax.functions
        calls = {
            name: [n for n in walk(function) if isinstance(n, Call) and n.function in self.syntax.signatures]
            for name, function in functions.items()
        }
        for name, called in calls.items():
            for call in called:
                if call.function not in functions:
                    raise Problem(call.place, f"{call.function} is declared, but its body is missing")
                if name in _reached(call.function, calls):
                    raise Problem(
                        call.place, f"{call.function} calls itself in the end: GLSL has no recursion"
                    )

    def _check(self) -> None:
        """Run on no lanes: main first, then what no one has called."""
        if self.stage == "fragment":
            self._check_outputs()
        names = {v.name: _no_lanes(v) for v in self.inputs}
        run = ShaderRun(0, SHADER, names, is_checking=True)
        self._functions.run_main(run)
        reached = _reached(
            "main", {n: [c for c in walk(f) if isinstance(c, Call)] for n, f in self.syntax.functions.items()}
        )
        for name in self.syntax.functions:
            if name != "main" and name not in reached:
                signature = self.syntax.signatures[name]
                run.names.update(
                    {p: zero_of(of) for p, of in zip(signature.parameters, signature.types, strict=True)}
                )
                self._functions.run_main(run, name=name)

    def _check_outputs(self) -> None:
        outputs = self.outputs
        if not outputs:
            raise Problem(
                self.syntax.functions["main"].place,
                "no colour leaves this shader: declare out vec4 outColor; and write to it",
            )
        if outputs[0].of != "vec4":
            raise Problem(
                outputs[0].place,
                f"the colour is red, green, blue and alpha: write out vec4 {outputs[0].name}, not {outputs[0].of}",
            )


def _reached(name: str, calls: Mapping[str, Sequence[Expression]]) -> set[str]:
    """Return the functions that a function calls, itself included, however far down."""
    found, open_ = {name}, [name]
    while open_:
        for call in calls.get(open_.pop(), ()):
            assert isinstance(call, Call)
            if call.function not in found:
                found.add(call.function)
                open_.append(call.function)
    return found


def _no_lanes(variable: GlobalVariable) -> GlslValue:
    """Return the value of an input on no lanes: uniforms are one number, the others arrays (0,)."""
    value = zero_of(variable.of)
    if variable.qualifier == "uniform" or variable.of in ("sampler2D",) or variable.of.startswith("mat"):
        return value
    return GlslValue(variable.of, tuple(np.zeros(0, part.dtype) for part in value.parts))


@lru_cache(maxsize=64)
def compile_shader(source: str, stage: str, dialect: str = "shader-material") -> Shader:
    """Read and check a shader.

    Parameters
    ----------
    source : str
        GLSL ES 3.00, see the package.
    stage : str
        ``vertex`` or ``fragment``.
    dialect : str
        A key of `core.shaders.record.DIALECTS`.

    Raises
    ------
    Problem
        With line, column and one sentence.
    """
    return Shader(source, stage, dialect)
