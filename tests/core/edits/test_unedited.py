"""A listing that was not changed draws what the rule draws, bit for bit: in the picture, the trace and every lane."""

from dataclasses import fields, replace

import numpy as np
import pytest

from core import Settings, Texture, clip_lines, draw_lines, render, trace
from core.edits.edit import Edit, apply_edit, edits_of, original, place_of, without_edits
from core.edits.editable import EDITABLE, refusal
from core.edits.typed import Typed
from core.explain.steps import variables
from core.lanes.python_values import at_lane
from core.lines.line_method import check_segments
from core.methods import table
from core.pixel_history import why
from core.stages.needs import refusal as refusal_of_scene
from lessons.mistakes.twin import frame_bytes
from lessons.scenes import make_scene, scene_names
from tests.core.trace.trace_cases import lit_scene, textured_clip_scene
from tests.covering import every_nth, is_everything

CASES = [
    (part.name, of)
    for part in EDITABLE.values()
    for of in table.names(part.family)
    if not refusal(part.name, of)
]
SCENES = {name: scene for name in scene_names() if max((scene := make_scene(name)).size) <= 64} | {
    "textured-clip": textured_clip_scene(),
    "textured-grey": replace(textured_clip_scene(), texture=Texture(np.linspace(0, 1, 12).reshape(3, 4, 1))),
    "textured-floor": replace(make_scene("textured-floor"), size=(32, 24)),
    "lit": lit_scene(),
    "lit-parallel": lit_scene("orthographic"),
}
OF_LINES = ("line", "line_clipping")
"""Parts of which only outlines are drawn."""
FEW = ("intersecting", "near-plane", "fan")
"""Of the triangles, those whose outlines are drawn here."""


SHOWN = {**dict.fromkeys(OF_LINES, "clipped-segment"), "texture_filter": "textured-clip", "shading": "lit"}
"""Scenes of which a stage is traced, where an edit does not run in the usual one."""


def settings_for(part: str, of: str) -> Settings:
    """Return settings in which an edit of a part runs."""
    family = EDITABLE[part].family
    plain = Settings(fill="bounding-box", blend="opaque" if part in OF_LINES else "over")
    return replace(plain, **{"polygon_mode": "wireframe" if part in OF_LINES else "fill", family: of})


def unedited(part: str, of: str) -> Settings:
    """Return settings that run the text of a listing in the lanes."""
    return apply_edit(settings_for(part, of), Edit(part, of, original(part, of).source))


@pytest.mark.parametrize(("part", "of"), CASES)
def test_draws_what_the_rule_draws_in_every_small_scene(part, of):
    plain, typed = settings_for(part, of), unedited(part, of)
    (edit,) = edits_of(typed)
    fitting = []
    for name, scene in SCENES.items():
        if part in OF_LINES and scene.corner_count == 3 and name not in FEW:
            continue
        if refusal_of_scene(EDITABLE[part].family, of, scene):
            continue
        if edit.passed_over(typed, scene):
            with pytest.raises(ValueError, match="would not run"):
                render(scene, typed)
            continue
        fitting.append(scene)
    assert len(fitting) >= 3
    for scene in fitting if is_everything() else fitting[:: max(1, len(fitting) // 2)]:
        assert frame_bytes(render(scene, plain)) == frame_bytes(render(scene, typed)), scene


@pytest.mark.parametrize(
    ("part", "of"), [case for case in CASES if case[0] == "line" or case in every_nth(CASES, 3)]
)
def test_the_trace_and_the_history_of_a_pixel_are_those_of_the_rule(part, of):
    plain, typed = settings_for(part, of), unedited(part, of)
    stage, scene = EDITABLE[part].stage, SCENES[SHOWN.get(part, "intersecting")]
    right, ours = trace(scene, plain), trace(scene, typed)
    its = ours.stage(stage).columns
    assert part in ("texture_filter", "shading") or right.stage(stage).columns.keys() <= its.keys()
    for name, column in right.stage(stage).columns.items():
        if name not in its:
            continue  # Numbers of texels and lights that a listing does not return.
        if part != "line" or name not in left_open(of):
            np.testing.assert_array_equal(ours.stage(stage).columns[name], column, err_msg=name)
    its = ours.stage("edges" if part == "fill_rule" else stage)
    shown = [listed for listed in its.listings.values() if place_of(listed, typed) == (part, of)]
    assert shown
    assert {listed.source for listed in shown} == {original(part, of).source}
    if of == "bresenham-float":
        return  # Its decision is not in the listing, and stands in the history of a pixel.
    column, row = ours.stage("raster").pixel[-1].tolist()
    for position in range(1, min(its.steps.count, 40) + 1):
        for each in variables(its.explain(position)):
            assert each.now is None or isinstance(each.now, bool | int | float | str | tuple), each
    found = str(why(ours.source, column, row)).replace("'is_edited': True", "'is_edited': False")
    assert found == str(why(right.source, column, row))


LEFT_OPEN = frozenset(
    {"exit_start", "exit_end", "along", "line_distance", "share", "is_tie"}
    | {"sum_before", "sum_corrected", "sum_advanced"}
)
"""Columns of lines that a listing does not return."""


def left_open(of: str) -> frozenset[str]:
    """Return the columns that the listing of a line method does not return; the float version adds the slope."""
    if of == "bresenham-float":
        return LEFT_OPEN | {"decision", "fraction", "previous"}
    counts_others = of in ("rectangle", "wu", "gupta-sproull")
    return LEFT_OPEN | (OF_COLUMNS if counts_others else {"sy"} if of == "dda-float32" else set())


OF_COLUMNS = frozenset(("index", "has_stepped", "minor_before", "major_before", "entry", "filtered", "sy"))
"""Columns of methods that look at several pixels of a column, and count those that they leave out, too."""


@pytest.mark.parametrize("of", [of for part, of in CASES if part == "line"])
@pytest.mark.parametrize("last_pixel", [False, True])
def test_lines_of_all_octants_ties_and_points(of, last_pixel):
    typed, rng = unedited("line", of), np.random.default_rng(3)
    ends = np.concatenate(
        [
            rng.integers(0, 25, (60, 2, 2)) + 0.5,
            rng.uniform(-6, 30, (60, 2, 2)),
            np.repeat(rng.uniform(0, 24, (6, 1, 2)), 2, axis=1),
            rng.integers(0, 50, (40, 2, 2)) / 2,
        ]
    )
    right = draw_lines(ends, 24, 24, of, last_pixel)
    ours = draw_lines(ends, 24, 24, typed.line, last_pixel)
    for name in ("pixels", "intensities", "owner"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(right, name))
    for field in fields(right.steps):
        if field.name not in left_open(of):
            found, wanted = getattr(ours.steps, field.name), getattr(right.steps, field.name)
            np.testing.assert_array_equal(found, wanted, err_msg=field.name)


@pytest.mark.parametrize("of", [of for part, of in CASES if part == "line_clipping"])
def test_clippers_cut_many_segments_by_different_edges(of):
    segments = np.random.default_rng(4).integers(-8, 20, (200, 2, 2)) * 1.25
    right, ours = (
        clip_lines(segments, (0, 0, 12, 9), method)
        for method in (of, unedited("line_clipping", of).line_clipping)
    )
    np.testing.assert_array_equal(ours.segments, right.segments)
    np.testing.assert_array_equal(ours.cut_by, right.cut_by)


@pytest.mark.parametrize("of", every_nth([of for part, of in CASES if part == "line"], 3))
def test_a_lane_alone_is_that_lane_of_the_batch_and_the_scalar_listing(of):
    listed = original("line", of)
    typed, rng = Typed(listed.function, listed.source), np.random.default_rng(5)
    takes_pixels = Settings(line=of).line.startswith("bresenham")
    size = (40 if is_everything() else 12, 4)
    ends = rng.integers(-4, 20, size) if takes_pixels else rng.integers(-64, 300, size) / 16
    batch = typed.program.run([*ends.T.copy(), True], len(ends))
    for lane, values in enumerate(ends.tolist()):
        alone = typed.program.run([*(np.array([value]) for value in values), True], 1)
        numbers = [list(pixel) for pixel in listed.function(*values, True)]
        assert at_lane(batch, lane) == at_lane(alone, 0) == [list(pixel) for pixel in typed(*values, True)]
        assert at_lane(batch, lane) == numbers


def hard_numbers(count: int, rng: np.random.Generator) -> np.ndarray:
    """Return numbers with zeros, ties, infinities, NaN and signs of all kinds."""
    hard = np.array([0.0, -0.0, 1.0, -1.0, 0.5, np.inf, -np.inf, np.nan, 1e300, 5e-324, 2.0**53])
    return np.where(rng.random(count) < 0.4, rng.choice(hard, count), rng.normal(size=count) * 50)


def scalar_cases() -> dict[str, list]:
    """Return arguments of listings that decide on a pixel, a row for each lane."""
    rng, count = np.random.default_rng(11), 300

    def three() -> np.ndarray:
        return np.stack([hard_numbers(count, rng) for _ in range(3)], axis=1)

    flags = rng.random((count, 3)) < 0.5
    place = [rng.integers(0, 60, count) + 0.5 for _ in range(2)]
    single = [rng.random(count).astype(np.float32).round(1) for _ in range(2)]
    return {
        "covers": [three(), three(), three(), flags, *place],
        "owns": [hard_numbers(count, rng), hard_numbers(count, rng)],
        "interpolate_at": [three(), three(), three(), *place, three()],
        "interpolate_affine_at": [three(), three(), three(), three(), *place, three()],
        "depth_test": [*single, flags[:, 0], flags[:, 1]],
        "over_pixel": [rng.random((count, 4)), rng.random((count, 4)).astype(np.float32)],
        "additive_pixel": [rng.random((count, 4)), rng.random((count, 4)).astype(np.float32)],
    }


@pytest.mark.parametrize("name", scalar_cases())
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_listings_of_a_pixel_are_those_of_python_lane_by_lane(name):
    """Python divides by no zero: NumPy's numbers stand for it, which give infinity and NaN as the picture does."""
    (listed,) = {original(part, of) for part, of in CASES if original(part, of).function.__name__ == name}
    rows = scalar_cases()[name]
    values = [list(np.ascontiguousarray(row.T)) if row.ndim == 2 else row for row in rows]
    batch = Typed(listed.function, listed.source).program.run(values, len(rows[0]))
    for lane in range(len(rows[0])):
        mine = listed.function(*(row[lane] for row in rows))
        np.testing.assert_array_equal(_flat(at_lane(batch, lane)), _flat(mine))


def _flat(value) -> np.ndarray:
    parts = value if isinstance(value, list | tuple) else [value]
    return np.concatenate(
        [_flat(part) if isinstance(part, list | tuple) else [float(part)] for part in parts]
    )


def test_check_segments_with_edited_lines_of_any_count():
    typed = unedited("line", "dda")
    none = table.get("line", typed.line).function(check_segments(np.zeros((0, 2, 2)), 8, 8, 0.5), True)
    assert len(none.owner) == 0


def test_an_edit_keeps_what_its_own_method_needs_and_goes_again():
    typed = unedited("interpolation", "affine")
    method = table.get("interpolation", typed.interpolation)
    assert method.needs == table.get("interpolation", "affine").needs == ("positive-w",)
    assert method.title.endswith("(edited)")
    assert without_edits(typed) == settings_for("interpolation", "affine")
    assert typed == unedited("interpolation", "affine")
    assert typed != without_edits(typed)
