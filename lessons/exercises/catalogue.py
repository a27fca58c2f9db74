"""All templates that ship with the program, and how one is found."""

import tomllib
from collections.abc import Mapping
from difflib import get_close_matches
from pathlib import Path

from lessons.exercises import templates
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import Template
from lessons.exercises.templates import (
    beliefs_looks,
    beliefs_pixels,
    beliefs_space,
    clipping,
    coverage,
    depths,
    edges,
    faces,
    filling,
    fragments,
    interpolation,
    lighting,
    line_methods,
    lines,
    mixing,
    next_steps,
    on_picture,
    placing,
    polygon_rows,
    polygons,
    reading,
    repairs,
    running,
    stepping,
    stepping_numbers,
    textures,
    transforms,
    wrong_lines,
)

_MODULES = (
    on_picture,
    transforms,
    faces,
    polygons,
    edges,
    coverage,
    filling,
    polygon_rows,
    lines,
    line_methods,
    clipping,
    interpolation,
    textures,
    lighting,
    fragments,
    depths,
    mixing,
    placing,
    reading,
    stepping,
    running,
    next_steps,
    beliefs_space,
    beliefs_pixels,
    beliefs_looks,
    wrong_lines,
    stepping_numbers,
    repairs,
)

_FILES = Path(templates.__file__).parent.glob("*.toml")
_FOUND = {
    template.name: template
    for template in [
        *(each for module in _MODULES for each in module.TEMPLATES),
        *(read_exercise(path, revision=1) for path in _FILES),
    ]
}
_ORDER: dict[str, dict[str, list[str]]] = tomllib.loads(
    Path(__file__).with_name("order.toml").read_text(encoding="utf-8")
)

SUBJECTS: dict[str, str] = {
    name: subject for lists in _ORDER.values() for subject, names in lists.items() for name in names
}
"""What each template is about, by its name; empty: its stage is not divided."""
TEMPLATES: dict[str, Template] = {name: _FOUND[name] for name in SUBJECTS}
"""By name, stage by stage, from easy to hard."""


def template_named(name: str, templates: Mapping[str, Template] = TEMPLATES) -> Template:
    """Return a template by its name, or that of a TOML file by its path; ValueError where there is none."""
    if name.endswith(".toml"):
        return read_exercise(Path(name))
    if name not in templates:
        near = get_close_matches(name, templates) or ["triangle-coverage"]
        raise ValueError(f"expected a .toml file or an exercise such as {', '.join(near)}, got {name!r:.60}")
    return templates[name]
