"""Edited inside tests, fill rules and back-face tests: the text decides what is covered or dropped."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.coverage.edges import EdgeFunctions
from core.coverage.number_formats import number_format
from core.coverage.pixel_runs import FillTraits
from core.culling.normal_view import EyeTriangles, NormalView
from core.edits.typed import Typed, parameters_of
from core.methods import Method, is_registered, table
from core.records.arrays import Flags, Floats, Integers
from core.settings import Settings

# Edited inside tests and fill rules.


VALUES = "the three values, and whether the pixel is covered"
OWNS = "whether the edge owns the pixel centre"


@dataclass(frozen=True)
class TypedTest:
    """A rule of `core.coverage.edges.EdgeFunctions` that runs a typed text."""

    typed: Typed

    def __call__(
        self, edges: EdgeFunctions, primitive: Integers, x: Floats, y: Floats
    ) -> tuple[Floats, Flags]:
        """Return values (Q, 3) and coverage (Q,) of triangles at pixel centres (Q,)."""
        rows = [[np.ascontiguousarray(part[:, k]) for k in range(3)] for part in (edges.a, edges.b, edges.c)]
        owns_tie = [np.ascontiguousarray(edges.owns_tie[:, k]) for k in range(3)]

        def of_block(part: slice) -> list[Any]:
            shown = primitive[part]
            triples = [[row.take(shown) for row in three] for three in (*rows, owns_tie)]
            return [*triples, x[part], y[part]]

        shape = (("number",) * 3, "flag")
        values, covered = self.typed.run_blocks(of_block, len(primitive), shape, VALUES)
        return values.T, covered


def check_test(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    none, flags = [np.zeros(0)] * 3, [np.zeros(0, bool)] * 3
    typed.checked([none, none, none, flags, np.zeros(0), np.zeros(0)], (("number",) * 3, "flag"), VALUES)


def edited_test(method: Method, typed: Typed) -> Method:
    """Return a fill that decides by a text."""
    traits = method.traits or FillTraits()
    return replace(method, traits=replace(traits, rule=TypedTest(typed), test_listing=typed))


def test_is_passed_over(settings: Settings, scene: Any) -> str:
    """Return why an edited inside test would not run."""
    if number_format(settings.coverage).held_as is not np.float64:
        return f"It runs in float64, not in the numbers of coverage {settings.coverage}."
    return areas_pass_over(settings)


def areas_pass_over(settings: Settings) -> str:
    """Return why no pixel centre is tested."""
    if is_registered(settings.antialiasing, "area"):
        return "Exact areas test no pixel centre: choose another antialiasing."
    return ""


def fill_rule_is_passed_over(settings: Settings, scene: Any) -> str:
    """Return why an edited fill rule would not run."""
    if number_format(settings.coverage).held_as is object:
        return f"It takes no whole numbers of any length, as those of coverage {settings.coverage}."
    if "projected" in table.get("fill", settings.fill).needs:
        return f"The fill {settings.fill} has no fill rule."
    return areas_pass_over(settings)


@dataclass(frozen=True)
class TypedFillRule:
    """A fill rule that runs a typed text."""

    typed: Typed

    def __call__(self, a: np.ndarray, b: np.ndarray) -> Flags:
        """Return who owns the centres on its edge; any shape, as a and b."""
        a, b = np.broadcast_arrays(a, b)
        flat_a, flat_b = a.ravel(), b.ravel()
        owns: Flags = self.typed.run_blocks(lambda part: [flat_a[part], flat_b[part]], a.size, "flag", OWNS)
        return owns.reshape(a.shape)


def check_fill_rule(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    typed.checked([np.zeros(0), np.zeros(0)], "flag", OWNS)


def edited_fill_rule(method: Method, typed: Typed) -> Method:
    """Return a fill rule that runs a text."""
    return replace(method, function=TypedFillRule(typed), listing=typed)


# Edited back-face tests by N . V: the text decides which triangles are dropped.


TRIANGLE = 3
SHAPE = (("number",) * 3, "number", "flag")
WORDS = "N, its product with V, and whether the triangle is dropped"


@dataclass(frozen=True)
class TypedLook:
    """Looks at triangles from the eye by a typed text.

    Near 0 its N . V has the sign that rounding gives it; the method settles that by exact arithmetic.
    """

    typed: Typed
    right: Callable[[EyeTriangles], NormalView]

    def __call__(self, eye: EyeTriangles) -> NormalView:
        """Return N . V of T triangles, and what the text drops."""
        seen = self.right(eye)

        def of_block(part: slice) -> list[Any]:
            return look_inputs(
                self.typed, eye.corners[..., part], eye.given[..., part], eye.carry[part], seen
            )

        normal, product, drops = self.typed.run_blocks(of_block, len(seen.product), SHAPE, WORDS)
        return replace(seen, normal=normal.T, product=product, drops=drops)


def look_inputs(typed: Typed, corners: Floats, given: Floats, carry: Floats, seen: NormalView) -> list[Any]:
    """Return what a listing is given of triangles, in the order of its parameters.

    ``corners`` and ``given`` are (3, 3, T), as `EyeTriangles` has them, ``carry`` is (T, 3, 3).
    """
    rows = np.ascontiguousarray(carry.transpose(1, 2, 0))
    known = {
        "corners": [list(corner) for corner in corners],
        "given": [list(corner) for corner in given],
        "carry": [list(row) for row in rows],
        "corner": list(corners[0]),
        "is_parallel": seen.is_parallel,
    }
    return [known[name] for name in parameters_of(typed.of)]


def cull_is_passed_over(settings: Settings, scene: Any) -> str:
    """Return why an edited back-face test would not run."""
    if scene is not None and scene.corner_count > TRIANGLE:
        return "A polygon is culled by the sign of its area."
    return ""


def check_cull(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    none = np.zeros((3, 3, 0))
    eye = EyeTriangles(none, none, none.transpose(2, 0, 1), False)
    seen = NormalView(eye, none[0].T, none[0].T, np.zeros(0), False)
    typed.checked(look_inputs(typed, none, none, eye.carry, seen), SHAPE, WORDS)


def edited_cull(method: Method, typed: Typed) -> Method:
    """Return a method of culling that decides by a text."""
    return replace(method, traits=TypedLook(typed, method.traits), listing=typed)
