"""Values in a stopped program: read, evaluate, set."""

import ctypes
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from types import FrameType

from rapidgen.controller.debugger.stack import StackFrame
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.emit.access import Options
from rapidgen.runtime.compiler.emit.statements import loop_variable
from rapidgen.runtime.compiler.link import Linker
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.resume import (
    WatchedExpression,
    parse_assignment,
    parse_expression,
    store,
    watch,
)
from rapidgen.runtime.compiler.symbols import CannotCompile, LoadedModule, Routine
from rapidgen.runtime.errors import RECOVERABLE, FatalError, as_rapid_error
from rapidgen.runtime.text import value_text
from rapidgen.runtime.values import ATOMIC, Record, Type, Value

LONGEST = 400
"""Maximum length of a displayed value; its parts can be requested."""


class NotPaused(Exception):
    """A request that is not possible at this place; the text explains why."""


@dataclass(frozen=True, slots=True)
class DisplayedValue:
    """A displayed value: RAPID text, and True if it has parts."""

    name: str
    type: str
    text: str
    parts: int = 0
    """Components or elements."""
    settable: bool = True


def evaluate(program: Program, frame: StackFrame, text: str) -> DisplayedValue:
    """Evaluate an expression in a frame.

    NotPaused: it has no value, or contains a call.
    """
    watched = compiled(program, frame, text)
    return shown(text, watched.type, watched.dims, read(watched, frame))


def compiled(program: Program, frame: StackFrame, text: str) -> WatchedExpression:
    """Compile an expression for all frames of the routine. NotPaused."""
    try:
        return watch(*_where(program, frame), parse_expression(text))
    except (CannotCompile, SyntaxError, FatalError) as error:
        raise NotPaused(str(error)) from error


def read(watched: WatchedExpression, frame: StackFrame) -> Value:
    """Return the present value. NotPaused: an error of execution."""
    try:
        return watched.read(frame.values)
    except RECOVERABLE as error:
        known = as_rapid_error(error)
        raise NotPaused(f"{known.name}{f': {known.text}' if known.text else ''}") from error
    except FatalError as error:
        raise NotPaused(f"{error.event} {error.title}") from error
    except NameError as error:
        raise NotPaused("a variable of a routine that is not being executed") from error


def assign(program: Program, frame: StackFrame, target: str, value: str) -> DisplayedValue:
    """Set a datum, an element or a component like an assignment.

    Raises NotPaused.
    """
    try:
        node = parse_assignment(f"{target}:={value}")
        name, change = store(*_where(program, frame), node)
    except (CannotCompile, SyntaxError, FatalError) as error:
        raise NotPaused(str(error)) from error
    try:
        changed = change(frame.values)
    except RECOVERABLE as error:
        raise NotPaused(as_rapid_error(error).name) from error
    if name:
        _set_local(program, frame, name, changed)
    return evaluate(program, frame, target)


def _set_local(program: Program, frame: StackFrame, name: str, value: Value) -> None:
    code = program.codes[frame.python.f_code.co_filename] if frame.python is not None else None
    complete = type(frame.values[name]) is int and type(value) is not int
    if complete and code is not None and not code.traced:
        raise NotPaused("the code that is being executed counts on a whole number there")
    frame.values[name] = value
    if frame.python is not None:
        _write_local(frame.python, name, value)


def _write_local(frame: FrameType, name: str, value: Value) -> None:
    frame.f_locals[name] = value
    if sys.version_info < (3, 13):  # since then the line above writes through [PEP 667]
        ctypes.pythonapi.PyFrame_LocalsToFast(ctypes.py_object(frame), ctypes.c_int(0))


def _where(
    program: Program, frame: StackFrame
) -> tuple[Linker, Routine, tuple[n.For, ...], Options, tuple[str, ...]]:
    return program.linker, frame.routine, frame.loops, program.options, tuple(frame.values)


def variables(program: Program, frame: StackFrame) -> tuple[DisplayedValue, ...]:
    """Return parameters, data and loop variables of a frame.

    The order is that of the declarations.
    """
    node = frame.routine.node
    assert node is not None
    loops = [loop.variable for loop in frame.loops if loop_variable(loop) in frame.values]
    names = [p.name for p in node.parameters] + [d.name for d in node.data]
    return tuple(_each(program, frame, [*dict.fromkeys([*loops, *names])]))


def module_data(program: Program, frame: StackFrame) -> tuple[DisplayedValue, ...]:
    """Return data of the frame's module, as visible in the frame."""
    return tuple(_each(program, frame, [d.name for d in _declared(frame.module)]))


def parts(
    program: Program, frame: StackFrame, text: str, start: int = 0, count: int = 0
) -> tuple[DisplayedValue, ...]:
    """Return components or elements of a value, as expressions of the frame.

    `start` is the index of the first one, from 0; `count` 0 means all. A row of an array with
    several dimensions has the name `a{2`, which this function takes again; RAPID has no expression
    for it. NotPaused: no such value.
    """
    text, given = _row(text)
    watched = compiled(program, frame, text)
    value, dims = read(watched, frame), watched.dims[len(given) :]
    for index in given:
        value = value[index] if isinstance(value, dict) and index in value else None
    some = slice(start, start + count if count else None)
    if isinstance(value, Record):
        names = [f"{text}.{name}" for name, _ in watched.type.components[some]]
        return tuple(_each(program, frame, names))
    keys = list(value)[some] if isinstance(value, dict) else []
    elements = [text + "{" + ",".join(map(str, (*given, key))) for key in keys]
    if len(dims) < 2:
        return tuple(_each(program, frame, [element + "}" for element in elements]))
    rows = [shown(e, watched.type, dims[1:], value[k]) for e, k in zip(elements, keys, strict=True)]
    return tuple(replace(row, settable=False) for row in rows)


def _row(text: str) -> tuple[str, tuple[int, ...]]:
    """Return the array and the indices of a row, `a{2`; none for an expression."""
    if text.count("{") == text.count("}"):
        return text, ()
    base, _, indices = text.rpartition("{")
    given = indices.split(",")
    if not all(index.isdecimal() for index in given):
        raise NotPaused(f"{text} is no row of an array")
    return base, tuple(map(int, given))


def _declared(module: LoadedModule) -> Iterator[n.DataDeclaration]:
    yield from module.declarations.values()


def _each(program: Program, frame: StackFrame, names: list[str]) -> Iterator[DisplayedValue]:
    for name in names:
        try:
            yield evaluate(program, frame, name)
        except NotPaused as reason:
            yield DisplayedValue(name, "", f"({reason})", settable=False)


def shown(name: str, kind: Type, dims: tuple[int, ...], value: Value) -> DisplayedValue:
    """Return a value for display."""
    typed = kind.name + ("{" + ",".join(map(str, dims)) + "}" if any(dims) else "")
    if kind.kind == "semivalue":
        return DisplayedValue(name, kind.name, value_text(value.value), settable=False)
    if value is None:
        return DisplayedValue(name, typed, "(not present)", settable=False)
    parts = len(value) if isinstance(value, dict) else 0
    if isinstance(value, Record):
        parts = len(kind.components)
    elif kind.kind not in ATOMIC and not parts:
        return DisplayedValue(name, typed, f"({kind.name})", settable=False)
    text = value_text(value, kind)
    return DisplayedValue(
        name, typed, text if len(text) <= LONGEST else text[:LONGEST] + "…", parts
    )
