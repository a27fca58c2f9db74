"""What the stages hand to each other: frozen records of read-only arrays, and the rows that a cursor steps over."""
