"""What loose modules take from their cell and do not declare: signals, tools, work objects.

A public repository seldom has the controller's configuration beside its modules. A signal gets
the type of the parameter that it is passed to, one that is only read in expressions is a DI;
tools, work objects and loads are declared, as tool0, wobj0 and load0, in a module of the trial.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from rapidgen.rapid import parse
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.system.model import ModuleFile, SignalSpec, System

_GIVEN = {"tooldata": "tool0", "wobjdata": "wobj0", "loaddata": "load0"}


@dataclass
class Cell:
    """Names that a system uses and nobody declares."""

    signals: dict[str, SignalSpec] = field(default_factory=dict)
    data: dict[str, str] = field(default_factory=dict)
    """Tools, work objects and loads: type by name."""
    lost: dict[str, str] = field(default_factory=dict)
    """Data of other types that are in no module: they are not made up."""

    def __str__(self) -> str:
        kinds = Counter(s.type for s in self.signals.values()) + Counter(self.data.values())
        return ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items()))


def furnish(system: System) -> tuple[System, Cell]:
    """The system with the signals, tools and work objects that its modules lack."""
    cell = Cell()
    known = {s.name.lower() for s in system.signals} | set(signatures.predefined())
    known |= {f"{task.name.lower()}id" for task in system.tasks} | {"rob_1", "rob_2"}
    tasks = []
    for task in system.tasks:
        trees = [parse(m.data, path=m.path) for m in task.modules]
        own = dict(_missing([t for t in trees if t.name], known))
        made = {name: kind for name, kind in own.items() if kind in _GIVEN}
        for name, kind in own.items():
            if kind.startswith("signal"):
                size = 8 if kind[6] == "g" else 1
                cell.signals[name.lower()] = SignalSpec(name, kind[6:].upper(), size=size)
            elif kind not in _GIVEN:
                cell.lost[name] = kind
        cell.data |= made
        if made:
            lines = [
                f"  TASK PERS {kind} {name} := {_VALUES[kind]};" for name, kind in made.items()
            ]
            text = "\n".join(["MODULE TrialCell", *lines, "ENDMODULE", ""]).encode("latin-1")
            module = ModuleFile("TrialCell", "TrialCell.mod", text)
            task = replace(task, modules=(*task.modules, module))
        tasks.append(task)
    signals = (*system.signals, *cell.signals.values())
    return replace(system, tasks=tuple(tasks), signals=signals), cell


_FRAME = "[[0,0,0],[1,0,0,0]]"
_LOAD = "[0.001,[0,0,0.001],[1,0,0,0],0,0,0]"
_VALUES = {
    "tooldata": f"[TRUE,{_FRAME},{_LOAD}]",
    "wobjdata": f'[FALSE,TRUE,"",{_FRAME},{_FRAME}]',
    "loaddata": _LOAD,
}


def _missing(modules: list[n.Module], known: set[str]) -> Iterator[tuple[str, str]]:
    """(name, type) of every datum that is used and not declared; the first use decides."""
    routines = {r.name.lower(): r for m in modules for r in m.routines}
    declared = known | {
        d.name.lower()
        for m in modules
        for d in m.declarations
        if not isinstance(d, n.PlaceholderDeclaration)
    }
    found: dict[str, tuple[str, str]] = {}
    for module in modules:
        for routine in module.routines:
            here = declared | {d.name.lower() for d in routine.data}
            here |= {p.name.lower() for p in routine.parameters}
            nodes = list(walk(routine))
            here |= {node.variable.lower() for node in nodes if isinstance(node, n.For)}
            for name, kind in _uses(nodes, routines):
                if name.lower() not in here:
                    before = found.get(name.lower())
                    if before is None or (before[1] == "" and kind):
                        found[name.lower()] = (name, kind)
    for name, kind in found.values():
        yield name, kind or "signaldi"


def _uses(
    nodes: list[n.Node], routines: dict[str, n.RoutineDeclaration]
) -> Iterator[tuple[str, str]]:
    for node in nodes:
        if isinstance(node, n.ProcedureCall | n.FunctionCall):
            called = routines.get(node.name.lower()) or signatures.routine(node.name.lower())
            if called is not None:
                yield from _arguments(node.arguments, list(called.parameters))
        elif isinstance(node, n.Binary):
            for side in (node.left, node.right):
                if isinstance(side, n.Name):
                    yield side.name, ""


def _arguments(
    arguments: list[n.Argument], parameters: list[n.Parameter]
) -> Iterator[tuple[str, str]]:
    """Plain names among the arguments, with the types of their parameters."""
    by_name = {p.name.lower(): p for p in parameters}
    required: list[n.Parameter] = []
    for p in parameters:
        alternative = p.group >= 0 and required and required[-1].group == p.group
        if not p.optional and not alternative:
            required.append(p)
    waiting = iter(required)
    for argument in arguments:
        if argument.kind == "required" and not argument.name:
            parameter = next(waiting, None)
        else:
            parameter = by_name.get((argument.name or "").lower())
        if isinstance(argument.value, n.Name) and parameter is not None:
            kind = parameter.type.lower()
            yield argument.value.name, "" if kind == "anytype" else kind
