"""Digest of the C sources, compiled into the shared library and compared by `load`."""

import hashlib
from pathlib import Path


def digest_of(folder: Path) -> str:
    """Compute the SHA-256 digest of a folder's C files and headers, including their names; 64 hexadecimal digits."""
    digest = hashlib.sha256()
    for path in sorted(path for path in folder.iterdir() if path.suffix in {".c", ".h"}):
        text = path.read_bytes()
        digest.update(f"{path.name} {len(text)}\n".encode() + text)
    return digest.hexdigest()
