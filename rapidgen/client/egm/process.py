"""The 4 ms loop of a session: `python -m rapidgen.client.egm.process PIPE SOCKET`.

It answers the newest frame, once, as soon as it is there. What the caller does in the meantime
cannot delay it.
"""

import contextlib
import gc
import select
import signal
import socket
import sys
import time
from multiprocessing.connection import Connection

from rapidgen.client.egm.exchange import SILENCE, PartnerExchange
from rapidgen.wire.egm.values import EgmMessageError


def serve(pipe: Connection, link: socket.socket, exchange: PartnerExchange) -> None:
    """Answer frames until the caller closes the pipe."""
    link.setblocking(False)
    due = 0.0
    while True:
        wait = max(0.0, due - time.monotonic()) if exchange.is_guided else None
        ready = select.select([link.fileno(), pipe.fileno()], [], [], wait)[0]
        # Orders first: an answer contains the newest target.
        while pipe.poll():
            order = pipe.recv()
            if order is None:
                return
            exchange.execute(order)
        if link.fileno() not in ready:
            # After a pause of this process there are frames: they come first.
            if exchange.is_guided and time.monotonic() >= due:
                exchange.miss_frames()
                pipe.send(exchange.state())
            continue
        frame, source = _newest(link)
        if frame is None:
            continue
        arrived = time.monotonic()
        due = arrived + SILENCE
        try:
            answer = exchange.answer(frame, arrived)
        except EgmMessageError:
            continue
        # Any datagram may be lost.
        with contextlib.suppress(BlockingIOError, ConnectionRefusedError):
            link.sendto(answer, source)
        answered = time.monotonic()
        if select.select([], [pipe.fileno()], [], 0)[1]:
            pipe.send(exchange.state(answered - arrived))


def _newest(link: socket.socket) -> "tuple[bytes | None, tuple[str, int]]":
    """Return the last frame that is there, and where it came from."""
    frame, source = None, ("", 0)
    while True:
        try:
            frame, source = link.recvfrom(65_536)
        except (BlockingIOError, ConnectionRefusedError):
            return frame, source


def main() -> None:
    """Read the exchange from the pipe and serve it."""
    # Ctrl-C ends the caller, which closes the pipe.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    pipe = Connection(int(sys.argv[1]))
    link = socket.socket(fileno=int(sys.argv[2]))
    exchange = pipe.recv()
    gc.collect()
    gc.freeze()
    gc.disable()
    # The caller may end without a word.
    with link, pipe, contextlib.suppress(EOFError, BrokenPipeError, ConnectionResetError):
        pipe.send(None)
        serve(pipe, link, exchange)


if __name__ == "__main__":
    main()
