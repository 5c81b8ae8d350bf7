"""Who may look: a token in the link's fragment, which buys a cookie, and only from our own page.

A fragment is never sent to a server, so the token stays out of logs and Referer headers. Pages of
others in the same browser have no cookie (SameSite=Strict), and what they send names them as
Origin; a name that somebody lets point to this machine (DNS rebinding) is no address as Host.
"""

import hmac
import ipaddress
import os
import re
import secrets
from dataclasses import dataclass, field

from aiohttp import web

from rapidgen.diagnostics import refusal

HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; "
    "img-src 'self' data: blob:; connect-src 'self'; font-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cache-Control": "no-store",
}


@dataclass(frozen=True)
class TokenAuth:
    """The token of one server, and what it changes a good one into. DiagnosticError RG922."""

    token: str = field(default_factory=lambda: _given() or secrets.token_urlsafe(24), repr=False)

    @property
    def _session(self) -> str:
        """What the cookie holds: a server that comes back with the same token knows it again."""
        return hmac.new(self.token.encode(), b"rapidgen view", "sha256").hexdigest()

    def addressed(self, request: web.Request, port: int) -> bool:
        """Whether the Host is this machine by a number of it, or by `localhost`."""
        name, _, given = request.headers.get("Host", "").rpartition(":")
        if not given.isdigit() or int(given) != port:
            return False
        if name == "localhost":
            return True
        try:
            ipaddress.IPv4Address(name)
        except ValueError:
            return False
        return True

    def own(self, request: web.Request) -> bool:
        """Whether our own page asks: its Origin is where it asks."""
        return request.headers.get("Origin") == f"http://{request.headers.get('Host')}"

    def enter(self, given: str, response: web.Response, port: int) -> bool:
        """Give the cookie for the token; False: it is another one."""
        if not hmac.compare_digest(given.encode(), self.token.encode()):
            return False
        response.set_cookie(
            _cookie(port), self._session, httponly=True, samesite="Strict", path="/"
        )
        return True

    def admitted(self, request: web.Request, port: int) -> bool:
        """Whether a request has the cookie."""
        given = request.cookies.get(_cookie(port), "")
        return hmac.compare_digest(given.encode(), self._session.encode())


def _given() -> str:
    token = os.environ.get("RAPIDGEN_VIEW_TOKEN", "")
    if token and not re.fullmatch(r"[\w-]{16,}", token, re.ASCII):
        raise refusal(
            "RG922",
            None,
            "RAPIDGEN_VIEW_TOKEN is no token",
            "16 or more letters, digits, `-` or `_`; without it each run makes a new one",
        )
    return token


def _cookie(port: int) -> str:
    # Browsers share cookies between the ports of a host.
    return f"rapidgen-view-{port}"
