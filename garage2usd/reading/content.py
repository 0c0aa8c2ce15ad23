"""Digest of a stage's content, independent of the layout of its files.

OpenUSD orders the tables of a binary file differently on x86-64 and on Arm, so that equal layers have different bytes
and, as assets are named by their bytes, different names.
"""

import hashlib
import re
from pathlib import Path

from pxr import UsdUtils

from garage2usd.common.errors import StageError

_DIGEST_IN_NAME = re.compile(r"_[0-9a-f]{16}(?=\.usdc)")


def stage_digest(path: Path, *, digits: int = 64) -> str:
    """Digest the text of all layers of a stage and the bytes of its other files; hexadecimal digits of SHA-256.

    Raises
    ------
    StageError
        If the stage or one of its files cannot be read.
    """
    layers, assets, missing = UsdUtils.ComputeAllDependencies(str(path))
    if missing or not layers:
        raise StageError(path, f"cannot read {', '.join(missing) or 'it'}")
    texts = [_DIGEST_IN_NAME.sub("", layer.ExportToString()).encode() for layer in layers]
    sums = sorted(hashlib.sha256(data).hexdigest() for data in texts + [Path(asset).read_bytes() for asset in assets])
    return hashlib.sha256("\n".join(sums).encode()).hexdigest()[:digits]
