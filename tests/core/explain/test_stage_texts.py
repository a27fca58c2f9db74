"""Every stage has a card and every method its texts."""

import pytest
from pytestqt.qtbot import QtBot

from core import STAGES, Settings, trace
from core.explain import stage_texts
from core.methods import table
from core.records.steps import Level
from core.settings import FAMILIES, families
from core.stages.declared import DECLARED, stage_of
from lessons.scenes import make_scene
from widgets.timeline.stage_cards import StageCardView


def test_the_texts_follow_the_stages() -> None:
    assert tuple(stage_texts.ACCOUNTS) == STAGES
    assert len({stage.short_title for stage in DECLARED}) == len(STAGES)


@pytest.mark.parametrize("stage", STAGES)
def test_a_card_is_complete(stage: str) -> None:
    card = stage_texts.stage_card(stage)
    for text in (card.gets, card.gives, card.purpose):
        assert text.endswith(".")
        assert 20 < len(text) < 140
    assert stage_of(stage).short_title.lower().removesuffix("s") in card.title.lower()
    assert card.source
    assert len(stage_of(stage).short_title) <= 11


def test_a_card_names_the_method_that_ran() -> None:
    source = stage_texts.stage_card("raster", "fill=scanline-lecture").source
    assert source.startswith(stage_of("raster").source)
    assert source.endswith("Fill, Scanline, as printed (LMU): LMU 2020, Scan line algorithm for triangles")


def test_a_stage_that_is_not_there_is_refused() -> None:
    with pytest.raises(ValueError, match="stage must be one of transform, cull"):
        stage_texts.stage_card("tessellate")
    with pytest.raises(ValueError, match="fill must be one of"):
        stage_texts.stage_card("raster", "fill=magic")


@pytest.mark.parametrize("family", families())
def test_methods_have_texts(family: str) -> None:
    assert stage_texts.family_title(family) == FAMILIES[family].title
    for name in table.names(family):
        text = stage_texts.method_text(family, name)
        method = table.get(family, name)
        assert text.title == method.title
        assert f"Source: {method.source}" in text.tooltip
        assert ("Breaks: " in text.tooltip) == bool(method.breaks_where)


def test_a_new_family_goes_by_its_own_name() -> None:
    assert stage_texts.family_title("ray_caster") == "Ray caster"


def test_the_view_shows_a_card(qtbot: QtBot) -> None:
    view = StageCardView()
    qtbot.addWidget(view)
    view.show_card(stage_texts.stage_card("edges"))
    assert view.fold_button.text() == stage_of("edges").title


def test_the_card_of_a_table_of_depths_says_nothing_of_lines():
    assert stage_texts.stage_card("raster", "line=bresenham", 0).title == "Raster: which pixels are covered"


def test_edges_begin_with_no_word_on_snapping_which_only_some_number_formats_do() -> None:
    assert stage_texts.initial_sentence("edges") == "No edge function has been set up yet."
    for coverage in ("float64", "exact", "inverse"):
        step = trace(make_scene("single-triangle"), Settings(coverage=coverage)).stage("edges").explain(1)
        assert step.listing is None or "snap" not in step.listing.source


def test_rays_in_a_tree_say_what_is_kept_and_what_was_nearest_so_far() -> None:
    scene = make_scene("intersecting")
    traced = trace(scene, Settings(visibility="ray-casting-tree"))
    stage = traced.stage("depth")
    counts = stage.summary(0, stage.steps.row_count)
    text = stage_texts.summary_sentence("depth", Level.STAGE, counts, None, 3, stage.method, stage.order)
    nearest = counts["covered"]
    assert f" {nearest:,} hits nearest so far, of which each ray keeps the last" in text
    assert traced.source.depth_tests.passes.sum() < nearest
    assert "kept" not in text
