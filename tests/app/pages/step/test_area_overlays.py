"""The polygon that a pixel's square is cut to, as the grid draws it."""

import numpy as np
import pytest

from app.pages.step.grid_overlays import area_overlays
from app.session.moment import Cursor, Step
from core import ClipScene, Settings, trace
from tests.covering import every_nth

CLIP = [[[-1, -1, 0, 1], [0.5, -1, 0, 1], [-1, 0.75, 0, 1]]]


def shown(settings: Settings, region: tuple[int, int, int, int], position: int) -> dict[str, np.ndarray]:
    traced = trace(ClipScene(CLIP, size=(4, 4)), settings, region=region)
    return {o.key: o.segments for o in area_overlays(Step(traced, Cursor("resolve", position)))}


@pytest.mark.parametrize("pixel_center", every_nth(["half", "integer"], 2))
def test_the_polygon_stands_in_its_pixel(pixel_center: str) -> None:
    settings, region = Settings(antialiasing="area", pixel_center=pixel_center), (1, 1, 3, 3)
    traced = trace(ClipScene(CLIP, size=(4, 4)), settings, region=region)
    stage = traced.stage("resolve")
    places = 0
    for position in range(1, stage.steps.count + 1):
        row, operation = stage.steps.row_at(position)
        found = shown(settings, region, position)
        if stage.kind_of(row) == "areas":
            assert found == {}
            continue
        assert ("cutting edge" in found) == (stage.kind_of(row) == "cut")
        middle = stage.pixel[row] - 1 + traced.source.raster.center
        assert (np.abs(found["cut polygon"] - middle) <= 0.5 + 1e-12).all()
        is_before = stage.kind_of(row) == "cut" and operation == 0
        corners = stage.columns["before" if is_before else "polygon"][row]
        assert len(found["cut polygon"]) == np.isfinite(corners[:, 0]).sum()
        places += 1
    assert places > 10


def test_the_edge_runs_where_its_function_is_zero() -> None:
    settings, region = Settings(antialiasing="area"), (0, 0, 4, 4)
    traced = trace(ClipScene(CLIP, size=(4, 4)), settings, region=region)
    stage, edges = traced.stage("resolve"), traced.source.geometry.edges
    cuts = np.flatnonzero(stage.steps.kind == stage.steps.kinds.index("cut"))
    for row in cuts:
        ends = shown(settings, region, stage.steps.position_after(int(row)))["cutting edge"][0]
        k = stage.columns["edge"][row]
        assert np.allclose(
            edges.a[0, k] * ends[:, 0] + edges.b[0, k] * ends[:, 1] + edges.c[0, k], 0, atol=1e-9
        )
    assert len(cuts) > 5


def test_other_stages_and_methods_have_none() -> None:
    traced = trace(ClipScene(CLIP, size=(4, 4)), Settings(antialiasing="msaa-4"))
    assert area_overlays(Step(traced, Cursor("resolve", 3))) == []
    assert area_overlays(Step(traced, Cursor("raster", 3))) == []
