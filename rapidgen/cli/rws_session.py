"""What the verbs over Robot Web Services do alike: log in, agree to a certificate, ask."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from rapidgen.cli.wizard import is_terminal

if TYPE_CHECKING:
    from rapidgen.client.rws import Controller


_PROMPT = 10.0
"""s that a question stands on the pendant [RWS manual]."""


@contextmanager
def controller(
    host: str, user: str, secrets: Path | None, fingerprint: str
) -> "Iterator[Controller]":
    """A connected controller, logged out at the end. Raises DiagnosticError."""
    from rapidgen.client.rws import Controller
    from rapidgen.client.rws.address import parse_address
    from rapidgen.deploy.secrets import Credentials, find_password

    address = parse_address(host)
    login = find_password(
        Credentials(address.user or user), address.host, address.port, secrets=secrets, ask=True
    )
    result = Controller(
        host,
        user=login.user or "Default User",
        password=login.password.get(),
        fingerprint=fingerprint,
        confirm=agree(),
    )
    with result:
        yield result


def ask_pendant(result: "Controller", privilege: str, mode: str) -> None:
    """In manual mode the pendant's user is asked, which is announced. Raises RG661, RG659."""
    if mode == "AUTO":
        return
    typer.echo(
        f"{result.where} is in manual mode: its pendant asks now whether this may be. "
        f"Press Grant there within {_PROMPT:g} s",
        err=True,
    )
    result.ask_rmmp(privilege, wait=_PROMPT)


def agree() -> Callable[[str, str], bool] | None:
    """Asks whether a certificate is right; None: nobody is at the terminal."""
    return _agree if is_terminal() else None


def _agree(where: str, fingerprint: str) -> bool:
    typer.echo(f"{where} was not met before. Its certificate has the fingerprint", err=True)
    typer.echo(f"  {fingerprint}", err=True)
    return typer.confirm("Is that the controller's own?", err=True)
