"""The workloads: meshes before a camera, triangles and lines, as scenes of the core and as files to be read."""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, replace
from math import radians
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from app.bench import records
from app.opengl_check.cases import icosphere
from core import Camera, ClipScene, DirectionalLight, Material, Mesh, Scene, Texture
from core.transform.matrices import projection, world_to_camera
from lessons import shapes

# The workloads that are a mesh before a camera: a sphere, a floor that runs behind the eye, a knot.


TO_LIGHT = np.array([0.4, 0.8, 0.45]) / np.linalg.norm([0.4, 0.8, 0.45])
TEXTURE_SIDE = 1024


def lit_sphere() -> records.ViewedMesh:
    """Return an icosphere of 81,920 triangles with a colour at every vertex, lit at the vertices."""
    positions, normals, triangles = icosphere(6)
    colors = 0.55 + 0.45 * np.sin(5 * positions + np.array([0.0, 2.0, 4.0]))
    return viewed(
        positions,
        triangles,
        normals,
        camera=Camera(eye=np.array([1.1, 0.9, 2.6]), target=np.zeros(3)),
        size=(1024, 1024),
        colors=colors,
        lighting=records.Lighting(-TO_LIGHT, 0.15, 0.85, 0.0, 1.0, is_per_pixel=False),
    )


def unlike_sphere() -> records.ViewedMesh:
    """Return the sphere of `lit_sphere` with a random colour at every vertex, as scans have them."""
    sphere = lit_sphere()
    colors = np.random.default_rng(47).uniform(0.1, 1.0, sphere.positions.shape)
    return replace(sphere, colors=colors)


def sphere_file(extension: str) -> records.MeshFile:
    """Return an icosphere of 327,680 triangles as a file."""
    positions, _, triangles = icosphere(7)
    return records.MeshFile(positions, triangles, extension)


def textured_floor() -> records.ViewedMesh:
    """Return a floor of two triangles, one with a corner behind the eye, with a texture of 1024 x 1024 texels."""
    positions = np.array([[-8.0, 0.0, 4.0], [8.0, 0.0, 4.0], [8.0, 0.0, -12.0], [-8.0, 0.0, -12.0]])
    return viewed(
        positions,
        np.array([[0, 1, 2], [0, 2, 3]]),
        np.tile([0.0, 1.0, 0.0], (4, 1)),
        camera=Camera(
            eye=np.array([0.3, 1.6, 3.2]),
            target=np.array([0.0, -0.35, 0.0]),
            up=np.array([0.03, 1.0, 0.0]),
            field_of_view=radians(60),
        ),
        size=(1024, 1024),
        uvs=np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
        texture=patterned_texture(),
    )


def textured_knot() -> records.ViewedMesh:
    """Return a knot of 200,000 triangles with a texture, lit at every pixel, 1920 x 1080."""
    mesh = shapes.knot(columns=2500, rows=40)
    assert mesh.normals is not None
    assert mesh.uvs is not None
    return viewed(
        mesh.positions,
        mesh.triangles,
        mesh.normals,
        camera=Camera(eye=np.array([0.6, 0.9, 4.2]), target=np.zeros(3)),
        size=(1920, 1080),
        uvs=mesh.uvs * np.array([12.0, 1.0]),
        texture=patterned_texture(),
        lighting=records.Lighting(-TO_LIGHT, 0.15, 0.7, 0.25, 32.0, is_per_pixel=True),
    )


def patterned_texture() -> records.Bytes:
    """Return (1024, 1024, 3) uint8: squares in red, a ramp in green, noise in blue."""
    side = TEXTURE_SIDE
    row, column = np.mgrid[0:side, 0:side]
    texture = np.empty((side, side, 3), np.uint8)
    texture[..., 0] = 180 * ((column >> 5 ^ row >> 5) & 1) + (column >> 3 & 63)
    texture[..., 1] = row >> 2
    texture[..., 2] = np.random.default_rng(5).integers(0, 256, (side, side))
    return np.maximum(texture, records.DARKEST)


def viewed(
    positions: records.Floats,
    triangles: records.Integers,
    normals: records.Floats,
    *,
    camera: Camera,
    size: tuple[int, int],
    colors: records.Floats | None = None,
    uvs: records.Floats | None = None,
    texture: records.Bytes | None = None,
    lighting: records.Lighting | None = None,
) -> records.ViewedMesh:
    """Put a mesh before a camera: all that a library may ask for, the matrices too."""
    return records.ViewedMesh(
        positions,
        triangles,
        normals,
        eye=camera.eye,
        target=camera.target,
        up=camera.up,
        field_of_view=camera.field_of_view,
        near=camera.near,
        far=camera.far,
        view=world_to_camera(camera),
        projection=projection(camera, size[0] / size[1]),
        size=size,
        colors=colors,
        uvs=uvs,
        texture=texture,
        lighting=lighting,
    )


# The workloads as scenes of the core, and the settings that draw them.


BLACK = np.array([0.0, 0.0, 0.0, 1.0])


def clip_scene(work: records.WindowTriangles) -> ClipScene:
    """Return window triangles as a scene in clip space; all w are 1."""
    clip = np.ones((len(work.corners), 3, 4))
    clip[..., :2] = work.corners / np.array(work.size) * 2 - 1
    clip[..., 2] = 2 * work.depth - 1
    return ClipScene(clip, work.colors / 255, work.size, background=BLACK)


def mesh_of(work: records.ViewedMesh) -> Mesh:
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


def lights_of(work: records.ViewedMesh) -> tuple[DirectionalLight, ...]:
    """Return the lights; like the mesh they are the same in every picture."""
    return () if work.lighting is None else (DirectionalLight(work.lighting.direction),)


def view_of(work: records.ViewedMesh, mesh: Mesh, lights: tuple[DirectionalLight, ...]) -> Scene:
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


def method_names(work: records.WindowTriangles | records.ViewedMesh) -> dict[str, str]:
    """Return the settings that say what the picture is, whatever draws it."""
    if isinstance(work, records.ViewedMesh):
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
    make: Callable[[], records.Work]


def small_triangles() -> records.WindowTriangles:
    """Return workload B: 2,000 triangles of 100 pixels each in 512 x 512."""
    return records.random_triangles(42, 2000, (512, 512), 100.0)


def random_lines() -> records.Lines:
    """Return 1,000 lines between random pixels of 1024 x 1024."""
    rng = np.random.default_rng(46)
    ends = rng.integers(0, 1024, (1000, 4))
    return records.Lines(ends, rng.integers(records.DARKEST, 256, (1000, 3)).astype(np.uint8), (1024, 1024))


WORKLOADS = (
    Workload("A1", "one large triangle, flat", lambda: records.large_triangle(FLAT)),
    Workload("A2", "one large triangle, depth and Gouraud", lambda: records.large_triangle(RAINBOW)),
    Workload("B", "2,000 triangles of 100 pixels", small_triangles),
    Workload(
        "C", "20,000 triangles of 16 pixels", lambda: records.random_triangles(43, 20000, (512, 512), 16.0)
    ),
    Workload("D", "81,920-triangle sphere, whole pipeline", lit_sphere),
    Workload("E", "textured floor, clipped, bilinear", textured_floor),
    Workload("F", "1,000 lines", random_lines),
    Workload("G", "200,000-triangle knot, texture and Phong", textured_knot),
    Workload(
        "H", "10,000 blended triangles", lambda: records.random_triangles(44, 10000, (512, 512), 100.0, True)
    ),
    Workload("I", "first picture from a cold start", lambda: records.ColdStart(small_triangles())),
    Workload("J", "81,920-triangle sphere, unlike vertex colours", unlike_sphere),
    Workload("K1", "opening an OBJ file", lambda: sphere_file(".obj")),
    Workload("K2", "opening a binary PLY file", lambda: sphere_file(".ply")),
    Workload("K3", "opening a binary STL file", lambda: sphere_file(".stl")),
    Workload("L1", "edited inside test, small raster", lambda: records.TypedPicture("fill", (64, 48))),
    Workload("L2", "edited inside test", lambda: records.TypedPicture("fill", (512, 512))),
    Workload("L3", "30 lines by an edited listing", lambda: records.TypedPicture("line", (512, 512))),
    Workload("L4", "Phong as shaders in GLSL", lambda: records.TypedPicture("shaders", (512, 512))),
)
"""All workloads, in the order in which they are run."""


# Meshes as files: written to be read, and what was read as a picture that can be compared.


def prepare_reading(
    work: records.MeshFile,
    stack: ExitStack,
    read: Callable[[Path], Any],
    arrays_of: Callable[[Any], tuple[records.Floats, records.Integers]],
) -> records.Prepared:
    """Write the file, which is read anew in every run; ``arrays_of`` gives positions and triangles of what was read."""
    folder = Path(stack.enter_context(TemporaryDirectory(prefix="rasterscope-bench-")))
    path = folder / f"sphere{work.extension}"
    path.write_bytes(file_bytes(work))
    return records.Prepared(lambda: read(path), picture=lambda found: corner_picture(*arrays_of(found)))


def corner_picture(positions: records.Floats, triangles: records.Integers) -> records.Bytes:
    """Return the corners (T, 3) as pixels whose colours are their places, none of them black."""
    return np.rint(100 * positions + 128).astype(np.uint8).take(triangles, axis=0)


def file_bytes(work: records.MeshFile) -> bytes:
    """Return the content of the file."""
    singles, indices = work.positions.astype("<f4"), work.triangles.astype("<i4")
    if work.extension == ".obj":
        vertices = [f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in work.positions.tolist()]
        polygons = [f"f {a} {b} {c}\n" for a, b, c in (work.triangles + 1).tolist()]
        return "".join(vertices + polygons).encode()
    if work.extension == ".ply":
        faces = np.zeros(len(indices), [("count", "u1"), ("corners", "<i4", 3)])
        faces["count"], faces["corners"] = 3, indices
        header = (
            f"ply\nformat binary_little_endian 1.0\nelement vertex {len(singles)}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {len(indices)}\nproperty list uchar int vertex_indices\nend_header\n"
        )
        return header.encode() + singles.tobytes() + faces.tobytes()
    rows = np.zeros(len(indices), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    rows["corners"] = singles[indices]
    return b"".join([bytes(80), len(rows).to_bytes(4, "little"), rows.tobytes()])
