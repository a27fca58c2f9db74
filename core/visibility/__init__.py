"""Which triangle is seen: z-buffer, drawing order, painter's algorithm, ray casting."""

from core.visibility import painters, ray_casting

__all__ = ["painters", "ray_casting"]
