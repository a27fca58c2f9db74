"""How fast the window answers: keys, scrubbing, hovering, dragging and turning, in a real window."""
