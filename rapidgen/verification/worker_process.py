"""Worker process of a Dask worker.

Run by `python -m rapidgen.verification.worker_process`. A Dask worker has threads; a controller
that is copied by a fork must have none. The process gets the same input as a local worker, after
the context.
"""

import socket
import subprocess
import sys
from collections.abc import Callable
from multiprocessing.connection import Connection

from rapidgen.verification.worker_pool import serve


class WorkerProcessLost(Exception):
    """The process ended during an item."""


class WorkerProcess:
    """The process, seen from its Dask worker."""

    def __init__(self, context: bytes) -> None:
        """Start the process with a pickled context."""
        ours, theirs = socket.socketpair()
        with theirs:
            values = [
                sys.executable,
                "-m",
                "rapidgen.verification.worker_process",
                str(theirs.fileno()),
            ]
            self._process = subprocess.Popen(values, pass_fds=(theirs.fileno(),))
        self._connection = Connection(ours.detach())
        self._connection.send_bytes(context)

    def work(self, function: Callable[..., object], item: object) -> tuple[bool, object]:
        """Return success, and the result or exception of a call.

        Raises WorkerProcessLost.
        """
        try:
            self._connection.send((function, item))
            outcome: tuple[bool, object] = self._connection.recv()
        except (EOFError, BrokenPipeError, ConnectionResetError) as gone:
            self.close()
            raise WorkerProcessLost(f"status {self._process.returncode}") from gone
        return outcome

    def close(self) -> None:
        """Let it finish its item, and stop it."""
        self._connection.close()
        self._process.wait()


def main() -> None:
    """Serve the other end of the socket."""
    connection = Connection(int(sys.argv[1]))
    serve(connection, connection.recv())


if __name__ == "__main__":
    main()
