"""One routine: RAPID tree to Python function."""

from collections.abc import Callable
from types import CodeType
from typing import TYPE_CHECKING, Any

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.analysis import Facts, Whole
from rapidgen.runtime.compiler.base import UNBOUNDED, Options
from rapidgen.runtime.compiler.compiled import Compiled, Role
from rapidgen.runtime.compiler.inline import NEVER_BOXES
from rapidgen.runtime.compiler.loops import Loops
from rapidgen.runtime.compiler.symbols import Data, Parameter, Routine
from rapidgen.runtime.compiler.writer import Line, Writer
from rapidgen.runtime.values import NUM, Type

if TYPE_CHECKING:
    from rapidgen.runtime.compiler.program import LoadedModule, Program

_ATOMIC = ("num", "dnum", "bool", "string")
_IMMUTABLE = ("num", "dnum", "bool", "string")


class RoutineCompiler(Loops):
    """Compiles one routine."""

    def __init__(
        self, program: "Program", module: "LoadedModule", routine: Routine, options: Options
    ) -> None:
        node = routine.node
        assert node is not None
        self.program = program
        self.module = module
        self.routine = routine
        self.node = node
        self.options = options
        self.locals: dict[str, Data] = {}
        self.globals_written: set[str] = set()
        self.temporaries = 0
        self.guarded = node.error is not None
        self.handler = ""
        self.nesting = []
        self.stored = set()
        self.label_states = {}
        self.jumps_out = 0
        self.uses_jump = False
        self.apart = [[]]
        self.depth_at = 1
        self.w = Writer(options.accounting)
        self.entry = routine.code
        self.file = program.code_name(routine)
        self.resumed = set()
        self.roles = {}
        self.facts = Facts(node, self.known_routine, NEVER_BOXES)
        self.goto = self.facts.goto
        self.boxed = self.facts.by_reference

    # -- the function ----------------------------------------------------------------------------

    def compile(self) -> tuple[CodeType, Compiled]:
        """Code of a module that defines the function."""
        node, w = self.node, self.w
        w.token = node.name_token
        self.head()
        globals_at = next(i for i, line in enumerate(w.lines) if line.text == "@GLOBALS")
        handlers_at = len(w.lines)
        body = self._part(node.body, "")
        deep, self.apart = self.apart[0], [[]]
        head: list[Any] = []
        if node.error is not None:
            handler = self._function("_h", node.error.body, "ERROR")
            if any("v_" in line.text for line in handler):
                head += handler
            else:  # it uses none of the routine's variables: made once, not at each call
                apart = f"{self.entry}_h"
                for line in handler:
                    line.depth -= 1
                w.lines[0:0] = handler
                before = len(handler)
                w.lines.insert(before, Line(0, f"{apart} = _h", node.error.first))
                globals_at += before + 1
                handlers_at += before + 1
                head.append(Line(1, f"_h = {apart}", node.error.first))
            head += self._recovery_list(node.error)
        if node.undo is not None:
            head += self._function("_u", node.undo.body, "UNDO")
        w.lines[handlers_at:] = [*head, *deep]
        if self.uses_jump:
            w.emit("_j = False")
        if node.undo is not None:
            w.emit("try:")
            w.depth += 1
            self._append(body, 1)
            w.depth -= 1
            w.emit("except BaseException as _x:")
            w.depth += 1
            w.emit("R.undo(_u, _x)")
            w.emit("raise")
            w.depth -= 1
        else:
            self._append(body, 0)
        w.token = node.last
        if self.routine.kind == "FUNC":
            w.emit("R.b = b")
            w.emit("FAIL('ERR_FNCNORET')")
        else:
            w.emit("R.b = b")
        names = ", ".join(sorted(self.globals_written))
        w.lines[globals_at].text = f"global {names}" if names else ""
        text, tokens, refunds, synced = w.render()
        try:
            code = compile(text, self.file, "exec", dont_inherit=True)
        except (SyntaxError, RecursionError) as error:
            # CPython nests 20 loops and 100 levels of indentation, not more.
            self.fault(f"statements are nested too deeply ({error.args[0]})", node)
        return code, Compiled(self.routine, self.module, text, tokens, refunds, synced, self.roles)

    def head(self) -> None:
        """The function's header, its parameters and variables."""
        w = self.w
        parameters = ", ".join(
            f"v_{p.name.lower()}" + ("=None" if p.optional or self._after_absent(i) else "")
            for i, p in enumerate(self.routine.parameters)
        )
        w.emit(f"def {self.entry}({parameters}):")
        w.depth = 1
        w.emit("@GLOBALS")
        w.emit("b = R.b")
        self.variables()

    def variables(self) -> None:
        """Declare parameters and data."""
        for parameter in self.routine.parameters:
            self._parameter(parameter)
        self._declare(self.node.data)

    def _after_absent(self, index: int) -> bool:
        return any(p.optional for p in self.routine.parameters[:index])

    def _part(self, body: list[n.Statement], handler: str) -> list[Any]:
        """Lines of a statement list, taken off the writer again."""
        w = self.w
        mark = len(w.lines)
        self.handler = handler
        guarded, self.guarded = self.guarded, self.guarded and not handler
        listed = self.node.error is not None and self.node.error.numbers is not None
        leave, w.leave = w.leave, "return R.ret" if self.guarded and listed else ""
        self.nesting, states = [], self.label_states
        self.label_states = {}
        self.statements(body)
        w.close()
        self.label_states = states
        self.guarded = guarded
        w.leave = leave
        self.handler = ""
        lines = w.lines[mark:]
        del w.lines[mark:]
        return lines

    def _append(self, lines: list[Any], deeper: int) -> None:
        for line in lines:
            line.depth += deeper
        self.w.lines += lines
        if not lines:
            self.w.emit("pass")

    def _function(self, name: str, body: list[n.Statement], handler: str) -> list[Any]:
        """A handler as a nested function that shares the routine's variables."""
        w = self.w
        mark = len(w.lines)
        stored, self.stored = self.stored, set()
        jump, self.uses_jump = self.uses_jump, False
        w.token = body[0].first if body else self.node.name_token
        w.depth += 1
        outer, self.apart = self.apart, [*self.apart, []]
        base, self.depth_at = self.depth_at, w.depth
        lines = self._part(body, handler)
        self.depth_at = base
        apart, self.apart = self.apart[-1], outer
        w.depth -= 1
        own = {d.code for d in self.locals.values()}
        nonlocals = ", ".join(sorted(self.stored & own))
        w.emit(f"def {name}():")
        self.roles[name] = Role(handler)
        w.depth += 1
        if nonlocals:
            w.emit(f"nonlocal {nonlocals}")
        written = sorted(self.globals_written & self.stored)
        if written:
            w.emit(f"global {', '.join(written)}")
        w.emit("b = R.b")
        if self.uses_jump:
            w.emit("_j = False")
        self._append([*apart, *lines], 0)
        w.token = self.node.last
        w.emit("R.b = b")
        w.emit("return 4")
        w.depth -= 1
        self.stored, self.uses_jump = stored | self.stored, jump
        done = w.lines[mark:]
        del w.lines[mark:]
        return done

    def _recovery_list(self, handler: n.ErrorHandler) -> list[Any]:
        """`_l()` gives the numbers of ERROR (list), for its own errors and for long jumps."""
        w = self.w
        mark = len(w.lines)
        w.token = handler.first
        if handler.numbers is None:
            w.emit("_l = None")
        else:
            codes = "".join(f"{self.value_of(x, NUM).code}, " for x in handler.numbers)
            w.emit(f"def _l(): return ({codes})")
        done = w.lines[mark:]
        del w.lines[mark:]
        return done

    # -- variables -------------------------------------------------------------------------------

    def _parameter(self, parameter: Parameter) -> None:
        key = parameter.name.lower()
        code = f"v_{key}"
        kind = parameter.type or self.program.switch_type
        dims = (0,) * parameter.dims
        atomic = kind.kind in _ATOMIC and not dims
        storage: Any = "local"
        if parameter.mode in ("PERS", "INOUT") or (parameter.mode == "VAR" and atomic):
            storage = "ref"
        elif parameter.mode == "VAR":
            storage = "object"
        elif key in self.boxed and atomic and not parameter.switch:
            storage = "box"
            t = self.program.type_code(kind)
            box = f"{code} = BOX({code}, {t}, (), {parameter.name!r})"
            self.w.emit(f"if {code} is not None: {box}" if parameter.optional else box)
        self.locals[key] = Data(
            parameter.name,
            "PARAMETER",
            kind,
            dims,
            storage,
            code,
            mode=parameter.mode,
            optional=parameter.optional,
        )

    def _declare(self, declarations: list[n.DataDeclaration]) -> None:
        candidates: dict[str, int] = {}
        values: list[tuple[n.DataDeclaration, Type, tuple[int, ...], Any]] = []
        constants: dict[str, Any] = {}
        for declaration in declarations:
            self.w.token = declaration.first
            kind, dims, value = self.program.evaluate_local(self.module, self.locals, declaration)
            key = declaration.name.lower()
            if declaration.kind == "CONST" and not dims and kind.kind in _ATOMIC:
                constants[key] = value
                self.locals[key] = Data(
                    declaration.name, "CONST", kind, (), "inline", "", value=value, readonly=True
                )
                continue
            values.append((declaration, kind, dims, value))
            if kind.kind == "num" and not dims and isinstance(value, int):
                candidates[key] = value
            self.locals[key] = Data(declaration.name, "VAR", kind, dims, "local", f"v_{key}")
        whole = Whole(candidates, self.facts, self._constant)
        for declaration, kind, dims, value in values:
            self._variable(declaration, kind, dims, value, whole)

    def _constant(self, name: str) -> object:
        data = self.data(name)
        return data.value if data is not None and data.storage == "inline" else None

    def _variable(
        self,
        declaration: n.DataDeclaration,
        kind: Type,
        dims: tuple[int, ...],
        value: Any,  # noqa: ANN401 - a RAPID value
        whole: Whole,
    ) -> None:
        key = declaration.name.lower()
        data = self.locals[key]
        w = self.w
        w.token = declaration.first
        if declaration.kind == "CONST":
            data.kind, data.readonly, data.storage = "CONST", True, "global"
            data.code = self.program.keep(value)
            return
        if dims or kind.kind not in _IMMUTABLE:
            if declaration.initial is None and not dims and kind.make is not None:
                fresh = f"{self.program.record_code(kind)}()"
            elif declaration.initial is None and len(dims) == 1 and kind.kind in _IMMUTABLE:
                fresh = f"dict.fromkeys(range(1, {dims[0] + 1}), {kind.default()!r})"
            elif kind.is_value:
                fresh = f"COPY({self.program.keep(value)})"
            else:
                fresh = f"ARRAY({dims!r}, {self.program.record_code(kind)})"
            w.emit(f"{data.code} = {fresh}")
            return
        if key in self.boxed:
            data.storage = "box"
            t = self.program.type_code(kind)
            w.emit(f"{data.code} = BOX({value!r}, {t}, (), {declaration.name!r})")
            return
        data.whole = key in whole.whole and kind.kind == "num"
        if data.whole and key in whole.natural:
            data.range = (0, UNBOUNDED)
        w.emit(f"{data.code} = {value!r}")


def compile_routine(
    program: "Program", module: "LoadedModule", routine: Routine, options: Options
) -> tuple[Callable[..., Any], Compiled]:
    """Compile a routine in the program's namespace."""
    code, compiled = RoutineCompiler(program, module, routine, options).compile()
    space = program.space
    exec(code, space)
    return space[routine.code], compiled
