"""rws://, rwss:// - HOME by the file service of Robot Web Services.

It offers more than files: `services` is the same controller's web services.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import PurePosixPath

from rapidgen.client.errors import ConnectionFailed, RobotError
from rapidgen.client.rws import Controller, RwsError
from rapidgen.client.rws.errors import LoginFailed, NotConfirmed, NotRws
from rapidgen.deploy.secrets import Credentials
from rapidgen.deploy.transports.registry import SCHEMES, Target
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
from rapidgen.diagnostics import refusal

_MISSING = ("E_DIR_NOT_EXIST", "E_FILE_NOT_FOUND")
_FULL = ("E_NOT_ENOUGH_SPACE", "E_DEVICE_FULL")


class RwsTransport:
    """Files below `folder` (`HOME`) of a controller, and its other services."""

    reach = TransportCapabilities(
        rename="delete, then rename (Robot Web Services only rename to a free name)",
        writes_cfg=False,
        unseen=(),
    )

    def __init__(self, services: Controller, displayed: str, folder: str = "HOME") -> None:
        self.services: Controller = services
        self.shown = displayed
        self._folder = folder
        self._made: set[str] = {""}

    def entries(self, folder: str) -> tuple[Entry, ...]:
        with _faults(folder or "HOME"):
            result = self.services.list_files(self._path(folder))
        if len(result) > LISTING_LIMIT:
            raise TransportFault("garbled", f"too many files in {folder or 'HOME'}")
        named = [Entry(f.name, None if f.is_folder else f.size, f.is_folder) for f in result]
        return tuple(sorted(named, key=lambda e: e.name))

    def read(self, path: str) -> bytes:
        with _faults(path):
            data = self.services.read_file(self._path(safe(path)))
        if len(data) > FILE_LIMIT:
            raise TransportFault("garbled", f"{path} is larger than 8 MB")
        return data

    def write(self, path: str, data: bytes) -> None:
        with _faults(path):
            self.services.write_file(self._path(safe(path)), data)

    def rename(self, old: str, new: str) -> None:
        if parent(safe(old)) != parent(safe(new)):
            raise TransportFault("unsupported", f"{old} stays in its folder")
        with _faults(old):
            self.services.rename_file(self._path(old), PurePosixPath(new).name)

    def delete(self, path: str) -> None:
        with _faults(path):
            there = self.services.delete_file(self._path(safe(path)))
        if not there:
            raise TransportFault("missing", f"{path}: there is no such file")

    def make_folder(self, path: str) -> None:
        """Create a folder and its parents: the service creates one at a time."""
        if path in self._made:
            return
        self.make_folder(parent(safe(path)))
        try:
            with _faults(path):
                self.services.make_folder(self._path(path))
        except TransportFault as fault:
            # Controllers report an existing file differently: check whether it exists.
            name = path.rpartition("/")[2].casefold()
            if fault.kind == "lost" or not any(
                e.folder and e.name.casefold() == name for e in self.entries(parent(path))
            ):
                raise
        self._made.add(path)

    def delete_folder(self, path: str) -> None:
        # The service deletes a folder with its content.
        if self.entries(path):
            raise TransportFault("denied", f"{path} is not empty")
        self._made.discard(path)
        self.delete(path)

    def free(self) -> int | None:
        return None

    def close(self) -> None:
        try:
            self.services.close()
        except RobotError:
            return

    def _path(self, path: str) -> str:
        return f"{self._folder}/{path}" if path else self._folder


def open_services(target: Target, login: Credentials, timeout: float) -> RwsTransport:
    """Log in.

    Raises TransportFault RG501, RG502, RG504; DiagnosticError RG509.
    """
    folder = target.path.strip("/") or "HOME"
    if folder.upper().lstrip("$") != "HOME":
        raise refusal(
            "RG509",
            None,
            f"--to {target.shown}: web services reach HOME as it is, without a folder",
            f"{target.scheme}://HOST[:PORT]",
        )
    host = f"[{target.host}]" if ":" in target.host else target.host
    port = "" if target.port == SCHEMES[target.scheme].port else f":{target.port}"
    services = Controller(
        f"{target.scheme}://{host}{port}",
        user=login.user,
        password=login.password.get(),
        fingerprint=login.fingerprint,
        confirm=login.agree,
        timeout=timeout,
    )
    with _faults(target.shown):
        services.connect()
    return RwsTransport(services, target.shown)


@contextmanager
def _faults(path: str) -> Iterator[None]:
    try:
        yield
    except RobotError as error:
        first = error.diagnostics[0]
        code = "RG501" if type(error) is ConnectionFailed else ""
        text = first.message if path in first.message else f"{path}: {first.message}"
        help_text = first.help if isinstance(error, LoginFailed) or code else ""
        raise TransportFault(_kind(error), text, code=code, help=help_text) from error


def _kind(error: RobotError) -> Kind:
    match error:
        case RwsError() if error.status == 404 or error.symbol in _MISSING:
            return "missing"
        case RwsError() if error.status == 507 or error.symbol in _FULL:
            return "full"
        case RwsError():
            return "denied"
        case LoginFailed():
            return "login"
        case NotRws() | NotConfirmed():
            return "garbled"
    return "lost"
