"""A RAPID routine as a Python function.

An analysis before emission collects two facts. Locals passed by reference need a box; all others
are plain Python locals. Locals whose every store is a whole number stay Python ints without
rounding. The second fact is a greatest fixed point: the analysis assumes it for all candidates and
removes contradicted ones until no store contradicts.

The order of emission matters: the body comes first, because it decides which nonlocal names,
handlers and nested functions the header needs.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from types import CodeType

from rapidgen.rapid.binding.arguments import match
from rapidgen.rapid.builtins.signatures import marked
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.compiler.emit.access import UNBOUNDED, Options, Unit
from rapidgen.runtime.compiler.emit.expressions import compile_expression
from rapidgen.runtime.compiler.emit.statements import compile_statement
from rapidgen.runtime.compiler.emit.writer import CodeLine, Emitter, Writer
from rapidgen.runtime.compiler.link import Linker
from rapidgen.runtime.compiler.symbols import (
    HANDLER,
    LISTED,
    UNDO,
    CannotCompile,
    CodeRole,
    Compiled,
    Data,
    FormalParameter,
    Routine,
    Storage,
)
from rapidgen.runtime.values import ATOMIC, NUM, Type, Value

# -- Analysis --------------------------------------------------------------------------------------
#
# One walk over a routine before it is compiled: what is passed by reference, what is whole.


class RoutineFacts:
    """Facts about the local variables of a routine."""

    def __init__(
        self, routine: n.RoutineDeclaration, find: Callable[[str], Routine | None]
    ) -> None:
        self.by_reference: set[str] = set()
        """Locals that are arguments of reference parameters, lower case."""
        self.stores: dict[str, list[n.Expression | None]] = {}
        """Values stored in whole locals; None: an unknown value."""
        self.loops: list[n.For] = []
        self.goto: set[str] = set()
        for at in walk(routine):
            self._look(at, find)

    def _look(self, at: n.Node, find: Callable[[str], Routine | None]) -> None:
        match at:
            case n.Assignment(target=n.Name(name=name)):
                self.stores.setdefault(name.lower(), []).append(at.value)
            case n.ProcedureCall() | n.FunctionCall():
                self._call(at, find(at.name))
            case n.LateCall():
                for argument in at.arguments:
                    self._by_reference(argument.value)
            case n.Connect(target=n.Name(name=name)):
                self.by_reference.add(name.lower())
            case n.For():
                self.loops.append(at)
            case n.Goto():
                self.goto.add(at.name.lower())

    def _call(self, at: n.ProcedureCall | n.FunctionCall, routine: Routine | None) -> None:
        key = at.name.lower()
        unboxed = key in marked("inplace") or key in marked("steps")
        if routine is None or (routine.node is None and unboxed):
            self._step(at, key)
            return
        if not routine.refers:
            return
        parameters = routine.parameters

        def by_reference(_argument: n.Argument, among: Sequence[int]) -> int:
            """Return an alternative passed by reference, if any."""
            return next((i for i in among if parameters[i].mode), among[0])

        for pair in match(parameters, at.arguments, by_reference).pairs:
            if pair.parameter >= 0 and parameters[pair.parameter].mode:
                self._by_reference(pair.argument.value)

    def _step(self, at: n.ProcedureCall | n.FunctionCall, key: str) -> None:
        """Treat Incr and related instructions as assignments."""
        if key not in marked("steps") or not at.arguments:
            return
        target = at.arguments[0].value
        if isinstance(target, n.Name):
            value = at.arguments[1].value if key == "add" and len(at.arguments) > 1 else None
            complete = n.NumberLiteral(at.first, at.first, 1, "1")
            self.stores.setdefault(target.name.lower(), []).append(
                value if key == "add" else complete
            )

    def _by_reference(self, node: n.Expression | None) -> None:
        if isinstance(node, n.Name):
            self.by_reference.add(node.name.lower())


class IntegerLocals:
    """Locals and loop variables with whole numbers, or none below zero.

    Both sets are the largest ones consistent with every store. `initial` contains the candidates
    and their initial values, `constant(name)` returns the value of a num constant or None.
    """

    def __init__(
        self, initial: dict[str, int], facts: RoutineFacts, constant: Callable[[str], object]
    ) -> None:
        self._constant = constant
        loops: dict[str, list[n.For]] = {}
        for loop in facts.loops:
            loops.setdefault(loop.variable.lower(), []).append(loop)
        names = {name for name in initial if name not in facts.by_reference} | set(loops)
        stores = {name: facts.stores.get(name, []) for name in names}
        self.whole = names
        self._shrink(
            self.whole,
            lambda name: (
                all(map(self._is_whole, stores[name]))
                and all(self._is_whole_loop(loop) for loop in loops.get(name, ()))
            ),
        )
        self.natural = {name for name in self.whole if initial.get(name, 0) >= 0}
        self._shrink(
            self.natural,
            lambda name: (
                all(map(self._is_natural, stores[name]))
                and all(self._is_natural_loop(loop) for loop in loops.get(name, ()))
            ),
        )

    @staticmethod
    def _shrink(names: set[str], holds: Callable[[str], bool]) -> None:
        changed = True
        while changed:
            wrong = [name for name in sorted(names) if not holds(name)]
            names.difference_update(wrong)
            changed = bool(wrong)

    def _is_whole_loop(self, loop: n.For) -> bool:
        return self._is_whole(loop.start) and (loop.step is None or self._is_whole(loop.step))

    def _is_natural_loop(self, loop: n.For) -> bool:
        return loop.step is None and self._is_natural(loop.start) and self._is_natural(loop.end)

    def _is_whole(self, node: n.Expression | None) -> bool:
        match node:
            case n.NumberLiteral():
                return isinstance(node.value, int)
            case n.Name():
                return node.name.lower() in self.whole or isinstance(
                    self._constant(node.name.lower()), int
                )
            case n.Parenthesis():
                return self._is_whole(node.inner)
            case n.Unary():
                return node.operator != "NOT" and self._is_whole(node.operand)
            case n.Binary(operator="DIV" | "MOD"):
                return True
            case n.Binary(operator="+" | "-" | "*"):
                return self._is_whole(node.left) and self._is_whole(node.right)
            case n.FunctionCall():
                return node.name.lower() in marked("whole")
        return False

    def _is_natural(self, node: n.Expression | None) -> bool:
        match node:
            case n.NumberLiteral():
                return isinstance(node.value, int)
            case n.Name():
                value = self._constant(node.name.lower())
                return node.name.lower() in self.natural or (isinstance(value, int) and value >= 0)
            case n.Parenthesis():
                return self._is_natural(node.inner)
            case n.Binary(operator="+" | "*" | "DIV" | "MOD"):
                return self._is_natural(node.left) and self._is_natural(node.right)
            case n.FunctionCall():
                return node.name.lower() in marked("whole")
        return False


# -- Variables -------------------------------------------------------------------------------------
#
# Storage of parameters and data of a routine, and the Python code that creates them.


SWITCH = Type("switch", "bool")


def header(unit: Unit) -> str:
    """Return the parameters of the Python function."""
    absent = False
    names = []
    for parameter in unit.routine.parameters:
        absent = absent or parameter.optional
        names.append(f"v_{parameter.name.lower()}" + ("=None" if absent else ""))
    return ", ".join(names)


def declare(unit: Unit, w: Writer, facts: RoutineFacts) -> None:
    """Enter parameters and data into the unit, and emit their creation."""
    for parameter in unit.routine.parameters:
        _parameter(unit, w, parameter)
    candidates: dict[str, int] = {}
    values: list[tuple[n.DataDeclaration, Data, Value]] = []
    for d in unit.node.data:
        w.token = d.first
        kind, dims, value = unit.linker.evaluate(unit.module, unit.names, d)
        key = d.name.lower()
        symbol = unit.names.names[key]
        if d.kind == "CONST" and not dims and kind.kind in ATOMIC:
            unit.locals[symbol] = Data(
                d.name, "CONST", kind, (), "inline", "", value=value, readonly=True
            )
            continue
        data = unit.locals[symbol] = Data(d.name, "VAR", kind, dims, "local", f"v_{key}")
        values.append((d, data, value))
        if kind.kind == "num" and not dims and isinstance(value, int):
            candidates[key] = value
    complete = IntegerLocals(candidates, facts, lambda name: _constant(unit, name))
    for d, data, value in values:
        w.token = d.first
        _variable(unit, w, d, data, value, complete)


def _parameter(unit: Unit, w: Writer, parameter: FormalParameter) -> None:
    key = parameter.name.lower()
    code = f"v_{key}"
    kind = parameter.type or SWITCH
    dims = (0,) * parameter.dims
    atomic = kind.kind in ATOMIC and not dims
    storage: Storage = "local"
    if parameter.mode in ("PERS", "INOUT") or (parameter.mode == "VAR" and atomic):
        storage = "ref"
    elif parameter.mode == "VAR":
        storage = "object"
    elif key in unit.boxed and atomic and not parameter.switch:
        storage = "box"
        t = unit.keep(kind)
        box = f"{code} = BOX({code}, {t}, (), {parameter.name!r})"
        w.emit(f"if {code} is not None: {box}" if parameter.optional else box)
    unit.locals[unit.names.names[key]] = Data(
        parameter.name,
        "PARAMETER",
        kind,
        dims,
        storage,
        code,
        mode=parameter.mode,
        optional=parameter.optional,
    )


def _constant(unit: Unit, name: str) -> Value:
    data = unit.data(name)
    return data.value if data is not None and data.storage == "inline" else None


def _variable(
    unit: Unit, w: Writer, d: n.DataDeclaration, data: Data, value: Value, complete: IntegerLocals
) -> None:
    key, kind, dims = d.name.lower(), data.type, data.dims
    if d.kind == "CONST":
        data.kind, data.readonly, data.storage = "CONST", True, "global"
        data.code = unit.keep(value)
    elif dims or kind.kind not in ATOMIC:
        w.emit(f"{data.code} = {_fresh(unit, d, kind, dims, value)}")
    elif key in unit.boxed:
        data.storage = "box"
        w.emit(f"{data.code} = BOX({value!r}, {unit.keep(kind)}, (), {d.name!r})")
    else:
        # With tracing, a debugger may store any value.
        data.whole = key in complete.whole and kind.kind == "num" and not unit.options.tracing
        if data.whole and key in complete.natural:
            data.range = (0, UNBOUNDED)
        w.emit(f"{data.code} = {value!r}")


def _fresh(
    unit: Unit, d: n.DataDeclaration, kind: Type, dims: tuple[int, ...], value: Value
) -> str:
    """Return code that creates a record, array or object per call."""
    if d.initial is None and not dims and kind.make is not None:
        return f"{unit.keep(kind.make)}()"
    if d.initial is None and len(dims) == 1 and kind.kind in ATOMIC:
        return f"dict.fromkeys(range(1, {dims[0] + 1}), {kind.default()!r})"
    if kind.is_value:
        return f"COPY({unit.keep(value)})"
    return f"ARRAY({dims!r}, {unit.keep(kind.make)})"


# -- Routine ---------------------------------------------------------------------------------------
#
# One routine: RAPID tree to Python function.


@lru_cache(maxsize=4096)
def _code(text: str, file: str) -> CodeType:
    """Compile Python source.

    Controllers booted with the same modules share the code object.
    """
    return compile(text, file, "exec", dont_inherit=True)


class RoutineCompiler:
    """Assembles the Python of one routine: header, handlers, statements.

    Subclasses for resumption replace `parameters`, `variables` and `body`.
    """

    def __init__(
        self,
        linker: Linker,
        routine: Routine,
        options: Options,
        entry: str,
        file: str,
        keep: Callable[[Value], str] | None = None,
    ) -> None:
        """Set the name of the Python function (`entry`) and of its `file`.

        `keep` names objects in the code, by default the linker.
        """
        node = routine.node
        module = routine.module
        assert node is not None
        assert module is not None
        self.entry = entry
        self.file = file
        names = module.scope.routine(node)
        self.facts = RoutineFacts(node, lambda name: linker.routine(names.find(name)))
        boxed = self.facts.by_reference
        self.unit = Unit(
            linker,
            module,
            routine,
            node,
            options,
            compile_expression,
            names,
            boxed,
            keep or linker.keep,
        )
        self.emitter = Emitter(self.unit, compile_statement, self.facts.goto)
        self.parameters = header(self.unit)
        self.variables: Callable[[], None] = lambda: declare(self.unit, self.emitter.w, self.facts)
        self.body: Callable[[], None] = lambda: self.emitter.statements(node.body)

    def link(self) -> tuple[Callable[..., Value], Compiled]:
        """Return the function, defined in the namespace. CannotCompile."""
        code, compiled = self.compile()
        space = self.unit.linker.space
        exec(code, space)
        return space[self.entry], compiled

    def compile(self) -> tuple[CodeType, Compiled]:
        """Return the code that defines the function. CannotCompile."""
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
        """Emit functions of ERROR and UNDO.

        Code that runs once goes before `top`.
        """
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
        """Emit `_l()`, which returns the numbers of ERROR (list).

        The list applies to the routine's own errors and to long jumps.
        """
        w = self.emitter.w
        w.token = handler.first
        if handler.numbers is None:
            w.emit(f"{LISTED} = None")
        else:
            codes = "".join(f"{self.unit.value_of(x, NUM).code}, " for x in handler.numbers)
            w.emit(f"def {LISTED}(): return ({codes})")
        return w.cut(0)
