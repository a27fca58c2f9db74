"""Edited interpolation: weights and values both come from the text."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.edits.typed import Typed, parameters_of
from core.fragments.interpolation import Planes, interpolate_affine_at, interpolate_at
from core.fragments.value_rule import ValuePlaces, ValueRule
from core.methods import Method
from core.records.arrays import Floats, Integers
from core.resolved import resolve
from core.settings import Settings

WEIGHTS = "the weights of the three corners"
GIVEN: dict[str, Callable[[ValuePlaces, slice], Any]] = {
    "a": lambda at, part: _rows(at.planes.a, at.primitive[part]),
    "b": lambda at, part: _rows(at.planes.b, at.primitive[part]),
    "c": lambda at, part: _rows(at.planes.c, at.primitive[part]),
    "w": lambda at, part: _rows(at.planes.w, at.primitive[part]),
    "determinant": lambda at, part: at.planes.determinant.take(at.primitive[part]),
    "corners": lambda at, part: [list(xy) for xy in at.planes.window.take(at.primitive[part], axis=2)],
    "x": lambda at, part: at.x[part],
    "y": lambda at, part: at.y[part],
    "provoking": lambda at, _part: at.provoking,
    "interval": lambda at, _part: at.interval,
}
"""What listings of the family are given, by the names of their parameters; ``values`` come beside."""
WITH_SUM = (interpolate_at, interpolate_affine_at)
"""Listings that return the sum of what they divide by it, too."""
THREE = ("number",) * 3


def _rows(values: Floats, primitive: Integers) -> list[Floats]:
    return [values[:, k].take(primitive) for k in range(3)]


@dataclass(frozen=True)
class TypedInterpolation(ValueRule):
    """A rule of the family ``interpolation`` that runs a typed text."""

    typed: Typed

    @property
    def _parameters(self) -> tuple[str, ...]:
        return parameters_of(self.typed.of)

    @property
    def _shape(self) -> tuple[Any, ...]:
        return (THREE, "number", "number") if self.typed.of in WITH_SUM else (THREE, "number")

    @property
    def _words(self) -> str:
        return f"{WEIGHTS}, {'their sum, ' if len(self._shape) == 3 else ''}and the value"

    def __call__(
        self, planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int, interval: int
    ) -> Floats:
        """Return weights (F, 3)."""
        at = ValuePlaces(planes, primitive, x, y, provoking, interval)
        return self.weights_and_values(at, np.zeros((3, len(primitive))))[0].T

    def weights_and_values(self, at: ValuePlaces, corners: Floats) -> tuple[Floats, Floats]:
        """Return weights (3, F) and values (F,) between those of the corners (3, F)."""

        def of_block(part: slice) -> list[Any]:
            at_corners = list(corners[:, part])
            return [at_corners if name == "values" else GIVEN[name](at, part) for name in self._parameters]

        weights, *_, values = self.typed.run_blocks(of_block, len(at.primitive), self._shape, self._words)
        return weights, values

    def check(self) -> None:
        """Raise `Problem` for a text that cannot run."""
        none = np.zeros((0, 3))
        planes = Planes(none, none, none, np.zeros(0), none, np.zeros((0, 3, 3)))
        at = ValuePlaces(planes, np.zeros(0, np.int64), np.zeros(0), np.zeros(0), 2, 16)
        values = [
            [np.zeros(0)] * 3 if name == "values" else GIVEN[name](at, slice(0)) for name in self._parameters
        ]
        self.typed.checked(values, self._shape, self._words)


def check_interpolation(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    TypedInterpolation(typed).check()


def edited_interpolation(method: Method, typed: Typed) -> Method:
    """Return an interpolation that runs a text."""
    return replace(method, function=TypedInterpolation(typed), listing=typed)


def interpolation_is_passed_over(settings: Settings, scene: Any) -> str:
    """Return why an edited interpolation would not run."""
    if (scene is not None and scene.corner_count < 3) or resolve(settings).is_outlined:
        return "Lines and points are interpolated along themselves, by listings of their own."
    return ""
