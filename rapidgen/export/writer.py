"""Write a description as a RAPID module through templates.

The text of a module is made in four steps:

1. `_Declarations` gives each speed and zone its name: RAPID's own if the values are equal, else
   that of a constant. Targets stand in the instructions, or in constants or arrays.
2. Each instruction becomes lines of text. A trigger becomes a variable that the routine defines
   before its first move.
3. A template puts header, declarations, the user's own text and the lines together. The formatter
   then makes it ABB's style. The shipped template writes that style by itself, which matters for
   large programs.
4. `lines_of` finds each instruction again in the result, so that a finding about a line of the
   module can name the line of its source. A template that has lost an instruction is rejected.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import jinja2
import jinja2.sandbox

from rapidgen._data import data_folder
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, Span, refusal
from rapidgen.export import text
from rapidgen.export.description import (
    Call,
    Comment,
    Instruction,
    JointTarget,
    Move,
    PathMode,
    Routine,
    SetSignal,
    Speed,
    Target,
    Trigger,
    Wait,
    WaitSignal,
    Zone,
)
from rapidgen.export.names import Names, check_names, speeds, zones
from rapidgen.rapid import check, format_source, parse
from rapidgen.rapid.dialect import Dialect

TargetStyle = Literal["inline", "named", "arrays"]
RELEASES = ((5, 15), (6, 15), (7, 10))
"""RobotWare releases for which a module is checked."""
_MOST_FORMATTED = 5_000
"""Instructions up to which the text of the shipped template is formatted again."""
_AXES = (*(f"rax_{i}" for i in range(1, 7)), *(f"eax_{letter}" for letter in "abcdef"))
_TEMPLATE = "module.mod.j2"
_SHOWN = 10


@dataclass(frozen=True, slots=True)
class WriterOptions:
    """What the user chooses about the text.

    `prologue` and `epilogue` are statements before and after the instructions, `routines` are
    declarations of the module, `templates` is a folder with a `module.mod.j2`.
    """

    targets: TargetStyle = "inline"
    prologue: str = ""
    epilogue: str = ""
    routines: str = ""
    templates: Path | None = None
    taken: frozenset[str] = frozenset()
    """Lower-case names that exist on the controller."""


@dataclass(frozen=True, slots=True)
class WrittenModule:
    """A module's text, and the line of each instruction."""

    name: str
    routine: str
    text: str
    lines: tuple[int, ...]

    @property
    def path(self) -> str:
        """Name of the text in findings: it is no file yet."""
        return f"<{self.name}.mod>"


@dataclass(frozen=True, slots=True)
class ExportedModule:
    """A RAPID module, checked for RobotWare 5, 6 and 7, not yet executed.

    `start` are the joints (URDF, rad and m) from which its first move was checked; `lines` the
    line of each step of the program.
    """

    module: WrittenModule
    description: Routine
    config: RobotConfig
    group: GroupConfig
    start: tuple[float, ...]
    lines: tuple[int, ...]
    notes: tuple[Diagnostic, ...]
    spans: tuple[Span, ...] = ()
    """Places of the steps in their source, if they were read from one."""

    @property
    def text(self) -> str:
        """Text of the module."""
        return self.module.text

    @property
    def start_values(self) -> tuple[float, ...]:
        """Start position in deg and mm: robot axes, then external axes."""
        joints = JointMap.of(self.group)
        slots = [
            value for part in joints.to_rapid(joints.to_controller(self.start)) for value in part
        ]
        used = sorted(_AXES.index(joint.axis) for joint in joints.joints)
        return tuple(slots[i] for i in used)


def write_module(routine: Routine, options: WriterOptions | None = None) -> WrittenModule:
    """Return the formatted text of a module.

    Raises DiagnosticError: RG750 for names, RG751 for a template that fails, and the parser's
    findings for a text that is no RAPID.
    """
    options = options or WriterOptions()
    declared = _Declarations(routine, options)
    instructions = [declared.lines(instruction) for instruction in routine.instructions]
    source = _render(routine, options, declared, instructions)
    if (
        options.templates is not None
        or _has_own_text(options)
        or (len(instructions) <= _MOST_FORMATTED)
    ):
        source = format_source(source, path=f"<{routine.module}.mod>")
    lines = lines_of(source, instructions)
    return WrittenModule(routine.module, routine.name, source, lines)


def check_module(
    module: WrittenModule, releases: Sequence[tuple[int, int]] = RELEASES
) -> list[Diagnostic]:
    """Check a module for releases of RobotWare; return warnings.

    Raises DiagnosticError with the errors of all releases, each once.
    """
    findings: dict[tuple[str, str, int], Diagnostic] = {}
    # The text has no syntax that only some releases know.
    tree = parse(module.text, path=module.path)
    for release in releases:
        dialect = Dialect(release)
        for found in check(tree, dialect=dialect):
            line = found.span.line if found.span else 0
            findings.setdefault((found.code, found.message, line), found)
    result = list(findings.values())
    if any(d.severity is Severity.ERROR for d in result):
        raise DiagnosticError(result, exit_code=1)
    return result


def lines_of(source: str, instructions: Sequence[Sequence[str]]) -> tuple[int, ...]:
    """Return the line in which each instruction begins.

    Raises DiagnosticError RG751 if one is missing.
    """
    result: list[int] = []
    lines = enumerate(source.split("\n"), 1)
    for number, texts in enumerate(instructions):
        for wanted in texts:
            line = next((n for n, text in lines if text.lstrip() == wanted), 0)
            if not line:
                raise refusal(
                    "RG751",
                    None,
                    f"the template has lost instruction {number}: {wanted[:60]}",
                    "write all `instructions` in their order, one line each",
                )
            if wanted is texts[0]:
                result.append(line)
    return tuple(result)


def _has_own_text(options: WriterOptions) -> bool:
    return bool(options.prologue or options.epilogue or options.routines)


def _render(
    routine: Routine,
    options: WriterOptions,
    declared: "_Declarations",
    instructions: Sequence[Sequence[str]],
) -> str:
    folder = options.templates or data_folder("templates") / "export"
    # A template is a foreign file: it may not reach attributes of Python.
    environment = jinja2.sandbox.SandboxedEnvironment(
        loader=jinja2.FileSystemLoader(folder, encoding="utf-8"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )
    try:
        return environment.get_template(_TEMPLATE).render(
            module=routine.module,
            routine=routine.name,
            header=[_plain(line) for line in routine.header],
            declarations=declared.sorted(),
            payload="" if routine.loads_moves else routine.payload,
            triggers=declared.triggers,
            instructions=[line for lines in instructions for line in lines],
            prologue=_indented(options.prologue),
            epilogue=_indented(options.epilogue),
            routines=options.routines.strip("\n"),
        )
    except (jinja2.TemplateError, OSError) as fault:
        message = (
            f"{folder / _TEMPLATE}: {fault.message or fault!r}"
            if isinstance(fault, jinja2.TemplateError)
            else f"{folder / _TEMPLATE}: {fault.strerror}"
        )
        raise refusal(
            "RG751", None, message, f"a folder with {_TEMPLATE}; see docs/use/export.md"
        ) from fault


def _indented(statements: str) -> str:
    return "\n".join(f"        {line.strip()}" for line in statements.splitlines() if line.strip())


def _plain(line: str) -> str:
    """Return a comment's text in the characters of RAPID files, ISO 8859-1."""
    return " ".join(line.encode("latin-1", "replace").decode("latin-1").split())


@dataclass
class _Declarations:
    """Declarations of a module, made while its instructions are written."""

    routine: Routine
    options: WriterOptions
    texts: list[str] = field(default_factory=list)
    triggers: list[str] = field(default_factory=list)
    """Statements that define the triggers."""

    def __post_init__(self) -> None:
        routine, options = self.routine, self.options
        own = [
            ("module", routine.module),
            ("routine", routine.name),
            *(("tool", tool.name) for tool in routine.tools),
            *(("work object", wobj.name) for wobj in routine.work_objects),
        ]
        findings = check_names(own, options.taken)
        if findings:
            raise DiagnosticError(findings, exit_code=2)
        used = [name for _, name in own]
        for instruction in routine.instructions:
            if isinstance(instruction, Call):
                used.append(instruction.routine)
            elif isinstance(instruction, SetSignal | WaitSignal):
                used.append(instruction.signal)
            elif isinstance(instruction, Move) and instruction.triggers:
                used += [trigger.signal for trigger in instruction.triggers]
        self._names = Names((*used, *options.taken))
        self._speeds: dict[Speed, str] = dict(speeds())
        self._zones: dict[Zone, str] = dict(zones())
        self._triggers: dict[Trigger, str] = {}
        self._targets: dict[Target, str] = {}
        for tool in routine.tools:
            self.texts.append(f"PERS tooldata {tool.name} := {text.tool(tool)};")
        for wobj in routine.work_objects:
            self.texts.append(f"PERS wobjdata {wobj.name} := {text.work_object(wobj)};")
        if options.targets == "arrays":
            self._declare_arrays()

    def sorted(self) -> list[str]:
        """Return all declarations: tools and work objects first, targets last."""
        kinds = ("tooldata", "wobjdata", "speeddata", "zonedata", "triggdata")
        places = {kind: place for place, kind in enumerate(kinds)}
        places |= {"jointtarget": len(kinds) + 1, "robtarget": len(kinds) + 2}
        return sorted(self.texts, key=lambda line: places.get(line.split(" ", 2)[1], len(kinds)))

    def lines(self, instruction: Instruction) -> list[str]:
        """Return the lines of an instruction, without indentation."""
        match instruction:
            case Move():
                return [self._move(instruction)]
            case SetSignal(signal, kind, value):
                return [f"Set{kind} {signal}, {text.number(value)};"]
            case WaitSignal(signal, kind, value, seconds):
                limit = f"\\MaxTime:={text.number(seconds)}"
                return [f"Wait{kind} {signal}, {text.number(value)} {limit};"]
            case Wait(seconds):
                return [f"WaitTime {text.number(seconds)};"]
            case PathMode(singularities, configurations):
                area = "\\Wrist" if singularities else "\\Off"
                configured = "\\Off" if configurations else "\\On"
                return [f"SingArea {area};", f"ConfL {configured};"]
            case Call():
                return self._call(instruction)
            case Comment(comment):
                return [f"! {_plain(comment)}".rstrip()]

    def _move(self, move: Move) -> str:
        target = self._target(move.target)
        if move.kind == "AbsJ":
            target += " \\NoEOffs"
        if move.via is not None:
            target = f"{self._target(move.via)}, {target}"
        name = "Move"
        first = speed = self._speed(move.speed)
        if move.seconds:
            first = f"{speed} \\T:={text.number(move.seconds)}"
        if move.triggers:
            name = "Trigg"
            one, *others = (self._trigger(trigger) for trigger in move.triggers)
            numbered = "".join(f" \\T{n}:={other}" for n, other in enumerate(others, 2))
            first = f"{speed}, {one}{numbered}"
        options = "" if move.work_object == "wobj0" else f" \\WObj:={move.work_object}"
        if self.routine.payload and self.routine.loads_moves:
            options += f" \\TLoad:={self.routine.payload}"
        return (
            f"{name}{move.kind} {target}, {first}, {self._zone(move.zone)}, {move.tool}{options};"
        )

    def _call(self, call: Call) -> list[str]:
        lines: list[str] = []
        words: list[str] = []
        for argument in call.arguments:
            # A literal has no type of its own; a constant tells the reader what it is.
            value = (
                self._constant(argument.value)
                if isinstance(argument.value, tuple)
                else _argument(argument.value)
            )
            if argument.inout:
                name = self._variable(argument.type, "arg")
                lines.append(f"{name} := {value};")
                value = name
            words.append(value)
        if call.returns:
            name = self._variable(call.returns, "result")
            return [*lines, f"{name} := {call.routine}({', '.join(words)});"]
        return [*lines, f"{call.routine} {', '.join(words)};" if words else f"{call.routine};"]

    def _variable(self, type_name: str, stem: str) -> str:
        name = self._names.new(stem)
        self.texts.append(f"VAR {type_name} {name};")
        return name

    def _target(self, target: Target) -> str:
        if self.options.targets == "inline":
            return text.target(target)
        return self._constant(target)

    def _constant(self, target: Target) -> str:
        name = self._targets.get(target)
        if name is None:
            stem = "jp" if isinstance(target, JointTarget) else "p"
            name = self._names.new(stem, 10)
            self._targets[target] = name
            self.texts.append(f"CONST {text.target_type(target)} {name} := {text.target(target)};")
        return name

    def _declare_arrays(self) -> None:
        """Declare an array of robtargets and one of jointtargets."""
        moves = [i for i in self.routine.instructions if isinstance(i, Move)]
        targets = [t for move in moves for t in (move.via, move.target) if t is not None]
        for kind, stem in (("robtarget", "targets"), ("jointtarget", "joints")):
            own = list(dict.fromkeys(t for t in targets if text.target_type(t) == kind))
            if not own:
                continue
            name = self._names.new(stem)
            size = "{" + str(len(own)) + "}"
            values = ",\n".join(f"        {text.target(target)}" for target in own)
            self.texts.append(f"CONST {kind} {name}{size} := [\n{values}];")
            for number, target in enumerate(own, 1):
                self._targets[target] = name + "{" + str(number) + "}"

    def _speed(self, speed: Speed) -> str:
        name = self._speeds.get(speed)
        if name is None:
            name = self._names.new("speed")
            self._speeds[speed] = name
            self.texts.append(f"CONST speeddata {name} := {text.speed(speed)};")
        return name

    def _zone(self, zone: Zone) -> str:
        name = "fine" if zone.finep else self._zones.get(zone)
        if name is None:
            name = self._names.new("zone")
            self._zones[zone] = name
            self.texts.append(f"CONST zonedata {name} := {text.zone(zone)};")
        return name

    def _trigger(self, trigger: Trigger) -> str:
        name = self._triggers.get(trigger)
        if name is None:
            name = self._names.new("trigg")
            self._triggers[trigger] = name
            self.texts.append(f"VAR triggdata {name};")
            self.triggers.append(text.trigger(trigger, name))
        return name


def _argument(value: float | bool | str) -> str:
    if isinstance(value, bool):
        return text.truth(value)
    return text.string(value) if isinstance(value, str) else text.number(value)
