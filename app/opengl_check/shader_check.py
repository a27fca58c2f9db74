"""The family ``shaders`` of the comparison with OpenGL: small shaders, lane by lane."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.opengl_check.draw import OpenGLRenderer
from app.opengl_check.shader_cases import CASES, ShaderCase, shader_inputs
from app.opengl_check.shader_draw import draw_with_opengl, run_with_core
from core.records.arrays import Singles

SHADERS = "shaders"
"""Name of the family."""
SIDE = 32
"""Pixels each way of a case: the lanes of a shader."""


@dataclass(frozen=True, eq=False)
class ShaderResult:
    """How a shader's numbers compare."""

    equal: int
    """Numbers with the same bits."""
    count: int
    error: float
    """The largest difference."""
    excess: int
    """Numbers that differ by more than the case allows."""

    @property
    def agrees(self) -> bool:
        """Whether nothing differs by more."""
        return self.excess == 0


def compare_shader(case: ShaderCase, ours: Singles, theirs: Singles) -> ShaderResult:
    """Compare two results (side, side, 4) of a case; NaN equals NaN."""
    with np.errstate(invalid="ignore", over="ignore"):
        difference = np.abs(ours.astype(float) - theirs)
    same = (ours == theirs) | (np.isnan(ours) & np.isnan(theirs))
    difference[same] = 0
    allowed = case.absolute + case.relative * np.abs(theirs.astype(float))
    return ShaderResult(
        int(same.sum()),
        same.size,
        float(np.max(np.nan_to_num(difference, nan=np.inf))),
        int(np.count_nonzero(~(difference <= allowed))),
    )


def check_shaders(renderer: OpenGLRenderer, seed: int, write: Callable[[str], object]) -> bool:
    """Run all cases with OpenGL and with the core, write what differs, and return whether all agree."""
    a, b = shader_inputs(SIDE, seed)
    results = {
        case.name: compare_shader(case, run_with_core(case, a, b), draw_with_opengl(renderer, case, a, b))
        for case in CASES
    }
    equal, count = (sum(getattr(result, name) for result in results.values()) for name in ("equal", "count"))
    differing = [name for name, result in results.items() if not result.agrees]
    verdict = f"{len(differing)} shaders differ" if differing else "agrees"
    write(
        f"{'shaders':<14}{len(CASES):>6}{count:>12,} numbers, {equal / count:.2%} of them with the same bits  {verdict}"
    )
    for name in differing:
        result = results[name]
        write(f"    {name}: {result.excess} of {result.count} numbers differ, by up to {result.error:.1e}")
    return not differing
