"""What files of USD and of glTF draw: objects as triangles with surfaces."""
