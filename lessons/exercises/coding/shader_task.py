"""What a shader, or one of its functions, must do, and what a run of another text gives on hidden inputs."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

import numpy as np

from core import Settings, render
from core.lanes.problem import Place, Problem
from core.lanes.run import bounded
from core.scene import Scene, Texture
from core.shaders.glsl_types import MATRICES, GlslValue, component_count, from_rows
from core.shaders.rules import Sampler
from core.shaders.shader import SECONDS, Outcome, Shader, compile_shader
from core.shaders.stages import texture_colors_of
from lessons.exercises.coding.task import Case, Task
from lessons.exercises.coding.triangles import numbers_text

HEAD = "#version 300 es\nprecision highp float;\n"
"""Begins a whole shader."""
ROUNDED = 4e-6
"""Relative difference of two numbers that are the same: float32 rounds sums in their order."""
BYTE = 1 / 255
QUAD = 4
TEXTURED = Settings(texture_filter="nearest")
"""How hidden inputs read a texture."""
WIDENED = {
    "float": "vec4({}, 0.0, 0.0, 0.0)",
    "vec2": "vec4({}, 0.0, 0.0)",
    "vec3": "vec4({}, 0.0)",
    "vec4": "{}",
}
"""By the type that a function returns, how a colour is made of it."""
DISCARDED: list[float] = []
"""What stands for a fragment that is discarded."""


@dataclass(frozen=True, eq=False)
class Beside:
    """A scene as built-in shading draws it, and as a shader that was written does."""

    settings: Settings
    scene: Scene
    other: Scene

    @property
    def differs(self) -> bool:
        """Whether the two pictures differ by more than a byte."""
        mine, other = (render(scene, self.settings).color for scene in (self.scene, self.other))
        return bool((np.abs(mine - other) > BYTE).any())


@dataclass(frozen=True, eq=False)
class ShaderTask(Task):
    """A shader, or a function, to be repaired or written; a case has a value for each of what is ``given``."""

    tolerance: float = ROUNDED
    given: tuple[tuple[str, str], ...] = ()
    """Type and name of what the hidden inputs give: in variables, attributes, uniforms, or parameters."""
    outputs: tuple[str, ...] = ()
    """What is compared, as ``gl_Position``; none: what the function returns."""
    returns: str = ""
    """Type of what the function returns; empty: it is a whole shader."""
    textures: Mapping[str, Texture] = field(default_factory=dict)
    """By sampler, what it reads."""
    beside: Callable[[str], Beside | None] = field(default=lambda _text: None)
    """What a text draws beside built-in shading, which a right one equals; ``None``: nothing is drawn."""

    note: ClassVar[str] = "//"
    tail: ClassVar[str] = "\n}"

    @property
    def kind(self) -> str:
        """Which shader it is, or is tried in."""
        return "vertex" if "gl_Position" in self.outputs else "fragment"

    def told(self, value: list[float]) -> str:
        """Return what a shader gives in words: outputs of 3 numbers, gl_Position of 4."""
        if not value:
            return "discarded"
        if len(self.outputs) < 2:
            return numbers_text(value) if len(value) == 1 else f"({numbers_text(value)})"
        parts, at = [], 0
        for name in self.outputs:
            count = 4 if name == "gl_Position" else 3
            parts.append(f"{name} ({numbers_text(value[at : at + count])})")
            at += count
        return ", ".join(parts)

    @property
    def head(self) -> str:
        """The text up to the body of its last function."""
        lines = self.text.split("\n")
        last = max(number for number, line in enumerate(lines) if line.endswith("{") and line[0] != " ")
        return "\n".join(lines[: last + 1])

    @property
    def guessed(self) -> list[str]:
        """Texts of somebody who guesses."""
        return [f"{self.head}\n   {guess}{self.tail}" for guess in self.guesses]

    def read(self, text: str) -> Shader:
        """Return a text, read and checked: run on no lanes. `Problem` where it cannot run, or is not what is asked."""
        if not self.returns:
            return self._compiled(text, "")
        plain = self._compiled(text, "out vec4 result;\nvoid main() { result = vec4(0.0); }")
        name, wanted = self._name, tuple(of for of, _ in self.given)
        signature = plain.syntax.signatures.get(name)
        if signature is None or (signature.of, signature.types) != (self.returns, wanted):
            raise Problem(Place(1), f"the head of {name} must stay: {self.head.removesuffix(' {')}")
        values = ", ".join(f"given{k}" for k in range(len(wanted)))
        lines = [f"in {of} given{k};" for k, of in enumerate(wanted)]
        lines += ["out vec4 result;", "void main() {"]
        lines += [f"result = {WIDENED[self.returns].format(f'{name}({values})')};", "}"]
        return self._compiled(text, "\n".join(lines))

    @property
    def _name(self) -> str:
        return self.head.split("\n")[-1].split("(")[0].split(" ")[-1]

    def _compiled(self, text: str, more: str) -> Shader:
        """Read a text with what runs it below; what is wrong there is said at the end of the text."""
        last = text.count("\n") + 1
        try:
            return compile_shader(f"{text}\n{more}", self.kind)
        except Problem as problem:
            if problem.line <= last:
                raise
            raise Problem(Place(last), problem.sentence) from None

    def check_text(self, text: str) -> None:
        """Raise `Problem` for a text that cannot run."""
        self.read(text)

    def run(self, text: str) -> list[Any]:
        """Return the numbers that a text gives for every hidden input, of one that is discarded none."""
        shader, cases = self.read(text), [case for _, case in self.all_cases]
        repeated = QUAD if shader.needs_quads else 1
        names = [f"given{k}" if self.returns else name for k, (_, name) in enumerate(self.given)]
        columns = zip(*(case.values for case in cases), strict=True)
        given = {
            name: _of_lanes(of, column, repeated)
            for name, (of, _), column in zip(names, self.given, columns, strict=True)
        }
        colors_of = partial(texture_colors_of, TEXTURED)
        given |= {
            name: GlslValue("sampler2D", (Sampler((texture,), colors_of),))
            for name, texture in self.textures.items()
        }
        with bounded(SECONDS):
            outcome = shader.run(given, len(cases) * repeated)
        rows = np.concatenate(
            [self._numbers(shader, outcome, name) for name in self.outputs or ("result",)], axis=1
        )
        gone = outcome.discarded[::repeated]
        return [
            DISCARDED if is_gone else row
            for is_gone, row in zip(gone, rows[::repeated].tolist(), strict=True)
        ]

    def _numbers(self, shader: Shader, outcome: Outcome, name: str) -> Any:
        """Return the numbers (L, n) of an output, which a text must have."""
        value = outcome.values.get(name)
        if value is None:
            raise Problem(shader.syntax.functions["main"].place, f"{name} must be written: it is asked for")
        count = component_count(self.returns) if self.returns else len(value.parts)
        lanes = len(outcome.discarded)
        return np.stack([np.broadcast_to(part, (lanes,)) for part in value.parts[:count]], axis=1)


def _of_lanes(of: str, column: Sequence[Any], repeated: int) -> GlslValue:
    """Return the values of a type, one for each lane; a matrix has its numbers column by column."""
    rows = np.repeat(np.array(column, np.float32).reshape(len(column), -1), repeated, axis=0)
    if of not in MATRICES:
        return from_rows(of, rows)
    size = MATRICES[of]
    parts = np.ascontiguousarray(rows.T)
    return GlslValue(of, tuple(tuple(parts[size * c : size * c + size]) for c in range(size)))


def said_of(given: Sequence[tuple[str, str]], values: Sequence[Any]) -> str:
    """Return a hidden input in words; of matrices only whether they turn."""
    parts = []
    for (of, name), value in zip(given, values, strict=True):
        if of not in MATRICES:
            text = numbers_text([float(one) for one in np.ravel(value)])
            parts.append(f"{name} = {text if of == 'float' else f'({text})'}")
        elif not np.array_equal(np.reshape(value, (MATRICES[of], -1)), np.eye(MATRICES[of])):
            parts.append(f"a {name} that turns")
    return f"for {', '.join(parts)}"


def cases_of(
    given: Sequence[tuple[str, str]], classes: Mapping[str, Sequence[tuple[Any, ...]]]
) -> dict[str, tuple[Case, ...]]:
    """Return hidden inputs by class, each with its words."""
    return {
        name: tuple(Case(values, said_of(given, values)) for values in inputs)
        for name, inputs in classes.items()
    }
