"""The content of a state file: a strict model, one class for each object of the JSON."""

import math
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from app.session.document import VIEWS
from core import STAGES
from core.lanes.problem import LISTING, NAME_LENGTH, SHADER
from widgets.space.orbit import EXTENT_LIMITS

VERSION: Literal[3] = 3
"""Of the format. Files of earlier versions are migrated, files of later ones are refused."""


NOTE_LIMIT = 500
"""Longest note of a bookmark in characters."""
DRAFTS_LIMIT = 100
"""Most texts that are kept though they do not run: more than there are listings to edit."""
DRAFT_LIMIT = 10 * LISTING.characters
"""Longest text that is kept though it does not run, in characters."""


class Record(BaseModel):
    """What all objects share: no unknown field, no conversion of types, no NaN."""

    model_config = ConfigDict(strict=True, frozen=True, extra="forbid", allow_inf_nan=False, defer_build=True)


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
    mirror: float = 0.0


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
    casts_shadow: bool = True
    """Of a directional light, whether it may be the one that casts shadows."""


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


class ProgramRecord(Record):
    """A ``core.shaders.record.ShaderProgram``: its shaders as text."""

    vertex: Annotated[str, Field(max_length=20_000)]
    fragment: Annotated[str, Field(max_length=20_000)]
    uniforms: dict[str, list[float]] = {}
    """Name to numbers; of a matrix column by column."""
    dialect: Literal["shader-material", "raw-shader-material"] = "shader-material"
    title: str = ""


class MovingRecord(Record):
    """An object of a `MotionRecord`: the number of a mesh or triangle, and its way from picture to picture."""

    number: Count
    way: Numbers3


class MotionRecord(Record):
    """A ``core.records.motion.Motion``."""

    camera: Numbers3 = (0.0, 0.0, 0.0)
    objects: list[MovingRecord] = []


class MeshSceneRecord(Record):
    """A ``core.scene.Scene``."""

    kind: Literal["meshes"]
    source: SourceRecord | None
    meshes: Annotated[list[MeshRecord], Field(min_length=1)]
    camera: CameraRecord
    lights: list[LightRecord]
    size: Size
    background: Numbers4
    program: ProgramRecord | None = None
    motion: MotionRecord | None = None


class ClipSceneRecord(Record):
    """A ``core.scene.ClipScene``; it is always kept as a whole."""

    kind: Literal["clip"]
    primitives: Literal["triangles", "segments", "points", "polygons"] = "triangles"
    clip: ArrayRecord
    attributes: ArrayRecord
    shared: ArrayRecord | None
    clip_region: ArrayRecord | None = None
    rings: ArrayRecord | None = None
    region_rings: ArrayRecord | None = None
    curves: ArrayRecord | None = None
    """Control points of ``core.records.curves.Curves``; ``curve_colors`` are theirs."""
    curve_colors: ArrayRecord | None = None
    texture: ArrayRecord | None
    texture_name: str = "texture"
    size: Size
    background: Numbers4
    motion: MotionRecord | None = None


class TableSceneRecord(Record):
    """A ``core.scene.ClipScene`` of fragments: its ``core.records.depth_table.DepthTable``."""

    kind: Literal["table"]
    patches: list[str]
    """Cells as they are printed: a line for each row, the top row first."""
    colors: ArrayRecord
    test: Literal["less", "less-equal", "greater", "greater-equal"]


class RasterRecord(Record):
    """An ``app.session.document.TeachingRaster``."""

    columns: int
    rows: int
    origin: tuple[Count, Count] | None


def _one_of(*names: str) -> AfterValidator:
    """Return a check that a text is one of these names."""

    def check(name: str) -> str:
        if name not in names:
            raise ValueError(f"must be one of {', '.join(names)}, got {name}")
        return name

    return AfterValidator(check)


def _rises(ends: tuple[float, float]) -> tuple[float, float]:
    if ends[0] > ends[1]:
        raise ValueError(f"the first end must not be above the second, got {ends[0]:g} and {ends[1]:g}")
    return ends


Fraction = Annotated[float, Field(ge=0, le=1)]
Range = Annotated[tuple[float, float], AfterValidator(_rises)]
TextSize = Literal[0, 100, 110, 125, 150, 175, 200]
StageName = Annotated[str, _one_of(*STAGES)]
ViewName = Annotated[str, _one_of(*VIEWS)]


class Bookmark(Record):
    """A remembered step."""

    stage: StageName
    position: Count
    note: Annotated[str, Field(max_length=NOTE_LIMIT)] = ""
    """What the user wrote about it."""


class Breakpoints(Record):
    """Where running stops."""

    pixels: list[tuple[Count, Count]] = []
    """Columns and rows of the traced picture."""
    lines: list[tuple[str, Annotated[int, Field(ge=1)]]] = []
    """Name of a listing's function, and a line of it."""
    condition: str = ""
    """Text of ``core.trace.conditions``; empty: none."""


class GridLook(Record):
    """What the pixel grid shows, where it is not what it shows at first."""

    buffers: dict[StageName, str] = {}
    """Buffer of the main view by stage."""
    overlays: dict[StageName, list[str]] = {}
    """Overlays that are on, by stage."""
    ranges: dict[str, Range] = {}
    """Colour range by buffer."""
    fits_ranges: bool = False
    """Whether the colour range follows the values."""
    hidden_buffers: list[str] = []
    """Buffers that the strip leaves out."""
    middle: tuple[Fraction, Fraction] = (0.5, 0.5)
    """Middle of the visible part, as fractions of the raster's width and height from its lower left corner."""
    zoom: Annotated[float, Field(ge=0.01, le=1e6)] = 1.0
    """Magnification; at 1 the whole raster just fits."""


class OrbitRecord(Record):
    """A ``widgets.space.orbit.Orbit``."""

    azimuth: float
    elevation: float
    target: Numbers3
    extent: Annotated[float, Field(ge=EXTENT_LIMITS[0], le=EXTENT_LIMITS[1])]


class DraftRecord(Record):
    """A text that does not run, in place of the listing of a method."""

    part: str
    of: str
    text: Annotated[str, Field(max_length=DRAFT_LIMIT)]


class Look(Record):
    """How the Step page shows the run, where it is not how it is first shown."""

    view: ViewName = "pixels"
    """The main view."""
    views: dict[StageName, ViewName] = {}
    """Main view by stage, where the user has chosen one."""
    grid: GridLook = Field(default_factory=GridLook)
    orbits: dict[ViewName, OrbitRecord] = {}
    """From where views in space are seen, where the user has turned them."""
    other: dict[str, str | int] = {}
    """Family to method: what B does otherwise than A."""
    printed: str = ""
    """Name of the listing as printed that B runs; empty: none."""
    drafts: Annotated[list[DraftRecord], Field(max_length=DRAFTS_LIMIT)] = []
    """Edited listings that do not run: *Edit* opens them again."""
    other_buffer: str = "color"
    """Buffer in which A and B are compared."""
    panes: list[str] | None = None
    """Names of the panes that are not folded away; ``None``: those of the window that opens it."""
    text_size: TextSize = 100
    """Percent; 0: as large as the desktop's text. A window with larger text keeps its own."""
    shader_drafts: dict[
        Literal["vertex", "fragment"], Annotated[str, Field(max_length=SHADER.characters)]
    ] = {}
    """Texts of shaders that do not run, as they stand in the editors."""
    event: str = "covered"
    """Kind of event that N runs to."""
    lesson: tuple[str, int] | None = None
    """Name of the lesson that is open over it, and the number of its step; ``None``: none is."""


class EditRecord(Record):
    """A ``core.edits.edit.Edit``: a text in place of the listing of a method."""

    part: str
    of: str
    text: Annotated[str, Field(max_length=LISTING.characters)]
    name: Annotated[str, Field(max_length=NAME_LENGTH)] = ""


class StateRecord(Record):
    """A whole state file."""

    program: Literal["rasterscope"]
    version: Literal[3]
    title: str
    scene: Annotated[MeshSceneRecord | ClipSceneRecord | TableSceneRecord, Field(discriminator="kind")]
    settings: dict[str, str | int]
    """Family to method; a family that is left out has its default."""
    edits: list[EditRecord] = []
    """Listings that were edited, of methods that ``settings`` choose."""
    raster: RasterRecord
    triangle: Count | None
    before: str
    """``earlier`` or ``cleared``."""
    lanes: Annotated[str, _one_of("one", "together")] = "one"
    """Order of a shader's steps: one lane after another, or those of a triangle together."""
    stage: StageName
    position: Count
    level: Annotated[int, Field(ge=0, le=4)]
    pin: tuple[Count, Count] | None
    bookmarks: list[Bookmark]
    breakpoints: Breakpoints = Field(default_factory=Breakpoints)
    look: Look = Field(default_factory=Look)
    counted_by: Literal[2, 3] = 3
    """The version by whose steps ``position`` and the bookmarks count."""


def _from_version_1(record: dict[str, Any]) -> dict[str, Any]:
    """Return a record of version 1 as one of version 2: the main view was all that it kept of the look."""
    rest = {name: value for name, value in record.items() if name != "view"}
    return rest | {"look": {"view": record["view"]} if "view" in record else {}}


def _from_version_2(record: dict[str, Any]) -> dict[str, Any]:
    """Return a record of version 2 as one of version 3: lines of listings were counted with their docstring."""
    found = record | {"counted_by": 2}
    breakpoints = record.get("breakpoints")
    if isinstance(breakpoints, dict) and isinstance(breakpoints.get("lines"), list):
        lines = [_without_docstring(line) for line in breakpoints["lines"]]
        found["breakpoints"] = breakpoints | {"lines": lines}
    return found


def _without_docstring(line: Any) -> Any:
    """Return a line of a listing's code by its number without the docstring; what is no such line stays."""
    if not isinstance(line, list) or len(line) != 2 or type(line[1]) is not int:
        return line
    docstring = 4 if line[0] == "cyrus_beck_listing" else 1
    return [line[0], max(line[1] - docstring, 1)]


MIGRATIONS = (_from_version_1, _from_version_2)
"""What turns a record of each earlier version, from 1, into one of the next version."""
