"""The digest of the C sources, which the build compiles into the library and `load` compares."""

import hashlib
from pathlib import Path

__all__ = ["digest_of"]


def digest_of(folder: Path) -> str:
    """Digest the C files and headers of a folder by SHA-256, with their names; 64 hexadecimal digits."""
    digest = hashlib.sha256()
    for path in sorted(path for path in folder.iterdir() if path.suffix in {".c", ".h"}):
        text = path.read_bytes()
        digest.update(f"{path.name} {len(text)}\n".encode() + text)
    return digest.hexdigest()
