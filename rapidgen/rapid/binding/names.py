"""Names: symbols, types as texts and the scopes of a task.

See "Scopes" below for the rules of name resolution.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Final, Literal

from rapidgen.diagnostics import Span
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.builtins.signatures import Signature, TypeClass, Value
from rapidgen.rapid.syntax.nodes import (
    AliasDeclaration,
    Component,
    DataDeclaration,
    Declaration,
    Expression,
    For,
    Label,
    Mode,
    Module,
    Node,
    Parameter,
    RecordDeclaration,
    RoutineDeclaration,
)
from rapidgen.rapid.syntax.walk import walk

# -- Types as texts --------------------------------------------------------------------------------
#
# Types as texts, and the results of operators [K §2.17, 3.11].
#
# A type is the lower-case name after resolution of aliases. Arrays append `{*}`, `{*,*}` or
# `{*,*,*}`: `num`, `robtarget{*}`. None is an unknown type.


NUMBER: Final = "number"
"""A number that may still become num or dnum: a literal, or sums of literals."""
AGGREGATE: Final = "aggregate"
NUMERIC: Final = frozenset((NUMBER, "num", "dnum"))
ATOMIC: Final = frozenset(("num", "dnum", "bool", "string"))
"""Types without components; those of some installed types are unknown."""
LOGICAL: Final = frozenset(("AND", "OR", "XOR", "NOT"))
EQUALITY: Final = frozenset(("=", "<>"))
RELATIONS: Final = frozenset(("<", "<=", ">", ">="))


def array(base: str, degree: int) -> str:
    """Return the type of an array of `base`."""
    return base + "{" + ",".join("*" * degree) + "}" if degree else base


def degree(type_name: str) -> int:
    """Return the number of dimensions of a type."""
    return type_name.count("*")


def element(type_name: str) -> str:
    """Return the element type of an array type, else the type itself."""
    return type_name.partition("{")[0]


def equal(left: str, right: str) -> bool:
    """Return True if types are equal; a literal number fits both types."""
    if left == right:
        return True
    if left == NUMBER:
        return right in NUMERIC
    return right == NUMBER and left in NUMERIC


def arithmetic(operator: str, left: str, right: str) -> str | None:
    """Return the type of `left operator right`, None if not permitted."""
    if left in NUMERIC and right in NUMERIC:
        if not equal(left, right):
            return None
        return right if left == NUMBER else left
    if operator in ("+", "-") and left == right == "pos":
        return "pos"
    if operator == "+" and left == right == "string":
        return "string"
    if operator == "*":
        if left == right and left in ("pos", "orient"):
            return left
        if "pos" in (left, right) and {left, right} & {NUMBER, "num"}:
            return "pos"
    if operator == "/" and left == "pos" and right in (NUMBER, "num"):
        return "pos"  # in no manual; programs of running cells have it [backup]
    return None


# -- Symbols ---------------------------------------------------------------------------------------
#
# Meanings of names. Symbols are made once, do not change, and compare by identity.
#
# `module` is the declaring scope, None for built-in and installed objects. Names keep the spelling
# of the declaration.


DataRole = Literal["VAR", "PERS", "CONST", "PARAMETER", "LOOP", "INSTALLED"]
TypeRole = Literal["RECORD", "ALIAS", "TYPE"]
Role = Literal[DataRole, TypeRole, "PROC", "FUNC", "TRAP", "MODULE", "LABEL", "COMPONENT"]

ROUTINES: Final[frozenset[Role]] = frozenset(("PROC", "FUNC", "TRAP"))
TYPES: Final[frozenset[Role]] = frozenset(("RECORD", "ALIAS", "TYPE"))
DATA: Final[frozenset[Role]] = frozenset(("VAR", "PERS", "CONST", "PARAMETER", "LOOP", "INSTALLED"))


@dataclass(slots=True, eq=False)
class Symbol:
    """A named object."""

    name: str
    kind: Role
    module: "ModuleScope | None" = None
    local: bool = False
    """Declared LOCAL."""
    node: Node | None = None
    """Its declaration; None for what is built in or installed."""

    @property
    def token(self) -> int:
        """Index of the name in the module's tokens, -1 without a declaration."""
        return -1

    @property
    def declared_at(self) -> Span | None:
        """Place of the name in its declaration.

        None for built-in and installed objects.
        """
        if self.module is None or self.token < 0:
            return None
        return self.module.tree.source.span(self.token, self.token)


@dataclass(slots=True, eq=False)
class DataSymbol(Symbol):
    """A datum: variable, persistent, constant, parameter, loop or signal.

    `INSTALLED` objects are signals, mechanical units and task identities.
    """

    node: DataDeclaration | Parameter | For | None = None
    type: str = "num"
    """As declared: before aliases, and without dimensions."""
    degree: int = 0
    routine: RoutineDeclaration | None = None
    """Routine of a parameter, datum or loop variable; None for module data."""
    readonly: bool = False
    """A program cannot assign it: CONST, loop variables, ERRNO, INTNO."""

    @property
    def token(self) -> int:
        """See `Symbol.token`."""
        node = self.node
        if node is None:
            return -1
        return node.first + 1 if isinstance(node, For) else node.name_token

    @property
    def mode(self) -> Mode:
        """Passing mode of a parameter."""
        return self.node.mode if isinstance(self.node, Parameter) else ""

    @property
    def optional(self) -> bool:
        """True for an optional parameter."""
        return isinstance(self.node, Parameter) and self.node.optional

    @property
    def initial(self) -> Expression | None:
        """Initial value of a declaration."""
        return self.node.initial if isinstance(self.node, DataDeclaration) else None

    @property
    def dimensions(self) -> Sequence[Expression]:
        """Sizes of a declaration; an array parameter has only a `degree`."""
        return self.node.dimensions if isinstance(self.node, DataDeclaration) else ()


@dataclass(slots=True, eq=False)
class RoutineSymbol(Symbol):
    """A routine of the program (`node`) or a built-in one (`signature`)."""

    node: RoutineDeclaration | None = None
    type: str | None = None
    """Type of a function's value, as declared."""
    signature: Signature | None = None

    @property
    def token(self) -> int:
        """See `Symbol.token`."""
        return -1 if self.node is None else self.node.name_token

    @property
    def parameters(self) -> Sequence[Parameter] | None:
        """Parameters in the order of the call, None if unknown."""
        if self.signature is not None:
            return self.signature.parameters if self.signature.checked else None
        if self.node is None or any(p.name.startswith("<") for p in self.node.parameters):
            return None
        return self.node.parameters


@dataclass(slots=True, eq=False)
class TypeSymbol(Symbol):
    """A record, an alias or a predefined type.

    Predefined records have the kind `TYPE`.
    """

    node: RecordDeclaration | AliasDeclaration | None = None
    base: str | None = None
    """Of an alias: the type that it names."""
    components: Sequence[tuple[str, str]] | None = None
    """(type, name) of a record's components in order, as declared; None for what is no record."""
    newer: int = 0
    """So many of the last components are missing in values that older releases saved."""
    partly: bool = False
    """Not all names of the components of a predefined record are public."""

    @property
    def token(self) -> int:
        """See `Symbol.token`."""
        node = self.node
        if isinstance(node, AliasDeclaration):
            return node.last - 1
        return -1 if node is None else node.first + 1 + bool(node.scope)


@dataclass(slots=True, eq=False)
class ComponentSymbol(Symbol):
    """A component of a record; without a node that of a predefined one."""

    node: Component | None = None
    type: str = "num"
    """As declared."""
    record: TypeSymbol | None = None

    @property
    def token(self) -> int:
        """See `Symbol.token`."""
        return -1 if self.node is None else self.node.first + 1


@dataclass(slots=True, eq=False)
class ModuleSymbol(Symbol):
    """The name of a module: global in its task, used by late calls only."""

    node: Module | None = None

    @property
    def token(self) -> int:
        """See `Symbol.token`."""
        return -1 if self.node is None else self.node.first + 1


@dataclass(slots=True, eq=False)
class LabelSymbol(Symbol):
    """A label of a routine."""

    node: Label | None = None

    @property
    def token(self) -> int:
        """See `Symbol.token`."""
        return -1 if self.node is None else self.node.first


# -- Scopes ----------------------------------------------------------------------------------------
#
# Scopes of a task [K §2.12, 2.20, 4.3, 4.15, 5.2, 9.1, 13.1].
#
# RAPID compares names without case. There is one space of names: a datum, a type, a routine and a
# module of the same name hide each other or clash. A name denotes the object of the innermost of
# these scopes:
#
# 1. a FOR loop: its variable, inside DO .. ENDFOR only;
# 2. the routine: parameters and data, in the body and in all its handlers. A datum of a routine
#    sees only data declared above it. GOTO alone looks up labels, in the whole routine; a label may
#    not have the name of one of its data;
# 3. the module: all its declarations, LOCAL or not. References in declarations of the module start
#    here. A LOCAL object hides a global one of another module;
# 4. the task: declarations of its modules without LOCAL, and the modules' names. Of equal global
#    names the first loaded one counts, and the clash is an error;
# 5. installed modules (built in, or shared by all tasks): their global names. The program may hide
#    them. An installed module sees its own names, those of installed modules and of the scopes
#    below, but never the program;
# 6. the configuration: signals, mechanical units, task identities. In a call they hide no
#    predefined routine (`called`): a signal may have the name of a function;
# 7. the predefined data, types and routines of RAPID (`builtins/*.rapid`).
#
# The module that declares an object resolves the aliases of its type. If two tasks declare a name
# differently, its type is unknown where both are checked together.
#
# This module reports no errors: an undeclared name is None, an unknown type is None, and objects of
# a module or a task with the same name are pairs in `clashes`.
#
# Costs: look-ups are cached per module and spelling (`known`, `bases`, `classes`), because the
# checker looks up each name of a large program many times. Adding or removing a module clears all
# caches of the task (`_forget`): a new global name may hide or provide any other.


_MAX_ALIASES: Final = 4
Clash = tuple[Symbol, Symbol]
"""Two objects of one name where there may be one: the first, which counts, and the second."""


@dataclass(slots=True, eq=False)
class TaskScope:
    """Modules of a task and all that they see.

    Modules may be added and removed.
    """

    configured: Mapping[str, Symbol] = field(default_factory=dict)
    """Signals, mechanical units and task identities, by lower-case name."""
    globals: dict[str, Symbol] = field(default_factory=dict)
    """Global names of the program, lower case."""
    installed: dict[str, Symbol] = field(default_factory=dict)
    """Global names of installed modules, lower case."""
    modules: dict[str, "ModuleScope"] = field(default_factory=dict)
    """By lower-case name; of equal names the last."""
    clashes: list[Clash] = field(default_factory=list)
    """Global objects of different modules with the same name."""
    types: dict[Symbol, str | None] = field(default_factory=dict)
    """Cache of `ModuleScope.type_of`."""
    values: dict[DataSymbol, Value | None] = field(default_factory=dict)
    """Cache of `constants.value_of`; None during evaluation and for data without a value."""
    records: dict[TypeSymbol, Mapping[str, str | None]] = field(default_factory=dict)
    """Cache of `ModuleScope.components`."""
    _members: dict[TypeSymbol, Mapping[str, ComponentSymbol]] = field(default_factory=dict)
    _parameters: dict[RoutineSymbol, tuple[DataSymbol, ...]] = field(default_factory=dict)
    _scopes: list["ModuleScope"] = field(default_factory=list)
    """All modules, of equal names as well."""

    def add(self, tree: Module, *, installed: bool = False) -> "ModuleScope":
        """Add a module; all modules see its global names from now on."""
        module = ModuleScope(tree, self, installed)
        self._scopes.append(module)
        self._publish(module)
        self._forget()
        return module

    def remove(self, module: "ModuleScope") -> None:
        """Remove a module; objects that its global names hid come back."""
        self._scopes.remove(module)
        self._rebuild(module)

    def replace(self, module: "ModuleScope", tree: Module) -> "ModuleScope":
        """Put an edited module into the place of an earlier version of it.

        The result equals that of a new scope with all modules in the same order: of equal global
        names the first module's still counts.
        """
        result = ModuleScope(tree, self, module.installed)
        self._scopes[self._scopes.index(module)] = result
        self._rebuild(module)
        return result

    def _publish(self, module: "ModuleScope") -> None:
        """Add the global names of a module."""
        own, name = module.symbol, module.tree.name.lower()
        self.modules[name] = module
        result = self.installed if module.installed else self.globals
        for key, symbol in [(name, own), *module.own.items()]:
            if symbol.local or not key:
                continue
            first = result.get(key)
            if first is None:
                result[key] = symbol
            elif first.module is not module or "MODULE" in (first.kind, symbol.kind):
                # For a module loaded twice, report only the module's name.
                again = first.module and first.module.tree.name.lower() == name
                if symbol is own or first.kind == "MODULE" or not again:
                    self.clashes.append((first, symbol))

    def _rebuild(self, gone: "ModuleScope") -> None:
        """Collect all global names again, without those of `gone`.

        To take out single names is not enough: a name that leaves gives its place to the object
        that it hid, and ends a clash. 200 modules cost about 2 ms.
        """
        for names in (self.globals, self.installed, self.modules):
            names.clear()
        self.clashes.clear()
        for symbol in gone.own.values():
            if isinstance(symbol, RoutineSymbol):
                self._parameters.pop(symbol, None)
            elif isinstance(symbol, TypeSymbol):
                self._members.pop(symbol, None)
        for module in self._scopes:
            self._publish(module)
        self._forget()

    def _forget(self) -> None:
        """Clear all caches of names, types and values."""
        for result in (self.types, self.values, self.records):
            result.clear()
        for scope in self._scopes:
            for known in (scope.known, scope.bases, scope.classes):
                known.clear()

    def find(self, key: str, *, program: bool = True) -> Symbol | None:
        """Return the symbol of a lower-case name as seen from no module.

        `program` includes the names of the program.
        """
        return (
            (self.globals.get(key) if program else None)
            or self.installed.get(key)
            or self.configured.get(key)
            or builtin(key)
        )

    def conflicting_objects(self, clash: Clash) -> None:
        """Make the type of an object unknown if two tasks declare it differently."""
        first, second = clash
        if first.kind != second.kind or _shape(first) != _shape(second):
            self.types[first] = None

    def members(self, record: TypeSymbol) -> Mapping[str, ComponentSymbol]:
        """Return the components of a record by lower-case name, always the same symbols."""
        result = self._members.get(record)
        if result is None:
            result = self._members[record] = component_symbols(record)
        return result

    def parameters(self, routine: RoutineSymbol) -> tuple[DataSymbol, ...]:
        """Return the parameters of a routine as symbols, in order.

        Empty if they are unknown.
        """
        match = self._parameters.get(routine)
        if match is None:
            match = self._parameters[routine] = tuple(
                parameter_symbol(p, routine.module, routine.node) for p in routine.parameters or ()
            )
        return match


def component_symbols(record: TypeSymbol) -> Mapping[str, ComponentSymbol]:
    """Return the components of a record by lower-case name; empty for other types."""
    nodes = record.node.components if isinstance(record.node, RecordDeclaration) else None
    return {
        name.lower(): ComponentSymbol(
            name, "COMPONENT", record.module, node=nodes[k] if nodes else None, type=of,
            record=record,
        )
        for k, (of, name) in enumerate(record.components or ())
    }  # fmt: skip


def _shape(symbol: Symbol) -> tuple[str | None, int]:
    if isinstance(symbol, DataSymbol):
        return symbol.type, symbol.degree
    if isinstance(symbol, TypeSymbol):
        return symbol.base, 0
    return (symbol.type if isinstance(symbol, RoutineSymbol) else None), 0


@dataclass(slots=True, eq=False)
class ModuleScope:
    """A module: its own names and the access to outer scopes."""

    tree: Module
    task: TaskScope
    installed: bool = False
    own: dict[str, Symbol] = field(default_factory=dict)
    """Declared symbols, by lower-case name."""
    clashes: list[Clash] = field(default_factory=list)
    """Objects of this module with the same name [K §2.12]."""
    known: dict[str, Symbol | None] = field(default_factory=dict)
    """Cache of `find`, by name as spelled."""
    bases: dict[str, str | None] = field(default_factory=dict)
    """Cache of `base`."""
    classes: dict[str, TypeClass | None] = field(default_factory=dict)
    """Cache of `type_class`; None for a record in progress."""
    symbol: ModuleSymbol = field(init=False)
    """The module's own name."""
    _routines: dict[RoutineDeclaration, "RoutineScope"] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.symbol = ModuleSymbol(self.tree.name, "MODULE", self, node=self.tree)
        for declaration in self.tree.declarations:
            symbol = self._symbol(declaration)
            if symbol is None:
                continue
            key = symbol.name.lower()
            first = self.own.get(key)
            if first is not None:
                self.clashes.append((first, symbol))
            elif key and key != "<id>":
                self.own[key] = symbol

    def _symbol(self, d: Declaration) -> Symbol | None:
        if isinstance(d, DataDeclaration):
            return datum_symbol(d, self)
        if isinstance(d, RoutineDeclaration):
            return RoutineSymbol(d.name, d.kind, self, d.scope == "LOCAL", d, d.type)
        if isinstance(d, RecordDeclaration):
            components = [(c.type, c.name) for c in d.components]
            return TypeSymbol(d.name, "RECORD", self, d.scope == "LOCAL", d, None, components)
        if isinstance(d, AliasDeclaration):
            return TypeSymbol(d.name, "ALIAS", self, d.scope == "LOCAL", d, d.type)
        return None

    @property
    def module(self) -> "ModuleScope":
        """The module itself, so that all scopes have this property."""
        return self

    def find(self, name: str) -> Symbol | None:
        """Return the symbol of a name outside routines."""
        if name in self.known:
            return self.known[name]
        key = name.lower()
        match = self.own.get(key) or self.task.find(key, program=not self.installed)
        self.known[name] = match
        return match

    def routine(self, node: RoutineDeclaration) -> "RoutineScope":
        """Return the scope of a routine with all its declarations."""
        match = self._routines.get(node)
        if match is None:
            match = self._routines[node] = RoutineScope(self, node)
            symbol = self.own.get(node.name.lower())
            if not isinstance(symbol, RoutineSymbol) or symbol.node is not node:
                symbol = RoutineSymbol(node.name, node.kind, self, False, node, node.type)
            for parameter in self.task.parameters(symbol):
                match.declare(parameter)
            for declaration in node.data:
                match.declare(datum_symbol(declaration, self, node))
        return match

    # -- types ---------------------------------------------------------------------------

    def type_symbol(self, name: str) -> TypeSymbol | None:
        """Return the type after resolution of aliases, None if unknown.

        An alias of an alias is an error [K §2.15]; aliases of each other end here.
        """
        scope: ModuleScope = self
        for _ in range(_MAX_ALIASES):
            symbol = scope.find(name)
            if not isinstance(symbol, TypeSymbol):
                return None
            if symbol.base is None:
                return symbol
            scope, name = symbol.module or scope, symbol.base
        return None

    def base(self, name: str) -> str | None:
        """Return the lower-case name after aliases, None if unknown."""
        if name in self.bases:
            return self.bases[name]
        symbol = self.type_symbol(name)
        result = symbol.name.lower() if symbol is not None else None
        self.bases[name] = result
        return result

    def type_of(self, symbol: Symbol) -> str | None:
        """Return the type of a datum, parameter or function.

        It includes the dimensions.
        """
        types = self.task.types
        if symbol in types:
            return types[symbol]
        result = None
        if isinstance(symbol, DataSymbol | RoutineSymbol) and symbol.type is not None:
            scope = symbol.module or self
            base = "anytype" if symbol.type == "anytype" else scope.base(symbol.type)
            if base is not None:
                degree = symbol.degree if isinstance(symbol, DataSymbol) else 0
                result = array(base, degree)
        types[symbol] = result
        return result

    def components(self, type_name: str) -> Mapping[str, str | None] | None:
        """Return the types of a record's lower-case components.

        None for other types.
        """
        symbol = self.find(type_name)
        if not isinstance(symbol, TypeSymbol) or symbol.components is None:
            return None
        match = self.task.records.get(symbol)
        if match is None:
            scope = symbol.module or self
            match = {name.lower(): scope.base(of) for of, name in symbol.components}
            self.task.records[symbol] = match
        return match

    def member(self, type_name: str, name: str) -> ComponentSymbol | None:
        """Return the component of a record type, as seen from this module."""
        symbol = self.find(type_name)
        if not isinstance(symbol, TypeSymbol):
            return None
        return self.task.members(symbol).get(name.lower())

    def knows_in_part(self, type_name: str) -> bool:
        """Return True if some components of a record are not public."""
        symbol = self.find(type_name)
        return isinstance(symbol, TypeSymbol) and symbol.partly

    def takes(self, type_name: str, members: int) -> bool:
        """Return True if a record type permits an aggregate of this length."""
        symbol = self.find(type_name)
        if not isinstance(symbol, TypeSymbol) or symbol.components is None:
            return False
        most = len(symbol.components)
        return most - symbol.newer <= members <= most

    def type_class(self, type_name: str) -> TypeClass | None:
        """Return the value class of a type after aliases.

        An array has the class of its element [K §2.16].
        """
        if type_name in self.classes:
            return self.classes[type_name]
        self.classes[type_name] = None
        symbol = self.find(element(type_name))
        result: TypeClass | None = None
        if isinstance(symbol, TypeSymbol) and symbol.kind == "RECORD":
            inside = symbol.module or self
            classes = {inside.type_class(of) for of, _ in symbol.components or ()}
            result = "nonvalue" if classes & {"nonvalue", "semivalue"} else "value"
        elif symbol is not None:
            result = signatures.type_class(symbol.name)
        self.classes[type_name] = result
        return result


@dataclass(slots=True, eq=False)
class RoutineScope:
    """A routine, or a FOR loop in it: its names, and the outer scopes."""

    module: ModuleScope
    node: RoutineDeclaration
    names: dict[str, DataSymbol] = field(default_factory=dict)
    """Parameters, data and loop variables, by lower-case name."""
    _labels: dict[str, LabelSymbol] | None = None

    def declare(self, symbol: DataSymbol) -> DataSymbol | None:
        """Add a parameter or datum; return an existing one of that name."""
        key = symbol.name.lower()
        first = self.names.get(key)
        if first is None and not key.startswith("<"):
            self.names[key] = symbol
        return first

    @property
    def labels(self) -> dict[str, LabelSymbol]:
        """Labels by lower-case name, collected on demand.

        Of equal labels the first one counts.
        """
        routine = self.module.routine(self.node)
        if routine is not self:
            return routine.labels
        if self._labels is None:
            self._labels = {}
            for at in walk(self.node):
                if isinstance(at, Label):
                    symbol = LabelSymbol(at.name, "LABEL", self.module, node=at)
                    self._labels.setdefault(at.name.lower(), symbol)
        return self._labels

    def loop(self, node: For) -> "RoutineScope":
        """Return the scope of a loop's statements [K §4.15].

        The loop variable hides other names.
        """
        variable = DataSymbol(
            node.variable, "LOOP", self.module, node=node, routine=self.node, readonly=True
        )
        names = {**self.names, node.variable.lower(): variable}
        return RoutineScope(self.module, self.node, names)

    def find(self, name: str) -> Symbol | None:
        """Return the symbol of a name in this routine."""
        return self.names.get(name.lower()) or self.module.find(name)


Scope = ModuleScope | RoutineScope
"""Where a name is looked up: both have `find` and `module`."""


def datum_symbol(
    d: DataDeclaration, module: ModuleScope, routine: RoutineDeclaration | None = None
) -> DataSymbol:
    """Return the symbol of a data declaration."""
    local, degree = d.scope == "LOCAL", len(d.dimensions)
    return DataSymbol(d.name, d.kind, module, local, d, d.type, degree, routine, d.kind == "CONST")


def parameter_symbol(
    p: Parameter, module: ModuleScope | None, routine: RoutineDeclaration | None
) -> DataSymbol:
    """Return the symbol of a parameter inside its routine.

    Both arguments are None for a built-in.
    """
    return DataSymbol(p.name, "PARAMETER", module, False, p, p.type, p.dimensions, routine)


@cache
def builtin(key: str) -> Symbol | None:
    """Return a predefined symbol by lower-case name.

    All tasks share it.
    """
    datum = signatures.constant(key)
    if datum is not None:
        return DataSymbol(datum.name, datum.kind, type=datum.type, readonly=datum.readonly)
    base = signatures.alias(key)
    if base is not None:
        return TypeSymbol(key, "ALIAS", base=base)
    if signatures.type_class(key) is not None or key in ("anytype", "switch"):
        record = signatures.record(key)
        if record is None:
            return TypeSymbol(key, "TYPE")
        return TypeSymbol(
            key, "TYPE", components=record.components, newer=record.newer, partly=record.partly
        )
    routine = signatures.routine(key)
    if routine is not None:
        return RoutineSymbol(routine.name, routine.kind, type=routine.type, signature=routine)
    return None


def called(symbol: Symbol | None) -> Symbol | None:
    """Return the symbol of a called name.

    An object of the configuration hides no predefined routine.
    """
    if symbol is not None and symbol.kind == "INSTALLED":
        routine = builtin(symbol.name.lower())
        return routine if isinstance(routine, RoutineSymbol) else symbol
    return symbol


def installed_objects(objects: Iterable[tuple[str, str]]) -> dict[str, Symbol]:
    """Return symbols of (name, type), for `TaskScope.configured`."""
    return {name.lower(): DataSymbol(name, "INSTALLED", type=of) for name, of in objects}
