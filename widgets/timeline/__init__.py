"""The timeline of steps and the rail of stages."""
