"""Signals that interrupt a command or a node.

It then stops its robot and ends.
"""

import signal

_HANGUP: signal.Signals | None = getattr(signal, "SIGHUP", None)
"""None on Windows, which has no such signal."""
INTERRUPTIONS = (signal.SIGINT, signal.SIGTERM, *((_HANGUP,) if _HANGUP is not None else ()))


def heeded_signals() -> tuple[signal.Signals, ...]:
    """Return the signals that end this process.

    A shell starts the background jobs of a script (`COMMAND &`) with SIGINT ignored, and the user
    must be able to interrupt a robot that such a job moves: SIGINT and SIGTERM are never ignored.
    SIGHUP stays ignored below `nohup`, which has this purpose.
    """
    if _HANGUP is not None and signal.getsignal(_HANGUP) is signal.SIG_IGN:
        return INTERRUPTIONS[:2]
    return INTERRUPTIONS


def raise_on_signals() -> None:
    """Raise KeyboardInterrupt in the main thread at each of these signals."""
    for number in heeded_signals():
        signal.signal(number, signal.default_int_handler)
