"""Where a number comes from: always an earlier step, where the same number stands."""

import numpy as np
import pytest

from core import STAGES, Settings, Trace, trace
from core.scene import AnyScene
from core.trace.origins import SOURCES, origin
from lessons.scenes import make_scene


def middle(scene: AnyScene) -> tuple[int, int, int, int]:
    """Return a small region in the middle of a scene's picture."""
    width, height = scene.size
    return width // 2 - 8, height // 2 - 6, 16, 12


def origins(run: Trace, stage: str, rows: int) -> list[tuple[str, int]]:
    """Return the variables that come from elsewhere, at some rows of a stage, after checking each."""
    here = run.stage(stage)
    found = []
    for row in (
        np.unique(np.linspace(0, here.steps.row_count - 1, rows).astype(int)) if here.steps.row_count else ()
    ):
        position = int(here.steps.starts[row + 1])
        for name, column in here.columns.items():
            for element in (None, *range(3)) if column.ndim == 2 and column.shape[1] == 3 else (None,):
                made = origin(run, stage, position, name, element)
                if made is None:
                    continue
                assert (STAGES.index(made.stage), made.position) < (STAGES.index(stage), position)
                there = run.stage(made.stage)
                its_row, _ = there.steps.row_at(made.position)
                held = np.ravel(there.columns[made.variable][its_row])
                if element is not None and len(held) > 1:
                    held = held[[element]]
                value = np.ravel(column[row] if element is None else column[row][element])
                if made.is_alike:
                    assert (stage, name) in [("interpolate", letter) for letter in "abc"]
                elif f"{stage}.{name}" in SOURCES or made.stage != stage:
                    assert all(held[: len(value)] == value[: len(held)]) or its_row == row
                found.append((f"{stage}.{name}", int(row)))
    return found


@pytest.mark.parametrize("name", ["single-triangle", "intersecting", "textured-floor", "sphere"])
def test_the_same_number_stands_in_an_earlier_step(name: str) -> None:
    scene = make_scene(name)
    run = trace(scene, Settings(fill="bounding-box"), region=middle(scene))
    names = {name for stage in STAGES for name, _ in origins(run, stage, 12)}
    assert {"raster.a", "raster.b", "raster.c", "blend.source", "resolve.linear"} <= names


def test_a_byte_is_followed_to_a_vertex() -> None:
    scene = make_scene("cube")
    run = trace(scene, region=middle(scene))
    shown = np.argwhere(run.source.picture.primitive >= 0)[0][::-1] + run.source.raster.bounds[:2]
    rows = run.stage("resolve").rows_at_pixel(*shown)
    at = origin(run, "resolve", int(run.stage("resolve").steps.starts[rows[0] + 1]), "linear")
    way = []
    for variable in ("source", "vertex_color"):
        way.append(at.stage)
        at = origin(run, at.stage, at.position, variable)
    way.append(at.stage)
    at = origin(run, at.stage, at.position, "corner_w", 0)
    while at is not None:
        way.append(at.stage)
        at = origin(run, at.stage, at.position, "before_w")
    assert way == ["blend", "shade", "interpolate", "transform", "transform", "transform"]


def test_what_was_given_and_what_this_step_made_come_from_nowhere() -> None:
    run = trace(make_scene("single-triangle"), region=(10, 10, 20, 16))
    raster = run.stage("edges")
    assert origin(run, "edges", 0, "a") is None
    assert origin(run, "edges", int(raster.steps.starts[4]) + 1, "a") is None
    later = origin(run, "edges", int(raster.steps.starts[4]) + 3, "a")
    assert (later.stage, later.position) == ("edges", int(raster.steps.starts[4]) + 1)
    assert origin(run, "transform", 1, "before_x") is None
    assert origin(run, "transform", 1, "no such variable") is None


def test_the_numbers_of_bresenham_come_from_the_steps_that_made_them() -> None:
    run = trace(make_scene("segment"), Settings(line="bresenham"))
    raster = run.stage("raster")
    names = [raster.explain(k).key.rpartition(".")[2] for k in range(1, raster.steps.count + 1)]
    second = int(raster.steps.starts[2])
    position = names.index("advance", second) + 1
    for variable, wanted in (("dy", "lengths"), ("sum_before", "advance"), ("major_before", "next")):
        made = origin(run, "raster", position, variable)
        assert names[made.position - 1] == wanted
        assert made.position <= second
