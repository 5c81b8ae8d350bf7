"""Log-in, certificate and consent of the commands over Robot Web Services."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, TypedDict

import typer

from rapidgen.cli.terminal import is_terminal

if TYPE_CHECKING:
    from rapidgen.client.rws import Controller


_PROMPT = 10.0
"""Seconds for which the pendant shows the question [RWS manual]."""


class Login(TypedDict):
    """Arguments of `Controller` and `AsyncController`."""

    address: str
    user: str
    password: str
    fingerprint: str
    confirm: Callable[[str, str], bool] | None


def login(host: str, user: str, secrets: Path | None, fingerprint: str) -> Login:
    """Return address and log-in of a controller. Raises DiagnosticError.

    The host `sim` is the running simulator of this user.
    """
    from rapidgen.client.rws.address import parse_address
    from rapidgen.client.sim_address import SIMULATOR, find_web_services
    from rapidgen.deploy.secrets import Credentials, find_password

    if host == SIMULATOR:
        simulator = find_web_services()
        host, fingerprint = simulator.web_services, fingerprint or simulator.fingerprint
    address = parse_address(host)
    known = find_password(
        Credentials(address.user or user), address.host, address.port, secrets=secrets, ask=True
    )
    return Login(
        address=host,
        user=known.user or "Default User",
        password=known.password.get(),
        fingerprint=fingerprint,
        confirm=certificate_prompt(),
    )


@contextmanager
def controller(
    host: str, user: str, secrets: Path | None, fingerprint: str
) -> "Iterator[Controller]":
    """Connect to a controller and log out at the end. Raises as `login`."""
    from rapidgen.client.rws import Controller

    with Controller(**login(host, user, secrets, fingerprint)) as result:
        yield result


def ask_pendant(result: "Controller", privilege: str, mode: str) -> None:
    """Ask the operator at the pendant for consent in manual mode. Raises RG661, RG659."""
    if mode == "AUTO":
        return
    typer.echo(
        f"{result.where} is in manual mode: press Grant on its pendant within {_PROMPT:g} s",
        err=True,
    )
    result.ask_rmmp(privilege, wait=_PROMPT)


def certificate_prompt() -> Callable[[str, str], bool] | None:
    """Return a function that asks whether to trust a certificate; None without a terminal."""
    return _trusts if is_terminal() else None


def _trusts(where: str, fingerprint: str) -> bool:
    typer.echo(f"{where} is unknown. The fingerprint of its certificate is", err=True)
    typer.echo(f"  {fingerprint}", err=True)
    return typer.confirm("Trust this certificate?", err=True)
