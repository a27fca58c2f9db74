"""What is open at a step of a lesson: settings, scene, and the texts of listings and shaders that it changes."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import radians
from typing import Any

import numpy as np

from core import STAGES, Settings, Trace, trace
from core.edits.edit import Edit, edited_settings, original
from core.edits.editable import EDITABLE, refusal
from core.methods import ReplacedName
from core.scene import AnyScene, ClipScene, DirectionalLight, PointLight, Scene
from core.setting_texts import settings_from_texts
from core.shaders.presets import PRESETS, preset_program, retyped
from core.shaders.shader import STAGES as SHADER_STAGES
from core.trace import scene_triangle_count
from core.trace.run_to import START
from core.trace.source import LONGEST_RUN, most_tests
from lessons.course.catalogue import Lesson
from lessons.course.record import CameraPart, ChangePart, MaterialPart, SolutionPart, StatePart, StepPart
from lessons.exercises.drafting import DrawnScene, draw_scene
from lessons.exercises.numbers import Draws
from lessons.lectures.catalogue import printed_listing
from lessons.lectures.scenes import scene_named
from lessons.run_place import RunPlace
from lessons.scene_edits import clip_of_window, join_shared, move_corner, set_clip_corner, window_of_clip

# Texts that a state or a solution changes: of the listings that methods run, and of a scene's shaders.


Change = Sequence[str]
"""Part, old text, new text: the part is one of `core.edits.EDITABLE`, or one of two shaders."""


def is_of_shader(change: Change) -> bool:
    """Return whether a change is in a shader."""
    return change[0] in SHADER_STAGES


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
    for stage in SHADER_STAGES:
        changes += change_between(stage, getattr(known, stage), getattr(program, stage))
    return ("" if its == known else preset), changes


def edited_shader(step: StepPart) -> str:
    """Return which shader the solution of a step changes first; empty: none."""
    changes = step.solution.edit if step.solution is not None else ()
    return next((change[0] for change in changes if is_of_shader(change)), "")


def wanted_settings(step: StepPart | None, panes: Collection[str]) -> dict[str, str]:
    """Return the settings that the solution of a step changes, where the Methods pane is open for it."""
    if step is None or step.solution is None or "methods" not in panes:
        return {}
    return dict(step.solution.settings)


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
    sources = {stage: getattr(program, stage) for stage in SHADER_STAGES}
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


# A state: what is open at a step of a lesson, merged from what the file says for all steps and for this
# one.


RASTER_LIMIT = (96, 72)
"""Largest raster of a state in pixels: one on which every pixel can be pointed at."""
OF_SCENE = (
    *("size", "shared", "corners", "depth", "w", "vertices", "camera", "light", "material", "shaders"),
    *("edit", "triangle", "pixel"),
)
"""What a state drops when it names another scene."""


@dataclass(frozen=True, eq=False)
class State:
    """What is open, and where the cursor stands."""

    scene: AnyScene
    title: str
    """Of the scene, or of the lesson."""
    drawn: DrawnScene
    """The scene with its numbers, as answers read it."""
    settings: Settings
    other: Settings | None = None
    """Of side B; ``None``: only A is shown."""
    printed: str = ""
    """Name of the listing that B runs as it is printed; empty: none."""
    edits: tuple[Edit, ...] = ()
    """Listings that are edited: B runs them."""
    place: RunPlace = field(default_factory=RunPlace)
    triangle: int | None = None
    buffer: str = ""
    view: str = ""
    panes: tuple[str, ...] = ()

    @property
    def stage(self) -> str:
        """The stage of the cursor."""
        return self.place.stage

    @property
    def pixel(self) -> tuple[int, int] | None:
        """The pixel that is pinned."""
        return self.place.pixel

    @cached_property
    def run(self) -> Trace:
        """Its trace."""
        return trace(self.scene, self.settings, self.triangle)

    def position(self, run: Trace) -> int:
        """Return where the cursor stands in a run; ValueError where nothing of its name happens."""
        return self.place.position(run)


def merged(base: StatePart, step: StatePart) -> StatePart:
    """Return what a step says on top of a base.

    Settings are joined, all else replaces; another scene drops what is of it, another stage the cursor and the buffer.
    """
    given: dict[str, Any] = {name: getattr(base, name) for name in base.model_fields_set}
    if step.scene is not None:
        given = {name: value for name, value in given.items() if name not in OF_SCENE}
    if step.stage is not None and step.stage != given.get("stage"):
        given = {name: value for name, value in given.items() if name not in ("at", "operation", "buffer")}
    if step.at is not None:
        given.pop("operation", None)
    given |= {name: getattr(step, name) for name in step.model_fields_set}
    given["settings"] = {**base.settings, **step.settings}
    return StatePart().model_copy(update=given)


class States:
    """The states of one lesson; equal scenes are the same object, so that two steps share what is open."""

    def __init__(self, lesson: Lesson) -> None:
        self._lesson = lesson
        self._scenes: dict[str, tuple[DrawnScene, str]] = {}
        self._states: dict[str, State] = {}

    def of_step(self, number: int) -> State:
        """Return where a step begins; ValueError with file and line."""
        return self._opened(self._merged(number), ("step", number, "state"))

    def of_reveal(self, number: int) -> State | None:
        """Return what a step shows after the answer; ``None``: the same."""
        reveal = self._lesson.steps[number].reveal
        if reveal is None:
            return None
        return self._opened(merged(self._merged(number), reveal), ("step", number, "reveal"))

    def of_solution(self, number: int) -> State:
        """Return what the recorded solution of a step leaves; without one, where the step begins."""
        solution, state = self._lesson.steps[number].solution, self.of_step(number)
        return state if solution is None else solved(state, solution)

    def of_wrong(self, number: int, wrong: int) -> State | None:
        """Return the step that refutes a wrong answer; ``None``: the file names none."""
        part = self._lesson.steps[number].wrong[wrong]
        if part.at is None:
            return None
        its = StatePart(at=part.at) if part.stage is None else StatePart(at=part.at, stage=part.stage)
        return self._opened(merged(self._merged(number), its), ("step", number, "wrong", wrong, "at"))

    def _merged(self, number: int) -> StatePart:
        return merged(self._lesson.part.state, self._lesson.steps[number].state)

    def _opened(self, part: StatePart, location: tuple[str | int, ...]) -> State:
        key = repr(part)
        if key not in self._states:
            try:
                self._states[key] = self._open(part)
            except ValueError as problem:
                raise self._lesson.file.error(location, str(problem)) from None
        return self._states[key]

    def _open(self, part: StatePart) -> State:
        drawn, title = self._scene(part)
        own = scene_named(drawn.name).settings if drawn.name else {}
        settings = settings_from_texts({**own, **part.settings})
        count = 1 if part.triangle is not None else scene_triangle_count(drawn.scene)
        columns, rows = drawn.scene.size
        if most_tests(drawn.scene, settings, count, columns * rows) > LONGEST_RUN:
            raise ValueError("expected a smaller size, or one triangle: there are too many steps to be kept")
        stage = part.stage or STAGES[0]
        pixel = _pixel(part.pixel, drawn.scene)
        return State(
            drawn.scene,
            title,
            drawn,
            settings,
            settings_from_texts(part.other, settings) if part.other else None,
            printed_listing(part.printed).name if part.printed else "",
            with_changed_listings((), settings, drawn.scene, part.edit),
            RunPlace(stage, part.at or START, part.operation or "", pixel),
            part.triangle,
            part.buffer or "",
            part.view or "",
            tuple(part.panes or ()),
        )

    def _scene(self, part: StatePart) -> tuple[DrawnScene, str]:
        """Return the scene of a state, and its title."""
        if part.scene is None:
            raise ValueError("expected a scene, here or in [state]")
        names = ("scene", *OF_SCENE[: OF_SCENE.index("edit")])
        key = repr([*(getattr(part, name) for name in names), [*filter(is_of_shader, part.edit)]])
        if key not in self._scenes:
            name = part.scene.builtin
            named = None if name is None else scene_named(name)
            size = part.size or (named.make().size if named else part.scene.size)
            if size[0] > RASTER_LIMIT[0] or size[1] > RASTER_LIMIT[1]:
                limit, got = " x ".join(map(str, RASTER_LIMIT)), " x ".join(map(str, size))
                raise ValueError(f"expected a size of up to {limit} pixels, got {got}")
            if part.scene.has_ranges:
                raise ValueError("expected coordinates, not ranges to draw from")
            drawn = draw_scene(part.scene.model_copy(update={"size": list(size)}), Draws(0))
            scene = moved_vertices(drawn.scene, part.vertices)
            if part.material is not None:
                scene = _of_material(scene, part.material)
            if part.shaders is not None:
                scene = with_shaders(scene, part.shaders)
            if part.shared:
                scene = join_shared(scene)
            scene = changed(scene, part)
            title = named.title if named else self._lesson.title
            self._scenes[key] = replace(drawn, scene=scene), title
        return self._scenes[key]


def _pixel(given: list[int] | None, scene: AnyScene) -> tuple[int, int] | None:
    if not given:
        return None
    if len(given) != 2 or any(one >= side for one, side in zip(given, scene.size, strict=True)):
        columns, rows = scene.size
        raise ValueError(f"expected a pixel of the {columns} x {rows} there are, got {given}")
    return given[0], given[1]


def moved_vertices(scene: AnyScene, vertices: list[list[Any]]) -> AnyScene:
    """Return a scene with vertices [mesh, vertex, x, y, z] at other places in object space."""
    for mesh, vertex, *place in vertices:
        if isinstance(scene, ClipScene):
            raise ValueError("expected a scene of meshes where vertices are moved")
        if mesh >= len(scene.meshes) or vertex >= len(scene.meshes[int(mesh)].positions):
            raise ValueError(f"expected a vertex of the scene, got [{mesh}, {vertex}]")
        meshes = list(scene.meshes)
        positions = meshes[int(mesh)].positions.copy()
        positions[int(vertex)] = [float(one) for one in place]
        meshes[int(mesh)] = replace(meshes[int(mesh)], positions=positions)
        scene = replace(scene, meshes=tuple(meshes))
    return scene


def changed(scene: AnyScene, change: ChangePart) -> AnyScene:
    """Return a scene with its corners, camera and lights changed; ValueError where it has none such."""
    for *at, x, y in change.corners:
        triangle, corner = _corner(scene, at)
        scene = move_corner(scene, triangle, corner, (float(x), float(y)), scene.size)
    for name, rows in (("depth", change.depth), ("w", change.w)):
        for *at, value in rows:
            triangle, corner = _corner(scene, at)
            if not isinstance(scene, ClipScene):
                raise ValueError(f"expected triangles in the window where {name} is changed")
            window = window_of_clip(scene.clip[triangle, corner], scene.size)
            window[["depth", "w"].index(name) + 2] = float(value)
            if window[3] == 0:
                raise ValueError("expected a w that is not 0")
            scene = set_clip_corner(scene, triangle, corner, clip_of_window(window, scene.size))
    if change.camera is not None:
        scene = _through(scene, change.camera)
    for light, *vector in change.light:
        scene = _lit(scene, int(light), [float(one) for one in vector])
    return with_changed_shaders(scene, change.edit)


def _corner(scene: AnyScene, at: list[Any]) -> tuple[int, int]:
    triangle, corner = (int(one) for one in at)
    count = len(scene.clip) if isinstance(scene, ClipScene) else sum(len(m.triangles) for m in scene.meshes)
    if not (0 <= triangle < count and 0 <= corner < scene.corner_count):
        raise ValueError(f"expected a corner of the scene, got [{triangle}, {corner}]")
    return triangle, corner


def _through(scene: AnyScene, part: CameraPart) -> Scene:
    if isinstance(scene, ClipScene):
        raise ValueError("expected a scene of meshes where the camera is changed")
    values: dict[str, Any] = {}
    for name in part.model_fields_set:
        value = getattr(part, name)
        if isinstance(value, list):
            values[name] = np.array([float(one) for one in value])
        elif name == "field_of_view":
            values[name] = radians(float(value))
        else:
            values[name] = value if isinstance(value, str) else float(value)
    return replace(scene, camera=replace(scene.camera, **values))


def _of_material(scene: AnyScene, part: MaterialPart) -> Scene:
    if isinstance(scene, ClipScene):
        raise ValueError("expected a scene of meshes where the material is changed")
    values = {name: float(getattr(part, name)) for name in part.model_fields_set}
    meshes = (replace(mesh, material=replace(mesh.material, **values)) for mesh in scene.meshes)
    return replace(scene, meshes=tuple(meshes))


def _lit(scene: AnyScene, number: int, vector: list[float]) -> Scene:
    if isinstance(scene, ClipScene) or not 0 <= number < len(scene.lights):
        raise ValueError(f"expected a light of the scene, got {number}")
    lights = list(scene.lights)
    light = lights[number]
    if isinstance(light, PointLight):
        lights[number] = replace(light, position=np.array(vector))
    else:
        assert isinstance(light, DirectionalLight)
        lights[number] = replace(light, direction=np.array(vector))
    return replace(scene, lights=tuple(lights))


def solved(state: State, solution: SolutionPart) -> State:
    """Return what a solution makes of a state; ValueError where it cannot be done."""
    scene = changed(state.scene, solution)
    if solution.size is not None:
        scene = replace(scene, size=(solution.size[0], solution.size[1]))
    place = replace(
        state.place,
        stage=solution.stage or state.stage,
        at=solution.at or (START if solution.stage else state.place.at),
        operation="" if solution.at or solution.stage else state.place.operation,
        pixel=_pixel(solution.pixel, scene) or state.pixel,
    )
    settings = settings_from_texts(solution.settings, state.settings)
    edits = with_changed_listings(state.edits, settings, scene, solution.edit)
    return replace(state, scene=scene, settings=settings, edits=edits, place=place)
