"""Laws of shaders over lanes: a lane alone is that lane of the batch, and masks are disjoint and join."""

import numpy as np
import pytest

from core.lanes.nodes import Discard, If
from core.shaders.lane_steps import Recorder
from core.shaders.rules import EACH_RULES, WHOLE_RULES, rounded_to_int, whole_quotient, whole_remainder
from tests.core.shaders.samples import SAMPLES, lane_of, random_lanes, shader_of

LANES = 64


def _run(shader, given, count):
    recorder = Recorder(count)
    outcome = shader.run(given, count, watch=recorder)
    color = np.stack([np.broadcast_to(part, count) for part in outcome.values["c"].parts])
    return color, outcome.discarded, recorder.steps


@pytest.mark.parametrize("name", SAMPLES)
def test_a_lane_alone_is_that_lane_of_the_batch(name):
    shader, given = shader_of(SAMPLES[name]), random_lanes(LANES)
    color, discarded, together = _run(shader, given, LANES)
    assert 0 < discarded.sum() < LANES or name == "phong"
    for k in range(LANES):
        own, own_discarded, alone = _run(shader, lane_of(given, k), 1)
        assert own_discarded[0] == discarded[k]
        if not discarded[k]:
            np.testing.assert_array_equal(own[:, 0].view(np.int32), color[:, k].copy().view(np.int32))
        # It is live in exactly the statements of its own run, in their order.
        assert [id(step.node) for step in alone] == [id(step.node) for step in together if step.live[k]]


@pytest.mark.parametrize("name", SAMPLES)
def test_masks_are_disjoint_and_join(name):
    shader, given = shader_of(SAMPLES[name]), random_lanes(LANES)
    _, discarded, steps = _run(shader, given, LANES)
    gone = np.zeros(LANES, bool)
    for at, step in enumerate(steps):
        assert not (step.live & gone).any(), "a discarded lane lives on"
        if isinstance(step.node, Discard):
            gone |= step.live
        if isinstance(step.node, If):
            chosen = np.broadcast_to(np.asarray(step.value), LANES) & step.live
            first = step.node.yes[0]
            inside = [s.live for s in steps[at + 1 :] if s.node is first][:1]
            if chosen.any() and inside:
                np.testing.assert_array_equal(inside[0] & ~gone, chosen & ~gone)
    np.testing.assert_array_equal(gone, discarded)


def test_a_shader_computes_in_float32():
    source = (
        SAMPLES["phong"].split("void main")[0]
        + "void main() { c = vec4(0.1 + 0.2, 16777217.0, 1.0 / 3.0, t); }"
    )
    shader = shader_of(source)
    found = [part[()] for part in shader.run(random_lanes(4), 4).values["c"].parts]
    assert found == [np.float32(0.1) + np.float32(0.2), 16777216, np.float32(1) / np.float32(3), 0.25]
    assert {np.asarray(part).dtype for part in found} == {np.dtype(np.float32)}


def test_ints_are_cut_off_and_wrap_around():
    head = SAMPLES["phong"].split("void main")[0]
    body = "int big = 2147483647; int k = big + 1; c = vec4(float(-7 / 2), float(-7 % 2), float(k), float(int(-2.9)));"
    parts = shader_of(f"{head}void main() {{ {body} }}").run(random_lanes(2), 2).values["c"].parts
    assert [float(part) for part in parts] == [-3, -1, -(2.0**31), -2]


def test_built_in_functions_keep_their_definitions():
    random = np.random.default_rng(5)
    i, n = (vectors / np.linalg.norm(vectors, axis=0) for vectors in random.normal(size=(2, 3, 40)))
    n = np.array(WHOLE_RULES["faceforward"](n, i, n), float)
    assert ((n * i).sum(axis=0) <= 0).all()
    ratio = 0.75
    refracted = np.array(WHOLE_RULES["refract"](i, n, (ratio,)), float)
    along, beside = (refracted * n).sum(axis=0), i - (i * n).sum(axis=0) * n
    np.testing.assert_allclose(np.linalg.norm(refracted, axis=0), 1, rtol=1e-6)
    np.testing.assert_allclose(refracted - along * n, ratio * beside, atol=1e-6)
    assert (along < 0).all()
    assert [EACH_RULES["step"](2.0, value) for value in (1.5, 2.0, 2.5)] == [0, 1, 1]
    tops, bottoms = np.array([7, -7, 7, -7, 7]), np.array([2, 2, -2, -2, 0])
    np.testing.assert_array_equal(whole_quotient(tops, bottoms), [3, -3, -3, 3, 0])
    np.testing.assert_array_equal(whole_remainder(tops, bottoms), [1, -1, 1, -1, 7])
    np.testing.assert_array_equal(rounded_to_int(np.array([np.nan, -2.9, 1e12])), [0, -2, 2**31 - 1])
