"""Why each method was chosen, a sentence with the numbers."""

import numpy as np

from core.settings import Settings
from core.study.planner.color_ranges import ColorRanges, w_ratio
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
    with_one = surface.side == 1
    shared = f"with one sample a pixel what can be seen in a pixel differs by {bound(surface.error)} at most"
    if surface.pixels:
        shared += f", but for {counted(surface.pixels, 'pixel')}"
    width = float(surface.surfaces.width.max(initial=0.0))
    return {
        "cull": _cull_reason(surface, everything, chosen, shared),
        "clipping": _clipping_reason(surface, chosen, shared),
        "visibility": _visibility_reason(surface, chosen),
        "depth": _depth_reason(surface, chosen, shared),
        "blend": _blend_reason(surface, chosen),
        "antialiasing": (
            f"{shared[0].upper()}{shared[1:]}: one is enough."
            if with_one
            else f"In {counted(surface.beyond, 'pixel')} what can be seen differs by more than {tolerance.bytes}/255, "
            f"by up to {bound(width)}: edges and details need their samples."
        ),
    }


def _cull_reason(surface: SurfaceChoice, everything: Settings, chosen: Settings, shared: str) -> str:
    if everything.cull != "none":
        return "Which faces are left out was a wish."
    seen = counted(surface.back_pixels, "pixel")
    if chosen.cull == "none":
        return f"Back faces may be seen in {seen}, so they stay."
    if surface.back_pixels and surface.side == 1:
        return f"Back faces may be seen in {seen}, but {shared}."
    if surface.back_pixels:
        return f"Back faces may be seen in no more than {seen}, and so many may differ."
    return "Every back face lies behind fronts at every sample: none is seen."


def _clipping_reason(surface: SurfaceChoice, chosen: Settings, shared: str) -> str:
    if not surface.cut:
        return "No triangle crosses a plane of the view volume: there is nothing to clip."
    pieces = f"{counted(surface.cut, 'piece')} of triangles cross a plane of the view volume"
    if chosen.clipping == "homogeneous":
        return f"{pieces}, homogeneous rasterization draws them without clipping, and {shared}."
    return f"{pieces}, and clipping snaps new corners: without it samples at their edges might change."


def _visibility_reason(surface: SurfaceChoice, chosen: Settings) -> str:
    if chosen.visibility == "last-drawn":
        return "No two triangles overlap but with the nearer one drawn later: no depth buffer is needed."
    if chosen.visibility == "painters":
        return "Sorted by distance, whatever overlaps is drawn from far to near: no depth buffer is needed."
    if surface.cut:
        return "Triangles are cut at the view volume, so that their order was not looked into: the depth buffer stays."
    return f"In {counted(surface.doubtful, 'pixel')} triangles overlap that are not drawn from far to near."


def _depth_reason(surface: SurfaceChoice, chosen: Settings, shared: str) -> str:
    if chosen.visibility != "z-buffer":
        return "No depth buffer is used, so its format does not matter."
    if surface.side == 1:
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
    values: dict[str, ValueChoice], surface: SurfaceChoice, touched: Touched, colors: ColorRanges
) -> dict[str, str]:
    """Return the reasons of interpolation, texture filter and shading, by family."""
    seen = surface.surfaces.is_candidate
    ratio = float(w_ratio(touched)[np.unique(touched.primitive[seen])].max(initial=1.0))
    lod = float(colors.lod[seen].max(initial=-np.inf)) - float(np.log2(surface.side))
    texture = "There is no texture to be filtered"
    if "uv" in touched.geometry.primitives.layout:
        texture = (
            f"A step of one sample is {step_text(lod)}" if np.isfinite(lod) else "Some steps are endless"
        )
    lit = "normal" in touched.geometry.primitives.layout
    return {
        "interpolation": _bounded(
            f"w differs by a factor of {ratio:.4g} at most in a triangle", values["interpolation"]
        ),
        "texture_filter": _bounded(texture, values["texture_filter"]),
        "shading": _bounded(
            "Normals and highlights were bounded by cones" if lit else "Nothing is lit", values["shading"]
        ),
    }


def _bounded(start: str, value: ValueChoice) -> str:
    rejected = "; ".join(f"{name} may be {bound(error)} off" for name, error in value.rejected)
    text = (
        f"{start}: {value.chosen} is {bound(value.error)} off at most"
        if value.error
        else f"{start}: {value.chosen}"
    )
    if not value.error and value.chosen not in ("perspective", "trilinear", "phong"):
        text += " is not off at all"
    return f"{text}{', but ' + rejected if rejected else ''}."
