"""The Plan page: no more than a scene needs."""
