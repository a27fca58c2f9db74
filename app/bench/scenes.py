"""The workloads as scenes of the core, and the settings that draw them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.bench.meshes import lit_sphere, sphere_file, textured_floor, textured_knot, unlike_sphere
from app.bench.random_triangles import DARKEST, large_triangle, random_triangles
from app.bench.records import ColdStart, Lines, TypedPicture, ViewedMesh, WindowTriangles, Work
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


FLAT = ((255, 40, 20),) * 3
RAINBOW = ((255, 40, 20), (20, 250, 60), (30, 80, 240))


@dataclass(frozen=True)
class Workload:
    """One picture to be drawn."""

    name: str
    title: str
    make: Callable[[], Work]


def small_triangles() -> WindowTriangles:
    """Return workload B: 2,000 triangles of 100 pixels each in 512 x 512."""
    return random_triangles(42, 2000, (512, 512), 100.0)


def random_lines() -> Lines:
    """Return 1,000 lines between random pixels of 1024 x 1024."""
    rng = np.random.default_rng(46)
    ends = rng.integers(0, 1024, (1000, 4))
    return Lines(ends, rng.integers(DARKEST, 256, (1000, 3)).astype(np.uint8), (1024, 1024))


WORKLOADS = (
    Workload("A1", "one large triangle, flat", lambda: large_triangle(FLAT)),
    Workload("A2", "one large triangle, depth and Gouraud", lambda: large_triangle(RAINBOW)),
    Workload("B", "2,000 triangles of 100 pixels", small_triangles),
    Workload("C", "20,000 triangles of 16 pixels", lambda: random_triangles(43, 20000, (512, 512), 16.0)),
    Workload("D", "81,920-triangle sphere, whole pipeline", lit_sphere),
    Workload("E", "textured floor, clipped, bilinear", textured_floor),
    Workload("F", "1,000 lines", random_lines),
    Workload("G", "200,000-triangle knot, texture and Phong", textured_knot),
    Workload("H", "10,000 blended triangles", lambda: random_triangles(44, 10000, (512, 512), 100.0, True)),
    Workload("I", "first picture from a cold start", lambda: ColdStart(small_triangles())),
    Workload("J", "81,920-triangle sphere, unlike vertex colours", unlike_sphere),
    Workload("K1", "opening an OBJ file", lambda: sphere_file(".obj")),
    Workload("K2", "opening a binary PLY file", lambda: sphere_file(".ply")),
    Workload("K3", "opening a binary STL file", lambda: sphere_file(".stl")),
    Workload("L1", "edited inside test, small raster", lambda: TypedPicture("fill", (64, 48))),
    Workload("L2", "edited inside test", lambda: TypedPicture("fill", (512, 512))),
    Workload("L3", "30 lines by an edited listing", lambda: TypedPicture("line", (512, 512))),
    Workload("L4", "Phong as shaders in GLSL", lambda: TypedPicture("shaders", (512, 512))),
)
"""All workloads, in the order in which they are run."""
