"""Ray casting in its own loops: for every pixel its ray, for every ray all triangles, the nearest hit is kept.

It decides each hit as ``ray-casting`` does, so the picture is the same, bit for bit. What differs is the order of the
work: a pixel is accessed once and is finished when its ray is, but every triangle is asked again by every ray.

References
----------
A. Appel, *Some techniques for shading machine renderings of solids*, 1968.
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline", "graphics pipelines vs. raytracing": foreach pixel,
foreach object, access objects many times.
"""

from collections.abc import Callable, Iterable
from typing import TypeVar

import numpy as np

from core.methods import method
from core.records.arrays import Floats
from core.records.primitives import DrawingOrder
from core.records.steps import PIXEL_BY_PIXEL
from core.visibility.ray_casting import decide_hits

Pixel = TypeVar("Pixel")
Triangle = TypeVar("Triangle")


def cast_all_rays(
    pixels: Iterable[Pixel],
    triangles: Iterable[Triangle],
    meets: Callable[[Pixel, Triangle], bool],
    is_nearer: Callable[[Pixel, Triangle, Triangle], bool],
) -> dict[Pixel, Triangle | None]:
    """Listing of both loops: the triangle that is seen at each pixel."""
    seen: dict[Pixel, Triangle | None] = {}
    for pixel in pixels:
        nearest = None
        for triangle in triangles:  #: loops
            if not meets(pixel, triangle):  #: meets
                continue
            if nearest is None or is_nearer(pixel, triangle, nearest):
                nearest = triangle
        seen[pixel] = nearest
    return seen


@method(
    "visibility",
    "ray-casting-by-pixel",
    "Ray casting, pixel by pixel",
    source="Appel 1968; Pellacini, graphics pipelines vs. raytracing",
    exact_for="opaque triangles in any order: each hit is decided as in ray casting (exact)",
    breaks_where="large meshes: every ray asks every triangle; coplanar triangles: a tie keeps the first one drawn",
    takes=("depth_test_time",),
    listing=cast_all_rays,
    traits="exact",
)
def ray_casting_by_pixel(clip: Floats) -> DrawingOrder:
    """Take the triangles as given, for one ray after another."""
    return DrawingOrder(np.arange(len(clip)), True, decide_hits, PIXEL_BY_PIXEL, asks_all=True)
