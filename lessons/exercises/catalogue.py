"""All templates that ship with the program, and how one is found."""

from collections.abc import Mapping
from pathlib import Path

from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import Template
from lessons.exercises.templates import (
    clipping,
    coverage,
    edges,
    faces,
    filling,
    fragments,
    line_methods,
    lines,
    placing,
    polygons,
    reading,
    running,
    stepping,
    transforms,
)

TEMPLATES: dict[str, Template] = {
    template.name: template
    for module in (
        transforms,
        faces,
        polygons,
        edges,
        coverage,
        filling,
        lines,
        line_methods,
        clipping,
        fragments,
        placing,
        reading,
        stepping,
        running,
    )
    for template in module.TEMPLATES
}
"""By name, stage by stage."""


def template_named(name: str, templates: Mapping[str, Template] = TEMPLATES) -> Template:
    """Return a template by its name, or that of a TOML file by its path; ValueError where there is none."""
    if name.endswith(".toml"):
        return read_exercise(Path(name))
    if name not in templates:
        raise ValueError(f"expected a .toml file or one of {', '.join(templates)}, got {name!r:.60}")
    return templates[name]
