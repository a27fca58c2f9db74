"""The listings, executed, give the numbers of the rows bit for bit."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, trace
from core.antialiasing.exact_area import piece_sum
from core.antialiasing.pixel_pieces import SQUARE, cut_polygon, polygon_area, shown_areas
from core.antialiasing.resolve import weighted_mean
from core.framebuffer.display import srgb_byte
from core.methods import table
from core.resolved import resolve
from core.trace import Trace
from core.trace.sample_sources import CenterSource, finer_source, sources_of_samples
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace
from core.trace.tracers import tracer_of
from tests.core.strategies import ANY_TRIANGLES
from tests.core.trace.depth_listings import check_blend, check_depth
from tests.core.trace.executed_rows import equal, rows_of_kind
from tests.core.trace.fragment_listings import check_interpolate, check_shade
from tests.core.trace.geometry_listings import check_clip, check_cull, check_edges, check_transform
from tests.core.trace.order_listings import check_sort, check_tree
from tests.core.trace.raster_listings import check_bin, check_raster
from tests.core.trace.trace_cases import EACH_METHOD, SCENES, name_of, settings_of, small_region
from tests.covering import in_turn


def check_resolve(traced: Trace) -> None:
    found = traced.stage("resolve")
    rules = {"average": weighted_mean, "areas": piece_sum}
    for kind in found.steps.kinds:
        for row in rows_of_kind(found, kind) if kind in rules else []:
            samples, weights = found.columns["samples"][row], found.columns["sample_weights"][row]
            values = [samples[:, k].tolist() for k in range(4)]
            with np.errstate(invalid="ignore", over="ignore"):
                mixed = [rules[kind](*((v, weights) if kind == "average" else (weights, v))) for v in values]
            assert equal(mixed, found.columns["linear"][row])
    if "cut" in found.steps.kinds:
        check_cuts(found)
    for row in rows_of_kind(found, found.steps.kinds[0]):
        linear, shown = found.columns["linear"][row], found.columns["bytes"][row]
        assert [srgb_byte(float(value)) for value in linear[:3]] == shown[:3].tolist()


def check_cuts(found: StageTrace) -> None:
    """Cut the squares of pixels again, edge by edge, and measure what is left."""
    c = found.columns
    for kind in ("cut", "piece"):
        for row in rows_of_kind(found, kind):
            before, after = (
                [(float(x), float(y)) for x, y in c[name][row] if np.isfinite(x)]
                for name in ("before", "polygon")
            )
            if kind == "piece":
                assert polygon_area(after) == c["piece_area"][row]
                parts = c["part_area"][row].tolist(), c["part_primitive"][row].tolist()
                shown = shown_areas(*parts, int(c["primitive"][row]))
                assert shown == (c["seen_area"][row], c["covered_area"][row])
                continue
            if c["edge"][row] == 0:
                assert before == [tuple(corner) for corner in SQUARE.tolist()]
            else:
                previous = c["polygon"][row - 1]
                assert np.array_equal(previous, c["before"][row], equal_nan=True)
            assert cut_polygon(before, *(float(c[name][row]) for name in ("a", "b", "value"))) == after
            assert len(after) == c["corner_count"][row]


CHECKS = (
    check_transform,
    check_cull,
    check_clip,
    check_edges,
    check_bin,
    check_raster,
    check_interpolate,
    check_shade,
    check_depth,
    check_blend,
)
CENTER_CHECKS = (check_interpolate, check_shade)


class OnePart:
    """The stages of one source, as the traces of several samples are joined from."""

    def __init__(self, source: TraceSource) -> None:
        self.source = source

    def stage(self, name: str) -> StageTrace:
        return tracer_of(name)(self.source)


def check_order(traced: Trace) -> None:
    """Execute the listings of the order, whose rows come before those of the stage."""
    check = {"painters": check_sort, "bsp": check_tree}.get(traced.source.settings.visibility)
    if check is not None and traced.source.triangle is None and traced.source.scene.corner_count:
        check(traced.stage("depth"))


def check_all(traced: Trace) -> None:
    """Execute the listings of all stages: of several samples, on what the rows of each were made from."""
    source = traced.source
    check_order(traced)
    side = resolve(source.settings).sampling.side
    check_resolve(traced)
    if side:
        parts = [(finer_source(source, side), CHECKS)]
    elif source.settings.antialiasing == "msaa-4":
        samples = sources_of_samples(source)
        of_sample = tuple(check for check in CHECKS if check not in CENTER_CHECKS)
        parts = [(sample, of_sample) for sample in samples]
        centers = CenterSource(source.scene, source.settings, source.triangle, source.region, samples=samples)
        parts.append((centers, CENTER_CHECKS))
    else:
        parts = [(replace(source, settings=replace(source.settings, antialiasing="none")), CHECKS)]
    for part, checks in parts:
        for check in checks:
            check(OnePart(part))


@pytest.mark.parametrize(
    ("name", "choice"), in_turn(["clip", "lit", "orthographic", "textured-clip"], EACH_METHOD), ids=name_of
)
def test_listings_of_all_stages(name, choice):
    scene = SCENES[name]
    traced = trace(scene, settings_of(choice, scene), region=small_region(scene))
    check_all(traced)


@pytest.mark.parametrize(
    ("fill", "name"),
    in_turn(
        ["hierarchy", "scanline", "scanline-lecture", "spans"],
        [
            name
            for name, scene in SCENES.items()
            if name not in ("clip", "lit", "orthographic") and scene.corner_count < 4
        ],
    ),
)
def test_listings_on_the_built_in_scenes(name, fill):
    depth = "fixed-38" if fill == "spans" else "z-float32"
    traced = trace(SCENES[name], Settings(fill=fill, depth=depth), region=small_region(SCENES[name]))
    check_all(traced)


FILLS = st.sampled_from(["hierarchy", "blocks", "scanline", "scanline-lecture", "spans", "incremental"])


@given(
    ANY_TRIANGLES,
    FILLS,
    st.sampled_from(["homogeneous", "sutherland-hodgman"]),
    st.sampled_from(table.names("coverage")),
    st.sampled_from(table.names("depth")),
)
def test_listings_on_any_triangles(case, fill, clipping, coverage, depth):
    clip, size = case
    values = np.linspace(0, 1, clip.size).reshape(clip.shape)
    scene = ClipScene(clip, values, size)
    traced = trace(
        scene,
        Settings(fill=fill, clipping=clipping, coverage=coverage, depth=depth, block_size=2, blend="over"),
    )
    check_all(traced)
