"""MTL: the materials that an OBJ file names."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from app.files.mesh_formats.images import ImageError, linear_from_srgb, read_texture
from core.records.arrays import Floats
from core.scene import Material, Texture

DIFFUSE = 0.8
"""Grey of a material that gives no Kd."""


@dataclass(frozen=True, eq=False)
class ObjMaterial:
    """What the triangles between two ``usemtl`` lines look like."""

    name: str = ""
    color: Floats = field(default_factory=lambda: np.append(linear_from_srgb([DIFFUSE] * 3), 1.0))
    """(4,) float64 linear: Kd, and d as alpha. White where there is a texture."""
    texture: Texture | None = None
    material: Material = field(default_factory=Material)


def beside(path: Path, name: str) -> Path:
    """Return where the file ``name`` is that ``path`` names.

    Notes
    -----
    Names written on another machine may have backslashes, or folders that are not here; then the file
    that stands beside ``path`` is meant.
    """
    name = name.strip().strip('"').replace("\\", "/")
    whole = path.parent / name
    return whole if whole.is_file() else path.parent / name.rsplit("/", 1)[-1]


def read_mtl(path: Path) -> tuple[dict[str, ObjMaterial], list[str]]:
    """Read the materials of an MTL file.

    Kd, Ks, Ns, d, Tr and map_Kd are read; colours count as sRGB. Ns and Ks become the exponent and, as the
    mean of its channels, the strength of the highlight.

    Returns
    -------
    materials : dict
        By name.
    warnings : list of str
        Textures that cannot be had and lines that cannot be read.

    Raises
    ------
    OSError
        If ``path`` cannot be read.
    """
    materials: dict[str, ObjMaterial] = {}
    warnings: list[str] = []
    current: ObjMaterial | None = None
    for number, line in enumerate(path.read_text(encoding="utf-8-sig", errors="replace").splitlines(), 1):
        keyword, _, rest = line.strip().partition(" ")
        if keyword == "newmtl":
            current = ObjMaterial(name=rest.strip())
        elif current is not None:
            try:
                current = with_property(current, keyword.lower(), rest.strip(), path)
            except ImageError as problem:
                warnings.append(
                    f"texture {texture_name(rest)} of material {current.name} {problem}; it is left out"
                )
            except ValueError:
                warnings.append(f"line {number} of {path.name} cannot be read: {line.strip()}")
        if current is not None:
            materials[current.name] = current
    return materials, warnings


def with_property(material: ObjMaterial, keyword: str, rest: str, path: Path) -> ObjMaterial:
    """Return ``material`` with one line of its MTL file put in; unknown keywords change nothing."""
    if keyword == "map_kd":
        # The core multiplies the two, and many files give Kd 0 0 0 beside a texture.
        texture = read_texture(beside(path, texture_name(rest)))
        return replace(material, texture=texture, color=np.append(np.ones(3), material.color[3]))
    if keyword not in ("kd", "ks", "ns", "d", "tr"):
        return material
    values = [float(value) for value in rest.split() if value != "-halo"]
    if not values or not np.isfinite(values).all():
        raise ValueError(f"{keyword} must be finite numbers, got {rest}")
    if keyword == "kd":
        if material.texture is not None:
            return material
        red, green, blue = values if len(values) == 3 else values[:1] * 3
        return replace(material, color=np.append(linear_from_srgb([red, green, blue]), material.color[3]))
    if keyword == "ks":
        strength = min(1.0, max(0.0, sum(values) / len(values)))
        return replace(material, material=replace(material.material, specular=strength))
    if keyword == "ns":
        return replace(
            material, material=replace(material.material, shininess=min(10000.0, max(1.0, values[0])))
        )
    opacity = values[0] if keyword == "d" else 1 - values[0]
    return replace(material, color=np.append(material.color[:3], min(1.0, max(0.0, opacity))))


def texture_name(rest: str) -> str:
    """Return the file name that ends a ``map_Kd`` line, which may have options with values before it."""
    words = rest.split()
    while words and words[0].startswith("-"):
        words = words[1:]
        while len(words) > 1 and is_option_value(words[0]):
            words = words[1:]
        rest = " ".join(words)
    return rest


def is_option_value(word: str) -> bool:
    """Whether ``word`` is a value that options of a texture take: a number, ``on``, ``off`` or a channel."""
    if word in ("on", "off", "r", "g", "b", "m", "l", "z"):
        return True
    try:
        float(word)
    except ValueError:
        return False
    return True


def find_materials(
    path: Path, libraries: Sequence[str], names: Sequence[str], has_uvs: bool
) -> tuple[dict[str, ObjMaterial], list[str]]:
    """Read the materials that an OBJ file names; what cannot be had gives a warning each.

    Parameters
    ----------
    path : Path
        The OBJ file.
    libraries : sequence of str
        What its ``mtllib`` lines say.
    names : sequence of str
        What its ``usemtl`` lines say.
    has_uvs : bool
        Whether it has texture coordinates: then an image beside it is its texture if it names no library.
    """
    materials: dict[str, ObjMaterial] = {}
    warnings: list[str] = []
    unread = 0
    for line in dict.fromkeys(libraries):
        # A line may give several files, or one whose name has spaces.
        for name in [line] if beside(path, line).is_file() else line.split() or ["(no name)"]:
            try:
                more, problems = read_mtl(beside(path, name))
            except OSError as problem:
                unread += 1
                warnings.append(
                    f"material file {name} cannot be read ({problem.strerror}); its materials are left out"
                )
            else:
                materials.update(more)
                warnings += problems
    used = dict.fromkeys(name for name in names if name)
    missing = [name for name in used if name not in materials]
    if missing and libraries and not unread:
        warnings.append(f"material {', '.join(missing)} is in no material file; it is left out")
    elif missing and not libraries:
        warnings.append(f"the file names material {', '.join(missing)} but no material file; it is left out")
    if not libraries and has_uvs:
        texture, problems = texture_beside(path)
        warnings += problems
        if texture is not None:
            materials = {name: ObjMaterial(name, np.ones(4), texture) for name in ("", *used)}
    return materials, warnings


def texture_beside(path: Path) -> tuple[Texture | None, list[str]]:
    """Return the image that stands beside ``path`` under its name, and why it cannot be used if so."""
    for ending in ("_texture.png", ".png", "_texture.jpg", ".jpg"):
        image = path.with_name(path.stem + ending)
        if image.is_file():
            try:
                return read_texture(image), []
            except ImageError as problem:
                return None, [f"texture {image.name} {problem}; it is left out"]
    return None, []
