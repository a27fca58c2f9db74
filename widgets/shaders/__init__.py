"""The pane in which shaders are typed."""
