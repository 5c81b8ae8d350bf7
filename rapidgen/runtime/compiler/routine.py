"""One routine: RAPID tree to Python function."""

from collections.abc import Callable
from functools import lru_cache
from types import CodeType

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.analysis import RoutineFacts
from rapidgen.runtime.compiler.code_info import HANDLER, LISTED, UNDO, CodeRole, Compiled
from rapidgen.runtime.compiler.context import Options, Unit
from rapidgen.runtime.compiler.emitter import Emitter
from rapidgen.runtime.compiler.expressions import compile_expression
from rapidgen.runtime.compiler.linking import Linker
from rapidgen.runtime.compiler.statements import compile_statement
from rapidgen.runtime.compiler.symbols import CannotCompile, Routine
from rapidgen.runtime.compiler.variables import declare, header
from rapidgen.runtime.compiler.writer import CodeLine
from rapidgen.runtime.values import NUM, Value


@lru_cache(maxsize=4096)
def _code(text: str, file: str) -> CodeType:
    """CPython's code; controllers that are booted anew with the same modules share it."""
    return compile(text, file, "exec", dont_inherit=True)


class RoutineCompiler:
    """Puts the Python of one routine together: header, handlers, statements.

    `parameters`, `variables` and `body` are its own; whoever goes on in its middle replaces them.
    """

    def __init__(
        self, linker: Linker, routine: Routine, options: Options, entry: str, file: str
    ) -> None:
        """`entry` names the Python function, `file` its code."""
        node = routine.node
        module = routine.module
        assert node is not None
        assert module is not None
        self.entry = entry
        self.file = file
        names = module.scope.routine(node)
        self.facts = RoutineFacts(node, lambda name: linker.routine(names.find(name)))
        boxed = self.facts.by_reference
        self.unit = Unit(linker, module, routine, node, options, compile_expression, names, boxed)
        self.emitter = Emitter(self.unit, compile_statement, self.facts.goto)
        self.parameters = header(self.unit)
        self.variables: Callable[[], None] = lambda: declare(self.unit, self.emitter.w, self.facts)
        self.body: Callable[[], None] = lambda: self.emitter.statements(node.body)

    def link(self) -> tuple[Callable[..., Value], Compiled]:
        """The function, defined in the namespace. CannotCompile."""
        code, compiled = self._compile()
        space = self.unit.linker.space
        exec(code, space)
        return space[self.entry], compiled

    def _compile(self) -> tuple[CodeType, Compiled]:
        unit, emitter, w = self.unit, self.emitter, self.emitter.w
        node = unit.node
        w.token = node.name_token
        w.emit(f"def {self.entry}({self.parameters}):")
        w.depth = 1
        w.emit("")
        written = w.lines[-1]
        w.emit("b = R.b")
        self.variables()
        top = w.cut(0)
        body = self._statements()
        handlers = self._handlers(node, top)
        w.lines = [*top, *handlers, *emitter.function.apart]
        if emitter.function.uses_jump:
            w.emit("_j = False")
        if node.undo is not None:
            w.emit("try:")
            self._append(body, 1)
            w.emit("except BaseException as _x:")
            w.depth += 1
            w.emit(f"R.undo({UNDO}, _x)")
            w.emit("raise")
            w.depth -= 1
        else:
            self._append(body, 0)
        w.token = node.last
        w.emit("R.b = b")
        if unit.routine.kind == "FUNC":
            w.emit("FAIL('ERR_FNCNORET')")
        if unit.globals_written:
            written.text = f"global {', '.join(sorted(unit.globals_written))}"
        text, tokens, refunds, synced = w.render()
        try:
            code = _code(text, self.file)
        except (SyntaxError, RecursionError) as error:
            # CPython nests 20 loops and 100 levels of indentation, not more.
            raise CannotCompile(
                f"statements are nested too deeply ({error.args[0]})", node
            ) from error
        compiled = Compiled(
            self.file,
            unit.routine,
            unit.module,
            text,
            tokens,
            refunds,
            synced,
            emitter.roles,
            unit.options.tracing,
        )
        return code, compiled

    def _statements(self) -> list[CodeLine]:
        w, error = self.emitter.w, self.unit.node.error
        w.leave = "return R.ret" if error is not None and error.numbers is not None else ""
        self.body()
        w.close()
        w.leave = ""
        return w.cut(0)

    def _append(self, lines: list[CodeLine], deeper: int) -> None:
        w = self.emitter.w
        for line in lines:
            line.depth += deeper
        w.lines += lines
        if not lines:
            w.depth += deeper
            w.emit("pass")
            w.depth -= deeper

    def _handlers(self, node: n.RoutineDeclaration, top: list[CodeLine]) -> list[CodeLine]:
        """Functions of ERROR and UNDO; one that is made once goes before `top`."""
        lines: list[CodeLine] = []
        if node.error is not None:
            handler = self.emitter.handler(HANDLER, node.error.body, CodeRole.HANDLER)
            if any("v_" in line.text for line in handler):
                lines += handler
            else:  # it uses none of the routine's variables: made once, not at each call
                apart = f"{self.entry}{HANDLER}"
                for line in handler:
                    line.depth -= 1
                top[0:0] = [*handler, CodeLine(0, f"{apart} = {HANDLER}", node.error.first)]
                lines.append(CodeLine(1, f"{HANDLER} = {apart}", node.error.first))
            lines += self._recovery_list(node.error)
        if node.undo is not None:
            lines += self.emitter.handler(UNDO, node.undo.body, CodeRole.UNDO)
        return lines

    def _recovery_list(self, handler: n.ErrorHandler) -> list[CodeLine]:
        """`_l()` gives the numbers of ERROR (list), for its own errors and for long jumps."""
        w = self.emitter.w
        w.token = handler.first
        if handler.numbers is None:
            w.emit(f"{LISTED} = None")
        else:
            codes = "".join(f"{self.unit.value_of(x, NUM).code}, " for x in handler.numbers)
            w.emit(f"def {LISTED}(): return ({codes})")
        return w.cut(0)
