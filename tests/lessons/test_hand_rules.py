"""The right formulas of questions by hand give what the core computes; figures that are known of the wrong ones."""

from fractions import Fraction as F
from math import acos, degrees, radians

import numpy as np
import pytest

from core import Camera, ClipScene, DirectionalLight, Material, Mesh, Settings, render, trace
from core.coverage.snapping import window_position
from core.scene import Texture
from core.shading.lighting import blinn_phong, plain_lights, plain_material
from core.textures.look_up import sample_texture
from core.transform.matrices import projection, rotation, scaling, translation, viewport, world_to_camera
from core.transform.vertex_stage import world_normals
from lessons.exercises.numbers import Draws, NoQuestionError
from lessons.exercises.templates.on_picture import draw_box
from lessons.mistakes import depths, hit_lists, scan_lines, transforms
from lessons.mistakes.shelf import RULES, SHELF
from lessons.mistakes.twin import Case, line_pixels
from lessons.small_scenes import pixel_segments, triangle_scene


def near(found, wanted) -> None:
    np.testing.assert_allclose(np.array(found, float), np.array(wanted, float), atol=1e-12)


def test_turns_and_moves_are_products_of_the_matrices_of_the_core() -> None:
    turn, shift, point = (F(3, 5), F(4, 5)), (2, -1), (3, 4)
    R, T = rotation(np.array([0, 0, 1.0]), np.arctan2(4, 3)), translation(2, -1, 0)
    p = np.array([3, 4, 0, 1.0])
    near(transforms.turn_and_move(turn, shift, point), (T @ R @ p)[:2])
    near(transforms.factors_reversed(turn, shift, point), (R @ T @ p)[:2])
    plane = np.ix_([0, 1, 3], [0, 1, 3])
    near(transforms.scale_and_move((2, 3), shift), (T @ scaling(2, 3, 1))[plane].ravel())
    near(transforms.translated((2, -1, 0), (3, 4, 0)), T @ p)
    near(transforms.matrix_transposed((2, -1, 0), (3, 4, 0)), T.T @ p)
    near(transforms.turned_by(30, (3, 4)), (rotation(np.array([0, 0, 1.0]), radians(30)) @ p)[:2])


def test_camera_and_projection_are_those_of_the_core() -> None:
    _, eye, target, point = transforms.SEEN
    camera = Camera(
        np.array(eye, float), np.array(target, float), field_of_view=2 * np.arctan(0.5), near=1, far=10
    )
    near(transforms.in_camera(*transforms.SEEN), (world_to_camera(camera) @ [*point, 1])[:3])
    half, aspect, n, f, p = transforms.VIEW
    assert (half, n, f) == (F(1, 2), 1, 10)
    near(transforms.projected(*transforms.VIEW), projection(camera, float(aspect)) @ [*map(float, p), 1])
    near(viewport(8, 6) @ [0.5, 0, 0, 1], [6, 3, 0.5, 1])


def test_depths_and_distances_are_those_of_the_core() -> None:
    camera = Camera(np.array([0, 0, 0.0]), np.array([0, 0, -1.0]), near=1, far=10)
    clip = projection(camera, 1) @ [0, 0, -2, 1]
    near(depths.window_depth(1, 10, 2), [(clip[2] / clip[3] + 1) / 2])
    ends = [projection(camera, 1) @ [0, 0, -d, 1] for d in (1, 10)]
    near(depths.distance_between(F(1, 2), (1, 10)), [2 / (1 / ends[0][3] + 1 / ends[1][3])])


def test_light_and_normals_are_those_of_the_core() -> None:
    light = DirectionalLight(np.array([-2.0, -1.0, -2.0]))
    material = Material(ambient=0.25, diffuse=0.75, specular=1, shininess=4)
    normal, to_eye = (0.0, 3.0, 4.0), (-2.0, 2.0, 1.0)
    diffuse, specular = blinn_phong(
        (0, 0, 0), normal, to_eye, plain_lights([light]), plain_material(material), False
    )
    near(RULES["light-reversed"].right(0.25, normal, (2, 1, 2)), diffuse[:1])
    near(RULES["highlight-at-light"].right(normal, (2, 1, 2), to_eye, 4), specular[:1])
    positions = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]])
    mesh = Mesh(
        positions,
        np.array([[0, 1, 2]]),
        normals=np.array([[1, 2, 2.0]] * 3),
        transform=translation(3, 1, 2) @ scaling(3, 1, 2),
    )
    near(RULES["normal-moved"].right((3, 1, 2), (3, 1, 2), (1, 2, 2)), world_normals(mesh)[0])


def test_boxes_are_those_of_the_core() -> None:
    draws, found = Draws(3), 0
    for _ in range(40):
        try:
            draft = draw_box(draws)
        except NoQuestionError:
            continue
        counted = render(draft.scene, draft.settings).statistics["bin"].outgoing
        assert counted == len(draft.answer.reference)
        found += 1
    assert found > 5


def wrong(name: str, *arguments) -> list:
    return list(RULES[name].wrong(*arguments))


def test_figures_of_transforms_and_normals() -> None:
    near(wrong("pivot-left-out", transforms.QUARTER, (2, 0), (2, 0)), (0, 2))
    near(wrong("matrix-transposed", (2, 0, 0), (1, 5, 7)), (1, 5, 7, 3))
    near(wrong("degrees-for-radians", 90, (1.0, 0.0)), transforms.turned_by(117, (1.0, 0.0), lambda _: 90.0))
    assert round(degrees(90) % 360) == 117
    half = F(np.tan(np.pi / 6))
    narrow = wrong("angle-not-halved", half, F(1), 1, 10, (F(1), F(1), F(-1)))[1]
    near([transforms.projected(half, F(1), 1, 10, (1, 1, -1))[1] / narrow], [3])
    scene = triangle_scene([[(6, 3), (8, 0), (8, 6)]], (8, 6))
    near(window_position(SHELF["window-one-less"].change_scene(scene).clip, (8, 6))[0, 0], (5.25, 2.5))
    near(wrong("weights-not-normalized", (F(1, 2), F(12, 25)), (100, 100)), [98])
    rule, scaled = RULES["normal-as-position"], ((2, 1, 1), (0, 0, 0), (1, 1, 0))
    turned, right = rule.wrong(*scaled), rule.right(*scaled)
    assert round(degrees(acos(np.dot(turned, right)))) == 37
    (short,) = wrong("normal-not-renormalized", (1, 0, 0), (0, 1, 0), 0.5, (1, 1, 0))
    assert (round(short, 2), round(short**20, 3)) == (0.71, 0.001)
    assert wrong("byte-overflows", 0.4, 0.8) == [50]


def test_figures_of_clipping_and_lines() -> None:
    # Behind the eye x/w and y/w pass, z/w does not.
    camera = Camera(np.array([0, 0, 0.0]), np.array([0, 0, -1.0]), field_of_view=np.pi / 2, near=1, far=10)
    clip = projection(camera, 1) @ [1, 1, 2, 1]
    near(clip[:3] / clip[3], (-0.5, -0.5, 7 / 3))
    near(wrong("attribute-copied", F(0), F(1), F(1, 2)), [1])

    def columns(name: str, *ends) -> list[int]:
        twin = SHELF[name]
        scene = pixel_segments([ends], (16, 12))
        right = line_pixels(scene, twin.shows.settings)
        return sorted({x for x, _ in line_pixels(scene, twin.change_settings(twin.shows.settings)) ^ right})

    assert columns("from-other-end", (0, 0), (8, 3)) == [4]
    # Of the two forms of this mistake the other one, whose steps are not doubled, shows here.
    assert columns("start-not-doubled", (0, 0), (10, 1)) == []
    assert columns("start-not-doubled", (1, 1), (9, 4)) == [8]
    assert wrong("both-ends-crossed", ((0, 0), (6, 3), (4, 8), (0, 8)), 3) == [3]
    steps = [w for w in range(150, 220) if wrong("product-overflows", w, w) != [F((256 * w) ** 2)]]
    assert steps[0] == 182


def grey(name: str, texels: list[float], places: list[float], wrap: str = "clamp") -> list[float]:
    settings = Settings(wrap=wrap, texture_filter=SHELF[name].shows.settings.texture_filter)
    changed = SHELF[name].change_settings(settings)
    uv = np.array([[u, 0.5] for u in places])
    texture = Texture(np.array(texels, np.float32).reshape(1, -1, 1))
    return sample_texture(texture, uv, changed.texture_filter, changed.wrap).color[:, 0].tolist()


def test_figures_of_textures() -> None:
    centres = [0.125, 0.375, 0.625, 0.875]
    assert grey("half-texel-missing", [0, 1, 2, 3], centres) == [0.5, 1.5, 2.5, 3]
    assert grey("half-texel-added", [0, 1, 2, 3], centres) == [1, 2, 3, 3]
    pixels = [(k + 0.5) / 8 for k in range(8)]
    assert grey("texels-of-one-less", [0, 1, 2, 3], pixels) == [0, 0, 0, 1, 1, 2, 2, 2]
    assert wrong("level-without-size", 64, 1 / 16) == [-4]
    assert RULES["level-without-size"].right(64, 1 / 16) == (2,)
    assert (RULES["level-of-area"].right(64, 1 / 32), wrong("level-of-area", 64, 1 / 32)) == ((1,), [2])


def test_figures_of_depth_blending_and_samples() -> None:
    assert (wrong("depth-linear", 1, 10, 2), RULES["depth-linear"].right(1, 10, 2)) == ([F(1, 9)], (F(5, 9),))
    assert wrong("depth-corrected-twice", F(1, 2), (0, 1), (1, 10)) == [F(1, 11)]
    # The wall from 1 to 10 meets that at 3 at 20/27 of the way, not at 2/9.
    assert RULES["distance-linear"].right(F(20, 27), (1, 10)) == (3,)
    assert wrong("distance-linear", F(2, 9), (1, 10)) == [3]
    assert wrong("sorted-by-mean", [(1, 1, 30), (12, 12, 12)]) == [1, 0]
    square = [(-20, -20), (40, -20), (-20, 40)]

    def blended(name: str, channel: int) -> float:
        scene = triangle_scene([square], (2, 2), attributes=[[(1, 0, 0, 0.5)] * 3])
        over_black = ClipScene(scene.clip, scene.attributes, scene.size, background=np.array([0, 0, 0, 1.0]))
        settings = Settings(blend="over", visibility="last-drawn")
        return float(SHELF[name].draw(over_black, settings).color[0, 0, channel])

    assert [blended("multiplied-twice", 0), blended("not-multiplied", 0)] == [0.25, 1]
    assert [blended("alpha-of-source", 3), blended("alpha-squared", 3)] == [0.5, 0.75]

    def layers(twin: str, case: Case = SHELF["order-reversed"].shows) -> list[float]:
        drawn = SHELF[twin].draw(case.scene, case.settings) if twin else render(case.scene, case.settings)
        return drawn.color[0, 0, :3].tolist()

    assert (layers(""), layers("order-reversed")) == ([0.25, 0, 0.5], [0.5, 0, 0.25])
    assert wrong("one-sample-filled", (depths.Layer(frozenset(range(16)), 1, 16),), 16) == [1]


@pytest.mark.parametrize(
    ("name", "value"),
    [("affine-for-perspective", 1 / 2), ("not-divided-back", 1 / 8), ("multiplied-by-w", 4 / 5)],
)
def test_figures_of_an_edge_with_w_1_and_4(name: str, value: float) -> None:
    corners = [(0.5, 0.5), (8.5, 0.5), (0.5, 8.5)]
    scene = triangle_scene(
        [corners], (10, 10), w=[[1, 4, 1]], attributes=np.array([0, 1, 0.0]).reshape(1, 3, 1)
    )
    assert float(SHELF[name].draw(scene, Settings()).attributes[0, 4, 0]) == pytest.approx(value, abs=1e-6)
    assert float(render(scene).attributes[0, 4, 0]) == pytest.approx(1 / 5, abs=1e-6)


def test_figures_of_shared_edges_and_rows() -> None:
    half = F(1, 2)
    places = [(i, j) for i in range(12) for j in range(10)]

    def covered(corners, owned) -> set[tuple[int, int]]:
        edges = list(zip(corners, [*corners[1:], corners[0]], strict=True))
        values = {
            (i, j): [
                (y0 - y1) * (i + half - x0) + (x1 - x0) * (j + half - y0) for (x0, y0), (x1, y1) in edges
            ]
            for i, j in places
        }
        return {
            p for p, e in values.items() if all(v > 0 or (v == 0 and k in owned) for k, v in enumerate(e))
        }

    far = (F(17, 2), F(9, 2))
    pair = (((half, half), far, (F(5, 2), F(17, 2))), ((half, half), (F(19, 2), half), far))
    rule = RULES["leftmost-vertex"]
    assert not set.intersection(*(covered(corners, rule.right(corners)) for corners in pair))
    twice = set.intersection(*(covered(corners, rule.wrong(corners)) for corners in pair))
    assert sorted(twice) == [(0, 0), (2, 1), (4, 2), (6, 3)]

    corners = [(F(6, 5), F(19, 10)), (F(73, 10), F(31, 10)), (F(12, 5), F(87, 10))]

    def filled(crossing) -> set[tuple[int, int]]:
        spans = {}
        for row in range(10):
            edges = [(corners[a], corners[b]) for a, b in ((0, 1), (1, 2), (0, 2))]
            spans[row] = sorted(crossing(a, b, row)[0] for a, b in edges if a[1] <= row + half < b[1])
        return {(i, j) for i, j in places if len(spans[j]) == 2 and spans[j][0] <= i + half < spans[j][1]}

    # At whole rows 2 and 3 the edge (0, 0)-(10, 4) loses pixels 5 and 7 where its height is made one larger.
    taller = [wrong("height-plus-one", (0, 0), (10, 4), y - half)[0] for y in (2, 3)]
    assert taller == [4, 6]
    assert [RULES["height-plus-one"].right((0, 0), (10, 4), y - half)[0] for y in (2, 3)] == [5, F(15, 2)]

    rule = RULES["crossing-from-vertex"]
    assert (len(filled(rule.right)), len(filled(rule.right) ^ filled(rule.wrong))) == (20, 6)


def test_a_row_of_spans_shows_what_is_nearest_at_each_column() -> None:
    for seed in range(40):
        draws = Draws(seed)
        spans = [
            scan_lines.HandSpan(left, left + draws.whole(1, 9), draws.whole(0, 20), draws.whole(-2, 2))
            for left in (draws.whole(0, 6) for _ in range(3))
        ]
        seen = [0, 0, 0]
        for column in range(20):
            live = [k for k, span in enumerate(spans) if span.left <= column < span.right]
            if live:
                seen[min(live, key=lambda k: (spans[k].depth_at(column), k))] += 1
        assert scan_lines.pixels_seen(spans) == tuple(seen)
        segments, depths_of_ends = scan_lines.row_work(spans)
        assert segments <= 5
        assert depths_of_ends <= sum(span.right - span.left for span in spans)


def test_a_list_is_resolved_as_the_program_does() -> None:
    draws = np.random.default_rng(8)
    for _ in range(20):
        hits = [
            hit_lists.Hit(int(depth), int(draws.integers(0, 9)), F(int(draws.integers(0, 5)), 4))
            for depth in draws.permutation(9)[:4] + 1
        ]
        colors = [[(hit.grey / 8, 0, 0, float(hit.alpha))] * 3 for hit in hits]
        scene = triangle_scene(
            [depths.WINDOW] * 4, (2, 2), depth=[[hit.depth / 16] * 3 for hit in hits], attributes=colors
        )
        over_red = ClipScene(scene.clip, scene.attributes, scene.size, background=np.array([0.5, 0, 0, 1]))
        frame = render(over_red, Settings(visibility="hit-lists", blend="over", interpolation="flat"))
        (grey,) = hit_lists.resolved(hits, 4)
        assert frame.color[0, 0, 0] == np.float32(grey / 8)
        blended = hit_lists.listed_and_blended(hits)[1]
        counted = trace(over_red, Settings(visibility="hit-lists", blend="over")).stage("blend")
        assert np.count_nonzero(counted.marks["covered"]) == 4 * blended
