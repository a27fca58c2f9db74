"""Tables that fill as a stage is stepped."""
