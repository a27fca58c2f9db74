"""Light at every visible pixel in float32, from packed normals, as long as a bound keeps the bytes right."""
