"""The scene: chosen from cards, and edited as values, tables of depths and shaders."""
