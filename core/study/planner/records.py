"""What the planner is asked, saw, chose and measured, and what methods are called in its sentences."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import floor

import numpy as np

from core.records.arrays import Floats
from core.scene import AnyScene
from core.settings import Settings

# What methods and numbers are called in the sentences of a plan.


PHRASES = {
    "cull": {
        "none": "drawing both faces",
        "back": "leaving out back faces",
        "front": "leaving out front faces",
    },
    "clipping": {
        "homogeneous": "homogeneous rasterization without clipping",
        "sutherland-hodgman": "clipping to the view volume",
    },
    "interpolation": {
        "perspective": "perspective-correct interpolation",
        "affine": "affine interpolation",
        "affine-n": "affine interpolation corrected every few pixels",
        "flat": "one value without interpolation",
    },
    "texture_filter": {
        "nearest": "the nearest texel",
        "bilinear": "bilinear filtering",
        "trilinear": "trilinear filtering",
    },
    "shading": {
        "phong": "Phong shading",
        "gouraud": "Gouraud shading",
        "flat": "flat shading",
        "unlit": "leaving out the light",
    },
    "visibility": {
        "z-buffer": "the z-buffer",
        "last-drawn": "drawing without a depth test",
        "painters": "the painter's algorithm",
        "bsp": "the painter's algorithm with a BSP tree",
    },
    "depth": {
        "z-16": "depth in 16 bits",
        "z-24": "depth in 24 bits",
        "z-float32": "depth in float32",
        "reversed-z": "reversed depth in float32",
    },
    "blend": {"opaque": "drawing without blending", "over": "blending", "additive": "additive blending"},
    "antialiasing": {
        "none": "one sample a pixel",
        "msaa-4": "multisampling with 4 samples",
        "ssaa-4": "2 x 2 samples",
        "ssaa-16": "4 x 4 samples",
    },
}
"""What a method that a plan may choose is called within a sentence, by family and name."""


def phrase(family: str, method: str) -> str:
    """Return what a method is called within a sentence."""
    return PHRASES[family][method]


def in_bytes(error: float) -> str:
    """Return a difference of bytes as text: ``2/255``."""
    return f"{error:,g}/255"


def figure(value: float) -> str:
    """Return a number of three digits, with commas and no exponent: ``5,190``, ``0.82``; small ones as ``0.001``."""
    if 0 < value < SMALLEST:
        return f"{SMALLEST:g}"
    rounded = float(f"{value:.3g}")
    return f"{rounded:,.0f}" if rounded >= 1000 else f"{rounded:g}"


SMALLEST = 0.001
"""Smaller numbers display as this."""


# What the planner is asked, what it saw, what it chose, and what was measured.


Watch = Callable[[float, str], None]
"""Called with the part that is done and what is done next; whatever it raises ends planning or measuring."""


def unwatched(done: float, doing: str) -> None:
    """Let everything be done."""


@dataclass(frozen=True)
class Tolerance:
    """At most ``pixels`` pixels may differ from the reference picture by more than ``color``.

    The reference is the picture of `reference_settings`. Colours are compared as a screen shows them: sRGB bytes, the
    channel that differs most. Bytes are whole, so a ``color`` of 2.5 allows no more than 2.
    """

    color: float = 2.0
    """In 1/255, 0 to 255."""
    pixels: int = 0
    """How many pixels may differ by more."""

    def __post_init__(self) -> None:
        if not 0 <= self.color <= 255:
            raise ValueError(f"tolerance color must be from 0 to 255, got {self.color}")
        if type(self.pixels) is not int or self.pixels < 0:
            raise ValueError(f"tolerance pixels must be a whole number from 0 on, got {self.pixels!r}")

    @classmethod
    def exact(cls) -> "Tolerance":
        """Return the tolerance that no byte of no pixel may differ."""
        return cls(0.0, 0)

    @property
    def bytes(self) -> int:
        """The largest difference of bytes that is within ``color``."""
        return floor(self.color)


@dataclass(frozen=True)
class Fact:
    """One thing that was seen in the scene."""

    name: str
    """Key, as ``w-ratio``."""
    title: str
    """What a person reads: ``Largest ratio of w in a triangle``."""
    text: str
    """The value with its unit, as ``3.2``, ``12 of 40 triangles``, ``yes``."""


@dataclass(frozen=True, eq=False)
class Findings:
    """What was seen in a scene before anything was chosen."""

    facts: tuple[Fact, ...]
    """In pipeline order, to be read."""
    seconds: float
    """How long the looking took."""
    corner_count: int = 3
    """Of the scene's primitives: less than 3 of segments and points, see ``core.scene``."""


@dataclass(frozen=True)
class Decision:
    """What was chosen at one stage, and why."""

    setting: str
    """Family of the methods, as ``depth``."""
    chosen: str
    """Name of the method chosen."""
    dearest: str
    """Name of the method of the reference settings."""
    reason: str
    """One sentence with the numbers."""
    predicted_error: float
    """Error of this choice where it was tried, in 1/255 of an sRGB byte's range: every pixel but `predicted_pixels`."""
    predicted_pixels: int = 0
    """Pixels that may differ by more than that."""
    is_needed: bool = False
    """Whether the dearest method is kept although there are cheaper ones."""
    rests_on: tuple[str, ...] = ()
    """Settings whose choices came before: the prediction is of this choice on top of them."""


@dataclass(frozen=True, eq=False)
class Tessellation:
    """How far a mesh's facets lie from the smooth surface that its normals describe: advice, not applied."""

    mesh: str
    """Name of the mesh."""
    triangles: int
    deviation: float
    """Largest distance of a facet from the smooth surface, in pixels."""
    wanted: int
    """Triangles that would do for a deviation of a quarter of a pixel, about."""
    text: str
    """One sentence with the numbers."""


@dataclass(frozen=True, eq=False)
class Plan:
    """The cheapest methods whose errors stay within a tolerance where they were tried."""

    tolerance: Tolerance
    everything: Settings
    """Settings of the reference picture."""
    settings: Settings
    """Settings that were chosen."""
    decisions: tuple[Decision, ...]
    """In pipeline order."""
    findings: Findings
    tessellations: tuple[Tessellation, ...] = ()

    predicted_error: float = 0.0
    """Error of all choices together where they were tried, in 1/255: every pixel but `predicted_pixels`."""
    predicted_pixels: int = 0
    """Pixels that may differ by more."""
    predicted_everything: float | None = None
    """Seconds of a picture with the reference settings, from smaller ones; ``None``: nothing was timed."""
    predicted_seconds: float | None = None
    """Seconds of a picture with the chosen settings."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """One decision, predicted and measured: the reference settings with this choice and what it rests on."""

    decision: Decision
    measured_error: float
    """Largest difference of any pixel but the `Decision.predicted_pixels` that differ most, in 1/255."""
    measured_pixels: int
    """Pixels that differ by more than the prediction, rounded up to whole bytes."""
    is_right: bool
    """Whether the prediction held."""
    text: str
    """As ``predicted 0.8/255, measured 1.4/255: the prediction was wrong``."""
    seconds: Floats = field(default_factory=lambda: np.empty(0))
    """(R,) float64, drawings with the reference settings but for this choice; empty: not timed."""


@dataclass(frozen=True, eq=False)
class PlanReport:
    """A plan, measured."""

    scene: AnyScene
    plan: Plan
    outcomes: tuple[Outcome, ...]
    """One for each decision that chose something else than the dearest method."""
    largest_error: float
    """Largest difference of any pixel of the chosen settings from the reference, in 1/255."""
    pixels_beyond: int
    """Pixels that differ by more than the tolerance's colour."""
    is_within: bool
    """Whether the tolerance holds."""
    seconds_everything: Floats
    """(R,) float64, drawings of the reference settings."""
    seconds_chosen: Floats
    """(R,) float64, drawings with the chosen settings, taken in turn with the others."""
    text: str
    """One sentence: whether the tolerance holds, and how much time is saved."""
    fallen_back: tuple[str, ...] = field(default=())
    """Settings that were put back to the dearest method since the first plan was not within the tolerance."""
