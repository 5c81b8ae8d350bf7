"""The program of one task: modules linked into one Python namespace, compiled on first call."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial
from typing import Protocol

from rapidgen.diagnostics import error
from rapidgen.rapid.binding.symbols import Symbol
from rapidgen.rapid.numbers import dnum
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler import runtime
from rapidgen.runtime.compiler.argname import arg_name
from rapidgen.runtime.compiler.code_info import Compiled
from rapidgen.runtime.compiler.context import Options
from rapidgen.runtime.compiler.linking import Linker, Shared
from rapidgen.runtime.compiler.resume import StoppedFrame, after, compile_backward, compile_rest
from rapidgen.runtime.compiler.routine import RoutineCompiler
from rapidgen.runtime.compiler.symbols import CannotCompile, Data, LoadedModule, Routine
from rapidgen.runtime.errors import RECOVERABLE, FatalError
from rapidgen.runtime.values import PersistentCell, Value, make_array
from rapidgen.system.model import ModuleFile


class Executor(Protocol):
    """What compiled code runs on: its name and, as `R`, whatever it is asked for."""

    name: str

    def trace(self, point: int) -> None:
        """A statement is about to be executed."""


class Program:
    """Modules of one task and their compiled code."""

    def __init__(self, executor: Executor, shared: Shared, options: Options) -> None:
        self.name = executor.name
        self.shared = shared
        self.options = options
        self.codes: dict[str, Compiled] = {}
        self._linked: set[Routine] = set()
        """What is compiled as the modules are now."""
        self._initial: dict[str, Value] = {}
        """Values that nothing has changed yet, by where they are kept."""
        self.space: dict[str, Value] = {
            **runtime.NAMESPACE,
            "R": executor,
            "ERRS": RECOVERABLE,
            "ARRAY": make_array,
            "AFTER": after,
            "ARGNAME": partial(arg_name, self.codes, self.find_data),
        }
        dialect = options.dialect
        self.space["WHOLE"] = partial(dnum, bits=int(dialect.dnum_whole))
        if dialect.for_loop == "tested":
            self.space["STEPS"] = runtime.count_tested
        if dialect.integer_division == "floor":
            self.space["DIV"], self.space["MOD"] = runtime.div_floor, runtime.mod_floor
        if dialect.negative_mod == "error":
            self.space["MOD"] = runtime.mod_strict
        self.linker = Linker(shared, self.space)
        self.names = self.linker.names
        self.modules = self.linker.modules
        self.faults = self.linker.faults
        self.datum = self.linker.datum
        self.routine = self.linker.routine
        self.evaluate = self.linker.evaluate
        self.global_ref = self.linker.global_ref
        self.trace_points = self.linker.trace_points
        self.told = self.linker.told

    # -- loading ---------------------------------------------------------------------------------

    def load(self, modules: Iterable[tuple[n.Module, ModuleFile]]) -> None:
        """Link modules; names of all are known before any value is evaluated."""
        loaded = [self.linker.add(tree, file) for tree, file in modules]
        self.linker.link(loaded)
        self._reset_code()

    def unload(self, name: str) -> None:
        """Remove a module; code that called it is linked anew."""
        self.linker.remove(name)
        self._reset_code()

    def _reset_code(self) -> None:
        self._linked.clear()
        self._initial = {}
        for module in self.modules.values():
            for routine in module.routines.values():
                self.space[routine.code] = self._stub(routine)

    def reset_variables(self) -> None:
        """Give every module VAR its initial value: PP to main [S4 overview 4-24].

        Data of built-in modules keep theirs, but for what a shared one has for each task [K §13.2].
        """
        self.find_initial_values()
        self.space |= self._initial
        # Arrays and records are changed in place: next time these are others.
        self._initial = {}

    def find_initial_values(self) -> None:
        """Work out now what `reset_variables` will give, so that copies of this need not.

        CannotCompile: some value is none."""
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
        """What a lower-case name means in a module; None: seen from outside."""
        return self.names.find(key) if module is None else module.scope.find(key)

    def find_data(self, module: LoadedModule | None, key: str) -> Data | None:
        """A datum by lower-case name, as seen from a module."""
        return self.datum(self.find(module, key))

    def find_routine(self, module: LoadedModule | None, key: str) -> Routine | None:
        """A routine by lower-case name, as seen from a module; built-ins come last."""
        return self.routine(self.find(module, key))

    def code_name(self, routine: Routine) -> str:
        """Python file name of a routine's code."""
        assert routine.module is not None
        # What is being executed when tracing begins goes on in its own code, which is known, too.
        traced = " traced" if self.options.tracing else ""
        return f"<rapid {self.name} {routine.module.name} {routine.name}{traced}>"

    def tell_all(self) -> None:
        """Code that reports its statements reports every one of them again."""
        self.told[:] = [True] * len(self.told)

    def trace_from_now(self) -> None:
        """Compile with a report of every statement from now on."""
        self.tell_all()
        if not self.options.tracing:
            self.options = replace(self.options, tracing=True, accounting="statement")
            self._reset_code()

    # -- code ------------------------------------------------------------------------------------

    def _stub(self, routine: Routine) -> Callable[..., Value]:
        def stub(*arguments: Value, **named: Value) -> Value:
            return self.function(routine)(*arguments, **named)

        return stub

    def function(self, routine: Routine) -> Callable[..., Value]:
        """The compiled function of a routine; FatalError when it breaks the language's rules."""
        assert routine.module is not None
        file = self.code_name(routine)
        if routine in self._linked and file in self.codes:
            linked: Callable[..., Value] = self.space[routine.code]
            return linked
        compiler = RoutineCompiler(self.linker, routine, self.options, routine.code, file)
        try:
            function = self._known(*compiler.link())
        except CannotCompile as fault:
            span = routine.module.span(fault.node)
            self.faults.append(error("RG401", span, str(fault)))
            raise FatalError(
                40001, "Program cannot be linked", f"{routine.name}: {fault}", span=span
            ) from fault
        self._linked.add(routine)
        return function

    def _known(self, function: Callable[..., Value], compiled: Compiled) -> Callable[..., Value]:
        self.codes[compiled.file] = compiled
        return function

    def rest(
        self, standing: StoppedFrame, *, calls: bool = False, alone: bool = False
    ) -> Callable[[dict[str, Value]], Value]:
        """A function that goes on with a routine where it stands. CannotCompile: it cannot.

        `calls`: the statement is a call that is under way. `alone`: only it is executed.
        """
        options = replace(self.options, tracing=False) if alone else self.options
        file = self.code_name(standing.routine)
        linked = compile_rest(self.linker, standing, options, file, calls=calls, alone=alone)
        return self._known(*linked)

    def backward(self, routine: Routine) -> Callable[..., Value]:
        """The BACKWARD handler of a procedure as a function. CannotCompile."""
        file = self.code_name(routine)
        return self._known(*compile_backward(self.linker, routine, self.options, file))

    def value(self, module: LoadedModule | None, key: str) -> Value:
        """Current value of a datum, as seen from a module. KeyError: there is none."""
        data = self.find_data(module, key)
        if data is None:
            raise KeyError(key)
        if data.storage == "inline":
            return data.value
        saved = self.space[data.code]
        return saved.v if isinstance(saved, PersistentCell) else saved
