"""`%name% arguments;`: which procedure a text names, and which argument is for which parameter
[K §4.5]."""

from collections.abc import Sequence

from rapidgen.rapid.binding.arguments import ArgumentFault, first_fit, match
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.runtime import LateArgument
from rapidgen.runtime.compiler.symbols import FormalParameter, LoadedModule, Routine
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.values import ATOMIC, Value

_WRONG = frozenset({ArgumentFault.SURPLUS, ArgumentFault.UNKNOWN, ArgumentFault.TWICE})


def find(program: Program, name: str, module: LoadedModule | None) -> Routine:
    """The procedure that a text names, as seen from a module. ERR_REFUNKPRC, ERR_CALLPROC."""
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


def arguments(
    routine: Routine, given: Sequence[LateArgument]
) -> tuple[list[Value], dict[str, Value]]:
    """Arguments by position and by Python name. ERR_CALLPROC, ERR_ARGNOTVAR: they do not fit."""
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
