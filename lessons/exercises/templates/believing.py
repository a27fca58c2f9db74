"""Questions that uncover a belief: it is among the choices, and choosing it is answered by what refutes it."""

from collections.abc import Sequence
from fractions import Fraction
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from core.scene import Camera, Mesh, Scene
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.draws import Draws, reject
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft
from lessons.exercises.refutation import Refutation
from lessons.exercises.templates.drafting import drafted

Choice = str | int | Fraction


def choice_text(choice: Choice) -> str:
    """Return a choice as text."""
    return choice if isinstance(choice, str) else number_text(Fraction(choice))


def believed(
    draws: Draws,
    asked: str,
    right: Choice,
    beliefs: Sequence[Choice],
    others: Sequence[Choice],
    refutation: Refutation,
) -> Draft:
    """Ask for one of several choices that all differ."""
    wrong = [choice_text(belief) for belief in beliefs]
    options = draws.shuffled((choice_text(right), *wrong, *map(choice_text, others)))
    reject(len(set(options)) < len(options))
    answer = ChoiceAnswer(options, frozenset({options.index(choice_text(right))}))
    refutations = {frozenset({options.index(belief)}): refutation for belief in wrong}
    return drafted(asked, "", answer, reveal=refutation.sentence, refutations=refutations)


def eye_scene(
    points: ArrayLike, near: float = 1.0, far: float = 10.0, model: ArrayLike | None = None
) -> Scene:
    """Return a triangle (3, 3) before a camera at the origin that looks along -z, 90 degrees wide, 8 x 8 pixels."""
    transform = np.eye(4) if model is None else np.array(model, float)
    mesh = Mesh(positions=np.array(points, float), triangles=np.array([[0, 1, 2]]), transform=transform)
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]), field_of_view=pi / 2, near=near, far=far)
    return Scene((mesh,), camera, (), (8, 8))
