"""`--to URL`: the controller and its transport."""

import os
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from urllib.parse import unquote, urlsplit

from rapidgen.deploy.secrets import Credentials, find_password
from rapidgen.deploy.transports.registry import SCHEMES, Target
from rapidgen.deploy.transports.transport import Transport
from rapidgen.diagnostics import DiagnosticError, refusal, suggest


@dataclass(frozen=True, slots=True)
class Access:
    """Login settings common to all targets of a command."""

    user: str = ""
    secrets: Path | None = None
    identity: str = ""
    known_hosts: str = ""
    ask: bool = False
    timeout: float = 10.0
    fingerprint: str = ""
    agree: Callable[[str, str], bool] | None = None
    """Asks the user about a certificate (host:port, fingerprint).

    None: there is no terminal.
    """


def parse_target(url: str) -> Target:
    """Return the target of a URL.

    Raises DiagnosticError RG509 (not such a URL) and RG510 (a password in it).
    """
    scheme, colon, remaining = url.partition("://")
    if not colon:
        scheme, _, remaining = url.partition(":")
        if scheme not in SCHEMES or not remaining:
            _refuse_password(url)
            help = f"for a controller: rws://{url} or ftp://{url}; for a folder here: dir://{url}"
            raise _bad(url, "there is no scheme", help)
        if SCHEMES[scheme].port:
            _refuse_password(remaining)
            remaining = remaining.lstrip("/")
        raise _bad(url, "there is no '://'", f"write {scheme}://{remaining}")
    if scheme in SCHEMES and not SCHEMES[scheme].port:
        folder = Path(os.path.abspath(os.path.expanduser(unquote(remaining) or ".")))
        return Target(scheme, "", 0, str(folder))
    _refuse_password(remaining)
    if scheme not in SCHEMES:
        known = ", ".join(f"{name}://" for name in SCHEMES)
        meant = suggest(scheme, list(SCHEMES)) or f"there are {known}"
        raise _bad(url, f"unknown scheme {scheme!r}", meant)
    try:
        parts = urlsplit(url.replace(" ", "%20"))
        host, port = parts.hostname or "", parts.port
    except ValueError as fault:
        raise _bad("--to", str(fault)) from None
    path = unquote(parts.path).rstrip("/")
    if not host or parts.query or parts.fragment:
        raise _bad(url, "expected ftp://[USER@]HOST[:PORT]/FOLDER")
    if re.search(r"[\x00-\x1f\x7f]", path + host) or ".." in path.split("/"):
        raise _bad(url, "the folder holds '..' or control characters")
    return Target(scheme, host, port or SCHEMES[scheme].port, path, unquote(parts.username or ""))


def _refuse_password(place: str) -> None:
    """Refuse USER:PASSWORD@HOST before any output shows the URL.

    Raises DiagnosticError RG510.
    """
    found = re.match(r"/*[^/@]*:[^/@]*@([^/:?#]*)", place)
    if found is not None:
        raise refusal(
            "RG510",
            None,
            f"the URL of {found[1]} contains a password",
            "URLs end in histories and logs: use --secrets FILE, RAPIDGEN_PASSWORD, "
            "or wait for the prompt",
        )


def connect(target: Target, access: Access) -> Transport:
    """Return a logged-in transport. Raises DiagnosticError RG501..RG511."""
    login = credentials(target, access) if target.way.port else Credentials("")
    return target.open(login, access.timeout)


def credentials(target: Target, access: Access) -> Credentials:
    """Return user and password of a target.

    IRC5's default user name if none is given.
    """
    login = Credentials(
        target.user or access.user,
        identity=access.identity,
        known_hosts=access.known_hosts,
        fingerprint=access.fingerprint,
        agree=access.agree,
    )
    ask = access.ask and not (target.way.takes_keys and access.identity)
    login = find_password(
        login,
        target.host,
        target.port,
        secrets=access.secrets,
        ask=ask,
        needed=not target.way.takes_keys,
    )
    if login.user:
        return login
    return replace(login, user="Default User")


def _bad(url: str, reason: str, help: str = "") -> DiagnosticError:
    # An invalid URL may contain a password at an odd place: it is not repeated.
    displayed = url if "@" not in url else url.partition("://")[0] + "://..."
    return refusal("RG509", None, f"--to {displayed}: {reason}", help)
