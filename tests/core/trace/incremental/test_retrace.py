"""A trace after an edit is the trace made from nothing, bit for bit; only what changed is looked at again."""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any
from weakref import ref

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import STAGES, ClipScene, Material, PointLight, Settings, trace
from core.methods import table
from core.scene import AnyScene
from core.settings import families
from core.trace import Trace, source
from core.trace.incremental.draft import Draft, draft
from core.trace.incremental.retrace import Retrace
from tests.core.strategies import ANY_TRIANGLES
from tests.core.trace.trace_cases import EACH_METHOD, SCENES, name_of, settings_of, small_region
from tests.covering import in_turn

MIXED = [SCENES[name] for name in ("clip", "textured-clip", "lit", "orthographic", "shared-edge")]


def check_same(found: Any, wanted: Any, path: str) -> None:
    """Compare everything in two values, arrays by their bits."""
    assert type(found) is type(wanted), path
    if isinstance(wanted, np.ndarray):
        assert found.dtype == wanted.dtype, path
        assert found.shape == wanted.shape, path
        if wanted.dtype.hasobject:
            assert (found == wanted).all(), path
        else:
            assert found.tobytes() == wanted.tobytes(), path
    elif isinstance(wanted, Mapping):
        assert set(found) == set(wanted), path
        for name, value in wanted.items():
            check_same(found[name], value, f"{path}.{name}")
    elif isinstance(wanted, tuple | list):
        assert len(found) == len(wanted), path
        for number, value in enumerate(wanted):
            check_same(found[number], value, f"{path}[{number}]")
    elif is_dataclass(wanted) and not isinstance(wanted, Settings):
        for field in fields(wanted):
            check_same(getattr(found, field.name), getattr(wanted, field.name), f"{path}.{field.name}")
    elif not callable(wanted):
        assert found == wanted or (found != found and wanted != wanted), path


def check_trace(found: Trace, wanted: Trace) -> None:
    """Compare every stage of two traces, with all their buffers."""
    for stage in STAGES:
        check_same(found.stage(stage), wanted.stage(stage), stage)


# Edits: a scene, settings and a generator of random numbers to another scene and other settings.


def moved_corners(scene: AnyScene, generator: np.random.Generator, count: int = 1) -> AnyScene:
    """Return the scene with some corners elsewhere."""
    if isinstance(scene, ClipScene):
        clip = np.array(scene.clip)
        triangle, corner = generator.integers(len(clip), size=count), generator.integers(3, size=count)
        clip[triangle, corner] += generator.choice([0.0, 0.25, -0.5, 1.0], (count, 4))
        return replace(scene, clip=clip)
    meshes = list(scene.meshes)
    chosen = int(generator.integers(len(meshes)))
    positions = np.array(meshes[chosen].positions)
    positions[generator.integers(len(positions), size=count)] += generator.choice(
        [0.0, 0.3, -1.0], (count, 3)
    )
    meshes[chosen] = replace(meshes[chosen], positions=positions)
    return replace(scene, meshes=tuple(meshes))


def changed_values(scene: AnyScene, generator: np.random.Generator) -> AnyScene:
    """Return the scene with another colour, texture coordinate, light or material."""
    if isinstance(scene, ClipScene):
        attributes = np.array(scene.attributes)
        attributes[generator.integers(len(attributes)), generator.integers(3)] *= 0.5
        return replace(scene, attributes=attributes)
    if generator.random() < 0.5:
        return replace(scene, lights=(PointLight(generator.random(3) + 1),))
    changed = replace(scene.meshes[0], material=Material(0.1, 0.5, 0.4, float(generator.integers(1, 9))))
    return replace(scene, meshes=(changed, *scene.meshes[1:]))


def swapped_triangles(scene: AnyScene, generator: np.random.Generator) -> AnyScene:
    """Return the scene with its triangles in another order, or some of them gone."""
    if isinstance(scene, ClipScene):
        assert scene.attributes is not None
        order = generator.permutation(len(scene.clip))[: int(generator.integers(1, len(scene.clip) + 1))]
        return ClipScene(scene.clip[order], scene.attributes[order], scene.size, scene.texture)
    changed = replace(scene.meshes[0], triangles=scene.meshes[0].triangles[::-1])
    return replace(scene, meshes=(changed, *scene.meshes[1:]))


EDITS = {
    "nothing": lambda scene, generator: replace(scene),
    "one corner": moved_corners,
    "corners": lambda scene, generator: moved_corners(scene, generator, 3),
    "values": changed_values,
    "order": swapped_triangles,
    "size": lambda scene, generator: replace(scene, size=(scene.size[0] + 1, scene.size[1])),
}


@st.composite
def any_settings(draw) -> dict[str, Any]:
    """Draw a method of each of a few families."""
    names = draw(st.lists(st.sampled_from(families()), max_size=5, unique=True))
    return {family: draw(st.sampled_from(table.names(family))) for family in names}


def prepared(scene: AnyScene, choice: dict[str, Any], looked_at: list[str], **how: Any) -> Trace:
    """Return a trace of which some stages have been looked at."""
    traced = trace(scene, settings_of(choice, scene), **how)
    for stage in looked_at:
        traced.stage(stage)
    return traced


LOOKED_AT = st.lists(st.sampled_from(STAGES), min_size=1, max_size=4, unique=True)


@given(ANY_TRIANGLES, any_settings(), st.sampled_from(list(EDITS)), LOOKED_AT, st.integers(0, 1 << 20))
def test_any_edit_of_any_triangles_gives_the_trace_made_from_nothing(drawn, choice, edit, looked_at, seed):
    clip, size = drawn
    generator = np.random.default_rng(seed)
    scene = ClipScene(clip, generator.random((len(clip), 3, 5)), size)
    earlier = prepared(scene, choice, looked_at)
    edited = EDITS[edit](scene, generator)
    settings = settings_of(choice, scene)
    check_trace(trace(edited, settings, earlier=earlier), trace(edited, settings))


@given(
    st.sampled_from(MIXED), any_settings(), st.sampled_from(list(EDITS)), LOOKED_AT, st.integers(0, 1 << 20)
)
def test_any_edit_of_a_scene_gives_the_trace_made_from_nothing(scene, choice, edit, looked_at, seed):
    earlier = prepared(scene, choice, looked_at, region=small_region(scene))
    edited = EDITS[edit](scene, np.random.default_rng(seed))
    settings, region = settings_of(choice, scene), small_region(scene)
    check_trace(
        trace(edited, settings, region=region, earlier=earlier), trace(edited, settings, region=region)
    )


@pytest.mark.parametrize(
    ("name", "choice"), in_turn(["clip", "lit", "textured-clip"], EACH_METHOD), ids=name_of
)
def test_a_moved_corner_with_every_method(name, choice):
    scene = SCENES[name]
    region = small_region(scene)
    earlier = prepared(scene, choice, list(STAGES), region=region)
    edited = moved_corners(scene, np.random.default_rng(4))
    settings = settings_of(choice, scene)
    check_trace(
        trace(edited, settings, region=region, earlier=earlier), trace(edited, settings, region=region)
    )


@given(any_settings(), any_settings(), st.sampled_from([None, 0, 1]), st.sampled_from([None, (1, 1, 5, 4)]))
def test_other_settings_another_focus_or_raster_give_the_trace_made_from_nothing(
    first, second, triangle, region
):
    scene = SCENES["clip"]
    earlier = prepared(scene, first, ["raster", "blend"])
    how: dict[str, Any] = {"triangle": triangle, "region": region}
    settings = settings_of(second, scene)
    check_trace(trace(scene, settings, earlier=earlier, **how), trace(scene, settings, **how))


def test_edits_one_after_another_give_the_trace_made_from_nothing():
    generator = np.random.default_rng(8)
    scene: AnyScene = SCENES["clip"]
    earlier = prepared(scene, {"fill": "brute-force"}, ["raster"])
    for number in range(8):
        scene = moved_corners(scene, generator)
        traced = trace(scene, Settings(fill="brute-force"), earlier=earlier)
        for stage in STAGES[: 6 + number % 4]:
            traced.stage(stage)
        earlier = traced
    check_trace(earlier, trace(scene, Settings(fill="brute-force")))


# What is looked at again.


def grid(count: int = 4) -> ClipScene:
    """Return triangles that share no corner, one in each square of a grid."""
    corner = np.stack(np.meshgrid(np.arange(count), np.arange(count)), axis=-1).reshape(-1, 1, 2)
    window = (corner + np.array([[0.1, 0.1], [0.8, 0.2], [0.3, 0.9]])) * 2 / count - 1
    depth = np.broadcast_to([0.25, 1.0], window.shape)
    clip = np.concatenate([window, depth], axis=2)
    return ClipScene(clip, np.random.default_rng(1).random((len(clip), 3, 4)), (32, 32))


def pulled(scene: ClipScene, triangle: int, way: float = 0.02) -> ClipScene:
    """Return the scene with corner 0 of a triangle moved to the right."""
    clip = np.array(scene.clip)
    clip[triangle, 0, 0] += way
    return replace(scene, clip=clip)


@pytest.fixture
def examined(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return the list of primitives whose pixels are examined, once for each pixel."""
    found: list[int] = []
    examine = source.examine_pixels

    def count_and_examine(edges, runs, raster):
        tests = examine(edges, runs, raster)
        found.extend(tests.primitive.tolist())
        return tests

    monkeypatch.setattr(source, "examine_pixels", count_and_examine)
    return found


@pytest.mark.parametrize("fill", table.names("fill"))
def test_only_the_pixels_of_the_triangle_that_is_dragged_are_examined_again(fill, examined):
    scene, settings = grid(), Settings(fill=fill)
    earlier = trace(scene, settings)
    earlier.stage("raster")
    assert set(examined) == set(range(16))
    for _ in range(3):
        examined.clear()
        scene = pulled(scene, 6)
        traced = trace(scene, settings, earlier=earlier)
        for stage in STAGES:
            traced.stage(stage)
        earlier = traced
        assert set(examined) == {6}
        assert len(examined) == np.count_nonzero(earlier.source.tests.primitive == 6)


def test_of_what_did_not_change_the_very_numbers_are_kept():
    scene, settings = grid(), Settings(fill="brute-force")
    earlier = trace(scene, settings)
    before = earlier.stage("raster").columns
    after = trace(pulled(scene, 6), settings, earlier=earlier).stage("raster").columns
    assert all(after[name] is before[name] for name in ("column", "row", "x", "y", "start", "stop"))
    assert not np.array_equal(after["values"], before["values"])


def test_a_colour_that_changes_is_a_change_of_its_triangle_alone(examined):
    scene = grid()
    earlier = trace(scene)
    earlier.stage("shade")
    attributes = np.array(scene.attributes)
    attributes[3, 1, 0] = 0.75
    examined.clear()
    after = trace(replace(scene, attributes=attributes), earlier=earlier).stage("shade")
    assert set(examined) == {3}
    assert not np.array_equal(after.columns["color"], earlier.stage("shade").columns["color"])


@pytest.mark.parametrize("settings", [Settings(blend="over"), Settings(depth="inverse-w")], ids=str)
def test_other_settings_look_at_everything_again(settings, examined):
    earlier = trace(grid())
    earlier.stage("raster")
    examined.clear()
    trace(grid(), settings, earlier=earlier).stage("raster")
    assert set(examined) == set(range(16))


def test_a_reflectance_of_another_sign_is_another_one():
    scene, settings = SCENES["lit"], Settings(fill="brute-force")
    meshes = [
        tuple(replace(mesh, material=Material(zero, 0.5, 0.4, 8.0)) for mesh in scene.meshes)
        for zero in (0.0, -0.0)
    ]
    earlier = trace(replace(scene, meshes=meshes[0]), settings)
    earlier.stage("shade")
    edited = replace(scene, meshes=meshes[1])
    check_trace(trace(edited, settings, earlier=earlier), trace(edited, settings))


def test_a_triangle_that_is_culled_leaves_the_others_as_they_are(examined):
    scene, settings = grid(), Settings(cull="back")
    earlier = trace(scene, settings)
    earlier.stage("raster")
    clip = np.array(scene.clip)
    clip[6] = clip[6][::-1]
    examined.clear()
    after = trace(replace(scene, clip=clip), settings, earlier=earlier)
    assert 6 not in after.stage("raster").triangle
    assert not examined


def test_nothing_of_the_trace_before_is_kept_or_changed():
    scene, settings = grid(), Settings(fill="brute-force")
    earlier = trace(scene, settings)
    earlier.stage("raster")
    wanted = {name: column.copy() for name, column in earlier.stage("raster").columns.items()}
    after = trace(pulled(scene, 6), settings, earlier=earlier)
    after.stage("raster")
    check_same(dict(earlier.stage("raster").columns), wanted, "columns")
    run, stage = ref(earlier.source), ref(earlier.stage("raster"))
    del earlier
    assert run() is None
    assert stage() is None
    check_trace(after, trace(pulled(scene, 6), settings))


def test_what_is_asked_for_when_the_trace_before_is_gone_is_computed():
    earlier = trace(grid())
    earlier.stage("raster")
    after = trace(pulled(grid(), 6), earlier=earlier)
    assert isinstance(after.source, Retrace)
    del earlier
    check_trace(after, trace(pulled(grid(), 6)))
    assert after.source.number_before is None


@pytest.mark.parametrize("scene", MIXED, ids=name_of)
def test_a_draft_has_the_rows_of_the_triangle_and_a_trace_after_it_is_the_one_from_nothing(
    scene: AnyScene,
) -> None:
    generator = np.random.default_rng(7)
    run = Settings(clipping="sutherland-hodgman"), 0
    found = trace(scene, *run)
    for _ in range(3):
        scene = moved_corners(scene, generator, 2)
        found = draft(scene, found)
        assert isinstance(found.source, Draft)
        wanted = trace(scene, *run)
        for stage in ("transform", "clip", "edges", "bin", "raster", "interpolate", "shade"):
            check_same(found.stage(stage).columns, wanted.stage(stage).columns, stage)
    check_trace(trace(scene, *run, earlier=found), wanted)
