"""Listings of one pixel: interpolation, depth test, blending, and bilinear filtering."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from core import Settings
from core.edits.edit import original
from lessons.exercises.coding.task import SIDE, Case, Fault, Shown, Task, in_classes
from lessons.exercises.coding.triangles import (
    corners_text,
    edges_of,
    number_text,
    numbers_text,
    pixels_of_triangles,
)
from lessons.small_scenes import triangle_scene

# Listings of interpolation, at centres inside, on edges and at corners, with equal and unequal w.


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


# Listings of one pixel: depth test, blending, and bilinear filtering.


CORNERS = [(0.5, 0.5), (5.5, 0.5), (0.5, 5.5)]
SIZE = (6, 6)
DEPTHS = (0.25, 0.5, 0.75, 0.0, 1.0)


def _depth_cases() -> Iterator[tuple[str, Case]]:
    for is_larger in (False, True):
        for writes in (True, False):
            for new in DEPTHS:
                for old in DEPTHS:
                    way = "larger is nearer" if is_larger else "smaller is nearer"
                    name = "nothing is stored" if not writes else "equal depths" if new == old else way
                    said = f"new {new:g}, old {old:g}, {way}" + ("" if writes else ", writes is false")
                    yield name, Case((new, old, is_larger, writes), said)


def _depth_shown(case: Case) -> Shown | None:
    new, old, is_larger, writes = case.values
    if not writes:  # Only pale pixels of lines are not stored.
        return None
    method = "reversed-z" if is_larger else "z-float32"
    depths = [1 - depth if is_larger else depth for depth in (old, new)]
    scene = triangle_scene([CORNERS, CORNERS], SIZE, depth=[[depth] * 3 for depth in depths])
    return Shown(scene, Settings(depth=method), "depth_test", method, "depth")


_NEARER = "nearer = new > old if larger_is_nearer else new < old"
_DEPTH = original("depth_test", "z-float32")
DEPTH_TEST = Task(
    "depth-test",
    "depth",
    "the depth test",
    """depth_test is given the new depth and the old one that is stored, whether the larger of two depths is
    nearer, and whether a passing depth is stored. It returns the depth that is stored then, and whether the
    new one passes: it must be nearer. Equal depths do not pass.
    Hint: Take a nearer depth, a farther one and an equal one: what must be stored after each?
    Hint: What changes where the larger depth is the nearer one?
    Hint: Follow the lines with new = 1 and old = 0, once with each value of larger_is_nearer.""",
    _DEPTH.source,
    in_classes(_depth_cases()),
    (
        Fault(_NEARER, "nearer = new < old if larger_is_nearer else new > old", "farther-wins"),
        Fault(_NEARER, "nearer = new >= old if larger_is_nearer else new <= old", "last-wins-ties"),
        Fault(_NEARER, "nearer = new < old"),
        Fault("return old, False", "return new, False"),
        Fault("return old, False", "return new if writes else old, True", "no-depth-test"),
        Fault("return new if writes else old, True", "return new, True"),
        Fault("return new if writes else old, True", "return old if writes else new, True"),
    ),
    ("new, True", "old, False", "0, True"),
    ("number", "flag"),
    "the depth that is stored then, and whether the new one passes",
    lambda value: f"{number_text(value[0])} stored, {'passes' if value[1] else 'does not pass'}",
    _DEPTH.function,
    shown=_depth_shown,
)


def _blend_cases() -> Iterator[tuple[str, Case]]:
    colors = ((1.0, 0.0, 0.25), (0.5, 0.75, 0.0))
    for alpha in (0.0, 0.25, 0.5, 1.0):
        for there in (0.0, 0.5, 1.0):
            for one, other in (colors, colors[::-1]):
                layer = {0.0: "a clear layer", 1.0: "an opaque layer"}.get(alpha, "a layer between")
                below = {0.0: "a clear pixel", 1.0: "an opaque pixel"}.get(there, "a pixel between")
                name = f"{layer} over {below}" if layer == "a layer between" else layer
                source, destination = (*one, alpha), (*(part * there for part in other), there)
                said = f"({numbers_text([*source])}) over ({numbers_text([*destination])})"
                yield name, Case((source, destination), said)


def _blend_shown(case: Case) -> Shown:
    source, destination = case.values
    scene = triangle_scene([CORNERS], SIZE, attributes=np.array([[source] * 3]))
    scene = replace(scene, background=np.array(destination))
    return Shown(scene, Settings(blend="over"), "blend", "over", "blend")


_OVER = original("blend", "over")
_MIX = "result = [color[k] * alpha + destination[k] * (1 - alpha) for k in range(3)]"
_ALPHA = "result.append(alpha + destination[3] * (1 - alpha))"
OVER = Task(
    "over",
    "blend",
    "blending with over",
    """over_pixel is given a colour and what is there, each as red, green, blue and alpha; the colour's red,
    green and blue are straight, those that are there are multiplied by their alpha. It returns the four
    numbers of the result: the colour counts alpha, what is there counts 1 - alpha; the new alpha is alpha +
    (1 - alpha) times the one there.
    Hint: What must a layer with alpha 1 give, and one with alpha 0?
    Hint: Alpha is mixed, too: two half clear layers are not opaque.
    Hint: Put alpha = 1, then alpha = 0 into each line, over what has alpha 1.""",
    _OVER.source,
    in_classes(_blend_cases()),
    (
        Fault(
            _MIX,
            "result = [color[k] * (1 - alpha) + destination[k] * alpha for k in range(3)]",
            "factors-exchanged",
        ),
        Fault(_MIX, "result = [color[k] + destination[k] * (1 - alpha) for k in range(3)]", "not-multiplied"),
        Fault(
            _MIX,
            "result = [color[k] * alpha * alpha + destination[k] * (1 - alpha) for k in range(3)]",
            "multiplied-twice",
        ),
        Fault(_MIX, "result = [color[k] * alpha + destination[k] for k in range(3)]"),
        Fault(_ALPHA, "result.append(alpha)", "alpha-of-source"),
        Fault(_ALPHA, "result.append(destination[3])", "alpha-kept"),
        Fault(_ALPHA, "result.append(alpha * alpha + destination[3] * (1 - alpha))", "alpha-squared"),
    ),
    ("[0, 0, 0, 1]", "source", "destination"),
    ("number",) * 4,
    "four numbers",
    lambda value: numbers_text([*value]),
    _OVER.function,
    tolerance=1e-6,
    shown=_blend_shown,
)


def _bilinear_cases() -> Iterator[tuple[str, Case]]:
    texels = ((1.0, 3.0, 5.0, 11.0), (0.0, 8.0, 4.0, 2.0))
    for fx in (0.0, 0.25, 0.5, 1.0):
        for fy in (0.0, 0.5, 0.75, 1.0):
            whole = (fx in (0, 1)) + (fy in (0, 1))
            name = ("between four texels", "between two texels", "at a texel")[whole]
            for four in texels:
                said = f"texels {numbers_text([*four])}, fx = {fx:g}, fy = {fy:g}"
                yield name, Case((*four, fx, fy), said)


BILINEAR = Task(
    "bilinear",
    "shade",
    "bilinear filtering",
    """bilinear is given four texels, t00 and t10 of the lower row, t01 and t11 of the upper one, and how far
    the place is from t00 to the right, fx, and upwards, fy, from 0 to 1. It returns the mean of the four,
    each weighed by how near it is: first along both rows, then between them.
    Hint: What must come out at fx = 0 and fy = 0?
    Hint: Along a row, fx says how much the right texel counts, and 1 - fx the left one.
    Hint: t00 counts (1 - fx) (1 - fy), t11 counts fx fy: check the other two, t10 and t01, at fx = 1, fy =
    0.""",
    "def bilinear(t00, t10, t01, t11, fx, fy):\n"
    "  low = t00 * (1 - fx) + t10 * fx\n"
    "  high = t01 * (1 - fx) + t11 * fx\n"
    "  return low * (1 - fy) + high * fy",
    in_classes(_bilinear_cases()),
    (
        Fault("low = t00 * (1 - fx) + t10 * fx", "low = t00 * fx + t10 * (1 - fx)"),
        Fault("high = t01 * (1 - fx) + t11 * fx", "high = t10 * (1 - fx) + t11 * fx"),
        Fault("return low * (1 - fy) + high * fy", "return (low + high) / 2"),
    ),
    ("t00", "0", "(t00 + t10 + t01 + t11) / 4"),
    "number",
    "the filtered value",
    number_text,
)

TASKS = (PERSPECTIVE, AFFINE, DEPTH_TEST, OVER, BILINEAR)
