"""Edited depth tests, depth formats and blending."""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar

import numpy as np

from core.depth.depth import DepthFormat, Stored, as_float32
from core.edits.typed import Typed, parameters_of
from core.families import casts_rays
from core.methods import Method, is_registered
from core.records.arrays import Flags, Floats, Singles
from core.resolved import resolve
from core.settings import Settings

TESTED = "what the buffer holds then, and whether the fragment passes"
STORED = "the depth as it is stored"
COLOR = "four numbers"
FOUR = ("number",) * 4


@dataclass(frozen=True)
class OrderedDepths(DepthFormat):
    """A depth format of which nothing is known: fragments are tested in drawing order, and depths may be negative."""

    keeps_nearest: ClassVar[bool] = False


@dataclass(frozen=True)
class TypedDepths(OrderedDepths):
    """A depth format whose test is a typed text."""

    typed: Typed | None = None

    def try_depths(self, new: Stored, old: Stored, writes: Flags | None) -> Flags:
        """Return which depths (F,) pass; ``old`` (F,) becomes what the text says."""
        assert self.typed is not None
        writes = np.ones(len(new), bool) if writes is None else writes

        def of_block(part: slice) -> list[Any]:
            return [new[part], old[part], self.larger_is_nearer, writes[part]]

        passes: Flags
        old[:], passes = self.typed.run_blocks(of_block, len(new), ("number", "flag"), TESTED)
        return passes

    def is_nearer(self, new: Stored, old: Stored) -> Flags:
        """Decide the test of stored values (F,) alone."""
        return self.try_depths(new, old.copy(), None)


def fields_of(known: DepthFormat) -> dict[str, Any]:
    """Return the fields that every depth format has."""
    return {field.name: getattr(known, field.name) for field in fields(DepthFormat)}


@dataclass(frozen=True)
class TypedDepthTest:
    """Makes the depth format of a method with a typed test."""

    right: Callable[[], DepthFormat]
    typed: Typed

    def __call__(self) -> DepthFormat:
        """Return it."""
        kept = fields_of(self.right()) | {"test_listing": self.typed}
        return TypedDepths(**kept, typed=self.typed)


@dataclass(frozen=True)
class TypedStore:
    """What a depth is stored as, by a typed text."""

    typed: Typed
    scale: float

    def __call__(self, depth: Floats) -> Stored:
        """Return depths (F,) as they are stored; what is not finite is never seen, and stays as it is."""
        stored = depth.astype(np.float32)
        known = np.flatnonzero(np.isfinite(depth))
        finite = depth.take(known)
        steps = [self.scale] * (len(parameters_of(self.typed.of)) - 1)
        found = self.typed.run_blocks(lambda part: [finite[part], *steps], len(known), "number", STORED)
        stored[known] = as_float32(found)
        return stored


@dataclass(frozen=True)
class TypedDepthFormat:
    """Makes the depth format of a method that stores by a typed text."""

    right: Callable[[], DepthFormat]
    typed: Typed

    def __call__(self) -> DepthFormat:
        """Return it."""
        known = self.right()
        store = TypedStore(self.typed, known.scale)
        if isinstance(known, OrderedDepths):
            return replace(known, store=store)
        return OrderedDepths(**(fields_of(known) | {"store": store}))


def check_depth_format(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    steps = [1.0] * (len(parameters_of(typed.of)) - 1)
    typed.checked([np.zeros(0), *steps], "number", STORED)


def edited_depth_format(method: Method, typed: Typed) -> Method:
    """Return a depth method that stores by a text."""
    return replace(method, function=TypedDepthFormat(method.function, typed), listing=typed)


def check_depth_test(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    none = np.zeros(0, np.float32)
    typed.checked([none, none, False, np.zeros(0, bool)], ("number", "flag"), TESTED)


def edited_depth_test(method: Method, typed: Typed) -> Method:
    """Return a depth method that tests by a text."""
    return replace(method, function=TypedDepthTest(method.function, typed))


def depth_test_is_passed_over(settings: Settings, scene: Any) -> str:
    """Return why an edited depth test would not run."""
    if not is_registered(settings.visibility, "z-buffer"):
        return "Only the depth buffer tests depths: choose visibility z-buffer."
    if is_registered(settings.antialiasing, "area"):
        return "Exact areas have a depth test of their own: choose another antialiasing."
    return ""


def depth_format_is_passed_over(settings: Settings, scene: Any) -> str:
    """Return why an edited depth format would not run."""
    if casts_rays(settings.visibility):
        return "Triangles are compared exactly, without a depth buffer."
    return ""


@dataclass(frozen=True)
class TypedBlend:
    """A blend rule that runs a typed text."""

    typed: Typed
    takes_both: bool
    """Whether the listing takes what is there, too."""

    def __call__(self, source: Floats, destination: Singles) -> Singles:
        """Return colours (F, 4) float32, of fragments (F, 4) over those of their pixels (F, 4)."""

        def of_block(part: slice) -> list[Any]:
            both = (source, destination) if self.takes_both else (source,)
            return [[np.ascontiguousarray(color[part, k]) for k in range(4)] for color in both]

        found = self.typed.run_blocks(of_block, len(source), FOUR, COLOR)
        return np.asarray(found.T.astype(np.float32, order="C"))


def _takes_both(typed: Typed) -> bool:
    return typed.of.__code__.co_argcount == 2


def check_blend(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    colors = [[np.zeros(0)] * 4, [np.zeros(0, np.float32)] * 4]
    typed.checked(colors if _takes_both(typed) else colors[:1], FOUR, COLOR)


def edited_blend(method: Method, typed: Typed) -> Method:
    """Return a blend method that runs a text, of which nothing else is known: it may hide nothing."""
    rule = TypedBlend(typed, _takes_both(typed))
    traits = replace(method.traits, hides=_hides_nothing)
    return replace(method, function=rule, listing=typed, traits=traits)


def _hides_nothing(alpha: Floats) -> Flags:
    return np.zeros(alpha.shape, bool)


def blend_is_passed_over(settings: Settings, scene: Any) -> str:
    """Return why an edited blend method would not run."""
    inserted = resolve(settings).blend_inserted_for
    return f"Lines of {inserted} are mixed by blend over." if inserted else ""
