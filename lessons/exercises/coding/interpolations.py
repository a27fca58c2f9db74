"""Listings of interpolation, at centres inside, on edges and at corners, with equal and unequal w."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from core import Settings
from core.edits import original
from lessons.exercises.coding.task import SIDE, Case, Fault, Shown, Task, in_classes
from lessons.exercises.coding.triangles import (
    corners_text,
    edges_of,
    number_text,
    numbers_text,
    pixels_of_triangles,
)
from lessons.small_scenes import triangle_scene


def _weighted(is_perspective: bool) -> Iterator[tuple[str, Case]]:
    """Yield triangles with w and values, and a centre, by what is special."""
    equal, unequal = (2.0, 2.0, 2.0), (1.0, 4.0, 2.0)
    for number, (corners, column, row) in enumerate(pixels_of_triangles()):
        rows = edges_of(corners)
        x, y = column + 0.5, row + 0.5
        n = [rows[0][k] * x + rows[1][k] * y + rows[2][k] for k in range(3)]
        if min(n) < 0:
            continue
        for w in (equal, unequal):
            zeros = n.count(0.0)
            where = "at a corner" if zeros == 2 else "on an edge" if zeros else "inside"
            name = f"{where}, {'equal' if w is equal else 'unequal'} w"
            a, b, c = (tuple(part[k] / w[k] for k in range(3)) for part in rows)
            values = ((3.0, 1.0, 2.0), (0.0, 4.0, 8.0))[number % 2]
            said = (
                f"triangle {corners_text(corners)}, w {numbers_text([*w])}, values {numbers_text([*values])}, "
                f"centre ({x:g}, {y:g})"
            )
            given = (a, b, c, x, y, values) if is_perspective else (a, b, c, w, x, y, values)
            yield name, Case(given, said, (corners, w, values, (column, row)))


def _interpolation_shown(method: str, case: Case) -> Shown:
    corners, w, values, pixel = case.about
    scene = triangle_scene([corners], (SIDE, SIDE), w=[w], attributes=np.array(values).reshape(1, 3, 1))
    settings = Settings(interpolation=method)
    return Shown(scene, settings, "interpolation", method, "interpolate", pixel)


def _interpolation_text(value: Any) -> str:
    weights, total, made = value
    return f"weights {numbers_text(weights)}, total {number_text(total)}, value {number_text(made)}"


_VALUE = "value = weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]"
_TOTAL = "total = n[0] + n[1] + n[2]"
_WEIGHTS = "weights = [n[k] / total for k in range(3)]"
_TIMES_W = "n = [(a[k] * x + (b[k] * y + c[k])) * w[k] for k in range(3)]"
INTERPOLATION_HINTS = """
    Hint: Put in equal values at all corners: what must come out?
    Hint: The three weights add up to one. At a corner its own weight is one.
    Hint: With n = 1, 1, 2 the weights are in the ratio 1 to 1 to 2, and add up to 1: follow each line."""


def _interpolation_task(name: str, title: str, purpose: str, n_faults: tuple[Fault, ...]) -> Task:
    listing = original("interpolation", name)
    return Task(
        name,
        "interpolate",
        title,
        purpose + INTERPOLATION_HINTS,
        listing.source,
        in_classes(_weighted(name == "perspective"), 12),
        (
            *n_faults,
            Fault(_TOTAL, "total = n[0] + n[1]"),
            Fault(_TOTAL, "total = 1"),
            Fault(_WEIGHTS, "weights = [n[k] / n[0] for k in range(3)]"),
            Fault(_WEIGHTS, "weights = [n[k] for k in range(3)]"),
            Fault(
                _VALUE,
                "value = weights[0] * values[2] + weights[1] * values[0] + weights[2] * values[1]",
                "weights-permuted",
            ),
            Fault(_VALUE, "value = (values[0] + values[1] + values[2]) / 3"),
        ),
        ("[0, 0, 0], 1, 0", "[1, 1, 1], 3, 1"),
        (("number",) * 3, "number", "number"),
        "the three weights, their total, and the value",
        _interpolation_text,
        listing.function,
        shown=lambda case: _interpolation_shown(name, case),
    )


PERSPECTIVE = _interpolation_task(
    "perspective",
    "interpolation with perspective",
    "interpolate_at is given a, b and c of three edge functions, each divided by the w of the corner opposite to it, a "
    "centre (x, y), and the values of the corners. n[k] is a x + b y + c. It returns the weights n[k] / total, the "
    "total of the n, and the value: the values, each times its weight, added up.",
    (
        Fault(
            "n = [a[k] * x + (b[k] * y + c[k]) for k in range(3)]",
            "n = [a[k] * y + (b[k] * x + c[k]) for k in range(3)]",
        ),
    ),
)
AFFINE = _interpolation_task(
    "affine",
    "affine interpolation",
    "interpolate_affine_at is given a, b and c of three edge functions, each divided by the w of the corner opposite "
    "to it, the three w, a centre (x, y), and the values of the corners. n[k] is a x + b y + c, times w[k] again, so w "
    "does not count. It returns the weights n[k] / total, the total of the n, and the value: the values, each times "
    "its weight, added up.",
    (
        Fault(_TIMES_W, "n = [a[k] * x + (b[k] * y + c[k]) for k in range(3)]"),
        Fault(_TIMES_W, "n = [(a[k] * x + (b[k] * y + c[k])) / w[k] for k in range(3)]"),
    ),
)
TASKS = (PERSPECTIVE, AFFINE)
