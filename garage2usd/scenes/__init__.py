"""Content of USD and glTF files: objects as triangles with surfaces."""
