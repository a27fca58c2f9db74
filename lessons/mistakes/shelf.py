"""The shelf of mistakes, by name: faulty runs, and wrong formulas."""

from difflib import get_close_matches

from lessons import shader_mistakes
from lessons.mistakes import (
    clipping,
    coverage,
    cutting,
    depths,
    fills,
    fragments,
    lighting,
    lines,
    textures,
    transforms,
)
from lessons.mistakes.twin import Twin, WrongRule
from lessons.shader_mistakes import ShaderMistake

SHELF: dict[str, Twin] = {
    twin.name: twin
    for module in (coverage, fills, lines, clipping, fragments, textures, depths)
    for twin in module.TWINS
}
"""Runs that make a mistake, stage by stage."""

RULES: dict[str, WrongRule] = {
    rule.name: rule
    for module in (transforms, cutting, fills, lighting, textures, depths)
    for rule in module.RULES
}
"""Wrong formulas, stage by stage."""

SHADERS: dict[str, ShaderMistake] = {mistake.name: mistake for mistake in shader_mistakes.SHELF}
"""Wrong lines of shaders."""

MISTAKES: dict[str, Twin | WrongRule | ShaderMistake] = {**SHELF, **RULES, **SHADERS}
"""All of them."""


def twin_named(name: str) -> Twin:
    """Return a faulty run, or raise ValueError with the names that there are."""
    if name not in SHELF:
        near = get_close_matches(name, SHELF) or ["corner-for-center"]
        raise ValueError(f"expected a mistake such as {', '.join(near)}, got {name!r:.60}")
    return SHELF[name]
