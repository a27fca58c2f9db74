"""Culling behind occluders drops nothing that is seen, whatever is drawn how."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import STAGES, ClipScene, Settings, render, trace
from core.culling.object_culling import OUTSIDE, ObjectCulling
from core.culling.occlusion import BoxesOnScreen, compare_with_pyramid, occlusion, pyramid_of
from core.fast_path.draw import draw_picture
from core.methods import table
from core.records.frame import StageCount
from core.records.passes import PlannedPass
from core.resolved import resolve
from core.scene import Camera, Mesh, Scene
from core.stages.fragments import nearest_stored
from core.stages.geometry import farthest_from_grid
from core.stages.needs import refusal
from core.stages.object_tree import BEYOND
from core.stages.passes import drawn_depth, planned_passes
from core.stages.vertices import process_geometry
from core.study.planner.planning import look_at
from core.trace.source import TraceSource
from lessons.scenes import make_scene
from lessons.shapes import cube
from lessons.world_scenes import box_in_light
from tests.core.culling.test_object_culling import PLACE, SIDES, boxes_scene
from tests.core.trace.geometry_listings import check_cull

BEHIND = Settings(object_culling="occlusion", hierarchy="none", occluders=1, shading="unlit")
FRONT = ((0.4, 0.1, -2.0), (3.0, 2.0, 0.25))
"""Middle and sides of a wall before most of the other boxes."""
CHOICES = st.fixed_dictionaries(
    {
        "occluders": st.sampled_from([1, 3, 32]),
        "hierarchy": st.sampled_from(table.names("hierarchy")),
        "leaf_size": st.sampled_from([1, 12]),
        "octree_depth": st.just(2),
        "depth": st.sampled_from(table.names("depth")),
        "cull": st.sampled_from(["none", "back"]),
        "clipping": st.sampled_from(table.names("clipping")),
        "coverage": st.sampled_from(["snapped", "float64", "float32"]),
        "fill": st.sampled_from(["spans", "bounding-box", "scanline-lecture"]),
        "pixel_center": st.sampled_from(["half", "integer"]),
        "depth_test_time": st.sampled_from(table.names("depth_test_time")),
    }
)


def same_picture(scene: Scene, chosen: Settings) -> bool:
    plain = replace(chosen, object_culling="none")
    found, wanted = render(scene, chosen), render(scene, plain)
    names = ("color", "depth", "primitive")
    return all(np.array_equal(getattr(found, name), getattr(wanted, name)) for name in names)


def culled(scene: Scene, chosen: Settings) -> ObjectCulling:
    objects = process_geometry(scene, chosen, {stage: StageCount() for stage in STAGES}).culled.objects
    assert objects is not None
    return objects


@settings(max_examples=40)
@given(
    st.lists(st.tuples(PLACE, SIDES), min_size=1, max_size=6),
    st.sampled_from(["perspective", "orthographic"]),
    st.integers(-2, 2),
    CHOICES,
)
def test_the_picture_is_the_same_bit_for_bit(boxes, projection: str, turn: int, chosen) -> None:
    # The eye lies inside some boxes; some are flat, or a point; some touch the wall, or lie in its plane.
    scene = boxes_scene([*boxes, FRONT], projection, (13, 9))
    matrix = scene.meshes[0].transform.copy()
    matrix[:3, :3] = np.array([[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]]) @ matrix[:3, :3]
    scene = replace(
        scene, meshes=(*np.roll([replace(scene.meshes[0], transform=matrix), *scene.meshes[1:]], turn),)
    )
    picked = replace(BEHIND, **chosen)
    if not refusal("depth", picked.depth, scene):
        assert same_picture(scene, picked)


def random_boxes(count: int) -> Scene:
    """Return a wall before many boxes, those of the catalogue."""
    rng = np.random.default_rng(5)
    middle = np.column_stack(
        [rng.uniform(-12, 12, count), rng.uniform(-3, 3, count), rng.uniform(-30, -12, count)]
    )
    wall = cube(1.0)
    wall = replace(wall, positions=wall.positions * (8, 8, 0.2) + (-1, 0, -8.1))
    small = [replace(cube(0.8), positions=cube(0.8).positions + place) for place in middle]
    camera = Camera(np.zeros(3), np.array([0, 0, -1.0]), near=1, far=60)
    return Scene((wall, *small), camera, (), (128, 96))


def test_a_wall_before_two_hundred_boxes() -> None:
    scene = random_boxes(200)
    assert same_picture(scene, BEHIND)
    found = culled(scene, BEHIND).occlusion
    seen = np.unique(render(scene, Settings(shading="unlit")).primitive // 12)
    compared, hidden = found.boxes.node[1:], found.boxes.node[found.tests.is_hidden]
    texels = (found.tests.texels[..., 0] >= 0).sum(axis=1)[1:]
    assert (len(compared), len(np.setdiff1d(compared, seen)), len(hidden)) == (181, 159, 150)
    assert found.boxes.node[found.occluders].tolist() == [0]
    assert not np.isin(hidden, seen).any()
    assert round(float(texels.mean()), 2) == 3.68
    # With the nearest of 2 x 2 in the pyramid, one that looks out beside the wall is dropped, too.
    nearest = compare_with_pyramid(found.boxes, pyramid_of(found.tests.pyramid[0], np.minimum), False)
    assert np.isin(found.boxes.node[nearest.is_hidden], seen).sum() == 1


@given(st.integers(1, 9), st.integers(1, 9), st.booleans(), st.randoms(use_true_random=False))
def test_nothing_in_a_rectangle_is_farther_than_what_is_read_of_it(width, height, reverse, random) -> None:
    depth = np.array([[random.randint(0, 9) for _ in range(width)] for _ in range(height)], float)
    left, right = sorted(random.randrange(width) for _ in range(2))
    low, high = sorted(random.randrange(height) for _ in range(2))
    nearest = np.array([random.randint(0, 9)], float)
    rectangle = np.array([[left, low, right, high]])
    nothing = np.zeros((1, 8, 3)), 0.0, (width, height), rectangle, np.zeros(1), nearest
    one = BoxesOnScreen(np.array([0]), np.array([False]), *nothing)
    found = occlusion(one, depth, reverse)
    inside = depth[low : high + 1, left : right + 1]
    farthest = inside.min() if reverse else inside.max()
    sign = -1 if reverse else 1
    assert sign * found.farthest[0] >= sign * farthest
    assert found.is_hidden[0] == (sign * nearest[0] > sign * found.farthest[0])
    level = int(found.level[0])
    assert found.farthest[0] == (min if reverse else max)(found.stored[0][~np.isnan(found.stored[0])])
    assert (
        level == 0
        or (right >> level - 1) - (left >> level - 1) > 1
        or (high >> level - 1) - (low >> level - 1) > 1
    )


@settings(max_examples=20)
@given(
    st.lists(st.tuples(PLACE, SIDES), min_size=1, max_size=3),
    st.sampled_from(table.names("depth")),
    st.booleans(),
)
def test_no_fragment_of_a_box_is_nearer_or_elsewhere_than_its_box_says(
    boxes, depth: str, is_parallel
) -> None:
    scene = boxes_scene(boxes, "orthographic" if is_parallel else "perspective", (23, 17))
    if refusal("depth", depth, scene):
        return
    chosen = replace(BEHIND, depth=depth)
    found = culled(scene, chosen).occlusion
    depth_format = resolve(chosen).depth_format
    for place in np.flatnonzero(~found.boxes.is_before).tolist():
        alone = replace(scene, meshes=(scene.meshes[found.boxes.node[place]],))
        frame = render(alone, replace(chosen, object_culling="none"))
        rows, columns = np.nonzero(frame.primitive >= 0)
        left, low, right, high = found.boxes.rectangle[place]
        assert ((columns >= left) & (columns <= right) & (rows >= low) & (rows <= high)).all()
        nearest = np.array(found.boxes.nearest[place], frame.depth.dtype)
        assert not depth_format.is_nearer(frame.depth[rows, columns], nearest).any()


@pytest.mark.parametrize(
    ("chosen", "why"),
    [
        ({"blend": "over"}, "blended"),
        ({"visibility": "painters"}, "tests no depth"),
        ({"polygon_mode": "wireframe"}, "no area"),
        *(({"antialiasing": name}, "beside the centres") for name in ("msaa-4", "ssaa-4", "temporal")),
        ({"antialiasing": "area"}, "covered area"),
        ({"coverage": "float16"}, "beside a triangle"),
        ({"fill": "scanline-lecture"}, "beside a triangle"),
    ],
)
def test_where_what_is_behind_may_be_seen_there_are_no_occluders(chosen: dict[str, str], why: str) -> None:
    scene, picked = make_scene("boxes-behind-wall"), replace(BEHIND, **chosen)
    found = culled(scene, picked).occlusion
    assert why in found.why_none
    assert not found.tests.is_hidden.any()
    told = trace(scene, picked).stage("cull")
    [row] = np.flatnonzero(told.steps.kind == told.steps.kinds.index("no-occluder"))
    assert told.columns["why_none"][row] == found.why_none
    assert planned_passes(scene, picked) == ()
    assert same_picture(scene, picked)


def test_an_edited_listing_has_no_occluders_but_one_of_boxes_has() -> None:
    scene = make_scene("boxes-behind-wall")
    assert culled(scene, BEHIND).is_hidden.sum() == 36
    twice = BEHIND.replaced(object_culling=lambda *given: occlusion(*given))
    assert culled(scene, twice).is_hidden.sum() == 36
    other = BEHIND.replaced(fill_rule=lambda a, b: a > a)
    found = culled(scene, other).occlusion
    assert "edited" in found.why_none


def test_the_occluders_are_a_pass_beside_others() -> None:
    scene = replace(box_in_light(), size=(32, 24))
    chosen = Settings(
        shadow="map", map_size=16, depth_test_time="prepass", object_culling="occlusion", leaf_size=12
    )
    planned = planned_passes(scene, chosen)
    assert [each.name for each in planned] == ["shadow-map", "prepass", "occluders"]
    assert np.array_equal(drawn_depth(planned[2]), render(planned[2].scene, planned[2].settings).depth)
    assert planned_passes(scene, chosen)[2] is planned[2]
    assert same_picture(scene, chosen)
    with pytest.raises(
        ValueError, match="a pass must need no pass itself, got one with object_culling occlusion"
    ):
        PlannedPass("occluders", "itself", scene, BEHIND)


@pytest.mark.parametrize("antialiasing", table.names("antialiasing"))
def test_samples_beside_the_centres_are_drawn_without_occluders(antialiasing: str) -> None:
    scene = replace(make_scene("boxes-behind-wall"), size=(32, 24))
    chosen = replace(BEHIND, antialiasing=antialiasing, pixel_center="integer", pictures=2)
    assert same_picture(scene, chosen)
    frame, run = render(scene, chosen), trace(scene, chosen)
    is_plain = antialiasing in ("none", "fxaa")
    assert (frame.statistics["cull"].outgoing < 80) == is_plain
    assert (int(run.stage("cull").marks["covered"].sum()) < 80) == is_plain


def test_what_the_window_draws_is_what_is_rendered() -> None:
    scene = make_scene("boxes-behind-wall")
    with_it, without = (
        draw_picture(scene, chosen) for chosen in (BEHIND, replace(BEHIND, object_culling="none"))
    )
    assert np.array_equal(with_it.pixels, without.pixels)


@pytest.mark.parametrize(
    ("depth", "hierarchy"), [("z-16", "none"), ("reversed-z", "bvh"), ("fixed-38", "octree")]
)
def test_the_listings_give_the_rows(depth: str, hierarchy: str) -> None:
    chosen = replace(BEHIND, depth=depth, hierarchy=hierarchy, leaf_size=4, octree_depth=4, occluders=8)
    run = trace(make_scene("boxes-behind-wall"), chosen)
    check_cull(run)
    cull, hidden = run.stage("cull"), run.source.geometry.culled.objects.is_hidden
    named = cull.triangle[cull.steps.kind == cull.steps.kinds.index("behind-occluders")]
    assert named.tolist() == np.flatnonzero(hidden).tolist()
    assert hidden.any()


def test_scenes_without_meshes_have_nothing_to_hide_with() -> None:
    corners = [[[-1, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]]]
    assert planned_passes(ClipScene(np.array(corners, float), size=(4, 4)), BEHIND) == ()


@pytest.mark.parametrize("number", [0, 1025, 1.5, True])
def test_a_number_of_occluders_that_is_none_is_refused(number: object) -> None:
    with pytest.raises(ValueError, match="occluders must be a whole number from 1 to 1024, got"):
        replace(BEHIND, occluders=number)


def test_the_plan_counts_what_the_largest_meshes_hide() -> None:
    facts = {fact.name: fact for fact in look_at(make_scene("boxes-behind-wall")).facts}
    assert (facts["hidden"].text, "4 large meshes" in facts["hidden"].title) == ("36 of 108", True)
    assert "hidden" not in {fact.name for fact in look_at(make_scene("fan")).facts}


@pytest.mark.parametrize("depth", table.names("depth"))
def test_no_fragment_of_thin_or_flat_triangles_is_nearer_than_its_bound(depth: str) -> None:
    # Thin ones along lines through pixel centres, whose depth grows by all of it in a pixel, and almost flat ones.
    random = np.random.default_rng(3)
    start, along = random.integers(2, 30, (400, 1, 2)) + 0.5, [(6, 0), (0, 6), (6, 6), (6, -6), (8, 4)]
    ends = start + random.choice(along, 400)[:, None] * np.array([0, 1, 0.5])[:, None]
    thin, flat = ends + random.normal(0, 0.004, (400, 3, 2)), random.uniform(-10, 42, (30, 3, 2))
    window = np.concatenate([thin, flat])
    almost = random.uniform(0.2, 0.9, (30, 1)) + random.uniform(0, 1e-10, (30, 3))
    z, w = np.concatenate([random.uniform(0.05, 0.95, (400, 3)), almost]), random.uniform(1, 4, (430, 3))
    w[400:] = 1
    clip = np.concatenate(
        [(window / 16 - 1) * w[..., None], ((2 * z - 1) * w)[..., None], w[..., None]], axis=-1
    )
    source = TraceSource(ClipScene(clip, size=(32, 32)), Settings(depth=depth))
    geometry, depth_format = source.geometry, resolve(source.settings).depth_format
    reach = BEYOND + farthest_from_grid(
        geometry.window, geometry.primitives.vertex_clip, (32, 32), (0.0, 0.0)
    )
    _, keeps, stored = source.depths

    def nearer(reach: float, rounding: float = 0.0) -> int:
        bound = nearest_stored(geometry, depth_format, reach) + stored.dtype.type(rounding)
        bound = bound.astype(stored.dtype)[source.fragments.primitive]
        return int(depth_format.is_nearer(stored, bound)[keeps].sum())

    assert keeps.sum() > 1000
    assert nearer(reach) == 0
    # Without the way that snapping takes a corner, or the rounding of integer planes, some are nearer.
    assert nearer(0.0, 65 / 2 if depth == "fixed-38" else 0.0) > 0


def test_a_triangle_is_dropped_only_where_all_of_its_cells_are_hidden() -> None:
    bar, wall = ((2.0, 0.2, -5.0), (6.0, 0.5, 0.5)), ((0.0, 0.1, -2.0), (1.0, 2.0, 0.25))
    scene = boxes_scene([bar, wall], "perspective", (32, 24))
    chosen = replace(BEHIND, hierarchy="octree", leaf_size=1, octree_depth=4, occluders=64)
    objects = culled(scene, chosen)
    hidden = objects.occlusion.boxes.node[objects.occlusion.tests.is_hidden]
    listed = np.unique(np.concatenate([objects.tree.items_of(node) for node in hidden.tolist()]))
    assert np.isin(listed, render(scene, chosen).primitive).any()
    assert objects.is_hidden.any()
    assert same_picture(scene, chosen)


def test_boxes_in_what_lies_outside_a_plane_are_not_compared() -> None:
    objects = culled(make_scene("boxes-around"), replace(BEHIND, hierarchy="bvh", leaf_size=2))
    tree, outside = objects.tree, objects.visited[objects.verdict == OUTSIDE]
    inner = [node for node in outside.tolist() if not tree.is_leaf[node]]
    assert inner
    below = np.concatenate([np.arange(node, tree.subtree_end[node]) for node in outside])
    assert objects.occlusion.boxes.node.tolist() == np.setdiff1d(np.flatnonzero(tree.is_leaf), below).tolist()


@pytest.mark.parametrize("seed", [0, 4])
def test_plates_seen_edge_on_are_kept_where_snapping_takes_them_before_the_wall(seed: int) -> None:
    """The nearest depth of their boxes alone would not do: a hair beside such a plate its plane is before the wall."""
    random, across = np.random.default_rng(seed), np.tan(np.pi / 8) * 4 / 3
    distance, up = np.array([2.3, 2.3, 9.0, 9.0]), np.array([-0.2, 0.2, 0.2, -0.2])
    wall = replace(cube(1.0), positions=cube(1.0).positions * (8, 8, 0.1) + (0, 0, -2))
    plates = []
    for column in range(4, 28):
        x = ((column + 0.5) / 16 - 1 + random.normal(0, 0.002, 4) / 16) * across * distance
        places = np.stack([x, up * distance, -distance], axis=1)
        plates.append(Mesh(places, np.array([[0, 1, 2], [0, 2, 3]])))
    camera = Camera(np.zeros(3), np.array([0, 0, -1.0]), near=1, far=20, field_of_view=np.pi / 4)
    scene = Scene((wall, *plates), camera, (), (32, 24))
    assert (render(scene, BEHIND).primitive >= 12).any(), "one is seen through the wall"
    assert same_picture(scene, BEHIND)
    boxes = culled(scene, BEHIND).occlusion.boxes
    is_behind = boxes.node > 0
    assert (boxes.nearest + boxes.slack)[is_behind].min() > boxes.corners[0, :, 2].max()
