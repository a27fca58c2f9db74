"""What is aimed at: how many times as long another library should take as the core, and what a prototype reached.

The prototypes were measured on two cores, against llvmpipe on two threads; everything else ran on one.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Goal:
    """Peer time divided by our time."""

    wanted: float | None
    """``None``: no more than the prototype's figure is aimed at."""
    prototype: tuple[float, ...]
    """What was measured, one figure or a range."""

    def verdict(self, ratio: float) -> str:
        """Return how far ``ratio`` comes: ``goal``, ``prototype`` or ``below``."""
        if self.wanted is not None and ratio >= self.wanted:
            return "goal"
        return "prototype" if ratio >= self.prototype[0] else "below"


GOALS = {
    ("A1", "OpenCV"): Goal(0.4, (0.26,)),
    ("A1", "Pillow"): Goal(0.9, (0.59,)),
    ("A1", "scikit-image"): Goal(650, (430,)),
    ("A2", "numba"): Goal(1.6, (1.0,)),
    ("B", "OpenGL"): Goal(1.5, (1.0,)),
    ("B", "numba"): Goal(3, (1.1, 2.1)),
    ("B", "OpenCV"): Goal(None, (1.3,)),
    ("B", "Pillow"): Goal(None, (1.3,)),
    ("B", "scikit-image"): Goal(None, (36,)),
    ("B", "matplotlib"): Goal(None, (3.7,)),
    ("C", "OpenGL"): Goal(2, (1.1, 1.4)),
    ("C", "numba"): Goal(3, (1.3, 1.9)),
    ("C", "OpenCV"): Goal(6, (3.8,)),
    ("C", "Pillow"): Goal(6, (4.0,)),
    ("C", "scikit-image"): Goal(None, (51,)),
    ("C", "matplotlib"): Goal(None, (8,)),
    ("D", "OpenGL"): Goal(1.3, (0.91,)),
    ("D", "VTK"): Goal(2.2, (1.45,)),
    ("D", "numba"): Goal(None, (1.4,)),
    ("D", "matplotlib"): Goal(40, (25,)),
    ("E", "OpenGL"): Goal(0.6, (0.39,)),
    ("E", "VTK"): Goal(0.7, (0.43,)),
    ("E", "OpenCV"): Goal(None, (0.09,)),
    ("E", "Pillow"): Goal(2.8, (1.8,)),
    ("E", "scikit-image"): Goal(5.5, (3.5,)),
    ("J", "OpenGL"): Goal(1.0, (0.5,)),
    ("K1", "trimesh"): Goal(0.83, (0.32,)),
    ("K2", "trimesh"): Goal(0.83, (0.22,)),
    ("K3", "trimesh"): Goal(0.33, (0.11,)),
    ("F", "OpenCV"): Goal(0.65, (0.41,)),
    ("F", "Pillow"): Goal(1, (0.62,)),
    ("F", "scikit-image"): Goal(7, (4.6,)),
}
"""Goals by workload and library."""

SHARED_GOALS = {("D", "OpenGL"): Goal(2, (1.1, 1.2))}
"""Goals of the core on two processes."""


def goal_of(workload: str, library: str, detail: str, is_shared: bool = False) -> Goal | None:
    """Return the goal against a library, of one or of two processes; there is none against a graphics card."""
    if library == "OpenGL" and "llvmpipe" not in detail:
        return None
    return (SHARED_GOALS if is_shared else GOALS).get((workload, library))
