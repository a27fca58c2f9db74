"""The templates that ship with the program, stage by stage."""
