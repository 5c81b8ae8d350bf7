"""The command `egm`: check a set-up of externally guided motion, watch and record it."""

import math
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TextIO

import typer

from rapidgen.cli import options

if TYPE_CHECKING:
    from rapidgen.client.egm import EgmSession, EgmState

_SHOWN = 1.0
"""s between two lines."""
_SILENT = 2.0
"""s without a frame after which the controller has gone."""


def egm(
    target: Annotated[
        str, typer.Argument(help="Configuration file or shipped name.", metavar="CONFIG")
    ],
    host: Annotated[
        str,
        typer.Option(
            help="Address of this computer to listen on; default: `egm.address`, or 127.0.0.1.",
            metavar="ADDRESS",
        ),
    ] = "",
    port: Annotated[
        int | None,
        typer.Option(
            help="UDP port; default: `egm.port`, or 6510.", min=0, max=65_535, metavar="PORT"
        ),
    ] = None,
    group: options.Group = "",
    overrides: options.Overrides = None,
    wait: Annotated[
        float, typer.Option(help="Time for the first frame.", min=0.1, metavar="SECONDS")
    ] = 10.0,
    seconds: Annotated[
        float,
        typer.Option(help="Duration of the check.", min=0.2, max=60.0, metavar="SECONDS"),
    ] = 3.0,
    watch: Annotated[
        bool, typer.Option("--watch", help="Then show a line per second until Ctrl-C.")
    ] = False,
    record: Annotated[
        Path | None, typer.Option(help="CSV file of all frames; rad and m.", metavar="FILE.csv")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="JSON array on stdout.")] = False,
) -> int:
    """Check externally guided motion: frames, rate, state.

    Nothing moves: answers repeat the position of the robot. Each check is ok, warn, fail or
    unknown, with a fix. The exit code is 1 if one fails.
    """
    import json
    from dataclasses import asdict

    from rapidgen.client.egm import listen
    from rapidgen.client.egm.checks import check_set_up
    from rapidgen.client.egm.session import DEFAULT_PORT, choose_group
    from rapidgen.config import load_config

    if as_json and watch:
        raise typer.BadParameter("use either --json or --watch")
    config = load_config(target, overrides=overrides or ())
    settings = choose_group(config, group).egm
    address = host or (settings.address if settings else "127.0.0.1")
    if port is None:
        port = settings.port if settings else DEFAULT_PORT
    if record is not None and record.suffix.lower() != ".csv":
        raise typer.BadParameter("--record writes FILE.csv")
    with ExitStack() as stack:
        session = stack.enter_context(listen(config, group=group, host=address, port=port))
        typer.echo(f"listening on {address}:{session.port}", err=True)
        _first(session, wait, address)
        writer = None
        if record is not None:
            writer = _Writer(stack.enter_context(record.open("w", encoding="utf-8")), session)
        states = list(_states(session, seconds, writer))
        checks = check_set_up(states, session.envelope)
        if as_json:
            typer.echo(json.dumps([asdict(check) for check in checks], indent=2))
        else:
            width = max(len(check.area) for check in checks)
            for check in checks:
                typer.echo(f"{check.verdict:<7}  {check.area:<{width}}  {check.found}")
                if check.help and check.verdict != "ok":
                    typer.echo(f"{'':<7}  {'':<{width}}  -> {check.help}")
        if watch:
            _watch(session, writer)
        if writer is not None:
            typer.echo(f"{writer.count} frames in {record}", err=True)
    return 1 if any(check.verdict == "fail" for check in checks) else 0


def _first(session: "EgmSession", wait: float, address: str) -> None:
    """Wait for a frame. Raises RobotTimeout RG683."""
    from rapidgen.client.errors import RobotTimeout

    try:
        session.next_state(wait)
    except RobotTimeout:
        raise RobotTimeout.because(
            "RG683",
            f"no frame of a controller within {wait:g} s on {address}:{session.port}",
            "start the program; the UdpUc device of the controller needs this address and port, "
            "and this computer's firewall must let UDP through",
        ) from None


def _states(
    session: "EgmSession", seconds: float, writer: "_Writer | None"
) -> "Iterator[EgmState]":
    """Yield the states of a duration by the computer's clock."""
    from rapidgen.client.errors import RobotTimeout

    state = session.state
    assert state is not None
    end = state.time + seconds
    while state.time < end:
        if writer is not None:
            writer.write(state)
        yield state
        try:
            state = session.next_state(_SILENT)
        except RobotTimeout:
            # What came until then is checked: the controller may have ended its run.
            return


def _watch(session: "EgmSession", writer: "_Writer | None") -> None:
    """Print a line per second until Ctrl-C."""
    from rapidgen.client.egm.checks import figures

    try:
        while True:
            states = list(_states(session, _SHOWN, writer))
            found = figures(states)
            if found is None:
                typer.echo("no frames")
                continue
            last, lag = states[-1], session.lag
            words = [
                f"{found.rate:.0f} Hz",
                f"arrivals p99 {found.arrival * 1000:.1f} ms",
                f"answer {found.answer * 1000:.2f} ms",
                f"missed {found.missed}",
                "guided" if last.guided else "not guided",
                f"utilization {found.utilization:.0f} %",
                "joints " + " ".join(f"{math.degrees(q):.2f}" for q in last.joints),
            ]
            if lag is not None:
                words.append(f"lag {lag.seconds * 1000:.0f} ms")
            typer.echo("  ".join(words))
    except KeyboardInterrupt:
        # Ctrl-C is the usual end.
        typer.echo("", err=True)


class _Writer:
    """Writes states as CSV: time, joints, references, and figures of the frame."""

    def __init__(self, file: TextIO, session: "EgmSession") -> None:
        self._file, self.count = file, 0
        names = session.envelope.names
        columns = ["time", *names, *(f"{name}_planned" for name in names)]
        columns += [*(f"{name}_reference" for name in names), "x", "y", "z", "sequence", "missed"]
        columns += ["answer_time", "guided", "utilization"]
        file.write(",".join(columns) + "\n")

    def write(self, state: "EgmState") -> None:
        """Write a state."""
        place = ("", "", "") if state.pose is None else state.pose[0]
        values = (
            state.controller_time,
            *state.joints,
            *state.planned,
            *state.reference,
            *place,
            state.sequence,
            state.missed,
            f"{state.answer_time:.6f}",
            int(state.guided),
            state.utilization,
        )
        self._file.write(",".join(map(str, values)) + "\n")
        self.count += 1
