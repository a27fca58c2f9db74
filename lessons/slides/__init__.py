"""The numbers on the lectures' slides, each with how it is computed again: `lessons.slides.catalogue` lists them."""
