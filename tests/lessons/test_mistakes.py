"""Every faulty twin shows in one scene and hides in another; the figures that go with some of them."""

from importlib import import_module
from pkgutil import iter_modules

import numpy as np
import pytest

from core import Settings, render, trace
from lessons import mistakes
from lessons.mistakes import coverage, scan_conversion
from lessons.mistakes.clipping import ACROSS, segment
from lessons.mistakes.shelf import MISTAKES, RULES, SHADERS, SHELF, twin_named
from lessons.mistakes.twin import ENTERED, Twin, WrongRule, line_pixels, right_reading


@pytest.mark.parametrize("twin", SHELF.values(), ids=SHELF)
def test_a_mistake_shows_in_one_scene_and_hides_in_another(twin: Twin) -> None:
    assert twin.read(twin.shows) != right_reading(twin.shows)
    assert twin.read(twin.hides) == right_reading(twin.hides)
    if twin.hides.reading is None:
        assert (render(twin.hides.scene, twin.hides.settings).primitive >= 0).any(), "nothing is drawn"
    assert twin.sentence.endswith(".")


@pytest.mark.parametrize("rule", RULES.values(), ids=RULES)
def test_a_wrong_formula_shows_in_one_place_and_hides_in_another(rule: WrongRule) -> None:
    assert rule.right(*rule.shows) != rule.wrong(*rule.shows)
    assert rule.right(*rule.hides) == rule.wrong(*rule.hides)
    assert rule.sentence.endswith(".")


def test_names_are_unique_and_unknown_ones_refused() -> None:
    modules = [import_module(f"lessons.mistakes.{found.name}") for found in iter_modules(mistakes.__path__)]
    assert len(SHELF) == sum(len(getattr(module, "TWINS", ())) for module in modules)
    assert len(RULES) == sum(map(len, ENTERED.values()))
    both = SHELF.keys() & RULES.keys()
    assert both == {
        *("front-and-back-swapped", "octant-of-centre", "sorted-after-division"),
        *("list-not-sorted", "sorted-farthest-first"),
        *("reflection-sign", "face-by-signed-largest", "place-not-divided"),
        *("nearest-in-pyramid", "mean-in-pyramid"),
    }
    assert all(SHELF[name].sentence == RULES[name].sentence for name in both)
    assert len(MISTAKES) == len(SHELF) + len(RULES) - len(both) + len(SHADERS)
    with pytest.raises(ValueError, match="expected a mistake such as corner-for-center"):
        twin_named("'; DROP TABLE twins")


def covers(name: str, scene) -> tuple[int, int]:
    frame = twin_named(name).draw(scene, Settings()) if name else render(scene)
    return int((frame.primitive >= 0).sum()), int((frame.cover_count > 1).sum())


def test_the_square_on_centres_has_25_or_6_pixels_for_16() -> None:
    assert covers("", coverage.SQUARE) == (16, 0)
    assert covers("all-edges-inclusive", coverage.SQUARE) == (25, 5)
    assert covers("all-edges-exclusive", coverage.SQUARE) == (6, 0)
    assert covers("", coverage.WHOLE) == covers("corner-for-center", coverage.WHOLE) == (11, 0)


def test_lines_go_wrong_where_they_are_known_to() -> None:
    def pixels(name: str, case) -> set[tuple[int, int]]:
        settings = twin_named(name).change_settings(case.settings) if name else case.settings
        return line_pixels(case.scene, settings)

    right = pixels("", scan_conversion.GENTLE)
    columns = {
        name: {x for x, _ in pixels(name, scan_conversion.GENTLE) ^ right}
        for name in ("ties-step", "row-truncated")
    }
    assert columns == {"ties-step": {5}, "row-truncated": {3, 6, 8}}
    assert {x for x, _ in pixels("start-not-doubled", scan_conversion.GENTLE) ^ right} == {8}
    steep = twin_named("one-octant").shows
    assert {y for _, y in pixels("one-octant", steep)} == {1, 2, 3}
    assert max(y for _, y in pixels("slope-always-up", twin_named("slope-always-up").shows)) == 7


def test_clipped_ends_are_those_of_the_mistakes() -> None:
    def ends(name: str, case) -> list[list[float]]:
        return np.round(twin_named(name).read(case), 9).reshape(-1, 2).tolist()

    assert ends("ends-clamped", ACROSS) == [[0, 0], [8, 6]]
    assert ends("crossings-rounded", ACROSS) == [[1, 0], [8, 6]]
    assert ends("cut-once", ACROSS) == [[0, -1.1], [8, 6.1]]
    assert ends("top-and-bottom", ACROSS) == ends("normals-inward", segment((2, 1), (6, 5))) == []


def test_formulas_go_wrong_where_they_are_known_to() -> None:
    # Two triangles of float32 numbers draw 47 or 49 pixels by the order of their corners.
    rounded = RULES["third-weight-rounded"]
    assert (rounded.right(scan_conversion.HALVES, 7), rounded.wrong(scan_conversion.HALVES, 7)) == (
        (49,),
        (47,),
    )
    assert rounded.wrong(scan_conversion.TURNED_HALVES, 7) == (49,)
    # Edges that leave late draw an extra pixel in rows 6 and 7: a pair of edges too many in each.
    late = RULES["edges-leave-late"]
    extra = [
        len(late.wrong(scan_conversion.LATE, y) - late.right(scan_conversion.LATE, y)) for y in range(1, 9)
    ]
    assert extra == [0, 0, 0, 0, 0, 2, 2, 0]
    dropped = RULES["level-side-dropped"]
    assert len(dropped.right(scan_conversion.RECTANGLE)) == 20
    rest = dropped.right(scan_conversion.RECTANGLE) - dropped.wrong(scan_conversion.RECTANGLE)
    assert rest == {(i, 4) for i in range(1, 6)}
    # The crossing on the side that was cut second leaves the border.
    cut = RULES["clipped-in-place"]
    right, wrong = cut.right(*cut.shows), cut.wrong(*cut.shows)
    assert [x for x, _ in right] == [8, 8]
    assert (wrong[0], wrong[1][0] > 8) == (right[0], True)
    assert RULES["line-in-one-sample"].wrong(240, (1, 4, 16)) == (240, 60, 15)


def test_mistakes_that_draw_the_same_are_known() -> None:
    case = twin_named("affine-for-perspective").shows
    assert twin_named("w-overwritten").read(case) == twin_named("affine-for-perspective").read(case)


def test_a_faulty_line_can_be_stepped() -> None:
    faulty = twin_named("ties-step").change_settings(scan_conversion.LECTURE)
    traced = trace(scan_conversion.GENTLE.scene, faulty).stage("raster")
    last = traced.state(traced.steps.count)["overdraw"]
    np.testing.assert_array_equal(last, render(scan_conversion.GENTLE.scene, faulty).cover_count)
    assert (last != render(scan_conversion.GENTLE.scene, scan_conversion.LECTURE).cover_count).any()


ROWS = {
    "transforms": (
        "factors-reversed matrix-transposed ones-missing turned-clockwise degrees-for-radians eye-not-turned "
        "camera-not-inverted near-far-signs angle-not-halved aspect-inverted clip-for-ndc y-down window-one-less "
        "rows-and-columns weights-not-normalized"
    ),
    "normals and shading": (
        "normal-as-position normal-untransformed normal-by-projection normal-not-renormalized light-unclamped "
        "light-reversed highlight-at-light phong-at-vertices shininess-inverted byte-overflows"
    ),
    "culling and clipping": (
        "facing-exchanged view-direction-fixed dropped-at-border planes-after-divide attribute-copied quad-as-triangle "
        "clipped-in-place window-clockwise cut-once crossings-rounded ends-clamped parallel-kept top-and-bottom"
    ),
    "lines": (
        "one-octant ends-not-ordered slope-always-up start-not-doubled ties-step last-pixel-lost row-truncated "
        "from-other-end ends-at-full"
    ),
    "coverage": (
        "corner-for-center all-edges-inclusive all-edges-exclusive level-edges-never leftmost-vertex vertices-rounded "
        "box-truncated column-wrapped truncated-to-zero weights-permuted third-weight-rounded product-overflows "
        "block-by-one-corner"
    ),
    "scanline fill": (
        "attributes-not-sorted crossing-from-vertex height-plus-one flat-sides-lost right-end-drawn edges-leave-late "
        "both-ends-crossed level-side-dropped"
    ),
    "interpolation": (
        "affine-for-perspective not-divided-back multiplied-by-w w-overwritten depth-corrected-twice distance-linear"
    ),
    "textures": (
        "texture-upside-down half-texel-missing negative-repeat texels-of-one-less window-for-uv level-without-size "
        "level-of-area border-repeated"
    ),
    "depth": "farther-wins cleared-to-near last-wins-ties near-plane-tiny painted-by-mean",
    "blending": "order-reversed glass-writes-depth not-multiplied alpha-squared blended-in-srgb",
    "antialiasing": "one-depth-a-pixel one-sample-filled line-in-one-sample",
}
"""What people do wrong, as collected from courses and reports: one of our names for each."""


def test_the_mistakes_that_people_make_are_on_the_shelf() -> None:
    names = " ".join(ROWS.values()).split()
    assert len(names) == len(set(names)) == 95
    assert set(names) <= set(MISTAKES)
