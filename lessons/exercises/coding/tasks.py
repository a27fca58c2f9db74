"""All tasks by name, as files name them."""

from lessons.exercises.coding import fragment_shaders, lines, pixels, triangles, vertex_shaders
from lessons.exercises.coding.task import Task

TASKS: dict[str, Task] = {
    task.name: task
    for tasks in (
        lines.TASKS,
        triangles.TASKS,
        pixels.TASKS,
        lines.PICTURES,
        vertex_shaders.TASKS,
        fragment_shaders.TASKS,
    )
    for task in tasks
}


def task_named(name: str) -> Task:
    """Return a task; ValueError where there is none."""
    if name not in TASKS:
        raise ValueError(f"expected one of {', '.join(TASKS)}, got {name!r:.60}")
    return TASKS[name]
