"""The shrinker: what is left still fails in the same way, is small, short, and always the same."""

from typing import Any

import numpy as np
import pytest

import core
from core import ClipScene, Settings
from core.study.case_text import scene_text
from core.study.cases import digit_count, minimize, simpler_numbers
from core.study.experiment import SEGMENTS, TRIANGLES, first_edge, scene_of_segment
from core.study.record import Outcome, StudyCancelledError, Verdict
from core.study.stability import experiments
from core.study.stress import shrink_cell
from tests.stability.shrunk_tests import run_test, shrunk_of

CASES = [
    ("slivers", "coverage=snapped", (2.0**-12, 2.0**-14), "coverage=exact"),
    ("signs-of-w", "clipping=project-first", (-1.0, 0.5), "clipping=homogeneous"),
    ("segments-past-a-corner", "line_clipping=liang-barsky", (0.0, 0.59375), "line_clipping=exact"),
    ("z-fighting-range", "depth=z-24", (1000.0, 1e-6), "visibility=ray-casting"),
    ("blending-order", "visibility=last-drawn blend=over", (4.0, 0.5), "visibility=painters"),
    ("thin-triangles", "antialiasing=none", (0.25, 0.0), "antialiasing=area"),
    ("lost-highlight", "shading=gouraud", (8.0, 128.0), "shading=phong"),
    ("minification", "texture_filter=nearest", (4.0, 0.0), ""),
]
"""Experiment, method, place, and the method that is right for what is left, if there is one."""
MORE_CASES = [
    ("shared-edges", "fill_rule=inclusive", (1.0, 8.0), "fill_rule=shared-edge"),
    ("affine-w-ratio", "interpolation=affine", (4.0, 32.0), "interpolation=perspective"),
    ("opposite-normals", "shading=gouraud", (120.0, 2.0), ""),
    ("coordinates", "coverage=fixed-24.8", (1024.0, 2.0), "coverage=exact"),
    ("shared-edges", "fill_rule=exclusive", (1.0, 8.0), "fill_rule=shared-edge"),
    ("parallel-segments", "line_clipping=cyrus-beck-lecture", (3.0, 3.0), "line_clipping=exact"),
    ("z-fighting-distance", "depth=z-16", (100.0, 0.01), "visibility=ray-casting"),
    ("z-fighting-distance", "depth=inverse-w", (31.6, 1e-6), "visibility=ray-casting"),
    ("orthographic-depth", "depth=z-16", (0.01, 2.0**-30), "visibility=ray-casting"),
    ("painters-cycle", "visibility=painters", (0.3, 0.0), "visibility=z-buffer"),
    ("drawing-order", "visibility=last-drawn", (4.0, 2.0), "visibility=painters"),
    ("blending-order", "visibility=last-drawn blend=opaque", (0.0, 0.5), "blend=over"),
    ("thin-triangles", "antialiasing=msaa-4", (2.0**-6, 0.0), "antialiasing=area"),
    ("lost-highlight", "shading=flat", (8.0, 300.0), "shading=phong"),
    ("opposite-normals", "shading=phong", (180.0, 1.0), ""),
    ("minification", "texture_filter=trilinear", (1.0, 75.0), ""),
    ("shading-aliasing", "antialiasing=area", (8.0, 30.0), ""),
]
PAIRS = {"shared-edges", "z-fighting-distance", "z-fighting-range", "orthographic-depth", "painters-cycle"}
PAIRS |= {"drawing-order", "blending-order"}
"""Experiments that fail with two triangles and not with one."""


@pytest.mark.parametrize(
    ("name", "method", "place", "right"),
    [*CASES, *(pytest.param(*case, marks=pytest.mark.slow) for case in MORE_CASES)],
)
def test_what_is_left_is_small_fails_alike_and_its_test_holds_for_a_method_that_is_right(
    name: str, method: str, place: tuple[float, ...], right: str
) -> None:
    experiment = experiments.get(name)
    before, _ = experiment.case(method, place, 0)
    shrunk = shrunk_of(name, method, place)
    scene, text = shrunk.scene, shrunk.test
    assert shrunk.verdict.outcome == experiment.run(method, place, 0).outcome
    assert shrunk.sentence.startswith(method)
    most = 2 if name in PAIRS else 1
    if isinstance(scene, ClipScene):
        assert len(scene.clip) <= most
        assert np.prod(scene.size) <= np.prod(before.size)
    # The scene is all there: made again from its text it is judged alike.
    names: dict[str, Any] = {"np": np}
    exec(f"from core import *\n{scene_text(scene)}", names)
    for made in (scene, names["scene"]):
        assert experiment.judge(made, shrunk.settings) == shrunk.verdict
    if experiment.kind is TRIANGLES:
        digits = [sum(digit_count(value) for value in each.clip.ravel()) for each in (scene, before)]
        assert digits[0] <= digits[1]
    elif experiment.kind is not SEGMENTS:
        assert np.prod(scene.size) <= 2
        assert shrunk.pixel is not None
        assert (np.array(shrunk.pixel) < scene.size).all()
    with pytest.raises(AssertionError):
        run_test(text)
    if right:
        family, chosen = right.split("=")
        given = f'{family}="{getattr(shrunk.settings, family)}"'
        if family == "line_clipping":
            run_test(text.replace(f'"{shrunk.settings.line_clipping}"', f'"{chosen}"'))
        elif given in text:
            run_test(text.replace(given, f'{family}="{chosen}"'))
        else:
            # It is the default, which is not written.
            run_test(text.replace("Settings(", f'Settings({family}="{chosen}", '))


def test_the_same_cell_shrinks_to_the_same_test() -> None:
    name, method, place, _ = CASES[1]
    again = shrink_cell(name, method, place)
    assert again.test == shrunk_of(name, method, place).test


def test_a_mesh_shrinks_to_two_triangles_on_one_pixel() -> None:
    shrunk = shrunk_of("shared-edges", "fill_rule=inclusive", (1.0, 8.0))
    assert len(shrunk.scene.clip) == 2
    assert shrunk.scene.size == (1, 1)
    assert shrunk.pixel == (0, 0)
    # They still share an edge, and one of them alone would be right.
    first, second = ({tuple(corner) for corner in triangle} for triangle in shrunk.scene.clip.tolist())
    assert len(first & second) == 2
    judge = experiments.get("shared-edges").judge
    alone = ClipScene(shrunk.scene.clip[:1], size=(1, 1))
    assert judge(alone, shrunk.settings).outcome == Outcome.RIGHT


@pytest.mark.slow
def test_no_triangle_and_no_digit_can_be_left_out() -> None:
    shrunk = shrunk_of("coordinates", "coverage=fixed-24.8", (1024.0, 2.0))
    assert (shrunk.scene.clip == np.rint(shrunk.scene.clip)).all()
    assert max(digit_count(value) for value in shrunk.scene.clip.ravel()) <= 4


def test_only_what_fails_can_be_shrunk() -> None:
    with pytest.raises(ValueError, match="expected a scene that fails"):
        shrink_cell("slivers", "coverage=exact", (0.5, 0.25))
    with pytest.raises(ValueError, match="method of slivers must be one of"):
        shrink_cell("slivers", "coverage=decimal", (0.5, 0.25))


def test_runs_are_bounded_and_can_be_cancelled() -> None:
    name, method, place, _ = CASES[1]
    assert shrink_cell(name, method, place, most_runs=20).run_count <= 21
    answers = iter([False] * 5 + [True])
    with pytest.raises(StudyCancelledError):
        shrink_cell(name, method, place, is_cancelled=lambda: next(answers))


def test_candidates_that_are_no_scene_are_passed_over() -> None:
    inner = experiments.get("slivers")

    def judge(scene: ClipScene, settings: Settings) -> Verdict:
        if (scene.clip[..., 3] == 1).any():
            raise ValueError("w must not be 1")
        return inner.judge(scene, settings)

    scene, settings = inner.case("coverage=snapped", (2.0**-12, 2.0**-14), 0)
    found = minimize(
        TRIANGLES, ClipScene(2 * scene.clip, size=scene.size), lambda scene: judge(scene, settings), 3000
    )
    assert found.verdict.outcome == Outcome.HOLE
    assert not (found.parts.numbers["vertices"][:, 3] == 1).any()


def test_numbers_get_simpler_from_the_simplest_on() -> None:
    assert list(simpler_numbers(0.4375, 0.0, digit_count(0.4375))) == [0.0, 0.4, 0.44, 0.438]
    assert list(simpler_numbers(0.0, 0.0, 0)) == []
    assert list(simpler_numbers(2.0, 1.0, 1)) == [1.0]


def test_numbers_get_simpler_in_the_middle_of_a_pixel_too() -> None:
    found = list(simpler_numbers(8192.25, 0.5, digit_count(8192.25), (0.0, 0.5)))
    assert found[0] == 0.5
    assert 8000.5 in found
    assert 8000.0 in found


def test_a_segment_is_the_first_edge_of_a_triangle_that_is_seen() -> None:
    ends = np.array([[2.5, 3.5], [9.5, 5.5]])
    scene = scene_of_segment(ends, (16, 8))
    assert np.array_equal(first_edge(scene), ends)
    assert SEGMENTS.take_apart(scene).size == (16, 8)
    # The third corner lies in the picture, and beside the segment, wherever that is.
    for ends in ([[0.0, 1.0], [16.0, 1.0]], [[4.0, 0.0], [4.0, 8.0]], [[-2.0, -0.5], [6.0, 1.5]]):
        (third,) = scene_of_segment(np.array(ends), (16, 8)).clip[:, 2, :2]
        assert (np.abs(third) < 1).all()
        first, second = 2 * np.array(ends) / (16, 8) - 1
        assert np.cross([*(second - first), 0], [*(third - first), 0])[2] != 0
    with pytest.raises(ValueError, match="exact in clip space"):
        scene_of_segment(np.array([[0.1, 1.0], [0.3, 2.0]]), (1, 1))
    with pytest.raises(ValueError, match="as a triangle in clip space, got a scene of meshes"):
        SEGMENTS.take_apart(experiments.get("lost-highlight").case("shading=flat", (4.0, 4.0), 0)[0])


def test_the_names_of_a_test_are_those_of_core() -> None:
    text = shrunk_of(*CASES[0][:3]).test
    names = text.split("from core import ")[1].splitlines()[0].split(", ")
    assert set(names) <= set(core.__all__)
