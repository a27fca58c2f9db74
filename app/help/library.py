"""The pages of Help by their addresses: home, guide, glossary, terms and where they occur, and searching."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from html import escape

from app.help import reference
from app.help.pane import HelpPage, bullets, link, linked
from app.help.reference import family_page, method_page, methods_page
from app.views.stage_views import VIEWS
from app.window.actions import ACTIONS
from app.window.keys import LOCAL_KEYS, key_text
from core.explain.stage_texts import initial_sentence, stage_card
from core.explain.steps import VARIABLES, load_subjects
from core.methods import table
from core.records.words import capitalized
from core.settings import FAMILIES, FIELDS
from core.stages.declared import DECLARED, stage_of
from core.study.families import study_families
from core.study.stability import experiments
from lessons.help import GuideStep, Term, find_terms, glossary, guide
from lessons.scenes import CATALOGUE

# What stands on screen, by the tables that the window is made from: where a term of the glossary occurs.


@dataclass(frozen=True)
class Place:
    """A text on screen."""

    label: str
    """Where it stands, as ``Stage Raster``."""
    address: str
    """The link that goes there."""
    text: str


def places() -> Iterator[Place]:
    """Yield every text that the tables put on screen."""
    load_subjects()
    for stage in DECLARED:
        card = stage_card(stage.name)
        on_card = (card.title, card.purpose, card.gets, card.gives, initial_sentence(stage.name))
        levels = (stage.group_label, stage.row_label)
        yield Place(f"Stage {stage.short_title}", f"do:stage/{stage.name}", ". ".join((*on_card, *levels)))
    for name, setting in FIELDS.items():
        address = f"help:family/{name if name in table.families else setting.taken_by}"
        yield Place(f"Methods: {setting.title}", address, setting.title)
    for method in table:
        label = f"Methods: {FIELDS[method.family].title}, {method.title}"
        text = ". ".join((method.title, method.exact_for, method.breaks_where))
        yield Place(label, f"help:method/{method.family}/{method.name}", text)
    for stage_name, variables in VARIABLES.items():
        for variable in variables.values():
            texts = [text for text in (variable.label, variable.meaning) if isinstance(text, str)]
            name = texts[0].replace("#", "0") if texts else ""
            label = f"Variables of {stage_of(stage_name).short_title}: {name}".rstrip(": ")
            yield Place(label, f"do:stage/{stage_name}", ". ".join(texts))
    for action in ACTIONS:
        yield Place(f"Keys: {action.title}", "do:action/show_keys", action.title)
    for view in VIEWS:
        yield Place(f"View {view.title}", f"do:view/{view.name}", view.title)
    for scene in CATALOGUE:
        yield Place(f"Scene {scene.title}", f"do:scene/{scene.name}", f"{scene.title}. {scene.description}")
    for family in study_families():
        yield Place(f"Compare: {family.title}", f"do:compare/{family.name}", family.title)
    for experiment in experiments:
        info = experiment.info
        text = ". ".join((info.title, info.question, info.claim))
        yield Place(f"Stability: {info.title}", f"do:stability/{info.name}", text)


@cache
def occurrences() -> Mapping[str, tuple[Place, ...]]:
    """Return the places of every term that occurs on screen, by its key."""
    found: dict[str, dict[str, Place]] = {}
    for place in places():
        for _, _, term in find_terms(place.text):
            found.setdefault(term.key, {}).setdefault(place.label, place)
    return {key: tuple(by_label.values()) for key, by_label in found.items()}


# The pages of Help by their addresses: home, guide, glossary, terms, methods, and what a search finds.


GUIDES = {
    "guide": ("guide", "Five-minute guide"),
    "change_line": ("editing", "Change a line"),
    "own_exercise": ("exercise", "Your own exercise"),
}
"""Guides to the addresses and titles of their pages."""
MOST_PLACES = 40
"""Places of a term that its page lists."""


def home_page() -> HelpPage:
    """Return the first page: what there is, and how to come to a term."""
    rows = (
        f"{link('help:guide', 'Five-minute guide')}: one scene from its vertices to its bytes.",
        f"{link('help:editing', 'Change a line')}: edit a listing, and step through what your version draws.",
        f"{link('help:exercise', 'Your own exercise')}: a question for a class, in ten minutes.",
        f"{link('help:glossary', 'Glossary')}: {len(glossary())} terms in plain English.",
        f"{link('help:methods', 'Methods')}: source, limits and listing of all {len(tuple(table))}.",
        f"{link('do:action/show_keys', 'Keys')}: everything that a key does on this page.",
    )
    hint = (
        "Underlined words in a stage card open their entry. A right click on the sentence, on a tab, a button or a "
        "variable asks what it is. In Methods, the button i explains a method. "
        f"{_keys_of('help')} explains what the mouse points at, or what has the keyboard."
    )
    return HelpPage("Help", f"{bullets(rows)}<p>{escape(hint)}</p>")


def guide_page() -> HelpPage:
    """Return the guide, one step after the other."""
    return HelpPage("Five-minute guide", _steps("guide"))


def editing_page() -> HelpPage:
    """Return how a listing is edited."""
    return HelpPage("Change a line", _steps("change_line"))


def own_exercise_page() -> HelpPage:
    """Return how a teacher writes a first exercise."""
    return HelpPage("Your own exercise", _steps("own_exercise"))


def step_page(name: str, number: str) -> HelpPage:
    """Return one step of a guide, by its number from 1."""
    step = guide(name)[int(number) - 1]
    back = link(f"help:{GUIDES[name][0]}", GUIDES[name][1])
    return HelpPage(f"{number}. {step.title}", f"{_step(step, set())}<p>Step {number} of: {back}</p>")


def _steps(name: str) -> str:
    """Return the steps of a guide."""
    seen = set[str]()
    return "".join(
        f"<h2>{number}. {escape(step.title)}</h2>{_step(step, seen)}"
        for number, step in enumerate(guide(name), start=1)
    )


def _step(step: GuideStep, seen: set[str]) -> str:
    """Return a step of a guide without its title; ``seen``: the terms that get no link."""
    runs = " · ".join(link(address, label) for label, address in step.links.items())
    listing = f"<pre>{escape(step.listing)}</pre>" if step.listing else ""
    return f"<p>{linked(_with_keys(step.text), seen)}</p>{listing}<p>▸ {runs}</p>"


def _with_keys(text: str) -> str:
    """Return the text of a step with the keys of its actions."""
    return re.sub(r"\{(\w+)\}", lambda found: _keys_of(found[1]), text)


def _keys_of(action: str) -> str:
    """Return the first key of an action."""
    entry = next(entry for entry in ACTIONS if entry.name == action)
    return key_text(entry).partition(", ")[0]


def glossary_page() -> HelpPage:
    """Return all terms."""
    return HelpPage("Glossary", _entries(glossary().values()))


def term_page(key: str) -> HelpPage:
    """Return one term, with the places on screen where it occurs."""
    term = glossary()[key]
    others = [form for form in term.also if form.lower() not in term.name.lower()]
    also = f"<p>Also: {escape(', '.join(others))}.</p>" if others else ""
    shown = occurrences().get(key, ())
    rows = [link(place.address, place.label) for place in shown[:MOST_PLACES]]
    places = f"<h2>On screen</h2>{bullets(rows)}" if rows else ""
    more = f"<p>and {len(shown) - MOST_PLACES} more.</p>" if len(shown) > MOST_PLACES else ""
    return HelpPage(capitalized(term.name), f"<p>{linked(term.text, {key})}</p>{also}{places}{more}")


def variable_page(name: str, meaning: str) -> HelpPage:
    """Return what a variable of the stepper is, with the terms in its meaning."""
    found = dict.fromkeys(term for _, _, term in find_terms(f"{name} {meaning}"))
    return HelpPage(name, f"<p>{linked(meaning)}</p>{_entries(found)}")


def _entries(terms: Iterable[Term]) -> str:
    """Return terms with their texts."""
    return "".join(
        f"<p>{link(f'help:term/{term.key}', term.name)}. {linked(term.text, {term.key})}</p>"
        for term in terms
    )


def here_page(keys: str) -> HelpPage:
    """Return several terms, of one text on screen."""
    return HelpPage("Terms here", _entries(glossary()[key] for key in keys.split(",")))


def find_page(query: str) -> HelpPage:
    """Return what a search finds: terms by name before those by text; methods, exercises, slides, guides, keys."""
    words = query.lower().split()
    rows = [row for _, row in sorted(_found(words), key=lambda found: found[0])]
    return HelpPage(f"Results for “{query}”", bullets(rows) or "<p>Nothing was found.</p>")


def _found(words: list[str]) -> Iterator[tuple[int, str]]:
    """Yield rank and row of everything that holds all words."""

    def holds(text: str) -> bool:
        return all(word in text.lower() for word in words)

    for term in glossary().values():
        names = " ".join((term.name, *term.also))
        if holds(f"{names} {term.text}"):
            row = f"{link(f'help:term/{term.key}', term.name)}. {escape(term.text)}"
            yield (0 if holds(term.name) else 1 if holds(names) else 3), row
    for method in table:
        family = FAMILIES[method.family].title
        if holds(f"{family} {method.title} {method.name} {method.source}"):
            address = f"help:method/{method.family}/{method.name}"
            yield 2, f"{link(address, f'{family}: {method.title}')}. {escape(method.source)}."
    for text, row in reference.searched():
        if holds(text):
            yield 2, row
    for name, (_, guide_title) in GUIDES.items():
        for number, step in enumerate(guide(name), start=1):
            if holds(f"{step.title} {_with_keys(step.text)}"):
                row = f"{link(f'help:step/{name}/{number}', step.title)}: {guide_title}, step {number}"
                yield (2 if holds(step.title) else 4), row
    for action in ACTIONS:
        if action.keys and holds(f"{action.title} {key_text(action)}"):
            yield 2, f"{link(f'do:action/{action.name}', action.title)}: {escape(key_text(action))}"
    for key in LOCAL_KEYS:
        if holds(f"{key.title} {key.group} {key.name.replace('_', ' ')} {key_text(key)}"):
            yield 2, f"{escape(key.title)}: {escape(key_text(key))}"


PAGES: Mapping[str, Callable[..., HelpPage]] = {
    "home": home_page,
    "guide": guide_page,
    "editing": editing_page,
    "exercise": own_exercise_page,
    "step": step_page,
    "slide": reference.slide_page,
    "glossary": glossary_page,
    "term": term_page,
    "here": here_page,
    "variable": variable_page,
    "methods": methods_page,
    "family": family_page,
    "method": method_page,
    "find": find_page,
}
"""What makes a page, by the first word of its address; the others are arguments."""


def page(address: str) -> HelpPage:
    """Return the page of an address such as ``method/fill/blocks``; a KeyError or ValueError: there is none."""
    kind, *names = address.split("/", 1 if address.startswith("find/") else 2)
    return PAGES[kind](*names)
