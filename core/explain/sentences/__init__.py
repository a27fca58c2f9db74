"""The sentences of a step, one for every key."""
