"""Memory of the running process, on Linux.

``ru_maxrss`` will not do: a process starts with the peak of the one that it was forked from.
"""

from pathlib import Path

__all__ = ["peak_mb", "resident_mb"]

_KB_PER_MB = 1024


def peak_mb() -> float:
    """The most that was ever resident."""
    return _status_mb("VmHWM")


def resident_mb() -> float:
    """What is resident now."""
    return _status_mb("VmRSS")


def _status_mb(field: str) -> float:
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(float(line.split()[1]) for line in lines if line.startswith(f"{field}:")) / _KB_PER_MB
