"""The steps of the pipeline that join several rooms: from a scene to geometry, from fragments to depth and colour."""
