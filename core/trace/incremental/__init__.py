"""Tracing while a triangle is dragged: it alone, until the drag rests."""
