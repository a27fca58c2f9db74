"""What a glTF file holds: its header, its JSON as classes, its buffers, and the arrays that accessors find."""

import binascii
import struct
from base64 import b64decode
from collections.abc import Sequence
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar
from urllib.parse import unquote

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, ValidationError
from pydantic.alias_generators import to_camel

from app.files.file_access import NamedFileError, OutsideError, read_input
from app.files.mesh_formats.images import ImageError, TextureReader
from app.files.mesh_formats.reading import MeshFileError, OutsideMeshError
from app.files.saved_records import field_problem
from core.records.arrays import Floats
from core.scene import Texture

# The JSON of glTF 2.0: one class for each of its objects that is read.


Index = Annotated[int, Field(ge=0, lt=2**40)]
"""Place in a list of the header, or a number of bytes or elements."""
Numbers3 = tuple[float, float, float]
Numbers4 = tuple[float, float, float, float]


class Part(BaseModel):
    """What all objects share: names in camel case, unknown fields are passed over, no NaN."""

    model_config = ConfigDict(frozen=True, extra="ignore", allow_inf_nan=False, alias_generator=to_camel)


class Asset(Part):
    """What the file says of itself."""

    version: str


class Buffer(Part):
    """Bytes: those of the binary part, of another file or of the text itself."""

    byte_length: Index
    uri: str | None = None


class BufferView(Part):
    """A part of a buffer."""

    buffer: Index
    byte_offset: Index = 0
    byte_length: Index
    byte_stride: Annotated[int, Field(gt=0, lt=2**16)] | None = None


class Accessor(Part):
    """Numbers in a part of a buffer."""

    buffer_view: Index | None = None
    byte_offset: Index = 0
    component_type: Literal[5120, 5121, 5122, 5123, 5125, 5126]
    count: Index
    type: Literal["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"]
    sparse: dict[str, object] | None = None


class Primitive(Part):
    """Triangles of one material."""

    attributes: dict[str, Index]
    indices: Index | None = None
    material: Index | None = None
    mode: int = 4


class MeshParts(Part):
    """A mesh: several primitives."""

    primitives: list[Primitive]


class Node(Part):
    """A place in the tree of a scene."""

    name: str | None = None
    mesh: Index | None = None
    children: list[Index] = []
    matrix: Annotated[list[float], Field(min_length=16, max_length=16)] | None = None
    """Column by column."""
    translation: Numbers3 | None = None
    rotation: Numbers4 | None = None
    """Quaternion x, y, z, w."""
    scale: Numbers3 | None = None


class SceneRoots(Part):
    """A scene by its outermost nodes."""

    nodes: list[Index] = []


class TextureInfo(Part):
    """Which texture a material uses."""

    index: Index


class BaseColor(Part):
    """Colour of a surface: of the metallic and roughness model."""

    base_color_factor: Numbers4 | None = None
    base_color_texture: TextureInfo | None = None


class Diffuse(Part):
    """Colour of a surface: of the older specular and glossiness model."""

    diffuse_factor: Numbers4 | None = None
    diffuse_texture: TextureInfo | None = None


class MaterialExtensions(Part):
    """Extensions of a material that are read."""

    older: Diffuse | None = Field(None, alias="KHR_materials_pbrSpecularGlossiness")


class MaterialPart(Part):
    """A material."""

    name: str = ""
    pbr_metallic_roughness: BaseColor | None = None
    extensions: MaterialExtensions = MaterialExtensions()

    def color(self) -> tuple[Numbers4 | None, int | None]:
        """Return the factor and the texture of its colour, each ``None`` where there is none."""
        base, older = self.pbr_metallic_roughness, self.extensions.older
        if base is not None:
            factor, texture = base.base_color_factor, base.base_color_texture
        elif older is not None:
            factor, texture = older.diffuse_factor, older.diffuse_texture
        else:
            return None, None
        return factor, None if texture is None else texture.index


class WebpSource(Part):
    """The image of a texture as WebP."""

    source: Index | None = None


class TextureExtensions(Part):
    """Extensions of a texture that are read."""

    webp: WebpSource = Field(WebpSource(), alias="EXT_texture_webp")


class TexturePart(Part):
    """A texture by its image."""

    source: Index | None = None
    extensions: TextureExtensions = TextureExtensions()


class ImagePart(Part):
    """The bytes of an image file: in a buffer, another file or the text itself."""

    uri: str | None = None
    buffer_view: Index | None = None


class GltfHeader(Part):
    """A whole file."""

    asset: Asset
    extensions_required: list[str] = []
    scene: Index = 0
    scenes: list[SceneRoots] = []
    nodes: list[Node] = []
    meshes: list[MeshParts] = []
    materials: list[MaterialPart] = []
    textures: list[TexturePart] = []
    images: list[ImagePart] = []
    accessors: list[Accessor] = []
    buffer_views: list[BufferView] = []
    buffers: list[Buffer] = []


# The bytes of a glTF file: its header, its buffers, and the arrays that accessors find in them.


WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
KINDS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
FILE_LIMIT = 2**32
"""Most bytes of a file, or of a buffer beside it."""

Item = TypeVar("Item")


class GltfFile:
    """An opened glTF file; what does not fit together raises MeshFileError.

    Every array is made once, however often it is used.
    """

    def __init__(self, path: Path, textures: TextureReader) -> None:
        self.path, self._textures = path, textures
        content = read_input(path, FILE_LIMIT)
        self._binary = memoryview(b"")
        if path.suffix.lower() == ".glb":
            content, self._binary = self._chunks(content)
        try:
            self.header = GltfHeader.model_validate_json(content)
        except ValidationError as problem:
            is_json = problem.errors(include_url=False)[0]["type"] != "json_invalid"
            reason = field_problem(problem) if is_json else "its header is not JSON"
            raise MeshFileError(f"{path.name} is not a valid glTF file: {reason}") from problem
        version = self.header.asset.version
        if version.partition(".")[0] != "2":
            raise MeshFileError(f"{path.name} is glTF {version[:20]}; only glTF 2 is read")
        self._buffer = cache(self._read_buffer)
        self.values = cache(self._read_values)
        self.floats = cache(self._read_floats)

    @property
    def byte_count(self) -> int:
        """Bytes of all buffers that are there."""
        return sum(len(self._buffer(k)) for k in range(len(self.header.buffers)))

    def fail(self, reason: str) -> MeshFileError:
        """Return the error that the file cannot be read."""
        return MeshFileError(f"{self.path.name} cannot be read as {self.path.suffix[1:].upper()}: {reason}")

    def item(self, items: Sequence[Item], index: int, what: str) -> Item:
        """Return one of the ``items`` of the header, which are called ``what``."""
        if index >= len(items):
            raise self.fail(f"it names {what} {index} and has {len(items)}")
        return items[index]

    def image(self, index: int) -> Texture:
        """Return the image of a texture of the header, or raise NamedFileError."""
        texture = self.item(self.header.textures, index, "texture")
        source = texture.source if texture.extensions.webp.source is None else texture.extensions.webp.source
        if source is None:
            raise ImageError("has no image of a kind that is read")
        image = self.item(self.header.images, source, "image")
        if image.uri is not None and not image.uri.startswith("data:"):
            return self._textures.read(unquote(image.uri))
        if image.uri is not None:
            content: bytes | memoryview = data_of(image.uri)
        elif image.buffer_view is not None:
            content = self._view(image.buffer_view)
        else:
            raise ImageError("has no bytes")
        return self._textures.decode(BytesIO(content), f"image {source}")

    def image_name(self, index: int) -> str:
        """Return what the image of a texture is called: its file, or its number where it has none."""
        sources = [texture.source for texture in self.header.textures[index : index + 1]]
        images = [self.header.images[k] for k in sources if k is not None and k < len(self.header.images)]
        names = [image.uri for image in images if image.uri and not image.uri.startswith("data:")]
        return unquote(names[0]) if names else str(index)

    def _chunks(self, content: bytes) -> tuple[bytes, memoryview]:
        """Return the JSON and the binary part of a GLB file."""
        name = self.path.name
        if content[:4] != b"glTF":
            raise MeshFileError(f"{name} is not a GLB file: it does not begin with glTF")
        wanted = int.from_bytes(content[8:12], "little")
        if len(content) < max(20, wanted):
            raise MeshFileError(f"{name} is cut short: it has {len(content)} of its {wanted} bytes")
        parts: dict[bytes, memoryview] = {}
        place = 12
        while place + 8 <= len(content):
            length, kind = struct.unpack_from("<I4s", content, place)
            if place + 8 + length > len(content):
                raise MeshFileError(f"{name} is cut short: it ends within a part of {length} bytes")
            parts.setdefault(kind, memoryview(content)[place + 8 : place + 8 + length])
            place += 8 + length
        if b"JSON" not in parts:
            raise MeshFileError(f"{name} is not a glTF file: it has no header")
        return bytes(parts[b"JSON"]), parts.get(b"BIN\0", memoryview(b""))

    def _read_buffer(self, index: int) -> memoryview:
        buffer = self.item(self.header.buffers, index, "buffer")
        if buffer.uri is None:
            content = self._binary
        elif buffer.uri.startswith("data:"):
            try:
                content = memoryview(data_of(buffer.uri))
            except ImageError as problem:
                raise self.fail(f"buffer {index} {problem}") from problem
        else:
            name = unquote(buffer.uri)
            try:
                content = memoryview(read_input(self._textures.files.find(name), FILE_LIMIT))
            except NamedFileError as problem:
                error = OutsideMeshError if isinstance(problem, OutsideError) else MeshFileError
                raise error(f"{self.path.name} cannot be read: its file {name} {problem}") from problem
        if len(content) < buffer.byte_length:
            raise self.fail(f"buffer {index} has {len(content)} of its {buffer.byte_length} bytes")
        return content

    def _view(self, index: int) -> memoryview:
        """Return the bytes of a view of a buffer."""
        view = self.item(self.header.buffer_views, index, "bufferView")
        content = self._buffer(view.buffer)[view.byte_offset : view.byte_offset + view.byte_length]
        if len(content) < view.byte_length:
            raise self.fail(f"bufferView {index} has {len(content)} of its {view.byte_length} bytes")
        return content

    def _read_values(self, index: int) -> NDArray[Any]:
        """Return the numbers (count, width) of an accessor as its file has them, without a copy of their bytes."""
        accessor = self.item(self.header.accessors, index, "accessor")
        if accessor.sparse is not None:
            raise MeshFileError(f"{self.path.name} has sparse accessors, which are not read")
        if accessor.buffer_view is None:
            raise self.fail(f"accessor {index} has no bytes")
        view = self.header.buffer_views[accessor.buffer_view : accessor.buffer_view + 1]
        content = self._view(accessor.buffer_view)
        kind, width = np.dtype(KINDS[accessor.component_type]), WIDTHS[accessor.type]
        row = kind.itemsize * width
        stride = view[0].byte_stride or row
        end = accessor.byte_offset + (accessor.count - 1) * stride + row
        if not accessor.count:
            return np.zeros((0, width), kind)
        if end > len(content):
            raise self.fail(f"accessor {index} wants {end} bytes of the {len(content)} of its bufferView")
        found = np.ndarray(
            (accessor.count, width), kind, content, accessor.byte_offset, (stride, kind.itemsize)
        )
        found.flags.writeable = False
        return found

    def _read_floats(self, index: int) -> Floats:
        """Return the numbers of an accessor, (count, width) float64, read-only."""
        found = self.values(index).astype(np.float64)
        found.flags.writeable = False
        return found


def data_of(uri: str) -> bytes:
    """Return the bytes that a ``data:`` address holds in base 64, or raise ImageError."""
    try:
        return b64decode(uri.partition("base64,")[2], validate=True)
    except (binascii.Error, ValueError) as problem:
        raise ImageError("has bytes that are not base 64") from problem
