"""Choosing shading, texture filter and interpolation: each the cheapest whose bound still fits into the tolerance.

Their errors are bounds of linear light at every sample, so they add up, whatever the number of samples; each is turned
into bytes where the light is darkest after all that came before.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.records.arrays import Flags, Floats
from core.scene import AnyScene, Scene
from core.settings import Settings, with_method
from core.study.planner.bounds.bytes import byte_error, times
from core.study.planner.bounds.color_ranges import ColorRanges
from core.study.planner.bounds.shading_bounds import shading_error
from core.study.planner.bounds.tried_light import tried_error
from core.study.planner.bounds.value_bounds import filter_error, interpolation_error, share_of_range
from core.study.planner.choices.costs import Costs
from core.study.planner.progress import Pause, unpaused
from core.study.planner.scene_analysis.conservative_coverage import Touched, is_cut
from core.study.planner.scene_analysis.sample_patterns import Pattern

FILTERS = ("nearest", "bilinear")
SHADINGS = ("unlit", "flat", "gouraud")
INTERPOLATIONS = ("flat", "affine", "affine-n")
ROUNDING = 1e-9
"""Bounds below this, in 1/255, are rounding of equal colours."""


@dataclass(frozen=True)
class ValueChoice:
    """What was chosen of one family, and the bounds of the others that are cheaper."""

    chosen: str
    error: float
    """Bound in 1/255."""
    rejected: tuple[tuple[str, float], ...]
    """Cheaper methods and their bounds in 1/255, which are too large."""
    slower: tuple[str, ...] = ()
    """Methods that would do, but take longer."""
    is_dearest: bool = False
    """Whether nothing cheaper was chosen than everything on has."""
    allowed: float = 0.0
    """What was left of the tolerance before, in 1/255."""


class Budget:
    """What is left of the tolerance, at the pairs that can be seen."""

    def __init__(self, colors: ColorRanges, left: float) -> None:
        self._low = colors.low
        self._spent = np.zeros_like(self._low)
        self.left = left

    def cost(self, error: Floats) -> float:
        """Return what an error (Q, 3) of linear light costs, in 1/255."""
        if not error.any():
            return 0.0
        dark = np.maximum(self._low - self._spent - np.nan_to_num(error, nan=np.inf, posinf=np.inf), 0.0)
        found = float(byte_error(dark, error).max())
        return 0.0 if found < ROUNDING else found

    def choose(
        self, options: dict[str, Floats], dearest: str, is_slower: Callable[[str], bool]
    ) -> ValueChoice:
        """Return the first of the ``options``, each with its error (Q, 3), that fits and is no slower, and spend it."""
        allowed = self.left
        rejected: list[tuple[str, float]] = []
        slower: list[str] = []
        for name, error in options.items():
            cost = self.cost(error)
            if cost > self.left:
                rejected.append((name, cost))
            elif is_slower(name):
                slower.append(name)
            else:
                self.left -= cost
                self._spent += error
                return ValueChoice(name, cost, tuple(rejected), tuple(slower), allowed=allowed)
        return ValueChoice(dearest, 0.0, tuple(rejected), tuple(slower), is_dearest=True, allowed=allowed)


def choose_values(
    touched: Touched,
    colors: ColorRanges,
    scene: AnyScene,
    settings: Settings,
    seen: Flags,
    left: float,
    pattern: Pattern,
    costs: Costs,
    pause: Pause = unpaused,
) -> dict[str, ValueChoice]:
    """Choose by family.

    Parameters
    ----------
    touched : Touched
    colors : ColorRanges
    scene : Scene or ClipScene
    settings : Settings
        With what was chosen of the stages that decide what is seen.
    seen : (Q,) bool
        The pairs of the look that may be seen.
    left : float
        What is left of the tolerance, in 1/255.
    pattern : Pattern
        The samples that were chosen.
    costs : Costs
    pause : callable, optional
        Asked between the methods, see `Pause`.
    """
    index = np.flatnonzero(seen)
    touched, colors = touched.take(index), colors.take(index)
    budget = Budget(colors, left)
    chosen = settings

    def choose(family: str, options: dict[str, Floats]) -> ValueChoice:
        """Choose one family after those before it."""
        nonlocal chosen
        before = chosen

        def is_slower(name: str) -> bool:
            return costs.is_slower(with_method(before, family, name), before)

        value = budget.choose(options, getattr(settings, family), is_slower)
        chosen = with_method(chosen, family, value.chosen)
        return value

    shading = ValueChoice(settings.shading, 0.0, ())
    if isinstance(scene, Scene) and settings.shading != "unlit":
        errors = {}
        for name in SHADINGS:
            pause()
            light = shading_error(touched, scene, name)
            primitive = touched.primitive
            error = times(colors.albedo, light.diffuse[primitive]) + light.specular[primitive]
            is_lit = name != "unlit"
            errors[name] = tried_error(error, touched, colors, scene, pattern, name) if is_lit else error
        shading = choose("shading", errors)
    pause()
    has_texture = "uv" in touched.geometry.primitives.layout
    filters = {name: filter_error(touched, colors, scene, name, pattern.side) for name in FILTERS}
    found = choose("texture_filter", filters) if has_texture else ValueChoice("nearest", 0.0, ())

    def moved(name: str) -> Floats:
        pause()
        where = shares[name], shading.chosen, found.chosen, pattern
        return interpolation_error(touched, colors, scene, *where, is_affine=name == "affine")

    is_clipped = settings.clipping != "homogeneous"
    shares = {
        # One vertex's value is off by the whole range; of a cut triangle it is another vertex than the piece's.
        "flat": np.where(is_cut(touched), np.inf, 1.0),
        "affine": share_of_range(touched, is_clipped),
        "affine-n": share_of_range(touched, is_clipped, settings.correction_interval),
    }
    interpolation = choose("interpolation", {name: moved(name) for name in INTERPOLATIONS})
    return {"interpolation": interpolation, "texture_filter": found, "shading": shading}
