"""Which method is chosen: the cheapest whose bound is within the tolerance, and which does not take longer."""
