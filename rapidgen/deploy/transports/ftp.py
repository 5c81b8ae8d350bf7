"""ftp:// - the standard library's ftplib, passive, binary, bounded.

ftplib trusts the amount and pace of a server's text; here a line, an answer, a listing, a file and
the time for each are limited. Data connections go to the requested host (ftplib ignores the address
in the answer to PASV). Only RETR, STOR, LIST or NLST, CWD, MKD, RMD, DELE and, if available, MLSD
and RNFR/RNTO are needed.
"""

import ftplib
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rapidgen.deploy.secrets import Credentials, redact
from rapidgen.deploy.transports.listing import parse_facts, parse_list, parse_names
from rapidgen.deploy.transports.registry import Target
from rapidgen.deploy.transports.transport import (
    FILE_LIMIT,
    LISTING_LIMIT,
    Entry,
    Kind,
    TransportCapabilities,
    TransportFault,
    parent,
    safe,
)

_ANSWER_LINES = 500
_LISTING_BYTES = 4 * 1024 * 1024
_SPACE_WORDS = (
    "no space",
    "disk full",
    "quota exceeded",
    "disk quota",
    "insufficient",
    "not enough",
)


class FtpTransport:
    """One FTP session.

    `home` is absolute on the server; '' is the folder of the login.
    """

    services = None
    reach = TransportCapabilities(
        rename="detected at deploy: rename over, delete and rename, or overwriting in place",
        writes_cfg=False,
        unseen=(
            "loaded configuration, tasks, operating mode and running programs are not seen",
            "FTP is not encrypted: password and modules can be read and changed in transit",
        ),
    )

    def __init__(self, target: Target, login: Credentials, timeout: float) -> None:
        """Connect and log in. Raises TransportFault (RG501, RG502, RG504..RG506)."""
        host, port, home = target.host, target.port, target.path
        self.shown = target.shown
        self._login = login
        self._timeout = timeout
        self._dead = False
        self._ftp = _Session(timeout)
        self._facts = False
        try:
            with self._faults("connecting"):
                self._ftp.connect(host, port, timeout)
        except TransportFault as fault:
            self.close()
            raise TransportFault(
                fault.kind,
                f"cannot reach {self.shown}: {fault.diagnostics[0].message}",
                code="RG501",
                help="check address, cable and firewall; `rapidgen doctor` looks further",
            ) from fault
        try:
            with self._faults("logging in", login=True):
                self._ftp.login(login.user, login.password.get())
            with self._faults("binary mode"):
                self._ftp.voidcmd("TYPE I")
            self._facts = self._has_facts()
            with self._faults(home or "the login folder"):
                if home:
                    self._ftp.cwd(home)
                self._home = self._ftp.pwd().rstrip("/")
        except TransportFault:
            self.close()
            raise

    def entries(self, folder: str) -> tuple[Entry, ...]:
        with self._faults(folder or "HOME", folder):
            self._ftp.cwd(f"{self._home}/{folder}".rstrip("/") or "/")
            if self._facts:
                return parse_facts(self._lines("MLSD"))
            lines = self._lines("LIST")
            entries = parse_list(lines)
            return parse_names(self._lines("NLST")) if entries is None else entries

    def read(self, path: str) -> bytes:
        with self._faults(path, path):
            return self._fetch(f"RETR {self._full(path)}", FILE_LIMIT)

    def write(self, path: str, data: bytes) -> None:
        with self._faults(path, path), self._deadline():
            with self._ftp.transfercmd(f"STOR {self._full(path)}") as connection:
                connection.settimeout(self._timeout)
                connection.sendall(data)
            self._ftp.voidresp()

    def rename(self, old: str, new: str) -> None:
        with self._faults(old, old):
            self._ftp.rename(self._full(old), self._full(new))

    def delete(self, path: str) -> None:
        with self._faults(path, path):
            self._ftp.delete(self._full(path))

    def make_folder(self, path: str) -> None:
        done = ""
        for part in safe(path).split("/"):
            names = {e.name for e in self.entries(done) if e.folder is not False}
            done = f"{done}/{part}".lstrip("/")
            if part not in names:
                with self._faults(done):
                    self._ftp.mkd(self._full(done))

    def delete_folder(self, path: str) -> None:
        with self._faults(path, path):
            self._ftp.cwd(self._home or "/")
            self._ftp.rmd(self._full(path))

    def free(self) -> int | None:
        return None

    def close(self) -> None:
        self._dead = True
        self._ftp.close()

    def _full(self, path: str) -> str:
        return f"{self._home}/{safe(path)}"

    def _has_facts(self) -> bool:
        try:
            with self._faults("features"):
                return "MLST" in self._ftp.sendcmd("FEAT").upper()
        except TransportFault as fault:
            if fault.kind in ("lost", "garbled"):
                raise
            return False

    def _lines(self, command: str) -> list[str]:
        data = self._fetch(command, _LISTING_BYTES)
        try:
            text = data.decode("utf-8")
        except UnicodeDecodeError:
            text = data.decode("latin-1")
        lines = text.split("\n")
        if len(lines) > LISTING_LIMIT:
            raise ftplib.error_proto("too many files in one folder")
        return [line for line in lines if line.strip()]

    def _fetch(self, command: str, limit: int) -> bytes:
        result = bytearray()
        with self._deadline() as left:
            with self._ftp.transfercmd(command) as connection:
                while True:
                    connection.settimeout(min(self._timeout, left()))
                    block = connection.recv(65536)
                    if not block:
                        break
                    result += block
                    if len(result) > limit:
                        raise ftplib.error_proto(f"more than {limit} bytes")
            self._ftp.voidresp()
        return bytes(result)

    @contextmanager
    def _deadline(self) -> Iterator[Callable[[], float]]:
        """Return the s left for one transfer.

        So a slow server cannot block us for ever.
        """
        end = time.monotonic() + 6 * self._timeout

        def left() -> float:
            seconds = end - time.monotonic()
            if seconds <= 0:
                raise TimeoutError("timed out")
            return seconds

        yield left

    @contextmanager
    def _faults(
        self, place: str, path: str | None = None, *, login: bool = False
    ) -> Iterator[None]:
        """Turn every failure of ftplib into a TransportFault."""
        if self._dead:
            raise TransportFault("lost", f"{place}: the connection has ended")
        try:
            yield
        except TransportFault:
            raise
        except (ftplib.error_perm, ftplib.error_temp) as error:
            text = redact(str(error), self._login)
            kind = self._kind(str(error), path, login=login)
            if kind == "lost":
                self.close()
            raise TransportFault(kind, f"{place}: the server says: {text}") from None
        except (EOFError, OSError) as error:
            self.close()
            words = getattr(error, "strerror", None) or str(error)
            reason = redact(words, self._login) or "the connection was closed"
            raise TransportFault("lost", f"{place}: {reason}") from None
        except UnicodeEncodeError:
            # Its text has the letter, and that may be one of a password.
            raise TransportFault(
                "login" if login else "denied",
                f"{place}: a letter that FTP does not carry (it has those of latin-1)",
            ) from None
        except (ftplib.Error, ValueError, IndexError, OverflowError) as error:
            # After an invalid answer the next one may belong to any command.
            self.close()
            text = redact(str(error), self._login)
            raise TransportFault("garbled", f"{place}: senseless answer: {text[:200]}") from None

    def _kind(self, answer: str, path: str | None, *, login: bool) -> Kind:
        code = answer[:3]
        if login:
            return "login" if code.startswith("5") else "lost"
        # Servers repeat the path, and a path may hold any word.
        text = answer.replace(path, "").lower() if path else answer.lower()
        if code in ("452", "552") or any(word in text for word in _SPACE_WORDS):
            return "full"
        if code in ("500", "501", "502", "503", "504", "202"):
            return "unsupported"
        if code in ("421", "425", "426"):
            return "lost"
        if code in ("550", "450", "553") and path is not None and self._is_missing(path):
            return "missing"
        return "denied"

    def _is_missing(self, path: str) -> bool:
        """True if a file is missing.

        550 means "missing" and "not allowed" alike: the folder's listing decides.
        """
        if not path:
            return True
        try:
            return path.rpartition("/")[2] not in {e.name for e in self.entries(parent(path))}
        except TransportFault as fault:
            if fault.kind in ("lost", "garbled"):
                raise
            return True


class _Session(ftplib.FTP):
    """ftplib with answers that are limited in lines and time."""

    def __init__(self, timeout: float) -> None:
        super().__init__(timeout=timeout, encoding="latin-1")
        self._allowed = 3 * timeout
        self._pending = b""

    def connect(self, host: str = "", port: int = 0, timeout: float = -999, *_: object) -> str:
        self._pending = b""
        return super().connect(host, port, timeout)

    def getline(self) -> str:
        """Read one line of an answer from the socket, with a time limit."""
        end = time.monotonic() + self._allowed
        while b"\n" not in self._pending:
            left = end - time.monotonic()
            if left <= 0:
                raise TimeoutError("timed out")
            if self.sock is None:
                raise EOFError
            self.sock.settimeout(min(left, self.timeout or left))
            block = self.sock.recv(4096)
            if not block:
                raise EOFError
            self._pending += block
            if len(self._pending) > self.maxline:
                raise ftplib.error_proto("answer line too long")
        line, _, self._pending = self._pending.partition(b"\n")
        return line.rstrip(b"\r").decode("latin-1")

    def getmultiline(self) -> str:
        line = self.getline()
        lines = [line]
        if line[3:4] == "-":
            code = line[:3]
            while not (lines[-1][:3] == code and lines[-1][3:4] != "-" and len(lines) > 1):
                lines.append(self.getline())
                if len(lines) > _ANSWER_LINES:
                    raise ftplib.error_proto("answer without end")
        return "\n".join(lines)
