"""All tasks by name, as files name them."""

from lessons.exercises.coding import (
    fragment_shaders,
    interpolations,
    lines,
    pictures,
    pixels,
    triangles,
    vertex_shaders,
)
from lessons.exercises.coding.task import Task

TASKS: dict[str, Task] = {
    task.name: task
    for module in (lines, triangles, interpolations, pixels, pictures, vertex_shaders, fragment_shaders)
    for task in module.TASKS
}


def task_named(name: str) -> Task:
    """Return a task; ValueError where there is none."""
    if name not in TASKS:
        raise ValueError(f"expected one of {', '.join(TASKS)}, got {name!r:.60}")
    return TASKS[name]
