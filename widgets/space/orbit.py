"""Looking at a space from outside: an orbit around a point, and how far away is what is seen from there.

Needs no Qt: state files hold an orbit.

The space is right-handed with y up. The same record serves a perspective picture and a parallel drawing.
"""

from dataclasses import dataclass, field, replace
from math import cos, isfinite, pi, sin, tan

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import cached_property

# Looking at a space from outside: an orbit around a point, as a frozen value, and how a pointer changes it.


TURN_PER_PIXEL = 0.0085
"""Radians that one pixel of a drag turns."""
STEEPEST = 0.499 * pi
EXTENT_LIMITS = (1e-12, 1e15)
FINEST = 1e-7
"""Smallest extent as a part of the target's distance from the origin: beyond it float64 runs out of digits."""


@dataclass(frozen=True)
class Orbit:
    """From which direction, and how much of the space is seen."""

    azimuth: float = 0.6
    """Radians around the y axis; 0 looks along -z, growing to the right."""
    elevation: float = 0.4
    """Radians above the xz plane."""
    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The point in the middle of the view."""
    extent: float = 1.0
    """Half the height of what is seen, at the target."""

    def axes(self) -> NDArray[np.float64]:
        """Return (3, 3): unit vectors to the right, up and towards the viewer, one a row."""
        across, along = sin(self.azimuth), cos(self.azimuth)
        flat, steep = cos(self.elevation), sin(self.elevation)
        backward = np.array([across * flat, steep, along * flat])
        right = np.array([along, 0.0, -across])
        return np.array([right, np.cross(backward, right), backward])

    def eye(self, field_of_view: float) -> NDArray[np.float64]:
        """Return (3,) where a perspective camera of this vertical opening angle (radians) stands."""
        distance = self.extent / tan(field_of_view / 2)
        eye: NDArray[np.float64] = np.array(self.target) + distance * self.axes()[2]
        return eye


def turned(orbit: Orbit, right: float, down: float) -> Orbit:
    """Return the orbit after the space was turned by a drag of so many logical pixels."""
    elevation = orbit.elevation + down * TURN_PER_PIXEL
    return replace(
        orbit,
        azimuth=(orbit.azimuth - right * TURN_PER_PIXEL) % (2 * pi),
        elevation=min(max(elevation, -STEEPEST), STEEPEST),
    )


def panned(orbit: Orbit, right: float, down: float, height: float) -> Orbit:
    """Return the orbit after the space was moved by a drag, in a view of ``height`` logical pixels."""
    unit = 2 * orbit.extent / max(height, 1.0)
    axes = orbit.axes()
    return _with_target(orbit, np.array(orbit.target) + (-right * axes[0] + down * axes[1]) * unit)


def zoomed(orbit: Orbit, factor: float, right: float, down: float, height: float) -> Orbit:
    """Return the orbit magnified by ``factor``; what is so far from the middle keeps its place."""
    extent = min(max(orbit.extent / factor, _finest(orbit)), EXTENT_LIMITS[1])
    unit = 2 * (orbit.extent - extent) / max(height, 1.0)
    axes = orbit.axes()
    moved = _with_target(orbit, np.array(orbit.target) + (right * axes[0] - down * axes[1]) * unit)
    return replace(moved, extent=extent)


def refocused(orbit: Orbit, distance: float, field_of_view: float) -> Orbit:
    """Return the orbit from the same eye, its target so far away; what is seen stays the same.

    A distance that is not positive, or too small or large to look from, changes nothing.
    """
    extent = distance * tan(field_of_view / 2)
    if not _finest(orbit) < extent < EXTENT_LIMITS[1]:
        return orbit
    moved = _with_target(orbit, orbit.eye(field_of_view) - distance * orbit.axes()[2])
    return replace(moved, extent=extent)


def fitted(orbit: Orbit, center: tuple[float, float, float], radius: float, aspect: float = 1.0) -> Orbit:
    """Return the orbit from the same direction that shows a sphere; ``aspect`` is width over height."""
    known = radius if isfinite(radius) and radius > 0 else 1.0
    extent = known * 1.06 / min(max(aspect, 0.1), 1.0)
    return _with_target(replace(orbit, extent=min(extent, EXTENT_LIMITS[1])), np.array(center))


def framed(orbit: Orbit, points: NDArray[np.float64], aspect: float = 1.0, margin: float = 1.14) -> Orbit:
    """Return the orbit from the same direction in which points (N, 3) just fill a parallel view.

    ``margin`` is room for words at the border; points that are not finite are left out.
    """
    finite = points[np.isfinite(points).all(axis=1)]
    if not len(finite):
        return orbit
    axes = orbit.axes()
    seen = finite @ axes.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    half = (high - low) / 2 * margin
    extent = max(float(half[1]), float(half[0]) / max(aspect, 0.1), EXTENT_LIMITS[0])
    return _with_target(replace(orbit, extent=extent), ((low + high) / 2) @ axes)


def _finest(orbit: Orbit) -> float:
    """Return the smallest extent that there may be near a target."""
    return max(EXTENT_LIMITS[0], FINEST * max(abs(value) for value in orbit.target))


def _with_target(orbit: Orbit, target: NDArray[np.float64]) -> Orbit:
    if not np.isfinite(target).all():
        return orbit
    x, y, z = target.tolist()
    return replace(orbit, target=(x, y, z))


# How far away what is seen in a picture of a space is, so that the wheel can go there.


@dataclass(frozen=True, eq=False)
class ViewDepth:
    """Distances at some places of a picture that was drawn in perspective."""

    orbit: Orbit
    """From which the picture was drawn."""
    field_of_view: float
    """Vertical, in radians."""
    distance: NDArray[np.float64] = field(repr=False)
    """(R, C) along the direction of view, row 0 at the bottom, evenly over the picture; NaN where nothing is seen."""

    def __post_init__(self) -> None:
        if self.distance.ndim != 2 or 0 in self.distance.shape:
            raise ValueError(f"distance must be (R, C) with at least one place, got {self.distance.shape}")

    @cached_property
    def covered(self) -> list[tuple[float, float, float, float]]:
        """The places where something is seen, row by row: left, bottom, right and top, fractions."""
        rows, columns = self.distance.shape
        is_seen = ~np.isnan(self.distance)
        seen = np.flatnonzero(is_seen.any(axis=1))
        first = is_seen[seen].argmax(axis=1) / columns
        last = 1 - is_seen[seen, ::-1].argmax(axis=1) / columns
        return [
            (left, row / rows, right, (row + 1) / rows)
            for row, left, right in zip(seen.tolist(), first.tolist(), last.tolist(), strict=True)
        ]

    def focused(self, orbit: Orbit, x: float, y: float) -> Orbit:
        """Return ``orbit`` with its target as far away as what is seen at a place, and the same picture.

        Parameters
        ----------
        orbit : Orbit
            The present one: the picture may be older, and is of no use if the space has been turned since.
        x, y : float
            Fractions of the picture's width and height, y up.

        Notes
        -----
        Magnifying goes towards the target and never beyond it. If the target hangs in front of what is seen, the
        wheel does less and less and never gets there.
        """
        is_turned = (orbit.azimuth, orbit.elevation) != (self.orbit.azimuth, self.orbit.elevation)
        if is_turned or not (0 <= x < 1 and 0 <= y < 1):
            return orbit
        rows, columns = self.distance.shape
        forward = -orbit.axes()[2]
        gone = forward @ (orbit.eye(self.field_of_view) - self.orbit.eye(self.field_of_view))
        return refocused(
            orbit, float(self.distance[int(y * rows), int(x * columns)] - gone), self.field_of_view
        )


def framed_from_eye(
    orbit: Orbit,
    points: NDArray[np.float64],
    field_of_view: float,
    aspect: float = 1.0,
    margin: float = 1.2,
) -> Orbit:
    """Return the orbit from the same direction in which points (N, 3) just fill a view in perspective.

    ``field_of_view`` is the vertical opening angle (radians), ``margin`` room for words at the border; points that are
    not finite are left out.
    """
    finite = points[np.isfinite(points).all(axis=1)]
    if not len(finite):
        return orbit
    axes, slope = orbit.axes(), tan(field_of_view / 2)
    right, up, depth = (finite @ axes.T).T
    middles, backs = [], []
    for along, opening in ((right, slope * max(aspect, 0.1) / margin), (up, slope / margin)):
        # Each point is seen if it is no farther aside than the opening lets it be at its depth.
        high, low = float((along + opening * depth).max()), float((opening * depth - along).max())
        middles.append((high - low) / 2)
        backs.append((high + low) / (2 * opening))
    target = np.array([*middles, float(depth.min() + depth.max()) / 2])
    extent = min(max((max(backs) - float(target[2])) * slope, EXTENT_LIMITS[0]), EXTENT_LIMITS[1])
    return _with_target(replace(orbit, extent=extent), target @ axes)
