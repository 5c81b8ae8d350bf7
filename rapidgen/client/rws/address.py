"""Address of a controller: `rws://`, `rwss://` or bare `HOST[:PORT]`.

`rws` tries TLS first, then plain HTTP. `rwss` is TLS only.
"""

import re
from dataclasses import dataclass
from urllib.parse import unquote, urlsplit

from rapidgen.client.errors import fault
from rapidgen.diagnostics import DiagnosticError

_HOST = re.compile(r"[\w.-]{1,253}|(?=.*:)[0-9a-fA-F:.]{2,45}(%[\w.-]{1,18})?", re.ASCII)
_FILE = re.compile(r".*\.ya?ml", re.ASCII)


@dataclass(frozen=True, slots=True)
class RwsAddress:
    """Host and port; `port` 0 means 443 with TLS and 80 without."""

    host: str
    port: int = 0
    tls_only: bool = False
    user: str = ""

    @property
    def netloc(self) -> str:
        """The host as written in a URL."""
        return f"[{self.host}]" if ":" in self.host else self.host

    def __str__(self) -> str:
        port = f":{self.port}" if self.port else ""
        return f"{'rwss' if self.tls_only else 'rws'}://{self.netloc}{port}"


def parse_address(text: str) -> RwsAddress:
    """Parse an address of a user. Raises DiagnosticError RG657."""
    if not isinstance(text, str):
        raise _bad(repr(text))
    complete = text if "://" in text else f"rws://{text}"
    try:
        parts = urlsplit(complete.replace(" ", "%20"))
        host, port = parts.hostname or "", parts.port
    except ValueError as error:
        raise _bad("rws://...") from error
    if parts.password is not None:
        raise _bad(
            f"{parts.scheme}://...@{host}", "a password in an address is stored in shell histories"
        )
    remaining = parts.path.strip("/") or parts.query or parts.fragment
    if parts.scheme not in ("rws", "rwss") or remaining or not _HOST.fullmatch(host) or port == 0:
        raise _bad(text if "@" not in text else f"{parts.scheme}://...")
    if _FILE.fullmatch(host):
        raise _bad(host, "a configuration describes a robot, not its controller's address")
    return RwsAddress(host, port or 0, parts.scheme == "rwss", unquote(parts.username or ""))


def _bad(displayed: str, why: str = "") -> DiagnosticError:
    because = f": {why}" if why else ""
    help = "rws://[USER@]HOST[:PORT], or rwss:// where TLS is a must"
    message = f"'{displayed}' is not an address of Robot Web Services{because}"
    return DiagnosticError(fault("RG657", message, help))
