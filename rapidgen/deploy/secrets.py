"""Passwords from a protected file, the environment, or a prompt.

They are never shown.
"""

import getpass
import os
import stat
import sys
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

from rapidgen._reading import open_foreign
from rapidgen.diagnostics import DiagnosticError, refusal

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ENVIRONMENT = "RAPIDGEN_PASSWORD"
DEFAULTS = frozenset(
    {("Default User", "robotics"), ("Admin", "robotics"), ("anonymous", "anonymous@")}
)
"""Default logins of ABB's controllers, and the one without a password."""


_LARGEST = 1_000_000
"""Largest file of passwords, bytes."""


class Secret:
    """A text that no representation, log or pickle contains."""

    __slots__ = ("_text",)

    def __init__(self, text: str) -> None:
        self._text = text

    def get(self) -> str:
        """Return the text itself, for its single use."""
        return self._text

    def __repr__(self) -> str:
        return "Secret(***)"

    def __reduce__(self) -> str:
        raise TypeError("a Secret is not pickled")


@dataclass(frozen=True, slots=True)
class Credentials:
    """User and login method.

    `identity` and `known_hosts` are files for SFTP, `fingerprint` and `agree` (asks the user about
    host and fingerprint) are for TLS with a pinned certificate.
    """

    user: str
    password: Secret = field(default_factory=lambda: Secret(""))
    identity: str = ""
    known_hosts: str = ""
    fingerprint: str = ""
    agree: Callable[[str, str], bool] | None = None

    @property
    def is_default(self) -> bool:
        """True for ABB's published default login."""
        return (self.user, self.password.get()) in DEFAULTS


def redact(text: str, login: Credentials) -> str:
    """Return a server's words without the password that it may echo."""
    password = login.password.get()
    return text.replace(password, "***") if password else text


def find_password(
    login: Credentials,
    host: str,
    port: int,
    *,
    secrets: Path | None,
    ask: bool,
    needed: bool = True,
) -> Credentials:
    """Complete user and password of `login`: file, environment, prompt.

    The file is TOML: a table for each host, `host:port`, or `default`, with `user` and `password`.
    `needed`: there is no other way to log in; otherwise no prompt appears without a terminal, and
    the password stays empty. Raises DiagnosticError RG511 (file readable by others, or invalid),
    RG512 (no terminal to prompt on).
    """
    if secrets is not None:
        entry = _entry(secrets, host, port)
        login = replace(login, user=login.user or entry.get("user", ""))
        if "password" in entry:
            return replace(login, password=Secret(entry["password"]))
    from_environment = os.environ.get(ENVIRONMENT)
    if from_environment is not None:
        return replace(login, password=Secret(from_environment))
    if ask and sys.stdin.isatty():
        prompt = f"password of {login.user or 'the default user'} at {host}: "
        return replace(login, password=Secret(getpass.getpass(prompt)))
    if ask and needed:
        # A host's name without quotes is a nested table in TOML, not that host.
        help = (
            f"--secrets FILE, or {ENVIRONMENT}; it may be empty"
            if secrets is None
            else f'{secrets} has none for it: ["{host}"], in quotes, and below it password = "..."'
        )
        raise refusal(
            "RG512",
            None,
            f"{host} requires a password, and there is no terminal to prompt on",
            help,
        )
    return login


def _entry(path: Path, host: str, port: int) -> dict[str, str]:
    try:
        with open_foreign(path, _LARGEST) as file:
            status = os.fstat(file.fileno())
            if status.st_mode & (stat.S_IRWXG | stat.S_IRWXO):
                raise _refused(path, "others on this machine can read it", f"chmod 600 {path}")
            data = tomllib.loads(file.read().decode("utf-8-sig"))
    except OSError as fault:
        raise _refused(path, fault.strerror or str(fault), "name a file that exists") from fault
    except ValueError as fault:  # TOMLDecodeError, UnicodeDecodeError: without the line's text
        raise _refused(
            path, "it is not TOML", '["192.168.125.1"]\nuser = "..."\npassword = "..."'
        ) from fault
    for name in (f"{host}:{port}", host, "default"):
        entry = data.get(name)
        if isinstance(entry, dict):
            return {k: v for k, v in entry.items() if isinstance(v, str)}
    return {}


def _refused(path: Path, reason: str, help: str) -> DiagnosticError:
    return refusal("RG511", None, f"secrets file {path} is not used: {reason}", help)
