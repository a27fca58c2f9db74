"""glTF 2.0 and its binary form GLB: a graph of nodes with meshes, materials and textures."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from app.files.mesh_formats.images import ImageError, texture_from_image
from app.files.mesh_formats.reading import LoadedMeshes, MeshFileError, Report, check_memory
from app.files.mesh_formats.through_trimesh import MissingFiles, load_with_trimesh, translated_errors
from core.records.arrays import Floats
from core.scene import Mesh, Texture

MEMORY_PER_VALUE = 64
"""Bytes of memory that one number of an accessor takes at most while it is opened (measured)."""

VALUES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}

TRIANGLES = (4, 5)
"""Modes of primitives that are read: triangles and triangle strips."""

UNREADABLE = ("KHR_draco_mesh_compression", "EXT_meshopt_compression")
"""Extensions without whose decoder there are no positions."""


def read_gltf(path: Path, report: Report) -> LoadedMeshes:
    """Read a GLB or glTF file; every mesh of every node is a mesh with the node's transform.

    Positions, normals, texture coordinates, vertex colours, base colours and their textures are read.

    Raises
    ------
    MeshFileError
        If the file is cut short, is no glTF 2.0, needs an extension that is not read, or has no triangles.
    OSError
        If ``path`` cannot be read.
    """
    header = read_header(path)
    warnings = check_header(path, header)
    report(None, "reading nodes and meshes")
    files = MissingFiles(path)
    textures: dict[int, Texture | None] = {}
    with translated_errors(path, files):
        scene = load_with_trimesh(path, files)
        report(None, "converting meshes")
        warnings += [f"{name} is missing; its content is left out" for name in dict.fromkeys(files.missing)]
        order = {name: place for place, name in enumerate(scene.geometry)}
        nodes = [(node, *scene.graph[node]) for node in scene.graph.nodes_geometry]
        meshes = [
            convert(path, scene.geometry[name], np.asarray(transform), str(node), textures, warnings)
            for node, transform, name in sorted(nodes, key=lambda found: order[found[2]])
            if len(getattr(scene.geometry[name], "faces", ()))
        ]
        warnings += missing_textures(header, scene, bool(files.missing))
    if not meshes:
        raise MeshFileError(f"{path.name} has no faces")
    return LoadedMeshes(tuple(meshes), tuple(warnings))


def read_header(path: Path) -> dict[str, Any]:
    """Return the JSON part of ``path``, or raise MeshFileError if it is not all there."""
    if path.suffix.lower() == ".gltf":
        content = path.read_bytes()
    else:
        size = path.stat().st_size
        with path.open("rb") as file:
            head = file.read(20)
            if head[:4] != b"glTF":
                raise MeshFileError(f"{path.name} is not a GLB file: it does not begin with glTF")
            wanted = int.from_bytes(head[8:12], "little")
            if len(head) < 20 or size < wanted:
                raise MeshFileError(f"{path.name} is cut short: it has {size} of its {wanted} bytes")
            content = file.read(min(int.from_bytes(head[12:16], "little"), size))
    try:
        header = json.loads(content)
        if not isinstance(header, dict) or not isinstance(header["asset"]["version"], str):
            raise ValueError("it names no version of glTF")
    except (ValueError, KeyError, TypeError, RecursionError) as problem:
        raise MeshFileError(f"{path.name} is not a glTF file: {problem}") from problem
    if header["asset"]["version"].partition(".")[0] != "2":
        raise MeshFileError(f"{path.name} is glTF {header['asset']['version']}; only glTF 2 is read")
    return header


def check_header(path: Path, header: dict[str, Any]) -> list[str]:
    """Raise MeshFileError for what cannot be read at all; return warnings for parts that are left out."""
    try:
        needed = [name for name in header.get("extensionsRequired", []) if name in UNREADABLE]
        accessors = header.get("accessors", [])
        values = sum(int(accessor["count"]) * VALUES[accessor["type"]] for accessor in accessors)
        is_sparse = any("sparse" in accessor for accessor in accessors)
        modes = [part.get("mode", 4) for mesh in header.get("meshes", []) for part in mesh["primitives"]]
        bytes_ = sum(int(buffer["byteLength"]) for buffer in header.get("buffers", []))
    except (KeyError, TypeError, ValueError, AttributeError) as problem:
        raise MeshFileError(f"{path.name} is not a valid glTF file: {problem!r} in its header") from problem
    if needed:
        raise MeshFileError(f"{path.name} is compressed with {needed[0]}, which is not read")
    if is_sparse:
        raise MeshFileError(f"{path.name} has sparse accessors, which are not read")
    check_memory(path, max(values * MEMORY_PER_VALUE, bytes_))
    others = sum(mode not in TRIANGLES for mode in modes)
    return [f"{others} of its parts are points, lines or triangle fans; they are left out"] if others else []


def convert(
    path: Path,
    part: Any,
    transform: Floats,
    name: str,
    textures: dict[int, Texture | None],
    warnings: list[str],
) -> Mesh:
    """Return one geometry of trimesh as a mesh; ``textures`` keeps what images became, by their id."""
    count = len(part.vertices)
    triangles = np.asarray(part.faces)
    if np.linalg.det(transform[:3, :3]) < 0:
        # A mirrored node turns its triangles over: the format wants them to face outward still.
        triangles = triangles[:, ::-1]
    visual = part.visual
    material, uvs = getattr(visual, "material", None), getattr(visual, "uv", None)
    factor = getattr(material, "baseColorFactor", None)
    colors = np.ones((count, 4)) if factor is None else np.tile(np.asarray(factor) / 255.0, (count, 1))
    own = own_colors(visual)
    if own is not None and len(own) == count:
        colors[:, : own.shape[1]] *= own
    image = getattr(material, "baseColorTexture", None)
    texture = None
    if image is not None and uvs is not None and len(uvs) == count:
        if id(image) not in textures:
            try:
                textures[id(image)] = texture_from_image(image, getattr(material, "name", None) or path.stem)
            except (ImageError, OSError, SyntaxError, ValueError) as problem:
                textures[id(image)] = None
                warnings.append(f"a texture of {name} cannot be read ({problem}); it is left out")
        texture = textures[id(image)]
    return Mesh(
        positions=np.asarray(part.vertices),
        triangles=triangles,
        normals=np.asarray(part.vertex_normals) if "vertex_normals" in part._cache else None,
        uvs=None if uvs is None or len(uvs) != count else np.asarray(uvs),
        colors=None if own is None and factor is None else colors,
        texture=texture,
        transform=transform,
        name=name,
    )


def own_colors(visual: Any) -> Floats | None:
    """Return (N, 3 or 4) linear vertex colours of a geometry, or None."""
    if visual.kind == "vertex":
        return np.asarray(visual.vertex_colors) / 255.0
    stored = getattr(visual, "vertex_attributes", {}).get("color")
    if stored is None:
        return None
    values = np.asarray(stored)
    return values / (np.iinfo(values.dtype).max if values.dtype.kind in "iu" else 1.0)


def missing_textures(header: dict[str, Any], scene: Any, is_told: bool) -> list[str]:
    """Say that images which the file holds could not be decoded."""
    named = [
        material
        for material in header.get("materials", [])
        if "baseColorTexture" in material.get("pbrMetallicRoughness", {})
    ]
    used = [getattr(part.visual, "material", None) for part in scene.geometry.values()]
    images = sum(getattr(material, "baseColorTexture", None) is not None for material in used)
    if named and not images and not is_told:
        return ["its textures cannot be decoded; they are left out"]
    return []
