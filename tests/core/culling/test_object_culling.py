"""Culling of objects drops nothing that is seen, and asks fewer planes with a tree."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import STAGES, Settings, render, trace
from core.culling.culling import PLANE_COEFFICIENTS, PLANES
from core.culling.object_culling import OUTSIDE, ViewPlanes, box_against_planes, cull_objects, frustum
from core.methods import table
from core.records.frame import StageCount
from core.scene import Camera, Mesh, Scene
from core.stages.geometry import Geometry
from core.stages.vertices import process_geometry
from core.transform.vertex_stage import transform_vertices
from lessons.scenes import make_scene
from lessons.shapes import cube
from tests.core.trees.test_trees import BOXES, grown, objects_of

ORDERS = table.names("hierarchy")
PLACE = st.tuples(*[st.integers(-12, 12).map(lambda n: n / 2)] * 3)
SIDES = st.tuples(*[st.sampled_from([0.0, 0.25, 1.0, 3.0, 20.0])] * 3)


def boxes_scene(boxes, projection: str = "perspective", size: tuple[int, int] = (12, 9)) -> Scene:
    meshes = []
    for middle, sides in boxes:
        matrix = np.diag([*sides, 1.0])
        matrix[:3, 3] = middle
        meshes.append(replace(cube(1.0), transform=matrix))
    eye, target = np.array([0.3, 0.2, 0.1]), np.array([0.4, 0.1, -3.0])
    camera = Camera(eye, target, projection=projection, view_height=4.0, near=0.5, far=9.0)
    return Scene(tuple(meshes), camera, (), size)


def geometry(scene: Scene, **chosen) -> Geometry:
    return process_geometry(scene, Settings(**chosen), {stage: StageCount() for stage in STAGES})


def asked(scene: Scene, hierarchy: str, **chosen) -> Geometry:
    return geometry(scene, object_culling="frustum", hierarchy=hierarchy, **chosen)


@settings(max_examples=12)
@given(
    st.lists(st.tuples(PLACE, SIDES), min_size=1, max_size=6),
    st.sampled_from(["perspective", "orthographic"]),
)
def test_it_keeps_what_is_kept_without_it(boxes, projection: str) -> None:
    # The eye lies inside some boxes; some are flat, or a point.
    scene = boxes_scene(boxes, projection)
    kept = geometry(scene).culled.kept
    for hierarchy in ORDERS:
        culled = asked(scene, hierarchy, leaf_size=3, octree_depth=2).culled
        assert np.array_equal(culled.kept, kept)
        objects = culled.objects
        for triangle in np.flatnonzero(objects.is_dropped):
            holding = [
                n for n in np.flatnonzero(objects.tree.is_leaf) if triangle in objects.tree.items_of(n)
            ]
            assert (objects.sides.side[holding, objects.dropped_by[triangle]] == OUTSIDE).all()


@settings(max_examples=20)
@given(st.tuples(PLACE, SIDES), st.sampled_from(["perspective", "orthographic"]))
def test_a_box_is_dropped_where_all_of_its_corners_lie_outside_a_plane_exactly(box, projection: str) -> None:
    scene = boxes_scene([box], projection)
    objects = asked(scene, "none").culled.objects
    planes = [[Fraction(c) for c in row] for row in objects.planes.coefficients.tolist()]
    low, high = ([Fraction(c) for c in side[0].tolist()] for side in (objects.tree.lower, objects.tree.upper))
    corners = [[(low, high)[k >> axis & 1][axis] for axis in range(3)] for k in range(8)]
    outside = [
        all(sum(a * b for a, b in zip(plane, [*corner, 1], strict=True)) < 0 for corner in corners)
        for plane in planes
    ]
    # Nearer to a plane than rounding may be, a box is kept.
    near = np.abs(objects.sides.far[0]) < 2 * objects.sides.slack[0]
    found = objects.sides.side[0] == OUTSIDE
    assert (found == np.array(outside))[~near].all()
    assert not (found & ~np.array(outside)).any()


@pytest.mark.parametrize("hierarchy", ORDERS)
def test_the_picture_is_the_same_and_no_triangle_of_a_dropped_box_is_tested(hierarchy: str) -> None:
    scene = make_scene("boxes-around")
    chosen = Settings(object_culling="frustum", hierarchy=hierarchy, leaf_size=16, octree_depth=2)
    plain, frame = render(scene), render(scene, chosen)
    assert np.array_equal(plain.color, frame.color)
    assert np.array_equal(plain.depth, frame.depth)
    run = trace(scene, chosen)
    culled, cull = run.source.geometry.culled, run.stage("cull")
    kinds = [cull.steps.kinds.index(kind) for kind in ("behind", "with-its-box")]
    tested = [set(cull.triangle[cull.steps.kind == kind]) for kind in kinds]
    dropped = set(np.flatnonzero(culled.objects.is_dropped))
    assert tested == [set(range(120)) - dropped, dropped]
    # A triangle of the wall lies in many cells of an octree, outside of different planes.
    assert len(dropped) >= (30 if hierarchy != "octree" else 1)


def test_plane_tests_of_four_hundred_boxes() -> None:
    """The slide's example: boxes around a viewer, asked one by one."""
    rng = np.random.default_rng(3)
    middle = rng.uniform(-50, 50, (400, 3))
    middle[:, 1] = rng.uniform(-2, 2, 400)
    shape = cube(1.0)
    meshes = tuple(Mesh(shape.positions + place, shape.triangles) for place in middle)
    eye = np.array([0, 1.6, 0.0])
    camera = Camera(eye, np.array([0, 1.6, -1.0]), near=0.5, far=60, field_of_view=np.radians(45))
    objects = asked(Scene(meshes, camera, (), (64, 48)), "none").culled.objects
    assert (len(objects.plane), int((~objects.is_dropped).sum()) // 12) == (1058, 69)
    assert objects.one_by_one_count == 1058


def test_a_mesh_that_is_moved_by_a_projection_is_refused() -> None:
    scene = boxes_scene([((0, 0, -3), (1, 1, 1))])
    bent = scene.meshes[0].transform.copy()
    bent[3, 2] = 0.1
    with pytest.raises(ValueError, match="needs meshes in world space, where w is 1: the matrix of a mesh"):
        render(
            replace(scene, meshes=(replace(scene.meshes[0], transform=bent),)),
            Settings(object_culling="frustum"),
        )


def test_planes_are_asked_in_the_order_of_their_names() -> None:
    objects = asked(make_scene("boxes-around"), "bvh").culled.objects
    first = np.flatnonzero(np.diff(objects.visit, prepend=-1))
    assert (objects.plane[first[:1]] == PLANES.index("near")).all()
    assert (np.diff(objects.plane) > 0)[np.diff(objects.visit) == 0].all()


WHOLE = st.integers(-3, 3)
PLANES_IN_WHOLE_NUMBERS = st.lists(st.tuples(WHOLE, WHOLE, WHOLE, st.integers(0, 9)), min_size=6, max_size=6)


@given(BOXES, PLANES_IN_WHOLE_NUMBERS, st.sampled_from(ORDERS))
def test_the_walk_is_that_of_the_listing_where_boxes_touch_planes_too(boxes, rows, hierarchy: str) -> None:
    # In halves and whole numbers nothing is rounded: corners lie in planes exactly.
    objects = objects_of(boxes)
    tree = grown(hierarchy, objects)
    planes = ViewPlanes(np.array(rows, float), np.abs(np.array(rows, float)))
    found = cull_objects(tree, frustum, planes, len(objects))
    walked, asked = [], 0

    def walk(node: int, open_planes: list[int]) -> None:
        nonlocal asked
        box = tree.lower[node].tolist(), tree.upper[node].tolist()
        verdict, crossed = box_against_planes(*box, rows, found.sides.slack[node], open_planes)
        sides = [found.sides.side[node, k] for k in open_planes]
        asked += sides.index(OUTSIDE) + 1 if verdict == "outside" else len(sides)
        walked.append((node, ("outside", "inside", "crossing").index(verdict)))
        for child in tree.children(node) if verdict == "crossing" else []:
            walk(child, crossed)

    root = 0
    while root < len(tree):
        walk(root, list(range(6)))
        root = int(tree.subtree_end[root])
    assert walked == list(zip(found.visited.tolist(), found.verdict.tolist(), strict=True))
    assert asked == len(found.plane)


@given(st.tuples(PLACE, SIDES), st.sampled_from(["perspective", "orthographic"]))
def test_a_distance_is_rounded_by_no_more_than_its_slack(box, projection: str) -> None:
    scene = boxes_scene([box], projection)
    objects, stage = asked(scene, "none").culled.objects, transform_vertices(scene)
    matrices = [
        [[Fraction(number) for number in row] for row in matrix.tolist()]
        for matrix in (PLANE_COEFFICIENTS, stage.projection, stage.view)
    ]
    exact = matrices[0]
    for matrix in matrices[1:]:
        exact = [
            [sum(a * b for a, b in zip(row, column, strict=True)) for column in zip(*matrix, strict=True)]
            for row in exact
        ]
    low, high = ([Fraction(c) for c in side[0].tolist()] for side in (objects.tree.lower, objects.tree.upper))
    for k, (*normal, d) in enumerate(exact):
        far = d + sum(max(n * a, n * b) for n, a, b in zip(normal, low, high, strict=True))
        assert abs(Fraction(objects.sides.far[0, k]) - far) <= Fraction(objects.sides.slack[0, k])
