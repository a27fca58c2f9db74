"""The JSON of glTF 2.0: one class for each of its objects that is read."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field
from pydantic.alias_generators import to_camel

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
