"""The command `lsp`: the language server for editors."""

import logging
import sys
from pathlib import Path
from typing import Annotated

import typer


def lsp(
    tcp: Annotated[
        int | None,
        typer.Option(
            help="Listen on this port of localhost, 0: any free one; default: stdin and stdout.",
            metavar="PORT",
            min=0,
            max=65535,
        ),
    ] = None,
    log: Annotated[
        Path | None, typer.Option(help="Write messages about the server's work.", metavar="FILE")
    ] = None,
    stdio: Annotated[bool, typer.Option("--stdio", help="Use stdin and stdout (default).")] = False,
) -> int:
    """Serve editors by the language server protocol.

    An editor starts this command: it is of no use at a terminal. Reads files, and writes none: all
    changes are proposals to the editor.
    """
    from rapidgen._message_streams import listening, standard_stream
    from rapidgen.lsp.server import Server

    if log is not None:
        handler = logging.FileHandler(log, "w", "utf-8")
        handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(message)s"))
        own = logging.getLogger("rapidgen.lsp")
        own.addHandler(handler)
        own.setLevel(logging.DEBUG)
        own.propagate = False
    if tcp is None:
        with standard_stream() as stream:
            return Server(stream).run()
    with listening(tcp) as (port, clients):
        sys.stderr.write(f"listening on 127.0.0.1:{port}\n")
        sys.stderr.flush()
        for client in clients:
            return Server(client).run()
    return 0
