"""All templates that ship with the program, and how one is found."""

import tomllib
from collections.abc import Mapping
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

from lessons.exercises import templates
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import WRITTEN, Template

for _module in iter_modules(templates.__path__):
    import_module(f"{templates.__name__}.{_module.name}")
_FILES = Path(templates.__file__).parent.glob("*.toml")
_FOUND = WRITTEN | {path.stem: read_exercise(path, revision=1) for path in _FILES}
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
