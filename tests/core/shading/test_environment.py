"""Environment maps: laws of reflection and of the cube, rays as referee in rational arithmetic, and what is refused."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import Material, Mesh, Scene, Settings, render, trace
from core.edits.edit import Edit, apply_edit
from core.fast_path.draw import draw_picture
from core.framebuffer.display import to_display
from core.pixel_history import why
from core.pixel_history.told import link_sentence
from core.records.listing import listing
from core.scene import Texture
from core.settings import no_effect
from core.shading.environment import direction_of, look_up_faces, place_on_cube, reflect
from core.shading.lighting import blinn_phong
from core.shading.measured_environment import facing_wall, in_texels, off_angles
from core.shading.mirror_rays import nearest_met
from core.stages.before_matrices import before_matrices
from core.stages.environment import drawn_faces, environment_passes, surroundings
from core.stages.passes import planned_passes
from core.study.planner.planning import look_at
from core.trace.source import TraceSource
from core.transform.matrices import projection, world_to_camera
from lessons.scenes import make_scene
from tests.core.trace.fragment_listings import check_shade

CUBE = make_scene("mirror-cube")
RNG = np.random.default_rng(33)


def unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def test_a_direction_comes_back_from_its_place_on_the_cube() -> None:
    directions = unit(RNG.normal(size=(20_000, 3)))
    face, place = place_on_cube(directions)
    back = unit(direction_of(face, place))
    assert np.abs(back - directions).max() < 4.5e-16
    assert (np.bincount(face, minlength=6) > 3000).all()
    assert ((place >= 0) & (place <= 1)).all()


def test_the_face_is_that_of_the_largest_component_without_its_sign() -> None:
    directions = np.array(
        [[3.0, 1, -2], [-3, 1, 2], [1, 4, -2], [1, -4, 2], [-1, 2, 5], [1, 2, -5], [-2, 2, 2]]
    )
    face, place = place_on_cube(directions)
    assert face.tolist() == [0, 1, 2, 3, 4, 5, 1]
    # To the right of +x runs z, of -x -z; up of +y runs z, of -y -z; to the right of +z runs -x.
    expected = [
        [1 / 6, 2 / 3],
        [1 / 6, 2 / 3],
        [5 / 8, 1 / 4],
        [5 / 8, 1 / 4],
        [0.6, 0.7],
        [0.6, 0.7],
        [0, 1],
    ]
    assert place == pytest.approx(np.array(expected))


@given(st.tuples(*[st.integers(-9, 9)] * 3), st.tuples(*[st.integers(-9, 9)] * 3))
def test_reflection_keeps_length_turns_the_normal_part_and_undoes_itself(n, v) -> None:
    # In rational arithmetic N.I and R are exact for N of any length: R = I - 2 (N.I) N / |N|^2.
    if not any(n) or not any(v):
        return
    normal, to_eye = unit(np.array([n], float)), np.array([v], float)
    n_dot_i, r = reflect(normal, to_eye)
    square = sum(part * part for part in n)
    along = Fraction(-sum(a * b for a, b in zip(n, v, strict=True)), square)
    exact = [-b - 2 * along * a for a, b in zip(n, v, strict=True)]
    assert r[0] == pytest.approx([float(part) for part in exact], abs=1e-14)
    assert np.linalg.norm(r) == pytest.approx(np.linalg.norm(to_eye))
    assert (r @ normal[0])[0] == pytest.approx(-n_dot_i[0], abs=1e-14)
    assert reflect(normal, -r)[1] == pytest.approx(-to_eye, abs=1e-13)


def test_a_texel_in_a_corner_sees_less_of_what_is_around() -> None:
    # The solid angle of a texel is 1 / |d|^3 of one in the middle, d with its largest component 1: at most 3^1.5 = 5.2,
    # 5.03 on 64 texels.
    size = 64
    edges = np.arange(size + 1) / size

    def solid(column: int, row: int) -> float:
        ends = [(edges[column + i], edges[row + j]) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
        corners = unit(direction_of(np.zeros(4, np.int64), np.array(ends)))
        found = 0.0
        for a, b, c in ((0, 1, 2), (0, 2, 3)):
            p, q, r = corners[[a, b, c]]
            found += 2 * np.arctan2(abs(p @ np.cross(q, r)), 1 + p @ q + q @ r + r @ p)
        return found

    corner = (1 + 2 * (1 - 1 / size) ** 2) ** 1.5
    assert solid(32, 32) / solid(0, 0) == pytest.approx(corner, rel=0.002)
    assert 3**1.5 * 0.96 < corner < 3**1.5
    whole = sum(solid(column, row) for column in range(size) for row in range(size))
    assert whole == pytest.approx(4 * np.pi / 6)


def test_pictures_of_the_passes_lie_where_directions_look() -> None:
    # The camera of each face takes a point in the direction of a place to this place of its picture.
    for face, planned in enumerate(environment_passes(CUBE, Settings(environment_size=16), 1)):
        camera, places = planned.scene.camera, RNG.uniform(0.02, 0.98, (50, 2))
        points = camera.eye + 3 * direction_of(np.full(50, face), places)
        clip = np.column_stack([points, np.ones(50)]) @ (projection(camera, 1.0) @ world_to_camera(camera)).T
        assert (clip[:, :2] / clip[:, 3:] + 1) / 2 == pytest.approx(places)
        assert planned.scene.meshes == (CUBE.meshes[0], CUBE.meshes[2]), "the mirror is left out"


@pytest.mark.parametrize(
    ("size", "seam", "largest_seam", "change"), [(16, 0.127, 0.195, 0.510), (64, 0.031, 0.048, 0.128)]
)
def test_across_a_border_of_two_faces_the_colour_jumps_by_less_than_neighbours_differ(
    size, seam, largest_seam, change
) -> None:
    def shown(d: np.ndarray) -> np.ndarray:
        x, y, z = np.moveaxis(unit(d), -1, 0)
        return np.sin(3 * x) + np.cos(4 * y + z)

    middle = (np.arange(size) + 0.5) / size
    places = np.stack(np.meshgrid(middle, middle), axis=-1).reshape(-1, 2)
    faces = [
        Texture(shown(direction_of(np.full(size**2, face), places)).reshape(size, size, 1))
        for face in range(6)
    ]
    t, e = RNG.uniform(-1, 1, 20_000), 1e-9
    jumps = []
    for first in range(3):
        for sides in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            here, there = np.empty((2, len(t), 3))
            second, third = (first + 1) % 3, (first + 2) % 3
            here[:, third] = there[:, third] = t
            here[:, first], here[:, second] = sides[0], sides[1] * (1 - e)
            there[:, first], there[:, second] = sides[0] * (1 - e), sides[1]
            colors = [look_up_faces(faces, *place_on_cube(d))[0][:, 0] for d in (here, there)]
            jumps.append(np.abs(colors[0] - colors[1]).max())
    texels = np.array([face.pixels[..., 0] for face in faces])
    largest = max(np.abs(np.diff(texels, axis=axis)).max() for axis in (1, 2))
    assert largest == pytest.approx(change, abs=0.001)
    assert jumps[0] == pytest.approx(seam, abs=0.001)
    assert max(jumps) == pytest.approx(largest_seam, abs=0.001)
    assert max(jumps) <= largest / 2


@pytest.mark.parametrize(
    ("distance", "degrees", "texels"), [(1, 26.6, 18.9), (4, 7.1, 5.1), (100, 0.29, 0.20)]
)
def test_what_is_near_is_looked_up_elsewhere(distance: float, degrees: float, texels: float) -> None:
    beside = np.array([[0.5, 0.0, 0.0]]), np.array([[0.0, 0.0, 1.0]])
    (angle,) = off_angles(facing_wall(distance), Settings(environment="cube"), np.zeros(1, int), *beside)
    assert angle == pytest.approx(np.arctan(0.5 / distance))
    assert np.degrees(angle) == pytest.approx(degrees, rel=0.02)
    assert in_texels(angle, 64) == pytest.approx(texels, rel=0.02)
    # In the middle of a face a texel is wider than 90 / 64 degrees: there it is 64 s / (2 d) texels.
    place = place_on_cube(np.array([[0.5, 0, distance], [0, 0, distance]], float))[1]
    assert abs(np.diff(place[:, 0]))[0] * 64 == pytest.approx(16 / distance)


@settings(max_examples=60)
@given(
    st.lists(st.tuples(*[st.tuples(*[st.integers(-6, 6)] * 3)] * 3), min_size=1, max_size=5),
    st.tuples(*[st.integers(-6, 6)] * 3),
    st.tuples(*[st.integers(-3, 3)] * 3),
)
def test_rays_meet_what_they_meet_in_rational_arithmetic(triangles, origin, way) -> None:
    found, distance, weights = nearest_met(
        np.array([origin], float), np.array([way], float), np.array(triangles, float), 1e-9
    )
    met = []
    for number, corners in enumerate(triangles):
        a, b, c = ([Fraction(part) for part in corner] for corner in corners)
        e, f, s = ([p - q for p, q in zip(one, a, strict=True)] for one in (b, c, origin))
        volume = det(way, e, f)
        if volume:
            # o + t r = a + beta e + gamma f, by Cramer's rule.
            minus = [-part for part in way]
            t, beta, gamma = det(s, e, f), det(minus, s, f), det(minus, e, s)
            t, beta, gamma = (part / det(minus, e, f) for part in (t, beta, gamma))
            if t > 0 and beta >= 0 and gamma >= 0 and beta + gamma <= 1:
                on_border = beta in (0, 1) or gamma in (0, 1) or beta + gamma == 1
                met.append((t, number, on_border, (1 - beta - gamma, beta, gamma)))
    nearest = min(met, default=None)
    inner = min((each for each in met if not each[2]), default=None)
    if nearest is None:
        assert found[0] == -1
    elif nearest == inner:
        at_once = {number for t, number, *_ in met if t == nearest[0]}
        assert found[0] in at_once
        assert distance[0] == pytest.approx(float(nearest[0]))
        if len(at_once) == 1:
            assert weights[0] == pytest.approx([float(part) for part in nearest[3]], abs=1e-12)


def det(a, b, c) -> Fraction:
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    ) * Fraction(1)


def test_rays_show_the_floor_where_it_goes_on_behind_the_mirror_and_a_map_does_not() -> None:
    # The front of the mirror is flat: what it shows lies on the line of sight, turned round at its plane.
    scene = replace(CUBE, meshes=CUBE.meshes[:2])
    frame = {name: render(scene, Settings(environment=name)) for name in ("cube", "rays")}
    source = trace(scene, Settings()).source
    layout, values = source.geometry.primitives.layout, source.interpolated[1]
    position, normal = values[:, layout["position"]], values[:, layout["normal"]]
    eye, seen = scene.camera.eye, source.picture.primitive[source.fragments.row, source.fragments.column]
    front = np.flatnonzero((source.triangle_of_fragment == seen) & (normal[:, 2] > 0.9) & (seen >= 2))
    assert len(front) > 100
    own = trace(scene, Settings(environment="rays")).stage("shade").columns["own_color"]
    off = {name: [] for name in frame}
    for k in front:
        r = (position[k] - eye) * [1, 1, -1]
        floor = position[k] - r * position[k, 1] / r[1]
        if np.abs(floor[[0, 2]]).max() > 3.9:
            continue
        u, v = (floor[0] + 4) / 2, (4 - floor[2]) / 2
        pixels = scene.meshes[0].texture.pixels
        # Away from the borders of squares and letters the texture is constant around a texel.
        column, row = (int(part * 32) % 32 for part in (u, v))
        around = pixels[np.ix_([(row + i) % 32 for i in (-1, 0, 1)], [(column + i) % 32 for i in (-1, 0, 1)])]
        if np.ptp(around, axis=(0, 1)).max() > 0:
            continue
        n_dot_l = 0.8 / np.sqrt(0.4**2 + 0.8**2 + 0.7**2)
        lit = around[1, 1] * (0.12 + 0.88 * n_dot_l)
        place = source.fragments.row[k], source.fragments.column[k]
        for name, found in frame.items():
            mirrored = (found.color[place][:3] - own[k, :3]) / 0.85
            off[name].append(np.abs(mirrored - lit).max())
    assert len(off["rays"]) > 60
    # Only a highlight is added to the floor's own light.
    assert np.median(off["rays"]) < 0.01
    assert np.median(off["cube"]) > 0.05


@pytest.mark.parametrize(
    ("method", "others"),
    [("cube", {"shadow": "map", "map_size": 16}), ("rays", {"texture_filter": "trilinear"})],
)
def test_picture_trace_and_listing_agree(method: str, others: dict[str, str | int]) -> None:
    meshes = list(CUBE.meshes)
    meshes[0] = replace(meshes[0], material=Material(mirror=0.25))
    scene = replace(CUBE, meshes=tuple(meshes), size=(16, 12))
    chosen = Settings(environment=method, environment_size=8, **others)
    traced = trace(scene, chosen)
    check_shade(traced)
    frame, stage = render(scene, chosen), traced.stage("shade")
    passes = traced.stage("depth").columns["passes"]
    assert {"mirror", "textured-mirror", "lit"} == {stage.steps.kinds[kind] for kind in set(stage.steps.kind)}
    for row, (column, line) in enumerate(stage.pixel.tolist()):
        if passes[row] and (
            not passes[row + 1 :][(stage.pixel[row + 1 :] == (column, line)).all(axis=1)].any()
        ):
            assert np.array_equal(frame.color[line, column], stage.columns["color"][row].astype(np.float32))
    assert np.array_equal(to_display(frame.color).pixels, draw_picture(scene, chosen).pixels)


def test_the_map_is_what_its_passes_draw_and_is_kept() -> None:
    chosen = Settings(environment="cube", environment_size=8)
    planned = planned_passes(CUBE, chosen)
    assert [each.title for each in planned][::5] == ["What mirror sees along +x", "What mirror sees along −z"]
    for face, each in zip(drawn_faces(planned), planned, strict=True):
        assert np.array_equal(face.pixels, render(each.scene, each.settings).color[..., :3])
    moved = replace(CUBE, camera=replace(CUBE.camera, eye=np.array([3.0, 5, 5])))
    assert planned_passes(moved, chosen) == planned
    assert planned_passes(CUBE, Settings()) == () == planned_passes(CUBE, replace(chosen, shading="gouraud"))
    with_shadow = planned_passes(CUBE, replace(chosen, shadow="map", depth_test_time="prepass"))
    assert [each.name for each in with_shadow] == ["shadow-map", *["environment"] * 6, "prepass"]


def test_nothing_changes_without_a_mirror_and_a_reason_is_given() -> None:
    plain = [replace(mesh, material=Material()) for mesh in CUBE.meshes]
    for scene in (replace(CUBE, meshes=tuple(plain)), replace(CUBE, meshes=CUBE.meshes[1:2])):
        assert "No mesh of this scene has a mirror share" in no_effect(Settings(), "environment", scene)
        assert np.array_equal(render(scene, Settings(environment="cube")).color, render(scene).color)
    gouraud = Settings(shading="gouraud")
    assert "choose Phong shading" in no_effect(gouraud, "environment", CUBE)
    assert np.array_equal(
        render(CUBE, replace(gouraud, environment="rays")).color, render(CUBE, gouraud).color
    )


def test_what_is_refused_says_why() -> None:
    with pytest.raises(ValueError, match="environment_size must be a whole number from 1 to 512, got 100000"):
        Settings(environment_size=100_000)
    for share in (-0.1, 1.1, float("nan")):
        with pytest.raises(ValueError, match=f"material mirror must be from 0 to 1, got {share}"):
            Material(mirror=share)
    large = replace(CUBE, meshes=(*CUBE.meshes, *make_scene("knot").meshes), size=(512, 512))
    with pytest.raises(ValueError, match="environment rays needs at most 536,870,912 tests"):
        render(large, Settings(environment="rays"))
    edit = Edit("shading", "phong", listing(blinn_phong).source)
    with pytest.raises(ValueError, match="would not run: reflections are added to what the text computes"):
        render(CUBE, apply_edit(Settings(environment="cube"), edit))


@pytest.mark.parametrize("method", ["cube", "rays"])
def test_any_mirror_and_a_map_of_one_texel_draw(method: str) -> None:
    floor, mirror, box = CUBE.meshes
    far = np.diag([1e40, 1e40, 1e40, 1.0])
    flat = Mesh(np.zeros((3, 3)), np.array([[0, 1, 2]]), material=Material(mirror=1.0))
    around = replace(box, transform=mirror.transform)
    for meshes in (
        (floor, replace(mirror, transform=far @ mirror.transform)),
        (floor, flat, replace(box, material=Material(mirror=1.0))),
        (around, mirror),
    ):
        scene = Scene(meshes, CUBE.camera, CUBE.lights, (8, 6))
        for size in (1, 3):
            assert np.isfinite(render(scene, Settings(environment=method, environment_size=size)).color).all()


def test_a_mirror_of_patches_or_bones_is_drawn_as_it_is_now() -> None:
    teapot = make_scene("teapot").meshes[0]
    shiny = replace(CUBE.meshes[1], transform=np.eye(4))
    scene = Scene((teapot, shiny), CUBE.camera, CUBE.lights, (8, 6))
    chosen = Settings(environment="cube", environment_size=4, segments=2)
    planned = planned_passes(scene, chosen)
    cut = before_matrices(scene, chosen).meshes[0].triangles
    assert len(cut) < len(teapot.triangles)
    for each in (*planned, *planned_passes(scene, replace(chosen, environment="none", shadow="map"))):
        drawn = before_matrices(each.scene, each.settings).meshes[0].triangles
        assert len(drawn) == len(cut)


def test_the_history_of_a_pixel_tells_what_is_mirrored() -> None:
    history = why(TraceSource(CUBE, Settings(environment="cube")), 24, 22)
    links = [link for event in history.events for link in event.chain if link.stage == "shade"]
    told = [link_sentence(link) for link in links]
    assert "is mirrored" in told[-1]
    assert not any(
        "mirrored" in link_sentence(link)
        for event in why(TraceSource(CUBE, Settings(environment="cube")), 60, 3).events
        for link in event.chain
    )


def test_the_planner_names_the_largest_error() -> None:
    facts = {fact.name: fact.text for fact in look_at(CUBE, Settings(environment="cube")).facts}
    angle, texels = (float(part.split()[0]) for part in facts["reflection"].split(", "))
    assert 30 < angle < 180
    assert texels == pytest.approx(angle / 90 * 64, rel=0.01)
    assert "reflection" not in {fact.name for fact in look_at(CUBE, Settings(environment="rays")).facts}


def test_a_mirror_sees_others_and_itself_by_rays_only() -> None:
    around = surroundings(CUBE, Settings(environment="rays"), 1)
    assert (len(around.triangles), around.faces) == (26, ())
