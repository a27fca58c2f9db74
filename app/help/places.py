"""What stands on screen, by the tables that the window is made from: where a term of the glossary occurs."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache

from app.views.stage_views import VIEWS
from app.window.actions import ACTIONS
from core.explain.stage_texts import initial_sentence, stage_card
from core.explain.steps import load_subjects
from core.explain.variable_text import VARIABLES
from core.methods import table
from core.settings import FIELDS
from core.stages.declared import DECLARED, stage_of
from core.study.accuracy.families import study_families
from core.study.stability import experiments
from lessons.glossary import find_terms
from lessons.scenes import CATALOGUE


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
