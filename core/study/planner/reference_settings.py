"""The reference settings of a plan: the most accurate and most expensive method at every stage."""

from dataclasses import replace

from core.scene import AnyScene, Scene
from core.settings import Settings


def reference_settings(scene: AnyScene, base: Settings | None = None) -> Settings:
    """Return the settings of the reference picture.

    Parameters
    ----------
    base : Settings, optional
        What to draw, not how well: polygon mode, lines, wrapping, pixel centres; additive blending, culled fronts and
        pictures without light are such wishes too.

    Notes
    -----
    The reference is the picture of 16 samples a pixel, each of them lit and textured by itself. The mean of 256 samples
    is nearer to the truth (see ``core.antialiasing.measured``), but it is no method that could be chosen: at an
    edge of full contrast even 16 samples are sixteenths away from it, so no plan at all would be within 2/255.
    """
    wished = base or Settings()
    chosen = replace(
        wished,
        cull="none",
        clipping="sutherland-hodgman",
        coverage="snapped",
        fill_rule="shared-edge",
        fill="spans",
        interpolation="perspective",
        texture_filter="trilinear",
        visibility="z-buffer",
        depth="reversed-z" if is_perspective(scene) else "z-float32",
        blend="over",
        antialiasing="ssaa-16",
        resolve_filter="box",
    )
    is_lit = isinstance(scene, Scene) and wished.shading != "unlit"
    chosen = replace(chosen, shading="phong" if is_lit else "unlit")
    if wished.blend == "additive":
        chosen = replace(chosen, blend="additive")
    if wished.cull == "front":
        chosen = replace(chosen, cull="front")
    return chosen


def is_perspective(scene: AnyScene) -> bool:
    """Return whether depth can be kept reversed, by a projection of its own."""
    return not isinstance(scene, Scene) or scene.camera.projection == "perspective"
