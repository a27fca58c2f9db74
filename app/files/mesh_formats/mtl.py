"""MTL: the materials that an OBJ file names."""

import os
from collections.abc import Sequence, Set
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from app.files.file_access import (
    NamedFileError,
    NamedFiles,
    OutsideError,
    OutsideWarning,
    left_out,
    read_input,
)
from app.files.mesh_formats.images import TextureReader, linear_from_srgb
from core.records.arrays import Floats
from core.scene import Material, Texture
from lessons.os_errors import os_error_reason

DIFFUSE = 0.8
"""Grey of a material that gives no Kd."""
SIZE_LIMIT = 2**25
"""Most bytes of an MTL file."""
NAMES_SHOWN = 10
"""Names of missing materials that a warning gives."""


@dataclass(frozen=True, eq=False)
class ObjMaterial:
    """What the triangles between two ``usemtl`` lines look like."""

    name: str = ""
    color: Floats = field(default_factory=lambda: np.append(linear_from_srgb([DIFFUSE] * 3), 1.0))
    """(4,) float64 linear: Kd, and d as alpha. White where there is a texture."""
    texture: Texture | None = None
    material: Material = field(default_factory=Material)


@dataclass(frozen=True, eq=False)
class MaterialText:
    """A material as its MTL file gives it: the texture is not read yet."""

    look: ObjMaterial
    texture: str = ""
    """Name of the image file; empty: none."""
    folder: Path | None = None
    """Folder of the MTL file."""

    def made(self, textures: TextureReader, warnings: list[str]) -> ObjMaterial:
        """Return the material with its texture; why that cannot be had is added to ``warnings``."""
        if not self.texture:
            return self.look
        try:
            texture = textures.read(self.texture, self.folder)
        except NamedFileError as problem:
            warnings.append(left_out(f"texture {self.texture} of material {self.look.name}", problem))
            return self.look
        # The core multiplies the two, and many files give Kd 0 0 0 beside a texture.
        return replace(self.look, texture=texture, color=np.append(np.ones(3), self.look.color[3]))


def read_mtl(path: Path, used: Set[str]) -> tuple[dict[str, MaterialText], list[str]]:
    """Read the ``used`` materials of an MTL file.

    Kd, Ks, Ns, d, Tr and map_Kd are read; colours count as sRGB. Ns and Ks become the exponent and, as the
    mean of its channels, the strength of the highlight.

    Returns
    -------
    materials : dict
        By name.
    warnings : list of str
        Lines of these that cannot be read.

    Raises
    ------
    OSError
        If ``path`` cannot be read.
    """
    materials: dict[str, MaterialText] = {}
    warnings: list[str] = []
    current: MaterialText | None = None
    content = read_input(path, SIZE_LIMIT).decode("utf-8-sig", errors="replace")
    for number, line in enumerate(content.splitlines(), 1):
        keyword, _, rest = line.strip().partition(" ")
        if keyword == "newmtl":
            name = rest.strip()
            current = MaterialText(ObjMaterial(name), folder=path.parent) if name in used else None
        elif current is not None and keyword.lower() == "map_kd":
            current = replace(current, texture=texture_name(rest.strip()))
        elif current is not None:
            try:
                current = replace(current, look=with_property(current.look, keyword.lower(), rest.strip()))
            except ValueError:
                warnings.append(f"line {number} of {path.name} cannot be read: {line.strip()[:80]}")
        if current is not None:
            materials[current.look.name] = current
    return materials, warnings


def with_property(material: ObjMaterial, keyword: str, rest: str) -> ObjMaterial:
    """Return ``material`` with one line of its MTL file put in; unknown keywords change nothing."""
    if keyword not in ("kd", "ks", "ns", "d", "tr"):
        return material
    values = [float(value) for value in rest.split() if value != "-halo"]
    if not values or not np.isfinite(values).all():
        raise ValueError(f"{keyword} must be finite numbers, got {rest}")
    if keyword == "kd":
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
    textures: TextureReader, libraries: Sequence[str], names: Sequence[str], has_uvs: bool
) -> tuple[dict[str, ObjMaterial], list[str]]:
    """Read the materials that an OBJ file uses; what cannot be had gives a warning each.

    Parameters
    ----------
    textures : TextureReader
        Of the OBJ file.
    libraries : sequence of str
        What its ``mtllib`` lines say.
    names : sequence of str
        What its ``usemtl`` lines say.
    has_uvs : bool
        Whether it has texture coordinates: then an image beside it is its texture if it names no library.
    """
    used = dict.fromkeys(name for name in names if name)
    texts, warnings, unread = read_libraries(textures.files, libraries, set(used))
    materials = {name: texts[name].made(textures, warnings) for name in used if name in texts}
    missing = [name for name in used if name not in materials]
    if missing and libraries and not unread:
        warnings.append(f"material {named(missing)} is in no material file; it is left out")
    elif missing and not libraries:
        warnings.append(f"the file names material {named(missing)} but no material file; it is left out")
    if not libraries and has_uvs:
        texture, problems = texture_beside(textures)
        warnings += problems
        if texture is not None:
            materials = {name: ObjMaterial(name, np.ones(4), texture) for name in ("", *used)}
    return materials, warnings


def read_libraries(
    files: NamedFiles, libraries: Sequence[str], used: Set[str]
) -> tuple[dict[str, MaterialText], list[str], int]:
    """Return the ``used`` materials of all MTL files by name, warnings, and how many files could not be read."""
    materials: dict[str, MaterialText] = {}
    warnings: list[str] = []
    unread = 0
    done: set[Path] = set()
    for name in dict.fromkeys(name for line in libraries for name in library_names(files, line)):
        try:
            path = files.find(name)
            if path in done:
                continue
            done.add(path)
            more, problems = read_mtl(path, used)
        except (OSError, NamedFileError) as problem:
            unread += 1
            reason: object = problem
            if isinstance(problem, OSError):
                reason = f"cannot be read: {os_error_reason(problem)}"
            text = f"material file {name} {reason}; its materials are left out"
            warnings.append(OutsideWarning(text) if isinstance(problem, OutsideError) else text)
        else:
            materials.update(more)
            warnings += problems
    return materials, warnings, unread


def library_names(files: NamedFiles, line: str) -> list[str]:
    """Return the names that a ``mtllib`` line gives: several files, or one whose name has spaces."""
    try:
        files.find(line)
    except NamedFileError:
        return line.split() or ["(no name)"]
    return [line]


def named(names: Sequence[str]) -> str:
    """Return a few of many names as a text."""
    more = [f"and {len(names) - NAMES_SHOWN} more"] if len(names) > NAMES_SHOWN else []
    return ", ".join([*names[:NAMES_SHOWN], *more])


def texture_beside(textures: TextureReader) -> tuple[Texture | None, list[str]]:
    """Return the image that stands beside an OBJ file under its name, and why it cannot be used if so."""
    path = textures.files.path
    for ending in ("_texture.png", ".png", "_texture.jpg", ".jpg"):
        name = path.stem + ending
        if os.path.isfile(path.with_name(name)):
            try:
                return textures.read(name), []
            except NamedFileError as problem:
                return None, [left_out(f"texture {name}", problem)]
    return None, []
