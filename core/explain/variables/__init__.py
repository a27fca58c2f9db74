"""The variables of a step, in the order of the algorithm."""
