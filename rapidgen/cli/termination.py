"""Signals that end what serves, or what is carried out."""

import signal
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rapidgen._interruption import heeded_signals


@contextmanager
def on_signal(end: Callable[[], None]) -> Iterator[None]:
    """`end()` is called, in a thread of its own, whenever Ctrl-C, SIGTERM or SIGHUP comes.

    Not in a handler: there every lock may be held by what it has interrupted. And a handler runs in
    the main thread, which goes on waiting where the system gave the signal to another one; the
    descriptor that Python writes to is told of any (docs of signal.set_wakeup_fd).
    """
    numbers = heeded_signals()
    text, tells = socket.socketpair()
    tells.setblocking(False)

    def watch() -> None:
        while number := text.recv(1):
            if number[0] in numbers:
                end()

    watcher = threading.Thread(target=watch, name="signals", daemon=True)
    other = signal.set_wakeup_fd(tells.fileno(), warn_on_full_buffer=False)
    before = {number: signal.signal(number, lambda *_: None) for number in numbers}
    watcher.start()
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(other)
        tells.close()
        watcher.join()
        text.close()
