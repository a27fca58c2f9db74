"""Which triangle is seen: z-buffer, drawing order, painter's algorithm, ray casting."""
