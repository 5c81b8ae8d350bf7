"""Objects outside the generated files that belong to the customer.

A configuration exposes signals of the cell to clients. The customer's EIO.cfg defines them with
units and bits, so a generated file must not. Booting a driver on the virtual controller creates
virtual signals of the configured types instead. The same applies to tools, work objects and loads
declared in a module of the customer.

With `main: own` the customer has a `main` that calls the driver. If it is missing, a `main` with
only this call replaces it.

Only the boot of a driver imports this module, because `generate` takes long to import.
"""

from dataclasses import replace

from rapidgen.config.model import RobotConfig
from rapidgen.generate.context import data_of_another
from rapidgen.rapid import parse
from rapidgen.system.model import ModuleFile, SignalSpec, System, TaskSpec

GROUP_BITS = 32
"""Bits of an exposed group signal; the configuration does not contain the number."""
_MAIN = ModuleFile(
    "own_main",
    "own_main.mod",
    b"MODULE own_main\n    PROC main()\n        ROS_run;\n    ENDPROC\nENDMODULE\n",
)


def in_its_cell(system: System, config: RobotConfig) -> System:
    """Return `system` with the objects that `config` leaves to the customer.

    These are signals and, where configured, `main`. Existing objects stay unchanged.
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
    """Return a task with the data that its modules expect elsewhere.

    Declared data stay unchanged.
    """
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
