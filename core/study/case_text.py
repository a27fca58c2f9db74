"""A failing case as a Python test: its scene, its settings, and what is right."""

import re
from dataclasses import asdict
from textwrap import wrap

import numpy as np

from core.records.arrays import Flags, Floats, Integers, read_only
from core.scene import AnyScene, Camera, ClipScene, DirectionalLight, Scene, Texture
from core.settings import Settings

LINE_LENGTH = 100
UP = read_only(np.array([0.0, 1.0, 0.0]))
"""(3,) a camera's way up, if nothing is said of it."""
NAMES = (
    *("Camera", "ClipScene", "DirectionalLight", "Material", "Mesh", "Scene", "Settings", "Texture"),
    *("clip_lines", "draw_lines", "render"),
)
"""Names of ``core`` that a test may call."""


def case_text(title: str, sentence: str, body: str) -> str:
    """Return a Python file with one test.

    Parameters
    ----------
    title : str
        What the test is called, after ``test_``.
    sentence : str
        What goes wrong.
    body : str
        Its statements; they may use ``np`` and the names of ``core``.
    """
    names = [name for name in NAMES if re.search(rf"\b{name}\(", body)]
    imports = ["import numpy as np", ""] if "np." in body else []
    name = "".join(character if character.isalnum() else "_" for character in title)
    remarks = [f"    # {line}" for line in wrap(sentence, LINE_LENGTH)]
    statements = [f"    {line}" for line in body.splitlines()]
    head = [*imports, f"from core import {', '.join(names)}", "", "", f"def test_{name}() -> None:"]
    return "\n".join([*head, *remarks, *statements, ""])


def clip_text(clip: Floats) -> str:
    """Return clip positions (T, 3, 4) as Python writes lists, a line for each corner."""
    lines = ["["]
    for triangle in clip.tolist():
        corners = [f"        [{', '.join(_number(value) for value in corner)}]," for corner in triangle]
        lines += ["    [", *corners, "    ],"]
    return "\n".join([*lines, "]"])


def _number(value: float) -> str:
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


def cover_text(cover: Integers) -> list[str]:
    """Return how often pixels (H, W) are covered, row by row from the top: ``.`` for 0, ``1`` to ``9`` and more."""
    return ["".join(".123456789"[min(count, 9)] for count in row) for row in cover[::-1].tolist()]


def settings_text(settings: Settings) -> str:
    """Return settings as Python makes them, those that are not the defaults."""
    changed = {name: value for name, value in vars(settings).items() if value != getattr(Settings(), name)}
    return f"Settings({', '.join(f'{name}={_quoted(value)}' for name, value in changed.items())})"


def _quoted(value: str | int) -> str:
    return f'"{value}"' if isinstance(value, str) else str(value)


def scene_text(scene: AnyScene) -> str:
    """Return statements that make ``scene``, with all that matters to a picture.

    Raises ValueError for a scene of meshes other than one with normals under one distant light.
    """
    return _triangles_text(scene) if isinstance(scene, ClipScene) else _mesh_text(scene)


def _triangles_text(scene: ClipScene) -> str:
    background = _unless_usual("background", scene.background, 0.0)
    texture = "" if scene.texture is None else ", texture=texture"
    assert scene.attributes is not None
    return (
        f"clip = {clip_text(scene.clip)}\n"
        f"values = {clip_text(scene.attributes)}\n"
        f"{'' if scene.texture is None else _texture_text(scene.texture)}"
        f"scene = ClipScene(np.array(clip, float), np.array(values, float), {scene.size}{texture}{background})"
    )


def _texture_text(texture: Texture) -> str:
    """Return a statement that makes a texture; its numbers have no more digits than float32 needs."""
    rows = [
        "    [" + ", ".join(f"[{', '.join(map(str, texel))}]" for texel in row) + "],"
        for row in texture.pixels
    ]
    listed = "\n".join(rows)
    return f"texels = [\n{listed}\n]\ntexture = Texture(np.array(texels, np.float32))\n"


def _mesh_text(scene: Scene) -> str:
    if len(scene.meshes) != 1 or len(scene.lights) != 1:
        raise ValueError("expected one mesh under one light, got another scene")
    (mesh,), (light,) = scene.meshes, scene.lights
    if mesh.normals is None or not isinstance(light, DirectionalLight):
        raise ValueError("expected a mesh with normals under a distant light, got another one")
    material = ", ".join(f"{name}={value}" for name, value in asdict(mesh.material).items())
    is_round = np.array_equal(mesh.normals, mesh.positions)
    normals = "positions" if is_round else f"np.array({mesh.normals.tolist()})"
    return (
        f"positions = np.array({mesh.positions.tolist()})\n"
        f"normals = {normals}\n"
        f"material = Material({material})\n"
        f"mesh = Mesh(positions, np.array({mesh.triangles.tolist()}), normals, material=material)\n"
        f"{_camera_text(scene.camera)}\n"
        f"light = DirectionalLight(np.array({light.direction.tolist()}){_unless_usual('color', light.color, 1.0)})\n"
        f"scene = Scene((mesh,), camera, (light,), {scene.size}{_unless_usual('background', scene.background, 0.0)})"
    )


def _unless_usual(name: str, numbers: Floats, usual: Floats | float) -> str:
    """Return an argument that gives ``numbers`` (k,), or nothing where they are the ``usual`` ones."""
    return "" if (numbers == usual).all() else f", {name}=np.array({numbers.tolist()})"


def _camera_text(camera: Camera) -> str:
    opening = (
        f"field_of_view={camera.field_of_view}"
        if camera.projection == "perspective"
        else f'projection="orthographic", view_height={camera.view_height}'
    )
    return (
        f"eye, target = np.array({camera.eye.tolist()}), np.array({camera.target.tolist()})\n"
        f"camera = Camera(eye, target{_unless_usual('up', camera.up, UP)}, {opening}, "
        f"near={camera.near}, far={camera.far})"
    )


def pixels_text(wrong: Flags, wanted: Floats | Integers, check: str) -> str:
    """Return statements that check every wrong pixel against what it should show.

    Parameters
    ----------
    wrong : (H, W) bool
    wanted : (H, W) or (H, W, C)
        What is right: whole numbers or float64.
    check : str
        What holds of ``column``, ``row`` and ``wanted``.
    """
    return f"{listed_pixels(wrong, wanted)}\nfor column, row, wanted in pixels:\n    assert {check}"


def listed_pixels(which: Flags, wanted: Floats | Integers) -> str:
    """Return a statement that lists pixels, ``which`` (H, W) bool, with what is ``wanted``, (H, W) or (H, W, C)."""
    rows, columns = np.nonzero(which)
    values = [
        f"    ({column}, {row}, {wanted[row, column].tolist()}),"
        for column, row in zip(columns.tolist(), rows.tolist(), strict=True)
    ]
    listed = "\n".join(values)
    return f"pixels = [\n{listed}\n]"
