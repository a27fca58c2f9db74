"""Scenes in clip space put together: primitives from shared vertices, and tables of depths."""
