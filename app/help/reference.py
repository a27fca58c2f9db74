"""The reference pages: one for each method and family, with the exercises and slides that ask for them."""

from collections.abc import Iterable, Iterator
from functools import cache
from html import escape
from typing import NamedTuple

from app.help.pane import HelpPage, bullets, facts, link, linked, sentence
from app.session.printed_runs import runnable
from core import Settings, trace
from core.explain.stage_texts import stage_card
from core.families import Family
from core.methods import Method, table
from core.records.listing import listing
from core.settings import DEFAULTS, FAMILIES, FIELDS
from core.stages.declared import DECLARED, stage_of
from core.stages.needs import NEEDS
from core.study.families import study_families
from core.study.stability import experiments
from lessons.exercises.asked import LECTURES, Topic, topics
from lessons.exercises.catalogue import TEMPLATES
from lessons.help import find_terms
from lessons.lectures import scenes
from lessons.scenes import make_scene

# What Help says of exercises and slides: which exercises ask for a family of methods, and what each slide
# asks.


class Slide(NamedTuple):
    """A slide, or a few, by its title or question."""

    lecture: str
    number: int
    """Its place in the lecture."""
    topic: Topic

    @property
    def row(self) -> str:
        """The link to its page."""
        return link(f"help:slide/{self.lecture}/{self.number}", f"{self.lecture}: {self.topic.name}")


@cache
def slides() -> tuple[Slide, ...]:
    """Return the slides of all lectures, in their order."""
    return tuple(
        Slide(lecture, number, topic)
        for lecture in LECTURES
        for number, topic in enumerate(topics()[lecture])
    )


def exercise_links(names: Iterable[str]) -> list[str]:
    """Return links that ask exercises."""
    return [link(f"do:exercise/{name}", TEMPLATES[name].title) for name in names]


def exercises_of(family: str) -> tuple[str, ...]:
    """Return the names of the exercises about a family."""
    return next((topic.templates for topic in topics()["families"] if topic.name == family), ())


def slides_of(family: str) -> list[str]:
    """Return links to the slides that ask what the exercises about a family ask."""
    asked = set(exercises_of(family))
    return [slide.row for slide in slides() if asked & set(slide.topic.templates)]


def scenes_of(family: str, method: str) -> list[str]:
    """Return links to the lectures' scenes that a method is chosen for."""
    return [
        link(f"do:scene/{scene.name}", f"{lecture}: {scene.title}")
        for lecture, found in scenes.LECTURE_SCENES.items()
        for scene in found
        if scene.settings.get(family) == method
    ]


def slide_page(lecture: str, number: str) -> HelpPage:
    """Return what a slide asks, and the exercises that ask it."""
    topic = next(s.topic for s in slides() if (s.lecture, str(s.number)) == (lecture, number))
    asks = bullets(exercise_links(topic.templates)) or f"<p>{escape(topic.reason)}</p>"
    return HelpPage(topic.name, f"<p>{escape(scenes.LECTURES[lecture])}</p><h2>Exercises</h2>{asks}")


def searched() -> Iterator[tuple[str, str]]:
    """Yield what may be found, and its row: exercises by title and name, slides by title or question."""
    for template in TEMPLATES.values():
        row = f"{link(f'do:exercise/{template.name}', template.title)}: exercise"
        yield f"{template.title} {template.name} exercise", row
    for slide in slides():
        yield f"{slide.lecture} {slide.topic.name} slide", slide.row


# The reference pages: one for each method and family, made from the table of methods.


SHOWN_BY = {
    "clipping": "near-plane",
    "texture_filter": "textured-floor",
    "wrap": "textured-floor",
    "shading": "cube",
    "polygon_clipping": "weiler-atherton",
    "polygon_fill": "pentagram",
    **dict.fromkeys(("presentation", "flush"), "two-buffers"),
    "history": "bar-and-wire",
}
"""Families to the scene in which their methods do something; ``single-triangle`` for the others."""
TOGETHER = {
    "polygon_mode": {"line": "bresenham"},
    "line_clipping": {"polygon_mode": "wireframe"},
    "provoking": {"interpolation": "flat"},
    "resolve_filter": {"antialiasing": "ssaa-4"},
    "flush": {"presentation": "double"},
    "history": {"antialiasing": "temporal"},
}
"""Other settings with which the methods of a family do something."""
NO_LISTING = "It has no listing."


def methods_page() -> HelpPage:
    """Return the list of all families and methods, by stage."""
    parts = []
    for stage in DECLARED:
        names = [name for name, family in FAMILIES.items() if family.stage == stage.name]
        if names:
            rows = (f"{_family_link(name)}: {', '.join(map(_method_link, _methods(name)))}" for name in names)
            parts.append(f"<h2>{escape(stage.short_title)}</h2>{bullets(rows)}")
    return HelpPage("Methods", "".join(parts))


def family_page(name: str) -> HelpPage:
    """Return the page of a family: what its methods are, and where they are measured."""
    family = FAMILIES[name]
    rows = (f"{_method_link(method)}. {linked(sentence(method.exact_for))}" for method in _methods(name))
    body = facts(
        (
            ("Stage", link(f"do:stage/{family.stage}", stage_card(family.stage).title)),
            ("Setting", f"<code>{name}</code>"),
            ("Chart", _chart(name)),
            ("Maps", _maps(name)),
            ("Exercises", ", ".join(exercise_links(exercises_of(name)))),
            ("Slides", ", ".join(slides_of(name))),
        )
    )
    return HelpPage(family.title, f"{body}<h2>Methods</h2>{bullets(rows)}")


def method_page(name: str, method_name: str) -> HelpPage:
    """Return the page of a method: source, where it is exact and where it breaks, listing, chart and map."""
    method, family = table.get(name, method_name), FAMILIES[name]
    needs = ", ".join(NEEDS[need].noun for need in method.needs)
    takes = ", ".join(FIELDS[taken].title for taken in method.takes)
    rows = [
        ("Family", f"{_family_link(name)}, stage {link(f'do:stage/{family.stage}', _stage_title(family))}"),
        ("Source", escape(sentence(method.source))),
        ("Exact for", linked(sentence(method.exact_for))),
        ("Breaks where", linked(sentence(method.breaks_where)) if method.breaks_where else "Nowhere."),
        ("Needs", linked(sentence(needs)) if needs else ""),
        ("Settings", escape(takes)),
        ("Chart", _chart(name)),
        ("Map", _maps(name, method_name)),
        ("Exercises", ", ".join(exercise_links(exercises_of(name)))),
        ("Slides", ", ".join(slides_of(name))),
        ("Scenes of the lectures", ", ".join(scenes_of(name, method_name))),
        ("As printed", _printed(name, method_name)),
        ("Command", f"<code>--set {name}={method_name}</code>"),
    ]
    use = f"<p>{link(f'do:use/{name}/{method_name}', 'Use this method')} on the open scene.</p>"
    listings = "".join(f"<pre>{escape(source)}</pre>" for source in listings_of(method))
    shown = listings or f"<p>{NO_LISTING}</p>"
    return HelpPage(method.title, f"{about(method)}{use}{facts(rows)}<h2>Listing</h2>{shown}")


def _printed(family: str, method: str) -> str:
    """Return links that show the listings of slides beside the method, where they first differ."""
    found = [each for each in runnable() if (each.family, each.right) == (family, method)]
    return ", ".join(link(f"do:printed/{each.name}", f"{each.title} ({each.lecture})") for each in found)


def about(method: Method) -> str:
    """Return what the glossary says of the term that a method's title begins with, or else of its family's."""
    own = [term for start, _, term in find_terms(method.title) if start == 0]
    of_family = [term for _, _, term in find_terms(FAMILIES[method.family].title)]
    return "".join(f"<p>{linked(term.text, {term.key})}</p>" for term in (own or of_family)[-1:])


def listings_of(method: Method) -> list[str]:
    """Return the listings that the stepper shows with a method: its own, or those of its stage in a small scene."""
    if method.listing is not None:
        return [listing(method.listing).source]
    scene = make_scene(SHOWN_BY.get(method.family, "single-triangle"))
    settings = Settings(**(TOGETHER.get(method.family, {}) | {method.family: method.name}))  # type: ignore[arg-type]
    width, height = scene.size
    traced = trace(scene, settings, region=(width // 2, height // 2, 2, 2))
    stage = traced.stage(FAMILIES[method.family].stage)
    kinds = {stage.steps.kinds[number] for number in stage.steps.kind.tolist()}
    found = [each.source for kind, each in stage.listings.items() if kind.partition(".")[0] in kinds]
    return list(dict.fromkeys(found))


def _methods(family: str) -> list[Method]:
    return [table.get(family, name) for name in table.names(family)]


def _stage_title(family: Family) -> str:
    return stage_of(family.stage).short_title


def _family_link(name: str) -> str:
    return link(f"help:family/{name}", FAMILIES[name].title)


def _method_link(method: Method) -> str:
    default = " (default)" if getattr(DEFAULTS, method.family) == method.name else ""
    return link(f"help:method/{method.family}/{method.name}", method.title) + default


def _chart(family: str) -> str:
    """Return links to the charts that vary a family."""
    found = [study for study in study_families() if family in study.varies]
    return ", ".join(link(f"do:compare/{study.name}", study.title) for study in found)


def _maps(family: str, method: str = "") -> str:
    """Return links to the experiments that run a method, or any of the family."""
    infos = [
        experiment.info
        for experiment in experiments
        if any(
            pair == f"{family}={method}" or (not method and pair.startswith(f"{family}="))
            for choices in experiment.info.methods
            for pair in choices.split()
        )
    ]
    return (
        ", ".join(link(f"do:stability/{info.name}", info.title) for info in infos) or "No experiment runs it."
    )
