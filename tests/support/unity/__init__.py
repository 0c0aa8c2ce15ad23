"""The C# readers: compiled, asked, compared with ``pxr``, damaged and mutated."""
