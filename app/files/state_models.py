"""The content of a state file: a strict model, one class for each object of the JSON."""

import math
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

VERSION: Literal[1] = 1
"""Of the format; files of others are refused. A field that is added with a default needs no new version."""


class Record(BaseModel):
    """What all objects share: no unknown field, no conversion of types, no NaN."""

    model_config = ConfigDict(strict=True, frozen=True, extra="forbid", allow_inf_nan=False)


Numbers3 = tuple[float, float, float]
Numbers4 = tuple[float, float, float, float]
Count = Annotated[int, Field(ge=0)]
Size = tuple[Annotated[int, Field(ge=1)], Annotated[int, Field(ge=1)]]


class ArrayRecord(Record):
    """An array: as rows of numbers that can be read or, if there are many, as bytes; see ``app.files.state_arrays``."""

    dtype: Literal["float64", "float32", "int64"]
    shape: list[Count]
    rows: list[list[int | float]] | None = None
    """Numbers in row-major order, one list for each run along the last axis."""
    zlib: str | None = None
    """Little-endian bytes in row-major order, compressed by zlib, in base 64."""
    file: Annotated[str, Field(pattern=r"^[0-9a-f]{32}$")] | None = None
    """Name of the file that has these bytes: their fingerprint. It stands in the folder of the state's arrays."""

    @model_validator(mode="after")
    def _has_one_content(self) -> "ArrayRecord":
        if sum(content is not None for content in (self.rows, self.zlib, self.file)) != 1:
            raise ValueError("an array must have either rows, zlib or file")
        if self.rows is not None:
            count = sum(map(len, self.rows))
            if count != math.prod(self.shape):
                raise ValueError(f"shape {self.shape} wants {math.prod(self.shape)} numbers, got {count}")
        return self


class MaterialRecord(Record):
    """A ``core.scene.Material``."""

    ambient: float
    diffuse: float
    specular: float
    shininess: float


class MeshRecord(Record):
    """A mesh: arrays of its own, and those that it takes from the same mesh of the source."""

    name: str
    transform: tuple[Numbers4, Numbers4, Numbers4, Numbers4]
    material: MaterialRecord
    source_mesh: Count | None = None
    """Number of the mesh in the source; ``None``: nothing is taken from there."""
    from_source: dict[str, str] = {}
    """Name to fingerprint of the arrays that are taken from there."""
    arrays: dict[str, ArrayRecord] = {}
    """The others by name."""
    texture_name: str = "texture"


class CameraRecord(Record):
    """A ``core.scene.Camera``."""

    eye: Numbers3
    target: Numbers3
    up: Numbers3
    projection: Literal["perspective", "orthographic"]
    field_of_view: float
    """Radians."""
    view_height: float
    near: float
    far: float


class LightRecord(Record):
    """A directional light (``direction``) or a point light (``position``)."""

    kind: Literal["directional", "point"]
    vector: Numbers3
    """Direction or position, world space."""
    color: Numbers3


class SourceRecord(Record):
    """Where meshes are taken from."""

    built_in: str | None = None
    """Name of a built-in scene."""
    file: str | None = None
    """Path of a mesh file, relative to the folder of the state file unless it is on another drive."""
    allows_outside: bool = False
    """Whether the user has allowed that the mesh file reads files outside its folder."""
    mark: str = ""
    """Of a state that names files outside its folder: that this program has written it on this machine."""

    @model_validator(mode="after")
    def _is_one(self) -> "SourceRecord":
        if (self.built_in is None) == (self.file is None):
            raise ValueError("a source is either built_in or file")
        return self


class MeshSceneRecord(Record):
    """A ``core.scene.Scene``."""

    kind: Literal["meshes"]
    source: SourceRecord | None
    meshes: Annotated[list[MeshRecord], Field(min_length=1)]
    camera: CameraRecord
    lights: list[LightRecord]
    size: Size
    background: Numbers4


class ClipSceneRecord(Record):
    """A ``core.scene.ClipScene``; it is always kept as a whole."""

    kind: Literal["clip"]
    clip: ArrayRecord
    attributes: ArrayRecord
    shared: ArrayRecord | None
    texture: ArrayRecord | None
    texture_name: str = "texture"
    size: Size
    background: Numbers4


class RasterRecord(Record):
    """An ``app.session.document.TeachingRaster``."""

    columns: int
    rows: int
    origin: tuple[Count, Count] | None


class BookmarkRecord(Record):
    """A remembered step."""

    stage: str
    position: Count


class StateRecord(Record):
    """A whole state file."""

    program: Literal["rasterscope"]
    version: Literal[1]
    title: str
    scene: Annotated[MeshSceneRecord | ClipSceneRecord, Field(discriminator="kind")]
    settings: dict[str, str | int]
    """Family to method; a family that is left out has its default."""
    raster: RasterRecord
    triangle: Count | None
    before: str
    """``earlier`` or ``cleared``."""
    stage: str
    position: Count
    level: Annotated[int, Field(ge=0, le=4)]
    pin: tuple[Count, Count] | None
    bookmarks: list[BookmarkRecord]
    view: str
