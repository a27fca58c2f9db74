"""Which mistake is this? The mistake of the shelf that draws what an edited listing draws, on one scene."""

from dataclasses import dataclass
from typing import cast

from app.session.document import Document
from app.session.listing_runs import settings_as_edited
from core import Settings, render
from core.scene import ClipScene
from lessons.course.catalogue import shipped
from lessons.exercises.asked import topics
from lessons.mistakes.shelf import SHELF
from lessons.mistakes.twin import Twin, frame_bytes

MOST_SECONDS = 0.05
"""Estimated time of a run above which the shelf, which is drawn some fifty times, is not asked."""


@dataclass(frozen=True)
class Outcome:
    """What an edited listing draws on a scene."""

    is_right: bool
    """Whether it is the picture of the method itself."""
    mistake: Twin | None = None
    """The first mistake that draws the same."""


def outcome_of(document: Document) -> Outcome:
    """Draw a document with its edited listings, as it is, and with each mistake of the shelf that can be stepped.

    Raises ValueError where an edited listing cannot be drawn.
    """
    mine, other = settings_as_edited(document)
    scene = document.traced_scene
    wanted = frame_bytes(render(scene, other))
    if wanted == frame_bytes(render(scene, mine)):
        return Outcome(True)
    if document.estimated_seconds > MOST_SECONDS:
        return Outcome(False)
    family = set(mine.differences(other))
    # Those that are mistakes of the same family come first: others may draw the same by chance.
    twins = sorted(
        SHELF.values(), key=lambda twin: not family & set(mine.differences(twin.change_settings(mine)))
    )
    return Outcome(False, next((twin for twin in twins if _draws(twin, document, mine, wanted)), None))


def _draws(twin: Twin, document: Document, mine: Settings, wanted: tuple[bytes, ...]) -> bool:
    scene = document.traced_scene
    if not twin.is_run or not (twin.takes_any_scene or isinstance(scene, ClipScene)):
        return False
    try:
        if twin.takes_any_scene and not mine.differences(twin.change_settings(mine)):
            return False  # It draws what the method itself draws.
        return frame_bytes(twin.draw(cast(ClipScene, scene), mine)) == wanted
    except ValueError:  # It cannot be made on this scene.
        return False


def exercise_about(family: str) -> str:
    """Return the name of the first exercise about a family of methods; empty: there is none."""
    found = (topic.templates for topic in topics()["families"] if topic.name == family)
    return next(iter(next(found, ())), "")


def lesson_about(mistake: str) -> tuple[str, int] | None:
    """Return name and step, from 0, of a lesson that asks for something which this mistake gets wrong."""
    for name, lesson in shipped().lessons.items():
        for number, step in enumerate(lesson.written_steps()):
            if mistake in step.get("mistakes", ()) or any(
                wrong.get("mistake") == mistake for wrong in step.get("wrong", ())
            ):
                return name, number
    return None
