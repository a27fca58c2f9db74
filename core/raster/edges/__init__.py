"""Edges: snapped corners, edge functions, and which triangle owns a centre on an edge."""
