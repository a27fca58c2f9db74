"""Listings as printed: they run in the pipeline as they read, and leave the right method where it is said."""

import copy
import pickle
import re

import numpy as np
import pytest

from core import Settings, render, trace
from core.explain.steps import account, variables
from core.methods import table
from core.records.listing import listing
from lessons.assembled_scenes import assembled
from lessons.lectures.bresenham import final, missed_ends, naive
from lessons.lectures.catalogue import PRINTED, printed_listing
from lessons.lectures.pellacini import bresenham, dda, midpoint
from lessons.lectures.printed import first_divergence

LINES = [printed for printed in PRINTED if printed.rule is not None]


def two_segments(rises: bool):
    """Return two segments between pixel centres, of slopes 0.4 and 1, mirrored where they fall."""
    y = np.array([1.5, 3.5, 1.5, 5.5])
    return assembled("segments", [1.5, 6.5, 8.5, 12.5], y if rises else 12 - y, (16, 12))


@pytest.mark.parametrize("printed", LINES, ids=lambda printed: printed.name)
def test_render_and_trace_run_the_printed_listing(printed):
    scene, settings = two_segments(printed.rule.rises), printed.settings(Settings())
    stage = trace(scene, settings).stage("raster")
    run = next(iter(printed.readings.values()))
    assert {found.function for found in stage.listings.values()} == {run}
    listed = []
    for first, second in (scene.clip[..., :2] + 1) * (8, 6) - 0.5:
        ends = [*first, *second] if not printed.rule.takes_pixels else [round(x) for x in (*first, *second)]
        listed += run(*ends, True)
    assert stage.pixel.tolist() == [list(pixel[:2]) for pixel in listed]
    np.testing.assert_allclose(stage.columns["decision"], [pixel[2] for pixel in listed], atol=1e-12)
    count = np.zeros((12, 16), int)
    np.add.at(count, tuple(stage.pixel.T[::-1]), 1)
    assert np.array_equal(render(scene, settings).cover_count, count)


@pytest.mark.parametrize("printed", LINES, ids=lambda printed: printed.name)
def test_every_assignment_of_the_printed_text_is_a_step_with_its_sum(printed):
    stage = trace(two_segments(printed.rule.rises), printed.settings(Settings())).stage("raster")
    shown = next(iter(stage.listings.values())).source
    assert shown == (printed.text.replace(*printed.read) if printed.read[0] else printed.text)
    assert not re.search("chosen_by|half_up|#:", shown)
    held, marked = {}, set()
    for row in range(stage.steps.row_count):
        held = {} if stage.kind_of(row).endswith("-start") else held
        for position in range(stage.steps.starts[row] + 1, stage.steps.starts[row + 1] + 1):
            made = stage.explain(position)
            text, equation = account(made, 0, None)
            assert "NaN" not in text + (equation.substituted if equation else ""), made.key
            now = {one.name: one for one in variables(made) if one.name in ("x", "y", "e", "d", "D")}
            # No variable jumps: what was there before a step is what the step before has left.
            assert all(one.before == held.get(name) for name, one in now.items() if one.is_changed()), (
                made.key
            )
            assert all(one.now == held[name] for name, one in now.items() if not one.is_changed()), made.key
            assert equation or not any(one.is_changed() for one in now.values())
            held = {name: one.now for name, one in now.items()}
            marked.add(made.line)
    # All lines that do something are marked, but for those of brackets, comments and loops that go on.
    assigning = {
        k for k, line in enumerate(shown.splitlines(), 1) if re.search(r"[+-]= |draw|write|if ", line)
    }
    assert assigning <= marked


def test_the_table_of_methods_has_none_of_them():
    names = {(method.family, method.name) for method in table}
    for printed in PRINTED:
        assert ((printed.family, printed.registered) in names) == bool(printed.registered)
        assert (printed.family, printed.name) not in names
        assert not printed.right or (printed.family, printed.right) in names
        for run in printed.readings.values():
            assert listing(getattr(run, "func", run)).source


def test_settings_with_a_printed_listing_are_equal_after_a_copy():
    settings = printed_listing("pellacini-dda").settings(Settings())
    assert settings == pickle.loads(pickle.dumps(settings)) == copy.deepcopy(settings)
    assert settings != Settings(line="dda") != printed_listing("pellacini-midpoint").settings(Settings())


@pytest.mark.parametrize("x", [[6.5, 1.5], [1.5, 1.5], [1.5, 2.5]], ids=["backwards", "point", "steep"])
def test_slopes_that_the_slide_does_not_print_are_refused(x):
    y = [1.5, 1.5] if x == [1.5, 1.5] else [1.5, 4.5]
    scene = assembled("segments", x, y, (16, 12))
    with pytest.raises(ValueError, match=r"x0 < x1 and slopes from 0 to 1, got"):
        render(scene, printed_listing("lmu-final").settings(Settings()))


def test_first_divergence():
    found = first_divergence(bresenham, "midpoint", (0, 0, 5, 2))
    assert (found.step, found.printed[:2], found.right[:2]) == (1, (1, 1), (1, 0))
    assert (found.printed[2], found.right[2]) == (0.8, 0.4)
    lost = first_divergence(dda, "midpoint", (0, 0, 5, 2))
    assert (lost.step, lost.printed, lost.right[:2]) == (5, None, (5, 2))
    assert first_divergence(midpoint, "midpoint", (0.25, 0.5, 5.75, 2)) is None
    assert first_divergence(final, "bresenham-lecture", (3, 4, 9, 8)) is None
    assert first_divergence(naive, "bresenham-lecture", (0, 0, 6, 5)).step == 3
    assert missed_ends(final, ((0, 0, 6, 5),)) == 0


def test_an_unknown_listing_is_named_with_those_that_there_are():
    with pytest.raises(ValueError, match=r"must be one of pellacini-midpoint, .* got other"):
        printed_listing("other")
    with pytest.raises(ValueError, match="lmu-projection does not run in place of a line method"):
        printed_listing("lmu-projection").settings(Settings())
