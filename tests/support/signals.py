"""Signals of processes that tests start."""

import signal

__all__ = ["heed_all"]


def heed_all():
    """What a process heeds though whoever runs the tests ignores it: ``nohup`` ignores hangups, ``&`` interrupts.

    For ``preexec_fn`` of `subprocess.Popen`.
    """
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)
