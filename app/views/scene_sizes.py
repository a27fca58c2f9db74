"""At which sizes the 3D view can draw: that of the view, that of the scene, or one that others are compared at."""

from widgets.space.frame_corner import SizeChoice

OWN_SIZE = "view"
SCENE_SIZE = "scene"
FIXED_SIZES = ((512, 512), (1024, 1024), (1280, 720), (1920, 1080))


def size_choices(scene_size: tuple[int, int]) -> tuple[SizeChoice, ...]:
    """Return what can be chosen for a scene whose picture is (width, height)."""
    return (
        SizeChoice(OWN_SIZE, "Draw at the size of the view"),
        SizeChoice(SCENE_SIZE, f"Size of the scene: {scene_size[0]} × {scene_size[1]}"),
        *(SizeChoice(f"{width}x{height}", f"{width} × {height}") for width, height in FIXED_SIZES),
    )


def fixed_size(name: str, scene_size: tuple[int, int]) -> tuple[int, int] | None:
    """Return width and height that a choice stands for, None: those of the view.

    Raises
    ------
    ValueError
        If there is no such choice.
    """
    named = {f"{width}x{height}": (width, height) for width, height in FIXED_SIZES}
    named[SCENE_SIZE] = scene_size
    if name != OWN_SIZE and name not in named:
        raise ValueError(f"size must be one of {', '.join((OWN_SIZE, *named))}, got {name}")
    return named.get(name)
