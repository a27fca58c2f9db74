"""Texts that a state or a solution changes: of the listings that methods run, and of a scene's shaders."""

from collections.abc import Sequence
from dataclasses import replace

from core import Settings
from core.edits import EDITABLE, Edit, edited_settings, original, refusal
from core.methods import ReplacedName
from core.scene import AnyScene, Scene
from core.shaders.presets import preset_program, retyped
from core.shaders.shader import STAGES

Change = Sequence[str]
"""Part, old text, new text: the part is one of `core.edits.EDITABLE`, or one of two shaders."""


def is_of_shader(change: Change) -> bool:
    """Return whether a change is in a shader."""
    return change[0] in STAGES


def with_shaders(scene: AnyScene, preset: str) -> Scene:
    """Return a scene that a preset's shaders draw; ValueError where it has no meshes."""
    if not isinstance(scene, Scene):
        raise ValueError("expected a scene of meshes where shaders draw")
    return replace(scene, program=preset_program(preset, replace(scene, program=None)))


def with_changed_shaders(scene: AnyScene, changes: Sequence[Change]) -> AnyScene:
    """Return a scene with the changes that are in its shaders; ValueError where it has none, or they do not run."""
    for part, old, new in filter(is_of_shader, changes):
        program = scene.program if isinstance(scene, Scene) else None
        if not isinstance(scene, Scene) or program is None:
            raise ValueError("expected a scene with shaders where one is changed")
        sources = {stage: getattr(program, stage) for stage in STAGES}
        sources[part] = _replaced(sources[part], old, new, f"the {part} shader")
        scene = replace(scene, program=retyped(program, scene, **sources))
    return scene


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
