"""Fragments: attributes of a covered pixel become its colour (interpolation, texture look-up, lighting)."""
