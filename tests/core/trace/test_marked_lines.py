"""The law of the marked line: it gives a value to every variable that the step changes, or it decides."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import chain
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from core import STAGES, ClipScene, Settings, Trace, trace
from core.depth.whole_depths import table_scene
from core.edits.edit import Edit, apply_edit, original
from core.explain.steps import VARIABLES, load_subjects
from core.interpolation.barycentric import WAYS
from core.records.depth_table import DEPTH_TESTS, DepthTable
from core.records.listing import Listing, Operation, ShaderListing, Variables
from core.trace.stage_trace import StageTrace
from lessons.scenes import make_scene
from tests.core.explain.explained_steps import traces
from tests.core.listings import listings_of_the_program
from tests.core.one_ended import one_ended_triangles
from tests.core.strategies import clip_of_window
from tests.core.trace.trace_cases import SCENES


class Mark(NamedTuple):
    """An operation of a kind of rows, and a line of its listing that it marks."""

    key: str
    operation: Operation
    listing: Listing
    line: int
    changed: frozenset[str]
    """What the listing calls the variables that get a value in any of the rows."""

    @property
    def name(self) -> str:
        shown = self.listing.source.splitlines()[self.line - 1].strip()
        return f"{self.key} marks {shown!r} of {self.listing.name}"


def names(variables: Variables) -> dict[str, str]:
    """Return variables and what the listing calls them, one name or several."""
    return {name: name for name in variables} if isinstance(variables, tuple) else dict(variables)


def changes(stage: StageTrace, name: str, rows: NDArray[np.int64]) -> bool:
    """Return whether a variable gets a value in any of these rows, another one than it had."""
    text = VARIABLES[stage.stage].get(name)
    values = stage.columns[name][rows]
    if text is not None and text.previous in stage.columns:
        return not np.array_equal(
            values, stage.columns[text.previous][rows], equal_nan=values.dtype.kind == "f"
        )
    return values.dtype.kind != "f" or not np.isnan(values).all()


def marks_of(stage: StageTrace, kind: str, rows: NDArray[np.int64]) -> Iterator[Mark]:
    """Yield what the rows of a kind mark, by every outcome."""
    for operation in stage.steps.operations[kind]:
        listing = stage.listings.get(f"{kind}.{operation.name}", stage.listings.get(kind))
        ran = np.full(len(rows), operation.label) if isinstance(operation.label, str) else None
        ran = operation.label(stage.columns, rows) if ran is None else ran
        for label in np.unique(ran).tolist() if listing is not None else ():
            if label:
                found = names(operation.sets).items()
                changed = [
                    called.split() for name, called in found if changes(stage, name, rows[ran == label])
                ]
                line, key = listing.lines[label], f"{stage.stage}.{kind}.{operation.name}"
                yield Mark(key, operation, listing, line, frozenset().union(*changed))


def rare_traces() -> Iterator[Trace]:
    """Yield traces with the listings and lines that the usual ones do without."""
    yield trace(SCENES["circle-of-bars"], Settings(visibility="bsp"), region=(0, 0, 1, 1))
    yield trace(SCENES["intersecting"], Settings(visibility="scan-line"), region=(28, 28, 12, 3))
    for filters in ("nearest", "mipmap-nearest", "bilinear"):
        yield trace(SCENES["textured-clip"], Settings(texture_filter=filters))
    yield trace(SCENES["textured-clip"], Settings(texture_filter="trilinear", interpolation="flat"))
    for way in ("perspective", "affine"):
        outlined = Settings(texture_filter="trilinear", polygon_mode="wireframe", interpolation=way)
        yield trace(SCENES["textured-clip"], outlined)
    as_it_is = Edit("interpolation", "perspective", original("interpolation", "perspective").source)
    yield trace(SCENES["textured-clip"], apply_edit(Settings(texture_filter="trilinear"), as_it_is))
    yield trace(replace(SCENES["lit"], lights=()))
    for way in ("by-pixel", "at-once"):
        yield trace(SCENES["clip"], Settings(presentation="triple", flush=way), region=(0, 0, 2, 2))
    depths = np.array([[[1.0, 3, 2]], [[1.0, 2, 3]]])
    for test in DEPTH_TESTS:
        yield trace(table_scene(DepthTable(depths, np.ones((2, 4)), test)))
    polygon = replace(make_scene("weiler-atherton"), clip_region=[0, 0, 1, 1], region_rings=None)
    yield trace(polygon, Settings(polygon_clipping="weiler-atherton"))
    # Corners that lie on a line before snapping, and beside it afterwards.
    line = np.array([[(5434, 4434), (5664, 3453), (6124, 1491)]]) / 1024
    for way in WAYS:
        yield trace(ClipScene(clip_of_window(line, (8, 8)), size=(8, 8)), Settings(interpolation=way))
    one_ended = one_ended_triangles(6, 30, (17, 13), gaps=(0.01, 10.0), sizes=(0.0001, 0.1))
    yield trace(ClipScene(one_ended, size=(17, 13)))
    yield trace(ClipScene(one_ended, size=(17, 13)), Settings(depth="logarithmic"))
    yield trace(SCENES["clip"], Settings(antialiasing="area"))
    yield trace(ClipScene(clip_of_window(line, (8, 8)), size=(8, 8)), Settings(coverage="inverse"))


@cache
def all_marks() -> tuple[Mark, ...]:
    """Return what any row of any trace marks, but in the source of a shader: there a step names what it sets itself."""
    load_subjects()
    found = {}
    usual = (each for group in traces().values() for each in group.values())
    for traced in chain(usual, rare_traces()):
        for stage in map(traced.stage, STAGES):
            for number, kind in enumerate(stage.steps.kinds):
                rows = np.flatnonzero(stage.steps.kind == number)
                for mark in marks_of(stage, kind, rows) if rows.size else ():
                    if isinstance(mark.listing, ShaderListing):
                        continue
                    found.setdefault((mark.key, mark.listing.function, mark.line, mark.changed), mark)
    return tuple(found.values())


def test_a_marked_line_gives_each_changed_variable_its_value() -> None:
    wrong = [
        (mark.name, sorted(mark.changed))
        for mark in all_marks()
        if not mark.changed <= mark.listing.assigned(mark.line)
    ]
    assert wrong == []


def test_a_step_that_changes_nothing_marks_a_decision() -> None:
    wrong = [
        mark.name for mark in all_marks() if not mark.operation.sets and not mark.listing.decides(mark.line)
    ]
    assert wrong == []


def test_what_a_listing_computes_is_set_by_its_line() -> None:
    wrong = [
        (mark.name, taken)
        for mark in all_marks()
        for taken in names(mark.operation.takes).values()
        if taken in mark.listing.everywhere
    ]
    assert wrong == []


NOT_MET = {("logarithm_of_w", "behind"), ("inverse_coefficients", "singular")}
"""Lines for pixels behind the eye that snapping has covered, and for triangles that culling drops by their area 0."""


def test_every_listing_is_stepped_and_every_label_is_marked() -> None:
    marked = {(mark.listing.function, mark.line) for mark in all_marks()}
    unmarked = {
        (found.name, label)
        for found in listings_of_the_program()
        for label, line in found.lines.items()
        if (found.function, line) not in marked
    }
    assert unmarked == NOT_MET
