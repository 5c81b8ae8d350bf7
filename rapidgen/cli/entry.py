"""Entry point of `rapidgen`: send a STOP before anything heavy is imported."""

import gc
import signal
import sys


def run() -> None:
    """Run one command and exit with its code."""
    # Until `raise_on_signals`, Ctrl-C ends the process without a traceback.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # Imports make tens of thousands of permanent objects: collecting them costs 10 % of a build.
    gc.set_threshold(200_000, 20, 50)
    text = sys.argv[1:]
    if text[:1] == ["stop"]:
        from rapidgen.cli.send_stop import send

        send(text[1:])
    from rapidgen._interruption import raise_on_signals
    from rapidgen.cli.app import run as complete

    raise_on_signals()
    complete()
