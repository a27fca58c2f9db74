"""Drawings in space and texture space: orbit, pick, drag."""
