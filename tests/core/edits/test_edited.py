"""Edited lines draw what they say: a mistake of the shelf that replaces a function is also an edit of a line."""

import pickle
from copy import deepcopy
from dataclasses import replace

import numpy as np
import pytest

from core import Settings, draw_picture, render, trace
from core.edits.edit import Edit, apply_edit, edits_of, original, place_of, without_edits
from core.edits.editable import EDITABLE, NOT_EDITABLE, refusal
from core.edits.typed import Typed
from core.explain.edited import edited_step
from core.explain.steps import formula, sentence
from core.framebuffer.display import to_display
from core.lanes.problem import Problem
from core.methods import table
from core.pixel_history import why
from core.records.listing import EditedListing
from core.settings import families
from core.shaders.presets import preset_program
from core.shading.lighting import blinn_phong
from core.textures.footprints import slopes_of_edit
from lessons.mistakes import clipping, coverage, depths, fragments
from lessons.mistakes import surfaces as textures
from lessons.mistakes.shelf import RULES
from lessons.scenes import make_scene

TWINS = {
    twin.name: twin for module in (clipping, coverage, depths, fragments, textures) for twin in module.TWINS
}
PLACE = "u * width, v * height"
WIDE = "len(pixels[0])"
ACROSS = f"u * {WIDE}"
ALPHA = "result.append(alpha + destination[3] * (1 - alpha))"
MISTAKES = {
    "parallel-kept": ("line_clipping", "if q < 0:", "if False:"),
    "normals-inward": (
        "line_clipping",
        "[(-dx, x0 - left), (dx, right - x0), (-dy, y0 - bottom), (dy, top - y0)]",
        "[(dx, left - x0), (-dx, x0 - right), (dy, bottom - y0), (-dy, y0 - top)]",
    ),
    "top-and-bottom": (
        "line_clipping",
        "(-dy, y0 - bottom), (dy, top - y0)]",
        "(-dy, top - y0), (dy, y0 - bottom)]",
    ),
    "all-edges-inclusive": ("fill", "value > 0 or (value == 0 and owns_tie[k])", "value >= 0"),
    "all-edges-exclusive": ("fill", "value > 0 or (value == 0 and owns_tie[k])", "value > 0"),
    "level-edges-never": ("fill_rule", "return b > 0", "return False"),
    "level-edges-always": ("fill_rule", "return b > 0", "return True"),
    "last-wins-ties": ("depth_test", "new < old", "new <= old"),
    "first-drawn-wins": ("depth_test", "new < old", "old == 1"),
    "half-texel-missing": ("texture_filter", PLACE, f"{PLACE} + 0.5".replace(",", " + 0.5,")),
    "half-texel-added": ("texture_filter", PLACE, f"{PLACE} + 1".replace(",", " + 1,")),
    "texels-of-one-less": ("texture_filter", ACROSS, f"({ACROSS}) * (({WIDE} - 1) / {WIDE})", "nearest"),
    "texel-rounded": ("texture_filter", ACROSS, f"{ACROSS} + 0.5", "nearest"),
    "negative-repeat": (
        "texture_filter",
        "return index % size",
        "return (-index - 1 if index < 0 else index) % size",
        "nearest",
    ),
    "weights-permuted": (
        "interpolation",
        "weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]",
        "weights[0] * values[2] + weights[1] * values[0] + weights[2] * values[1]",
    ),
}
"""By twin: what is edited, and one line of it, before and after."""
OF = {
    "cull": "back-normal",
    "line": "bresenham-lecture",
    "line_clipping": "liang-barsky",
    "fill": "bounding-box",
    "fill_rule": "shared-edge",
    "depth_test": "z-float32",
    "interpolation": "perspective",
    "texture_filter": "bilinear",
    "shading": "phong",
    "blend": "over",
}


def edit(part: str, old: str, new: str, of: str = "") -> Edit:
    """Return an edit of one place of a listing."""
    source = original(part, of or OF[part]).source
    assert source.count(old) == 1, (old, source)
    return Edit(part, of or OF[part], source.replace(old, new))


def mistaken(name: str, settings: Settings) -> Settings:
    """Return settings with a mistake of the shelf, as an edit of a line."""
    part, *change = MISTAKES[name]
    others = replace(settings, fill="bounding-box") if part == "fill" else settings
    return apply_edit(others, edit(part, *change))


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_that_is_an_edit_of_a_line_is_its_twin(name):
    twin = TWINS[name]
    for case, differs in ((twin.shows, True), (twin.hides, False)):
        same = replace(
            twin, change_settings=lambda settings: mistaken(name, settings), change_scene=lambda s: s
        )
        assert same.read(case) == twin.read(case)
        right = replace(twin, change_settings=lambda settings: settings, change_scene=lambda s: s).read(case)
        assert (same.read(case) != right) == differs


def test_values_come_from_the_listing_not_only_weights():
    settings = Settings()
    doubled = apply_edit(
        settings, edit("interpolation", "weights[0] * values[0] +", "2 * weights[0] * values[0] +")
    )
    scene = make_scene("intersecting")
    right, ours = render(scene, settings), render(scene, doubled)
    assert not np.array_equal(right.attributes, ours.attributes)
    np.testing.assert_array_equal(right.primitive, ours.primitive)
    wrong = trace(scene, doubled).stage("interpolate")
    np.testing.assert_array_equal(
        wrong.columns["weights"], trace(scene, settings).stage("interpolate").columns["weights"]
    )
    assert not np.array_equal(
        wrong.columns["values"], trace(scene, settings).stage("interpolate").columns["values"]
    )


def test_the_level_of_detail_follows_the_edited_values():
    scene = replace(make_scene("textured-floor"), size=(48, 48))
    settings = Settings(texture_filter="trilinear")
    source = original("interpolation", "perspective").source
    as_it_is = apply_edit(settings, Edit("interpolation", "perspective", source))
    right, same = trace(scene, settings).stage("shade"), trace(scene, as_it_is).stage("shade")
    np.testing.assert_array_equal(same.columns["uv_slopes"], right.columns["uv_slopes"])
    text = original("interpolation", "perspective").source.replace("return", "value = value * 4\n  return")
    four_times = apply_edit(settings, Edit("interpolation", "perspective", text))
    ours = trace(scene, four_times).stage("shade")
    textured = np.isfinite(right.columns["lod"])
    apart = ours.columns["lod"][textured] - right.columns["lod"][textured]
    np.testing.assert_allclose(apart, 2, atol=0.05)
    row = int(np.flatnonzero(textured)[0])
    slopes = slopes_of_edit(
        *(ours.columns[f"slope_{name}"][row] for name in ("rule", "right", "left", "up", "down"))
    )
    np.testing.assert_array_equal(slopes, ours.columns["uv_slopes"][row])
    step = ours.explain(ours.steps.position_after(row) - len(ours.steps.operations[ours.kind_of(row)]) + 1)
    assert "by your listing (u, v) change by" in sentence(step, -1, None)
    assert formula(step) is not None


INCLUSIVE = edit("fill", *MISTAKES["all-edges-inclusive"][1:])


@pytest.mark.parametrize("antialiasing", ["none", "ssaa-4", "msaa-4"])
@pytest.mark.parametrize("coverage", ["snapped", "float64", "inverse"])
def test_an_edited_inside_test_decides_samples_pictures_and_histories(antialiasing, coverage):
    scene = make_scene("shared-edge")
    plain = Settings(fill="bounding-box", antialiasing=antialiasing, coverage=coverage)
    ours, wanted = apply_edit(plain, INCLUSIVE), replace(plain, fill_rule="inclusive")
    found, right = render(scene, ours), render(scene, wanted)
    np.testing.assert_array_equal(found.cover_count, right.cover_count)
    np.testing.assert_array_equal(found.color, right.color)
    np.testing.assert_array_equal(draw_picture(scene, ours).pixels, to_display(found.color).pixels)
    differs = np.argwhere(found.cover_count != render(scene, plain).cover_count)
    assert len(differs)
    if antialiasing != "none":
        return
    source = trace(scene, ours).source
    for row, column in differs.tolist():
        assert why(source, column, row).cover_count == found.cover_count[row, column]


def test_a_pixel_that_an_edited_test_takes_or_leaves_is_so_in_its_history():
    scene, settings = make_scene("single-triangle"), Settings(fill="bounding-box")
    for text, key in (("return values, False", "all-missed"), ("return values, True", "seen")):
        ours = apply_edit(settings, edit("fill", "return values, all(inside)", text))
        frame = render(scene, ours)
        history = why(trace(scene, ours).source, 32, 20)
        assert (history.verdict.key == key) == ((frame.primitive[20, 32] >= 0) == (key == "seen"))
        assert history.cover_count == frame.cover_count[20, 32]


REFUSED = {
    "spans": ({"fill": "spans"}, "tests no pixel"),
    "blocks": ({"fill": "blocks"}, "whole blocks"),
    "int64": ({"coverage": "int64"}, "float64"),
    "exact": ({"coverage": "exact"}, "float64"),
    "area": ({"antialiasing": "area"}, "no pixel centre"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_would_pass_an_edit_over_is_refused_with_a_sentence(name):
    changes, words = REFUSED[name]
    if "fill" in changes:
        with pytest.raises(ValueError, match=words):
            Edit("fill", changes["fill"], INCLUSIVE.text)
        return
    with pytest.raises(ValueError, match=words):
        apply_edit(Settings(fill="bounding-box", **changes), INCLUSIVE)
    later = replace(apply_edit(Settings(fill="bounding-box"), INCLUSIVE), **changes)
    with pytest.raises(ValueError, match=words):
        render(make_scene("shared-edge"), later)


@pytest.mark.parametrize(
    ("part", "scene", "changes", "words"),
    [
        ("line", "shared-edge", {}, "only wireframes draw lines"),
        ("line", "points", {}, "a point is one pixel"),
        ("fill", "polygon-holes", {}, "edge table"),
        ("fill_rule", "segment", {}, "no area"),
        ("fill_rule", "shared-edge", {"fill": "scanline-lecture"}, "no fill rule"),
        ("interpolation", "segment", {}, "listings of their own"),
        ("depth_test", "shared-edge", {"visibility": "painters"}, "only the depth buffer"),
        ("depth_test", "depth-table", {}, "has its own"),
        ("blend", "segment", {"line": "wu"}, "blend over"),
        ("cull", "polygon-holes", {}, "sign of its area"),
        ("shading", "shared-edge", {}, "no lights"),
        ("texture_filter", "cube", {}, "no texture"),
    ],
)
def test_scenes_and_settings_that_would_not_run_an_edit_say_so(part, scene, changes, words):
    of = "opaque" if part == "blend" else OF[part]
    made = apply_edit(Settings(), Edit(part, of, original(part, of).source))
    for run in (render, lambda *given: trace(*given).stage("transform")):
        with pytest.raises(ValueError, match=words):
            run(make_scene(scene), replace(made, **changes))


def test_several_edits_stand_beside_each_other_in_one_family_too():
    settings = apply_edit(Settings(), edit("blend", ALPHA, "result.append(alpha)"))
    settings = apply_edit(settings, edit("depth_test", "new < old", "new <= old"))
    assert {known.part for known in edits_of(settings)} == {"blend", "depth_test"}
    again = apply_edit(settings, edit("depth_test", "new < old", "new > old"))
    assert len(edits_of(again)) == 2
    assert again != settings
    assert without_edits(again) == Settings(blend="over")


def test_an_edit_is_a_value():
    settings = apply_edit(Settings(line="dda"), edit("line", "if D > 0:", "if D >= 0:"))
    assert settings == deepcopy(settings) == pickle.loads(pickle.dumps(settings))
    assert len({settings, deepcopy(settings)}) == 1
    by_test = [
        apply_edit(Settings(), edit("fill", "value > 0 or", text))
        for text in ("value >= 0 or", "value > 1 or")
    ]
    assert by_test[0] != by_test[1]
    assert settings.line == "bresenham-lecture"
    method = table.get("line", settings.line)
    assert method.listing(0, 0, 4, 2, True) == [
        [k, y, D] for k, y, D in [(0, 0, 0), (1, 1, -4), (2, 1, 0), (3, 2, -4), (4, 2, 0)]
    ]


def test_the_listing_that_is_shown_is_the_text_and_labels_follow_their_lines():
    source = original("line", "bresenham-lecture").source
    text = source.replace("  D = 2 * dy - dx\n", "  twice = 2 * dy\n  D = twice - dx\n")
    settings = apply_edit(Settings(), Edit("line", "bresenham-lecture", text))
    stage = trace(make_scene("segment"), settings).stage("raster")
    (shown,) = {listed for listed in stage.listings.values() if isinstance(listed, EditedListing)}
    assert shown.source == text.rstrip("\n")
    assert place_of(shown, settings) == ("line", "bresenham-lecture")
    lines = shown.source.splitlines()
    for label, line in shown.original.lines.items():
        if label != "first-sum":
            assert lines[shown.lines[label] - 1] == source.splitlines()[line - 1]
    assert "twice" in lines[shown.lines["first-sum"] - 1]


def test_every_method_of_an_editable_family_is_editable_or_says_why_not():
    for part in EDITABLE.values():
        for of in table.names(part.family):
            reason = refusal(part.name, of)
            assert (reason == "") == (of not in part.refused)
            if reason:
                assert reason.endswith(".")
                with pytest.raises(ValueError, match=r"\."):
                    original(part.name, of)
        assert part.refused.keys() <= set(table.names(part.family))
    with_part = {part.family for part in EDITABLE.values()}
    assert with_part | NOT_EDITABLE.keys() == set(families())
    assert not with_part & NOT_EDITABLE.keys()
    assert refusal("wrap", "repeat") == NOT_EDITABLE["wrap"]
    assert refusal("shade", "phong").startswith("What can be edited")


@pytest.mark.parametrize("of", ["liang-barsky", "cohen-sutherland", "cyrus-beck"])
def test_steps_of_a_clipper_tell_its_own_lines_border_by_border(of):
    text = original("line_clipping", of).source.replace("t = ", "t = 0 + ")
    wireframe = Settings(polygon_mode="wireframe", line_clipping=of)
    stage = trace(
        make_scene("clipped-segment"), apply_edit(wireframe, Edit("line_clipping", of, text))
    ).stage("raster")
    rows = np.flatnonzero(stage.columns["clip_row"] >= 0)
    wanted = stage.columns["crossing_t" if of != "cohen-sutherland" else "clip_row"][rows]
    for row, number in zip(rows.tolist(), wanted.tolist(), strict=True):
        first, end = stage.steps.starts[row : row + 2].tolist()
        said = " ".join(sentence(stage.explain(k), -1, None) for k in range(first + 1, end + 1))
        assert "Pixel" not in said
        assert "segment" not in said
        if of != "cohen-sutherland" and np.isfinite(number):
            assert f"t = {number:.4g}." in said
        if of == "cohen-sutherland":
            assert f"codes = ({stage.columns['code_start'][row]}, {stage.columns['code_end'][row]})" in said


def test_the_classical_error_of_culling_is_an_edit_of_a_line():
    scene = make_scene("cube")
    text = edit("cull", "(0.0, 0.0, -1.0) if is_parallel else (ax, ay, az)", "(0.0, 0.0, -1.0)")
    ours, wrong = apply_edit(Settings(), text), Settings(cull="back-axis")
    found = trace(scene, ours).stage("cull")
    np.testing.assert_array_equal(
        found.extra["culled"].drops, trace(scene, wrong).stage("cull").extra["culled"].drops
    )
    turned = apply_edit(Settings(), edit("cull", "product > 0", "product < 0"))
    right = trace(scene, Settings(cull="back-normal")).stage("cull").extra["culled"]
    np.testing.assert_array_equal(trace(scene, turned).stage("cull").extra["culled"].drops, right.side > 0)
    said = [sentence(found.explain(k), -1, None) for k in range(1, found.steps.count + 1)]
    assert any(text.startswith("Line 7: product = ") for text in said)


def test_a_light_of_shaders_is_not_edited():
    scene = replace(make_scene("cube"), size=(16, 16))
    shaders = replace(scene, program=preset_program("phong", scene))
    ours = apply_edit(Settings(), Edit("shading", "phong", original("shading", "phong").source))
    with pytest.raises(ValueError, match="the scene's own shaders do it"):
        render(shaders, ours)


LIGHTS = {
    "light-unclamped": ("max(n_dot_l, 0.0)", "n_dot_l"),
    "normal-too-long": ("unit(normal), ", "normal, "),
    "highlight-at-light": ("max(n_dot_h, 0.0)", "max(n_dot_l, 0.0)"),
    "highlight-at-eye": ("inner(n, h)", "inner(n, v)"),
    "light-reversed": ("else unit(place)", "else unit([-place[0], -place[1], -place[2]])"),
}
"""By wrong formula of the shelf: a line of the light, before and after."""


@pytest.mark.parametrize("name", LIGHTS)
def test_a_mistake_in_the_light_that_is_an_edit_of_a_line_is_its_formula(name):
    rule = RULES[name]
    typed = Typed(blinn_phong, edit("shading", *LIGHTS[name]).text)
    right = Typed(blinn_phong, original("shading", "phong").source)
    for numbers in (rule.shows, rule.hides):
        if name.startswith("highlight"):
            normal, to_light, to_eye, shininess = numbers
            material, which = (0.0, 0.0, 1.0, shininess), 1
        else:
            ambient, normal, to_light = numbers
            material, to_eye, which = (ambient, 1 - ambient, 0.0, 1.0), (0, 0, 1), 0
        given = (0.0, 0.0, 0.0), normal, to_eye, [(to_light, False, (1.0, 1.0, 1.0))], material, False
        for text, formula_of in ((typed, rule.wrong), (right, rule.right)):
            np.testing.assert_allclose(text(*map(_listed, given))[which], formula_of(*numbers)[0])


def _listed(value):
    return [_listed(part) for part in value] if isinstance(value, tuple | list) else value


def test_a_texel_is_a_colour():
    plain = Settings(texture_filter="nearest")
    ours = apply_edit(
        plain, edit("texture_filter", "tuple(pixels[row][column])", "pixels[row][column]", "nearest")
    )
    scene = replace(make_scene("textured-floor"), size=(16, 16))
    np.testing.assert_array_equal(render(scene, ours).color, render(scene, plain).color)


def test_every_line_that_runs_is_told_by_a_step_of_its_row():
    scene = replace(make_scene("textured-floor"), size=(16, 16))
    for part, of in (("interpolation", "perspective"), ("texture_filter", "bilinear"), ("shading", "phong")):
        ours = apply_edit(Settings(), Edit(part, of, original(part, of).source))
        stage = trace(scene, ours).stage(EDITABLE[part].stage)
        first, end = stage.steps.starts[:2].tolist()
        said = [sentence(stage.explain(k), -1, None) for k in range(first + 1, end + 1)]
        assert not any("does not run here" in text for text in said), said
        done = [stage.explain(k) for k in range(first + 1, end + 1)]
        steps = [edited_step(each) for each in done if isinstance(each.listing, EditedListing)]
        assert steps[-1].steps[-1].kind == "return"
    filtered = apply_edit(
        Settings(), Edit("texture_filter", "bilinear", original("texture_filter", "bilinear").source)
    )
    text = sentence(trace(scene, filtered).stage("shade").explain(2), -1, None)
    assert "(left, right) = (" in text


def test_an_endless_loop_of_a_line_ends_with_its_line():
    with pytest.raises(Problem, match="does it ever end") as caught:
        render(make_scene("segment"), apply_edit(Settings(), edit("line", "x += sx", "x = x")))
    assert caught.value.line == 12


@pytest.mark.parametrize("end", ["[]", "[x1]", "[x1, [y1]]", "x1"])
def test_an_end_of_a_clipper_is_two_numbers(end):
    source = original("line_clipping", "liang-barsky").source
    text = source.replace("[[x0, y0], [x1, y1]]", f"[{end}, {end}]").replace("if k >= 0:", "if k < -1:")
    settings = apply_edit(Settings(polygon_mode="wireframe"), Edit("line_clipping", "liang-barsky", text))
    with pytest.raises(Problem, match="the ends that are left must be two, each"):
        render(make_scene("clipped-segment"), settings)
