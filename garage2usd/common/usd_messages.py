"""Warnings of the USD library, which otherwise go to standard error with the function and line of its source."""

import re
from typing import Any

_collectors: list[Any] = []
_is_kept = False
_INTERNAL = re.compile(r"\s*\(instantiating stage on stage [^)]*\)|\s*<0x[0-9a-f]+>")


def keep_usd_messages() -> None:
    """Keep the messages of stages that this process opens from now on, for `usd_messages`."""
    global _is_kept  # noqa: PLW0603 - USD's messages are the process's own
    _is_kept = True
    usd_messages()  # those of an earlier command of this process


def collect_usd_messages() -> None:
    """Collect the messages from now on, if they are kept; called before a stage is opened."""
    if _is_kept and not _collectors:
        from pxr import UsdUtils  # noqa: PLC0415 - brings USD

        _collectors.append(UsdUtils.CoalescingDiagnosticDelegate())


def usd_messages() -> list[str]:
    """Return the messages so far, each once and on one line, without the places in USD's source; they are forgotten."""
    said = []
    for collector in _collectors:
        for message in collector.TakeUncoalescedDiagnostics():
            try:
                said.append(" ".join(_INTERNAL.sub("", message.commentary).split()))
            except UnicodeDecodeError:  # the message quotes bytes that are not text
                continue
    return list(dict.fromkeys(said))
