"""State that all RWS handlers share.

The controller, permissions, and running jobs.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from rapidgen.controller.controller import VirtualController
from rapidgen.controller.runner import ControllerRunner
from rapidgen.machine.files import DiskFault
from rapidgen.runtime.queues import Queue
from rapidgen.runtime.text import literal_text
from rapidgen.servers.rws.mastership import Masterships
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse
from rapidgen.servers.rws.rmmp import ManualPrivilege
from rapidgen.servers.rws.sessions import Session
from rapidgen.servers.rws.subscriptions import Groups
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.codes import CODES, OK
from rapidgen.wire.rws.grants import GRANTS

MESSAGE_KINDS = ("IPC_SEND", "IPC_PACKAGE")
"""Kinds of messages, by `dipc-msgtype`."""


@dataclass(frozen=True, slots=True)
class ClientText:
    """Message from one client to another."""

    sender: str
    data: str
    command: str
    user: str
    kind: str


@dataclass(slots=True, eq=False)
class ClientQueue:
    """A queue that a client has made; tasks put their answers into `queue`."""

    name: str
    queue: Queue
    texts: deque[ClientText] = field(default_factory=deque)

    def __len__(self) -> int:
        return len(self.texts) + len(self.queue.messages)

    def take(self) -> ClientText | None:
        """Remove and return the first message; None if the queue is empty."""
        if self.texts:
            return self.texts.popleft()
        if not self.queue.messages:
            return None
        message = self.queue.messages.popleft()
        data = f"{message.type.name};{literal_text(message.value, message.type)}"
        return ClientText(message.sender, data, "0", f"{message.user:g}", MESSAGE_KINDS[1])


@dataclass(frozen=True, slots=True)
class Accounts:
    """Accounts that may log in.

    All users have all grants except `Default User`, which lacks those of `denied`.
    """

    users: dict[str, str]
    denied: frozenset[str] = frozenset()

    def granted(self, user: str) -> frozenset[str]:
        """Return a user's grants by UAS name."""
        return frozenset(GRANTS) - (self.denied if user == "Default User" else frozenset())


class RwsContext:
    """State of one server beyond its sessions."""

    groups: Groups
    """Subscriptions."""
    end_session: Callable[[Session], None]
    """Called when a user logs out."""
    sessions: Callable[[], tuple[Session, ...]]
    """Users logged in."""

    def __init__(
        self,
        controller_runner: ControllerRunner,
        generation: Generation,
        login: Accounts,
        *,
        strict: bool,
    ) -> None:
        self.runner = controller_runner
        self.generation = generation
        self.login = login
        self.strict = strict
        self.masters = self._new_masters()
        self.progress: dict[str, int] = {}
        """Result codes of jobs by number."""
        self.dialogs: dict[int, str] = {}
        """Answers to dialogs by number, until they are complete."""
        self.queues: dict[str, ClientQueue] = {}
        """Message queues of clients, by name in lower case."""
        self.chosen: dict[str, dict[str, str]] = {}
        """Clients' choices for jogging by mechanical unit: tool, wobj, ..."""
        self.led: set[str] = set()
        """Units in lead-through."""
        self.program_names: dict[str, str] = {}
        """Names of loaded program files, by task."""
        self.mode_lock = ""
        """Lock of the operating mode by a pin: `Temporary`, `Permanent` or empty."""

    @property
    def controller(self) -> VirtualController:
        """The running controller."""
        return self.runner.controller

    def _new_masters(self) -> Masterships:
        manual = ManualPrivilege(lambda: self.controller, lambda: self.runner.now)
        return Masterships(
            self.generation, lambda: self.controller.mode, manual, strict=self.strict
        )

    def restarted(self) -> None:
        """Drop all masterships and running jobs."""
        self.masters = self._new_masters()
        for state in (self.progress, self.dialogs, self.queues, self.chosen, self.led):
            state.clear()

    def started(self, refused: str) -> RwsResponse:
        """Return the answer to a job that has ended already.

        It is a refusal with a code's name, or a success. RWS 2.0, and a backup in RWS 1.0, answer
        202 with the address of the result.
        """
        number = str(len(self.progress) + 1)
        self.progress[number] = CODES[refused] if refused else OK
        return RwsResponse(202, headers=(("Location", f"/progress/{number}"),))

    def write_file(self, path: Path, data: bytes) -> bool:
        """Write a file of the controller's disks; return True if it is new.

        Raises RequestDenied.
        """
        new = not path.exists()
        try:
            self.controller.files.spend(len(data))
            path.write_bytes(data)
        except DiskFault as fault:
            raise RequestDenied(507, "E_NOT_ENOUGH_SPACE", str(fault)) from fault
        except OSError as fault:
            raise RequestDenied(404, "E_DIR_NOT_EXIST", fault.strerror or "") from fault
        return new


VOLUMES = ("HOME", "TEMP", "BACKUP", "RAMDISK")


def disk_path(context: "RwsContext", words: str, request: RwsRequest) -> Path:
    """Return the file of a path on a volume.

    The path is `$HOME/a`, `HOME/a`, `HOME:/a` or `/fileservice/...`. RequestDenied: it names no
    volume, or leads out of one.
    """
    text = words.removeprefix("/fileservice/").strip("/")
    first, _, remaining = text.partition("/")
    name = first.strip("$:").upper()
    if ":" in first.rstrip(":"):
        name, _, more = first.partition(":")
        name, remaining = name.strip("$").upper(), f"{more}/{remaining}".strip("/")
    if name not in VOLUMES:
        # RobotWare 6 and 7 differ here [VC 6.16, VC 7.21].
        if request.is_one:
            raise RequestDenied(404, "E_FAIL", f"no volume {first}")
        raise RequestDenied(400, "E_INVALID_PATH", f"no volume {first}")
    try:
        return context.controller.files.path(f"{name}:{remaining}")
    except DiskFault as fault:
        raise RequestDenied(400, "E_INVALID_PATH", str(fault)) from fault
