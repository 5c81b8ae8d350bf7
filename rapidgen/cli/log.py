"""`rapidgen log`: the event log of a controller, over Robot Web Services or from a saved file."""

from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli import options
from rapidgen.diagnostics import refusal

_ALL = 10_000
"""Entries that --follow takes at once, so that none is left out of a burst."""


def log(
    host: Annotated[
        str,
        typer.Argument(
            metavar="HOST|FILE",
            help="Host or host:port of a controller, or an event log that was saved as text.",
        ),
    ],
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
    """Show and explain a controller's event log.

    Oldest first, with arguments. Ctrl-C ends `--follow`. A saved log is shown with rapidgen's
    explanation of each event, and a summary of its errors and warnings.
    """
    if "://" not in host and ("/" in host or Path(host).is_file()):
        if follow:
            raise refusal(
                "RG901", None, "--follow with a file", "give the HOST, or leave out --follow"
            )
        return _saved(Path(host), count, domain, as_json)
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


def _saved(path: Path, count: int, domain: int, as_json: bool) -> int:
    import json
    from dataclasses import asdict

    from rapidgen.cli.event_texts import saved_event, summary
    from rapidgen.machine.saved_log import read_saved_log

    result = read_saved_log(path)
    events = [e for e in result.events if domain in (0, e.code // 10_000)]
    events.sort(key=lambda event: event.sequence)
    for event in events[-count:] if count else ():
        typer.echo(json.dumps(asdict(event)) if as_json else saved_event(event))
    if not as_json:
        typer.echo()
        for line in summary(result):
            typer.echo(line)
    return 0
