"""Why each method was chosen, a sentence with the numbers."""

from math import acos, pi

import numpy as np

from core.arrays import Flags
from core.scene import AnyScene, Scene
from core.settings import Settings
from core.study.planner.color_ranges import ColorRanges, materials, normal_cones, w_ratio
from core.study.planner.records import Tolerance
from core.study.planner.surface_choice import SurfaceChoice
from core.study.planner.texture_ranges import step_text
from core.study.planner.touched import Touched
from core.study.planner.value_choice import ValueChoice


def counted(count: int, noun: str) -> str:
    """Return ``1 pixel`` or ``12 pixels``."""
    return f"{count:,} {noun}" if count == 1 else f"{count:,} {noun}s"


def bound(error: float) -> str:
    """Return a bound as text: ``0.82/255``."""
    return f"{error:.3g}/255"


def surface_reasons(
    surface: SurfaceChoice, everything: Settings, chosen: Settings, tolerance: Tolerance
) -> dict[str, str]:
    """Return the reasons of the stages that decide what is seen where, by family."""
    shared = f"with one sample a pixel what can be seen in a pixel differs by {bound(surface.error)} at most"
    if surface.pixels:
        shared += f", but for {counted(surface.pixels, 'pixel')}"
    reasons = {
        "cull": _cull_reason(surface, everything, chosen, shared),
        "clipping": _clipping_reason(surface, chosen, shared),
        "visibility": _visibility_reason(surface, chosen),
        "depth": _depth_reason(surface, chosen, shared),
        "blend": _blend_reason(surface, chosen),
        "antialiasing": _samples_reason(surface, everything, tolerance, shared),
    }
    for family, method in surface.slower:
        reasons[family] += f" {method} would do, but takes longer here."
    return reasons


def _samples_reason(surface: SurfaceChoice, everything: Settings, tolerance: Tolerance, shared: str) -> str:
    if surface.by_widths:
        return f"{shared[0].upper()}{shared[1:]}: one is enough."
    width = float(surface.surfaces.width.max(initial=0.0))
    beyond = (
        f"In {counted(surface.beyond, 'pixel')} what can be seen differs by more than {tolerance.bytes}/255, "
        f"by up to {bound(width)}"
    )
    name = surface.settings.antialiasing
    rejected = "; ".join(
        f"{other} is beyond {tolerance.bytes}/255 in {counted(error.beyond, 'pixel')} at least"
        for other, error in surface.rejected
    )
    if name != everything.antialiasing:
        but = f", but for {counted(surface.sample_pixels, 'pixel')}" if surface.sample_pixels else ""
        text = f"{beyond}, but by what its samples cover {name} is {bound(surface.error)} off at most{but}"
    else:
        text = f"{beyond}: edges and details need their samples"
    return f"{text}; {rejected}." if rejected else f"{text}."


def _cull_reason(surface: SurfaceChoice, everything: Settings, chosen: Settings, shared: str) -> str:
    if everything.cull != "none":
        return "Which faces are left out was a wish."
    seen = counted(surface.back_pixels, "pixel")
    if not surface.back_pixels and surface.cull_pixels == 0:
        return "Every back face lies behind fronts at every sample: none is seen."
    if chosen.cull == "none":
        return f"Back faces may be seen in {seen}, so they stay."
    if surface.by_widths:
        return f"Back faces may be seen in {seen}, but {shared}."
    return f"Back faces may be seen in no more than {seen}, and so many may differ."


def _clipping_reason(surface: SurfaceChoice, chosen: Settings, shared: str) -> str:
    if not surface.cut:
        return "No triangle crosses a plane of the view volume: there is nothing to clip."
    pieces = f"{counted(surface.cut, 'piece')} of triangles cross a plane of the view volume"
    if chosen.clipping == "homogeneous":
        return f"{pieces}, homogeneous rasterization draws them without clipping, and {shared}."
    if surface.by_widths:
        return f"{pieces}; homogeneous rasterization could draw them without clipping, as {shared}."
    return f"{pieces}, and clipping snaps new corners: without it samples at their edges might change."


def _visibility_reason(surface: SurfaceChoice, chosen: Settings) -> str:
    if surface.is_once:
        drawn = "fronts wind once around what they cover, as those of a convex mesh do"
        way = drawn if chosen.cull == "back" else "the triangles wind once around what they cover"
        return f"Every sample is covered by one triangle at most: the {way.removeprefix('the ')}."
    if chosen.visibility == "last-drawn":
        return "No two triangles overlap but with the nearer one drawn later: no depth buffer is needed."
    if chosen.visibility == "painters":
        return "Sorted by distance, whatever overlaps is drawn from far to near: no depth buffer is needed."
    if surface.cut and chosen.clipping == "homogeneous":
        return (
            "Triangles are drawn that reach beyond the view volume, and only what lies within was looked at: the depth "
            "buffer stays."
        )
    if surface.doubtful:
        return (
            f"In {counted(surface.doubtful, 'pixel')} triangles overlap that are not drawn from far to near."
        )
    return "No two triangles overlap but with the nearer one drawn later."


def _depth_reason(surface: SurfaceChoice, chosen: Settings, shared: str) -> str:
    if chosen.visibility != "z-buffer":
        return "No depth buffer is used, so its format does not matter."
    if surface.by_widths:
        return f"{shared[0].upper()}{shared[1:]}, whichever is drawn of what its steps cannot tell apart."
    apart = "1.5/65,535 of the depth range"
    if surface.coarse == 0:
        return f"Wherever surfaces of different colours overlap, they are more than {apart} apart."
    return f"In {counted(surface.coarse, 'pixel')} surfaces overlap that are no more than {apart} apart."


def _blend_reason(surface: SurfaceChoice, chosen: Settings) -> str:
    if chosen.blend == "additive":
        return "Light that adds up was a wish."
    if surface.translucent:
        return "Some alpha is below 1: what is behind shines through."
    return "Every alpha is 1: nothing shines through."


def value_reasons(
    values: dict[str, ValueChoice],
    surface: SurfaceChoice,
    touched: Touched,
    colors: ColorRanges,
    scene: AnyScene,
) -> dict[str, str]:
    """Return the reasons of interpolation, texture filter and shading, by family."""
    seen = surface.surfaces.is_candidate
    ratio = float(w_ratio(touched)[np.unique(touched.primitive[seen])].max(initial=1.0))
    lod = float(colors.lod[seen].max(initial=-np.inf)) - float(np.log2(surface.pattern.side))
    texture = "There is no texture to be filtered"
    if "uv" in touched.geometry.primitives.layout:
        texture = (
            f"A step of one sample is {step_text(lod)}" if np.isfinite(lod) else "Some steps are endless"
        )
    return {
        "interpolation": _bounded(
            f"w differs by a factor of {ratio:.4g} at most in a triangle", values["interpolation"]
        ),
        "texture_filter": _bounded(texture, values["texture_filter"]),
        "shading": _bounded(_light_text(touched, scene, seen), values["shading"]),
    }


def _light_text(touched: Touched, scene: AnyScene, seen: Flags) -> str:
    """Return how far normals turn, and how narrow highlights are."""
    if "normal" not in touched.geometry.primitives.layout or not isinstance(scene, Scene):
        return "Nothing is lit"
    if not seen.any():
        return "Nothing that is lit is in view"
    primitive = np.unique(touched.primitive[seen])
    turned = np.degrees(normal_cones(touched).radius[primitive].max())
    text = f"Normals turn by up to {turned:.3g} degrees from the middle of a triangle"
    material = materials(scene, touched.geometry.primitives.mesh[primitive])
    is_shiny = material.specular > 0
    if not is_shiny.any():
        return f"{text}, and nothing has highlights"
    half = np.degrees(half_width(float(material.shininess[is_shiny].max())))
    return f"{text}, and a highlight falls to half within {half:.3g} degrees"


def half_width(shininess: float) -> float:
    """Return the angle, in radians, at which a highlight has half its light: cos(angle)^shininess = 1/2."""
    return acos(0.5 ** (1 / shininess)) if shininess > 0 else pi / 2


def _bounded(start: str, value: ValueChoice) -> str:
    rejected = [f"{name} may be {bound(error)} off" for name, error in value.rejected if error < UNBOUNDED]
    unknown = [name for name, error in value.rejected if error >= UNBOUNDED]
    if unknown:
        rejected.append(f"of {' and '.join(unknown)} no bound is known here")
    rejected += [f"{name} would do, but takes longer here" for name in value.slower]
    text = (
        f"{start}: {value.chosen} is {bound(value.error)} off at most"
        if value.error
        else f"{start}: {value.chosen}"
    )
    if not value.error and value.chosen not in ("perspective", "trilinear", "phong"):
        text += " is not off at all"
    return f"{text}{', but ' + '; '.join(rejected) if rejected else ''}."


UNBOUNDED = 254.5
"""1/255: a bound from here on is that a byte is a byte."""
