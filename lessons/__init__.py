"""The course: text, scenes, exercises, checking and progress, without Qt."""
