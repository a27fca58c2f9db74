"""Light at points, and where it is evaluated."""
