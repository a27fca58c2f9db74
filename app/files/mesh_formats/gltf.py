"""glTF 2.0 and its binary form GLB: a graph of nodes with meshes, materials and textures."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from app.files.file_access import NamedFileError, NamedFiles, left_out
from app.files.mesh_formats.gltf_buffers import GltfFile, MeshParts, Node, Primitive
from app.files.mesh_formats.images import TextureReader
from app.files.mesh_formats.reading import DRAWING, LoadedMeshes, MeshFileError, Report, check_mesh_count
from app.session.memory import Need, check_free
from core.records.arrays import Floats, Integers
from core.scene import Mesh, Texture

TRIANGLES, STRIP = 4, 5
"""Modes of primitives that are read."""

UNREADABLE = ("KHR_draco_mesh_compression", "EXT_meshopt_compression")
"""Extensions without whose decoder there are no positions."""


def read_gltf(path: Path, report: Report, files: NamedFiles) -> LoadedMeshes:
    """Read a GLB or glTF file; every primitive of the mesh of every node is a mesh with the node's transform.

    Positions, normals, texture coordinates, vertex colours, base colours and their textures are read. Meshes of several
    nodes share their arrays. Raises MeshFileError if the file is cut short, is no glTF 2.0, needs an extension that is
    not read, or has no triangles; OSError if ``path`` cannot be read.
    """
    report(None, "reading nodes and meshes")
    file = GltfFile(path, TextureReader(files))
    warnings = check_header(file)
    nodes = list(placed_nodes(file))
    check_instances(file, [mesh for mesh, _, _ in nodes])
    parts_of = [drawn_parts(mesh) for mesh in file.header.meshes]
    placed = sorted(
        (
            (mesh, place, node)
            for node, (mesh, _, _) in enumerate(nodes)
            for place in range(len(parts_of[mesh]))
        )
    )
    check_mesh_count(path, len(placed), "parts in its nodes")
    maker = PrimitiveMaker(file, warnings)
    meshes: list[Mesh] = []
    for mesh, place, node in placed:
        report(len(meshes) / len(placed), "converting meshes")
        _, transform, name = nodes[node]
        title = name if len(parts_of[mesh]) == 1 else f"{name}_{place}"
        made = maker.made(parts_of[mesh][place], bool(np.linalg.det(transform[:3, :3]) < 0))
        meshes.append(replace(made, transform=transform, name=title))
    if not meshes:
        raise MeshFileError(f"{path.name} has no faces")
    return LoadedMeshes(tuple(meshes), tuple(warnings))


def drawn_parts(mesh: MeshParts) -> list[Primitive]:
    """Return the primitives of a mesh that are read."""
    return [part for part in mesh.primitives if part.mode in (TRIANGLES, STRIP)]


def check_header(file: GltfFile) -> list[str]:
    """Raise MeshFileError for what cannot be read at all; return warnings for parts that are left out."""
    needed = [name for name in file.header.extensions_required if name in UNREADABLE]
    if needed:
        raise MeshFileError(f"{file.path.name} is compressed with {needed[0]}, which is not read")
    modes = [part.mode for mesh in file.header.meshes for part in mesh.primitives]
    others = sum(mode not in (TRIANGLES, STRIP) for mode in modes)
    return [f"{others} of its parts are points, lines or triangle fans; they are left out"] if others else []


def check_instances(file: GltfFile, meshes: list[int]) -> None:
    """Raise MeshFileError where drawing all ``meshes`` of the nodes takes too much memory.

    What the file holds once may take what is free; what it only repeats takes no more than its bytes warrant.
    """
    accessors: list[int] = []
    for number in meshes:
        for part in drawn_parts(file.header.meshes[number]):
            named = (part.attributes.get("POSITION"), part.indices)
            accessors += [index for index in named if index is not None]
    counts = {index: file.item(file.header.accessors, index, "accessor").count for index in set(accessors)}
    total = sum(counts[index] for index in accessors)
    # A number of the file has a byte at least, whatever its accessors count.
    once = min(sum(counts.values()), file.byte_count)
    what = f"drawing the meshes of its {len(meshes)} nodes"
    Need().ask((total - once) * DRAWING, file.byte_count, what)
    check_free(total * DRAWING, what)


def placed_nodes(file: GltfFile) -> Iterator[tuple[int, Floats, str]]:
    """Yield mesh, transform (4, 4) float64 and name of every node of the scene that has a mesh."""
    header = file.header
    if header.scenes:
        roots = file.item(header.scenes, header.scene, "scene").nodes
    else:
        children = {child for node in header.nodes for child in node.children}
        roots = [k for k in range(len(header.nodes)) if k not in children]
    waiting = [(root, np.eye(4)) for root in roots]
    seen = set()
    while waiting:
        index, above = waiting.pop()
        if index in seen:
            continue
        seen.add(index)
        node = file.item(header.nodes, index, "node")
        transform = above @ local_transform(node)
        waiting += [(child, transform) for child in node.children]
        if node.mesh is not None:
            file.item(header.meshes, node.mesh, "mesh")
            yield node.mesh, transform, node.name or str(index)


def local_transform(node: Node) -> Floats:
    """Return the transform (4, 4) float64 of a node in its parent: its matrix, then T R S."""
    transform = np.eye(4) if node.matrix is None else np.array(node.matrix).reshape(4, 4).T
    if node.translation is not None:
        move = np.eye(4)
        move[:3, 3] = node.translation
        transform = transform @ move
    if node.rotation is not None:
        transform = transform @ rotation(np.array(node.rotation))
    if node.scale is not None:
        transform = transform @ np.diag([*node.scale, 1.0])
    return transform


def rotation(quaternion: Floats) -> Floats:
    """Return the matrix (4, 4) float64 of a quaternion x, y, z, w of any length; of length 0 the identity."""
    length = float(quaternion @ quaternion)
    if not np.isfinite(length) or length == 0:
        return np.eye(4)
    x, y, z, w = quaternion * np.sqrt(2 / length)
    return np.array(
        [
            [1 - y * y - z * z, x * y - z * w, x * z + y * w, 0],
            [x * y + z * w, 1 - x * x - z * z, y * z - x * w, 0],
            [x * z - y * w, y * z + x * w, 1 - x * x - y * y, 0],
            [0, 0, 0, 1],
        ]
    )


class PrimitiveMaker:
    """Makes the meshes of primitives, each once, and each again where a mirrored node turns its triangles over."""

    def __init__(self, file: GltfFile, warnings: list[str]) -> None:
        self._file, self._warnings = file, warnings
        self._made: dict[tuple[int, bool], Mesh] = {}
        self._textures: dict[int, Texture | None] = {}

    def made(self, part: Primitive, is_mirrored: bool) -> Mesh:
        """Return the mesh of a primitive without a place; mirrored, its triangles face outward still."""
        key = id(part), is_mirrored
        if key not in self._made:
            other = self._made.get((id(part), not is_mirrored))
            if other is None:
                mesh = self._make(part)
                self._made[id(part), False] = other = mesh
            if is_mirrored:
                self._made[key] = replace(other, triangles=other.triangles[:, ::-1])
        return self._made[key]

    def _make(self, part: Primitive) -> Mesh:
        file = self._file
        if "POSITION" not in part.attributes:
            raise file.fail("a part has no positions")
        positions = file.floats(part.attributes["POSITION"])
        count = len(positions)
        factor, texture, uvs = None, None, None
        if part.material is not None:
            material = file.item(file.header.materials, part.material, "material")
            factor, image = material.color()
            uvs = self._optional(part, "TEXCOORD_0", count, 2)
            if uvs is not None:
                # The file counts v from the top, in 32 bits.
                uvs = np.stack([uvs[:, 0], 1 - uvs[:, 1].astype(np.float32)], axis=1)
                texture = None if image is None else self._texture(image, material.name or f"{part.material}")
        return Mesh(
            positions=positions,
            triangles=self._triangles(part, count),
            normals=self._optional(part, "NORMAL", count, 3),
            uvs=uvs,
            colors=self._colors(part, count, factor),
            texture=texture,
        )

    def _triangles(self, part: Primitive, count: int) -> Integers:
        """Return the triangles (T, 3) int64 of a primitive of ``count`` vertices."""
        indices = np.arange(count) if part.indices is None else self._file.values(part.indices).reshape(-1)
        if indices.dtype.kind == "f":
            raise self._file.fail("its indices are not whole numbers")
        if part.mode == TRIANGLES:
            if len(indices) % 3:
                raise self._file.fail(f"{len(indices)} corners make no triangles")
            return indices.reshape(-1, 3).astype(np.int64)
        strip = np.stack([indices[k : len(indices) - 2 + k] for k in range(3)], axis=1).astype(np.int64)
        strip[1::2] = strip[1::2, ::-1]
        return strip

    def _optional(self, part: Primitive, name: str, count: int, width: int) -> Floats | None:
        """Return an attribute (count, width) float64, ``None`` where there is none of this shape."""
        index = part.attributes.get(name)
        found = None if index is None else self._file.floats(index)
        if found is None or found.shape != (count, width):
            return None
        kind = self._file.values(part.attributes[name]).dtype
        return found if kind.kind == "f" else found / np.iinfo(kind).max

    def _colors(self, part: Primitive, count: int, factor: tuple[float, ...] | None) -> Floats | None:
        """Return linear colours (count, 4) of the vertices: the factor of the material times their own, if any."""
        own = self._optional(part, "COLOR_0", count, 4)
        if own is None:
            own = self._optional(part, "COLOR_0", count, 3)
        if own is None and factor is None:
            return None
        colors = np.tile(in_bytes(np.ones(4) if factor is None else np.array(factor)), (count, 1))
        if own is not None:
            colors[:, : own.shape[1]] *= own if part.material is not None else in_bytes(own)
        return colors

    def _texture(self, index: int, material: str) -> Texture | None:
        """Return a texture of the header; why it cannot be had is a warning, once."""
        if index not in self._textures:
            try:
                self._textures[index] = self._file.image(index)
            except NamedFileError as problem:
                self._textures[index] = None
                name = self._file.image_name(index)
                self._warnings.append(left_out(f"texture {name} of material {material}", problem))
        return self._textures[index]


def in_bytes(values: Floats) -> Floats:
    """Return colours, any shape, in steps of 1/255: saved states know the colours of their file by these numbers."""
    return np.round(np.clip(values, 0, 1) * 255) / 255
