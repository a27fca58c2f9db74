"""The program measures itself: speed against accuracy, stability, and what a scene needs."""
