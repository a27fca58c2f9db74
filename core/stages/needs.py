"""What methods need, in words, and which scenes do not have it: decided here for menus, errors and tests alike."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from core.methods import ReplacedName, table
from core.records.clip_region import is_convex, region_in_window
from core.records.words import nouns
from core.scene import AnyScene, ClipScene, Scene
from core.settings import FAMILIES, Settings, no_effect


def _parallel_rays(scene: AnyScene) -> str:
    is_parallel = isinstance(scene, Scene) and scene.camera.projection == "orthographic"
    return "1/w is constant for an orthographic one" if is_parallel else ""


def _polygon_as_window(scene: AnyScene) -> str:
    region = scene.clip_region if isinstance(scene, ClipScene) else None
    return "that of this scene is a polygon" if region is not None and region.ndim == 2 else ""


def _concave_window(scene: AnyScene) -> str:
    if not isinstance(scene, ClipScene) or scene.clip_region is None or scene.clip_region.ndim == 1:
        return ""
    if scene.region_rings is not None and len(scene.region_rings) > 1:
        return "that of this scene has holes"
    return (
        "" if is_convex(region_in_window(scene.clip_region, scene.size)) else "that of this scene is concave"
    )


def _no_triangles(scene: AnyScene) -> str:
    # Segments and points have no plane: nothing is cut, and they are drawn as given.
    return "" if 1 <= scene.corner_count <= 3 else f"this scene has {nouns(scene.corner_count).many}"


def _meeting_rings(scene: AnyScene) -> str:
    return _meeting_sides(scene) if isinstance(scene, ClipScene) and scene.rings is not None else ""


@lru_cache(maxsize=4)
def _meeting_sides(scene: ClipScene) -> str:
    # Only scenes of polygons wait for these.
    from core.clipping.rings import meeting_sides, whole_rings
    from core.stages.primitives import polygons_in_pixels, region_in_pixels
    from core.transform.vertex_stage import transform_vertices

    vertices, count = transform_vertices(scene), len(scene.clip)
    polygons = polygons_in_pixels(vertices, np.arange(count))
    found = [meeting_sides(whole_rings([polygons.rings_of(k)])[0][0], "polygon") for k in range(count)]
    found.append(meeting_sides(whole_rings([region_in_pixels(vertices, 0.5)])[0][0], "clip window"))
    return next(filter(None, found), "")


def _moved_by_projection(scene: AnyScene) -> str:
    is_moved = isinstance(scene, Scene) and not all(mesh.is_affine for mesh in scene.meshes)
    return "the matrix of a mesh of this scene is a projection itself" if is_moved else ""


MOST_RAYS = 1 << 29
"""Pixels times triangles that rays to the light may ask: some seconds."""


def _many_rays(scene: AnyScene) -> str:
    if not isinstance(scene, Scene):
        return ""
    triangles = sum(len(mesh.triangles) for mesh in scene.meshes)
    asked = scene.size[0] * scene.size[1] * triangles
    return f"this scene takes up to {asked:,}" if asked > MOST_RAYS else ""


@dataclass(frozen=True, eq=False)
class Need:
    """Something that a method needs of what it is given."""

    noun: str
    """What it is, as ``a perspective camera``."""
    lack: Callable[[AnyScene], str] | None = None
    """Why a scene does not have it; "": it has. ``None``: every scene has it, or a stage before provides it."""


NEEDS = {
    "positive-w": Need("all corners in front of the eye (w > 0), which clipping provides"),
    "projected": Need("corners divided by w"),
    "float64-edges": Need("edge functions in float64"),
    "mipmaps": Need("mipmaps of the texture"),
    "blending": Need("blending"),
    "triangles": Need("triangles to cut", _no_triangles),
    "perspective": Need("a perspective camera", _parallel_rays),
    "world-boxes": Need("meshes in world space, where w is 1", _moved_by_projection),
    "few-rays": Need(f"at most {MOST_RAYS:,} tests of a ray against a triangle", _many_rays),
    "rectangle": Need("a rectangle as clip window", _polygon_as_window),
    "convex-window": Need("a convex clip window", _concave_window),
    "simple-rings": Need("rings that do not cross or touch", _meeting_rings),
}
"""By its name in `core.methods.Method.needs`."""


def refusal(family: str, name: str, scene: AnyScene) -> str:
    """Return why a method cannot draw a scene, as ``needs a convex clip window: that of this scene has holes``."""
    for need in (NEEDS[each] for each in table.get(family, name).needs):
        reason = need.lack(scene) if need.lack is not None else ""
        if reason:
            return f"needs {need.noun}: {reason}"
    return ""


def check_needs(scene: AnyScene, settings: Settings) -> None:
    """Raise ValueError, with a sentence, for a chosen method that cannot draw the scene; the defaults draw any."""
    for family in FAMILIES:
        name = getattr(settings, family)
        if name == getattr(Settings, family) or no_effect(settings, family, scene):
            continue
        if reason := refusal(family, name, scene):
            raise ValueError(f"{family} {name} {reason}")


def check_edits(scene: AnyScene, settings: Settings) -> None:
    """Raise ValueError, with a sentence, for what would be passed over; before settings are `suited`.

    That is an edited listing that would not run, or the shaders of the scene.
    """
    if scene.program is not None and settings.antialiasing == "area":
        raise ValueError("exact areas run no shaders: choose several samples instead (antialiasing=ssaa-4)")
    for name in vars(settings).values():
        for edit in name.method.edits if isinstance(name, ReplacedName) else ():
            if reason := edit.passed_over(settings, scene):
                raise ValueError(f"{edit.title} would not run: {reason[0].lower()}{reason[1:].rstrip('.')}")
