"""Help: every page can be reached, no link is dead, methods and terms have all that their pages promise."""

import re
from functools import cache

import pytest

from app.help.library import GUIDES, find_page, guide_page, occurrences, page, places
from app.help.reference import listings_of, slides
from app.session.printed_runs import runnable
from app.views.stage_views import VIEWS
from app.window.actions import ACTIONS
from core.methods import table
from core.settings import FAMILIES
from core.stages.declared import STAGES
from core.study.families import study_families
from core.study.stability import experiments
from lessons.exercises.asked import topics
from lessons.exercises.catalogue import TEMPLATES
from lessons.help import find_terms, glossary, guide
from lessons.lectures.scenes import ALL_SCENES


@cache
def crawled():
    """Return every page that links lead to from the first one, by address, and what the other links do."""
    pages, todo, doing = {}, ["home"], set()
    while todo:
        address = todo.pop()
        if address not in pages:
            pages[address] = page(address)
            for scheme, rest in re.findall(r'href="(\w+):([^"]+)"', pages[address].html):
                if scheme == "help":
                    todo.append(rest)
                else:
                    doing.add(rest)
    return pages, doing


def test_every_method_family_and_term_can_be_reached_by_links() -> None:
    pages, _ = crawled()
    assert {f"method/{m.family}/{m.name}" for m in table} <= set(pages)
    assert {f"family/{name}" for name in FAMILIES} <= set(pages)
    assert {f"term/{key}" for key in glossary()} <= set(pages)


def test_no_link_is_dead() -> None:
    known = {
        "action": {action.name for action in ACTIONS},
        "stage": set(STAGES),
        "view": {view.name for view in VIEWS},
        "scene": set(ALL_SCENES),
        "use": {f"{method.family}/{method.name}" for method in table},
        "compare": {family.name for family in study_families()},
        "stability": {experiment.info.name for experiment in experiments},
        "printed": {printed.name for printed in runnable()},
        "exercise": set(TEMPLATES),
    }
    dead = [link for link in crawled()[1] if link.partition("/")[2] not in known[link.partition("/")[0]]]
    assert dead == []


def test_a_reference_page_has_every_field() -> None:
    for method in table:
        html = page(f"method/{method.family}/{method.name}").html
        for field in ("Family", "Source", "Exact for", "Breaks where", "Chart", "Map", "Command", "Listing"):
            assert f">{field}</" in html, (method.family, method.name, field)
        assert "do:compare/" in html, method.family


def test_methods_that_compute_something_have_a_listing() -> None:
    without = {f"{method.family}={method.name}" for method in table if not listings_of(method)}
    assert without == {
        "clipping=homogeneous",
        "line_clipping=none",
        "polygon_clipping=none",
        "polygon_mode=wireframe",
    }


def test_places_of_a_term_name_it() -> None:
    assert len(occurrences()) >= 150
    texts = {place.label: [] for place in places()}
    for place in places():
        texts[place.label].append(place.text)
    for key, found in occurrences().items():
        for place in found:
            named = {term.key for text in texts[place.label] for _, _, term in find_terms(text)}
            assert key in named, (key, place.label)


@pytest.mark.parametrize(
    ("query", "first"),
    [
        ("depth buffer", "help:term/depth-buffer"),
        ("bresenham", "help:term/bresenham-s-algorithm"),
        ("wu two", "help:method/line/wu"),
        ("pixels of the vertices", "do:exercise/vertex-pixels"),
        ("extends to the right", "help:slide/Zwicker/14"),
        ("who owns a shared edge", "help:step/guide/6"),
    ],
)
def test_a_search_finds_terms_methods_exercises_slides_and_steps(query: str, first: str) -> None:
    assert re.search(r'href="([^"]+)"', find_page(query).html)[1] == first


def test_everything_that_is_asked_and_every_step_of_the_guides_is_found_by_its_title() -> None:
    titles = {f"do:exercise/{name}": template.title for name, template in TEMPLATES.items()}
    titles |= {f"help:slide/{s.lecture}/{s.number}": s.topic.name for s in slides()}
    titles |= {
        f"help:step/{name}/{number}": step.title
        for name in GUIDES
        for number, step in enumerate(guide(name), start=1)
    }
    missing = [address for address, title in titles.items() if f'"{address}"' not in find_page(title).html]
    assert missing == []
    assert page("slide/Zwicker/14").title == slides()[14].topic.name


def test_a_method_links_its_exercises_its_slides_and_scenes() -> None:
    html = page("method/fill_rule/shared-edge").html
    assert "do:exercise/owned-edges" in html
    assert "Zwicker: Shared edges: fill only if the triangle extends to the right" in html
    assert "do:scene/pellacini-rectangle" in page("method/line/rectangle").html
    asked = [family for family in FAMILIES if "do:exercise/" in page(f"family/{family}").html]
    assert set(asked) == {topic.name for topic in topics()["families"] if topic.templates}


def test_a_search_for_nothing_known_says_so() -> None:
    assert "Nothing was found" in find_page("zzz").html
    for query in ("clicker", "Page Down", "black screen"):
        assert "Presenting: " in find_page(query).html


def test_the_guide_names_keys_not_actions() -> None:
    assert "{" not in guide_page().html
    assert "Ctrl+O" in guide_page().html
