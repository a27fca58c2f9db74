"""Texts that a state or a solution changes: of the listings that methods run, and of a scene's shaders."""

from collections.abc import Sequence
from dataclasses import replace

from core import Settings
from core.edits import EDITABLE, Edit, edited_settings, original, refusal
from core.methods import ReplacedName
from core.scene import AnyScene, Scene
from core.shaders.presets import PRESETS, preset_program, retyped
from core.shaders.shader import STAGES
from lessons.course.record import StepPart

Change = Sequence[str]
"""Part, old text, new text: the part is one of `core.edits.EDITABLE`, or one of two shaders."""


def is_of_shader(change: Change) -> bool:
    """Return whether a change is in a shader."""
    return change[0] in STAGES


def change_between(part: str, old: str, new: str) -> list[Change]:
    """Return the change that makes one text of another: whole lines that stand once; none where both are the same."""
    if old == new:
        return []
    before, after = old.splitlines(keepends=True), new.splitlines(keepends=True)
    first = next(
        (k for k, (one, other) in enumerate(zip(before, after, strict=False)) if one != other),
        min(len(before), len(after)),
    )
    last = 0
    while last < min(len(before), len(after)) - first and before[-1 - last] == after[-1 - last]:
        last += 1
    while True:
        lines = (each[first : len(each) - last] for each in (before, after))
        changed, by = map("".join, lines)
        if old.count(changed) == 1:
            return [[part, changed, by]]
        first, last = max(first - 1, 0), max(last - 1, 0)


def changes_of_edits(edits: Sequence[Edit]) -> list[Change]:
    """Return the changes that make edits of the listings of their methods."""
    found: list[Change] = []
    for edit in edits:
        found += change_between(edit.part, original(edit.part, edit.of).source, edit.text)
    return found


def shaders_of(scene: AnyScene, base: AnyScene) -> tuple[str, list[Change]]:
    """Return the preset that the shaders of a scene began with, and the changes since; empty: those of the base.

    Raises ValueError where a state cannot say them.
    """
    program = scene.program if isinstance(scene, Scene) else None
    its = base.program if isinstance(base, Scene) else None
    if program == its:
        return "", []
    if program is None or not isinstance(scene, Scene):
        raise ValueError("a state of this scene keeps its shaders")
    preset = next((name for name, known in PRESETS.items() if known.title == program.name), "")
    if not preset:
        raise ValueError("only shaders that began with a preset can stand in a lesson")
    known = preset_program(preset, replace(scene, program=None))
    if (program.uniforms, program.dialect) != (known.uniforms, known.dialect):
        raise ValueError("uniforms and the dialect of shaders can only be those of their preset in a lesson")
    changes: list[Change] = []
    for stage in STAGES:
        changes += change_between(stage, getattr(known, stage), getattr(program, stage))
    return ("" if its == known else preset), changes


def edited_shader(step: StepPart) -> str:
    """Return which shader the solution of a step changes first; empty: none."""
    changes = step.solution.edit if step.solution is not None else ()
    return next((change[0] for change in changes if is_of_shader(change)), "")


def with_shaders(scene: AnyScene, preset: str) -> Scene:
    """Return a scene that a preset's shaders draw; ValueError where it has no meshes."""
    if not isinstance(scene, Scene):
        raise ValueError("expected a scene of meshes where shaders draw")
    return replace(scene, program=preset_program(preset, replace(scene, program=None)))


def with_changed_shaders(scene: AnyScene, changes: Sequence[Change]) -> AnyScene:
    """Return a scene with the changes that are in its shaders; ValueError where it has none, or they do not run."""
    wanted = list(filter(is_of_shader, changes))
    if not wanted:
        return scene
    program = scene.program if isinstance(scene, Scene) else None
    if not isinstance(scene, Scene) or program is None:
        raise ValueError("expected a scene with shaders where one is changed")
    sources = {stage: getattr(program, stage) for stage in STAGES}
    for part, old, new in wanted:
        sources[part] = _replaced(sources[part], old, new, f"the {part} shader")
    return replace(scene, program=retyped(program, **sources))


def with_changed_listings(
    edits: tuple[Edit, ...], settings: Settings, scene: AnyScene, changes: Sequence[Change]
) -> tuple[Edit, ...]:
    """Return edits with the changes that are in listings of the chosen methods; ValueError where they do not run."""
    found = list(edits)
    for part, old, new in changes:
        if is_of_shader((part,)):
            continue
        if part not in EDITABLE:
            raise ValueError(refusal(part, ""))
        chosen = getattr(settings, EDITABLE[part].family)
        of = chosen.method.name if isinstance(chosen, ReplacedName) else str(chosen)
        if reason := refusal(part, of):
            raise ValueError(reason)
        before = next((edit.text for edit in found if edit.part == part), original(part, of).source)
        text = _replaced(before, old, new, f"the listing of {part}")
        found = [edit for edit in found if edit.part != part] + [Edit(part, of, text)]
    if found:
        edited_settings(settings, scene, found)
    return tuple(found)


def _replaced(text: str, old: str, new: str, where: str) -> str:
    if text.count(old) != 1:
        raise ValueError(f"expected a text that stands once in {where}, got {old!r:.80}")
    return text.replace(old, new)
