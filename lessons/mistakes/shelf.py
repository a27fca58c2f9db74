"""The shelf of mistakes, by name: faulty runs, and wrong formulas."""

from difflib import get_close_matches

from lessons.mistakes import (
    bones,
    boxes,
    clipping,
    coverage,
    curves,
    depths,
    fragments,
    history,
    hit_lists,
    occluders,
    planes,
    presenting,
    reflections,
    scan_conversion,
    scan_lines,
    shaders,
    shadows,
    smoothing,
    surfaces,
    transforms,
    visible_work,
)
from lessons.mistakes.shaders import ShaderMistake
from lessons.mistakes.twin import ENTERED, Twin, WrongRule

SHELF: dict[str, Twin] = {
    twin.name: twin
    for module in (
        coverage,
        scan_conversion,
        clipping,
        fragments,
        surfaces,
        shadows,
        reflections,
        depths,
        planes,
        boxes,
        hit_lists,
        occluders,
    )
    for twin in module.TWINS
}
"""Runs that make a mistake, stage by stage."""

RULES: dict[str, WrongRule] = {
    rule.name: rule
    for module in (
        transforms,
        curves,
        bones,
        clipping,
        scan_conversion,
        surfaces,
        shadows,
        reflections,
        depths,
        planes,
        scan_lines,
        hit_lists,
        boxes,
        occluders,
        smoothing,
        visible_work,
        history,
        presenting,
    )
    for rule in ENTERED[module.__name__]
}
"""Wrong formulas, stage by stage; a run of the shelf with the same name makes the same mistake."""

SHADERS: dict[str, ShaderMistake] = {mistake.name: mistake for mistake in shaders.SHELF}
"""Wrong lines of shaders."""

MISTAKES: dict[str, Twin | WrongRule | ShaderMistake] = {**SHELF, **RULES, **SHADERS}
"""All of them."""


def twin_named(name: str) -> Twin:
    """Return a faulty run, or raise ValueError with the names that there are."""
    if name not in SHELF:
        near = get_close_matches(name, SHELF) or ["corner-for-center"]
        raise ValueError(f"expected a mistake such as {', '.join(near)}, got {name!r:.60}")
    return SHELF[name]
