"""ArgName: the name of the datum that a parameter stands for, back through the calls.

Values carry no names: the calls are looked up in the trees, from the place of each routine.
"""

import sys
from collections.abc import Callable, Iterator
from types import FrameType
from typing import TypeAlias

from rapidgen.rapid.binding.arguments import match
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.compiler.code_info import CodeRole, Codes
from rapidgen.runtime.compiler.resume import find
from rapidgen.runtime.compiler.symbols import Data, LoadedModule, Routine
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.values import Ref

Call: TypeAlias = n.ProcedureCall | n.FunctionCall | n.LateCall
FindData: TypeAlias = Callable[[LoadedModule | None, str], Data | None]


def arg_name(codes: Codes, find_data: FindData, parameter: str, number: Ref | None = None) -> str:
    """Name of the datum behind `parameter` of the routine that asks [S4 datasys 3-ArgName].

    For an element or a component the whole datum's; ERR_ARGNAME for an expression. With
    `number` that gets the error instead, and the name is empty.
    """
    try:
        return _named(codes, find_data, parameter)
    except RapidError as error:
        if number is None:
            raise
        number.set(error.number)
        return ""


def _named(codes: Codes, find_data: FindData, name: str) -> str:
    places = _places(codes, sys._getframe(2))
    routine, _ = next(places)
    while (at := routine.by_name.get(name.lower())) is not None:
        caller, token = next(places, (None, 0))
        if caller is None:
            raise RapidError("ERR_ARGNAME")
        value = _argument(caller, token, routine, at)
        while isinstance(value, n.Index | n.Member):
            value = value.base
        if not isinstance(value, n.Name):
            raise RapidError("ERR_ARGNAME")
        routine, name = caller, value.name
    data = None if _is_local(routine, name) else find_data(routine.module, name.lower())
    return data.name if data is not None else name


def _places(codes: Codes, frame: FrameType | None) -> Iterator[tuple[Routine, int]]:
    """Routines of the call stack, innermost first, and the token at which each is."""
    inside: Routine | None = None
    while frame is not None:
        compiled = codes.get(frame.f_code.co_filename)
        if compiled is not None:
            inner = compiled.role(frame.f_code) is not CodeRole.ROUTINE
            if inside is not compiled.routine:
                yield compiled.routine, compiled.tokens[frame.f_lineno]
            # A handler's or a deep part's own frame comes before that of its routine.
            inside = compiled.routine if inner else None
        frame = frame.f_back


def _argument(caller: Routine, token: int, routine: Routine, at: int) -> n.Expression | None:
    """What a call in the statement at `token` gives to a parameter."""
    for call in _calls(caller, token):
        if not isinstance(call, n.LateCall) and call.name.lower() != routine.name.lower():
            continue
        matching = match(routine.parameters, call.arguments, lambda _, among: among[0])
        for pair in matching.pairs:
            if pair.parameter == at:
                return pair.argument.value
    return None


def _calls(caller: Routine, token: int) -> Iterator[Call]:
    node = caller.node
    assert node is not None
    bodies = [node.body]
    bodies += [part.body for part in (node.backward, node.error, node.undo) if part is not None]
    for body in bodies:
        path = find(body, token)
        if path is not None:
            inner, i = path[-1]
            yield from (at for at in walk(inner[i]) if isinstance(at, Call))


def _is_local(routine: Routine, name: str) -> bool:
    node = routine.node
    return node is not None and any(d.name.lower() == name.lower() for d in node.data)
