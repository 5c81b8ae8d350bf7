"""Authentication: a token in the link's fragment, exchanged for a cookie.

A fragment is never sent to a server, so the token stays out of logs and Referer headers. Foreign
pages in the same browser have no cookie (SameSite=Strict), and their requests name them as Origin;
a domain name that an attacker points to this machine (DNS rebinding) is not a valid Host.
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


def is_readable(request: web.Request) -> bool:
    """True if the headers that authenticate a request are ASCII."""
    names = ("Host", "Origin", "Cookie")
    return all(value.isascii() for name in names for value in request.headers.getall(name, ()))


@dataclass(frozen=True)
class TokenAuth:
    """The token of one server, and its exchange. DiagnosticError RG922."""

    token: str = field(default_factory=lambda: _given() or secrets.token_urlsafe(24), repr=False)

    @property
    def _session(self) -> str:
        """Return the cookie's value.

        It depends only on the token: a restarted server with the same token accepts it.
        """
        return hmac.new(self.token.encode(), b"rapidgen view", "sha256").hexdigest()

    def addressed(self, request: web.Request, port: int) -> bool:
        """True if the Host is an IP address of this machine, or `localhost`."""
        name, _, given = request.headers.get("Host", "").rpartition(":")
        if given != str(port):
            return False
        if name == "localhost":
            return True
        try:
            ipaddress.IPv4Address(name)
        except ValueError:
            return False
        return True

    def own(self, request: web.Request) -> bool:
        """True for a request of our own page: its Origin equals its Host."""
        return request.headers.get("Origin") == f"http://{request.headers.get('Host')}"

    def enter(self, given: bytes, response: web.Response, port: int) -> bool:
        """Return the cookie for the token; False: a wrong token."""
        if not hmac.compare_digest(given, self.token.encode()):
            return False
        response.set_cookie(
            _cookie(port), self._session, httponly=True, samesite="Strict", path="/"
        )
        return True

    def admitted(self, request: web.Request, port: int) -> bool:
        """True if a request has the cookie."""
        given = request.cookies.get(_cookie(port), "")
        return hmac.compare_digest(given.encode(), self._session.encode())


def _given() -> str:
    token = os.environ.get("RAPIDGEN_VIEW_TOKEN", "")
    if token and not re.fullmatch(r"[\w-]{16,}", token, re.ASCII):
        raise refusal(
            "RG922",
            None,
            "RAPIDGEN_VIEW_TOKEN is not a token",
            "16 or more letters, digits, `-` or `_`; without it each run makes a new one",
        )
    return token


def _cookie(port: int) -> str:
    # Browsers share cookies between the ports of a host.
    return f"rapidgen-view-{port}"
