"""Edited back-face tests by N . V: the text decides which triangles are dropped."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.edits.typed import Typed, parameters_of
from core.geometry.normal_view import EyeTriangles, NormalView
from core.methods import Method
from core.records.arrays import Floats
from core.settings import Settings

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
