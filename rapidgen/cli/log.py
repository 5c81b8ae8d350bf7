"""`rapidgen log`: the event log of a controller, over Robot Web Services."""

from typing import Annotated

import typer

from rapidgen.cli import options

_ALL = 10_000
"""Entries that --follow takes at once, so that none is left out of a burst."""


def log(
    host: options.WebServices,
    follow: Annotated[
        bool, typer.Option("--follow", "-f", help="Go on with new entries, over restarts.")
    ] = False,
    count: Annotated[int, typer.Option(help="Entries to begin with.", min=0)] = 20,
    domain: Annotated[int, typer.Option(help="Domain; 0: all.", min=0, max=99)] = 0,
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object a line.")] = False,
) -> int:
    """Show a controller's event log; follow it.

    Oldest first, with arguments. Ctrl-C ends `--follow`.
    """
    import json
    import time
    from dataclasses import asdict

    from rapidgen.cli.rws_session import controller
    from rapidgen.client.errors import ConnectionFailed, ConnectionLost
    from rapidgen.client.rws.model import LogEvent

    with controller(host, user, secrets, fingerprint) as result:
        last: LogEvent | None = None
        events = result.log(domain=domain, count=count)
        while True:
            for event in events:
                typer.echo(json.dumps(asdict(event)) if as_json else event)
                last = event
            if not follow:
                return 0
            time.sleep(1.0)
            try:
                events = result.log(domain=domain, after=last.number if last else 0, count=_ALL)
            except (ConnectionFailed, ConnectionLost):
                result.wait_ready()
                # Numbers may have begun anew: what was shown is known by all that it says.
                events = result.log(domain=domain, count=_ALL)
                if last in events:
                    events = events[events.index(last) + 1 :]
