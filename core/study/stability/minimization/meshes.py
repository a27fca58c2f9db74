"""A lit mesh made smaller: fewer triangles, a nearer look at a smaller picture, fewer digits of everything."""

from collections.abc import Iterator
from dataclasses import astuple, dataclass, replace

import numpy as np

from core.geometry.matrices import camera_axes
from core.records.arrays import Floats, Integers
from core.scene import AnyScene, Camera, DirectionalLight, Material, Mesh, Scene
from core.study.stability.minimization.kind import Kind, counted_triangles
from core.study.stability.minimization.numbers import digit_count, simpler_numbers
from core.study.stability.minimization.search import without_parts

SHININESS = 3
"""Place of the shininess among the numbers of a material; the others are reflectances."""


@dataclass(frozen=True, eq=False)
class LitMesh:
    """One mesh under one distant light, and who looks at it."""

    positions: Floats
    """(N, 3) float64, object space."""
    normals: Floats | None
    """(N, 3) float64; ``None``: the positions, as of a sphere around the origin."""
    triangles: Integers
    """(T, 3) int64."""
    eye: Floats
    """(3,) float64."""
    target: Floats
    """(3,) float64."""
    opening: Floats
    """(1,) float64, the field of view in radians, or the height of the view."""
    light: Floats
    """(3,) float64, the way the light travels."""
    material: Floats
    """(4,) float64, ambient, diffuse, specular and shininess."""
    scene: Scene
    """What it was taken from; its other numbers stay."""
    size: tuple[int, int]

    @property
    def camera(self) -> Camera:
        """Who looks at it."""
        opening, camera = float(self.opening[0]), replace(self.scene.camera, eye=self.eye, target=self.target)
        if camera.projection == "perspective":
            return replace(camera, field_of_view=opening)
        return replace(camera, view_height=opening)


def take_apart(scene: AnyScene) -> LitMesh:
    """Take a scene of one mesh under one distant light apart."""
    if not isinstance(scene, Scene) or len(scene.meshes) != 1 or len(scene.lights) != 1:
        raise ValueError("one mesh under one light is wanted, got another scene")
    (mesh,), (light,), camera = scene.meshes, scene.lights, scene.camera
    if mesh.normals is None or not isinstance(light, DirectionalLight):
        raise ValueError("a mesh with normals under a distant light is wanted, got another one")
    is_placed = not np.array_equal(mesh.transform, np.eye(4))
    if is_placed or mesh.colors is not None or mesh.texture is not None:
        raise ValueError("a mesh in its own place and of one material is wanted, got another one")
    is_round = np.array_equal(mesh.normals, mesh.positions)
    is_perspective = camera.projection == "perspective"
    return LitMesh(
        mesh.positions,
        None if is_round else mesh.normals,
        mesh.triangles,
        camera.eye,
        camera.target,
        np.array([camera.field_of_view if is_perspective else camera.view_height]),
        light.direction,
        np.array(astuple(mesh.material)),
        scene,
        scene.size,
    )


def put_together(parts: LitMesh) -> Scene:
    """Put the scene together."""
    (mesh,), (light,) = parts.scene.meshes, parts.scene.lights
    assert isinstance(light, DirectionalLight)
    normals = parts.positions if parts.normals is None else parts.normals
    shape = Mesh(parts.positions, parts.triangles, normals, name=mesh.name)
    smaller = replace(shape, material=Material(*parts.material.tolist()))
    lit_by = (replace(light, direction=parts.light),)
    return Scene((smaller,), parts.camera, lit_by, parts.size, parts.scene.background)


def with_fewer_triangles(parts: LitMesh) -> Iterator[LitMesh]:
    """Yield the mesh without a half, a quarter, an eighth ... of its triangles."""
    for left in without_parts(len(parts.triangles)):
        used, corners = np.unique(parts.triangles[left], return_inverse=True)
        yield replace(
            parts,
            positions=parts.positions[used],
            normals=None if parts.normals is None else parts.normals[used],
            triangles=corners.reshape(-1, 3).astype(np.int64),
        )


def with_smaller_picture(parts: LitMesh) -> Iterator[LitMesh]:
    """Yield the same at half the scale, then its left, middle and right, lower, middle and upper half.

    Notes
    -----
    Of a perspective camera a part is seen by turning it there: not the very same pixels, but as good.
    """
    width, height = parts.size
    if parts.size != (1, 1):
        yield replace(parts, size=(max(width // 2, 1), max(height // 2, 1)))
    for axis, side in enumerate(parts.size):
        kept = side // 2
        for first in sorted({0, (side - kept) // 2, side - kept}) if kept else ():
            yield _part(parts, axis, first, kept)


def _part(parts: LitMesh, axis: int, first: int, kept: int) -> LitMesh:
    """Return columns (axis 0) or rows (1) ``first`` to ``first + kept`` of the picture."""
    width, height = parts.size
    size = (kept, height) if axis == 0 else (width, kept)
    # The middle of what is kept, from the middle of the picture, in half heights.
    away = (2 * first + kept - parts.size[axis]) / height
    camera, opening = parts.camera, float(parts.opening[0])
    way = camera_axes(camera)[axis] * away
    part = kept / height if axis == 1 else 1.0
    if camera.projection == "orthographic":
        shift = way * opening / 2
        view = np.array([opening * part])
        return replace(parts, eye=parts.eye + shift, target=parts.target + shift, opening=view, size=size)
    reach = np.tan(opening / 2)
    distance = float(np.linalg.norm(parts.target - parts.eye))
    view = np.array([2 * np.arctan(reach * part)])
    return replace(parts, target=parts.target + way * reach * distance, opening=view, size=size)


def with_simpler_numbers(parts: LitMesh) -> Iterator[LitMesh]:
    """Yield the same with one number written in fewer digits, those with the most digits first."""
    names = ["positions", "eye", "target", "opening", "light", "material"]
    if parts.normals is not None:
        names.insert(1, "normals")
    places = [
        (-digit_count(value), name, index)
        for name in names
        for index, value in enumerate(getattr(parts, name).ravel().tolist())
    ]
    for negative, name, index in sorted(places, key=lambda place: place[0]):
        numbers: Floats = getattr(parts, name)
        is_measure = name == "opening" or (name == "material" and index == SHININESS)
        for simpler in simpler_numbers(float(numbers.flat[index]), float(is_measure), -negative):
            changed = numbers.copy()
            changed.flat[index] = simpler
            yield _with(parts, name, changed)


def _with(parts: LitMesh, name: str, numbers: Floats) -> LitMesh:
    """Return the same with other numbers of the field ``name``, an array of its shape."""
    return LitMesh(**(vars(parts) | {name: numbers}))


def in_words(parts: LitMesh) -> str:
    """Return how many triangles there are in how large a picture."""
    return counted_triangles(len(parts.triangles), parts.size)


LIT_MESHES = Kind(
    take_apart, put_together, (with_fewer_triangles, with_smaller_picture, with_simpler_numbers), in_words
)
"""One mesh with normals under one distant light."""
