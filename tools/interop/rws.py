"""Robot Web Services as Python calls instead of HTTP.

`Face` has the methods of `abb_robot_client.rws.RWS` that public clients use. A trial that is not
about HTTP replaces that class by it, and everything else of the client stays unchanged;
`tests/servers/rws/test_foreign_clients.py` tests the class itself with the HTTP server.
"""

from collections import namedtuple
from datetime import datetime, timezone

from rapidgen.controller import VirtualController

_Execution = namedtuple("_Execution", "ctrlexecstate cycle")
_Entry = namedtuple("_Entry", "seqnum msgtype code tstamp args title desc conseqs causes actions")


class Face:
    """One controller, called from another thread.

    `/x` names are those of RAMDISK:.
    """

    def __init__(self, controller: VirtualController) -> None:
        self._controller = controller

    def _do(self, action):
        return self._controller.call(action)

    def _running(self) -> bool:
        tasks = self._controller.rapid_tasks.values()
        return any(t.state == "running" for t in tasks if t.spec.type == "NORMAL")

    # -- execution ---------------------------------------------------------------------------

    def get_execution_state(self):
        running = self._do(self._running)
        return _Execution("running" if running else "stopped", "once")

    def get_controller_state(self) -> str:
        return "motoron" if self._do(lambda: self._controller.motors_on) else "motoroff"

    def resetpp(self) -> None:
        self._do(self._controller.pp_to_main)

    def start(self, cycle="asis", tasks=("T_ROB1",)) -> None:
        assert cycle == "once"
        assert self._do(self._controller.start_program), "the start was refused"

    def stop(self) -> None:
        self._do(self._controller.stop_program)

    # -- files, signals, log -----------------------------------------------------------------

    def get_ramdisk_path(self) -> str:
        return "RAMDISK:"

    def _path(self, name: str):
        return self._controller.files.path(name)

    def upload_file(self, name: str, contents: bytes) -> None:
        self._do(lambda: self._path(name).write_bytes(contents))

    def read_file(self, name: str) -> bytes:
        return self._do(lambda: self._path(name).read_bytes())

    def delete_file(self, name: str) -> None:
        self._do(lambda: self._path(name).unlink())

    def get_analog_io(self, signal: str) -> float:
        return self._do(lambda: self._controller.signals[signal])

    def set_analog_io(self, signal: str, value: float) -> None:
        self._do(lambda: self._controller.signals.__setitem__(signal, value))

    get_digital_io, set_digital_io = get_analog_io, set_analog_io

    def read_event_log(self, elog: int = 0):
        """Return the event log, newest first.

        The first argument of an ErrWrite event is its header.
        """
        events = self._do(lambda: list(self._controller.log))
        now = datetime.now(timezone.utc)
        return [
            _Entry(e.sequence, int(e.type), e.code, now, [e.title, *e.texts], e.title, *[""] * 4)
            for e in reversed(events)
        ]
