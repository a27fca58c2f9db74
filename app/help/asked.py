"""What Help says of exercises and slides: which exercises ask for a family of methods, and what each slide asks."""

from collections.abc import Iterable, Iterator
from functools import cache
from html import escape
from typing import NamedTuple

from app.help.markup import HelpPage, bullets, link
from lessons.exercises.asked import LECTURES, Topic, topics
from lessons.exercises.catalogue import TEMPLATES
from lessons.slides import scenes


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
