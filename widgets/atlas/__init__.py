"""Stability maps and the case behind a cell."""
