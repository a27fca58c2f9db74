"""Mistakes with mirrors: faulty look-ups that can be run, and the same by hand."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from core import Material, Settings
from core.records.arrays import Floats, Integers
from core.shading.environment import ABOVE, ACROSS, MapLooks, Surroundings, cube, look_up_faces, place_on_cube
from lessons.mistakes.twin import Case, Twin, wrong_rule
from lessons.world_scenes import mirror_cube

Look = Callable[[Floats, Floats, Floats, Surroundings], MapLooks]

# Faulty look-ups.


def _looked(
    looks: MapLooks, direction: Floats, face: Integers, place: Floats, around: Surroundings
) -> MapLooks:
    color, texels, shares = look_up_faces(around.faces, face, place)
    return MapLooks(looks.n_dot_i, direction, color, face, place, texels, shares)


def sign_of_normal(position: Floats, normal: Floats, to_eye: Floats, around: Surroundings) -> MapLooks:
    """Add twice the part along the normal."""
    looks = cube(position, normal, to_eye, around)
    direction = 2 * looks.n_dot_i[:, None] * normal - to_eye
    return _looked(looks, direction, *place_on_cube(direction), around)


def signed_largest(position: Floats, normal: Floats, to_eye: Floats, around: Surroundings) -> MapLooks:
    """Take the face of the largest component with its sign."""
    looks = cube(position, normal, to_eye, around)
    face = 2 * looks.direction.argmax(axis=1)
    return _looked(looks, looks.direction, face, _place(looks.direction, face, True), around)


def not_divided(position: Floats, normal: Floats, to_eye: Floats, around: Surroundings) -> MapLooks:
    """Leave the other two components as they are."""
    looks = cube(position, normal, to_eye, around)
    return _looked(looks, looks.direction, looks.face, _place(looks.direction, looks.face, False), around)


def _place(direction: Floats, face: Integers, is_divided: bool) -> Floats:
    rows = np.arange(len(face))
    size = np.abs(direction[rows, face // 2]) if is_divided else 1.0
    with np.errstate(divide="ignore", invalid="ignore"):
        sides = [
            direction[rows, way[face, 0]] * way[face, 1] / size for way in map(np.array, (ACROSS, ABOVE))
        ]
    return (np.stack(sides, axis=1) + 1) / 2


def looked_up_by(wrong: Look) -> Callable[[Settings], Settings]:
    """Return what looks into an environment map in another way, where settings have one."""
    return lambda settings: (
        settings.replaced(environment=wrong) if settings.environment == "cube" else settings
    )


MAPPED = Settings(environment="cube", environment_size=16)


def mirror() -> Case:
    """Return the mirror on a floor, small, with its map."""
    scene: Any = replace(mirror_cube(), size=(24, 18))
    return Case(scene, MAPPED)


def in_fog() -> Case:
    """Return a mirror of which all around, a floor too, has the colour of the background."""
    scene = mirror_cube()
    floor = replace(
        scene.meshes[0],
        texture=None,
        colors=np.tile(scene.background, (4, 1)),
        material=Material(1.0, 0.0, 0.0),
    )
    fog: Any = replace(scene, meshes=(floor, scene.meshes[1]), size=(24, 18))
    return Case(fog, MAPPED)


SIGN = (
    "The part along the normal was added twice. Subtract it twice: I comes from the eye, against the normal."
)
SIGNED = (
    "The largest component was sought with its sign. Its size counts: the sign says which of two faces it is."
)
UNDIVIDED = "The other two components were taken undivided. They are divided by the size of the largest."
TWINS = (
    Twin("reflection-sign", SIGN, mirror(), in_fog(), looked_up_by(sign_of_normal)),
    Twin("face-by-signed-largest", SIGNED, mirror(), in_fog(), looked_up_by(signed_largest)),
    Twin("place-not-divided", UNDIVIDED, mirror(), in_fog(), looked_up_by(not_divided)),
)

# The same by hand, in whole numbers and fractions.

Exact = Sequence[Any]


def mirrored(incoming: Exact, normal: Exact) -> tuple[Any, ...]:
    """Return R = I - 2 (N . I) N for a normal of length 1."""
    return _mirrored(incoming, normal, -2)


def _mirrored(incoming: Exact, normal: Exact, factor: int) -> tuple[Any, ...]:
    along = sum(i * n for i, n in zip(incoming, normal, strict=True))
    return tuple(i + factor * along * n for i, n in zip(incoming, normal, strict=True))


def face_of(direction: Sequence[int]) -> int:
    """Return the face, 0 to 5, of the largest component without its sign."""
    axis = max(range(3), key=lambda k: abs(direction[k]))
    return 2 * axis + (direction[axis] < 0)


def place_of(first: int, second: int, largest: int) -> tuple[Fraction, Fraction]:
    """Return the place on a face, from 0 to 1, of two components and the largest."""
    return (Fraction(first, largest) + 1) / 2, (Fraction(second, largest) + 1) / 2


SLANTED, DOWN = ((3, -4, 2), (0, 1, 0)), ((3, 0, 2), (0, 1, 0))


@wrong_rule(mirrored, shows=SLANTED, hides=DOWN, twin=TWINS[0])
def reflection_sign(incoming: Exact, normal: Exact) -> tuple[Any, ...]:
    """Add twice the part along the normal."""
    return _mirrored(incoming, normal, 2)


@wrong_rule(mirrored, shows=SLANTED, hides=DOWN)
def reflection_once(incoming: Exact, normal: Exact) -> tuple[Any, ...]:
    """The part along the normal was subtracted once, so the direction runs along the surface. Subtract it twice."""
    return _mirrored(incoming, normal, -1)


@wrong_rule(mirrored, shows=SLANTED, hides=((0, 0, 0), (0, 1, 0)))
def reflection_of_view(incoming: Exact, normal: Exact) -> tuple[Any, ...]:
    """The direction to the eye was mirrored. I runs from the eye to the surface."""
    return mirrored([-i for i in incoming], normal)


@wrong_rule(face_of, shows=((2, -5, 1),), hides=((2, 5, 1),), twin=TWINS[1])
def face_by_signed_largest(direction: Sequence[int]) -> int:
    """Take the largest component with its sign."""
    return 2 * max(range(3), key=lambda k: direction[k])


@wrong_rule(face_of, shows=((2, -5, 1),), hides=((2, 2, 2),))
def face_by_smallest(direction: Sequence[int]) -> int:
    """The face of the smallest component was taken. The direction meets the face that it runs along most."""
    axis = min(range(3), key=lambda k: abs(direction[k]))
    return 2 * axis + (direction[axis] < 0)


@wrong_rule(place_of, shows=(2, 3, 6), hides=(0, 0, 6), twin=TWINS[2])
def place_not_divided(first: int, second: int, largest: int) -> tuple[Fraction, Fraction]:
    """Leave the components as they are."""
    return place_of(first, second, 1)


@wrong_rule(place_of, shows=(2, 3, 6), hides=(6, 6, 6))
def place_from_middle(first: int, second: int, largest: int) -> tuple[Fraction, Fraction]:
    """The place was left from -1 to 1. Add 1 and halve it, so that it runs from 0 to 1."""
    return Fraction(first, largest), Fraction(second, largest)


@wrong_rule(place_of, shows=(2, 3, 6), hides=(0, 0, 6))
def place_by_length(first: int, second: int, largest: int) -> tuple[Fraction, Fraction]:
    """The components were divided by the length of R. They are divided by the size of the largest component."""
    length = round((first**2 + second**2 + largest**2) ** 0.5)
    return place_of(first, second, length)
