"""What the start page shows: scenes with their pictures."""
