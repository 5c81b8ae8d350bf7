"""Signals that interrupt a command or a node.

It then stops its robot and ends.
"""

import signal

INTERRUPTIONS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def heeded_signals() -> tuple[signal.Signals, ...]:
    """Return the signals that end this process.

    A shell starts the background jobs of a script (`COMMAND &`) with SIGINT ignored, and the user
    must be able to interrupt a robot that such a job moves: SIGINT and SIGTERM are never ignored.
    SIGHUP stays ignored below `nohup`, which has this purpose.
    """
    if signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
        return INTERRUPTIONS[:2]
    return INTERRUPTIONS


def raise_on_signals() -> None:
    """Raise KeyboardInterrupt in the main thread at each of these signals."""
    for number in heeded_signals():
        signal.signal(number, signal.default_int_handler)
