"""Process of one exchange of externally guided motion: `python -m ... FILE_DESCRIPTOR`."""

import gc
import signal
import sys
from multiprocessing.connection import Connection

from rapidgen.motion.egm.exchange import codec
from rapidgen.servers.egm import UdpLink, run_exchange


def main() -> None:
    """Read the exchange from the pipe and execute it."""
    # Ctrl-C ends the controller, which closes the pipe.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    pipe = Connection(int(sys.argv[1]))
    exchange, address, offset = pipe.recv()
    link = UdpLink(address)
    # Its import takes many cycles.
    codec()
    gc.collect()
    gc.freeze()
    gc.disable()
    try:
        run_exchange(pipe, exchange, link, offset)
    finally:
        link.close()


if __name__ == "__main__":
    main()
