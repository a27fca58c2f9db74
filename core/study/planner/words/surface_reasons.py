"""Why each method was chosen of what decides which surface is seen where: sentences with the numbers."""

from core.settings import Settings
from core.study.planner.choices.surface_choice import SurfaceChoice
from core.study.planner.records import Tolerance
from core.study.planner.words.phrases import bound, capitalized, counted, listed, phrase

STEPS = "1.5 of its 65,535 steps"
"""How close two depths must be for 16 bits to take one for the other."""
NOT_TRIED = (
    "Not tried: exact areas, which take 0.8 to 60 times as long as 4 x 4 samples, and 3 x 3 samples, which are hardly "
    "ever near enough where 2 x 2 are not."
)


def surface_reasons(
    surface: SurfaceChoice, everything: Settings, chosen: Settings, tolerance: Tolerance
) -> dict[str, str]:
    """Return the reasons of the stages that decide what is seen where, by family."""
    shared = f"the colours that can be seen in a pixel differ by {bound(surface.error)} at most"
    if surface.error == 0:
        shared = "all that can be seen in a pixel has the same colour"
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
        reasons[family] += f" {capitalized(phrase(family, method))} would do, but takes longer here."
    return reasons


def _samples_reason(surface: SurfaceChoice, everything: Settings, tolerance: Tolerance, shared: str) -> str:
    if surface.by_widths:
        return f"{capitalized(shared)}, so one sample is enough."
    width = float(surface.surfaces.width.max(initial=0.0))
    meets = (
        f"In {counted(surface.beyond, 'pixel')} what can be seen differs by more than {tolerance.bytes}/255, by up to "
        f"{bound(width)}"
    )
    name = surface.settings.antialiasing
    if name != everything.antialiasing:
        but = f", but for {counted(surface.sample_pixels, 'pixel')}" if surface.sample_pixels else ""
        return (
            f"{meets}. What is seen at every sample was worked out there: {phrase('antialiasing', name)} is off by "
            f"{bound(surface.error)} at most{but}.{_rejected(surface, tolerance)}"
        )
    return f"{meets}, so 4 x 4 samples stay.{_rejected(surface, tolerance)} {NOT_TRIED}"


def _rejected(surface: SurfaceChoice, tolerance: Tolerance) -> str:
    """Return which fewer samples are too far off, and in how many pixels."""
    if not surface.rejected:
        return ""
    names = listed([phrase("antialiasing", name) for name, _ in surface.rejected])
    least = min(error.beyond for _, error in surface.rejected)
    each = " each" if len(surface.rejected) > 1 else ""
    allowed = f"{tolerance.pixels:,} may be" if tolerance.pixels else "none may be"
    return (
        f" {capitalized(names)} could be too far off in {counted(least, 'pixel')} or more{each}; {allowed}."
    )


def _cull_reason(surface: SurfaceChoice, everything: Settings, chosen: Settings, shared: str) -> str:
    if everything.cull != "none":
        return "Leaving out front faces was asked for."
    seen = counted(surface.back_pixels, "pixel")
    if not surface.back_pixels and surface.cull_pixels == 0:
        return "No back face is seen at any sample: there are none in view, or fronts hide them."
    if chosen.cull == "none":
        return f"Back faces may be seen in {seen}, so they are drawn."
    if surface.by_widths:
        return f"Back faces may be seen in {seen}, but {shared}."
    return f"Back faces may be seen in {seen} at most, and so many may differ."


def _clipping_reason(surface: SurfaceChoice, chosen: Settings, shared: str) -> str:
    if not surface.cut:
        return "No triangle crosses a plane of the view volume: there is nothing to clip."
    pieces = f"Triangles cross planes of the view volume (clipped, they are {counted(surface.cut, 'piece')})"
    if chosen.clipping == "homogeneous":
        return f"{pieces}. Homogeneous rasterization draws them without clipping, and {shared}."
    if surface.by_widths:
        return f"{pieces}. Homogeneous rasterization could draw them without clipping, as {shared}."
    return f"{pieces}, and clipping snaps new corners: without it samples at their edges might change."


def _visibility_reason(surface: SurfaceChoice, chosen: Settings) -> str:
    if surface.is_once:
        drawn = "fronts" if chosen.cull == "back" else "triangles"
        way = f"{drawn} wind once around what they cover, as those of a convex mesh do"
        return f"Every sample is covered by one triangle at most ({way}): depth need not be compared."
    if chosen.visibility == "last-drawn":
        return "Wherever triangles overlap, the nearer one is drawn later: depth need not be compared."
    if chosen.visibility == "painters":
        return "Sorted by distance, whatever overlaps is drawn from far to near: depth need not be compared."
    if surface.cut and chosen.clipping == "homogeneous":
        return (
            "Triangles are drawn that reach beyond the view volume, and only what lies within was looked at, so depth "
            "is compared."
        )
    if surface.doubtful:
        return (
            f"In {counted(surface.doubtful, 'pixel')} triangles overlap that are not drawn from far to near, so depth "
            "is compared."
        )
    return "Wherever triangles overlap, the nearer one is drawn later."


def _depth_reason(surface: SurfaceChoice, chosen: Settings, shared: str) -> str:
    if chosen.visibility != "z-buffer":
        return "Depth is not compared, so its format does not matter."
    if surface.by_widths:
        return f"{capitalized(shared)}, whichever is drawn of what its steps cannot tell apart."
    if surface.coarse == 0:
        return f"Where surfaces of different colours overlap, 16 bits tell them apart: they differ by {STEPS} or more."
    close = f"In {counted(surface.coarse, 'pixel')} surfaces overlap that 16 bits may not tell apart ({STEPS} or less)"
    if chosen.depth == "z-16":
        return f"{close}, and so many may differ."
    if chosen.depth in COARSE:
        return f"{close}; {phrase('depth', chosen.depth)} tells them apart."
    return f"{close}, and coarser formats would not do."


COARSE = ("z-24", "z-float32")
"""Formats that a plan may choose where 16 bits are too few."""


def _blend_reason(surface: SurfaceChoice, chosen: Settings) -> str:
    if chosen.blend == "additive":
        return "Light that adds up was asked for."
    if surface.translucent:
        return "Some alpha is below 1: what is behind shines through."
    return "Every alpha is 1: nothing shines through."
