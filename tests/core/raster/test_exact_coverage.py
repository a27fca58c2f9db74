"""The referee against a second derivation in fractions, and the count of misclassified pixels."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.methods import table
from core.raster.edges.exact_coverage import exact_coverage, misclassified
from tests.core import exact_reference
from tests.core.drawing import cover_each
from tests.core.strategies import ANY_TRIANGLES, REGIONS, clip_of_window

RULES = st.sampled_from(table.names("fill_rule"))


@given(ANY_TRIANGLES, RULES, st.booleans(), st.sampled_from([0, 1]))
def test_two_derivations_agree(case, rule: str, snapped: bool, doubled_center: int) -> None:
    clip, size = case
    center = "half" if doubled_center else "integer"
    found = exact_coverage(clip, size, rule, center, snapped=snapped)
    wanted = [exact_reference.exact_coverage(t, size, rule, doubled_center, snapped) for t in clip]
    assert np.array_equal(found, np.stack(wanted))


@given(
    st.lists(st.floats(-1e4, 1e4), min_size=24, max_size=24),
    st.sampled_from([(5, 4), (16, 16)]),
    st.booleans(),
)
def test_two_derivations_agree_on_any_numbers(
    numbers: list[float], size: tuple[int, int], snapped: bool
) -> None:
    clip = np.reshape(numbers, (2, 3, 4))
    wanted = [exact_reference.exact_coverage(t, size, snaps=snapped) for t in clip]
    assert np.array_equal(exact_coverage(clip, size, snapped=snapped), np.stack(wanted))


@given(ANY_TRIANGLES, REGIONS)
def test_a_region_is_a_part_of_the_image(case, region) -> None:
    clip, size = case
    column, row, columns, rows = region
    part = exact_coverage(clip, size, region=region)
    whole = exact_coverage(clip, size)
    assert np.array_equal(part, whole[:, row : row + rows, column : column + columns])


@given(ANY_TRIANGLES, RULES)
def test_the_snapped_fills_misclassify_nothing_on_their_lattice(case, rule: str) -> None:
    clip, size = case
    for fill in ("bounding-box", "spans", "blocks", "incremental"):
        found = misclassified(clip, size, "snapped", fill, rule, snapped=True)
        assert found.count == 0
        assert found.first is None
        assert found.per_million == 0


@given(ANY_TRIANGLES, st.sampled_from(table.names("coverage")), st.booleans())
def test_misclassified_pixels_are_those_that_differ(case, coverage: str, snapped: bool) -> None:
    clip, size = case
    found = misclassified(clip, size, coverage, snapped=snapped)
    drawn, wanted = (
        cover_each(clip, size, "bounding-box", coverage=coverage) > 0,
        exact_coverage(clip, size, snapped=snapped),
    )
    assert found.missing.tolist() == (wanted & ~drawn).sum(axis=(1, 2)).tolist()
    assert found.extra.tolist() == (drawn & ~wanted).sum(axis=(1, 2)).tolist()
    assert found.covered.tolist() == wanted.sum(axis=(1, 2)).tolist()
    assert (found.first is None) == (found.count == 0)
    if found.first is not None:
        triangle, column, row = found.first
        assert drawn[triangle, row, column] != wanted[triangle, row, column]


def test_what_snapping_moves_is_misclassified_where_the_question_is_the_triangle_as_given() -> None:
    # The left side lies a quarter of a subpixel to the right of the centres of column 2, and snaps onto them.
    clip = clip_of_window([[(2.5 + 1 / 1024, 0), (8, 0), (2.5 + 1 / 1024, 8)]], (8, 8))
    as_given, on_lattice = (
        misclassified(clip, (8, 8), "snapped", snapped=snapped) for snapped in (False, True)
    )
    assert on_lattice.count == 0
    assert as_given.extra.tolist() == [8]
    assert as_given.missing.tolist() == [0]
    assert as_given.first == (0, 2, 0)
    assert as_given.per_million == pytest.approx(1e6 * 8 / as_given.covered.sum())
