"""Vertices are placed and lit once for all triangles: the same numbers, bit for bit, as for every corner by itself."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera, ClipScene, DirectionalLight, Material, Mesh, PointLight, Scene, Settings
from core.coverage.edges import orient, set_up_edges
from core.coverage.snapping import place_corners
from core.culling.culling import plane_distances
from core.methods import table
from core.records.frame import StageCount
from core.shading.lighting import light_surface
from core.shading.shading import centroids
from core.stages.declared import STAGES
from core.stages.geometry import Geometry
from core.stages.vertices import process_geometry
from core.transform.matrices import rotation
from core.transform.vertex_stage import place_meshes, transform_vertices
from tests.core.shading.seen_sides import is_seen_from_behind

NUMBERS = st.one_of(
    st.sampled_from([0.0, -0.0, 1.0, -1.0, 0.5, 1e-300, -1e-30, 1e30, 1e60, -1e60]), st.floats(-4, 4)
)
CORNERS = st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS)
TRIANGLES = st.lists(st.tuples(CORNERS, CORNERS, CORNERS), min_size=1, max_size=6)
SIZES = st.sampled_from([(1, 1), (7, 4), (16, 16)])
LIGHTS = (DirectionalLight([1.0, -2.0, -0.5]), PointLight([0.5, 2.0, 3.0], [0.2, 0.9, 0.4]))


def geometry_of(scene, settings: Settings, chosen=None) -> Geometry:
    return process_geometry(scene, settings, {stage: StageCount() for stage in STAGES}, chosen)


def random_mesh(seed: int, **changes) -> Mesh:
    random = np.random.default_rng(seed)
    return Mesh(random.normal(size=(20, 3)), random.integers(0, 20, (30, 3)), **changes)


def random_scene(seed: int, meshes: tuple[Mesh, ...], projection: str = "perspective") -> Scene:
    # Near enough that some triangles cross the eye.
    eye = np.random.default_rng(seed).normal(size=3)
    return Scene(meshes, Camera(eye, [0.0, 0.1, 0.0], projection=projection), LIGHTS, size=(24, 16))


def assert_same(first, second) -> None:
    assert np.array_equal(first, second, equal_nan=True)


@given(TRIANGLES, SIZES, st.sampled_from(["snapped", "float64"]), st.sampled_from(["none", "back", "front"]))
def test_placed_vertices_against_placed_corners(triangles, size, coverage: str, faces: str) -> None:
    clip = np.array(triangles)
    settings = Settings(coverage=coverage, cull=faces)
    geometry = geometry_of(ClipScene(clip, size=size), settings)
    corners = place_corners(clip, size, coverage)
    assert_same(geometry.culled.facing, orient(corners))
    assert_same(geometry.culled.distances, plane_distances(clip))

    # What is drawn.
    kept = geometry.kept.triangle
    corners = place_corners(clip[kept], size, coverage)
    edges = set_up_edges(place_corners(clip[kept], size, coverage), settings.fill_rule)
    x, y = corners.decided.transpose(2, 1, 0)
    z, w = clip[kept, :, 2], clip[kept, :, 3]
    assert_same(geometry.window_x, x)
    assert_same(geometry.window_y, y)
    assert_same(geometry.is_projected, corners.is_projected.all(axis=1))
    assert_same(geometry.doubled_area, edges.doubled_area)
    assert_same(geometry.is_in_range, np.all((w > 0) & (z >= -w) & (z <= w), axis=1))
    with np.errstate(all="ignore"):
        assert_same(geometry.depth, ((z / w + 1) / 2).T)
    for name in ("a", "b", "c", "owns_tie", "doubled_area"):
        assert_same(getattr(geometry.edges, name), getattr(edges, name))


@pytest.mark.parametrize("clipping", ["homogeneous", "sutherland-hodgman"])
@pytest.mark.parametrize("seed", range(4))
def test_rows_are_those_of_the_pieces(seed: int, clipping: str) -> None:
    scene = random_scene(seed, (random_mesh(seed), random_mesh(seed + 9)))
    geometry = geometry_of(scene, Settings(clipping=clipping, cull="back"))
    clip = geometry.primitives.clip
    corners = place_corners(clip, scene.size, "snapped")
    assert_same(np.stack([geometry.window_x, geometry.window_y]), corners.decided.transpose(2, 1, 0))
    assert_same(geometry.doubled_area, orient(corners))
    assert_same(geometry.primitives.clip_of(np.arange(0, len(clip), 2)), clip[::2])
    for rows in (geometry.window_x, geometry.window_y, geometry.depth):
        assert rows.flags.c_contiguous
        assert rows.shape == (3, len(geometry.primitives))


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize("specular", [0.0, 0.25])
@pytest.mark.parametrize("shading", table.names("shading"))
def test_lit_vertices_against_lit_corners(shading: str, specular: float, projection: str) -> None:
    meshes = tuple(random_mesh(k, material=Material(specular=specular * k)) for k in range(3))
    scene = random_scene(5, meshes, projection)
    of_meshes = place_meshes(meshes)
    position, normal, corners = of_meshes.world[:, :3], of_meshes.normals, of_meshes.corners
    eye = scene.camera.eye
    seen_from = (
        centroids(position, corners) + np.zeros(3) + _backward(scene) if projection != "perspective" else eye
    )
    behind = is_seen_from_behind(position, normal, corners, seen_from)
    assert 0 < behind.sum() < len(behind)

    def light_at(at, facing, vertex):
        # One point at a time.
        found = []
        for place, direction, v in zip(at, facing, vertex, strict=True):
            viewpoint = eye if projection == "perspective" else place + _backward(scene)
            material = meshes[of_meshes.mesh_of_vertex[v]].material
            found.append(
                light_surface(place[None], direction[None], viewpoint, LIGHTS, material, two_sided=False)
            )
        return tuple(np.concatenate(lights) for lights in zip(*found, strict=True))

    expected = table.get("shading", shading).function(position, normal, corners, behind, light_at)
    for chosen in (None, np.array([7]), np.arange(3, 60, 2)):
        assembled = geometry_of(scene, Settings(shading=shading), chosen).assembled
        assert set(assembled.layout) == {"color", *expected}
        for name, values in expected.items():
            assert_same(assembled.varyings[..., assembled.layout[name]], values[assembled.triangle])


def _backward(scene: Scene) -> np.ndarray:
    return transform_vertices(scene).view[2, :3]


def test_a_moved_camera_keeps_what_does_not_depend_on_it() -> None:
    meshes = (random_mesh(1, material=Material(specular=0.0)),)
    first, second = random_scene(1, meshes), random_scene(2, meshes)
    before, after = transform_vertices(first), transform_vertices(second)
    assert before.world is after.world
    assert before.corners is after.corners
    assert not np.array_equal(before.clip, after.clip)
    values = [geometry_of(scene, Settings(shading="gouraud")).assembled.values for scene in (first, second)]
    assert values[0].rows is values[1].rows
    turned = (random_mesh(1, transform=rotation(np.array([0.0, 1.0, 0.0]), 0.5)),)
    assert transform_vertices(random_scene(1, turned)).world is not before.world


@pytest.mark.parametrize("visibility", table.names("visibility"))
def test_primitives_stay_in_drawing_order(visibility: str) -> None:
    scene = random_scene(3, (random_mesh(3),))
    settings = Settings(visibility=visibility, cull="back")
    clip = transform_vertices(scene).clip[transform_vertices(scene).corners]
    drawing = table.get("visibility", visibility).function(clip)
    if drawing.pieces is not None:
        return  # Its pieces have laws of their own.
    for chosen in (None, np.arange(2, 30, 3)):
        geometry = geometry_of(scene, settings, chosen)
        kept = geometry.assembled.triangle[geometry.culled.kept]
        assert geometry.kept.triangle.tolist() == [t for t in drawing.order if t in kept]


def test_nothing_is_lit_that_is_not_asked_for() -> None:
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(random_scene(4, (random_mesh(4),)), Settings(), counts)
    assert not {"values", "varyings", "clip"} & set(vars(geometry.kept))
    assert not {"edges", "planes", "corners"} & set(vars(geometry))
    before = counts["edges"].seconds
    assert len(geometry.edges) == len(geometry.primitives)
    assert counts["edges"].seconds > before


def test_time_of_nested_blocks_is_counted_once() -> None:
    outer, inner = StageCount(), StageCount()
    with outer, inner:
        sum(range(100_000))
    assert 0 <= outer.seconds < inner.seconds
    with pytest.raises(ZeroDivisionError), outer:
        raise ZeroDivisionError
    third = StageCount()
    with third:
        sum(range(1000))
    assert third.seconds > 0
