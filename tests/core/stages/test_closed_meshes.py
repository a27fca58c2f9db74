"""Solids: closed, and wound so that no back face is the first one on any ray from outside."""

from dataclasses import replace

import numpy as np
import pytest

from core import Camera, DirectionalLight, Mesh, Scene, Settings, render
from core.fast_path.draw import draw_picture
from core.stages.closed_meshes import is_closed, is_never_negative, is_solid

CAMERA = Camera(np.array([0.0, 0.0, 5.0]), np.zeros(3))


def box(size: float = 1.0, center: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Mesh:
    corners = np.stack(np.meshgrid([-1, 1], [-1, 1], [-1, 1], indexing="ij"), -1).reshape(8, 3) * size
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [(a, b, c) for p, q, r, s in quads for a, b, c in ((p, q, r), (p, r, s))]
    return Mesh(corners + np.array(center), np.array(triangles))


def plate(thickness: float, center: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Mesh:
    return replace(box(), positions=box().positions * [1.0, thickness, 1.0] + center)


def turned(mesh: Mesh) -> Mesh:
    return replace(mesh, triangles=mesh.triangles[:, ::-1].copy(), normals=None)


def scene_of(*meshes: Mesh) -> Scene:
    return Scene(meshes, CAMERA, (DirectionalLight(np.array([0.0, -1.0, -1.0])),), (40, 30))


def mirrored(mesh: Mesh) -> Mesh:
    return replace(mesh, transform=np.diag([-1.0, 1, 1, 1]))


def joined(*meshes: Mesh) -> Mesh:
    firsts = np.cumsum([0, *(len(mesh.positions) for mesh in meshes[:-1])])
    return Mesh(
        np.concatenate([mesh.positions for mesh in meshes]),
        np.concatenate([mesh.triangles + first for mesh, first in zip(meshes, firsts, strict=True)]),
    )


def with_one_face_turned() -> Mesh:
    triangles = box().triangles.copy()
    triangles[3] = triangles[3, ::-1]
    return Mesh(box().positions, triangles)


def prism(outline: list[tuple[float, float]]) -> Mesh:
    """A prism over a closed polygon in the plane, whose caps are fans: closed, whatever the polygon does."""
    count = len(outline)
    positions = np.array([(x, y, z) for z in (-1.0, 1.0) for x, y in outline])
    sides = [
        triangle
        for a in range(count)
        for b in ((a + 1) % count,)
        for triangle in ((a, b, count + b), (a, count + b, count + a))
    ]
    caps = [(0, k + 1, k) for k in range(1, count - 1)]
    caps += [(count, count + k, count + k + 1) for k in range(1, count - 1)]
    return Mesh(positions, np.array(sides + caps))


SQUARE = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
LYING_EIGHT = [(-1.0, -1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, 1.0)]
TWICE_AROUND = [*SQUARE, (-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]

SOLID = {
    "a box": lambda: (box(),),
    "a box and another one inside": lambda: (box(), box(0.4)),
    "two boxes that overlap": lambda: (box(), box(1.0, (0.7, 0.6, 0.5))),
    "a box with a hollow": lambda: (joined(box(), turned(box(0.5))),),
    "a mirrored box that is turned": lambda: (mirrored(turned(box())),),
    "a thin plate": lambda: (plate(0.003),),
    "a thin plate turned inside out within a box": lambda: (box(2.0), turned(plate(0.003))),
    "a prism": lambda: (prism(SQUARE),),
    "a prism that goes around twice": lambda: (prism(TWICE_AROUND),),
}
OPEN_OR_TURNED = {
    "a box turned inside out": lambda: (turned(box()),),
    "a box without a face": lambda: (replace(box(), triangles=box().triangles[1:].copy()),),
    "a box with one face turned": lambda: (with_one_face_turned(),),
    "a mirrored box": lambda: (mirrored(box()),),
    "a box beside one turned inside out": lambda: (box(), turned(box(0.5, (3.0, 0.0, 0.0)))),
    "one mesh of both": lambda: (joined(box(), turned(box(0.5, (3.0, 0.0, 0.0)))),),
    "a surface that passes through itself and turns over": lambda: (prism(LYING_EIGHT),),
    "a thin plate turned inside out": lambda: (turned(plate(0.003)),),
    "a very thin one beside a box": lambda: (box(), turned(plate(0.0005, (3.0, 0.0, 0.0)))),
    "a box without size": lambda: (box(0.0),),
    "nothing but a hollow": lambda: (turned(box()), turned(box(0.4))),
}


@pytest.mark.parametrize("name", list(SOLID))
def test_solids(name):
    assert is_solid(scene_of(*SOLID[name]()))


@pytest.mark.parametrize("name", list(OPEN_OR_TURNED))
def test_what_shows_backs_is_no_solid(name):
    assert not is_solid(scene_of(*OPEN_OR_TURNED[name]()))


def test_a_surface_that_turns_over_is_closed_all_the_same():
    mesh = prism(LYING_EIGHT)
    assert is_closed(mesh.positions, mesh.triangles)


@pytest.mark.parametrize("name", list(SOLID))
@pytest.mark.parametrize("eye", [(4.0, 1.0, 6.0), (-5.0, 3.0, -4.0), (0.1, -6.0, 0.2)], ids=str)
def test_no_back_of_a_solid_is_seen(name, eye):
    scene = replace(scene_of(*SOLID[name]()), camera=Camera(np.array(eye), np.zeros(3)), size=(90, 70))
    every = draw_picture(scene, Settings(shading="flat")).pixels
    fronts = draw_picture(scene, Settings(shading="flat", cull="back")).pixels
    assert np.array_equal(every, fronts)


def test_the_view_stays_the_window_s_own():
    """Finding out draws the scene from aside; what is known of the last scene is not touched by that."""
    scene = scene_of(box())
    before = render(scene)
    assert is_solid(scene)
    assert np.array_equal(render(scene).color, before.color)
    assert render(scene).statistics["transform"].seconds == 0  # still known


def test_winding_numbers_along_rays():
    ray = np.array([0, 0, 0, 0, 3, 3, 5, 5, 5])
    depth = np.array([0.1, 0.2, 0.7, 0.9, 0.4, 0.5, 0.1, 0.1001, 0.2])
    facing = np.array([1, 1, -1, -1, -1, 1, -1, 1, 1])
    found = is_never_negative(ray, depth, np.full(9, 0.0001), facing)
    #       enters twice, leaves twice   |  a back first | in the wrong order by rounding; does not end outside
    assert found.tolist() == [True] * 4 + [False, True] + [True, True, False]
