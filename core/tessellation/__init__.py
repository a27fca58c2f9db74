"""Curves into line strips and patches into triangles, before any matrix."""
