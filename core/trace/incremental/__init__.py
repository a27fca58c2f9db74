"""Tracing again after an edit: what did not change is found, and taken over."""
