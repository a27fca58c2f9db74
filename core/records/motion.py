"""What moves between two pictures: the camera, and objects, each by the same way from picture to picture."""

from dataclasses import dataclass
from math import isfinite

Way = tuple[float, float, float]
"""x, y, z."""


@dataclass(frozen=True)
class Motion:
    """How far everything moves from one picture to the next; what is not named stays."""

    camera: Way = (0.0, 0.0, 0.0)
    """In world units; triangles given in clip space have no camera."""
    objects: tuple[tuple[int, Way], ...] = ()
    """Number of a mesh and its way in world units, or of a triangle given in clip space and its way in NDC; numbers
    that a scene does not have are left out."""

    @property
    def is_rest(self) -> bool:
        """Whether nothing moves."""
        return not any(map(any, (self.camera, *(way for _, way in self.objects))))

    def __post_init__(self) -> None:
        for name, way in (
            ("camera", self.camera),
            *((f"object {number}", way) for number, way in self.objects),
        ):
            if len(way) != 3 or not all(map(isfinite, way)):
                raise ValueError(f"motion of {name} must be 3 finite numbers, got {way}")
