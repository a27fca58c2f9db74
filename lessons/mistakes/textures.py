"""Mistakes of texture look-up: faulty runs, and wrong formulas of the level."""

from collections.abc import Callable
from dataclasses import replace
from math import log2

import numpy as np

from core import Settings, Texture
from core.fragments.textures import Footprint, bilinear, nearest
from core.records.arrays import Floats, Integers
from core.scene import ClipScene
from lessons.mistakes.coverage import in_window
from lessons.mistakes.transforms import Vector
from lessons.mistakes.twin import Case, Twin, WrongRule, frame_colors
from lessons.small_scenes import triangle_scene

Wrap = Callable[[Integers, int], Integers]
SIZE = (8, 4)


def strip(values: list[float], start: float = 0.0, end: float = 1.0) -> ClipScene:
    """Return one row of grey texels across the window, u from ``start`` at its left side to ``end`` at its right."""
    texels = np.repeat(np.array([values])[..., None], 3, axis=2)
    corners = np.array([[(0.0, -8.0), (16.0, 0.0), (0.0, 8.0)]])
    u = start + corners[..., 0] / SIZE[0] * (end - start)
    scene = triangle_scene(corners, SIZE, attributes=np.stack([u, np.full_like(u, 0.5)], axis=2))
    return replace(scene, texture=Texture(texels))


def looked_up(scene: ClipScene, **names: str) -> Case:
    """Return a case of which the colours are compared."""
    return Case(scene, Settings(**names), frame_colors)  # type: ignore[arg-type]


def bilinear_without_half(position: Floats, size: tuple[int, int], wrap: Wrap) -> Footprint:
    """Take u w for u w - 1/2."""
    return bilinear(position + 0.5, size, wrap)


def bilinear_half_added(position: Floats, size: tuple[int, int], wrap: Wrap) -> Footprint:
    """Take u w + 1/2 for u w - 1/2."""
    return bilinear(position + 1.0, size, wrap)


def nearest_of_one_less(position: Floats, size: tuple[int, int], wrap: Wrap) -> Footprint:
    """Take u (w - 1) for u w."""
    return nearest(position * ((np.array(size) - 1) / np.array(size))[:, None], size, wrap)


def nearest_rounded(position: Floats, size: tuple[int, int], wrap: Wrap) -> Footprint:
    """Round where u w is cut off."""
    return nearest(position + 0.5, size, wrap)


def repeat_mirrored(index: Integers, size: int) -> Integers:
    """Take the remainder of the size alone, without the sign: u - int(u)."""
    return np.where(index < 0, -index - 1, index) % size


def mip_level(texels: int, uv_step: float) -> Vector:
    """Return the level for a step in u from pixel to pixel: log2 of the texels per pixel, at least 0."""
    return (max(0.0, log2(texels * uv_step)),)


RAMP = strip([0.0, 0.25, 0.5, 0.75])
EVEN = strip([0.5, 0.5, 0.5, 0.5])


def filtered(name: str, sentence: str, rule: Callable[..., Footprint], texture_filter: str) -> Twin:
    """Return a twin with another texture filter."""
    return Twin(
        name,
        sentence,
        looked_up(RAMP, texture_filter=texture_filter, wrap="clamp"),
        looked_up(EVEN, texture_filter=texture_filter, wrap="clamp"),
        change_settings=lambda settings: replace(settings, texture_filter=texture_filter).replaced(
            texture_filter=rule
        ),
    )


TWINS = (
    filtered(
        "half-texel-missing",
        "The texture is shifted by half a texel. Texel i has its centre at i + 1/2, so u w - 1/2 counts from it.",
        bilinear_without_half,
        "bilinear",
    ),
    filtered(
        "half-texel-added",
        "The texture is shifted by a whole texel: 1/2 was added where it is subtracted.",
        bilinear_half_added,
        "bilinear",
    ),
    filtered(
        "texels-of-one-less",
        "u was multiplied by w - 1. Texel i is floor(u w), so that all are equally wide.",
        nearest_of_one_less,
        "nearest",
    ),
    filtered(
        "texel-rounded",
        "u w was rounded. Texel i is floor(u w): it reaches from i to i + 1.",
        nearest_rounded,
        "nearest",
    ),
    Twin(
        "negative-repeat",
        "Below 0 the texture is mirrored: u - int(u) is not u - floor(u) there.",
        looked_up(strip([0.0, 0.25, 0.5, 0.75], -1.0, 1.0), texture_filter="nearest"),
        looked_up(RAMP, texture_filter="nearest"),
        change_settings=lambda settings: settings.replaced(wrap=repeat_mirrored),
    ),
    Twin(
        "border-repeated",
        "At the border the opposite side bleeds in. Clamp repeats the border texel.",
        looked_up(RAMP, wrap="clamp"),
        looked_up(RAMP, wrap="clamp", texture_filter="nearest"),
        change_settings=lambda settings: replace(settings, wrap="repeat"),
    ),
    Twin(
        "window-for-uv",
        "The texture was looked up with the place in the window. It is glued on by u and v.",
        looked_up(strip([0.0, 0.25, 0.5, 0.75], 0.0, 2.0)),
        looked_up(EVEN),
        change_scene=lambda scene: replace(scene, attributes=in_window(scene) / np.array(scene.size)),
    ),
)

RULES = (
    WrongRule(
        "level-without-size",
        "The step in u was not multiplied by the size of the texture: the level counts texels per pixel.",
        mip_level,
        lambda _texels, uv_step: (log2(uv_step),),
        (64, 1 / 16),
        (1, 2.0),
    ),
    WrongRule(
        "level-of-area",
        "The level was taken from the area, which doubles it. It is log2 of the longer side.",
        mip_level,
        lambda texels, uv_step: (max(0.0, 2 * log2(texels * uv_step)),),
        (64, 1 / 32),
        (64, 1 / 64),
    ),
)
