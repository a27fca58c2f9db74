"""Meshes seen from all around: the spans show the same triangles as the plain fill, once each, without a hole."""

import numpy as np
import pytest

from core import Camera, DirectionalLight, Frame, Mesh, Scene, Settings, draw_picture, render
from lessons.shapes import cube, floor, knot, sphere, torus
from tests.core.fast_path.references import exact_bytes, shows_thin_triangle
from tests.covering import every_nth, in_turn, is_everything

MESHES = {
    "cube": cube(1.5),
    "small cube": cube(0.05),
    "sphere": sphere(),
    "coarse sphere": sphere(1.0, 7, 4),
    "fine sphere": sphere(1.0, 150, 75),
    "torus": torus(),
    "coarse torus": torus(columns=9, rows=5),
    "thin torus": torus(0.9, 0.02, 200, 6),
    "knot": knot(columns=200, rows=10),
    "floor": floor(3.0, 6.0),
}


def seen_from(mesh: Mesh, turn: int, size: tuple[int, int] = (101, 77)) -> Scene:
    """Return a scene; every fourth view is from within the mesh, or so near that the near plane cuts it."""
    distance = 0.7 if turn % 4 == 3 else 2.6
    angle = 0.4 + 1.3 * turn
    direction = np.array([np.cos(angle), 0.5 * np.sin(2.1 * turn), np.sin(angle)])
    light = DirectionalLight(np.array([-1.0, -2.0, -0.5]))
    return Scene((mesh,), Camera(distance * direction, np.zeros(3)), (light,), size)


def assert_equal_frames(frame: Frame, usual: Frame) -> None:
    for buffer in ("primitive", "depth", "color", "attributes", "cover_count"):
        assert np.array_equal(getattr(frame, buffer), getattr(usual, buffer)), buffer


@pytest.mark.parametrize("name", every_nth(list(MESHES), 3))
def test_spans_draw_the_same_triangles(name: str) -> None:
    for turn in range(8) if is_everything() else (0, 3):
        scene = seen_from(MESHES[name], turn)
        for depth, cull in (("z-float32", "none"), ("fixed-38", "back"), ("inverse-w", "none")):
            chosen = {"depth": depth, "cull": cull, "shading": "unlit"}
            frame = render(scene, Settings(fill="spans", **chosen))
            assert_equal_frames(frame, render(scene, Settings(**chosen)))


@pytest.mark.parametrize(
    ("shading", "name"), every_nth(in_turn(["phong", "gouraud", "flat", "unlit"], list(MESHES)), 3)
)
def test_pictures_have_the_bytes_of_the_buffers(name: str, shading: str) -> None:
    for turn, depth in ((0, "z-float32"), (3, "fixed-38")):
        scene = seen_from(MESHES[name], turn)
        for cull in ("none", "back"):
            chosen = {"depth": depth, "cull": cull, "shading": shading}
            for encoding in ("srgb", "linear"):
                picture = draw_picture(scene, Settings(fill="spans", **chosen), encoding=encoding)
                away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, Settings(**chosen), encoding))
                if picture.route.color in ("palette", "deferred"):
                    assert away.max() == 0, picture.route
                else:
                    away[shows_thin_triangle(scene, Settings(**chosen))] = 0
                    assert away.max() <= 1, (picture.route, encoding)


@pytest.mark.parametrize("name", ["cube", "sphere", "coarse sphere"])
def test_convex_solids_are_watertight(name: str) -> None:
    for turn in (0, 1, 2, 4, 5, 6):
        scene = seen_from(MESHES[name], turn, (231, 177))
        front = render(scene, Settings(fill="spans", cull="back", shading="unlit"))
        back = render(scene, Settings(fill="spans", cull="front", shading="unlit"))
        assert front.cover_count.max() == 1
        assert np.array_equal(front.cover_count, back.cover_count)
        # No hole: every row of a convex solid is one stretch.
        for row in front.cover_count:
            covered = np.flatnonzero(row)
            assert len(covered) == 0 or covered[-1] - covered[0] == len(covered) - 1
