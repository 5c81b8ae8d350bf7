"""Linking: names of a task as types, data and routines.

Linking is lazy. `add` makes the names of all modules known first, so that declarations may refer to
each other in any order. Types, data and routines are then made on first need, through the one
resolver in rapid/binding. A datum under evaluation is None in the table: a cycle of initial values
ends with an error instead of a recursion.

A name without a declaration is an error only where a program uses it. Types, sizes and values that
other modules would declare become opaque types, so that a module of an incomplete program can be
loaded and run up to that use.
"""

from collections import Counter
from dataclasses import dataclass
from functools import cache, lru_cache
from math import prod
from typing import TypeAlias

from rapidgen.diagnostics import Diagnostic, Severity, error, refusal
from rapidgen.rapid.binding import constants
from rapidgen.rapid.binding.names import (
    DataSymbol,
    ModuleScope,
    ModuleSymbol,
    RoutineSymbol,
    Scope,
    Symbol,
    TaskScope,
    TypeSymbol,
    array,
    builtin,
    called,
    installed_objects,
)
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.module_trees import SMALL
from rapidgen.rapid.numbers import single
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.compiler.support import GlobalRef
from rapidgen.runtime.compiler.symbols import CannotCompile, Data, LoadedModule, Routine, formal
from rapidgen.runtime.registry import bound
from rapidgen.runtime.values import (
    ATOMIC,
    NUM,
    TYPES,
    PersistentCell,
    Type,
    Value,
    make_array,
    make_record,
    register_type,
)
from rapidgen.system.model import ModuleFile

# -- Initial values --------------------------------------------------------------------------------
#
# Initial values of declarations: constant expressions as RAPID values [K §3.1-3.2].
#
# They are not compiled, because backups contain a hundred thousand numbers. This code makes
# aggregates and literals directly; rapid/binding evaluates all other expressions.


def evaluate(node: n.Expression, kind: Type, dims: tuple[int, ...], scope: Scope) -> Value:
    """Return the value of a constant expression of a known type.

    CannotCompile: it has no value.
    """
    if not dims and kind.kind == "num":
        if isinstance(node, n.NumberLiteral):
            return single(node.value)
        if isinstance(node, n.Unary) and isinstance(node.operand, n.NumberLiteral):
            value = single(node.operand.value)
            return -value if node.operator == "-" else value
    elif isinstance(node, n.Aggregate):
        return _aggregate(node, kind, dims, scope)
    try:
        result = constants.evaluate(node, scope, array(kind.name, len(dims)))
    except constants.NotConstant as error:
        raise CannotCompile(str(error), error.node) from error
    return build(kind, result, len(dims))


def _aggregate(node: n.Aggregate, kind: Type, dims: tuple[int, ...], scope: Scope) -> Value:
    members = node.members
    if dims:
        if len(members) != dims[0]:
            raise CannotCompile(f"{len(members)} members for {dims[0]} elements", node)
        inner = dims[1:]
        return {i: evaluate(m, kind, inner, scope) for i, m in enumerate(members, start=1)}
    if kind.kind != "record" or kind.make is None:
        raise CannotCompile(f"an aggregate is no {kind.name}", node)
    components = kind.components
    if len(members) != len(components) and not scope.module.takes(kind.name, len(members)):
        raise CannotCompile(f"{kind.name} has {len(components)} components", node)
    return kind.make(
        *[evaluate(m, inner, (), scope) for m, (_, inner) in zip(members, components, strict=False)]
    )


def build(kind: Type, value: signatures.Value | None, degree: int = 0) -> Value:
    """Return nested tuples of rapid/binding as a RAPID value."""
    if value is None:
        return kind.default()
    if isinstance(value, tuple):
        if degree:
            return {i: build(kind, v, degree - 1) for i, v in enumerate(value, start=1)}
        assert kind.make is not None
        return kind.make(*[build(t, v) for (_, t), v in zip(kind.components, value, strict=False)])
    if kind.kind == "num" and isinstance(value, int | float):
        return single(value)
    return value


# -- Predefined names ------------------------------------------------------------------------------
#
# Predefined types, data and routines as symbols, from the signature data.


class Opaque:
    """A datum of a predefined type without public components."""

    __slots__ = ("type", "value")

    def __init__(self, type: str) -> None:
        self.type = type
        self.value: Value = None


def unknown_type(name: str) -> Type:
    """Return an opaque type for an undeclared type.

    Programs can only store its data and pass them on.
    """
    return Type(name.lower(), "nonvalue", (), lambda: Opaque(name))


@cache
def find_type(name: str) -> Type | None:
    """Return a predefined type by lower-case name, aliases resolved."""
    base = signatures.alias(name)
    if base is not None:
        return _needed(base)
    bound("")  # loading the built-ins registers their types
    known = TYPES.get(name)
    if known is not None:
        return known
    record = signatures.record(name)
    if record is not None:
        components = [(c, _needed(t)) for t, c in record.components]
        made: Type = make_record(record.name, components).rapid_type
        TYPES[name] = made
        return made
    kind = signatures.type_class(name)
    if kind is None:
        return None
    return register_type(
        name, lambda: Opaque(name), "semivalue" if kind == "semivalue" else "nonvalue"
    )


def _needed(name: str) -> Type:
    result: Type | None = find_type(name.lower())
    if result is None:
        raise LookupError(f"the signature data use an unknown type {name}")
    return result


@cache
def predefined_datum(key: str) -> Data | None:
    """Return the storage of a predefined datum by lower-case name.

    An atomic constant becomes part of the code.
    """
    result = signatures.constant(key)
    if result is None:
        return None
    kind = _needed(result.type)
    if result.kind == "PERS":
        return Data(result.name, "PERS", kind, (), "cell", f"p_{key}")
    readonly = result.readonly
    if readonly and kind.kind != "record":
        return Data(
            result.name,
            "CONST",
            kind,
            (),
            "inline",
            "",
            value=predefined_value(key),
            readonly=readonly,
        )
    return Data(result.name, result.kind, kind, (), "global", f"p_{key}", readonly=readonly)


def predefined_value(key: str) -> Value:
    """Return the initial value of a predefined datum."""
    result = signatures.predefined()[key]
    return build(_needed(result.type), result.value)


@cache
def predefined_routine(name: str) -> Routine | None:
    """Return a built-in routine by lower-case name.

    `missing` marks one without a Python function.
    """
    signature = signatures.routine(name)
    if signature is None:
        return None
    parameters = tuple(
        formal(p, None if p.type.lower() in ("anytype", "switch") else _needed(p.type))
        for p in signature.parameters
    )
    binding = bound(name)
    return Routine(
        signature.name,
        signature.kind,
        _needed(signature.type) if signature.type else None,
        parameters,
        f"B_{name}",
        builtin=binding,
        missing=binding is None and name not in signatures.marked("inline"),
        lazy=signature.marks.get("lazy", ()),
    )


# -- Names of a task -------------------------------------------------------------------------------
#
# Symbols of rapid/binding as types, data and routines of a task.
#
# Modules are linked into one Python namespace. All tasks share persistents, data of shared modules
# and record classes.


Typed = tuple[Type, tuple[int, ...], Value]
"""Type, sizes and value of a datum."""

MOST_ELEMENTS = 4_000_000
"""Elements of an array: about 400 MB. The program memory of a controller is smaller [mem]."""


class Shared:
    """State shared by all tasks: persistents, record classes, installed objects."""

    def __init__(self, configured: dict[str, tuple[Type, Value]] | None = None) -> None:
        self.cells: dict[str, PersistentCell] = {}
        self.declared: Counter[str] = Counter()
        """So many loaded modules declare the persistent of a cell: with the last one it goes."""
        self.bare: set[str] = set()
        """Cells whose declarations have had no initial value until now."""
        self.common: dict[tuple[str, str], Value] = {}
        """Data of shared modules by module and name: cells of atoms, else the object itself."""
        self.records: dict[tuple[object, ...], Type] = {}
        self.unknown: dict[str, Type] = {}
        """Undeclared types, and types of data whose size or value is undeclared, by the missing
        name in lower case."""
        self.configured = configured if configured is not None else {}
        """Signals, mechanical units and taskids by lower-case name."""
        self.names = installed_objects((k, t.name) for k, (t, _) in self.configured.items())


@lru_cache(maxsize=1024)
def _record_type(name: str, components: tuple[tuple[str, Type], ...]) -> Type:
    """Return the type of a record; controllers of a process share it."""
    made: Type = make_record(name, components).rapid_type
    return made


@dataclass(frozen=True, slots=True)
class Loading:
    """A module that was loaded into a task."""

    tree: n.Module
    installed: bool
    shared: bool


Change: TypeAlias = Loading | str
"""A module that was loaded, or the name of one that was removed."""


class Linker:
    """Types, data and routines of one task, made on first need."""

    def __init__(self, shared: Shared, space: dict[str, Value]) -> None:
        """Link into `space`, which receives values, persistents, built-ins."""
        self.shared = shared
        self.space = space
        self.names = TaskScope(shared.names)
        self.modules: dict[str, LoadedModule] = {}
        self.changes: list[Change] = []
        """All modules that came and went."""
        self.small = True
        """No module was larger than SMALL."""
        self.faults: list[Diagnostic] = []
        """Errors, and warnings of undeclared types."""
        self.trace_points: list[tuple[Routine, n.Statement]] = []
        self.traced_points: list[bool] = []
        """By trace point: True while a tracer may need the statement. Compiled code reads this
        list."""
        self.space["TRACED"] = self.traced_points
        self._kept: dict[int, str] = {}
        self._loaded: dict[ModuleScope, LoadedModule] = {}
        self._modules = 0
        self._serial = 0
        self._types: dict[TypeSymbol, Type | None] = {}
        self._data: dict[DataSymbol, Data | None] = {}
        self._routines: dict[RoutineSymbol, Routine | None] = {}
        self._sound: set[tuple[str, str, n.Shape]] = set()
        """Modules, types and shapes of constants that were evaluated without an error."""

    # -- what generated code names ---------------------------------------------------------------

    def keep(self, value: Value) -> str:
        """Return a name in the namespace for any object."""
        known = self._kept.get(id(value))
        if known is None:
            self._serial += 1
            known = self._kept[id(value)] = f"k{self._serial}"
            self.space[known] = value
        return known

    def global_ref(self, data: Data) -> str:
        """Return the name of a reference to module data."""
        name = f"r_{data.code}"
        if name not in self.space:
            self.space[name] = GlobalRef(self.space, data.code, data.type, data.dims, data.name)
        return name

    def trace_point(self, routine: Routine, statement: n.Statement) -> int:
        """Return a new trace point for a statement."""
        self.trace_points.append((routine, statement))
        self.traced_points.append(True)
        return len(self.trace_points) - 1

    # -- modules ---------------------------------------------------------------------------------

    def add(self, tree: n.Module, file: ModuleFile) -> LoadedModule:
        """Register the names of a module.

        DiagnosticError RG305: a module of this name exists.
        """
        if tree.name.lower() in self.modules:
            at = tree.source.span(tree.first, tree.first)
            raise refusal(
                "RG305",
                at,
                f"module '{tree.name}' is twice in this task",
                "load one of them",
                exit_code=1,
            )
        self._modules += 1
        self.changes.append(Loading(tree, file.installed, file.shared))
        self.small = self.small and len(file.data) <= SMALL
        scope = self.names.add(tree, installed=file.installed or file.shared)
        module = self._loaded[scope] = LoadedModule(self._modules, tree, file, scope)
        self.modules[tree.name.lower()] = module
        return module

    def link(self, loaded: list[LoadedModule]) -> None:
        """Make types, routines and data of registered modules."""
        for module in self.modules.values():
            module.types.clear()
        own = [(module, symbol) for module in loaded for symbol in module.scope.own.values()]
        for module, symbol in own:
            if isinstance(symbol, TypeSymbol):
                self._check_type(module, symbol)
        for module, symbol in own:
            if isinstance(symbol, RoutineSymbol):
                self._link_routine(module, symbol)
        for module, symbol in own:
            if isinstance(symbol, DataSymbol) and not self._can_wait(module, symbol):
                self.datum(symbol)

    def _can_wait(self, module: LoadedModule, symbol: DataSymbol) -> bool:
        """Return True for a constant whose value can be made on first need, without an error.

        The first constant of its type and shape is evaluated. A module with thousands of targets
        begins sooner, and most programs need few of them. The code of small programs is kept for
        others, which bind all their data.
        """
        d = symbol.node
        if self.small or not isinstance(d, n.DataDeclaration) or d.kind != "CONST" or d.dimensions:
            return False
        if type(d.initial) is not n.Aggregate or d.initial.shape is None:
            return False
        key = module.name, d.type.lower(), d.initial.shape
        if key in self._sound:
            return True
        faults = len(self.faults)
        data = self.datum(symbol)
        if data is not None and len(self.faults) == faults:
            self._sound.add(key)
        return True

    def remove(self, name: str) -> None:
        """Remove a module."""
        gone = self.modules.pop(name.lower()).scope
        self.changes.append(name.lower())
        self.names.remove(gone)
        del self._loaded[gone]
        for symbol in gone.own.values():
            if isinstance(symbol, TypeSymbol):
                self._types.pop(symbol, None)
            elif isinstance(symbol, DataSymbol):
                self._forget(self._data.pop(symbol, None))
            elif isinstance(symbol, RoutineSymbol):
                self._routines.pop(symbol, None)
        for module in self.modules.values():
            module.types.clear()

    def _forget(self, data: Data | None) -> None:
        """Remove a declaration.

        The last declaration of a system-global persistent removes its cell [K §14.4].
        """
        if data is None or data.kind != "PERS":
            return
        key = data.name.lower()
        if self.shared.cells.get(key) is self.space.get(data.code):
            self.shared.declared[key] -= 1
            if not self.shared.declared[key]:
                del self.shared.cells[key]
                self.shared.bare.discard(key)

    def _fault(self, module: LoadedModule, message: str, node: n.Node) -> None:
        self.faults.append(error("RG401", module.span(node), message))

    # -- types -----------------------------------------------------------------------------------

    @property
    def declared_types(self) -> tuple[Type | None, ...]:
        """Types that the modules declare."""
        return tuple(self._types.values())

    def find_type(self, module: LoadedModule, name: str, node: n.Node) -> Type | None:
        """Return the type of a name in a module; `node` is its place.

        An undeclared type may belong to an option or add-in: statements that need its components
        stop the task when executed. None: a record that contains itself.
        """
        if name in module.types:
            return module.types[name]
        symbol = module.scope.type_symbol(name)
        result = self._unknown(module, name, node) if symbol is None else self._type(symbol)
        module.types[name] = result
        return result

    def _unknown(self, module: LoadedModule, name: str, node: n.Node, what: str = "type") -> Type:
        """Return an opaque type for data with an undeclared type or size."""
        match = self.shared.unknown.get(name.lower())
        if match is None:
            match = self.shared.unknown[name.lower()] = unknown_type(name)
            option = name.lower() in signatures.option_names("types")
            self.faults.append(
                error(
                    "RG404",
                    module.span(node),
                    f"the {what} {name} is not declared in any module, nor built in",
                    "" if option else "load the module that declares it",
                    label="statements that look into it stop the task",
                    notes=("it belongs to an option or add-in of RobotWare",) if option else (),
                    severity=Severity.WARNING,
                )
            )
        return match

    def _check_type(self, module: LoadedModule, symbol: TypeSymbol) -> None:
        assert symbol.node is not None
        self.find_type(module, symbol.name, symbol.node)

    def _type(self, symbol: TypeSymbol) -> Type | None:
        if symbol.module is None:
            return find_type(symbol.name.lower())
        if symbol not in self._types:
            self._types[symbol] = None  # no record contains itself
            self._types[symbol] = self._record(self._loaded[symbol.module], symbol)
        return self._types[symbol]

    def _record(self, module: LoadedModule, symbol: TypeSymbol) -> Type | None:
        assert isinstance(symbol.node, n.RecordDeclaration)
        components = []
        for component in symbol.node.components:
            kind = self.find_type(module, component.type, component)
            if kind is None:
                self._fault(module, f"type {component.type} is not known", component)
                return None
            components.append((component.name, kind))
        signature = (symbol.name.lower(), *((c.lower(), t.name) for c, t in components))
        known = self.shared.records.get(signature)
        if known is None:
            known = _record_type(symbol.name, tuple(components))
            self.shared.records[signature] = known
        return known

    # -- routines --------------------------------------------------------------------------------

    def routine(self, symbol: Symbol | None) -> Routine | None:
        """Return the routine of a symbol, None for other symbols."""
        if not isinstance(symbol, RoutineSymbol):
            symbol = called(_meant(symbol))
            if not isinstance(symbol, RoutineSymbol):
                return None
        if symbol not in self._routines:
            self._routines[symbol] = self._builtin(symbol.name.lower())
        return self._routines[symbol]

    def _builtin(self, key: str) -> Routine | None:
        result = predefined_routine(key)
        if result is not None and result.builtin is not None:
            self.space.setdefault(result.code, result.builtin.function)
        return result

    def _link_routine(self, module: LoadedModule, symbol: RoutineSymbol) -> None:
        d = symbol.node
        assert d is not None
        parameters = []
        for p in d.parameters:
            switch = p.type.lower() == "switch"
            kind = None if switch else self.find_type(module, p.type, p)
            if kind is None and not switch:
                self._fault(module, f"type {p.type} is not known", p)
                kind = NUM
            parameters.append(formal(p, kind))
        result = self.find_type(module, d.type, d) if d.type else None
        if d.type and result is None:
            self._fault(module, f"type {d.type} is not known", d)
        code = f"m{module.index}_{d.name.lower()}"
        routine = Routine(d.name, d.kind, result, tuple(parameters), code, d, module)
        self._routines[symbol] = module.routines[d.name.lower()] = routine

    # -- data ------------------------------------------------------------------------------------

    def datum(self, symbol: Symbol | None) -> Data | None:
        """Return the storage of a symbol's datum, None for other symbols.

        Module data are evaluated on first need.
        """
        if not isinstance(symbol, DataSymbol):
            symbol = _meant(symbol)
            if not isinstance(symbol, DataSymbol):
                return None
        if symbol not in self._data:
            self._data[symbol] = None  # data that need each other come to an end
            if symbol.module is None:
                self._data[symbol] = self._predefined(symbol)
            else:
                self._data[symbol] = self._module_datum(symbol, self._loaded[symbol.module])
        return self._data[symbol]

    def _module_datum(self, symbol: DataSymbol, module: LoadedModule) -> Data | None:
        d = symbol.node
        assert isinstance(d, n.DataDeclaration)
        try:
            kind, dims, value = self.evaluate(module, module.scope, d)
        except CannotCompile as fault:
            names = (part.name for part in walk(d) if isinstance(part, n.Name))
            missing = next((name for name in names if module.scope.find(name) is None), None)
            result = self.find_type(module, d.type, d)
            if missing is not None:
                # Its size or value needs a constant of another module.
                result = self._unknown(module, missing, d, "constant")
            else:
                self._fault(module, str(fault), fault.node)
            if result is None:
                return None
            kind, dims, value = result, (), result.default()
        return self._place(module, d, kind, dims, value)

    def _place(
        self,
        module: LoadedModule,
        d: n.DataDeclaration,
        kind: Type,
        dims: tuple[int, ...],
        value: Value,
    ) -> Data:
        code = f"m{module.index}_{d.name.lower()}"
        if d.kind == "CONST" and not dims and kind.kind in ATOMIC:
            return Data(d.name, "CONST", kind, (), "inline", code, value=value, readonly=True)
        if d.kind == "PERS":
            self.space[code] = self._cell(module, d, kind, dims, value)
            return Data(d.name, "PERS", kind, dims, "cell", code)
        if d.kind == "VAR" and module.file.shared and d.scope != "TASK":
            atom = not dims and kind.kind in ATOMIC
            made = PersistentCell(d.name, kind, dims, value, variable=True) if atom else value
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
        value: Value,
    ) -> PersistentCell:
        """Return the cell of a PERS.

        Without LOCAL and TASK there is one cell per name in the whole system. The first declaration
        with an initial value defines the value [K §14.4].
        """
        if module.file.shared and d.scope != "TASK":
            place = (module.name.lower(), d.name.lower())
            made = PersistentCell(d.name, kind, dims, value)
            own: PersistentCell = self.shared.common.setdefault(place, made)
            return own
        if d.scope:
            return PersistentCell(d.name, kind, dims, value)
        key = d.name.lower()
        cell = self.shared.cells.get(key)
        if cell is None or (cell.type.name == kind.name and cell.dims == dims):
            self.shared.declared[key] += 1
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

    def evaluate(self, module: LoadedModule, scope: Scope, d: n.DataDeclaration) -> Typed:
        """Return type, sizes and initial value of a declaration.

        Raises CannotCompile.
        """
        kind = self.find_type(module, d.type, d)
        if kind is None:
            raise CannotCompile(f"type {d.type} is not known", d)
        dims = tuple(_dimension(x, scope) for x in d.dimensions)
        if prod(dims) > MOST_ELEMENTS:
            raise CannotCompile(
                f"{d.name} would have {prod(dims):,} elements; the limit is {MOST_ELEMENTS:,}",
                d,
            )
        if d.initial is not None and kind.name not in self.shared.unknown:
            return kind, dims, self._counted(evaluate(d.initial, kind, dims, scope), kind)
        if dims:
            return kind, dims, make_array(dims, kind.default)
        return kind, dims, kind.default()

    def _counted(self, value: Value, kind: Type) -> Value:
        """Round the dnums of an initial value."""
        if kind.kind != "dnum":
            return value
        if value.__class__ is dict:
            return {i: self._counted(part, kind) for i, part in value.items()}
        return self.space["WHOLE"](value)

    def _predefined(self, symbol: DataSymbol) -> Data | None:
        key = symbol.name.lower()
        if symbol.kind == "INSTALLED":
            kind, value = self.shared.configured[key]
            self.space[f"c_{key}"] = value
            return Data(key, "VAR", kind, (), "global", f"c_{key}")
        if symbol.readonly and symbol.kind == "VAR":  # ERRNO, INTNO
            return Data(symbol.name, "VAR", NUM, (), "global", f"R.{key}", readonly=True)
        result = predefined_datum(key)
        if result is None or result.storage == "inline":
            return result
        value = predefined_value(key)
        if result.storage == "cell":
            made = PersistentCell(result.name, result.type, (), value)
            value = self.shared.cells.setdefault(f" {key}", made)
        self.space[result.code] = value
        return result


def _meant(symbol: Symbol | None) -> Symbol | None:
    """Return the own or predefined object of a module's name.

    In code the name of a module has no meaning.
    """
    if isinstance(symbol, ModuleSymbol) and symbol.module is not None:
        key = symbol.name.lower()
        return symbol.module.own.get(key) or builtin(key)
    return symbol


def _dimension(node: n.Expression, scope: Scope) -> int:
    size = evaluate(node, NUM, (), scope)
    if not isinstance(size, int) or size < 1:
        raise CannotCompile("a dimension is a whole number from 1", node)
    return size
