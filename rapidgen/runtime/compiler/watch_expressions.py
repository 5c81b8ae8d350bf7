"""Expressions and assignments that somebody asks for where a routine stands.

They are compiled as a statement of the routine would be there, but apart from it: its handlers
are not for what fails here, it costs nothing, and it may neither wait nor call.
"""

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace

from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.parser import parse
from rapidgen.runtime.compiler.assignments import assignment
from rapidgen.runtime.compiler.code_info import CodeRole
from rapidgen.runtime.compiler.context import CALLS, CompiledExpression, Options, Unit
from rapidgen.runtime.compiler.emitter import PythonFunction
from rapidgen.runtime.compiler.linking import Linker
from rapidgen.runtime.compiler.loops import loop_bound, loop_variable
from rapidgen.runtime.compiler.references import undeclared
from rapidgen.runtime.compiler.routine import RoutineCompiler
from rapidgen.runtime.compiler.symbols import CannotCompile, Routine
from rapidgen.runtime.values import Type, Value

_ENTRY = "_watched"
_FILE = "<watched>"


@dataclass(frozen=True, slots=True)
class WatchedExpression:
    """An expression of a routine. `read` takes the Python locals of its frame."""

    type: Type
    dims: tuple[int, ...]
    read: Callable[[dict[str, Value]], Value]


def parse_assignment(text: str) -> n.Assignment:
    """The tree of `target := value`. SyntaxError says what is wrong with it."""
    module = parse(f"MODULE w\nPROC w()\n{text};\nENDPROC\nENDMODULE")
    if module.diagnostics:
        raise SyntaxError(module.diagnostics[0].message)
    body = module.routines[0].body if len(module.routines) == 1 else []
    if len(body) != 1 or not isinstance(body[0], n.Assignment):
        raise SyntaxError(f"{text!r} is not one expression")
    return body[0]


def parse_expression(text: str) -> n.Expression:
    """The tree of one expression. SyntaxError says what is wrong with it."""
    return parse_assignment(f"w:={text}").value


class _Probe:
    """Puts a function together that has the variables of a routine."""

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
    """An expression where a routine stands inside `loops`, with the Python locals `known`.

    CannotCompile: it has no value there, or it would have to call something.
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
    """An assignment where a routine stands, and the Python local that it changes ("": none).

    The function takes the locals of the frame and returns the new value of that local.
    CannotCompile: it is not allowed there. OverflowError and RECOVERABLE may come from it.
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
