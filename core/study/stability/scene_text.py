"""The scene of a failing case as Python statements that make it again."""

from dataclasses import asdict

import numpy as np

from core.records.arrays import Floats, read_only
from core.scene import AnyScene, Camera, ClipScene, DirectionalLight, Scene, Texture
from core.study.stability.case_text import clip_text

UP = read_only(np.array([0.0, 1.0, 0.0]))
"""(3,) a camera's way up, if nothing is said of it."""


def scene_text(scene: AnyScene) -> str:
    """Return statements that make ``scene``, with all that matters to a picture.

    Raises
    ------
    ValueError
        For a scene of meshes other than one with normals under one distant light.
    """
    return _triangles_text(scene) if isinstance(scene, ClipScene) else _mesh_text(scene)


def _triangles_text(scene: ClipScene) -> str:
    background = _unless_usual("background", scene.background, 0.0)
    texture = "" if scene.texture is None else ", texture=texture"
    assert scene.attributes is not None
    return (
        f"clip = {clip_text(scene.clip)}\n"
        f"values = {clip_text(scene.attributes)}\n"
        f"{'' if scene.texture is None else _texture_text(scene.texture)}"
        f"scene = ClipScene(np.array(clip, float), np.array(values, float), {scene.size}{texture}{background})"
    )


def _texture_text(texture: Texture) -> str:
    """Return a statement that makes a texture; its numbers have no more digits than float32 needs."""
    rows = [
        "    [" + ", ".join(f"[{', '.join(map(str, texel))}]" for texel in row) + "],"
        for row in texture.pixels
    ]
    listed = "\n".join(rows)
    return f"texels = [\n{listed}\n]\ntexture = Texture(np.array(texels, np.float32))\n"


def _mesh_text(scene: Scene) -> str:
    if len(scene.meshes) != 1 or len(scene.lights) != 1:
        raise ValueError("one mesh under one light is wanted, got another scene")
    (mesh,), (light,) = scene.meshes, scene.lights
    if mesh.normals is None or not isinstance(light, DirectionalLight):
        raise ValueError("a mesh with normals under a distant light is wanted, got another one")
    material = ", ".join(f"{name}={value}" for name, value in asdict(mesh.material).items())
    is_round = np.array_equal(mesh.normals, mesh.positions)
    normals = "positions" if is_round else f"np.array({mesh.normals.tolist()})"
    return (
        f"positions = np.array({mesh.positions.tolist()})\n"
        f"normals = {normals}\n"
        f"material = Material({material})\n"
        f"mesh = Mesh(positions, np.array({mesh.triangles.tolist()}), normals, material=material)\n"
        f"{_camera_text(scene.camera)}\n"
        f"light = DirectionalLight(np.array({light.direction.tolist()}){_unless_usual('color', light.color, 1.0)})\n"
        f"scene = Scene((mesh,), camera, (light,), {scene.size}{_unless_usual('background', scene.background, 0.0)})"
    )


def _unless_usual(name: str, numbers: Floats, usual: Floats | float) -> str:
    """Return an argument that gives ``numbers`` (k,), or nothing where they are the ``usual`` ones."""
    return "" if (numbers == usual).all() else f", {name}=np.array({numbers.tolist()})"


def _camera_text(camera: Camera) -> str:
    opening = (
        f"field_of_view={camera.field_of_view}"
        if camera.projection == "perspective"
        else f'projection="orthographic", view_height={camera.view_height}'
    )
    return (
        f"eye, target = np.array({camera.eye.tolist()}), np.array({camera.target.tolist()})\n"
        f"camera = Camera(eye, target{_unless_usual('up', camera.up, UP)}, {opening}, "
        f"near={camera.near}, far={camera.far})"
    )
