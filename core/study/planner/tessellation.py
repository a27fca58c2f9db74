"""How fine a tessellation is enough: how far facets lie from the smooth surface that the normals describe.

An edge of length l whose ends' normals are an angle t apart is the chord of an arc of radius l / (2 sin(t/2)); the arc
rises (l/2) tan(t/4) above it, its sagitta. A sphere of radius r with n edges around has the sagitta r (1 - cos(pi/n)).
It falls with the square of the edge, so with the number of triangles.
"""

from math import ceil, pi

import numpy as np

from core.records.arrays import Floats
from core.scene import AnyScene, Scene
from core.stages.vertex_program import vertex_stage
from core.study.planner.records import Tessellation

WANTED = 0.25
"""Pixels that a facet may lie away."""


def tessellations(scene: AnyScene) -> tuple[Tessellation, ...]:
    """Return advice for every mesh of a scene, which is not applied; none where a vertex shader may bend them."""
    if not isinstance(scene, Scene) or scene.program is not None:
        return ()
    vertices = vertex_stage(scene)
    assert vertices.normals is not None
    found = []
    for number, mesh in enumerate(scene.meshes):
        corners = vertices.corners[vertices.mesh == number]
        window, w = vertices.window[:, :2][corners], vertices.clip[:, 3][corners]
        in_front = (w > 0).all(axis=1)
        largest = 0.0
        for start in range(3):
            end = (start + 1) % 3
            turned = angle(vertices.normals[corners[:, start]], vertices.normals[corners[:, end]])
            length = np.linalg.norm(window[:, end] - window[:, start], axis=1)
            largest = max(largest, float(sagitta(length, turned)[in_front].max(initial=0.0)))
        found.append(_advice(mesh.name, len(corners), largest))
    return tuple(found)


def angle(first: Floats, second: Floats) -> Floats:
    """Return the angles (Q,) between unit vectors (Q, 3), accurate for small ones too."""
    apart, together = (np.linalg.norm(each, axis=-1) for each in (first - second, first + second))
    return np.asarray(2 * np.arctan2(apart, np.maximum(together, 1e-300)))


def sagitta(length: Floats, turned: Floats) -> Floats:
    """Return how far an arc over chords of ``length`` (E,), whose ends are ``turned`` (E,) radians, rises."""
    return np.asarray(length / 2 * np.tan(np.minimum(turned, pi / 2) / 4))


def _advice(name: str, count: int, deviation: float) -> Tessellation:
    wanted = max(ceil(count * deviation / WANTED), 1)
    if deviation == 0:
        text = f"{name}: the normals are those of flat faces, so {count:,} triangles are right."
        return Tessellation(name, count, 0.0, count, text)
    way = "fewer are enough" if wanted < count else "more look rounder"
    text = (
        f"{name}: facets lie up to {deviation:.3g} pixels from the smooth surface; {way}, about {wanted:,} triangles "
        f"for {WANTED:g} pixels instead of {count:,}."
    )
    return Tessellation(name, count, deviation, wanted, text)
