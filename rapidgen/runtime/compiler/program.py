"""The program of one task: linked modules and their compiled code.

Routines are compiled on their first call: the namespace contains a stub under the routine's name,
which compiles, replaces itself and calls the result. Loading or unloading a module invalidates only
routines linked to it. Tracing needs other code (a report before each statement), so it invalidates
all routines; frames in progress continue in their old code, which stays in `codes` for stack
look-ups.
"""

import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial
from types import FrameType
from typing import Protocol, TypeAlias

from rapidgen.diagnostics import Diagnostic, Severity, error
from rapidgen.machine.scheduler import WaitSet
from rapidgen.rapid.binding.arguments import match
from rapidgen.rapid.binding.names import Symbol
from rapidgen.rapid.numbers import dnum
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.lexer import KEYWORDS
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime import unsupported
from rapidgen.runtime.compiler import support
from rapidgen.runtime.compiler.emit.access import Options
from rapidgen.runtime.compiler.emit.routine import RoutineCompiler
from rapidgen.runtime.compiler.emitted import EmittedProgram, EmittedRoutine, Kept, emitted_program
from rapidgen.runtime.compiler.link import Linker, Shared
from rapidgen.runtime.compiler.resume import (
    StoppedFrame,
    after,
    compile_backward,
    compile_rest,
    find,
)
from rapidgen.runtime.compiler.symbols import (
    CannotCompile,
    CodeRole,
    Codes,
    Compiled,
    Data,
    LoadedModule,
    Routine,
)
from rapidgen.runtime.errors import RECOVERABLE, FatalError, RapidError
from rapidgen.runtime.values import PersistentCell, Ref, Value, make_array
from rapidgen.system.model import ModuleFile

# -- ArgName ---------------------------------------------------------------------------------------
#
# ArgName: the name of the datum that a parameter represents, along the call stack.
#
# Values have no names. The code reads the arguments of each call from the trees, at the current
# token of each routine.


Call: TypeAlias = n.ProcedureCall | n.FunctionCall | n.LateCall
FindData: TypeAlias = Callable[[LoadedModule | None, str], Data | None]


def arg_name(codes: Codes, find_data: FindData, parameter: str, number: Ref | None = None) -> str:
    """Return the name of the datum of a parameter.

    An element or component yields the name of the whole datum, an expression raises ERR_ARGNAME.
    With `number` that receives the error instead, and the name is empty. Source: [S4 datasys
    3-ArgName].
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
    """Iterate over routines of the call stack and their tokens.

    The innermost routine comes first.
    """
    inside: Routine | None = None
    while frame is not None:
        compiled = codes.get(frame.f_code.co_filename)
        if compiled is not None:
            inner = compiled.role(frame.f_code) is not CodeRole.ROUTINE
            if inside is not compiled.routine:
                yield compiled.routine, compiled.tokens[frame.f_lineno]
            # The frame of a handler or nested part precedes the frame of its routine.
            inside = compiled.routine if inner else None
        frame = frame.f_back


def _argument(caller: Routine, token: int, routine: Routine, at: int) -> n.Expression | None:
    """Return the argument for a parameter in a statement's call."""
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


# -- Program ---------------------------------------------------------------------------------------
#
# The program of one task: modules linked into one Python namespace, compiled on first call.


class Executor(Protocol):
    """Task interface of compiled code, `R` in its namespace."""

    name: str

    def trace(self, point: int) -> None:
        """Report the next statement."""


class Program:
    """Modules of one task and their compiled code."""

    def __init__(self, executor: Executor, shared: Shared, options: Options) -> None:
        self.name = executor.name
        self.shared = shared
        self.options = options
        self.codes: dict[str, Compiled] = {}
        self._linked: set[Routine] = set()
        """Routines compiled for the present modules."""
        self.emitted: EmittedProgram | None = None
        """Code of equal programs; None: nothing is kept for this one."""
        self._initial: dict[str, Value] = {}
        """Unchanged initial values, by storage."""
        self.changed = WaitSet()
        """Notified when modules are loaded or unloaded."""
        self.space: dict[str, Value] = {
            **support.NAMESPACE,
            "R": executor,
            "ERRS": RECOVERABLE,
            "ARRAY": make_array,
            "AFTER": after,
            "ARGNAME": partial(arg_name, self.codes, self.find_data),
        }
        dialect = options.dialect
        self.space["WHOLE"] = partial(dnum, bits=int(dialect.dnum_whole))
        if dialect.for_loop == "tested":
            self.space["STEPS"] = support.count_tested
        if dialect.integer_division == "floor":
            self.space["DIV"], self.space["MOD"] = support.div_floor, support.mod_floor
        if dialect.negative_mod == "error":
            self.space["MOD"] = support.mod_strict
        self.linker = Linker(shared, self.space)
        self.names = self.linker.names
        self.modules = self.linker.modules
        self.faults = self.linker.faults
        self.datum = self.linker.datum
        self.routine = self.linker.routine
        self.evaluate = self.linker.evaluate
        self.global_ref = self.linker.global_ref
        self.trace_points = self.linker.trace_points
        self.traced_points = self.linker.traced_points

    # -- loading ---------------------------------------------------------------------------------

    def load(self, modules: Iterable[tuple[n.Module, ModuleFile]]) -> None:
        """Link modules after registering the names of all of them."""
        loaded = [self.linker.add(tree, file) for tree, file in modules]
        self.linker.link(loaded)
        self._reset_code()
        self.changed.notify()

    def unload(self, name: str) -> None:
        """Remove a module; its callers are linked again."""
        self.linker.remove(name)
        self._reset_code()
        self.changed.notify()

    def _reset_code(self) -> None:
        self._linked.clear()
        self.emitted = emitted_program(self.name, self.linker, self.options)
        self._initial = {}
        for module in self.modules.values():
            for routine in module.routines.values():
                self.space[routine.code] = self._stub(routine)

    def reset_variables(self) -> None:
        """Give every module VAR its initial value: PP to main [S4 overview 4-24].

        Data of built-in modules keep their values, except TASK data of a shared module [K §13.2].
        """
        self.find_initial_values()
        self.space |= self._initial
        # Arrays and records are changed in place: next time these are others.
        self._initial = {}

    def find_initial_values(self) -> None:
        """Evaluate the values for `reset_variables` in advance.

        Copies of this program then share them. CannotCompile: an initial value has no value.
        """
        if not self._initial:
            self._initial = dict(self._initial_values())

    def _initial_values(self) -> Iterator[tuple[str, Value]]:
        for module in self.modules.values():
            for key, d in module.declarations.items():
                if d.kind != "VAR":
                    continue
                if module.installed and not (module.file.shared and d.scope == "TASK"):
                    continue
                data = self.find_data(module, key)
                if data is not None and data.type.name not in self.shared.unknown:
                    yield data.code, self.evaluate(module, module.scope, d)[2]

    # -- names -----------------------------------------------------------------------------------

    def find(self, module: LoadedModule | None, key: str) -> Symbol | None:
        """Return the symbol of a lower-case name in a module.

        None as the module means the view from outside.
        """
        return self.names.find(key) if module is None else module.scope.find(key)

    def find_data(self, module: LoadedModule | None, key: str) -> Data | None:
        """Return a datum by lower-case name in a module."""
        return self.datum(self.find(module, key))

    def find_routine(self, module: LoadedModule | None, key: str) -> Routine | None:
        """Return a routine by lower-case name; built-ins come last."""
        return self.routine(self.find(module, key))

    def code_name(self, routine: Routine) -> str:
        """Return the Python file name of a routine's code."""
        assert routine.module is not None
        # Frames in progress continue in code without tracing, which remains registered.
        traced = " traced" if self.options.tracing else ""
        return f"<rapid {self.name} {routine.module.name} {routine.name}{traced}>"

    def report_all(self) -> None:
        """Make all trace points active again."""
        self.traced_points[:] = [True] * len(self.traced_points)

    def trace_from_now(self) -> None:
        """Compile with tracing from now on."""
        self.report_all()
        if not self.options.tracing:
            self.options = replace(self.options, tracing=True, accounting="statement")
            self._reset_code()

    # -- code ------------------------------------------------------------------------------------

    def _stub(self, routine: Routine) -> Callable[..., Value]:
        def stub(*arguments: Value, **named: Value) -> Value:
            return self.function(routine)(*arguments, **named)

        return stub

    def function(self, routine: Routine) -> Callable[..., Value]:
        """Return the compiled function of a routine.

        FatalError: the routine violates the language.
        """
        assert routine.module is not None
        file = self.code_name(routine)
        if routine in self._linked and file in self.codes:
            linked: Callable[..., Value] = self.space[routine.code]
            return linked
        try:
            function = self._known(*self._linked_routine(routine, file))
        except CannotCompile as fault:
            span = routine.module.span(fault.node)
            self.faults.append(error("RG401", span, str(fault)))
            raise FatalError(
                194001, "Program cannot be linked", f"{routine.name}: {fault}", span=span
            ) from fault
        self._linked.add(routine)
        return function

    def _linked_routine(self, routine: Routine, file: str) -> tuple[Callable[..., Value], Compiled]:
        """Return a function and its code, emitted or known. CannotCompile."""
        # Undeclared types may come with another task, after this one was loaded.
        emitted = None if self.shared.unknown else self.emitted
        if emitted is None:
            return RoutineCompiler(self.linker, routine, self.options, routine.code, file).link()
        known = emitted.routines.get(file)
        if known is not None:
            compiled = known.taken_over(self.linker, routine, file)
            exec(known.code, self.space)
            return self.space[routine.code], compiled
        faults = len(self.faults)
        kept = Kept(f"{routine.code}_{len(self.linker.changes)}")
        compiler = RoutineCompiler(self.linker, routine, self.options, routine.code, file, kept)
        code, compiled = compiler.compile()
        self.space.update(kept.values)
        exec(code, self.space)
        if len(self.faults) == faults:
            emitted.routines[file] = EmittedRoutine.of(code, compiled, kept, self.linker)
        return self.space[routine.code], compiled

    def _known(self, function: Callable[..., Value], compiled: Compiled) -> Callable[..., Value]:
        self.codes[compiled.file] = compiled
        return function

    def rest(
        self, standing: StoppedFrame, *, calls: bool = False, alone: bool = False
    ) -> Callable[[dict[str, Value]], Value]:
        """Return a function that continues a routine at a statement.

        `calls`: the statement is a call in progress. `alone`: the function executes only this
        statement. CannotCompile: not possible there.
        """
        options = replace(self.options, tracing=False) if alone else self.options
        file = self.code_name(standing.routine)
        linked = compile_rest(self.linker, standing, options, file, calls=calls, alone=alone)
        return self._known(*linked)

    def backward(self, routine: Routine) -> Callable[..., Value]:
        """Return the BACKWARD handler of a procedure as a function.

        Raises CannotCompile.
        """
        file = self.code_name(routine)
        return self._known(*compile_backward(self.linker, routine, self.options, file))

    def value(self, module: LoadedModule | None, key: str) -> Value:
        """Return the current value of a datum in a module, or raise KeyError."""
        data = self.find_data(module, key)
        if data is None:
            raise KeyError(key)
        if data.storage == "inline":
            return data.value
        saved = self.space[data.code]
        return saved.v if isinstance(saved, PersistentCell) else saved


# -- Undefined calls -------------------------------------------------------------------------------
#
# Undefined calls are reported when modules are loaded.
#
# Large trees are not searched completely. The tokens yield names without a known routine in
# positions of a call; only for these the tree is searched.


_BEFORE_STATEMENT = frozenset({";", "THEN", "DO", "ELSE", "ERROR", "UNDO", ":", ")"})
_NO_CALL = frozenset({":=", ".", "{", ":", ",", ";"})


def missing_routines(program: Program) -> list[Diagnostic]:
    """Return one warning per unavailable or undeclared routine."""
    emitted = program.emitted
    if emitted is None:
        return _missing(program)
    if emitted.missing is None:
        emitted.missing = tuple(_missing(program))
    return list(emitted.missing)


def _missing(program: Program) -> list[Diagnostic]:
    findings: dict[str, Diagnostic] = {}
    for module in program.modules.values():
        suspects = _suspects(program, module) - findings.keys()
        if not suspects:
            continue
        for routine in module.tree.routines:
            for node in walk(routine):
                if isinstance(node, n.ProcedureCall | n.FunctionCall):
                    key = node.name.lower()
                    if key in suspects and key not in findings:
                        findings[key] = _diagnostic(program, module, node)
    return list(findings.values())


def _suspects(program: Program, module: LoadedModule) -> set[str]:
    tokens = module.tree.source.tokens
    unknown = set()
    for text in {t.lower() for t in set(tokens) if t[0].isalpha()}:
        if text.upper() in KEYWORDS:
            continue
        symbol = program.find(module, text)
        routine = program.routine(symbol)
        if symbol is None or (routine is not None and routine.missing):
            unknown.add(text)
    for record in module.tree.records:
        unknown.difference_update(c.name.lower() for c in record.components)
    for declared in module.tree.routines:
        unknown.difference_update(d.name.lower() for d in declared.data)
        unknown.difference_update(p.name.lower() for p in declared.parameters)
    if not unknown:
        return unknown
    spelled = {text: key for text in set(tokens) if (key := text.lower()) in unknown}
    suspects = set()
    last = len(tokens) - 1
    for i, text in enumerate(tokens):
        key = spelled.get(text, "")
        if not key or key in suspects:
            continue
        after = tokens[i + 1] if i < last else ""
        before = tokens[i - 1].upper() if i else ""
        starts = before in _BEFORE_STATEMENT or (before[:1].isalpha() and before not in KEYWORDS)
        if after == "(" or (starts and (after == ";" or after not in _NO_CALL)):
            suspects.add(key)
    return suspects


def _diagnostic(
    program: Program, module: LoadedModule, node: n.ProcedureCall | n.FunctionCall
) -> Diagnostic:
    routine = program.find_routine(module, node.name.lower())
    if routine is not None or node.name.lower() in unsupported.option_routines():
        return error(
            "RG403",
            module.span(node),
            f"{routine.name if routine else node.name} is not available on the virtual controller",
            label="the task stops here",
            notes=(unsupported.reason(node.name),),
            severity=Severity.WARNING,
        )
    return error(
        "RG404",
        module.span(node),
        f"{node.name} is not declared in any module of {program.name}",
        "load the module that declares it",
        label="ERR_REFUNKPRC when it is reached",
        severity=Severity.WARNING,
    )
