"""The program of one task: modules linked into one Python namespace, compiled on first call."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from rapidgen.diagnostics import Diagnostic, Severity, Span
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler import predefined, runtime
from rapidgen.runtime.compiler.argname import arg_name
from rapidgen.runtime.compiler.base import CannotCompile, Options
from rapidgen.runtime.compiler.compiled import Compiled
from rapidgen.runtime.compiler.evaluate import evaluate
from rapidgen.runtime.compiler.resume import Standing, after, compile_backward, compile_rest
from rapidgen.runtime.compiler.routine import compile_routine
from rapidgen.runtime.compiler.symbols import Data, Parameter, Pending, Routine, Symbol
from rapidgen.runtime.errors import RECOVERABLE, FatalError
from rapidgen.runtime.values import (
    NUM,
    PersistentCell,
    SharedVariable,
    Type,
    make_array,
    make_record,
)
from rapidgen.system.model import ModuleFile

if TYPE_CHECKING:
    from rapidgen.runtime.task.task import Task

TypeDeclaration = n.RecordDeclaration | n.AliasDeclaration
_ATOMIC = ("num", "dnum", "bool", "string")


def _trace(task: "Task", point: int) -> None:
    """A statement is about to be executed."""
    task.controller.statements.reached(task, point)


@dataclass(slots=True, eq=False)
class LoadedModule:
    """A module in a task."""

    name: str
    index: int
    tree: n.Module
    file: ModuleFile
    symbols: dict[str, Symbol] = field(default_factory=dict)
    """Everything it declares, by lower-case name."""
    declarations: dict[str, n.DataDeclaration] = field(default_factory=dict)
    """Of its data."""
    types: dict[str, TypeDeclaration] = field(default_factory=dict)
    """Declarations of its types."""

    @property
    def installed(self) -> bool:
        """Whether it is built in: it does not see the program, which may hide its names."""
        return self.file.installed or self.file.shared

    def span(self, node: n.Node) -> Span:
        """Place of a node."""
        return self.tree.source.span(node.first, node.last)


class Shared:
    """What the programs of all tasks share: persistents, record classes, configured objects."""

    def __init__(self, configured: dict[str, tuple[Type, Any]] | None = None) -> None:
        self.cells: dict[str, PersistentCell] = {}
        self.bare: set[str] = set()
        """Cells whose declarations so far had no initial value."""
        self.common: dict[tuple[str, str], Any] = {}
        """Data of shared modules by module and name: cells of atoms, else the object itself."""
        self.records: dict[tuple[object, ...], Type] = {}
        self.configured = configured if configured is not None else {}
        """Signals, mechanical units and taskids by lower-case name."""


class Program:
    """Modules of one task and their compiled code."""

    def __init__(self, task: "Task", shared: Shared, options: Options) -> None:
        self.task = task
        self.shared = shared
        self.options = options
        self.modules: dict[str, LoadedModule] = {}
        self.globals: dict[str, Symbol] = {}
        self.installed: dict[str, Symbol] = {}
        """Global names of built-in modules: the outermost scope [K §13.1]."""
        self.codes: dict[str, Compiled] = {}
        self.missing: set[str] = set()
        self.faults: list[Diagnostic] = []
        self.trace_points: list[tuple[Routine, n.Statement]] = []
        self.switch_type = Type("switch", "bool")
        self._serial = 0
        self._kept: dict[int, str] = {}
        self._predefined: dict[str, Data] = {}
        self._evaluating: set[int] = set()
        self._global_types: dict[str, tuple[LoadedModule, TypeDeclaration]] = {}
        self._installed_types: dict[str, tuple[LoadedModule, TypeDeclaration]] = {}
        self.space: dict[str, Any] = {
            **runtime.NAMESPACE,
            "R": task,
            "ERRS": RECOVERABLE,
            "ARRAY": make_array,
            "TRACE": _trace,
            "AFTER": after,
            "ARGNAME": arg_name,
        }
        dialect = options.dialect
        if dialect.for_loop == "tested":
            self.space["STEPS"] = runtime.count_tested
        if dialect.integer_division == "floor":
            self.space["DIV"], self.space["MOD"] = runtime.div_floor, runtime.mod_floor
        if dialect.negative_mod == "error":
            self.space["MOD"] = runtime.mod_strict

    # -- loading ---------------------------------------------------------------------------------

    def load(self, modules: Iterable[tuple[n.Module, ModuleFile]]) -> list[LoadedModule]:
        """Link modules; names of all are known before any value is evaluated."""
        loaded = []
        for tree, file in modules:
            self._serial += 1
            module = LoadedModule(tree.name, self._serial, tree, file)
            loaded.append(module)
            self.modules[tree.name.lower()] = module
            declared: list[TypeDeclaration] = [*tree.records, *tree.aliases]
            for declaration in declared:
                key = declaration.name.lower()
                module.types[key] = declaration
                if declaration.scope != "LOCAL":
                    types = self._installed_types if module.installed else self._global_types
                    types.setdefault(key, (module, declaration))
        for module in loaded:
            for own in module.types.values():
                self._declare_type(module, own)
        for module in loaded:
            for member in module.tree.declarations:
                self._declare(module, member)
        for module in loaded:
            for key in module.declarations:
                self._datum(module, key)
        if loaded:
            self._reset_code()
        return loaded

    def unload(self, name: str) -> None:
        """Remove a module; code that called it is linked anew."""
        module = self.modules.pop(name.lower())
        for key in module.types:
            if self._global_types.get(key, (None,))[0] is module:
                del self._global_types[key]
        for key, symbol in module.symbols.items():
            if self.globals.get(key) is symbol:
                del self.globals[key]
        self._reset_code()

    def _reset_code(self) -> None:
        for module in self.modules.values():
            for symbol in module.symbols.values():
                if isinstance(symbol, Routine):
                    self.space[symbol.code] = self._stub(symbol)

    def _declare_type(self, module: LoadedModule, d: TypeDeclaration) -> None:
        key = d.name.lower()
        if key in module.symbols or id(d) in self._evaluating:
            return
        self._evaluating.add(id(d))
        if isinstance(d, n.AliasDeclaration):
            kind = self.find_type(module, d.type.lower())
            if kind is None:
                self._fault(module, f"type {d.type} is not known", d)
        else:
            kind = self._record(module, d)
        self._evaluating.discard(id(d))
        if kind is not None:
            module.symbols[key] = kind
            if d.scope != "LOCAL":
                self._outside(module).setdefault(key, kind)

    def _record(self, module: LoadedModule, d: n.RecordDeclaration) -> Type | None:
        components = []
        for component in d.components:
            kind = self.find_type(module, component.type.lower())
            if kind is None:
                self._fault(module, f"type {component.type} is not known", component)
                return None
            components.append((component.name, kind))
        signature = (d.name.lower(), *((c.lower(), t.name) for c, t in components))
        known = self.shared.records.get(signature)
        if known is None:
            known = make_record(d.name, components).rapid_type
            self.shared.records[signature] = known
        return known

    def _declare(self, module: LoadedModule, d: n.Declaration) -> None:
        if isinstance(d, n.DataDeclaration):
            module.declarations[d.name.lower()] = d
            if d.scope != "LOCAL":
                # The module's own entry is made when it is evaluated; this one finds it.
                self._outside(module).setdefault(d.name.lower(), Pending(module))
        elif isinstance(d, n.RoutineDeclaration):
            routine = self._routine(module, d)
            module.symbols[d.name.lower()] = routine
            self.space[routine.code] = self._stub(routine)
            if d.scope != "LOCAL":
                self._outside(module).setdefault(d.name.lower(), routine)

    def _routine(self, module: LoadedModule, d: n.RoutineDeclaration) -> Routine:
        parameters = []
        for p in d.parameters:
            switch = p.type.lower() == "switch"
            kind = None if switch else self.find_type(module, p.type.lower())
            if kind is None and not switch:
                self._fault(module, f"type {p.type} is not known", p)
                kind = NUM
            parameters.append(
                Parameter(p.name, p.mode, kind, p.type, p.dimensions, p.optional, p.group, switch)
            )
        result = self.find_type(module, d.type.lower()) if d.type else None
        if d.type and result is None:
            self._fault(module, f"type {d.type} is not known", d)
        code = f"m{module.index}_{d.name.lower()}"
        return Routine(
            d.name, d.kind, result, tuple(parameters), code, d, module, type_name=d.type or ""
        )

    def _fault(self, module: LoadedModule, message: str, node: n.Node) -> None:
        self.faults.append(Diagnostic("RG401", Severity.ERROR, message, module.span(node)))

    # -- data ------------------------------------------------------------------------------------

    def _datum(self, module: LoadedModule, key: str) -> Data | None:
        """The symbol of a module datum, evaluated on first need."""
        symbol = module.symbols.get(key)
        if isinstance(symbol, Data):
            return symbol
        d = module.declarations.get(key)
        if d is None or id(d) in self._evaluating:
            return None
        self._evaluating.add(id(d))
        try:
            kind, dims, value = self._evaluate(module, {}, d)
        except CannotCompile as fault:
            self._fault(module, str(fault), fault.node)
            found = self.find_type(module, d.type.lower())
            if found is None:
                return None
            kind, dims, value = found, (), found.default()
        finally:
            self._evaluating.discard(id(d))
        data = self._place(module, d, kind, dims, value)
        module.symbols[key] = data
        scope = self._outside(module)
        pending = scope.get(key)
        if isinstance(pending, Pending) and pending.module is module:
            scope[key] = data
        return data

    def _outside(self, module: LoadedModule) -> dict[str, Symbol]:
        """The scope that gets the global names of a module."""
        return self.installed if module.installed else self.globals

    def _place(
        self,
        module: LoadedModule,
        d: n.DataDeclaration,
        kind: Type,
        dims: tuple[int, ...],
        value: Any,  # noqa: ANN401
    ) -> Data:
        code = f"m{module.index}_{d.name.lower()}"
        if d.kind == "CONST" and not dims and kind.kind in _ATOMIC:
            return Data(d.name, "CONST", kind, (), "inline", code, value=value, readonly=True)
        if d.kind == "PERS":
            self.space[code] = self._cell(module, d, kind, dims, value)
            return Data(d.name, "PERS", kind, dims, "cell", code)
        if d.kind == "VAR" and module.file.shared and d.scope != "TASK":
            atom = not dims and kind.kind in _ATOMIC
            made = SharedVariable(d.name, kind, dims, value) if atom else value
            key = (module.name.lower(), d.name.lower())
            self.space[code] = self.shared.common.setdefault(key, made)
            return Data(d.name, "VAR", kind, dims, "cell" if atom else "global", code)
        self.space[code] = value
        readonly = d.kind == "CONST"
        return Data(d.name, d.kind, kind, dims, "global", code, readonly=readonly)

    def _cell(
        self,
        module: LoadedModule,
        d: n.DataDeclaration,
        kind: Type,
        dims: tuple[int, ...],
        value: Any,  # noqa: ANN401
    ) -> PersistentCell:
        """The cell of a PERS: one for the whole system by name, unless LOCAL or TASK.

        The first declaration with an initial value gives the value [K §14.4].
        """
        if module.file.shared and d.scope != "TASK":
            place = (module.name.lower(), d.name.lower())
            own: PersistentCell = self.shared.common.setdefault(
                place, PersistentCell(d.name, kind, dims, value)
            )
            return own
        if d.scope:
            return PersistentCell(d.name, kind, dims, value)
        key = d.name.lower()
        cell = self.shared.cells.get(key)
        if cell is None:
            cell = self.shared.cells[key] = PersistentCell(d.name, kind, dims, value)
            if d.initial is None:
                self.shared.bare.add(key)
            return cell
        if cell.type.name != kind.name or cell.dims != dims:
            self._fault(
                module, f"{d.name} is shared with another task that declares another type", d
            )
            return PersistentCell(d.name, kind, dims, value)
        if d.initial is not None and key in self.shared.bare:
            self.shared.bare.discard(key)
            cell.set(value)
        return cell

    def evaluate_local(
        self, module: LoadedModule, local: dict[str, Data], d: n.DataDeclaration
    ) -> tuple[Type, tuple[int, ...], Any]:
        """Type, sizes and initial value of a routine's variable."""
        return self._evaluate(module, local, d)

    def _evaluate(
        self, module: LoadedModule, local: dict[str, Data], d: n.DataDeclaration
    ) -> tuple[Type, tuple[int, ...], Any]:
        kind = self.find_type(module, d.type.lower())
        if kind is None:
            raise CannotCompile(f"type {d.type} is not known", d)

        def lookup(node: n.Name) -> tuple[Type, tuple[int, ...], Any]:
            data = local.get(node.name.lower()) or self.find_data(module, node.name.lower())
            if data is None:
                raise CannotCompile(f"{node.name} is not known", node)
            if data.kind != "CONST":
                raise CannotCompile(f"{node.name} is no constant", node)
            value = data.value if data.storage == "inline" else self.space[data.code]
            return data.type, data.dims, value

        dims = tuple(self._dimension(x, lookup) for x in d.dimensions)
        if d.initial is not None:
            return kind, dims, evaluate(d.initial, kind, dims, lookup)
        if dims:
            return kind, dims, make_array(dims, kind.default)
        return kind, dims, kind.default()

    def _dimension(self, node: n.Expression, lookup: Any) -> int:  # noqa: ANN401
        size = evaluate(node, NUM, (), lookup)
        if not isinstance(size, int) or size < 1:
            raise CannotCompile("a dimension is a whole number from 1", node)
        return size

    def reset_variables(self) -> None:
        """Give every module VAR its initial value: PP to main [S4 overview 4-24].

        Data of built-in modules keep theirs, but for what a shared one has for each task [K §13.2].
        """
        for module in self.modules.values():
            for key, d in module.declarations.items():
                if module.installed and not (module.file.shared and d.scope == "TASK"):
                    continue
                data = module.symbols.get(key)
                if d.kind == "VAR" and isinstance(data, Data):
                    _, _, value = self._evaluate(module, {}, d)
                    self.space[data.code] = value

    # -- names -----------------------------------------------------------------------------------

    def find_type(self, module: LoadedModule, key: str) -> Type | None:
        """A type by lower-case name, as seen from a module."""
        for scope in self._scopes(module):
            found = scope.get(key)
            if isinstance(found, Type):
                return found
        # Not met yet: types may be used before the module that declares them is linked.
        place = module.types.get(key)
        owner = module
        if place is None or key in module.symbols:
            owner, place = self._installed_types.get(key, (module, None))
            if not module.installed:
                owner, place = self._global_types.get(key, (owner, place))
        if place is not None and key not in owner.symbols:
            self._declare_type(owner, place)
            found = owner.symbols.get(key)
            return found if isinstance(found, Type) else None
        return predefined.find_type(key)

    def _scopes(self, module: LoadedModule | None) -> tuple[dict[str, Symbol], ...]:
        """Where a name used in a module is looked for, from the inside out [K §13.1, 14.1]."""
        if module is None:
            return {}, self.globals, self.installed
        if module.installed:
            return module.symbols, self.installed
        return module.symbols, self.globals, self.installed

    def find_data(self, module: LoadedModule | None, key: str) -> Data | None:
        """A datum by lower-case name, as seen from a module (None: from outside)."""
        if module is not None:
            own = module.symbols.get(key)
            if own is None and key in module.declarations:
                own = self._datum(module, key)
            if own is not None:
                return own if isinstance(own, Data) else None
        for scope in self._scopes(module)[1:]:
            found = scope.get(key)
            if isinstance(found, Pending):
                found = self._datum(found.module, key)
            if found is not None:
                return found if isinstance(found, Data) else None
        return predefined.constant(key) or self._predefined_data(key)

    def _predefined_data(self, key: str) -> Data | None:
        known = self._predefined.get(key)
        if known is not None:
            return known
        data: Data | None = None
        datum = signatures.constant(key)
        if key in ("errno", "intno"):
            data = Data(key.upper(), "VAR", NUM, (), "global", f"R.{key}", readonly=True)
        elif datum is not None:
            data = self._predefined_datum(key, datum)
        elif key in self.shared.configured:
            kind, value = self.shared.configured[key]
            self.space[f"c_{key}"] = value
            data = Data(key, "VAR", kind, (), "global", f"c_{key}")
        if data is not None:
            self._predefined[key] = data
        return data

    def _predefined_datum(self, key: str, datum: signatures.Predefined) -> Data | None:
        kind = predefined.find_type(datum.type.lower())
        if kind is None:
            return None
        value = predefined.build(kind, datum.value)
        code = f"p_{key}"
        if datum.kind == "PERS":
            cell = self.shared.cells.get(f" {key}")
            if cell is None:
                cell = self.shared.cells[f" {key}"] = PersistentCell(datum.name, kind, (), value)
            self.space[code] = cell
            return Data(datum.name, "PERS", kind, (), "cell", code)
        self.space[code] = value
        readonly = datum.kind == "CONST"
        return Data(datum.name, datum.kind, kind, (), "global", code, readonly=readonly)

    def find_routine(self, module: LoadedModule | None, key: str) -> Routine | None:
        """A routine by lower-case name, as seen from a module; built-ins come last."""
        if module is not None:
            own = module.symbols.get(key)
            if isinstance(own, Routine):
                return own
        for scope in self._scopes(module)[1:]:
            found = scope.get(key)
            if isinstance(found, Routine):
                return found
        builtin = predefined.routine(key)
        if builtin is not None and builtin.builtin is not None and builtin.code not in self.space:
            self.space[builtin.code] = builtin.builtin.function
        return builtin

    # -- what generated code names ---------------------------------------------------------------

    def keep(self, value: Any) -> str:  # noqa: ANN401
        """A name in the namespace for any object."""
        known = self._kept.get(id(value))
        if known is None:
            self._serial += 1
            known = self._kept[id(value)] = f"k{self._serial}"
            self.space[known] = value
        return known

    def type_code(self, kind: Type) -> str:
        """Name of a Type."""
        return self.keep(kind)

    def record_code(self, kind: Type) -> str:
        """Name of what makes a datum of a type."""
        assert kind.make is not None
        return self.keep(kind.make)

    def global_ref(self, data: Data) -> str:
        """Name of a reference to module data."""
        name = f"r_{data.code}"
        if name not in self.space:
            self.space[name] = runtime.GlobalRef(
                self.space, data.code, data.type, data.dims, data.name
            )
        return name

    def module_code(self, module: LoadedModule) -> str:
        """Name of a module."""
        return self.keep(module)

    def trap_code(self, trap: Routine) -> str:
        """Name of a trap."""
        return self.keep(trap)

    def code_name(self, routine: Routine) -> str:
        """Python file name of a routine's code."""
        assert routine.module is not None
        return f"<rapid {self.task.name} {routine.module.name} {routine.name}>"

    def trace_point(self, routine: Routine, statement: n.Statement) -> int:
        """Number of a statement, for tracing."""
        self.trace_points.append((routine, statement))
        return len(self.trace_points) - 1

    def trace_from_now(self) -> None:
        """Compile with a report of every statement from now on."""
        if not self.options.tracing:
            self.options = replace(self.options, tracing=True, accounting="statement")
            self.codes.clear()
            self._reset_code()

    def said_missing(self, name: str) -> None:
        """Remember a routine that is called and does not exist."""
        self.missing.add(name)

    # -- code ------------------------------------------------------------------------------------

    def _stub(self, routine: Routine) -> Callable[..., Any]:
        def stub(*arguments: Any, **named: Any) -> Any:  # noqa: ANN401
            return self.function(routine)(*arguments, **named)

        return stub

    def function(self, routine: Routine) -> Callable[..., Any]:
        """The compiled function of a routine; FatalError when it breaks the language's rules."""
        assert routine.module is not None
        name = self.code_name(routine)
        known = self.codes.get(name)
        if known is not None and known.routine is routine:
            function: Callable[..., Any] = self.space[routine.code]
            if getattr(function, "__name__", "") != "stub":
                return function
        try:
            function, compiled = compile_routine(self, routine.module, routine, self.options)
        except CannotCompile as fault:
            span = routine.module.span(fault.node)
            self.faults.append(Diagnostic("RG401", Severity.ERROR, str(fault), span))
            raise FatalError(
                40001, "Program cannot be linked", f"{routine.name}: {fault}", span=span
            ) from fault
        self.codes[name] = compiled
        return function

    def rest(
        self, standing: Standing, *, calls: bool = False, alone: bool = False
    ) -> Callable[[dict[str, Any]], Any]:
        """A function that goes on with a routine where it stands. CannotCompile: it cannot.

        `calls`: the statement is a call that is under way. `alone`: only it is executed.
        """
        options = replace(self.options, tracing=False) if alone else self.options
        function, compiled, name = compile_rest(self, standing, options, calls=calls, alone=alone)
        self.codes[name] = compiled
        return function

    def backward(self, routine: Routine) -> Callable[..., Any]:
        """The BACKWARD handler of a procedure as a function. CannotCompile."""
        assert routine.module is not None
        function, compiled, name = compile_backward(self, routine, self.options)
        self.codes[name] = compiled
        return function

    def value(self, module: LoadedModule, key: str) -> Any:  # noqa: ANN401
        """Current value of a module datum. KeyError: there is none."""
        data = module.symbols[key]
        if not isinstance(data, Data):
            raise KeyError(key)
        if data.storage == "inline":
            return data.value
        kept = self.space[data.code]
        return kept.v if isinstance(kept, PersistentCell) else kept
