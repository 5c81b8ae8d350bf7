"""Going on in the middle of a routine: code that takes over the variables of a frame that is gone.

A program that an error stopped stands at the faulty statement and tries it again when it is
started [S4 overview 3-23]. The routine is compiled once more, beginning there: the rest of every
statement list around, and loops from their next pass on.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.base import Options
from rapidgen.runtime.compiler.compiled import Compiled
from rapidgen.runtime.compiler.loops import loop_variable
from rapidgen.runtime.compiler.routine import RoutineCompiler
from rapidgen.runtime.compiler.symbols import Routine

if TYPE_CHECKING:
    from rapidgen.runtime.compiler.program import LoadedModule, Program

Path = list[tuple[list[n.Statement], int]]
"""Statement lists from the routine's own inwards, and the place in each."""


@dataclass(frozen=True, slots=True)
class Standing:
    """Where a routine of a call stack is, and what its variables are."""

    routine: Routine
    path: Path
    values: dict[str, Any]
    """Python locals of the frame."""


def find(body: list[n.Statement], token: int) -> Path | None:
    """The statement that begins at a token."""
    for i, statement in enumerate(body):
        if isinstance(statement, n.Label):
            continue
        if statement.first == token:
            return [(body, i)]
        for inner in _lists(statement):
            found = find(inner, token)
            if found is not None:
                return [(body, i), *found]
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


def after(values: Any, current: float) -> Iterator[float]:  # noqa: ANN401 - any iterable of numbers
    """Values of a FOR variable behind the current one."""
    rest: Iterator[float] = iter(values)
    for value in rest:
        if value == current:
            break
    return rest


class ResumingCompiler(RoutineCompiler):
    """Compiles the rest of a routine. CannotCompile: not from there."""

    def __init__(
        self,
        program: "Program",
        module: "LoadedModule",
        standing: Standing,
        options: Options,
        *,
        calls: bool,
        alone: bool,
    ) -> None:
        """`calls`: the statement is a call that is under way, and its routine goes on, too.

        `alone`: nothing follows it.
        """
        super().__init__(program, module, standing.routine, options)
        self.entry = f"{self.routine.code}_rest"
        self._standing = standing
        self._calls = calls
        self._alone = alone
        if self.goto:
            self.fault("a routine with GOTO cannot go on in the middle", self.node)

    def head(self) -> None:
        """Take the variables over."""
        w = self.w
        w.emit(f"def {self.entry}(F):")
        w.depth = 1
        w.emit("@GLOBALS")
        w.emit("b = R.b")
        mark = len(w.lines)
        self.variables()
        del w.lines[mark:]
        for name in sorted({d.code for d in self.locals.values()} & self._standing.values.keys()):
            w.emit(f"{name} = F[{name!r}]")

    def statements(self, body: Sequence[n.Statement]) -> None:
        """The routine's own list begins where it stands."""
        if body is self.node.body:
            self._rest(self._standing.path)
        else:
            super().statements(body)

    def _rest(self, path: Path) -> None:
        (body, i), *deeper = path
        if deeper:
            self._into(body[i], deeper)
        else:
            if self._calls:
                self.w.token = body[i].first
                self.w.close()
                self.w.emit("R.go_on_below()")
                self.one(body[i])  # which is under way: no trace tells of it again
                self.w.close()
                self.w.emit("R.not_below()")
            else:
                self.statement(body[i])
        if self._alone:
            return
        for statement in body[i + 1 :]:
            self.statement(statement)

    def _into(self, statement: n.Statement, deeper: Path) -> None:
        match statement:
            case n.While():
                self._rest(deeper)
                if not self._alone:
                    self.statement(statement)
            case n.For():
                self._into_for(statement, deeper)
            case _:
                self._rest(deeper)

    def _into_for(self, node: n.For, deeper: Path) -> None:
        name = loop_variable(node)
        if name not in self._standing.values:
            self.fault("a FOR whose variable is lost cannot go on", node)
        self.w.emit(f"{name} = F[{name!r}]")
        hidden = self.bind_loop(node, name, whole=False, limits=None)
        self._rest(deeper)
        self.unbind_loop(node, hidden)
        if self._alone:
            return
        self.w.close()
        self.resumed.add(node.first)
        self.statement(node)


def compile_backward(
    program: "Program", routine: Routine, options: Options
) -> tuple[Callable[..., Any], Compiled, str]:
    """The BACKWARD handler of a procedure, with its parameters and variables [K §6.1].

    Errors in it are not for the procedure's own ERROR [K §7.1].
    """
    node, module = routine.node, routine.module
    assert node is not None
    assert node.backward is not None
    assert module is not None
    body = replace(node, body=node.backward.body, backward=None, error=None)
    compiler = RoutineCompiler(program, module, replace(routine, node=body), options)
    compiler.entry = f"{routine.code}_back"
    compiler.file = f"{program.code_name(routine)} backward"
    code, compiled = compiler.compile()
    exec(code, program.space)
    return program.space[compiler.entry], compiled, compiler.file


def compile_rest(
    program: "Program", standing: Standing, options: Options, *, calls: bool, alone: bool
) -> tuple[Callable[[dict[str, Any]], Any], Compiled, str]:
    """A function that goes on with a routine, given the values; and its Python file name."""
    module = standing.routine.module
    assert module is not None
    compiler = ResumingCompiler(program, module, standing, options, calls=calls, alone=alone)
    at = "".join(f" {i}" for _, i in standing.path)
    only = " alone" if alone else ""
    compiler.file = f"{program.code_name(standing.routine)} from{at}{only}"
    code, compiled = compiler.compile()
    space = program.space
    exec(code, space)
    return space[compiler.entry], compiled, compiler.file
