"""What is said of mipmaps: slopes, level of detail, the levels and their mix: one sentence for every key."""

import math
from collections.abc import Callable, Mapping

from core.explain.number_text import joined, spoken, vector_text
from core.explain.sentences.raster import pixel_name
from core.explain.step_values import TEXEL_NAMES, StepValues


def slopes(step: StepValues) -> str:
    """How u and v change from pixel to pixel."""
    values = step.vector("uv_slopes")
    right, up = vector_text(values[:2]), vector_text(values[2:])
    if step.has("length"):
        along = up if step.flag("is_steep") else right
        return f"{pixel_name(step)}: with every pixel along the line (u, v) change by {along}, across it they do not."
    if not step.has("slope_n"):
        return (
            f"{pixel_name(step)}: u and v are those of one corner everywhere, so they change neither to the right "
            "nor upwards."
        )
    return f"{pixel_name(step)}: with a pixel to the right (u, v) change by {right}, with one up by {up}."


def level_of_detail(step: StepValues) -> str:
    """The lengths in texels, and the logarithm of the longer one."""
    right, up = step.vector("lengths")
    lod = step.number("lod")
    text = f"{pixel_name(step)}: counted in texels a pixel to the right is {spoken(right)} long and one up {spoken(up)}"
    if math.isnan(lod):
        return f"{text}, so the level of detail λ is NaN, and level 0 will do."
    if lod == -math.inf:
        return f"{text}, so the level of detail λ is −∞: the place stays the same."
    longer = f"{text}, and the logarithm of the longer one is the level of detail, λ = {spoken(lod)}"
    return f"{longer}: a pixel is no larger than a texel." if lod <= 0 else f"{longer}."


def _level_name(step: StepValues, place: int) -> str:
    number = spoken(step.vector("levels")[place])
    width, height = step.vector("level_sizes")[2 * place : 2 * place + 2]
    return f"level {number} of {spoken(width)} × {spoken(height)} texels"


def levels(step: StepValues) -> str:
    """Which levels are read."""
    lod, share = step.number("lod"), step.number("level_fraction")
    near, far = step.vector("levels")
    name = _level_name(step, 0)
    if not lod > 0:
        return (
            f"{pixel_name(step)}: nothing is made smaller here, so {name} is read alone, the texture itself."
        )
    if lod > step.number("level"):
        return f"{pixel_name(step)}: λ is beyond the last level, so {name} is read."
    if not step.has("far_color"):
        return f"{pixel_name(step)}: the nearest to λ = {spoken(lod)} is {name}."
    if share == 0 or near == far:
        return f"{pixel_name(step)}: λ = {spoken(lod)} is {name} exactly."
    return (
        f"{pixel_name(step)}: λ = {spoken(lod)} is between {name} and {_level_name(step, 1)}, "
        f"and the second one's share is {spoken(share)}."
    )


def _level_color(step: StepValues, which: str) -> str:
    """What bilinear filtering gives in one of the levels."""
    number = spoken(step.vector("levels")[0 if which == "near" else 1])
    place, color = (vector_text(step.vector(f"{which}_{name}")) for name in ("position", "color"))
    shares = step.vector(f"{which}_shares")
    listed = joined([f"{spoken(share)} ({TEXEL_NAMES[k]})" for k, share in enumerate(shares)])
    return (
        f"{pixel_name(step)}: in level {number} the place is {place}, and the four texels around it give {color}, "
        f"with the shares {listed}."
    )


def near(step: StepValues) -> str:
    """The colour in the finer level."""
    return _level_color(step, "near")


def far(step: StepValues) -> str:
    """The colour in the coarser level."""
    return _level_color(step, "far")


def mix(step: StepValues) -> str:
    """The mix of both levels."""
    share, color = step.number("level_fraction"), vector_text(step.vector("texture_color"))
    first, second = (spoken(number) for number in step.vector("levels"))
    if share == 0:
        return f"{pixel_name(step)}: the texture's colour is {color}, that of level {first} alone."
    return (
        f"{pixel_name(step)}: the texture's colour is {color}, {spoken(1 - share)} of level {first} and "
        f"{spoken(share)} of level {second}."
    )


_OPERATIONS: Mapping[str, Callable[[StepValues], str]] = {
    "slopes": slopes,
    "lod": level_of_detail,
    "levels": levels,
    "near": near,
    "far": far,
    "mix": mix,
}

SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    f"shade.{kind}.{name}": say for kind in ("textured", "textured-lit") for name, say in _OPERATIONS.items()
}
