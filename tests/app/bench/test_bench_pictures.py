"""The core and Pillow as contenders: small pictures of every kind, compared with the reference."""

import re
from contextlib import ExitStack
from dataclasses import replace

import numpy as np
import pytest

from app.bench import ours, ours_child, ours_shared, pillow_peer, records, trimesh_peer
from app.bench.harness import cold_contender
from app.bench.reference import Difference, compare, make_reference
from app.bench.workloads import TO_LIGHT, textured_floor, viewed
from app.opengl_check.cases import icosphere
from core.fast_path.workers.sharing import Sharing
from core.scene import Camera
from core.transform.matrices import projection, world_to_camera
from lessons import shapes


def small_sphere(is_per_pixel: bool, columns: int = 24) -> records.ViewedMesh:
    mesh = shapes.sphere(columns=columns, rows=columns // 2)
    floor = textured_floor()
    assert mesh.normals is not None
    return viewed(
        mesh.positions,
        mesh.triangles,
        mesh.normals,
        camera=Camera(eye=np.array([1.1, 0.9, 2.6]), target=np.zeros(3)),
        size=(90, 70),
        colors=None if is_per_pixel else 0.6 + 0.3 * mesh.positions,
        uvs=mesh.uvs if is_per_pixel else None,
        texture=floor.texture if is_per_pixel else None,
        lighting=records.Lighting(-TO_LIGHT, 0.2, 0.6, 0.2 if is_per_pixel else 0.0, 8.0, is_per_pixel),
    )


def small_floor() -> records.ViewedMesh:
    floor, size = textured_floor(), (100, 80)
    camera = Camera(floor.eye, floor.target, floor.up, field_of_view=floor.field_of_view)
    return replace(
        floor, size=size, view=world_to_camera(camera), projection=projection(camera, size[0] / size[1])
    )


def some_lines() -> records.Lines:
    rng = np.random.default_rng(3)
    return records.Lines(
        rng.integers(0, 60, (30, 4)), rng.integers(9, 256, (30, 3)).astype(np.uint8), (60, 60)
    )


def drawn(module, work: records.Work) -> Difference:
    contender = module.contender(work)
    with ExitStack() as stack:
        pixels = contender.prepare(stack).run()
        return compare(pixels, contender.is_top_down, make_reference(work))


@pytest.mark.parametrize(
    "work",
    [
        records.large_triangle(((255, 40, 20),) * 3),
        records.large_triangle(((255, 40, 20), (20, 250, 60), (30, 80, 240))),
        records.random_triangles(1, 300, (64, 48), 40.0),
        records.random_triangles(2, 100, (64, 48), 40.0, is_blended=True),
        small_sphere(is_per_pixel=False),
        small_sphere(is_per_pixel=True),
        small_floor(),
        some_lines(),
    ],
    ids=["flat", "gouraud", "random", "blended", "mesh", "phong", "floor", "lines"],
)
def test_the_core_draws_the_reference(work: records.Work) -> None:
    assert drawn(ours, work) == Difference(0, 0)


@pytest.mark.slow
def test_two_processes_draw_large_meshes_and_say_who_drew_what() -> None:
    assert ours_shared.contender(small_sphere(is_per_pixel=False)) is None
    assert ours_shared.contender(some_lines()) is None
    work = small_sphere(is_per_pixel=False, columns=120)
    contender = ours_shared.contender(work)
    assert (contender.library, contender.kind) == ("Rasterscope, 2 processes", "ours")
    with ExitStack() as stack:
        prepared = contender.prepare(stack)
        assert compare(prepared.run(), False, make_reference(work)) == Difference(0, 0)
        told = prepared.tell()
    assert re.search(r"; rows 0-\d+ [\d.]+ ms, rows \d+-69 [\d.]+ ms$", told)
    assert ours_shared.sharing_text(Sharing(reason="of luck")) == "one process, because of luck"


def test_pillow_draws_the_same_lines() -> None:
    assert drawn(pillow_peer, some_lines()).is_none


@pytest.mark.parametrize(
    "work", [records.random_triangles(1, 60, (64, 48), 40.0), small_floor()], ids=["triangles", "floor"]
)
def test_pillow_draws_much_the_same(work: records.Work) -> None:
    """It paints every pixel that a polygon touches, so that outlines differ, and no more."""
    difference = drawn(pillow_peer, work)
    assert difference.covered + difference.colored < 0.35 * work.size[0] * work.size[1]


def test_a_library_says_what_it_cannot_draw() -> None:
    assert pillow_peer.contender(small_sphere(is_per_pixel=True)) is None
    assert pillow_peer.contender(records.large_triangle(((9, 9, 9), (9, 9, 9), (10, 9, 9)))) is None


@pytest.mark.slow
@pytest.mark.parametrize("extension", [".obj", ".ply", ".stl"])
def test_all_readers_give_the_mesh_of_the_file(extension: str) -> None:
    positions, _, triangles = icosphere(2)
    work = records.MeshFile(positions, triangles, extension)
    reference = make_reference(work)
    assert reference.primitive_count == len(triangles) == 320
    for module in (ours, trimesh_peer) if extension != ".obj" else (ours, ours_child, trimesh_peer):
        contender = module.contender(work)
        with ExitStack() as stack:
            prepared = contender.prepare(stack)
            assert compare(prepared.picture(prepared.run()), False, reference).is_none
    assert ours_shared.contender(work) is pillow_peer.contender(work) is None


@pytest.mark.slow
def test_a_fresh_process_draws_the_same_picture() -> None:
    work = records.random_triangles(1, 50, (64, 48), 40.0)
    contender = cold_contender(ours, records.ColdStart(work))
    with ExitStack() as stack:
        pixels = contender.prepare(stack).run()
    assert compare(pixels, False, make_reference(work)).is_none
