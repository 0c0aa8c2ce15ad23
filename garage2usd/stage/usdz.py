"""USDZ packages: ZIP archives of stored files, aligned to 64 bytes."""

import zipfile
from collections.abc import Iterable
from pathlib import Path

__all__ = ["write_usdz"]

_ALIGNMENT_BYTES = 64
_LOCAL_HEADER_BYTES = 30
_EXTRA_HEADER_BYTES = 4
_EXTRA_ID = 0x1986
_EPOCH = (1980, 1, 1, 0, 0, 0)


def write_usdz(path: Path, files: Iterable[tuple[str, bytes]]) -> None:
    """Write a package whose first file is the root layer.

    Parameters
    ----------
    path
        The package.
    files
        (name in the package, contents) pairs in order.

    Notes
    -----
    ``Sdf.ZipFileWriter`` is not used, because it stores the local time of each file, which makes packages
    irreproducible. ``zipfile`` allows a fixed time; the required padding goes into the extra field, as there.
    """
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as package:
        for name, data in files:
            entry = zipfile.ZipInfo(name, _EPOCH)
            entry.create_system = 0
            start = package.start_dir + _LOCAL_HEADER_BYTES + len(name.encode()) + _EXTRA_HEADER_BYTES
            padding = -start % _ALIGNMENT_BYTES
            entry.extra = _EXTRA_ID.to_bytes(2, "little") + padding.to_bytes(2, "little") + bytes(padding)
            package.writestr(entry, data)
