"""Programs that are too large for one module: parts that are loaded while the robot moves.

The main module loads part 1, then orders each further part (StartLoad) before it calls the one
before. When a part returns, its last move is still on the way: WaitLoad links the next part in that
time, and unloads the part before the last. A part is unloaded only after a complete later part, and
a part has more moves than a controller queues, so no queued move belongs to it.

Two times have to fit, and the smallest quotient of what there is and what is needed is the reserve:

- a part is read while the part before it moves: its size times the load time per kB;
- it is linked during the last move of the part before: its size times the link time per kB, and the
  same for the part that is unloaded. The task stands in WaitLoad meanwhile, the robot does not.

No public source has these times. The estimates are the same for all controllers, `LoadTimes`
takes a user's own, and `measuring_files` is a program that measures them. Times of moves are lower
bounds: way by programmed speed. A split without reserve is rejected.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import dist, inf
from typing import Final

from rapidgen.diagnostics import Diagnostic, Severity, error, refusal
from rapidgen.export import text
from rapidgen.export.description import (
    Comment,
    Instruction,
    Move,
    RobTarget,
    Routine,
    Wait,
)
from rapidgen.export.writer import WriterOptions, write_module
from rapidgen.rapid import format_source

SWEEP: Final = (0.25, 1.0, 4.0, 16.0)
"""Multiples of the estimated times for which a split says whether it holds."""
FASTEST: Final = 100.0
"""Moves per second above which nothing is known about controllers."""
QUEUED: Final = 10
"""Moves that a part has at least: more than a controller queues. Up to five without corners are
known (\\Conc, S4 datasys 2-MoveJ-1); twice that is the strict choice."""
AHEAD: Final = 0.2
"""s before the end of a move at which the next one has to be known, else the corner becomes a stop.
Estimated: the virtual controller needs the time to brake."""
REQUIRED: Final = 1.5
"""Smallest accepted reserve."""
_SMALLEST: Final = 1000
"""Bytes of the smallest part that is tried."""


@dataclass(frozen=True, slots=True)
class Limits:
    """What a controller of one release takes, with the source of each figure."""

    release: int
    name: int = 32
    """Characters of a name [K §2.3]."""
    dimensions: int = 3
    """Of an array [K §2.22]."""
    string: int = 80
    """Characters [K §2.13]."""
    memory_per_byte: float = 4.0
    """Program memory that a byte of a module's text takes [K §16]."""
    memory: int = 8_000_000
    """Bytes of program memory that an export may take. RobotWare 5 and 6 have about 20 MB in all
    (remembered, no source); the strict choice leaves more than half to what is there already."""
    lines: int = 0
    """Lines of a module; 0: no source names a limit."""

    @property
    def module(self) -> int:
        """Return the bytes of text of all modules that are loaded at once."""
        return int(self.memory / self.memory_per_byte)


LIMITS: Final = {5: Limits(5, memory=4_000_000), 6: Limits(6), 7: Limits(7)}
"""By major release of RobotWare. The kernel's limits are those of the manual "RAPID kernel" [K],
which is the same for all of them; only the memory differs."""


@dataclass(frozen=True, slots=True)
class LoadTimes:
    """Times of a controller for modules, s per kB of text, and s for each operation."""

    load: float = 0.005
    link: float = 0.005
    fixed: float = 0.02
    is_estimated: bool = True


@dataclass(frozen=True, slots=True)
class Part:
    """Instructions of one part, and its figures in s and bytes."""

    instructions: tuple[Instruction, ...]
    size: int
    duration: float
    cover: float
    """Time of its last move."""


@dataclass(frozen=True, slots=True)
class Parts:
    """A program in parts."""

    routine: Routine
    parts: tuple[Part, ...]
    times: LoadTimes
    reserve: float
    """Factor by which load and link times may be longer; inf for one part."""
    moves_per_second: float
    """In the fastest second."""

    @property
    def holds(self) -> dict[float, bool]:
        """Return whether the split holds at multiples of the times."""
        return {factor: self.reserve >= factor for factor in SWEEP}

    def report(self) -> list[str]:
        """Return what the split is, in lines for a person."""
        kind = "estimated" if self.times.is_estimated else "given"
        lines = [
            f"{len(self.parts)} parts of at most {max(p.size for p in self.parts) / 1000:.1f} kB, "
            f"{self.moves_per_second:.0f} moves per second at most"
        ]
        if len(self.parts) > 1:
            load, link = (1000 * self.reserve * t for t in (self.times.load, self.times.link))
            lines.append(
                f"tolerated: {load:.1f} ms/kB to load and {link:.1f} ms/kB to link, "
                f"{self.reserve:.1f} times the {kind} times"
            )
            held = [f"{factor:g}" for factor, holds in self.holds.items() if holds]
            lost = [f"{factor:g}" for factor, holds in self.holds.items() if not holds]
            lines.append(
                f"holds at {', '.join(held) or 'no'} times the {kind} times"
                + (f", not at {', '.join(lost)}" if lost else "")
            )
        return lines

    def findings(self, limits: Limits) -> list[Diagnostic]:
        """Return warnings: too many moves per second, a module of doubtful size."""
        result = []
        if self.moves_per_second > FASTEST:
            result.append(
                error(
                    "RG791",
                    None,
                    f"{self.moves_per_second:.0f} moves per second are not verified on controllers",
                    "use `rapidgen fit` for fewer moves",
                    severity=Severity.WARNING,
                )
            )
        if len(self.parts) == 1 and self.parts[0].size > limits.module:
            result.append(
                error(
                    "RG792",
                    None,
                    f"a module of {self.parts[0].size / 1000:,.0f} kB may be too large for "
                    f"RobotWare {limits.release} (limit here {limits.module / 1000:,.0f} kB)",
                    "use `--parts`, or `rapidgen fit` for fewer moves",
                    severity=Severity.WARNING,
                )
            )
        return result

    def files(self, options: WriterOptions | None = None, folder: str = "HOME:") -> dict[str, str]:
        """Return the texts of the modules by file name; the main module is the first.

        `folder`: where the parts are on the controller.
        """
        options = options or WriterOptions()
        routine = self.routine
        if len(self.parts) == 1:
            return {f"{routine.module}.mod": write_module(routine, options).text}
        names = [f"{routine.module}_{n}" for n in range(1, len(self.parts) + 1)]
        result = {f"{routine.module}.mod": self._main(names, options, folder)}
        plain = replace(options, prologue="", epilogue="", routines="")
        for number, (name, part) in enumerate(zip(names, self.parts, strict=True)):
            own = replace(
                routine,
                module=name,
                name=f"{name}_moves",
                instructions=part.instructions,
                tools=(),
                work_objects=(),
                payload=routine.payload if number == 0 or routine.loads_moves else "",
                header=(f"Part {number + 1} of {len(names)} of {routine.module}.",),
            )
            result[f"{name}.mod"] = _local(write_module(own, plain).text)
        return result

    def _main(self, names: Sequence[str], options: WriterOptions, folder: str) -> str:
        """Return the module that loads the parts."""
        routine = self.routine
        lines = [f"MODULE {routine.module}"]
        lines += [f"! {line}" for line in (*routine.header, *self.report())]
        lines += [f"PERS tooldata {t.name} := {text.tool(t)};" for t in routine.tools]
        lines += [f"PERS wobjdata {w.name} := {text.work_object(w)};" for w in routine.work_objects]
        lines += ["LOCAL VAR loadsession coming;", f"PROC {routine.name}()", options.prologue]
        files = [f'"{folder}" \\File:="{name}.mod"' for name in names]
        lines.append(f"Load \\Dynamic, {files[0]};")
        for number, name in enumerate(names):
            if number + 1 < len(names):
                lines.append(f"StartLoad \\Dynamic, {files[number + 1]}, coming;")
            lines.append(f'%"{name}_moves"%;')
            if number + 1 < len(names):
                # The part before this one is unloaded: all its moves are done.
                old = f'\\UnloadPath:="{folder}" \\UnloadFile:="{names[number - 1]}.mod", '
                lines.append(f"WaitLoad {old if number else ''}coming;")
        lines += ["WaitRob \\InPos;", f"UnLoad {files[-2]};", f"UnLoad {files[-1]};"]
        lines += [options.epilogue, "ENDPROC", options.routines, "ENDMODULE"]
        source = "\n".join(line for line in lines if line) + "\n"
        return format_source(source, path=f"<{routine.module}.mod>")


def split(
    routine: Routine,
    limits: Limits,
    times: LoadTimes | None = None,
    *,
    durations: Sequence[float] | None = None,
    required: float = REQUIRED,
) -> Parts:
    """Return a program in parts that are loaded while the robot moves.

    `durations`: s of each instruction, if known better than by `least_durations`. Two parts are
    loaded at once, so each has at most half of the limit; the largest that have `required` as their
    reserve are chosen. Raises DiagnosticError RG790 if there are none.
    """
    times = times or LoadTimes()
    durations = list(durations) if durations is not None else least_durations(routine)
    whole = unsplit(routine, times, durations)
    if whole.parts[0].size <= limits.module:
        return whole
    sizes = [_size(instruction) for instruction in routine.instructions]
    rate = whole.moves_per_second
    most = limits.module / 2
    best: Parts | None = None
    while most >= _SMALLEST:
        parts = _cut(routine, sizes, durations, most)
        if parts:
            found = Parts(routine, parts, times, _reserve(parts, times), rate)
            if best is None or found.reserve > best.reserve:
                best = found
            if best.reserve >= required:
                return best
        most /= 1.5
    if best is None:
        raise refusal(
            "RG790", None, "the program has no place to part it", "between two fly-by moves"
        )
    raise refusal(
        "RG790",
        None,
        f"no parts can be loaded while the robot moves: {best.reserve:.2g} of the time is there",
        "use `rapidgen fit` for fewer moves, slower moves, or your own load times",
        exit_code=1,
    )


def unsplit(routine: Routine, times: LoadTimes, durations: Sequence[float] | None = None) -> Parts:
    """Return a program as one part, with its size and moves per second."""
    durations = list(durations) if durations is not None else least_durations(routine)
    size = sum(map(_size, routine.instructions))
    whole = Part(routine.instructions, size, sum(durations), 0.0)
    return Parts(routine, (whole,), times, inf, _moves_per_second(routine, durations))


def least_durations(routine: Routine) -> list[float]:
    """Return lower bounds of the time of each instruction, s: way by programmed speed.

    A joint move without \\T counts 0: its time depends on the robot.
    """
    result = []
    last: tuple[RobTarget, str, str] | None = None
    for instruction in routine.instructions:
        seconds = 0.0
        if isinstance(instruction, Wait):
            seconds = instruction.seconds
        elif isinstance(instruction, Move):
            target = instruction.target
            at = None
            if isinstance(target, RobTarget):
                at = target, instruction.tool, instruction.work_object
            if instruction.seconds > 0.0:
                seconds = instruction.seconds
            elif at is not None and last is not None and at[1:] == last[1:]:
                way = dist(last[0].trans, at[0].trans)
                if instruction.via is not None:
                    way = dist(last[0].trans, instruction.via.trans)
                    way += dist(instruction.via.trans, at[0].trans)
                seconds = way / max(instruction.speed.tcp, 1e-9)
            last = at
        result.append(seconds)
    return result


def _size(instruction: Instruction) -> int:
    """Return the bytes of an instruction's text: the targets are most of it."""
    if isinstance(instruction, Move):
        size = 60 + len(instruction.tool) + len(instruction.work_object)
        for target in (instruction.target, instruction.via):
            size += len(text.target(target)) if target is not None else 0
        return size
    return len(instruction.text) + 12 if isinstance(instruction, Comment) else 60


def _moves_per_second(routine: Routine, durations: Sequence[float]) -> float:
    """Return the largest number of moves within one second.

    Joint moves of unknown duration are left out.
    """
    times: list[float] = []
    now, first, most = 0.0, 0, 0
    for instruction, seconds in zip(routine.instructions, durations, strict=True):
        now += seconds
        if isinstance(instruction, Move) and seconds > 0.0:
            times.append(now)
            while times[first] < now - 1.0:
                first += 1
            most = max(most, len(times) - first)
    return most / min(max(now, 1e-3), 1.0)


def _cut(
    routine: Routine, sizes: Sequence[int], durations: Sequence[float], most: float
) -> tuple[Part, ...]:
    """Return parts of at most `most` bytes, cut after the longest fly-by moves.

    Empty if there are no such places.
    """
    steps = routine.instructions
    parts: list[Part] = []
    begin = 0
    while begin < len(steps):
        size, moves, end, cover = 0, 0, 0, -1.0
        for n in range(begin, len(steps)):
            size += sizes[n]
            step = steps[n]
            if size > most:
                break
            if isinstance(step, Move):
                moves += 1
                fits = size >= most / 2 and moves > QUEUED and not step.zone.finep
                if fits and durations[n] >= cover:
                    end, cover = n + 1, durations[n]
        else:
            end, cover = len(steps), 0.0
        if not end:
            return ()
        own = range(begin, end)
        parts.append(
            Part(
                tuple(steps[begin:end]),
                sum(sizes[n] for n in own),
                sum(durations[n] for n in own),
                cover,
            )
        )
        begin = end
    last = sum(1 for step in parts[-1].instructions if isinstance(step, Move))
    return tuple(parts) if len(parts) > 1 and last > QUEUED else ()


def _reserve(parts: Sequence[Part], times: LoadTimes) -> float:
    """Return the smallest quotient of time that is there and time that is needed."""
    reserve = inf
    for number in range(1, len(parts)):
        before, own = parts[number - 1], parts[number]
        load = times.fixed + times.load * own.size / 1000
        linked = own.size + (parts[number - 2].size if number > 1 else 0)
        link = times.fixed + times.link * linked / 1000
        cover = max(0.0, before.cover - AHEAD)
        reserve = min(reserve, (before.duration - before.cover) / load, cover / link)
    return reserve


def _local(source: str) -> str:
    """Return a part whose declarations are local: parts are loaded together."""
    return re.sub(r"^(    )(CONST|VAR) ", r"\1LOCAL \2 ", source, flags=re.MULTILINE)


def measuring_files(
    kilobytes: Sequence[int] = (16, 64, 256), folder: str = "HOME:"
) -> dict[str, str]:
    """Return a program that measures a controller's load and link times, by file name.

    Run `measure_load` with the robot at rest: nothing moves. It writes a line for each size: s to
    load and link, s to link only, s to unload.
    """
    lines = ["MODULE measure_load", "LOCAL VAR loadsession coming;", "LOCAL VAR clock watch;"]
    lines += ["PROC measure_load_times()"]
    result = {}
    for size in kilobytes:
        name = f"measure_{size}"
        result[f"{name}.mod"] = _filler(name, 1000 * size)
        lines += [f'measure {size}, "{name}.mod";']
    lines += [
        "ENDPROC",
        "LOCAL PROC measure(num size, string file)",
        "VAR num whole;",
        "VAR num link;",
        "ClkReset watch;",
        "ClkStart watch;",
        f'StartLoad \\Dynamic, "{folder}" \\File:=file, coming;',
        "WaitLoad coming;",
        "ClkStop watch;",
        "whole := ClkRead(watch);",
        f'UnLoad "{folder}" \\File:=file;',
        f'StartLoad \\Dynamic, "{folder}" \\File:=file, coming;',
        "! Longer than it takes to load, so that only the link is left.",
        "WaitTime 2 * whole + 1;",
        "ClkReset watch;",
        "ClkStart watch;",
        "WaitLoad coming;",
        "ClkStop watch;",
        "link := ClkRead(watch);",
        "ClkReset watch;",
        "ClkStart watch;",
        f'UnLoad "{folder}" \\File:=file;',
        "ClkStop watch;",
        'TPWrite NumToStr(size, 0) + " kB: " + NumToStr(1000 * (whole - link) / size, 2)'
        ' + " ms/kB to load, " + NumToStr(1000 * link / size, 2) + " to link, "'
        ' + NumToStr(1000 * ClkRead(watch) / size, 2) + " to unload";',
        "ENDPROC",
        "ENDMODULE",
    ]
    source = format_source("\n".join(lines) + "\n", path="<measure_load.mod>")
    return {"measure_load.mod": source, **result}


def _filler(name: str, size: int) -> str:
    """Return a module of about a size that has moves which are never called."""
    move = (
        "        MoveL [[500.1234,12.3456,600.7891],[0,0.7071068,0.7071068,0],[0,0,0,0],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]], v200, z10, tool0;"
    )
    head = f"MODULE {name}\n    PROC {name}_moves()\n"
    tail = "    ENDPROC\nENDMODULE\n"
    count = max(1, (size - len(head) - len(tail)) // (len(move) + 1))
    return head + (move + "\n") * count + tail
