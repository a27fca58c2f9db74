"""What there is in a scene: which triangle touches which pixel, how deep, what hides what, and what meshes are like."""
