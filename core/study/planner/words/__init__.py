"""A plan in sentences: what was seen in the scene, and why each method was chosen."""
