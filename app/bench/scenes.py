"""The workloads as scenes of the core, and the settings that draw them."""

import numpy as np

from app.bench.records import ViewedMesh, WindowTriangles
from core import Camera, ClipScene, DirectionalLight, Material, Mesh, Scene, Texture

BLACK = np.array([0.0, 0.0, 0.0, 1.0])


def clip_scene(work: WindowTriangles) -> ClipScene:
    """Return window triangles as a scene in clip space; all w are 1."""
    clip = np.ones((len(work.corners), 3, 4))
    clip[..., :2] = work.corners / np.array(work.size) * 2 - 1
    clip[..., 2] = 2 * work.depth - 1
    return ClipScene(clip, work.colors / 255, work.size, background=BLACK)


def mesh_of(work: ViewedMesh) -> Mesh:
    """Return the mesh; its colours and texels are taken as linear."""
    light = work.lighting
    count = len(work.positions)
    return Mesh(
        work.positions,
        work.triangles,
        work.normals,
        work.uvs,
        None if work.colors is None else np.concatenate([work.colors, np.ones((count, 1))], axis=1),
        None if work.texture is None else Texture((work.texture / 255).astype(np.float32)),
        material=Material()
        if light is None
        else Material(light.ambient, light.diffuse, light.specular, light.shininess),
    )


def lights_of(work: ViewedMesh) -> tuple[DirectionalLight, ...]:
    """Return the lights; like the mesh they are the same in every picture."""
    return () if work.lighting is None else (DirectionalLight(work.lighting.direction),)


def view_of(work: ViewedMesh, mesh: Mesh, lights: tuple[DirectionalLight, ...]) -> Scene:
    """Return the mesh before its camera."""
    return Scene(
        (mesh,),
        Camera(
            work.eye, work.target, work.up, field_of_view=work.field_of_view, near=work.near, far=work.far
        ),
        lights,
        work.size,
        BLACK,
    )


def method_names(work: WindowTriangles | ViewedMesh) -> dict[str, str]:
    """Return the settings that say what the picture is, whatever draws it."""
    if isinstance(work, ViewedMesh):
        if work.lighting is None:
            return {"shading": "unlit", "clipping": "sutherland-hodgman"}
        return {"shading": "phong" if work.lighting.is_per_pixel else "gouraud"}
    names = {"interpolation": "flat" if work.is_flat else "perspective"}
    return names | ({"blend": "over", "visibility": "last-drawn"} if work.is_blended else {})
