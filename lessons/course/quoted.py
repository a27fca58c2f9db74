"""Numbers that a text quotes, as comparisons: ``drawn(32, 24) == 16``, read by the parser of conditions.

A number with a fraction is equal to what agrees with it in the digits that are written: ``E0 == 8.5``, ``t == 0.427``.
"""

import ast
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from functools import cached_property
from typing import Any

import numpy as np

from core import Settings, Trace, render
from core.edits.edit import Edit, edited_settings
from core.framebuffer.display import to_display
from core.records.arrays import Flags
from core.records.frame import Frame
from core.records.listing import read_expression
from core.scene import AnyScene, Scene
from core.setting_texts import settings_from_texts
from core.study.planner.trials import difference
from core.trace import trace
from core.trace.conditions import Condition, TraceNames, evaluate, parse_condition, spelled
from core.trace.run_to import named_position
from core.trace.stage_trace import MARKS, StageTrace
from lessons.exercises.drafting import different_pixels

COUNTS = ("drawn", "twice", "tested", "decisions", "colors", "rows")
"""Counts that are names as well as functions of settings."""


@dataclass(frozen=True, eq=False)
class Situation:
    """What is open, and where the cursor stands: all that conditions are asked about."""

    run: Trace
    stage: str
    position: int
    pixel: tuple[int, int] | None = None
    """The pixel that is pinned."""
    other: Settings | None = None
    """Of side B, where A | B is shown."""
    edits: tuple[Edit, ...] = ()
    """Listings that are edited: side B runs them."""

    @property
    def scene(self) -> AnyScene:
        """The scene at the size that is traced."""
        return self.run.source.scene

    @property
    def settings(self) -> Settings:
        """The settings of the run."""
        return self.run.source.settings

    @property
    def trace(self) -> StageTrace:
        """The stage of the cursor."""
        return self.run.stage(self.stage)

    @cached_property
    def edited(self) -> "Situation":
        """The run of the edited listings, at its start; where none is edited, what is open.

        Raises ValueError where an edited listing cannot run.
        """
        if not self.edits:
            return self
        other = edited_settings(self.settings, self.scene, self.edits)[1]
        return Situation(trace(self.scene, other), self.stage, 0, self.pixel)

    @cached_property
    def _frames(self) -> dict[str, Frame]:
        return {}

    def frame(self, chosen: Mapping[str, str] | None = None) -> Frame:
        """Return the picture, with other methods where they are ``chosen``; shading that is chosen needs no shaders."""
        key = repr(sorted((chosen or {}).items()))
        if key not in self._frames:
            scene = self.scene
            if "shading" in (chosen or {}) and isinstance(scene, Scene):
                scene = replace(scene, program=None)
            self._frames[key] = render(scene, self.chosen(chosen))
        return self._frames[key]

    def chosen(self, chosen: Mapping[str, str] | None) -> Settings:
        """Return the settings with other methods."""
        return settings_from_texts(dict(chosen), self.settings) if chosen else self.settings


def flags_of(text: str, found: StageTrace) -> Flags:
    """Return (R,) bool, the rows that have a mark of `MARKS` or meet a condition; ValueError as it is read."""
    if text in MARKS:
        return found.marks.get(text, np.zeros(found.steps.row_count, bool))
    return parse_condition(text).holds(found)


def parse_quoted(text: str) -> Condition:
    """Read a comparison of numbers; ValueError with a sentence where it is none."""
    condition = parse_condition(text, CALLED)
    tree = _AsWritten().visit(condition.tree)
    return Condition(condition.text, tree)


def is_right(text: str, situation: Situation) -> bool:
    """Return whether a quoted number is right; ValueError where it names what there is not."""
    return bool(parse_quoted(text).holds_of(_Names(situation))[0])


def value_of(text: str, situation: Situation) -> Any:
    """Return a number that a name or a call stands for, as ``drawn``; ValueError where there is none."""
    return np.asarray(evaluate(read_expression(text), _Names(situation))).item()


def said_instead(text: str, situation: Situation) -> str:
    """Return what the program says where a comparison does not hold, as ``drawn is 12``; empty: no one number."""
    match parse_condition(text, CALLED).tree:
        case ast.Compare(left=left, ops=[_], comparators=[ast.Constant() | ast.UnaryOp()]):
            found = np.asarray(evaluate(left, _Names(situation)))
            asked = ast.get_source_segment(text.strip(), left)
            return f"{asked} is {found.item()}" if found.size == 1 else ""
    return ""


class _AsWritten(ast.NodeTransformer):
    """Makes of ``a == 0.43`` a call of ``near``: equal in the digits that are written."""

    def visit_Compare(self, node: ast.Compare) -> ast.expr:
        """Replace one comparison."""
        self.generic_visit(node)
        if len(node.ops) != 1 or not isinstance(node.ops[0], ast.Eq):
            return node
        for number, other in ((node.comparators[0], node.left), (node.left, node.comparators[0])):
            value = number.operand if isinstance(number, ast.UnaryOp) else number
            if isinstance(value, ast.Constant) and isinstance(value.value, float):
                return ast.Call(ast.Name("near", ast.Load()), [other, number], [])
        return node


class _RowNames(TraceNames):
    """The variables of all rows, and arithmetic with them."""

    def call(self, name: str, given: Sequence[ast.expr], chosen: Mapping[str, str]) -> Any:
        """Return what a function of `ARITHMETIC` gives."""
        if name not in ARITHMETIC or chosen:
            raise ValueError(f"{name} is no function of a row")
        return ARITHMETIC[name](*(evaluate(part, self) for part in given))


@dataclass(frozen=True, eq=False)
class _Names:
    """What names and functions stand for in one situation."""

    situation: Situation
    row_count: int = 1

    def value(self, name: str) -> Any:
        """Return a count, or a variable of the row that was just done."""
        if name in COUNTS:
            return np.asarray(FUNCTIONS[name][0](self.situation, [], {}))
        found = self.situation.trace
        values = np.asarray(TraceNames(found).value(name))
        is_of_rows = values.shape[:1] == (found.steps.row_count,)
        return self._of_row(name, values) if is_of_rows else values

    def is_of_kind(self, kind: str) -> Flags:
        """Return whether the row that was just done is of a kind."""
        flags: Flags = self._of_row("kind", TraceNames(self.situation.trace).is_of_kind(kind))
        return flags

    def _of_row(self, name: str, values: Any) -> Any:
        row, _ = self.situation.trace.steps.row_at(self.situation.position)
        if row < 0:
            raise ValueError(f"no row is done where {name} is asked for: name one by at")
        return values[row : row + 1]

    def call(self, name: str, given: Sequence[ast.expr], chosen: Mapping[str, str]) -> Any:
        """Return what a function of `FUNCTIONS` or `OVER_ROWS` gives."""
        situation = self.situation
        if name == EDITED:
            if len(given) != 1 or chosen:
                raise ValueError(f"expected what is asked of the edited listings, as {name}(drawn)")
            return evaluate(given[0], _Names(situation.edited))
        if name in OVER_ROWS:
            if len(given) != 1:
                raise ValueError(f"expected one condition, as {name}(covered)")
            found = trace(situation.scene, situation.chosen(chosen)).stage(situation.stage)
            found = found if chosen else situation.trace
            text = spelled(given[0])
            names = _RowNames(found)
            flags = found.marks.get(text) if text in MARKS else np.asarray(evaluate(given[0], names))
            count = 0 if flags is None else int(np.count_nonzero(np.broadcast_to(flags, names.row_count)))
            return count > 0 if name == "some" else count
        values = [evaluate(part, self).item() for part in given]
        try:
            if name in ARITHMETIC:
                return ARITHMETIC[name](*values)
            function, counts = FUNCTIONS[name]
            if len(values) in counts:
                return function(situation, values, chosen)
        except (TypeError, IndexError, OverflowError):
            pass
        raise ValueError(f"{name} does not take {', '.join(map(ast.unparse, given)) or 'nothing'}")


def _pixel(frame: Frame, x: float, y: float) -> tuple[int, int]:
    rows, columns = frame.primitive.shape
    if not (0 <= x < columns and 0 <= y < rows):
        raise ValueError(f"expected a pixel of the {columns} x {rows} there are, got ({x:g}, {y:g})")
    return int(y), int(x)


def _drawn(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    frame = situation.frame(chosen)
    if given:
        x, y = given
        return int(frame.cover_count[_pixel(frame, x, y)])
    return int(np.count_nonzero(frame.cover_count))


def _twice(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    return int(np.count_nonzero(situation.frame(chosen).cover_count > 1))


def _seen(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    (triangle,) = given
    return int(np.count_nonzero(situation.frame(chosen).primitive == triangle))


def _owner(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    frame = situation.frame(chosen)
    x, y = given
    return int(frame.primitive[_pixel(frame, x, y)])


def _other_frame(situation: Situation, chosen: Mapping[str, str]) -> Frame:
    if chosen:
        return situation.frame(chosen)
    if situation.edits:
        return situation.edited.frame()
    if situation.other is None:
        raise ValueError("expected a method, as differs(depth=z-16), or a state with other")
    return render(situation.scene, situation.other)


def _differs(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    return len(different_pixels(situation.frame(), _other_frame(situation, chosen), most=0))


def _apart(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    frames = situation.frame(), _other_frame(situation, chosen)
    colors = (to_display(frame.color).pixels[..., :3].astype(np.int64) for frame in frames)
    return int(difference(*colors).max())


def _unlike(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    other = _other_frame(situation, chosen)
    return int(np.count_nonzero(situation.frame().primitive != other.primitive))


def _tested(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    return situation.frame(chosen).statistics["raster"].incoming


def _decisions(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    run = trace(situation.scene, situation.chosen(chosen)) if chosen else situation.run
    blocks = run.stage("bin")
    count = sum(
        int(np.count_nonzero(blocks.steps.kind == k))
        for k, kind in enumerate(blocks.steps.kinds)
        if kind == "block"
    )
    return count + _tested(situation, [], chosen)


def _colors(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    pixels = to_display(situation.frame(chosen).color).pixels
    return len(np.unique(pixels.reshape(-1, pixels.shape[-1]), axis=0))


def _rows(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    run = trace(situation.scene, situation.chosen(chosen)) if chosen else situation.run
    return run.stage(str(given[0]) if given else situation.stage).steps.row_count


def _attribute(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> float:
    frame = situation.frame(chosen)
    x, y, number = given
    return float(str(frame.attributes[_pixel(frame, x, y)][int(number)]))


def _u(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> float:
    return _attribute(situation, [*given, 0], chosen)


def _v(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> float:
    return _attribute(situation, [*given, 1], chosen)


def _linear(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> float:
    frame = situation.frame(chosen)
    x, y, channel = given
    return float(str(frame.color[_pixel(frame, x, y)][int(channel)]))


def _shown(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> int:
    frame = situation.frame(chosen)
    x, y, channel = given
    return int(to_display(frame.color).pixels[_pixel(frame, x, y)][int(channel)])


def _stored(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> float:
    frame = situation.frame(chosen)
    x, y = given
    return float(str(frame.depth[_pixel(frame, x, y)]))


def _buffer(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> float:
    """Return what a buffer of the stage holds where the cursor stands."""
    name, x, y, *channel = given
    found = situation.trace
    track = next((each for each in found.buffers if each.name == name), None)
    if track is None:
        raise ValueError(
            f"expected a buffer of {found.stage}, one of {', '.join(t.name for t in found.buffers)}"
        )
    held = track.at(found.steps.rows_done(situation.position))[int(y), int(x)]
    return float(np.asarray(held)[int(channel[0])] if channel else held)


def _value(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> Any:
    """Return a variable of the row that an ``at`` names, of this stage or another one."""
    name, at, *more = given
    stage = str(more[0]) if more and isinstance(more[0], str) else situation.stage
    run = trace(situation.scene, situation.chosen(chosen)) if chosen else situation.run
    place = Situation(run, stage, named_position(run.stage(stage), str(at)))
    found = np.asarray(_Names(place).value(str(name)))
    numbers = [int(one) for one in more if not isinstance(one, str)]
    return found[(0, *numbers)] if found.ndim else found


def _place(situation: Situation, given: list[Any], chosen: Mapping[str, str]) -> float:
    """Return x, y, depth or w of a corner in the window."""
    triangle, corner, name = given
    vertices = situation.run.source.geometry.vertices
    number = int(vertices.corners[int(triangle), int(corner)])
    if name == "w":
        return float(vertices.clip[number, 3])
    return float(vertices.window[number, ("x", "y", "depth").index(name)])


def near(one: Any, other: Any) -> Any:
    """Return whether numbers agree with one in the digits that it has."""
    exponent = Decimal(repr(float(other))).as_tuple().exponent
    return np.abs(np.asarray(one, float) - float(other)) <= 0.5 * 10.0 ** int(exponent) * (1 + 1e-9)


Function = Callable[[Situation, list[Any], Mapping[str, str]], Any]

FUNCTIONS: dict[str, tuple[Function, tuple[int, ...]]] = {
    "drawn": (_drawn, (0, 2)),
    "twice": (_twice, (0,)),
    "seen": (_seen, (1,)),
    "owner": (_owner, (2,)),
    "differs": (_differs, (0,)),
    "apart": (_apart, (0,)),
    "unlike": (_unlike, (0,)),
    "tested": (_tested, (0,)),
    "decisions": (_decisions, (0,)),
    "colors": (_colors, (0,)),
    "rows": (_rows, (0, 1)),
    "attribute": (_attribute, (3,)),
    "u": (_u, (2,)),
    "v": (_v, (2,)),
    "linear": (_linear, (3,)),
    "shown": (_shown, (3,)),
    "stored": (_stored, (2,)),
    "buffer": (_buffer, (3, 4)),
    "value": (_value, (2, 3, 4)),
    "place": (_place, (3,)),
}
"""What a quoted number may ask, and how many numbers or texts it takes."""
ARITHMETIC: dict[str, Callable[..., Any]] = {
    "near": near,
    "abs": np.abs,
    "floor": np.floor,
    "round": np.round,
    "sqrt": np.sqrt,
    "log2": np.log2,
    "power": np.power,
}
"""Functions of numbers alone, which may stand in a condition over rows, too."""
OVER_ROWS = ("count", "some")
"""Functions of a condition, which is asked of all rows of the stage."""
EDITED = "edited"
"""A function of a number that is asked of the run of the edited listings."""
CALLED = (*FUNCTIONS, *ARITHMETIC, *OVER_ROWS, EDITED)
"""All names that may be called."""
