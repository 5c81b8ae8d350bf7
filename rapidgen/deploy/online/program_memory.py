"""Modules in the memory of tasks: saved with their persistents, unloaded, loaded.

A controller loads and unloads only while nothing is executed: background tasks, too [real 7.21].
"""

from contextlib import suppress
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from rapidgen.client.rws import RwsError
from rapidgen.deploy.driver_set import STATE
from rapidgen.deploy.file_operations import FileOperations, delete, delete_folder, write
from rapidgen.deploy.online.plan import MemoryModule, OnlinePlan, has_main
from rapidgen.deploy.online.snapshot import ControllerSnapshot
from rapidgen.deploy.transports.transport import Transport, TransportFault

if TYPE_CHECKING:
    from rapidgen.client.rws import Controller

UNLOADED = "unloaded"
"""Folder of the state folder: a folder for each task, with the modules that were unloaded."""
_SCRATCH = "rapidgen_saved"


def saved(transport: Transport, home: str, view: ControllerSnapshot) -> tuple[MemoryModule, ...]:
    """Modules that an earlier deployment saved, of tasks that are there. Raises TransportFault."""
    folder, result = f"{home}{STATE}/{UNLOADED}", []
    for task in _names(transport, folder):
        if any(t.name == task for t in view.tasks):
            result += [
                MemoryModule(task, PurePosixPath(name).stem, f"{folder}/{task}/{name}")
                for name in _names(transport, f"{folder}/{task}")
            ]
    return tuple(result)


def save(services: "Controller", work: FileOperations, module: MemoryModule) -> None:
    """Its text with the present values of its persistents, into the state folder; read back.

    Raises RobotError, TransportFault.
    """
    place = services.save_module(module.task, module.module, _SCRATCH)
    data = services.read_file(place)
    services.delete_file(place)
    ending = PurePosixPath(place).suffix
    path = f"{work.folder}/{UNLOADED}/{module.task}/{module.module}{ending}"
    write(work, path, data)


def rearrange(services: "Controller", work: FileOperations, live: OnlinePlan, wait: float) -> None:
    """Take out what goes, bring in what comes; every background task stands afterwards.

    `wait`: s for somebody else's mastership.

    Raises RobotError, TransportFault; DiagnosticError RG543 when a module is not where it should.
    """
    for module in live.clash:
        work.say(f"saving {module.shown}")
        save(services, work, module)
    if live.started:
        # What cannot be loaded shall not be stopped.
        with services.mastership("rapid", wait=wait):
            pass
        work.say(f"stopping {', '.join(live.started)}")
        services.stop(everything=True)
    with services.mastership("rapid", wait=wait):
        _leave(services, live)
        for module in (*live.clash, *live.unload):
            work.say(f"unloading {module.shown}")
            services.unload_module(module.task, module.module)
        for module in (*live.replace, *live.restore):
            work.say(f"loading {module.shown}")
            services.load_module(module.task, f"HOME/{module.path}", replace=True)


def _leave(services: "Controller", live: OnlinePlan) -> None:
    """Program pointers of tasks whose modules go to their main: what a stopped program stands in
    cannot be unloaded [code: a RobotWare 6 client]. Other tasks keep theirs."""
    # What is to be loaded again may lie there: the driver's own module of that name.
    tasks = {module.task for module in live.restore}
    lying = {(t, m.name.casefold()) for t in sorted(tasks) for m in services.modules(t)}
    again = [m for m in live.restore if (m.task, m.module.casefold()) in lying]
    for module in (*live.clash, *live.unload, *live.replace, *again):
        if has_main(services, module.task, module.module):
            # Refused where the program has errors: then no pointer stands in it either.
            with suppress(RwsError):
                services.set_pointer(module.task, module.module, "main")


def forget_saved(work: FileOperations, live: OnlinePlan) -> None:
    """Delete the saved modules that lie in their tasks again. Raises TransportFault."""
    for module in live.restore:
        delete(work, module.path)
    for task in dict.fromkeys(module.task for module in live.restore):
        delete_folder(work, f"{work.folder}/{UNLOADED}/{task}")
    if live.restore:
        delete_folder(work, f"{work.folder}/{UNLOADED}")


def _names(transport: Transport, folder: str) -> list[str]:
    try:
        return [entry.name for entry in transport.entries(folder)]
    except TransportFault as fault:
        if fault.kind != "missing":
            raise
        return []
