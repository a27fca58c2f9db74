"""Speed against accuracy: every method of a family on the same work, against an exact reference."""
