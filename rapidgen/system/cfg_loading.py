"""Load a cfg file onto a controller in mode "add", with its checks.

Events are those of a real controller: 120003 (digits of the header), 120006 (an instance that
exists), 71391 (a system input or output) [real 6.03]. If the event of a rejection is not known, or
there is no trial, the strictest reading is taken and marked [mem].
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from rapidgen.diagnostics import Diagnostic, Severity, Span, error
from rapidgen.system.base.releases import DOMAINS
from rapidgen.system.cfg import CfgText, Instance
from rapidgen.system.cfg_schema import sections
from rapidgen.system.controller_cfg import ControllerCfg
from rapidgen.system.instance_rules import Place, faults_of

# Attributes that identify an instance, if not the name. [mem] The same file, routine or signal may
# be in several instances (RARO, VInRoS): the other attributes distinguish them.
_IDENTITY = {
    "CAB_TASK_MODULES": ("File", "Task"),
    "CAB_EXEC_HOOKS": ("Routine", "Shelf", "Task"),
    "SYSSIG_OUT": ("Signal", "Name"),
    "SYSSIG_IN": ("Signal", "Name", "Action"),
    "EIO_CROSS": ("Name", "Res"),
}


@dataclass(frozen=True, slots=True)
class CfgFileLoad:
    """A file to load.

    `optional`: the controller may reject it as a whole.
    """

    file: CfgText
    optional: bool = False
    replace: bool = False
    """Mode "replace": existing instances are removed first."""
    ascii: bool = True
    """True if its text is ASCII."""


@dataclass(frozen=True, slots=True)
class LoadResult:
    """The controller after loading, with its messages."""

    cfg: ControllerCfg
    faults: tuple[Diagnostic, ...] = ()
    """Of required files: nothing was loaded."""
    notes: tuple[Diagnostic, ...] = ()
    """Of optional files, which were omitted as a whole."""


def add(
    base: ControllerCfg, files: Iterable[CfgFileLoad], *, open_words: bool = False
) -> LoadResult:
    """Load the files onto a controller, optional ones last.

    `open_words`: accept statuses without a confirmed spelling on RobotWare 7.
    """
    source = tuple(files)
    needed = [addition for addition in source if not addition.optional]
    cfg, faults = _loaded(base, needed, open_words)
    if faults:
        return LoadResult(base, faults)
    notes: list[Diagnostic] = []
    for addition in source:
        if addition.optional:
            cfg, result = _loaded(cfg, [addition], open_words)
            notes += _left_out(addition.file, result)
    return LoadResult(cfg, (), tuple(notes))


def faults_within(cfg: ControllerCfg, *, open_words: bool = False) -> tuple[Diagnostic, ...]:
    """Apply the same rules to an existing controller, as notes.

    The controller loaded its own cfg, so these are not errors.
    """
    findings: list[Diagnostic] = []
    for text in cfg.domains:
        findings += _header(cfg, text)
        for section in text.sections:
            for instance in section.instances:
                place = Place(cfg, text, section.name, instance, open_words)
                findings += faults_of(place)
    return tuple(map(_note, findings))


def _loaded(
    base: ControllerCfg, files: Iterable[CfgFileLoad], open_words: bool
) -> tuple[ControllerCfg, tuple[Diagnostic, ...]]:
    """Load the files together: one may name instances of another."""
    cfg = base
    faults: list[Diagnostic] = []
    for addition in files:
        text = addition.file
        faults += _header(base, text)
        if not addition.ascii:
            faults.append(_not_ascii(text))
        existing = list(_existing(cfg, text))
        if addition.replace:
            cfg = cfg.without(text.domain, [old for _, _, old in existing])
        else:
            faults += [_exists(text, name, new, old) for name, new, old in existing]
        faults += [_exists(text, name, new, old) for name, new, old in _twice(text)]
        cfg = cfg.plus(text)
    known = sections(base.robotware[0], multimove=bool(base.unit_groups))
    for addition in files:
        text = addition.file
        for section in text.sections:
            allowed = known.get((text.domain, section.name))
            for instance in section.instances:
                place = Place(cfg, text, section.name, instance, open_words)
                if allowed is None:
                    faults.append(place.unknown_section())
                    break
                faults += place.unknown_attributes(allowed)
                faults += faults_of(place)
    return (base, tuple(faults)) if faults else (cfg, ())


def _header(base: ControllerCfg, text: CfgText) -> Iterator[Diagnostic]:
    if text.domain not in DOMAINS:
        yield error(
            "RG723",
            Span(text.path, 1, 1),
            f"a controller has no domain {text.domain} [mem]",
            f"the domains are {', '.join(DOMAINS)}",
        )
        return
    expected = base.domain(text.domain).version
    # ABB's own examples on a 7.6 (DAP) have no digits at all.
    if text.version is not None and expected is not None and text.version != expected:
        yield error(
            "RG720",
            Span(text.path, 1, 1),
            f"event 120003: {text.domain} is written for {_digits(text.version)}",
            "build for the release of this controller: controller.robotware, or --backup",
            label=f"this controller (RobotWare {_release(base)}) requires {_digits(expected)}",
        )


def _digits(version: tuple[int, int]) -> str:
    return f"{version[0]}:{version[1]}"


def _release(cfg: ControllerCfg) -> str:
    return f"{cfg.robotware[0]}.{cfg.robotware[1]:02d}"


def _not_ascii(text: CfgText) -> Diagnostic:
    return error(
        "RG723",
        Span(text.path, 1, 1),
        "the file holds characters beyond ASCII [mem]",
        "write it with letters that every controller reads",
    )


def _existing(cfg: ControllerCfg, text: CfgText) -> Iterator[tuple[str, Instance, Instance]]:
    """Yield (section, instance of the file, existing instance)"""
    for section in text.sections:
        there = {
            identity(section.name, old): old for old in cfg.instances(text.domain, section.name)
        }
        for new in section.instances:
            old = there.get(identity(section.name, new))
            if old is not None:
                yield section.name, new, old


def _twice(text: CfgText) -> Iterator[tuple[str, Instance, Instance]]:
    there: dict[tuple[str, ...], Instance] = {}
    for section in text.sections:
        for instance in section.instances:
            key = (section.name, *identity(section.name, instance))
            if key in there:
                yield section.name, instance, there[key]
            there.setdefault(key, instance)


def identity(section: str, instance: Instance) -> tuple[str, ...]:
    """Return the identifying attributes of an instance, without case."""
    return tuple(instance.text(n).casefold() for n in _IDENTITY.get(section, ("Name",)))


def _exists(text: CfgText, section: str, new: Instance, old: Instance) -> Diagnostic:
    name = " ".join(part for part in identity_text(section, new) if part)
    return error(
        "RG721",
        Span(text.path, max(new.line, 1), 1),
        f"event 120006: {section} '{name}' exists",
        "omit the controller's instances: build with --backup, or rename it",
        label=f"the controller has it (line {old.line} of its {text.domain})",
    )


def identity_text(section: str, instance: Instance) -> tuple[str, ...]:
    """Return `identity` as written."""
    return tuple(instance.text(n) for n in _IDENTITY.get(section, ("Name",)))


def _left_out(text: CfgText, findings: Sequence[Diagnostic]) -> Iterator[Diagnostic]:
    if findings:
        first = findings[0]
        yield error(
            first.code,
            Span(text.path, 1, 1),
            f"counts as refused, whole: {first.message}",
            "no change needed: the driver works without it",
            notes=tuple(f"line {d.span.line}: {d.message}" for d in findings[1:] if d.span),
            severity=Severity.WARNING,
        )


def _note(findings: Diagnostic) -> Diagnostic:
    return replace(findings, severity=Severity.WARNING)
