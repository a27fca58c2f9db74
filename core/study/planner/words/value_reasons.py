"""Why each method was chosen of what decides how a surface is coloured: sentences with the numbers."""

from math import acos, pi

import numpy as np

from core.records.arrays import Flags
from core.scene import AnyScene, Scene
from core.study.planner.bounds.color_ranges import ColorRanges, materials, normal_cones, w_ratio
from core.study.planner.choices.surface_choice import SurfaceChoice
from core.study.planner.choices.value_choice import ValueChoice
from core.study.planner.scene_analysis.conservative_coverage import Touched
from core.study.planner.words.phrases import bound, capitalized, counted, figure, listed, phrase

USELESS = 128
"""1/255: a bound from here on says next to nothing."""
NO_TEXTURE = "There is no texture in view, so any filter does."
NOT_LIT = "Nothing is lit, so there is nothing to shade."
NONE_LIT = "Nothing that is lit is in view, so any shading does."
IDLE = (NO_TEXTURE, NOT_LIT, NONE_LIT)
"""Facts that say all."""


def value_reasons(
    values: dict[str, ValueChoice],
    surface: SurfaceChoice,
    touched: Touched,
    colors: ColorRanges,
    scene: AnyScene,
) -> dict[str, str]:
    """Return the reasons of interpolation, texture filter and shading, by family."""
    seen = surface.surfaces.is_candidate
    facts = {
        "interpolation": _w_text(touched, colors, seen, surface.pattern.side),
        "texture_filter": _texel_text(touched, colors, seen, surface.pattern.side),
        "shading": _light_text(touched, scene, seen),
    }
    return {family: _reason(family, fact, values[family]) for family, fact in facts.items()}


def _reason(family: str, fact: str, value: ValueChoice) -> str:
    """Return a fact, what the choice does at most, and why nothing cheaper was chosen."""
    chosen = capitalized(phrase(family, value.chosen))
    parts = [fact]
    if not value.is_dearest and fact not in IDLE:
        parts.append(
            f"{chosen} is off by {bound(value.error)} at most."
            if value.error
            else f"{chosen} makes no difference."
        )
    elif value.is_dearest and value.rejected:
        parts.append(f"{chosen} stays.")
    known = [(name, error) for name, error in value.rejected if error < USELESS]
    unknown = [phrase(family, name) for name, error in value.rejected if error >= USELESS]
    if known:
        numbers = listed([f"{phrase(family, name)} ({bound(error)})" for name, error in known])
        kind = "bound of {} is" if len(known) == 1 else "bounds of {} are"
        parts.append(f"With {bound(value.allowed)} left, the {kind.format(numbers)} too large.")
    if unknown:
        parts.append(f"For {listed(unknown)} no useful bound is known.")
    if value.slower:
        slower = capitalized(listed([phrase(family, name) for name in value.slower]))
        parts.append(f"{slower} would do, but {'take' if len(value.slower) > 1 else 'takes'} longer here.")
    return " ".join(parts)


def _w_text(touched: Touched, colors: ColorRanges, seen: Flags, side: int) -> str:
    ratio = float(w_ratio(touched)[np.unique(touched.primitive[seen])].max(initial=1.0))
    if ratio - 1 < EVEN:
        return "Within every triangle w is the same."
    text = f"Within a triangle w changes by a factor of {ratio:.4g} at most"
    if (colors.lod[seen] > np.log2(side)).any():
        return f"{text}, but where a texture is made smaller its level of detail may change too."
    return f"{text}."


EVEN = 1e-9
"""Ratios of w no farther from 1 are 1, but for rounding."""


def _texel_text(touched: Touched, colors: ColorRanges, seen: Flags, side: int) -> str:
    """Return whether textures are made smaller, and where."""
    if "uv" not in touched.geometry.primitives.layout or not np.isfinite(colors.lod[seen]).any():
        return NO_TEXTURE
    level = colors.lod - np.log2(side)
    smaller = len(np.unique(touched.pixel[seen & (level > 0)]))
    if smaller:
        where = f"In {counted(smaller, 'pixel')} a step from sample to sample may be longer than a texel"
        return f"{where}, so the texture is made smaller there."
    longest = figure(2.0 ** float(level[seen].max()))
    return (
        f"A step from sample to sample is {longest} texels at most, so the texture is nowhere made smaller."
    )


def _light_text(touched: Touched, scene: AnyScene, seen: Flags) -> str:
    """Return how far normals turn, and how narrow highlights are."""
    if "normal" not in touched.geometry.primitives.layout or not isinstance(scene, Scene):
        return NOT_LIT
    if not seen.any():
        return NONE_LIT
    primitive = np.unique(touched.primitive[seen])
    turned = float(np.degrees(normal_cones(touched).radius[primitive].max()))
    text = f"Within a triangle normals lean up to {figure(turned)} degrees from their mean"
    if turned < FLAT:
        text = "Within every triangle the normals are the same"
    material = materials(scene, touched.geometry.primitives.mesh[primitive])
    is_shiny = material.specular > 0
    if not is_shiny.any():
        return f"{text}, and nothing has highlights."
    half = float(np.degrees(half_width(float(material.shininess[is_shiny].max()))))
    return f"{text}, and a highlight falls to half its light within {figure(half)} degrees."


FLAT = 1e-5
"""Degrees by which normals that are the same may differ, for rounding."""


def half_width(shininess: float) -> float:
    """Return the angle, in radians, at which a highlight has half its light: cos(angle)^shininess = 1/2."""
    return acos(0.5 ** (1 / shininess)) if shininess > 0 else pi / 2
