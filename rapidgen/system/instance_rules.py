"""Rules for cfg instances beyond attribute names: words, references."""

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass

from rapidgen.diagnostics import Diagnostic, Span, error, suggest
from rapidgen.system.cfg import CfgText, Instance
from rapidgen.system.cfg_schema import (
    INPUTS,
    OPEN_7,
    OUTPUTS_7,
    OUTPUTS_TO_6,
    SHELVES,
    TASK_TYPES,
    TRUST_LEVELS,
    SystemSignal,
)
from rapidgen.system.controller_cfg import ControllerCfg

_MAX_NAME = 32
"""Characters of a task's or signal's name [mem]."""


@dataclass(frozen=True, slots=True)
class Place:
    """An instance in its file, on the controller with all that is loaded."""

    cfg: ControllerCfg
    file: CfgText
    section: str
    instance: Instance
    open_words: bool = False

    def span(self) -> Span:
        """Return the start of the instance."""
        return Span(self.file.path, max(self.instance.line, 1), 1)

    def fault(self, message: str, help: str, *, code: str = "RG723") -> Diagnostic:
        """Return a fault without a known event."""
        marker = " [mem]" if code == "RG723" else ""
        return error(code, self.span(), f"{self.section}: {message}{marker}", help)

    def system_signal(self, message: str, help: str) -> Diagnostic:
        """Return a fault in a system input or output."""
        return self.fault(f"event 71391: {message}", help, code="RG722")

    def unknown_section(self) -> Diagnostic:
        """Return a fault: the release has no such section in this domain."""
        message = f"{self.file.domain} of RobotWare {self.cfg.robotware[0]} has no such section"
        if self.section.startswith("SYSSIG_"):
            where = "SYS" if self.cfg.robotware[0] >= 7 else "EIO"
            return self.system_signal(message, f"it belongs into {where}.cfg")
        return self.fault(message, "look at a backup of the release for the section's name")

    def unknown_attributes(self, known: Collection[str]) -> Iterator[Diagnostic]:
        """Yield attributes that no file of the release has."""
        for attribute in self.instance.attributes:
            if attribute.name.casefold() in known:
                continue
            message = f"-{attribute.name} is no attribute of it on this release"
            if self.section.startswith("SYSSIG_"):
                named = "Name" if self.cfg.robotware[0] >= 7 else "Signal"
                yield self.system_signal(message, f"the signal belongs in -{named}")
            else:
                yield self.fault(message, suggest(attribute.name, sorted(known)))

    def word(self, attribute: str, known: Collection[str]) -> Iterator[Diagnostic]:
        """Check that a given word is in a list."""
        value = self.instance.text(attribute)
        if value and value.casefold() not in {word.casefold() for word in known}:
            yield self.fault(
                f"-{attribute} '{value}' is not one of {', '.join(known)}",
                suggest(value, list(known)),
            )

    def named(self, attribute: str, known: Collection[str], what: str) -> Iterator[Diagnostic]:
        """Check that a given name exists; names have no case."""
        for source in self.instance.attributes:
            if source.name.casefold() != attribute.casefold():
                continue
            for value in source.values:
                if str(value).casefold() not in known:
                    yield self.fault(
                        f"there is no {what} '{value}'",
                        suggest(str(value), sorted(known)) or f"the controller has no {what} so",
                    )


def faults_of(place: Place) -> Iterator[Diagnostic]:
    """Yield the faults of an instance."""
    rule = _RULES.get(place.section)
    if rule is not None:
        yield from rule(place)


def _task(place: Place) -> Iterator[Diagnostic]:
    yield from _name(place)
    yield from place.word("Type", TASK_TYPES)
    yield from place.word("TrustLevel", TRUST_LEVELS)
    yield from place.named("Task_in_forground", place.cfg.tasks, "task")
    groups = place.cfg.unit_groups
    named = place.instance.text("UseMechanicalUnitGroup")
    if named and not groups:
        yield place.fault(
            "a controller without MultiMove has no mechanical unit groups",
            "leave -UseMechanicalUnitGroup out, as backups of eight such controllers do",
        )
    elif groups:
        yield from place.named("UseMechanicalUnitGroup", groups, "mechanical unit group")
        if not named:
            yield place.fault(
                "with MultiMove every task names its mechanical unit group",
                "write -UseMechanicalUnitGroup, as every task of such backups does",
            )


def _module(place: Place) -> Iterator[Diagnostic]:
    if not place.instance.text("File"):
        yield place.fault("-File is missing", "name the module's file")
    yield from place.named("Task", place.cfg.tasks, "task")
    loaded = ("Task", "AllTask", "AllMotionTask", "Shared")
    if not any(a.name in loaded for a in place.instance.attributes):
        yield place.fault("no task loads the file", "write -Task, -AllTask or -Shared")


def _hook(place: Place) -> Iterator[Diagnostic]:
    # A missing routine is event 10051 at each start; the file is accepted [real 6.16].
    if not place.instance.text("Routine"):
        yield place.fault("-Routine is missing", "name a routine")
    if not place.instance.text("Shelf"):
        yield place.fault("-Shelf is missing", f"one of {', '.join(SHELVES)}")
    yield from place.word("Shelf", SHELVES)
    yield from place.named("Task", place.cfg.tasks, "task")


def _group(place: Place) -> Iterator[Diagnostic]:
    yield from _name(place)
    units = place.cfg.units
    yield from place.named("Robot", units, "mechanical unit")
    for n in range(1, 7):
        yield from place.named(f"MechanicalUnit_{n}", units, "mechanical unit")
    planners = place.cfg.names("MOC", "MOTION_PLANNER")
    yield from place.named("UseMotionPlanner", planners, "motion planner")


def _name(place: Place) -> Iterator[Diagnostic]:
    name = place.instance.text("Name")
    if not 0 < len(name) <= _MAX_NAME:
        yield place.fault(
            f"a name of {len(name)} characters", f"1 to {_MAX_NAME} characters are a name"
        )


def _signal(place: Place) -> Iterator[Diagnostic]:
    yield from _name(place)
    if not place.instance.text("SignalType"):
        yield place.fault("-SignalType is missing", "such as DO")
    yield from place.word("SignalType", ("DI", "DO", "GI", "GO", "AI", "AO"))


def _output(place: Place) -> Iterator[Diagnostic]:
    known: Mapping[str, SystemSignal] = OUTPUTS_TO_6
    if place.cfg.robotware[0] >= 7:
        known = {**OUTPUTS_7, **OPEN_7} if place.open_words else OUTPUTS_7
    yield from _system_signal(place, "Status", known, {"unit": "Arg1", "task": "Arg2"})


def _input(place: Place) -> Iterator[Diagnostic]:
    yield from _system_signal(place, "Action", INPUTS, {"unit": "Arg6", "task": "Arg7"})


def _system_signal(
    place: Place, attribute: str, known: Mapping[str, SystemSignal], where: Mapping[str, str]
) -> Iterator[Diagnostic]:
    instance = place.instance
    word = instance.text(attribute)
    row = known.get(word.casefold())
    if row is None:
        yield place.system_signal(
            f"-{attribute} '{word}' is not known on RobotWare {place.cfg.robotware[0]}",
            suggest(word, [r.name for r in known.values()])
            or f"known are {', '.join(r.name for r in known.values())}",
        )
        return
    yield from _driven(place, row)
    own = where.get(row.argument, "")
    for source in instance.attributes:
        if source.name.startswith("Arg") and source.name not in (own, *row.others):
            help = f"{row.name} has its {row.argument} in -{own}" if own else "leave it out"
            yield place.system_signal(f"{row.name} has no -{source.name}", help)
    value = instance.text(own) if own else ""
    if row.needed and not value:
        yield place.system_signal(f"{row.name} lacks its {row.argument}", f"write it in -{own}")
    names = place.cfg.tasks if row.argument == "task" else place.cfg.units
    if value and value.casefold() not in names:
        yield place.system_signal(
            f"{row.name}: there is no {row.argument} '{value}'",
            suggest(value, sorted(names)) or "take a name that the controller has",
        )


def _driven(place: Place, row: SystemSignal) -> Iterator[Diagnostic]:
    """Check that the signal exists and has the type of the status or action."""
    named = "Name" if place.cfg.robotware[0] >= 7 else "Signal"
    name = place.instance.text(named)
    signal = place.cfg.signal(name)
    if signal is None:
        yield place.system_signal(
            f"there is no signal '{name}'", "define it in EIO_SIGNAL of EIO.cfg"
        )
    elif signal.text("SignalType").upper() != row.kind:
        yield place.system_signal(
            f"{row.name} takes a {row.kind}, '{name}' is a {signal.text('SignalType')}",
            f"take a {row.kind}",
        )


_RULES: Mapping[str, Callable[[Place], Iterator[Diagnostic]]] = {
    "CAB_TASKS": _task,
    "CAB_TASK_MODULES": _module,
    "CAB_EXEC_HOOKS": _hook,
    "MECHANICAL_UNIT_GROUP": _group,
    "EIO_SIGNAL": _signal,
    "SYSSIG_OUT": _output,
    "SYSSIG_IN": _input,
}
