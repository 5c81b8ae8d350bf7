"""Modules in program memory: saved with persistents, unloaded, loaded.

A controller loads and unloads only while no task runs, including background tasks [real 7.21].
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
"""Folder of the state folder for unloaded modules, one folder a task."""
_SCRATCH = "rapidgen_saved"


def saved(transport: Transport, home: str, view: ControllerSnapshot) -> tuple[MemoryModule, ...]:
    """Return modules that an earlier deployment saved, of existing tasks.

    Raises TransportFault.
    """
    folder, result = f"{home}{STATE}/{UNLOADED}", []
    for task in _names(transport, folder):
        if any(t.name == task for t in view.tasks):
            result += [
                MemoryModule(task, PurePosixPath(name).stem, f"{folder}/{task}/{name}")
                for name in _names(transport, f"{folder}/{task}")
            ]
    return tuple(result)


def save(services: "Controller", work: FileOperations, module: MemoryModule) -> None:
    """Save a module with its current persistents, and read it back.

    It is saved in the state folder. Raises RobotError, TransportFault.
    """
    place = services.save_module(module.task, module.module, _SCRATCH)
    data = services.read_file(place)
    services.delete_file(place)
    ending = PurePosixPath(place).suffix
    path = f"{work.folder}/{UNLOADED}/{module.task}/{module.module}{ending}"
    write(work, path, data)


def rearrange(services: "Controller", work: FileOperations, live: OnlinePlan, wait: float) -> None:
    """Unload and load modules; background tasks are stopped afterwards.

    `wait`: s to wait for another client's mastership.

    Raises RobotError, TransportFault; DiagnosticError RG543 if a module is missing.
    """
    for module in live.clash:
        work.say(f"saving {module.shown}")
        save(services, work, module)
    if live.started:
        # Stop no task if loading is impossible.
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
    """Set pointers of tasks with unloaded modules to main.

    A module with the pointer of a stopped program cannot be unloaded [code: a RobotWare 6 client].
    Other tasks keep their pointers.
    """
    # The driver's own module of that name may be saved there, to be loaded again.
    tasks = {module.task for module in live.restore}
    lying = {(t, m.name.casefold()) for t in sorted(tasks) for m in services.modules(t)}
    again = [m for m in live.restore if (m.task, m.module.casefold()) in lying]
    for module in (*live.clash, *live.unload, *live.replace, *again):
        if has_main(services, module.task, module.module):
            # Refused if the program has errors: then no pointer is in it either.
            with suppress(RwsError):
                services.set_pointer(module.task, module.module, "main")


def forget_saved(work: FileOperations, live: OnlinePlan) -> None:
    """Delete saved modules that are loaded again. Raises TransportFault."""
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
