"""SFTP server: paramiko, which the deployment's client uses too.

(asyncssh serves SFTP with less code of ours, but would be a second SSH stack in the wheel.) Only
password login, only the `sftp` subsystem: no shell, no forwarding. Every name is resolved, links
included, and refused if it ends outside the folder.
"""

import hmac
import logging
import os
import socket
import struct
import threading
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen.servers.service import Service, in_use, loopback

if TYPE_CHECKING:
    import paramiko

_TICK = 0.2
"""s between two checks of the stop flag; connections are accepted at once."""


_SENSELESS = (ValueError, IndexError, KeyError, TypeError, AttributeError, struct.error)
"""Exceptions of paramiko, besides its own, for invalid handshakes.

ValueError (text that is not UTF-8, invalid keys) is measured; indexing and unpacking such bytes can
raise the others.
"""


def serve_sftp(
    home: Path | str,
    host: str = "127.0.0.1",
    port: int = 0,
    user: str = "Default User",
    password: str = "",
) -> Service:
    """Serve the folder `home` over SFTP, read and write, in threads.

    An empty `password` is replaced by a random one; the host key is new in every run and is in the
    handle as a `known_hosts` line. Raises DiagnosticError RG560, RG561.
    """
    import secrets

    import paramiko

    address = loopback(host)
    password = password or secrets.token_urlsafe(12)
    logging.getLogger("paramiko").addHandler(logging.NullHandler())
    listener = socket.socket(socket.AF_INET6 if ":" in address else socket.AF_INET)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((address, port))
        listener.listen()
    except (OSError, OverflowError) as error:
        listener.close()
        fault = error if isinstance(error, OSError) else OSError(str(error))
        raise in_use(address, port, fault) from error
    listener.settimeout(_TICK)
    bound: int = listener.getsockname()[1]
    key = paramiko.ECDSAKey.generate()
    root = Path(home).resolve()
    stopping = threading.Event()
    sessions: set[paramiko.Transport] = set()

    def session(connection: socket.socket) -> None:
        transport = paramiko.Transport(connection)
        sessions.add(transport)
        transport.add_server_key(key)
        transport.set_subsystem_handler("sftp", paramiko.SFTPServer, _interface(), root)
        try:
            transport.start_server(server=_login(user, password))
        except (paramiko.SSHException, EOFError, OSError, *_SENSELESS):
            # The peer is not an SSH client, or has disconnected: nothing to do.
            transport.close()
        transport.join()
        sessions.discard(transport)

    def serve() -> None:
        while not stopping.is_set():
            try:
                connection, _ = listener.accept()
            except TimeoutError:
                continue
            # accept() passes its time limit to the transport; paramiko sets its own.
            connection.settimeout(None)
            threading.Thread(target=session, args=(connection,), daemon=True).start()
        listener.close()
        for transport in tuple(sessions):
            transport.close()

    thread = threading.Thread(target=serve, name=f"sftp:{bound}", daemon=True)

    def stop() -> None:
        stopping.set()
        thread.join()

    thread.start()
    line = f"[{address}]:{bound} {key.get_name()} {key.get_base64()}"
    return Service(address, bound, user, password, line, stop)


def _login(user: str, password: str) -> "paramiko.ServerInterface":
    import paramiko
    from paramiko import common

    class Login(paramiko.ServerInterface):
        def get_allowed_auths(self, username: str) -> str:
            return "password"

        def check_auth_password(self, username: str, given: str) -> int:
            same = hmac.compare_digest(username.encode(), user.encode())
            same &= hmac.compare_digest(given.encode(), password.encode())
            return common.AUTH_SUCCESSFUL if same else common.AUTH_FAILED

        def check_channel_request(self, kind: str, chanid: int) -> int:
            if kind == "session":
                return common.OPEN_SUCCEEDED
            return common.OPEN_FAILED_ADMINISTRATIVELY_PROHIBITED

    return Login()


def _plain(path: str) -> Path:
    """Return a path of the client below the root: `..` stops there."""
    if "\0" in path:
        raise PermissionError(13, "NUL in a path", path)
    return Path(os.path.normpath("/" + path.lstrip("/"))).relative_to("/")


def _interface() -> "type[paramiko.SFTPServerInterface]":
    """File operations; made on first use, as importing paramiko is slow."""
    import paramiko
    from paramiko import SFTPAttributes, SFTPHandle
    from paramiko.sftp import SFTP_OK

    class Files(paramiko.SFTPServerInterface):
        def __init__(self, server: paramiko.ServerInterface, root: Path) -> None:
            super().__init__(server)
            self._root = root

        def _real(self, path: str) -> Path:
            """Return the file of a client's path.

            PermissionError if it lies outside.
            """
            resolved = (self._root / _plain(path)).resolve()
            if not resolved.is_relative_to(self._root):
                raise PermissionError(13, "outside HOME", path)
            return resolved

        def _entry(self, path: str) -> Path:
            """As `_real`, but keep a link at the end, to remove or rename it."""
            plain = _plain(path)
            return self._real(str(plain.parent)) / plain.name

        def canonicalize(self, path: str) -> str:
            return os.path.normpath("/" + path.lstrip("/"))

        def list_folder(self, path: str) -> list[SFTPAttributes] | int:
            try:
                folder = self._real(path)
                return [
                    SFTPAttributes.from_stat(entry.lstat(), entry.name)
                    for entry in sorted(folder.iterdir())
                ]
            except OSError as error:
                return _code(error)

        def stat(self, path: str) -> SFTPAttributes | int:
            try:
                return SFTPAttributes.from_stat(self._real(path).stat())
            except OSError as error:
                return _code(error)

        def lstat(self, path: str) -> SFTPAttributes | int:
            try:
                return SFTPAttributes.from_stat(self._entry(path).lstat())
            except OSError as error:
                return _code(error)

        def open(self, path: str, flags: int, attr: SFTPAttributes) -> SFTPHandle | int:
            try:
                descriptor = os.open(self._real(path), flags | os.O_NOFOLLOW, 0o666)
            except OSError as error:
                return _code(error)
            writing = flags & (os.O_WRONLY | os.O_RDWR)
            try:
                file = os.fdopen(descriptor, "r+b" if writing else "rb", buffering=0)
            except IsADirectoryError as error:
                os.close(descriptor)
                return _code(error)
            handle = SFTPHandle(flags)
            # The two names that paramiko's SFTPHandle uses to read and write.
            setattr(handle, "readfile", file)  # noqa: B010
            setattr(handle, "writefile", file)  # noqa: B010
            return handle

        def remove(self, path: str) -> int:
            return _done(lambda: self._entry(path).unlink())

        def mkdir(self, path: str, attr: SFTPAttributes) -> int:
            return _done(lambda: self._entry(path).mkdir())

        def rmdir(self, path: str) -> int:
            return _done(lambda: self._entry(path).rmdir())

        def rename(self, oldpath: str, newpath: str) -> int:
            def move() -> None:
                new = self._entry(newpath)
                if new.exists():
                    raise FileExistsError(17, "the new name is taken", newpath)
                self._entry(oldpath).rename(new)

            return _done(move)

        def posix_rename(self, oldpath: str, newpath: str) -> int:
            return _done(lambda: self._entry(oldpath).replace(self._entry(newpath)))

    def _code(error: OSError) -> int:
        return paramiko.SFTPServer.convert_errno(error.errno or 0)

    def _done(action: Callable[[], object]) -> int:
        try:
            action()
        except OSError as error:
            return _code(error)
        return SFTP_OK

    return Files
