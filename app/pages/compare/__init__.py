"""The Compare page: speed against accuracy."""
