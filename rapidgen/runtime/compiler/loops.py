"""IF, TEST, FOR and WHILE.

Their conditions are the statement for RETRY and TRYNEXT: an error in a condition makes TRYNEXT
skip the whole of it [K §7.2].
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.context import CALLS, SILENT, CompiledExpression, Unit
from rapidgen.runtime.compiler.emitter import Emitter
from rapidgen.runtime.compiler.symbols import Data
from rapidgen.runtime.compiler.value_copies import rounded
from rapidgen.runtime.values import BOOL, NUM


def if_statement(
    emitter: Emitter,
    branches: Sequence[tuple[n.Expression, Sequence[n.Statement]]],
    otherwise: Sequence[n.Statement] | None,
) -> None:
    """IF: also the compact one."""
    conditions = [emitter.unit.condition(c) for c, _ in branches]
    _select(emitter, [c.code for c in conditions], conditions, [b for _, b in branches], otherwise)


def test_statement(emitter: Emitter, node: n.Test) -> None:
    """TEST: its subject is looked at once."""
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
    """Run the first body whose condition holds.

    The statement pays for its first condition; each branch for those looked at after it.
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
        # A program that stops here has chosen already.
        w.token = _first(body, w.token)
        w.cost(looked)
        if emitter.options.accounting == "statement":
            w.close()
        w.depth -= 1
    emitter.block_of(body)


def _first(body: Sequence[n.Statement], otherwise: int) -> int:
    """Token of the first statement of a list."""
    return next((s.first for s in body if not isinstance(s, n.Label)), otherwise)


def while_loop(emitter: Emitter, node: n.While) -> None:
    """WHILE."""
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
    """A condition that nothing outside can see is paid after it was looked at: together
    with what begins the pass, or with what follows the loop."""
    w = emitter.w
    w.close()
    w.emit(f"while {condition.code}:")
    w.depth += 1
    emitter.pay(condition)
    emitter.loop_body(node.body)
    w.token = node.first
    emitter.pay(condition)


def for_loop(emitter: Emitter, node: n.For) -> None:
    """FOR: limits and step are worked out once [K §4.15]."""
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
        # A program that stops here is in the pass already.
        w.token = _first(node.body, node.first)
        w.cost(emitter.options.statement)
        if emitter.options.accounting == "statement":
            w.close()
        emitter.loop_body(node.body)


@contextmanager
def loop_bound(
    unit: Unit, node: n.For, *, complete: bool, limits: tuple[int, int] | None
) -> Iterator[None]:
    """The variable of a FOR stands for a Python local, and hides what has its name."""
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
    """The Python local of a FOR, the same wherever its routine is compiled."""
    return f"l{node.first}_{node.variable.lower()}"


def _limits(
    start: CompiledExpression, end: CompiledExpression, step: CompiledExpression | None
) -> tuple[int, int] | None:
    """Range of a loop variable."""
    if start.range is None or end.range is None or not (start.whole and end.whole):
        return None
    if step is not None and not step.whole:
        return None
    return min(start.range[0], end.range[0]), max(start.range[1], end.range[1])
