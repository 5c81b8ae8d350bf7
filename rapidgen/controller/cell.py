"""What stands around a controller and is in none of its generated files.

A configuration exposes signals of the cell to clients. They are the customer's: his own EIO.cfg
defines them, with units and bits, so that a generated one must not. Whoever boots a driver here
gets them as virtual signals of the types that the configuration names. So with a tool, a work
object or a load that a module of his declares.

With `main: own` the customer has a `main` that calls the driver. Where his is not there, one that
does nothing else stands in for it.
"""

from dataclasses import replace

from rapidgen.config.model import RobotConfig
from rapidgen.generate.context import data_of_another
from rapidgen.rapid import parse
from rapidgen.system.model import ModuleFile, SignalSpec, System, TaskSpec

GROUP_BITS = 32
"""Bits of an exposed group signal; the configuration does not tell how many there are."""
_MAIN = ModuleFile(
    "own_main",
    "own_main.mod",
    b"MODULE own_main\n    PROC main()\n        ROS_run;\n    ENDPROC\nENDMODULE\n",
)


def in_its_cell(system: System, config: RobotConfig) -> System:
    """`system` with what `config` leaves to the customer: signals and, where it is own, `main`.

    What the system has already stays as it is.
    """
    known = {signal.name.lower() for signal in system.signals}
    exposed = tuple(
        SignalSpec(signal.name, signal.kind, size=GROUP_BITS if signal.kind[0] == "G" else 1)
        for signal in config.signals
        if signal.name.lower() not in known
    )
    tasks = system.tasks if config.call_main else tuple(_with_main(t) for t in system.tasks)
    tasks = tuple(_with_data(task, config) for task in tasks)
    return replace(system, tasks=tasks, signals=(*system.signals, *exposed))


def _with_main(task: TaskSpec) -> TaskSpec:
    if not task.motion or any(_has_main(module) for module in task.modules):
        return task
    return replace(task, modules=(*task.modules, _MAIN))


def _with_data(task: TaskSpec, config: RobotConfig) -> TaskSpec:
    """A task with the data that its modules take from another module, unless one declares them."""
    group = next((g for g in config.groups if g.task == task.name), None)
    data = data_of_another(group) if group is not None and task.motion else []
    if not data:
        return task
    known = {d.name.casefold() for m in task.modules for d in parse(m.data, path=m.path).data}
    expected = [
        f"    PERS {kind} {name} := {value};\n"
        for kind, name, value in data
        if name.casefold() not in known
    ]
    if not expected:
        return task
    text = f"MODULE own_data\n{''.join(expected)}ENDMODULE\n".encode("ascii")
    return replace(task, modules=(*task.modules, ModuleFile("own_data", "own_data.mod", text)))


def _has_main(module: ModuleFile) -> bool:
    return any(r.name.casefold() == "main" for r in parse(module.data, path=module.path).routines)
