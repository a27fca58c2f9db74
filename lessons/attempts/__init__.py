"""What learners have answered: kept at once, exchanged as files, and the ground of practice and progress."""
