"""Types of answers: how one is read, what it earns, and what a random one looks like."""
