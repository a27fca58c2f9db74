"""Mistakes with normals and light, and with texture look-up: faulty runs, and wrong formulas."""

from collections.abc import Callable
from dataclasses import replace
from math import log2, sqrt
from typing import Any

import numpy as np

from core import Settings, Texture
from core.records.arrays import Floats, Integers
from core.scene import ClipScene
from core.textures.look_up import Footprint, bilinear, nearest
from lessons.mistakes.transforms import Matrix, Vector, dot, image, shifted
from lessons.mistakes.twin import Case, Twin, frame_colors, in_window, wrong_rule
from lessons.small_scenes import triangle_scene

# Mistakes with normals and light, as wrong formulas.


def unit(vector: Vector) -> Vector:
    """Return a vector at length 1."""
    length = sqrt(dot(vector, vector))
    return tuple(float(c) / length for c in vector)


def normal_in_world(scale: Vector, shift: Vector, normal: Vector) -> Vector:
    """Return the unit normal after scaling by ``scale`` and moving by ``shift``: M^-T N."""
    return unit(tuple(n / s for n, s in zip(normal, scale, strict=True)))


def normal_in_camera(model_view: Matrix, focal: Vector, normal: Vector) -> Vector:
    """Return the normal by the normal matrix of V M, a rotation here."""
    return unit(image(model_view, normal))


def diffuse(ambient: float, normal: Vector, to_light: Vector) -> Vector:
    """Return ambient + (1 - ambient) max(0, N . L), with unit vectors."""
    return (ambient + (1 - ambient) * max(0.0, dot(unit(normal), unit(to_light))),)


def between_normals(first: Vector, second: Vector, t: Any, to_light: Vector) -> Vector:
    """Return N . L with the unit normal between two others."""
    mixed = tuple((1 - t) * a + t * b for a, b in zip(first, second, strict=True))
    return (dot(unit(mixed), unit(to_light)),)


def highlight(normal: Vector, to_light: Vector, to_eye: Vector, shininess: int) -> Vector:
    """Return max(0, N . H)^s of Blinn and Phong."""
    half = unit(shifted(unit(to_light), unit(to_eye)))
    return (max(0.0, dot(unit(normal), half)) ** shininess,)


def light_byte(ambient: Any, diffuse_light: Any) -> Vector:
    """Return the byte of a sum of lights, up to 255."""
    return (min(255, int(255 * (ambient + diffuse_light) + 0.5)),)


def lightings_by_fragment(triangles: int, vertices: int, fragments: int) -> Vector:
    """Return how often flat, Gouraud and Phong shading evaluate the light."""
    return triangles, vertices, fragments


SLOPE = ((2, 1, 1), (0, 0, 0), (1, 1, 0))
ROUND = ((1, 1, 1), (0, 0, 0), (1, 1, 0))
TURN = ((0.6, 0.0, -0.8), (0.0, 1.0, 0.0), (0.8, 0.0, 0.6))
FACING = (0.25, (0, 0, 1), (0, 0, 2))
SHINE = ((0, 0, 1), (3, 0, 4), (-4, 0, 3), 4)
STRAIGHT = ((0, 0, 1), (0, 0, 1), (0, 0, 1), 4)


# Mistakes of texture look-up: faulty runs, and wrong formulas of the level.


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


@wrong_rule(normal_in_world, shows=SLOPE, hides=ROUND)
def normal_as_position(scale: Vector, shift: Vector, normal: Vector) -> Vector:
    """The normal was transformed by M. It goes with the transposed inverse of M."""
    return unit(tuple(n * s for n, s in zip(normal, scale, strict=True)))


@wrong_rule(normal_in_world, shows=SLOPE, hides=ROUND)
def normal_untransformed(scale: Vector, shift: Vector, normal: Vector) -> Vector:
    """The normal was left in object space. It turns with the object."""
    return unit(normal)


@wrong_rule(normal_in_world, shows=((1, 1, 1), (5, 0, 0), (1, 1, 0)), hides=ROUND)
def normal_moved(scale: Vector, shift: Vector, normal: Vector) -> Vector:
    """The normal was moved with the object. It is a direction: its w is 0."""
    return unit(shifted(shift, tuple(n / s for n, s in zip(normal, scale, strict=True))))


@wrong_rule(normal_in_camera, shows=(TURN, (2, 1, 1), (1, 1, 0)), hides=(TURN, (1, 1, 1), (1, 1, 0)))
def normal_by_projection(model_view: Matrix, focal: Vector, normal: Vector) -> Vector:
    """The normal matrix was made from P V M. Light is computed before the projection: take V M."""
    return unit(tuple(c / f for c, f in zip(image(model_view, normal), focal, strict=True)))


@wrong_rule(diffuse, shows=(0.25, (0, 0, 2), (0, 3, 4)), hides=(0.25, (0, 0, 1), (0, 3, 4)))
def normal_too_long(ambient: float, normal: Vector, to_light: Vector) -> Vector:
    """The normal is not of length 1. Divide by its length first."""
    return (ambient + (1 - ambient) * max(0.0, dot(normal, unit(to_light))),)


@wrong_rule(diffuse, shows=(0.25, (0, 0, 1), (0, 0, -1)), hides=FACING)
def light_unclamped(ambient: float, normal: Vector, to_light: Vector) -> Vector:
    """N . L is negative on the dark side and took away from the ambient light: max(0, N . L)."""
    return (ambient + (1 - ambient) * dot(unit(normal), unit(to_light)),)


@wrong_rule(diffuse, shows=FACING, hides=(0.25, (0, 0, 1), (1, 0, 0)))
def light_reversed(ambient: float, normal: Vector, to_light: Vector) -> Vector:
    """L points from the light to the surface. It points from the surface to the light."""
    return diffuse(ambient, normal, tuple(-c for c in to_light))


@wrong_rule(
    between_normals,
    shows=((1, 0, 0), (0, 1, 0), 0.5, (1, 1, 0)),
    hides=((1, 0, 0), (1, 0, 0), 0.5, (1, 1, 0)),
)
def normal_not_renormalized(first: Vector, second: Vector, t: Any, to_light: Vector) -> Vector:
    """The interpolated normal is shorter than 1. Divide by its length again."""
    mixed = tuple((1 - t) * a + t * b for a, b in zip(first, second, strict=True))
    return (float(dot(mixed, unit(to_light))),)


@wrong_rule(highlight, shows=SHINE, hides=STRAIGHT)
def highlight_at_light(normal: Vector, to_light: Vector, to_eye: Vector, shininess: int) -> Vector:
    """N . L was taken: the highlight lies under the light. H is halfway between L and V."""
    return (max(0.0, dot(unit(normal), unit(to_light))) ** shininess,)


@wrong_rule(highlight, shows=SHINE, hides=STRAIGHT)
def highlight_at_eye(normal: Vector, to_light: Vector, to_eye: Vector, shininess: int) -> Vector:
    """N . V was taken: the highlight follows the eye. H is halfway between L and V."""
    return (max(0.0, dot(unit(normal), unit(to_eye))) ** shininess,)


@wrong_rule(highlight, shows=SHINE, hides=STRAIGHT)
def shininess_inverted(normal: Vector, to_light: Vector, to_eye: Vector, shininess: int) -> Vector:
    """The exponent was inverted: a larger s makes a smaller highlight."""
    return (highlight(normal, to_light, to_eye, shininess)[0] ** (1 / shininess**2),)


@wrong_rule(light_byte, shows=(0.4, 0.8), hides=(0.1, 0.8))
def byte_overflows(ambient: Any, diffuse_light: Any) -> Vector:
    """The sum was stored without a limit, and 256 became 0. Cut it off at 255."""
    return (int(255 * (ambient + diffuse_light) + 0.5) % 256,)


@wrong_rule(lightings_by_fragment, shows=(1, 3, 40), hides=(1, 3, 3))
def phong_at_vertices(triangles: int, vertices: int, fragments: int) -> Vector:
    """Phong was lit at the vertices. It interpolates normals and lights every fragment."""
    return (triangles, vertices, vertices)


@wrong_rule(mip_level, shows=(64, 1 / 16), hides=(1, 2.0))
def level_without_size(texels: int, uv_step: float) -> Vector:
    """The step in u was not multiplied by the size of the texture: the level counts texels per pixel."""
    return (log2(uv_step),)


@wrong_rule(mip_level, shows=(64, 1 / 32), hides=(64, 1 / 64))
def level_of_area(texels: int, uv_step: float) -> Vector:
    """The level was taken from the area, which doubles it. It is log2 of the longer side."""
    return (max(0.0, 2 * log2(texels * uv_step)),)
