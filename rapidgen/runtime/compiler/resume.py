"""Code compiled for a place inside a routine: resumption and watches.

Both compile a routine again with other surroundings. They depend on stable names: the Python local
of a datum or loop variable is the same in every compilation of a routine, so that the values of an
old frame fit the new function.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace

from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.parser import parse
from rapidgen.runtime.compiler.emit.access import (
    CALLS,
    CompiledExpression,
    Options,
    Unit,
    undeclared,
)
from rapidgen.runtime.compiler.emit.routine import RoutineCompiler
from rapidgen.runtime.compiler.emit.statements import (
    assignment,
    compile_statement,
    loop_bound,
    loop_variable,
)
from rapidgen.runtime.compiler.emit.writer import PythonFunction
from rapidgen.runtime.compiler.link import Linker
from rapidgen.runtime.compiler.symbols import CannotCompile, CodeRole, Compiled, Routine
from rapidgen.runtime.values import Type, Value

# -- Resumption ------------------------------------------------------------------------------------
#
# Resumption: code that takes over the variables of a frame that no longer exists.
#
# A program stopped by an error is at the failed statement and executes it again after a start [S4
# overview 3-23]. The routine is compiled again from there: the rest of every enclosing statement
# list, and loops from their next pass on.


Path = list[tuple[list[n.Statement], int]]
"""Statement lists from the routine's body inwards, and the index in each."""


@dataclass(frozen=True, slots=True)
class StoppedFrame:
    """A routine of a stopped call stack: its place and variables."""

    routine: Routine
    path: Path
    values: dict[str, Value]
    """Python locals of the frame."""


def find(body: list[n.Statement], token: int) -> Path | None:
    """Return the path to the statement that starts at a token."""
    for i, statement in enumerate(body):
        if isinstance(statement, n.Label):
            continue
        if statement.first == token:
            return [(body, i)]
        for inner in _lists(statement):
            result = find(inner, token)
            if result is not None:
                return [(body, i), *result]
    return None


def _lists(statement: n.Statement) -> Iterator[list[n.Statement]]:
    match statement:
        case n.If():
            yield from (branch.body for branch in statement.branches)
            yield statement.otherwise or []
        case n.CompactIf():
            yield [statement.statement]
        case n.For() | n.While():
            yield statement.body
        case n.Test():
            yield from (case.body for case in statement.cases)
            yield statement.default or []


def after(values: Iterable[float], current: float) -> Iterator[float]:
    """Iterate over values of a FOR variable after the current one."""
    remaining: Iterator[float] = iter(values)
    for value in remaining:
        if value == current:
            break
    return remaining


class _Rest:
    """Compiles the rest of a routine. CannotCompile: not possible there.

    `calls`: the statement is a call in progress, and its routine also continues. `alone`: execution
    ends after the statement.
    """

    def __init__(
        self, compiler: RoutineCompiler, standing: StoppedFrame, *, calls: bool, alone: bool
    ) -> None:
        if compiler.facts.goto:
            raise CannotCompile(
                "a routine with GOTO cannot go on in the middle", compiler.unit.node
            )
        self._emitter = compiler.emitter
        self._standing = standing
        self._calls = calls
        self._alone = alone
        declare = compiler.variables
        compiler.parameters = "F"
        compiler.variables = lambda: self._take_over(declare)
        compiler.body = lambda: self._rest(standing.path)

    def _take_over(self, declare: Callable[[], None]) -> None:
        """Take over the values of the variables."""
        emitter, values = self._emitter, self._standing.values
        marker = len(emitter.w.lines)
        declare()
        emitter.w.cut(marker)
        for name in sorted({d.code for d in emitter.unit.locals.values()} & values.keys()):
            emitter.w.emit(f"{name} = F[{name!r}]")

    def _rest(self, path: Path) -> None:
        emitter, w = self._emitter, self._emitter.w
        (body, i), *deeper = path
        if deeper:
            self._into(body[i], deeper)
        elif self._calls:
            w.token = body[i].first
            w.close()
            w.emit("R.go_on_below()")
            compile_statement(
                emitter, body[i]
            )  # the statement in progress has been reported already
            w.close()
            w.emit("R.not_below()")
        else:
            emitter.statement(body[i])
        if not self._alone:
            for statement in body[i + 1 :]:
                emitter.statement(statement)

    def _into(self, statement: n.Statement, deeper: Path) -> None:
        if isinstance(statement, n.For):
            self._into_for(statement, deeper)
            return
        self._rest(deeper)
        if isinstance(statement, n.While) and not self._alone:
            self._emitter.statement(statement)

    def _into_for(self, node: n.For, deeper: Path) -> None:
        emitter, name = self._emitter, loop_variable(node)
        if name not in self._standing.values:
            raise CannotCompile("a FOR whose variable is lost cannot go on", node)
        emitter.w.emit(f"{name} = F[{name!r}]")
        with loop_bound(emitter.unit, node, complete=False, limits=None):
            self._rest(deeper)
        if not self._alone:
            emitter.w.close()
            emitter.resumed.add(node.first)
            emitter.statement(node)


def compile_backward(
    linker: Linker, routine: Routine, options: Options, file: str
) -> tuple[Callable[..., Value], Compiled]:
    """Compile the BACKWARD handler of a procedure [K §6.1].

    It has the procedure's parameters, variables and `file`. The procedure's ERROR does not handle
    its errors [K §7.1].
    """
    node = routine.node
    assert node is not None
    assert node.backward is not None
    body = replace(node, body=node.backward.body, backward=None, error=None)
    changed = replace(routine, node=body)
    entry = f"{routine.code}_back"
    return RoutineCompiler(linker, changed, options, entry, f"{file} backward").link()


def compile_rest(
    linker: Linker, standing: StoppedFrame, options: Options, file: str, *, calls: bool, alone: bool
) -> tuple[Callable[[dict[str, Value]], Value], Compiled]:
    """Compile a function that continues a routine with given values.

    `file` is that of the routine.
    """
    routine = standing.routine
    at = "".join(f" {i}" for _, i in standing.path)
    file = f"{file} from{at}{' alone' if alone else ''}"
    compiler = RoutineCompiler(linker, routine, options, f"{routine.code}_rest", file)
    _Rest(compiler, standing, calls=calls, alone=alone)
    return compiler.link()


# -- Watch expressions -----------------------------------------------------------------------------
#
# Watch expressions: expressions and assignments evaluated at the current statement of a routine.
#
# They are compiled as a statement of the routine, but separately: the routine's handlers do not
# receive their errors, they cost no time, and they may neither wait nor call.


_ENTRY = "_watched"
_FILE = "<watched>"


@dataclass(frozen=True, slots=True)
class WatchedExpression:
    """An expression of a routine; `read` takes a frame's Python locals."""

    type: Type
    dims: tuple[int, ...]
    read: Callable[[dict[str, Value]], Value]


def parse_assignment(text: str) -> n.Assignment:
    """Parse `target := value`. SyntaxError explains a fault."""
    module = parse(f"MODULE w\nPROC w()\n{text};\nENDPROC\nENDMODULE")
    if module.diagnostics:
        raise SyntaxError(module.diagnostics[0].message)
    body = module.routines[0].body if len(module.routines) == 1 else []
    if len(body) != 1 or not isinstance(body[0], n.Assignment):
        raise SyntaxError(f"{text!r} is not one expression")
    return body[0]


def parse_expression(text: str) -> n.Expression:
    """Parse one expression. SyntaxError explains a fault."""
    return parse_assignment(f"w:={text}").value


class _Probe:
    """A builder of functions with access to a routine's variables."""

    def __init__(
        self,
        linker: Linker,
        routine: Routine,
        loops: Sequence[n.For],
        options: Options,
        known: Sequence[str],
    ) -> None:
        options = replace(options, accounting="none", tracing=False, switching=False)
        self.compiler = RoutineCompiler(linker, routine, options, _ENTRY, _FILE)
        self._loops = loops
        self._known = frozenset(known)
        self.unit: Unit = self.compiler.unit

    def link(self, write: Callable[[], None]) -> Callable[[dict[str, Value]], Value]:
        unit, emitter = self.unit, self.compiler.emitter
        emitter.function = PythonFunction(1, CodeRole.ROUTINE, False)
        w = emitter.w
        w.emit(f"def {_ENTRY}(F):")
        w.depth = 1
        w.emit("pass")
        marker = len(w.lines)
        self.compiler.variables()
        w.cut(marker)
        with ExitStack() as inside:
            for loop in self._loops:
                if loop_variable(loop) in self._known:
                    inside.enter_context(loop_bound(unit, loop, complete=False, limits=None))
            for name in sorted({d.code for d in unit.locals.values()} & self._known):
                w.emit(f"{name} = F[{name!r}]")
            write()
        w.close()
        if unit.globals_written:
            w.lines[marker - 1].text = f"global {', '.join(sorted(unit.globals_written))}"
        text, *_ = w.render()
        space = unit.linker.space
        exec(compile(text, _FILE, "exec", dont_inherit=True), space)
        function: Callable[[dict[str, Value]], Value] = space.pop(_ENTRY)
        return function


def _allowed(unit: Unit, e: CompiledExpression, node: n.Expression) -> None:
    name = undeclared(unit, node)
    if name:
        raise CannotCompile(f"{name} is not known here", node)
    if e.effect == CALLS:
        raise CannotCompile("it calls a routine, which would change the program's course", node)


def watch(
    linker: Linker,
    routine: Routine,
    loops: Sequence[n.For],
    options: Options,
    known: Sequence[str],
    node: n.Expression,
) -> WatchedExpression:
    """Compile an expression at a place inside `loops`.

    `known` are the Python locals of the frame. CannotCompile: it has no value there, or contains a
    call.
    """
    probe = _Probe(linker, routine, loops, options, known)
    result: list[CompiledExpression] = []

    def write() -> None:
        e = probe.unit.expression(node)
        _allowed(probe.unit, e, node)
        result.append(e)
        probe.compiler.emitter.w.emit(f"return {e.code}")

    read = probe.link(write)
    return WatchedExpression(result[0].type, result[0].dims, read)


def store(
    linker: Linker,
    routine: Routine,
    loops: Sequence[n.For],
    options: Options,
    known: Sequence[str],
    node: n.Assignment,
) -> tuple[str, Callable[[dict[str, Value]], Value]]:
    """Compile an assignment at a place inside a routine.

    Returns the changed Python local ("" for none) and a function that takes the locals of the frame
    and returns the local's new value. CannotCompile: not allowed there. The function may raise
    OverflowError and RECOVERABLE.
    """
    probe = _Probe(linker, routine, loops, options, known)
    changed: list[str] = []

    def write() -> None:
        unit, emitter = probe.unit, probe.compiler.emitter
        for part in (node.target, node.value):
            _allowed(unit, unit.expression(part), part)
        assignment(emitter, node)
        complete = unit.data(node.target.name) if isinstance(node.target, n.Name) else None
        if complete is not None and complete.storage == "local":
            changed.append(complete.code)
            emitter.w.emit(f"return {complete.code}")

    function = probe.link(write)
    return (changed[0] if changed else ""), function
