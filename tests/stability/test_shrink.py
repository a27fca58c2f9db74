"""The shrinker: what is left still fails in the same way, is small, short, and always the same."""

import numpy as np
import pytest

import core
from core import ClipScene, Settings
from core.study.stability import Outcome, StressCancelledError, Verdict, experiments
from core.study.stability.kinds import SEGMENTS, TRIANGLES, first_edge, scene_of_segment
from core.study.stability.minimization import digit_count, minimize, simpler_numbers
from core.study.stability.shrink import shrink_cell
from tests.stability.shrunk_tests import run_test, shrunk_of

CASES = [
    ("slivers", "coverage=snapped", (2.0**-12, 2.0**-14)),
    ("coordinates", "coverage=fixed-24.8", (1024.0, 2.0)),
    ("shared-edges", "fill_rule=inclusive", (1.0, 8.0)),
    ("shared-edges", "fill_rule=exclusive", (1.0, 8.0)),
    ("signs-of-w", "clipping=project-first", (-1.0, 0.5)),
    ("parallel-segments", "line_clipping=cyrus-beck-lecture", (3.0, 3.0)),
    ("segments-past-a-corner", "line_clipping=liang-barsky", (0.0, 0.59375)),
]


@pytest.mark.parametrize(("name", "method", "place"), CASES)
def test_what_is_left_fails_in_the_same_way_and_is_no_larger(name: str, method: str, place: tuple) -> None:
    experiment = experiments.get(name)
    before, _ = experiment.case(method, place, 0)
    shrunk = shrunk_of(name, method, place)
    assert shrunk.verdict.outcome == experiment.run(method, place, 0).outcome
    assert experiment.judge(shrunk.scene, shrunk.settings) == shrunk.verdict
    assert len(shrunk.scene.clip) <= len(before.clip)
    assert np.prod(shrunk.scene.size) <= np.prod(before.size)
    if experiment.kind is TRIANGLES:
        digits = [sum(digit_count(value) for value in scene.clip.ravel()) for scene in (shrunk.scene, before)]
        assert digits[0] <= digits[1]
    assert shrunk.sentence.startswith(method)
    again = shrink_cell(name, method, place)
    assert (again.scene.clip == shrunk.scene.clip).all()
    assert again.test == shrunk.test


@pytest.mark.parametrize(("name", "method", "place"), CASES)
def test_the_test_fails_now_and_holds_for_a_method_that_is_right(
    name: str, method: str, place: tuple
) -> None:
    text = shrunk_of(name, method, place).test
    with pytest.raises(AssertionError):
        run_test(text)
    family, wrong = method.split("=")
    right = {
        "coverage": "exact",
        "fill_rule": "shared-edge",
        "clipping": "homogeneous",
        "line_clipping": "exact",
    }[family]
    if f'{family}="{wrong}"' in text:
        run_test(text.replace(f'{family}="{wrong}"', f'{family}="{right}"'))
    elif family == "line_clipping":
        run_test(text.replace(f'"{wrong}"', f'"{right}"'))
    else:
        # It is the default, which is not written.
        run_test(text.replace("Settings(", f'Settings({family}="{right}", '))


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
    name, method, place = CASES[2]
    assert shrink_cell(name, method, place, most_runs=20).run_count <= 21
    answers = iter([False] * 5 + [True])
    with pytest.raises(StressCancelledError):
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
    text = shrunk_of(*CASES[0]).test
    names = text.split("from core import ")[1].splitlines()[0].split(", ")
    assert set(names) <= set(core.__all__)
