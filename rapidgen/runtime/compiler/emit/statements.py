"""Statements as Python source.

Each function takes the emitter and one node. It compiles the expressions, pays their cost, then
emits guarded lines. A store to a persistent wakes the tasks that wait for it, after the store and
outside the guard.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from rapidgen.rapid.builtins.signatures import marked
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime import unsupported
from rapidgen.runtime.compiler.emit.access import (
    CALLS,
    SHARED,
    SILENT,
    CompiledExpression,
    DataReference,
    Unit,
    by_value,
    calling,
    failing,
    place_of,
    rounded,
    store_lines,
)
from rapidgen.runtime.compiler.emit.expressions import call
from rapidgen.runtime.compiler.emit.writer import Emitter
from rapidgen.runtime.compiler.symbols import CannotCompile, CodeRole, Data
from rapidgen.runtime.values import BOOL, NUM, STRING, Type

# -- Assignments -----------------------------------------------------------------------------------
#
# Stores: assignment, Incr and its kin, CONNECT; waking who watches a persistent.


def _target(unit: Unit, node: n.Expression) -> DataReference:
    """Return a datum that the program may assign."""
    if isinstance(node, n.Placeholder):
        raise CannotCompile("a placeholder is no datum", node)
    place = place_of(unit, node)
    if place is None:
        raise CannotCompile("only variables, persistents and parameters can be assigned", node)
    if place.data.readonly:
        raise CannotCompile(f"{place.data.name} cannot be changed", node)
    return place


def assignment(emitter: Emitter, node: n.Assignment) -> None:
    """Compile `:=`, by value."""
    if isinstance(node.target, n.Placeholder):
        emitter.simple(failing("ERR_EXECPHR"))
        return
    place = _target(emitter.unit, node.target)
    if not place.e.type.is_value:
        raise CannotCompile(f"{place.e.type.name} cannot be assigned", node)
    value = emitter.unit.value_of(node.value, place.e.type, place.e.dims)
    _store(emitter, place, value)


def _store(emitter: Emitter, place: DataReference, value: CompiledExpression) -> None:
    """Assign a compiled value to a place and wake its waiters."""
    kind, data = place.e.type, place.data
    total = CompiledExpression("", kind).take(place.e, value)
    if place.holder or data.storage not in ("local", "global"):
        total.effect = max(total.effect, SHARED if data.storage != "box" else SILENT)
    if not place.holder and not place.e.dims and not place.cell:
        # Writing is no access in the cost model; reading the target was not either.
        total.fails = value.fails or place.data.optional
    total.fails = total.fails or value.risky or bool(place.e.dims)
    lines = _store_lines(emitter, place, value)
    if place.cell and emitter.options.switching:
        total.effect = CALLS
        lines.append(f"R.touch({place.cell})")
    emitter.pay(total)
    emitter.guard(total, lines)
    _wake(emitter, place)
    if total.effect != SILENT:
        emitter.w.close()


def _wake(emitter: Emitter, place: DataReference) -> None:
    if not place.cell:
        return
    w = emitter.w
    if place.data.storage == "cell":
        w.emit(f"if {place.cell}.w:")
    else:
        w.emit(f"_c = {place.cell}")
        w.emit("if _c is not None and _c.w:")
    cell = place.cell if place.data.storage == "cell" else "_c"
    w.depth += 1
    w.emit("R.b = b")
    w.emit(f"{cell}.notify()")
    w.emit("b = R.b")
    w.depth -= 1


def _store_lines(emitter: Emitter, place: DataReference, value: CompiledExpression) -> list[str]:
    data, kind = place.data, place.e.type
    if data.storage == "global":
        emitter.unit.globals_written.add(data.code)
    if place.e.dims:
        return _array_lines(emitter, place, value)
    if kind.kind == "record":
        if data.storage == "local" and not place.holder:
            emitter.function.stored.add(data.code)
            return [f"{data.code} = {by_value(value, kind)}"]
        return [f"{place.e.code}.assign({value.code})"]
    if not place.holder:
        if data.storage in ("local", "global"):
            emitter.function.stored.add(data.code)
            return store_lines(data.code, value, kind, keep=True)
        return _through("_x", f"{_kept(data)}.v", value, kind)
    if place.member:
        return _through("_x", f"{place.holder}.{place.key}", value, kind)
    lines = []
    key = place.key
    if not (key.isidentifier() or key.isdigit()):
        lines.append(f"_i = {key}")
        key = "_i"
    if not _inside(place):
        lines.append(f"{place.holder}[{key}]")  # outside: KeyError
    return lines + _through("_x", f"{place.holder}[{key}]", value, kind)


def _kept(data: Data) -> str:
    return f"PRESENT({data.code})" if data.optional else data.code


def _through(temporary: str, target: str, value: CompiledExpression, kind: Type) -> list[str]:
    """Store through a temporary if the value needs a test."""
    lines = store_lines(temporary, value, kind)
    if len(lines) == 1:
        return [target + lines[0].removeprefix(temporary)]
    return [*lines, f"{target} = {temporary}"]


def _inside(place: DataReference) -> bool:
    """Return True if the last index is inside the array for certain."""
    limits = place.index_range
    dims = place.data.dims
    return limits is not None and bool(dims) and limits[0] >= 1 and limits[1] <= dims[-1]


def _array_lines(emitter: Emitter, place: DataReference, value: CompiledExpression) -> list[str]:
    data = place.data
    known = 0 not in place.e.dims and place.e.dims == value.dims
    if data.storage == "local" and known:
        emitter.function.stored.add(data.code)
        return [f"{data.code} = {by_value(value, place.e.type)}"]
    return [f"ASSIGN({place.e.code}, {value.code})"]


def step(emitter: Emitter, key: str, node: n.ProcedureCall) -> None:
    """Compile Incr, Decr, Add and Clear as assignments."""
    arguments = [a.value for a in node.arguments if a.value is not None]
    if not arguments:
        raise CannotCompile(f"{node.name} takes an argument", node)
    place = _target(emitter.unit, arguments[0])
    kind = place.e.type
    if kind.kind not in ("num", "dnum") or place.e.dims:
        raise CannotCompile(f"{node.name} takes num or dnum, not {kind.name}", node)
    if key == "clear":
        value = CompiledExpression("0", kind, whole=True, exact=True, range=(0, 0))
    else:
        by = (
            emitter.unit.value_of(arguments[1], kind)
            if key == "add" and len(arguments) > 1
            else CompiledExpression("1", kind, whole=True, exact=True, range=(1, 1), literal=True)
        )
        sign = "-" if key == "decr" else "+"
        current = place.e
        value = CompiledExpression(
            f"({current.code} {sign} {by.code})",
            kind,
            whole=current.whole and by.whole,
            risky=not (by.literal or (current.whole and by.whole)),
        ).take(current, by)
    if kind.kind == "dnum" and key != "clear":
        value.code, value.fails = f"WHOLE{value.code}", True
    value.cost += emitter.options.call
    _store(emitter, place, value)


def connect(emitter: Emitter, node: n.Connect) -> None:
    """Compile CONNECT: store the interrupt's number in its variable."""
    place = _target(emitter.unit, node.target)
    trap = emitter.unit.routine_named(node.trap)
    if trap is None or trap.kind != "TRAP":
        emitter.simple(failing("ERR_REFUNKTRP", node.trap))
        return
    if place.e.type.kind != "num" or place.e.dims:
        raise CannotCompile("CONNECT takes an intnum", node)
    code = f"R.connect({place.e.code}, {emitter.unit.keep(trap)})"
    e = calling(code, NUM, place.e)
    lines = _through("_x", place.e.code, e, NUM)
    if place.data.storage == "global":
        emitter.unit.globals_written.add(place.data.code)
    if place.data.storage == "local" and not place.holder:
        emitter.function.stored.add(place.data.code)
    emitter.simple(e, *lines)


# -- Branches and loops ----------------------------------------------------------------------------
#
# IF, TEST, FOR and WHILE.
#
# Their conditions are the statement for RETRY and TRYNEXT: an error in a condition makes TRYNEXT
# skip the whole of it [K §7.2].


def if_statement(
    emitter: Emitter,
    branches: Sequence[tuple[n.Expression, Sequence[n.Statement]]],
    otherwise: Sequence[n.Statement] | None,
) -> None:
    """Compile IF, also the compact form."""
    conditions = [emitter.unit.condition(c) for c, _ in branches]
    _select(emitter, [c.code for c in conditions], conditions, [b for _, b in branches], otherwise)


def test_statement(emitter: Emitter, node: n.Test) -> None:
    """Compile TEST; the subject is evaluated once."""
    subject = emitter.unit.expression(node.subject)
    name = emitter.unit.temporary()
    codes, parts = [], []
    for case in node.cases:
        values = [
            emitter.unit.value_of(v, subject.type, subject.dims, "CASE value") for v in case.values
        ]
        codes.append(" or ".join(f"{name} == {v.code}" for v in values))
        part = CompiledExpression("", BOOL, ops=len(values)).take(*values)
        parts.append(part)
    if not node.cases:
        emitter.simple(subject, f"{name} = {subject.code}")
        for statement in node.default or ():
            emitter.statement(statement)
        return
    codes[0] = codes[0].replace(name, f"({name} := {subject.code})", 1)
    parts[0].take(subject)
    _select(emitter, codes, parts, [c.body for c in node.cases], node.default)


def _select(
    emitter: Emitter,
    codes: list[str],
    conditions: list[CompiledExpression],
    bodies: list[Sequence[n.Statement]],
    otherwise: Sequence[n.Statement] | None,
) -> None:
    """Emit the first body whose condition is true.

    The statement pays for its first condition, each branch for the conditions evaluated after it.
    """
    w = emitter.w
    everything = CompiledExpression("", BOOL).take(*conditions)
    first = conditions[0]
    emitter.pay(CompiledExpression("", BOOL, ops=first.ops, cost=first.cost))
    later = [c.ops * emitter.options.operator + c.cost for c in conditions]
    chosen = ""
    if everything.effect == CALLS or (emitter.function.guarded and everything.fails):
        chosen = emitter.unit.temporary()
        chain = " else ".join(f"{i} if {c}" for i, c in enumerate(codes, start=1))
        emitter.guard(everything, [f"{chosen} = {chain} else 0"], skip=f"{chosen} = -1")
    w.close()
    for i, (code, body) in enumerate(zip(codes, bodies, strict=True), start=1):
        word = "if" if i == 1 else "elif"
        w.emit(f"{word} {f'{chosen} == {i}' if chosen else code}:")
        _branch(emitter, body, sum(later[1:i]))
    remaining = sum(later[1:])
    if otherwise is not None or remaining:
        w.emit(f"elif {chosen} == 0:" if chosen else "else:")
        _branch(emitter, otherwise or (), remaining)


def _branch(emitter: Emitter, body: Sequence[n.Statement], looked: int) -> None:
    w = emitter.w
    if looked and emitter.options.accounting != "none":
        w.depth += 1
        # A program stopped here has already chosen the branch.
        w.token = _first(body, w.token)
        w.cost(looked)
        if emitter.options.accounting == "statement":
            w.close()
        w.depth -= 1
    emitter.block_of(body)


def _first(body: Sequence[n.Statement], otherwise: int) -> int:
    """Return the token of the first statement of a list."""
    return next((s.first for s in body if not isinstance(s, n.Label)), otherwise)


def while_loop(emitter: Emitter, node: n.While) -> None:
    """Compile WHILE."""
    w = emitter.w
    condition = emitter.unit.condition(node.condition)
    if condition.effect == SILENT and not condition.fails:
        _silent_while(emitter, node, condition)
        return
    simple = condition.effect != CALLS and not (emitter.function.guarded and condition.fails)
    emitter.pay(condition)
    if simple:
        w.close()
        w.emit(f"while {condition.code}:")
        w.depth += 1
    else:
        name = emitter.unit.temporary()
        w.close()
        w.emit("while True:")
        w.depth += 1
        # Paid before the loop and at the end of each pass.
        emitter.guard(condition, [f"{name} = {condition.code}"], skip=f"{name} = False")
        w.emit(f"if not {name}: break")
    emitter.loop_body(node.body, condition, node.first)


def _silent_while(emitter: Emitter, node: n.While, condition: CompiledExpression) -> None:
    """Compile a WHILE whose condition has no visible effect.

    Its cost is paid together with the start of the pass, or with the statements after the loop.
    """
    w = emitter.w
    w.close()
    w.emit(f"while {condition.code}:")
    w.depth += 1
    emitter.pay(condition)
    emitter.loop_body(node.body)
    w.token = node.first
    emitter.pay(condition)


def for_loop(emitter: Emitter, node: n.For) -> None:
    """Compile FOR: limits and step are evaluated once [K §4.15]."""
    w = emitter.w
    start = emitter.unit.value_of(node.start, NUM, (), "start")
    end = emitter.unit.value_of(node.end, NUM, (), "end")
    step = emitter.unit.value_of(node.step, NUM, (), "step") if node.step is not None else None
    parts = [start, end] + ([step] if step else [])
    total = CompiledExpression("", NUM).take(*parts)
    name = loop_variable(node)
    limits = _limits(start, end, step)
    rising = start.range and end.range and start.range[1] <= end.range[0]
    if rising and start.whole and end.whole and step is None:
        code = f"range({start.code}, {end.code} + 1)"
    else:
        codes = [rounded(p, NUM) for p in parts] + ([] if step else ["None"])
        code = f"STEPS({', '.join(codes)})"
    if total.effect == CALLS or (emitter.function.guarded and total.fails):
        values = emitter.unit.temporary()
        emitter.pay(total)
        emitter.guard(total, [f"{values} = {code}"], skip=f"{values} = ()")
        code = values
    else:
        emitter.pay(total)
    w.close()
    if node.first in emitter.resumed:
        emitter.resumed.remove(node.first)
        code = f"AFTER({code}, {name})"
    w.emit(f"for {name} in {code}:")
    w.depth += 1
    complete = start.whole and (step is None or step.whole)
    with loop_bound(emitter.unit, node, complete=complete, limits=limits):
        # A program stopped here is already in the pass.
        w.token = _first(node.body, node.first)
        w.cost(emitter.options.statement)
        if emitter.options.accounting == "statement":
            w.close()
        emitter.loop_body(node.body)


@contextmanager
def loop_bound(
    unit: Unit, node: n.For, *, complete: bool, limits: tuple[int, int] | None
) -> Iterator[None]:
    """Bind the variable of a FOR to a Python local.

    It hides other names.
    """
    outer, unit.names = unit.names, unit.names.loop(node)
    variable = unit.names.names[node.variable.lower()]
    unit.locals[variable] = Data(
        node.variable,
        "LOOP",
        NUM,
        (),
        "local",
        loop_variable(node),
        whole=complete,
        range=limits,
        readonly=True,
    )
    yield
    del unit.locals[variable]
    unit.names = outer


def loop_variable(node: n.For) -> str:
    """Return the Python local of a FOR, equal in all compilations."""
    return f"l{node.first}_{node.variable.lower()}"


def _limits(
    start: CompiledExpression, end: CompiledExpression, step: CompiledExpression | None
) -> tuple[int, int] | None:
    """Return the range of a loop variable."""
    if start.range is None or end.range is None or not (start.whole and end.whole):
        return None
    if step is not None and not step.whole:
        return None
    return min(start.range[0], end.range[0]), max(start.range[1], end.range[1])


# -- Late binding ----------------------------------------------------------------------------------
#
# `%name% arguments;` [K §4.5]: what is called is known when it is; arguments are thunks.


def late_call(emitter: Emitter, node: n.LateCall) -> None:
    """Compile `%name% arguments;` [K §4.5].

    Arguments are thunks, by value and by reference.
    """
    unit = emitter.unit
    name = unit.value_of(node.procedure, STRING)
    parts, codes = [name], []
    for argument in node.arguments:
        code, part = _argument(unit, argument)
        codes.append(code)
        parts += part
    module = unit.keep(unit.module)
    inside = "".join(c + ", " for c in codes)
    code = f"R.late({name.code}, {module}, ({inside}))"
    emitter.simple(calling(code, NUM, *parts, cost=emitter.options.call))


def _argument(unit: Unit, argument: n.Argument) -> tuple[str, list[CompiledExpression]]:
    name = repr(argument.name.lower() if argument.name else None)
    if argument.kind == "switch":
        return f"LATE({name}, None, None)", []
    node = argument.value
    assert node is not None
    if argument.kind == "conditional" and isinstance(node, n.Name):
        data = unit.data(node.name)
        if data is None or not data.optional:
            raise CannotCompile("a conditional argument names an optional parameter", argument)
        value = f"{data.code}.v" if data.storage in ("box", "ref") else data.code
        code = f"LATE({name}, lambda: {value}, lambda: {data.code})"
        return f"(None if {data.code} is None else {code})", []
    last = ", required=True" if argument.name and argument.kind == "required" else ""
    place = place_of(unit, node)
    if place is None:
        e = unit.expression(node)
        t = unit.keep(e.type)
        return f"LATE({name}, lambda: {by_value(e, e.type)}, None, {t}{last})", [e]
    t = unit.keep(place.e.type)
    read = by_value(place.e, place.e.type)
    ref = _reference(unit, place)
    return f"LATE({name}, lambda: {read}, {ref}, {t}, lambda: {place.e.code}{last})", [place.e]


def _reference(unit: Unit, place: DataReference) -> str:
    """Return a lambda that makes a Ref to a place, or None."""
    data, e = place.data, place.e
    if data.readonly or e.type.kind in ("nonvalue", "semivalue"):
        return "None"
    if not place.holder and data.storage in ("box", "cell", "ref"):
        return f"lambda: {data.code}"
    if not place.holder and data.storage == "global":
        return f"lambda: {unit.linker.global_ref(data)}"
    t, cell = unit.keep(e.type), place.cell or "None"
    if place.holder and place.atomic:
        maker = "MEMBER" if place.member else "ITEM"
        key = repr(place.key) if place.member else place.key
        return f"lambda: {maker}({place.holder}, {key}, {t}, {data.name!r}, {cell})"
    return f"lambda: PART({e.code}, {t}, {data.name!r}, {cell}, {e.dims!r})"


# -- All statements --------------------------------------------------------------------------------
#
# Statements: which part writes which; procedure calls, and what leaves a routine.


def compile_statement(emitter: Emitter, node: n.Statement) -> None:
    """Compile a statement."""
    w = emitter.w
    match node:
        case n.Assignment():
            assignment(emitter, node)
        case n.ProcedureCall():
            _procedure(emitter, node)
        case n.If():
            if_statement(emitter, [(b.condition, b.body) for b in node.branches], node.otherwise)
        case n.CompactIf():
            if_statement(emitter, [(node.condition, [node.statement])], None)
        case n.For():
            for_loop(emitter, node)
        case n.While():
            while_loop(emitter, node)
        case n.Test():
            test_statement(emitter, node)
        case n.Return():
            _return(emitter, node)
        case n.Goto():
            emitter.goto(node)
        case n.Raise():
            _raise(emitter, node)
        case n.Retry() | n.TryNext():
            _recover(emitter, node)
        case n.Exit():
            emitter.pay(CompiledExpression("", NUM, effect=CALLS))
            w.emit("R.b = b")
            w.emit("R.exit()")
            w.close()
        case n.Connect():
            connect(emitter, node)
        case n.LateCall():
            late_call(emitter, node)
        case n.PlaceholderStatement():
            emitter.simple(failing("ERR_EXECPHR"))
        case n.Label():
            pass


def _procedure(emitter: Emitter, node: n.ProcedureCall) -> None:
    routine = emitter.unit.routine_named(node.name)
    key = node.name.lower()
    if routine is None or routine.kind != "PROC":
        option = key in unsupported.option_routines()
        missing = calling(f"R.missing({node.name!r})", NUM)
        emitter.simple(missing if option else failing("ERR_REFUNKPRC", node.name))
        return
    if routine.node is None and key in marked("steps"):
        step(emitter, key, node)
        return
    e = call(emitter.unit, routine, node)
    emitter.simple(e)


def _return(emitter: Emitter, node: n.Return) -> None:
    w = emitter.w
    kind = emitter.unit.routine.type
    if emitter.function.handler is CodeRole.UNDO:
        raise CannotCompile("RETURN is not permitted in UNDO", node)
    if kind is not None:
        if node.value is None:
            raise CannotCompile("RETURN of a function needs a value", node)
        e = emitter.unit.value_of(node.value, kind)
        apart = emitter.function.outer is not None
        target = "R.ret" if apart else "_r"
        lines = [f"{target} = {by_value(e, kind)}"]
        e.fails = e.fails or e.risky
        if not apart and not (emitter.function.guarded and e.fails):
            emitter.pay(e)
            w.emit("R.b = b")
            w.synced = e.effect == CALLS
            w.emit(f"return {by_value(e, kind)}")
            w.synced = False
            w.close()
            return
        emitter.pay(e)
        emitter.guard(e, lines)
        w.emit("R.b = b")
        w.emit("return 2" if apart else "return _r")
    else:
        if node.value is not None:
            raise CannotCompile("RETURN takes a value only in a function", node)
        emitter.pay(CompiledExpression("", NUM))
        w.emit("R.b = b")
        w.emit("return" if emitter.function.outer is None else "return 2")
    w.close()


def _raise(emitter: Emitter, node: n.Raise) -> None:
    w = emitter.w
    if node.number is None:
        if emitter.function.handler is not CodeRole.HANDLER:
            raise CannotCompile(
                "RAISE without a number is permitted only in an error handler", node
            )
        emitter.pay(CompiledExpression("", NUM))
        w.emit("R.b = b")
        w.emit("return 3")
        w.close()
        return
    if emitter.function.handler is CodeRole.HANDLER:
        number = emitter.unit.value_of(node.number, NUM)
        emitter.simple(calling(f"R.instead({number.code})", NUM, number))
        w.emit("return 3")
        w.close()
        return
    if emitter.function.handler.is_handler:
        raise CannotCompile("RAISE with a number is not permitted in a handler", node)
    number = emitter.unit.value_of(node.number, NUM)
    emitter.simple(calling(f"R.throw({number.code})", NUM, number))


def _recover(emitter: Emitter, node: n.Retry | n.TryNext) -> None:
    if emitter.function.handler is not CodeRole.HANDLER:
        raise CannotCompile("RETRY and TRYNEXT are permitted only in an error handler", node)
    emitter.pay(CompiledExpression("", NUM))
    emitter.w.emit("R.b = b")
    emitter.w.emit("return 0" if isinstance(node, n.Retry) else "return 1")
    emitter.w.close()
