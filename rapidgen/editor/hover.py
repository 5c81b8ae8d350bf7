"""Descriptions of symbols as Markdown: declaration, comment, value, pose, release.

The text of a program comes from its own source: the declaration as it is written, and the comment
lines directly above it or behind it.
"""

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

from rapidgen.diagnostics import Span
from rapidgen.editor.navigation import name_span
from rapidgen.editor.workspace import View
from rapidgen.rapid.binding import (
    ComponentSymbol,
    DataSymbol,
    LabelSymbol,
    ModuleSymbol,
    RoutineSymbol,
    Symbol,
    TypeSymbol,
    value_of,
)
from rapidgen.rapid.binding.constants import NotConstant, evaluate
from rapidgen.rapid.binding.lookup import scope_at
from rapidgen.rapid.binding.names import called
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.builtins.signatures import Description, Signature, Value, Version
from rapidgen.rapid.syntax.nodes import Name, Parameter, ProcedureCall, RoutineDeclaration
from rapidgen.rapid.syntax.source import Source
from rapidgen.rapid.syntax.walk import walk

_LONGEST: Final = 400
"""Characters of a declaration or a value."""
_NO_AXIS: Final = 9e8
"""External axes with values from here on do not exist [K §2.13]: RAPID writes 9E9."""
_LINE_END: Final = re.compile(r"\r\n?|\n")


@dataclass(frozen=True, slots=True)
class Hover:
    """Markdown about the symbol at a place, and the place of its name."""

    text: str
    span: Span


def hover(view: View, line: int, column: int) -> Hover | None:
    """Return a description of the symbol at a line and column; None without a symbol."""
    token = view.names.token_at(line, column)
    if token is None:
        return None
    symbol = view.names.near(token)[token]
    return Hover(describe(view, symbol, token), name_span(view, token))


def describe(view: View, symbol: Symbol, token: int = -1) -> str:
    """Return Markdown about a symbol; `token` is where a local constant is named."""
    parts = [f"```rapid\n{headline(symbol)}\n```"]
    comment = comment_of(symbol)
    if comment:
        parts.append(comment)
    if symbol.module is None:
        known = signatures.described(symbol.name)
        parts += [known.text] if known.text else []
        parts += [f"```rapid\n{known.example}\n```"] if known.example else []
        parts += _releases(symbol, known)
    if isinstance(symbol, DataSymbol):
        parts += _value(view, symbol, token)
    where = _origin(view, symbol)
    if where:
        parts.append(where)
    return "\n\n".join(parts)


# -- declarations --------------------------------------------------------------------------------


def headline(symbol: Symbol) -> str:
    """Return the declaration of a symbol in one line, as RAPID writes it."""
    local = "LOCAL " if symbol.local else ""
    match symbol:
        case RoutineSymbol(node=RoutineDeclaration() as node):
            source = symbol.module.tree.source if symbol.module else None
            return _header(node, source) if source else symbol.name
        case RoutineSymbol(signature=Signature() as signature):
            return signature_text(signature)
        case DataSymbol(node=Parameter() as node):
            return f"{'parameter'} {parameter_text(node)}"
        case DataSymbol(kind="LOOP"):
            return f"FOR {symbol.name} (num)"
        case DataSymbol(kind="INSTALLED"):
            return f"{symbol.type} {symbol.name}"
        case DataSymbol(node=node):
            if node is not None and symbol.module is not None:
                return _flat(symbol.module.tree.source, node.first, node.last).rstrip(";")
            return f"{symbol.kind} {symbol.type} {symbol.name}"
        case TypeSymbol(kind="ALIAS"):
            return f"{local}ALIAS {symbol.base} {symbol.name}"
        case TypeSymbol():
            members = "; ".join(f"{of} {name}" for of, name in symbol.components or ())
            word = "RECORD" if symbol.components else "type"
            return f"{local}{word} {symbol.name}" + (f" {members};" if members else "")
        case ComponentSymbol():
            record = symbol.record.name if symbol.record is not None else ""
            return f"{symbol.type} {record}.{symbol.name}"
        case ModuleSymbol(node=node):
            words = f"({','.join(node.attributes)})" if node and node.attributes else ""
            return f"MODULE {symbol.name}{words}"
        case LabelSymbol():
            return f"{symbol.name}:"
    return f"{local}{symbol.kind} {symbol.name}"


def _header(node: RoutineDeclaration, source: Source) -> str:
    last = node.parameters[-1].last if node.parameters else node.name_token
    tokens = source.tokens
    if node.kind != "TRAP":
        while last < node.last and tokens[last] != ")":
            last += 1
    return _flat(source, node.first, min(last, len(tokens) - 1))


def _flat(source: Source, first: int, last: int) -> str:
    """Return the text of some tokens in one line, without comments."""
    parts: list[str] = []
    for at in range(first, min(last + 1, len(source.tokens))):
        parts.append(source.tokens[at])
        if at < last:
            parts.append(" " if source.gaps[at] else "")
    text = "".join(parts)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."


def parameter_text(parameter: Parameter) -> str:
    """Return a parameter as RAPID writes it, without a comma."""
    mode = f"{parameter.mode} " if parameter.mode else ""
    stars = "{" + ",".join("*" * parameter.dimensions) + "}" if parameter.dimensions else ""
    mark = "\\" if parameter.optional else ""
    return f"{mark}{mode}{parameter.type} {parameter.name}{stars}"


def parameter_labels(parameters: Sequence[Parameter]) -> list[str]:
    """Return the text of each parameter, with what separates it from the one before."""
    result = []
    before: Parameter | None = None
    for parameter in parameters:
        text = parameter_text(parameter)
        if before is None:
            separator = ""
        elif parameter.group >= 0 and parameter.group == before.group:
            text, separator = text.removeprefix("\\"), " | "
        else:
            separator = " " if parameter.optional else ", "
        result.append(separator + text)
        before = parameter
    return result


def signature_text(signature: Signature) -> str:
    """Return the header of a built-in routine."""
    of = f"{signature.type} " if signature.type else ""
    if not signature.checked:
        return f"{signature.kind} {of}{signature.name}(...)"
    return (
        f"{signature.kind} {of}{signature.name}({''.join(parameter_labels(signature.parameters))})"
    )


def comment_of(symbol: Symbol) -> str:
    """Return the comment lines directly above a declaration, or behind it on its line."""
    node, module = symbol.node, symbol.module
    if node is None or module is None or isinstance(symbol, LabelSymbol) or symbol.kind == "LOOP":
        return ""
    source = module.tree.source
    if isinstance(node, Parameter) or node.last >= len(source.tokens):
        return ""
    above = source.lead if node.first == 0 else source.gaps[node.first - 1]
    lines = [line.strip() for line in _LINE_END.split(above)][:-1]
    if node.first > 0:
        lines = lines[1:]  # the first one belongs to the declaration before
    found: list[str] = []
    for line in reversed(lines):
        if not line.startswith("!"):
            break
        text = line.lstrip("!*").strip(" *-=#")
        if text:
            found.insert(0, text)
    behind = _LINE_END.split(source.gaps[node.last])[0].strip()
    is_line = source.line(node.first) == source.line(node.last)
    if not found and is_line and behind.startswith("!"):
        found = [behind.lstrip("!").strip()]
    return "  \n".join(_escaped(line) for line in found)


def _escaped(text: str) -> str:
    """Return text of a program without marks of Markdown."""
    return re.sub(r"([\\`*_{}\[\]<>#|])", r"\\\1", text)


def _releases(symbol: Symbol, known: Description) -> list[str]:
    """Return the releases and the option that have a built-in name, and its changed arguments."""
    signature = symbol.signature if isinstance(symbol, RoutineSymbol) else None
    since, parts, arguments = known.since, [], []
    if signature is not None:
        since = signature.since or since
        for parameter in signature.parameters:
            came = signature.argument_version("came", parameter.name)
            went = signature.argument_version("went", parameter.name)
            for word, release in (("from", came), ("before", went)):
                if release is not None:
                    arguments.append(f"`\\{parameter.name}` {word} RobotWare {_release(release)}")
    if since is not None:
        parts.append(f"from RobotWare {_release(since)}")
    if signature is not None and signature.until is not None:
        parts.append(f"before RobotWare {_release(signature.until)}")
    if known.option:
        parts.append(f"with the option {known.option}")
    elif signature is not None and not signature.everywhere and since is None:
        parts.append("only with an option of RobotWare")
    lines = [f"Available {' and '.join(parts)}."] if parts else []
    return [*lines, f"Arguments: {', '.join(dict.fromkeys(arguments))}."] if arguments else lines


def _release(version: Version) -> str:
    return f"{version[0]}.{version[1]}"


def _origin(view: View, symbol: Symbol) -> str:
    """Return where a symbol of the program is declared."""
    if symbol.kind == "INSTALLED":
        return "Object of the controller's configuration."
    if symbol.module is None or isinstance(symbol, ModuleSymbol):
        return "" if symbol.module is not None else "Built in."
    name = _escaped(symbol.module.tree.name)
    task = f", task {_escaped(view.task.name)}" if view.task.name else ""
    routine = symbol.routine if isinstance(symbol, DataSymbol) else None
    if routine is not None:
        return f"Routine {_escaped(routine.name)}, module {name}{task}."
    return f"Module {name}{task}."


# -- values --------------------------------------------------------------------------------------


def _value(view: View, symbol: DataSymbol, token: int) -> list[str]:
    """Return lines about the value: poses of targets, results of constant expressions."""
    scope = scope_at(view.module, token) if token >= 0 else view.module
    value = initial_value(view, symbol, token)
    of = (scope.module.type_of(symbol) or "").lower()
    if value is None or "{" in of:
        return []
    intro = "Initial: " if symbol.kind != "CONST" else ""
    lines = _target_lines(of, value)
    if lines and of in ("robtarget", "jointtarget"):
        reach = _reachability(view, of, value, token)
        lines += [reach] if reach else []
    if lines:
        return [intro + "  \n".join(lines)]
    is_plain = symbol.module is not None and len(headline(symbol)) < _LONGEST
    is_literal = isinstance(value, tuple) or symbol.kind != "CONST"
    return [] if is_plain and is_literal else [f"Value: `{value_text(value)}`"]


def initial_value(view: View, symbol: DataSymbol, token: int = -1) -> Value | None:
    """Return the value of a constant, or the initial value of other data; None if unknown."""
    scope = scope_at(view.module, token) if token >= 0 else view.module
    if symbol.kind == "CONST":
        return value_of(symbol, scope)
    if symbol.module is None:
        predefined = signatures.constant(symbol.name)
        return predefined.value if predefined is not None else None
    inside = symbol.module if symbol.routine is None else scope
    expected = inside.module.type_of(symbol)
    if symbol.initial is None or expected is None:
        return None
    try:
        return evaluate(symbol.initial, inside, expected)
    except NotConstant:
        return None


def _reachability(view: View, of: str, value: Value, token: int) -> str:
    """Return whether the program's robot reaches a target; empty if that is unknown."""
    # Kinematics and models are loaded for the first target only, not when the server starts.
    from rapidgen.editor.reachability import Frames, reachability, robot_of

    robot = robot_of(view.program.program)
    if robot is None:
        return ""
    moved = Frames()
    for of_data, name, data in _frames_of_move(view, token):
        if data is None:
            return ""
        if of_data == "tooldata" and name.lower() != "tool0":
            moved = replace(moved, tool=_escaped(name), tool_value=data)
        elif of_data == "wobjdata" and name.lower() != "wobj0":
            moved = replace(moved, work_object=_escaped(name), work_object_value=data)
    return reachability(robot, of, value, moved)


def _frames_of_move(view: View, token: int) -> Iterator[tuple[str, str, Value | None]]:
    """Yield type, name and value of the tool and work object of the call around a token."""
    if token < 0:
        return
    scope = scope_at(view.module, token)
    for node in walk(view.module.tree):
        if isinstance(node, ProcedureCall) and node.first <= token <= node.last:
            routine = called(scope.find(node.name))
            if isinstance(routine, RoutineSymbol):
                yield from _frames_of_call(view, node, routine, token)


def _frames_of_call(
    view: View, call: ProcedureCall, routine: RoutineSymbol, token: int
) -> Iterator[tuple[str, str, Value | None]]:
    parameters = list(routine.parameters or ())
    required = iter([p for p in parameters if not p.optional])
    by_name = {p.name.lower(): p for p in parameters}
    for argument in call.arguments:
        if argument.kind == "required" and argument.name is None:
            parameter = next(required, None)
        else:
            parameter = by_name.get((argument.name or "").lower())
        if parameter is None or parameter.type.lower() not in ("tooldata", "wobjdata"):
            continue
        of, value = parameter.type.lower(), argument.value
        symbol = None
        if isinstance(value, Name):
            symbol = scope_at(view.module, token).find(value.name)
        if isinstance(value, Name) and isinstance(symbol, DataSymbol):
            yield of, value.name, initial_value(view, symbol, token)
        elif argument.kind != "switch":
            yield of, "", None


def value_text(value: Value) -> str:
    """Return a value as RAPID writes it, shortened."""
    text = _value_text(value)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."


def _value_text(value: Value) -> str:
    if isinstance(value, tuple):
        return f"[{','.join(map(_value_text, value))}]"
    if isinstance(value, bool):
        return str(value).upper()
    if isinstance(value, str):
        return '"' + value.replace('"', '""') + '"'
    return f"{value:.7g}"


def _target_lines(of: str, value: Value) -> list[str]:
    """Return the parts of a target or frame with their units; empty for other types.

    Positions are in mm, rotations in degrees (z, y, x: as RAPID's EulerZYX), axes in degrees or mm.
    """
    match of, value:
        case "robtarget", (trans, rot, conf, external):
            return [
                *_frame_lines(trans, rot),
                f"configuration {_value_text(conf)}",
                *_axes(external),
            ]
        case "jointtarget", (robot, external):
            return [f"axes {_numbers(robot, '°')}", *_axes(external)]
        case "pose", (trans, rot):
            return _frame_lines(trans, rot)
        case "tooldata", (_, (trans, rot), (mass, *_)):
            return ["tool centre point:", *_frame_lines(trans, rot), f"mass {_value_text(mass)} kg"]
        case "wobjdata", (_, _, _, user, object_):
            lines = []
            for name, frame in (("user frame", user), ("object frame", object_)):
                if isinstance(frame, tuple) and len(frame) == 2:
                    lines += [f"{name}:", *_frame_lines(*frame)]
            return lines
        case "speeddata", (tcp, orient, *_):
            return [f"{_value_text(tcp)} mm/s, {_value_text(orient)} °/s"]
        case "zonedata", (fine, tcp, *_):
            return ["stop point" if fine is True else f"zone of {_value_text(tcp)} mm"]
    return []


def _frame_lines(trans: Value, rot: Value) -> list[str]:
    lines = []
    if isinstance(trans, tuple) and len(trans) == 3:
        x, y, z = map(_value_text, trans)
        lines.append(f"x {x}, y {y}, z {z} mm")
    angles = _angles(rot)
    if angles is not None:
        z, y, x = (f"{angle:.2f}" for angle in angles)
        lines.append(f"rotation z {z}°, y {y}°, x {x}°")
    return lines


def _angles(rot: Value) -> tuple[float, float, float] | None:
    """Return the rotations about z, y and x in degrees of a quaternion; None if it is none."""
    if not isinstance(rot, tuple) or len(rot) != 4:
        return None
    numbers = [float(q) for q in rot if isinstance(q, int | float)]
    length = math.hypot(*numbers) if len(numbers) == 4 else 0.0
    if not 0.9 < length < 1.1:
        return None
    w, x, y, z = (number / length for number in numbers)
    sine = max(-1.0, min(1.0, 2 * (w * y - z * x)))
    yaw = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    degrees = (math.degrees(yaw), math.degrees(math.asin(sine)), math.degrees(roll))
    a, b, c = (0.0 if abs(angle) < 5e-3 else angle for angle in degrees)
    return a, b, c


def _axes(external: Value) -> list[str]:
    """Return the external axes that exist."""
    if not isinstance(external, tuple):
        return []
    known = [
        f"eax_{'abcdef'[k]} {_value_text(axis)}"
        for k, axis in enumerate(external[:6])
        if isinstance(axis, int | float) and abs(axis) < _NO_AXIS
    ]
    return [f"external axes: {', '.join(known)}"] if known else []


def _numbers(values: Value, unit: str) -> str:
    if not isinstance(values, tuple):
        return _value_text(values)
    return ", ".join(f"{_value_text(value)}{unit}" for value in values)
