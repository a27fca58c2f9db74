"""Light at every visible pixel in float32, as long as a bound keeps the bytes right."""
