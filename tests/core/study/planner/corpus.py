"""Scenes made from a seed, on which plans are tried: what is drawn and what it takes are mixed at random."""

from collections.abc import Callable

import numpy as np

from core.records.arrays import Floats
from core.scene import AnyScene, Camera, DirectionalLight, Light, Material, Mesh, PointLight, Scene, Texture
from core.study.workloads import (
    checkerboard,
    flat_scene,
    overlapping_triangles,
    random_source,
    sphere_mesh,
    textured_quad,
)

Source = np.random.Generator
MOST_SIDE = 48
"""Pixels on the longest side of a picture."""


def corpus_scene(seed: int) -> tuple[str, AnyScene]:
    """Return the kind of a scene and the scene; the kinds take turns."""
    source = random_source(seed)
    kinds = tuple(KINDS)
    name = kinds[seed % len(kinds)]
    return name, KINDS[name](source)


def _size(source: Source) -> tuple[int, int]:
    width, height = source.integers(20, MOST_SIDE + 1, 2).tolist()
    return width, height


def _colors(source: Source, count: int, spread: float) -> Floats:
    """Return vertex colours (count, 4) around one colour."""
    colors = np.ones((count, 4))
    colors[:, :3] = np.clip(source.uniform(0.1, 0.9, 3) + spread * source.uniform(-1, 1, (count, 3)), 0, 1)
    return colors


def _lights(source: Source) -> tuple[Light, ...]:
    direction = np.array([source.uniform(-1, 1), -1.0, source.uniform(-1.5, -0.2)])
    if source.random() < 0.3:
        return (PointLight(-4 * direction),)
    return (DirectionalLight(direction),)


def _material(source: Source) -> Material:
    if source.random() < 0.5:
        return Material(specular=0.0)
    return Material(specular=float(source.uniform(0.1, 0.6)), shininess=float(source.uniform(5, 80)))


def _camera(source: Source, distance: float) -> Camera:
    eye = source.normal(size=3)
    eye *= distance / np.linalg.norm(eye)
    kind = "orthographic" if source.random() < 0.2 else "perspective"
    return Camera(eye, np.zeros(3), up=np.array([0.1, 1.0, 0.2]), projection=kind, near=0.2, far=3 * distance)


def _ball(source: Source) -> Scene:
    whole = sphere_mesh(int(source.integers(4, 14)))
    colors = _colors(source, len(whole.positions), 0.0 if source.random() < 0.6 else 0.2)
    mesh = Mesh(whole.positions, whole.triangles, whole.normals, colors=colors, material=_material(source))
    background = colors[0] if source.random() < 0.3 else np.zeros(4)
    return Scene((mesh,), _camera(source, 3.0), _lights(source), _size(source), background)


def _room(source: Source) -> Scene:
    """The inside of a large sphere, which fills the picture."""
    whole = sphere_mesh(int(source.integers(5, 12)))
    colors = _colors(source, len(whole.positions), 0.0 if source.random() < 0.5 else 0.02)
    material = Material(ambient=0.8, diffuse=float(source.uniform(0, 0.2)), specular=0.0)
    mesh = Mesh(5 * whole.positions, whole.triangles, whole.normals, colors=colors, material=material)
    camera = Camera(source.uniform(-0.5, 0.5, 3), source.uniform(1, 2, 3), near=0.05, far=20.0)
    return Scene((mesh,), camera, _lights(source), _size(source))


def _sheet(source: Source) -> Scene:
    """A slanted floor or wall with a texture, or with colours that change slowly."""
    count = int(source.integers(1, 6))
    grid = np.linspace(-6, 6, count + 1)
    x, z = (axis.ravel() for axis in np.meshgrid(grid, grid))
    rise = source.uniform(-0.1, 0.1, len(x)) if source.random() < 0.5 else np.zeros(len(x))
    first = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    corners = np.stack(
        [first, first + count + 1, first + count + 2, first, first + count + 2, first + 1], axis=1
    )
    texture, repeats = None, float(source.choice([0.1, 1.0, 8.0]))
    if source.random() < 0.5:
        texture = (
            _soft_texture(source) if source.random() < 0.5 else checkerboard(16, int(source.integers(99)))
        )
    mesh = Mesh(
        np.stack([x, rise - 1, z], axis=1),
        corners.reshape(-1, 3),
        uvs=np.stack([x, z], axis=1) / 12 * repeats,
        colors=_colors(source, len(x), 0.03),
        texture=texture,
        material=_material(source),
    )
    eye = np.array([source.uniform(-1, 1), source.uniform(0, 4), source.uniform(1, 9)])
    camera = Camera(eye, np.array([0.0, -1.0, 0.0]), near=float(source.choice([0.1, 1.0])), far=40.0)
    return Scene((mesh,), camera, _lights(source), _size(source))


def _soft_texture(source: Source) -> Texture:
    base = source.uniform(0.3, 0.7, 3)
    pixels = base + 0.01 * source.uniform(-1, 1, (8, 8, 3))
    return Texture(pixels.astype(np.float32), "soft")


def _picture(source: Source) -> AnyScene:
    """A textured square that fills the picture, with any ratio of w."""
    texture = _soft_texture(source) if source.random() < 0.5 else checkerboard(16, int(source.integers(99)))
    ratio = float(source.choice([1.0, 1.2, 3.0]))
    return textured_quad(
        int(source.integers(20, MOST_SIDE)), ratio, float(source.choice([0.05, 0.5, 6.0])), texture
    )


def _bars(source: Source) -> AnyScene:
    size = _size(source)
    return flat_scene(
        overlapping_triangles(size, int(source.integers(1, 8)), int(source.integers(1 << 30))), size
    )


def _glass(source: Source) -> Scene:
    whole = sphere_mesh(int(source.integers(4, 8)))
    colors = _colors(source, len(whole.positions), 0.1)
    if source.random() < 0.8:
        colors[:, 3] = source.uniform(0.2, 1)
    mesh = Mesh(whole.positions, whole.triangles, whole.normals, colors=colors, material=_material(source))
    floor = Mesh(
        4 * np.array([[-1.0, -0.3, -1], [1, -0.3, -1], [1, -0.3, 1], [-1, -0.3, 1]]),
        np.array([[0, 2, 1], [0, 3, 2]]),
        colors=_colors(source, 4, 0.1),
    )
    return Scene((mesh, floor), _camera(source, 3.5), _lights(source), _size(source))


def _heap(source: Source) -> Scene:
    """Cubes and balls that overlap, in all sizes and at all distances."""
    meshes = []
    for _ in range(int(source.integers(2, 5))):
        whole = sphere_mesh(int(source.integers(2, 6)))
        transform = np.eye(4)
        transform[:3, :3] *= source.uniform(0.3, 1)
        transform[:3, 3] = source.uniform(-1, 1, 3)
        colors = _colors(source, len(whole.positions), 0.0)
        meshes.append(
            Mesh(
                whole.positions,
                whole.triangles,
                whole.normals,
                colors=colors,
                transform=transform,
                material=_material(source),
            )
        )
    return Scene(
        tuple(meshes), _camera(source, float(source.choice([1.5, 4.0]))), _lights(source), _size(source)
    )


KINDS: dict[str, Callable[[Source], AnyScene]] = {
    "ball": _ball,
    "room": _room,
    "sheet": _sheet,
    "picture": _picture,
    "bars": _bars,
    "glass": _glass,
    "heap": _heap,
}
"""What is drawn, by name."""
