"""Calls of a task: call stacks and late binding."""

from collections.abc import Iterator, Sequence
from types import CodeType, FrameType, TracebackType

from rapidgen.rapid.binding.arguments import ArgumentFault, first_fit, match
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.support import LateArgument
from rapidgen.runtime.compiler.symbols import (
    CodeRole,
    Codes,
    FormalParameter,
    LoadedModule,
    Routine,
)
from rapidgen.runtime.errors import Location, RapidError
from rapidgen.runtime.values import ATOMIC, Value

# -- Call stacks -----------------------------------------------------------------------------------
#
# Who is where: call stacks of tasks as places in RAPID.

_LONGEST_TARGET = 40
"""Tokens of a statement that are searched for the function that it calls."""


def outwards(frame: FrameType | None) -> Iterator[FrameType]:
    """Iterate over a frame and its callers."""
    while frame is not None:
        yield frame
        frame = frame.f_back


def frames_of(traceback: TracebackType | None) -> Iterator[tuple[FrameType, int]]:
    """Iterate over frames and lines of a traceback, outermost first."""
    while traceback is not None:
        yield traceback.tb_frame, traceback.tb_lineno
        traceback = traceback.tb_next


def location(codes: Codes, file: str, line: int) -> Location | None:
    """Return the RAPID location of a Python line."""
    compiled = codes.get(file)
    if compiled is None or not 0 <= line < len(compiled.tokens):
        return None
    module = compiled.module
    token = compiled.tokens[line]
    span = module.tree.source.span(token, token)
    origin = None
    for rapid_line, template, template_line in module.file.origin:
        if rapid_line > span.line:
            break
        origin = (template, template_line + span.line - rapid_line)
    word = _instruction(module.tree.source.tokens, token)
    return Location(module.name, compiled.routine.name, span, origin, word)


def _instruction(tokens: Sequence[str], first: int) -> str:
    """Return the first word of a statement, or the function that an assignment calls first."""
    is_assignment = False
    for place in range(first, min(first + _LONGEST_TARGET, len(tokens) - 1)):
        if tokens[place] == ";":
            break
        is_assignment = is_assignment or tokens[place] == ":="
        if is_assignment and tokens[place + 1] == "(" and tokens[place].isidentifier():
            return tokens[place]
    return tokens[first]


def place_in_rapid(codes: Codes, traceback: TracebackType | None) -> tuple[str, int] | None:
    """Return file and line of the innermost compiled frame; `location` has its place."""
    result = None
    while traceback is not None:
        file = traceback.tb_frame.f_code.co_filename
        if file in codes:
            result = file, traceback.tb_lineno
        traceback = traceback.tb_next
    return result


def between(codes: Codes, frame: FrameType | None, outside: Sequence[CodeType]) -> bool:
    """Return True if the innermost routine is between two statements.

    There it calls one of `outside`.
    """
    called: CodeType | None = None
    for at in outwards(frame):
        if at.f_code.co_filename in codes:
            return any(called is code for code in outside)
        called = at.f_code
    return False


def stack_of_error(codes: Codes, error: BaseException) -> tuple[Location, ...]:
    """Return the call stack of an error, outermost routine first."""
    result: list[Location] = []
    for frame, line in frames_of(error.__traceback__):
        place = location(codes, frame.f_code.co_filename, line)
        if place is not None:
            if _is_part(codes, frame):
                result.pop()
            result.append(place)
    return tuple(result)


def stack_at(codes: Codes, frame: FrameType | None) -> tuple[Location, ...]:
    """Return the call stack of a frame, outermost routine first."""
    result: list[Location] = []
    inside = False
    for at in outwards(frame):
        place = location(codes, at.f_code.co_filename, at.f_lineno)
        if place is not None:
            if not inside:
                result.append(place)
            inside = _is_part(codes, at)
    return tuple(reversed(result))


def _is_part(codes: Codes, frame: FrameType) -> bool:
    return codes[frame.f_code.co_filename].role(frame.f_code) is CodeRole.PART


# -- Late binding ----------------------------------------------------------------------------------
#
# `%name% arguments;`: which procedure a text names, and which argument is for which parameter
# [K §4.5].


_WRONG = frozenset({ArgumentFault.SURPLUS, ArgumentFault.UNKNOWN, ArgumentFault.TWICE})


def late_routine(program: Program, name: str, module: LoadedModule | None) -> Routine:
    """Return the procedure of a name, as seen from a module.

    Raises ERR_REFUNKPRC or ERR_CALLPROC.
    """
    where, colon, proper = name.rpartition(":")
    if not proper or not proper.replace("_", "").isalnum() or proper[0].isdigit():
        raise RapidError("ERR_CALLPROC", name)
    key = proper.lower()
    if colon and where:
        inside = program.modules.get(where.lower())
        match = inside.routines.get(key) if inside is not None else None
    elif colon:
        match = program.routine(program.names.globals.get(key))
    else:
        match = program.find_routine(module, key)
    if match is None:
        known = program.find_data(module, key) is not None
        raise RapidError("ERR_CALLPROC" if known else "ERR_REFUNKPRC", name)
    if not isinstance(match, Routine) or match.kind != "PROC":
        raise RapidError("ERR_CALLPROC", name)
    return match


def late_arguments(
    routine: Routine, given: Sequence[LateArgument]
) -> tuple[list[Value], dict[str, Value]]:
    """Return arguments by position and by Python name.

    ERR_CALLPROC, ERR_ARGNOTVAR: they do not match the parameters.
    """
    parameters = routine.parameters

    def fitting(argument: LateArgument, among: Sequence[int]) -> int:
        kinds = [kind.name if (kind := parameters[i].type) else None for i in among]
        return first_fit(argument.type.name if argument.type else None, among, kinds)

    result = match(parameters, given, fitting)
    if result.missing or any(_WRONG.intersection(pair.misfits) for pair in result.pairs):
        raise RapidError("ERR_CALLPROC", routine.name)
    positional: list[Value] = []
    named: dict[str, Value] = {}
    for pair in result.pairs:
        parameter = parameters[pair.parameter]
        value = _value(parameter, pair.argument, builtin=routine.node is None)
        if parameter.optional or named or len(positional) != pair.parameter:
            named[f"v_{parameter.name.lower()}"] = value
        else:
            positional.append(value)
    return positional, named


def _value(parameter: FormalParameter, argument: LateArgument, *, builtin: bool) -> Value:
    if argument.read is None:
        return True
    kind = parameter.type
    if kind is not None and argument.type is not None and kind.name != argument.type.name:
        raise RapidError("ERR_CALLPROC", f"{parameter.name} is {parameter.type_name}")
    if not parameter.mode:
        return argument.read()
    atomic = kind is not None and kind.kind in ATOMIC
    objects = kind is not None and kind.kind in ("nonvalue", "semivalue")
    if objects or (parameter.mode == "VAR" and not builtin and not atomic):
        if argument.itself is None:
            raise RapidError("ERR_ARGNOTVAR")
        return argument.itself()
    if argument.refer is None:
        raise RapidError("ERR_ARGNOTVAR")
    return argument.refer()
