"""HTTP authentication: digest (RFC 7616 with MD5, qop=auth) and Basic."""

import base64
import hashlib
import hmac
import re
from collections.abc import Mapping
from dataclasses import dataclass
from urllib.parse import unquote

REALM = "validusers@robapi.abb"
_PART = re.compile(r'(\w+)=(?:"((?:[^"\\]|\\.)*)"|([^\s,"]+))')


@dataclass(frozen=True, slots=True)
class Digest:
    """Authorization of a client."""

    user: str
    nonce: str
    uri: str
    nc: str
    cnonce: str
    response: str


def challenge(nonce: str, *, stale: bool = False) -> str:
    """Return WWW-Authenticate."""
    again = ", stale=true" if stale else ""
    return (
        f'Digest realm="{REALM}", domain="/", nonce="{nonce}", qop="auth", algorithm="MD5"{again}'
    )


def parse(header: str) -> Digest | None:
    """Parse an Authorization header; None: not a digest with qop=auth."""
    scheme, _, remaining = header.partition(" ")
    result = {key.lower(): quoted or bare for key, quoted, bare in _PART.findall(remaining)}
    if scheme.lower() != "digest" or result.get("qop") != "auth" or result.get("realm") != REALM:
        return None
    try:
        return Digest(
            # A quoted string escapes quotes and backslashes, and nothing else.
            re.sub(r"\\(.)", r"\1", result["username"]), result["nonce"], result["uri"],
            result["nc"], result["cnonce"], result["response"],
        )  # fmt: skip
    except KeyError:
        return None


def is_right(sent: Digest, method: str, password: str) -> bool:
    """True if the response belongs to this password.

    The user name is used unchanged.
    """
    try:
        ha1 = _md5(f"{sent.user}:{REALM}:{password}")
        ha2 = _md5(f"{method}:{sent.uri}")
        expected = _md5(f"{ha1}:{sent.nonce}:{sent.nc}:{sent.cnonce}:auth:{ha2}")
        return hmac.compare_digest(expected.encode(), sent.response.lower().encode())
    except UnicodeEncodeError:
        return False


def is_for(sent: Digest, target: str) -> bool:
    """True if a digest was made for this request target [RFC 7616, 3.4.6].

    A client may name the complete address, and may escape other characters.
    """
    uri = re.sub(r"^https?://[^/]*", "", sent.uri)
    return unquote(uri) == unquote(target)


def count_of(sent: Digest) -> int | None:
    """Return the nonce count; None if it is not one [RFC 7616, 3.4]."""
    return int(sent.nc, 16) if re.fullmatch(r"[0-9A-Fa-f]{8}", sent.nc) else None


def _md5(text: str) -> str:
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()


def basic_user(header: str, users: Mapping[str, str]) -> str | None:
    """Return the user of an `Authorization: Basic` header, or None.

    None: unknown user or wrong password.
    """
    scheme, _, remaining = header.partition(" ")
    if scheme.lower() != "basic":
        return None
    try:
        user, colon, password = base64.b64decode(remaining, validate=True).decode().partition(":")
    except ValueError:
        return None
    known = users.get(user)
    if not colon or known is None:
        return None
    return user if hmac.compare_digest(known.encode(), password.encode()) else None
