"""Execution of an exported module, before it is written.

The module runs alone on a virtual controller with the robot that it was made for. Signals,
routines and data of the real controller are inferred. Everything that the event log reports about
the path (reach, limits, singularities, configurations, corners) becomes a finding at the line of
the module, and at the line of the source if that is known. With SingArea \\Wrist each move is
reported whose planned orientation leaves the programmed one.
"""

from bisect import bisect_right
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees

from rapidgen.config.model import GroupConfig
from rapidgen.controller.boot_targets import INFER, BootOptions, boot_modules
from rapidgen.controller.controller import VirtualController
from rapidgen.controller.inference.restarts import run_past_stops
from rapidgen.diagnostics import Diagnostic, Label, Severity, Span, error
from rapidgen.export.writer import WrittenModule
from rapidgen.machine.event_log import Event, EventType
from rapidgen.machine.event_table import ERROR_CODES, RAPID_ERROR
from rapidgen.motion.cartesian import CartesianPath
from rapidgen.motion.motion import Motion
from rapidgen.system.model import ModuleFile, System, TaskSpec

_LONGEST = 1e6
"""Largest duration of a program, s."""
_SHOWN = 20
"""Findings of one trial that are worth reading."""
_SLIGHT = 0.01
"""deg of orientation that are not worth reading."""


@dataclass(frozen=True, slots=True)
class ModuleTrial:
    """Result of a trial: simulated seconds, inferred names, and warnings."""

    seconds: float
    inferred: tuple[str, ...]
    warnings: tuple[Diagnostic, ...]


def run_module(
    module: WrittenModule,
    group: GroupConfig,
    *,
    start: Sequence[float],
    robotware: tuple[int, int],
    lines: Sequence[int] = (),
    spans: Sequence[Span] = (),
) -> tuple[ModuleTrial, list[Diagnostic]]:
    """Run a module from a start position; return the trial and the errors.

    `start` are axis values in deg and mm: robot axes, then external axes. `lines` are the lines of
    the program's instructions in the module, `spans` their places in the source.
    """
    file = ModuleFile(module.name, module.path, module.text.encode("latin-1"))
    task = TaskSpec(group.task, entry=module.routine, motion=True, modules=(file,))
    system = System(module.name, (task,), robotware=robotware)
    target = boot_modules(system, (group,), BootOptions(cell=INFER, start=tuple(start)))
    with VirtualController.boot(target, cycle="once", autostart=False) as controller:
        events: list[Event] = []
        controller.log.subscribe(events.append)
        turned: dict[Span, float] = {}
        for each in controller.motion.groups.values():
            each.observers.append(lambda motion: _note_orientation(turned, motion))
        controller.start_program()
        since = controller.now
        ended = run_past_stops(controller, max_time=_LONGEST)
        seconds = controller.now - since
        where = tuple(controller.where())
        faults = [task.fault for task in controller.tasks.values() if task.fault is not None]
    places = list(zip(lines, spans, strict=False))
    errors = []
    for fault in faults:
        place = fault.span or (fault.stack[-1].span if fault.stack else None)
        texts = tuple(text for text in fault.arguments if text)
        errors.append(_finding(places, place, f"event {fault.event}: {fault.title}", texts))
    if not faults and ended != "finished":
        message = f"the module does not end: {ended}"
        errors.append(error("RG754", None, message, "give it an end", notes=where))
    guessed = target.guessed
    inferred = tuple(one.name for one in guessed.named) if guessed is not None else ()
    warnings = (*_warnings(places, events), *_turned(places, turned))
    return ModuleTrial(seconds, inferred, warnings), errors


def _note_orientation(turned: dict[Span, float], motion: Motion) -> None:
    """Store the orientation error (deg) of each move of a motion by its place in the module."""
    for leg in motion.legs:
        place = leg.move.place() if leg.move.place is not None else None
        if place is not None and place.span not in turned and isinstance(leg.way, CartesianPath):
            turned[place.span] = degrees(leg.way.orientation_error)


def _turned(places: Sequence[tuple[int, Span]], turned: dict[Span, float]) -> list[Diagnostic]:
    """Return the largest orientation errors of SingArea \\Wrist, as warnings at their places."""
    listed = sorted(turned.items(), key=lambda item: -item[1])
    result = []
    for place, angle in listed[:_SHOWN]:
        if angle > _SLIGHT:
            source = _source(places, place)
            result.append(
                error(
                    "RG759",
                    source or place,
                    f"SingArea \\Wrist: the tool turns up to {angle:.2f} deg away on this move",
                    "without --allow-singularities the orientation is kept",
                    related=(Label(place, "in the module"),) if source is not None else (),
                    severity=Severity.WARNING,
                )
            )
    return result


def _warnings(places: Sequence[tuple[int, Span]], events: Sequence[Event]) -> list[Diagnostic]:
    """Return the warnings of the event log, each place once."""
    handled = {RAPID_ERROR, *ERROR_CODES.values()}
    counts = Counter(
        (event.code, event.title, event.texts, event.span)
        for event in events
        if event.type is EventType.WARNING and event.code not in handled
    )
    shown = [
        _finding(
            places,
            place,
            f"event {code}: {title}" + (f" ({count} times)" if count > 1 else ""),
            tuple(text for text in texts if text),
            warning=True,
        )
        for (code, title, texts, place), count in counts.most_common(_SHOWN)
    ]
    if len(counts) > _SHOWN:
        more = f"{len(counts) - _SHOWN} more warnings of the event log"
        shown.append(error("RG755", None, more, severity=Severity.WARNING))
    return shown


def _finding(
    places: Sequence[tuple[int, Span]],
    place: Span | None,
    message: str,
    texts: tuple[str, ...],
    *,
    warning: bool = False,
) -> Diagnostic:
    """Return a finding at its place in the source, else in the module."""
    source = _source(places, place)
    related: tuple[Label, ...] = ()
    if source is not None and place is not None:
        related = (Label(place, "in the module"),)
    return error(
        "RG755" if warning else "RG754",
        source or place,
        message,
        "" if warning else "correct the source, or inspect the module with --no-run",
        notes=texts,
        related=related,
        severity=Severity.WARNING if warning else Severity.ERROR,
    )


def _source(places: Sequence[tuple[int, Span]], place: Span | None) -> Span | None:
    """Return the place in the source of the instruction at a line of the module."""
    if place is None:
        return None
    number = bisect_right(places, place.line, key=lambda known: known[0])
    return places[number - 1][1] if number else None
