"""A controller over its restarts."""

import shutil
import tempfile
import threading
import uuid
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from rapidgen._compat import Self, Unpack
from rapidgen.controller.boot_targets import Bootable
from rapidgen.controller.controller import ControllerOptions, VirtualController
from rapidgen.controller.debugger.debugger import Debugger
from rapidgen.controller.editor_link import EditorLink
from rapidgen.controller.programs import Programs
from rapidgen.controller.warm_start import PersistedState, boot
from rapidgen.diagnostics import Diagnostic
from rapidgen.machine.files import copy_files
from rapidgen.system import read_backup
from rapidgen.system.backup import backup_cfg
from rapidgen.system.controller_cfg import ControllerCfg
from rapidgen.system.model import System

# -- Runs ------------------------------------------------------------------------------------------
#
# A controller with a power switch: the state that survives a restart, and its thread.
#
# A restart makes a new `VirtualController` from the disks, the cfg database and the modules in
# the tasks. Disks, cfg and clock stay; sockets, paths and program pointers do not.


_NS = 1_000_000_000


class RestoredBackup(NamedTuple):
    """Parts of a backup for the next restart."""

    kept: PersistedState
    cfg: ControllerCfg
    home: Path


class ControllerRunner:
    """A controller and its restarts.

    `controller` is the current one. All methods except `post`, `ask_restart` and `close` belong to
    the thread that runs it. DiagnosticError: the system cannot be booted.
    """

    def __init__(
        self,
        system: System,
        **options: Unpack[ControllerOptions],
    ) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="rapidgen-controller-"))
        self._remove = weakref.finalize(self, shutil.rmtree, self.folder, ignore_errors=True)
        self._options = options
        self._options["folder"] = self.folder
        self.id = str(uuid.uuid5(uuid.NAMESPACE_DNS, system.name)).upper()
        """Identifier of this controller, equal in every run."""
        self.restarts = 0
        self.editor = EditorLink()
        """Between its page and editors, which debug it."""
        self._debugger: Debugger | None = None
        self.on_restart: list[Callable[[], None]] = []
        """Called on the controller's thread before a restart, to end all connections."""
        self.on_boot: list[Callable[[], None]] = []
        """Called when the new controller is there."""
        self._before = 0
        self._restart_asked = False
        self._restored: RestoredBackup | None = None
        self._lock = threading.Lock()
        self._up = True
        self._thread: threading.Thread | None = None
        self._ended = False
        self.controller = VirtualController(system, **self._options)
        self.programs = Programs(self.controller)

    @classmethod
    def boot(cls, result: Bootable, **options: Unpack[ControllerOptions]) -> Self:
        """Boot a target of `load_target`, as `VirtualController.boot`."""
        options.setdefault("robots", result.groups)
        options.setdefault("surroundings", result.surroundings)
        return cls(result.system, **options)

    @property
    def cfg(self) -> ControllerCfg:
        """The cfg database of all domains; changes take effect at the next restart."""
        return self.controller.cfg.cfg

    @cfg.setter
    def cfg(self, cfg: ControllerCfg) -> None:
        self.controller.cfg.cfg = cfg

    @property
    def now(self) -> float:
        """The controller's time in s; it continues over restarts."""
        return (self._before + self.controller.scheduler.now) / _NS

    @property
    def debugger(self) -> Debugger:
        """The debugger of the current controller, which all its clients share.

        Breakpoints and selected errors survive a restart; its numbers do not.
        """
        if self._debugger is None:
            self._debugger = Debugger(self.controller)
        return self._debugger

    def post(self, function: Callable[[], None]) -> bool:
        """Run `function` on the controller's thread, from any thread.

        Returns False during a restart.
        """
        with self._lock:
            if self._up:
                self.controller.scheduler.post(function)
            return self._up

    def ask_restart(self) -> None:
        """Restart after the current work."""
        self._restart_asked = True

    def ask_restore(self, backup: Path) -> None:
        """Restart with modules, cfg and HOME of a backup.

        The robots and their positions stay. DiagnosticError: invalid backup.
        """
        notes: list[Diagnostic] = []
        system = read_backup(backup, notes=notes)
        cfg = backup_cfg(backup, self.controller.system.robotware, notes)
        self._restored = RestoredBackup(
            {t.name: t.modules for t in system.tasks}, cfg, backup / "HOME"
        )
        self.ask_restart()

    def run(self, finished: Callable[[], bool], wait: Callable[[], None] | None = None) -> None:
        """Let time pass, over restarts, until `finished()` is true.

        `wait` is called where the virtual clock cannot go on: it returns when something was posted
        or changed.
        """
        while not finished():
            end = self.controller.scheduler.advance(stop=lambda: finished() or self._restart_asked)
            if self._restart_asked:
                self._restart()
            elif end in ("idle", "paused") and wait is not None:
                wait()

    def _restart(self) -> None:
        with self._lock:
            self._up = False
        # Accepted functions run in any case, because their callers wait.
        self.controller.scheduler.run_posted()
        for tell in tuple(self.on_restart):
            tell()
        old, programs = self.controller, self.programs
        self._restart_asked = False
        self._before += old.scheduler.now
        persisted, cfg = programs.kept(), self.cfg
        old.close()
        if self._restored is not None:
            persisted, cfg, files = self._restored
            home = old.files.path("HOME:")
            shutil.rmtree(home)
            copy_files(files, home)
            self._restored = None
        self.restarts += 1
        self.controller, self.programs = boot(old, persisted, cfg, self._options)
        if self._debugger is not None:
            self._debugger = self._debugger.successor(self.controller)
        self._set_going()
        with self._lock:
            self._up = True
        for tell in tuple(self.on_boot):
            tell()

    # -- thread ----------------------------------------------------------------------------------

    def start(self) -> None:
        """Run in a separate thread from now on."""
        self._ended = False
        self._set_going()
        self._thread = threading.Thread(target=self._run_alone, name="controller", daemon=True)
        self._thread.start()

    def _run_alone(self) -> None:
        try:
            self.run(lambda: self._ended)
        finally:
            if not self._ended:
                # A fault has ended the thread. No caller may wait for it.
                with self._lock:
                    self._up = False

    def _set_going(self) -> None:
        """Let time pass; posted functions wake the scheduler from now on."""
        scheduler = self.controller.scheduler
        if scheduler.clock == "real":
            scheduler.rebase()
            assert scheduler.selector is not None

    def stop(self) -> None:
        """End the thread."""
        if self._thread is None:
            return
        self._ended = True
        self.post(lambda: None)
        self._thread.join()
        self._thread = None

    def close(self) -> None:
        """Stop and release all resources."""
        self.stop()
        self.controller.close()
        self._remove()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
