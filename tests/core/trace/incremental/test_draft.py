"""A draft of a triangle that is dragged has the triangle's rows of a trace of the whole scene."""

from dataclasses import replace

import numpy as np
import pytest

from core import ClipScene, Settings, trace
from core.scene import AnyScene
from core.trace.incremental.draft import Draft, draft
from tests.core.trace.trace_cases import SCENES, name_of

MIXED = [SCENES[name] for name in ("clip", "textured-clip", "lit", "orthographic", "shared-edge")]


def moved_corners(scene: AnyScene, generator: np.random.Generator) -> AnyScene:
    """Return the scene with two corners elsewhere."""
    if isinstance(scene, ClipScene):
        clip = np.array(scene.clip)
        triangle, corner = generator.integers(len(clip), size=2), generator.integers(3, size=2)
        clip[triangle, corner] += generator.choice([0.0, 0.25, -0.5, 1.0], (2, 4))
        return replace(scene, clip=clip)
    meshes = list(scene.meshes)
    chosen = int(generator.integers(len(meshes)))
    positions = np.array(meshes[chosen].positions)
    positions[generator.integers(len(positions), size=2)] += generator.choice([0.0, 0.3, -1.0], (2, 3))
    meshes[chosen] = replace(meshes[chosen], positions=positions)
    return replace(scene, meshes=tuple(meshes))


@pytest.mark.parametrize("scene", MIXED, ids=name_of)
def test_a_draft_has_the_rows_of_the_triangle(scene: AnyScene) -> None:
    generator = np.random.default_rng(7)
    run = Settings(clipping="sutherland-hodgman"), 0
    found = trace(scene, *run)
    for _ in range(3):
        scene = moved_corners(scene, generator)
        found = draft(scene, found)
        assert isinstance(found.source, Draft)
        wanted = trace(scene, *run)
        for stage in ("transform", "clip", "edges", "bin", "raster", "interpolate", "shade"):
            columns = found.stage(stage).columns
            assert set(columns) == set(wanted.stage(stage).columns)
            for name, column in wanted.stage(stage).columns.items():
                assert columns[name].tobytes() == column.tobytes(), f"{stage}.{name}"
