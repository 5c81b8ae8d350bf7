"""Checks of an SFTP server's answers before paramiko parses them.

paramiko pads a short answer with zeros, and trusts every count in it: a listing of 2^30 names, or a
file that ends in zeros, from a few invalid bytes. So every answer is checked by the lengths in it
(draft-ietf-secsh-filexfer-02, which is version 3).
"""

from typing import NoReturn

from paramiko import SFTPClient, SFTPError

from rapidgen.deploy.transports.transport import LISTING_LIMIT

_VERSION, _STATUS, _HANDLE, _DATA, _NAME, _ATTRS, _EXTENDED = 2, 101, 102, 103, 104, 105, 201
_SIZE, _OWNER, _MODE, _TIMES, _MORE = 1, 2, 4, 8, 0x8000_0000
_STRAYS = 1000
"""Unrequested answers; a few arrive after a failed write."""


class CheckedClient(SFTPClient):
    """paramiko's client with checked answers.

    SFTPError for an invalid answer, ConnectionError for a closed connection.
    """

    names = 0
    """Names since the start of a listing; each listing sets it to 0."""
    _strays = 0

    def _read_packet(self) -> tuple[int, bytes]:
        try:
            # Private to paramiko, and so not in its type stubs; a test pins it.
            kind, data = super()._read_packet()  # type: ignore[misc]
        except EOFError as error:
            # paramiko would call it a protocol error.
            raise ConnectionResetError("connection closed") from error
        self.names += _names(kind, data)
        if self.names > LISTING_LIMIT:
            raise SFTPError("a listing without an end")
        if kind != _VERSION and int.from_bytes(data[:4], "big") not in self._expecting:  # type: ignore[attr-defined]
            self._strays += 1
            if self._strays > _STRAYS:
                raise SFTPError("answers without a request, without an end")
        return kind, data


def _names(kind: int, data: bytes) -> int:
    """Return the number of names of a valid answer.

    At least 1 for a listing. SFTPError: invalid.
    """
    if kind in (_VERSION, _EXTENDED):
        _skip(data, 0, 4)
        return 0
    at = _skip(data, 0, 4)  # the request's number
    if kind == _STATUS:
        at = _skip(data, at, 4)
        if at < len(data):  # old servers send no more
            _text(data, at)
    elif kind in (_HANDLE, _DATA):
        _text(data, at)
    elif kind == _ATTRS:
        _attributes(data, at)
    elif kind == _NAME:
        count = _number(data, at)
        at += 4
        for _ in range(count):
            at = _attributes(data, _text(data, _text(data, at)))
        return max(count, 1)
    else:
        _unsound(f"an answer of kind {kind}")
    return 0


def _attributes(data: bytes, at: int) -> int:
    flags = _number(data, at)
    widths = ((_SIZE, 8), (_OWNER, 8), (_MODE, 4), (_TIMES, 8))
    at = _skip(data, at + 4, sum(width for flag, width in widths if flags & flag))
    if flags & _MORE:
        count = _number(data, at)
        at += 4
        for _ in range(count):
            at = _text(data, _text(data, at))
    return at


def _text(data: bytes, at: int) -> int:
    return _skip(data, at + 4, _number(data, at))


def _number(data: bytes, at: int) -> int:
    return int.from_bytes(data[at : _skip(data, at, 4)], "big")


def _skip(data: bytes, at: int, width: int) -> int:
    if at + width > len(data):
        _unsound("a truncated answer")
    return at + width


def _unsound(what: str) -> NoReturn:
    raise SFTPError(what)
