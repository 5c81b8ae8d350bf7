"""sftp:// - paramiko with a known host key.

Keys and agent are tried before the password.
"""

import errno
import logging
import stat
import struct
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import paramiko

from rapidgen.deploy.secrets import Credentials, redact
from rapidgen.deploy.transports.registry import Target
from rapidgen.deploy.transports.sftp_checks import CheckedClient
from rapidgen.deploy.transports.transport import (
    FILE_LIMIT,
    LISTING_LIMIT,
    Entry,
    Kind,
    TransportCapabilities,
    TransportFault,
    safe,
)

_GARBLED = (
    paramiko.SSHException,
    paramiko.SFTPError,
    struct.error,
    ValueError,
    IndexError,
    KeyError,
    TypeError,
    AttributeError,
    OverflowError,
)
"""Exceptions of paramiko for invalid SFTP answers.

tests/deploy/test_hostile_sftp.py produces SSHException, SFTPError and ValueError (text that is not
UTF-8); paramiko's indexing and unpacking could raise the others, which were not observed.
"""


_NOTHING_TO_SHOW = "No authentication methods available"
"""paramiko's text for a login without password, key and agent.

It has no exception for it.
"""


class SftpTransport:
    """One SFTP session.

    `home` is absolute on the server; '' is the folder of the login.
    """

    services = None
    reach = TransportCapabilities(
        rename="posix-rename over the old file (atomic) where the server has it",
        writes_cfg=False,
        unseen=("loaded configuration, tasks, operating mode and running programs are not seen",),
    )

    def __init__(self, target: Target, login: Credentials, timeout: float) -> None:
        """Connect and log in. Raises TransportFault (RG501..RG506)."""
        host, port, home = target.host, target.port, target.path
        self.shown = target.shown
        self._login = login
        self._dead = False
        # Failures are raised; paramiko's own log would print them a second time.
        logging.getLogger("paramiko").addHandler(logging.NullHandler())
        self._client = paramiko.SSHClient()
        self._client.set_missing_host_key_policy(_Unknown(self.shown))
        try:
            self._connect(host, port, timeout)
            with self._faults("opening SFTP"):
                self._sftp = sftp = self._open(timeout)
            with self._faults(home or "the login folder"):
                self._home = (sftp.normalize(home or ".")).rstrip("/")
                if not stat.S_ISDIR(sftp.stat(self._home or "/").st_mode or 0):
                    raise TransportFault("missing", f"{home} is not a folder")
        except TransportFault:
            self.close()
            raise

    def _connect(self, host: str, port: int, timeout: float) -> None:
        login = self._login
        _readable("--known-hosts", login.known_hosts, "RG503")
        _readable("--identity", login.identity, "RG502")
        try:
            if login.known_hosts:
                self._client.load_host_keys(login.known_hosts)
            else:
                self._client.load_system_host_keys()
            self._client.connect(
                host,
                port,
                login.user or None,
                login.password.get() or None,
                key_filename=login.identity or None,
                timeout=timeout,
                banner_timeout=timeout,
                auth_timeout=timeout,
                channel_timeout=timeout,
            )
        except paramiko.BadHostKeyException as error:
            raise TransportFault(
                "login",
                f"the host key of {self.shown} has changed: {_print(error.key)}, "
                f"known is {_print(error.expected_key)}",
                code="RG503",
                help="find out why (a new controller, or an attacker in between); then "
                f"`ssh-keygen -R {_name(host, port)}` and accept the new key",
            ) from None
        except paramiko.AuthenticationException as error:
            raise TransportFault(
                "login", f"{self.shown} refuses the login: {redact(str(error), login)}"
            ) from None
        except (paramiko.SSHException, EOFError, OSError, *_GARBLED) as error:
            if isinstance(error, TransportFault):
                raise
            if str(error) == _NOTHING_TO_SHOW:
                raise TransportFault(
                    "login", f"{self.shown}: there is neither a password nor a key to log in with"
                ) from None
            raise TransportFault(
                "lost",
                f"cannot reach {self.shown}: {redact(str(error), login)[:300]}",
                code="RG501",
                help="check address, cable and firewall; `rapidgen doctor` looks further",
            ) from None

    def _open(self, timeout: float) -> CheckedClient:
        line = self._client.get_transport()
        if line is None:
            raise EOFError
        channel = line.open_session(timeout=timeout)
        channel.settimeout(timeout)
        # For the answer to this one request paramiko would wait without end.
        late = threading.Event()

        def give_up() -> None:
            late.set()
            line.close()

        clock = threading.Timer(timeout, give_up)
        clock.start()
        try:
            channel.invoke_subsystem("sftp")
        except paramiko.SSHException:
            if late.is_set():
                raise TimeoutError("no answer to the request for SFTP") from None
            raise
        finally:
            clock.cancel()
        return CheckedClient(channel)

    def entries(self, folder: str) -> tuple[Entry, ...]:
        with self._faults(folder or "HOME"):
            result = []
            self._sftp.names = 0
            for item in self._sftp.listdir_attr(f"{self._home}/{folder}".rstrip("/") or "/"):
                name = item.filename
                if name in (".", "..", "") or "/" in name or not name.isprintable():
                    continue
                mode = item.st_mode
                is_folder = None if mode is None else stat.S_ISDIR(mode)
                result.append(Entry(name, None if is_folder else item.st_size, is_folder))
                if len(result) > LISTING_LIMIT:
                    raise TransportFault("garbled", f"too many files in {folder or 'HOME'}")
        return tuple(sorted(result, key=lambda e: e.name))

    def read(self, path: str) -> bytes:
        result = bytearray()
        with self._faults(path), self._sftp.open(self._full(path), "rb") as file:
            while block := file.read(32768):
                result += block
                if len(result) > FILE_LIMIT:
                    raise TransportFault("garbled", f"{path} is larger than 8 MB")
        return bytes(result)

    def write(self, path: str, data: bytes) -> None:
        with self._faults(path), self._sftp.open(self._full(path), "wb") as file:
            file.set_pipelined(True)
            file.write(data)

    def rename(self, old: str, new: str) -> None:
        with self._faults(old):
            try:
                self._sftp.posix_rename(self._full(old), self._full(new))
            except OSError as error:
                # A server without the extension answers "unsupported"; the plain rename of
                # version 3 refuses an existing name.
                if error.errno is not None or "nsupported" not in str(error):
                    raise
                self._sftp.rename(self._full(old), self._full(new))

    def delete(self, path: str) -> None:
        with self._faults(path):
            self._sftp.remove(self._full(path))

    def make_folder(self, path: str) -> None:
        done = ""
        for part in safe(path).split("/"):
            names = {e.name for e in self.entries(done) if e.folder is not False}
            done = f"{done}/{part}".lstrip("/")
            if part not in names:
                with self._faults(done):
                    self._sftp.mkdir(self._full(done))

    def delete_folder(self, path: str) -> None:
        with self._faults(path):
            self._sftp.rmdir(self._full(path))

    def free(self) -> int | None:
        return None

    def close(self) -> None:
        self._dead = True
        self._client.close()

    def _full(self, path: str) -> str:
        return f"{self._home}/{safe(path)}"

    @contextmanager
    def _faults(self, place: str) -> Iterator[None]:
        """Turn every failure of paramiko into a TransportFault."""
        if self._dead:
            raise TransportFault("lost", f"{place}: the connection has ended")
        try:
            yield
        except TransportFault:
            raise
        except (EOFError, TimeoutError, ConnectionError) as error:
            self.close()
            late = isinstance(error, TimeoutError)
            reason = str(error) or ("timed out" if late else "the connection was closed")
            raise TransportFault("lost", f"{place}: {reason}") from None
        except OSError as error:
            text = redact(error.strerror or str(error), self._login)
            if "closed" in text.lower():
                self.close()
                raise TransportFault("lost", f"{place}: {text}") from None
            raise TransportFault(_kind(error, text), f"{place}: the server says: {text}") from None
        except _GARBLED as error:
            self.close()
            text = redact(str(error), self._login)
            raise TransportFault("garbled", f"{place}: senseless answer: {text[:200]}") from None


class _Unknown(paramiko.MissingHostKeyPolicy):
    """Refuses an unknown key, and shows its fingerprint and how to accept it."""

    def __init__(self, displayed: str) -> None:
        self._shown = displayed

    def missing_host_key(
        self, client: paramiko.SSHClient, hostname: str, key: paramiko.PKey
    ) -> None:
        raise TransportFault(
            "login",
            f"the host key of {self._shown} is not known: {_print(key)}",
            code="RG503",
            help="compare it with the controller's, then add it to known_hosts:\n"
            f"{hostname} {key.get_name()} {key.get_base64()}",
        )


def _readable(option: str, path: str, code: str) -> None:
    """Refuse a missing local file before it is taken for a connection fault."""
    try:
        if path:
            open(path, "rb").close()
    except OSError as error:
        raise TransportFault(
            "login",
            f"{option} {path}: {error.strerror or error}",
            code=code,
            help="name a file that is there and can be read",
        ) from None


def _print(key: paramiko.PKey) -> str:
    return f"{key.get_name()} {key.fingerprint}"


def _name(host: str, port: int) -> str:
    return host if port == 22 else f"'[{host}]:{port}'"


def _kind(error: OSError, text: str) -> Kind:
    lowered = text.lower()
    if error.errno == errno.ENOENT:
        return "missing"
    if error.errno in (errno.ENOSPC, errno.EDQUOT) or "space" in lowered or "quota" in lowered:
        return "full"
    return "unsupported" if "unsupported" in lowered else "denied"
