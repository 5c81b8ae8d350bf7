"""Names: what a declaration gives, and in which order scopes are asked [K §2.20, 5.2, 9.1].

A type is a text: the lower-case name behind aliases, with `{*}`, `{*,*}` or `{*,*,*}` behind it
for arrays. None means "not known", and nothing that depends on it is judged.
"""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Final, Literal

from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.builtins.signatures import Signature, TypeClass
from rapidgen.rapid.syntax.nodes import (
    AliasDeclaration,
    DataDeclaration,
    Module,
    Parameter,
    RecordDeclaration,
    RoutineDeclaration,
)

Kind = Literal[
    "VAR", "PERS", "CONST", "PARAMETER", "LOOP", "PROC", "FUNC", "TRAP",
    "RECORD", "ALIAS", "TYPE", "MODULE", "INSTALLED",
]  # fmt: skip

ROUTINES: Final = frozenset(("PROC", "FUNC", "TRAP"))
TYPES: Final = frozenset(("RECORD", "ALIAS", "TYPE"))
DATA: Final = frozenset(("VAR", "PERS", "CONST", "PARAMETER", "LOOP", "INSTALLED"))
READ_ONLY: Final = frozenset(("errno", "intno"))


@dataclass(slots=True, eq=False)
class Symbol:
    """One named thing. `type` is the declared type's name; see `Scope.type_of`."""

    name: str
    kind: Kind
    type: str | None = None
    degree: int = 0
    node: (
        DataDeclaration
        | Parameter
        | RoutineDeclaration
        | RecordDeclaration
        | (AliasDeclaration)
        | Module
        | None
    ) = None
    module: "Scope | None" = None
    signature: Signature | None = None
    local: bool = False
    used: bool = False
    resolved: str | None = None
    """Type as a text, once asked for."""
    known: bool = False


@dataclass(slots=True, eq=False)
class Scope:
    """A module: its own names, and the way to the task's and the built-in ones."""

    module: Module
    world: "World"
    own: dict[str, Symbol] = field(default_factory=dict)
    globals: Mapping[str, Symbol] = field(default_factory=dict)

    def find(self, name: str) -> Symbol | None:
        """What a name means in this module outside routines."""
        key = name.lower()
        return self.own.get(key) or self.globals.get(key) or self.world.find(key)

    def base(self, name: str) -> str | None:
        """Lower-case name of the type behind aliases, or None when there is no such type."""
        symbol = self.find(name)
        if symbol is None or symbol.kind not in TYPES:
            return None
        if symbol.kind == "ALIAS" and symbol.type is not None:
            target = self.find(symbol.type)
            if target is None or target.kind not in TYPES:
                return None
            return target.name.lower()
        return symbol.name.lower()

    def type_of(self, symbol: Symbol) -> str | None:
        """Type of a datum, parameter or function, with its dimensions."""
        if not symbol.known:
            symbol.known = True
            scope = symbol.module or self
            if symbol.type is not None:
                base = "anytype" if symbol.type == "anytype" else scope.base(symbol.type)
                if base is not None:
                    symbol.resolved = array(base, symbol.degree)
        return symbol.resolved

    def components(self, type_name: str) -> Mapping[str, str | None] | None:
        """Lower-case component to its type, of a record; None for what is no record."""
        return self.world.components(self, type_name)

    def type_class(self, type_name: str) -> TypeClass | None:
        """Value class of a type behind aliases; an array has that of its element."""
        return self.world.type_class(self, element(type_name))


@dataclass(slots=True, eq=False)
class World:
    """What every module sees: built-in objects and those that the configuration installs."""

    installed: Mapping[str, Symbol] = field(default_factory=dict)
    """Signals, mechanical units and task identities, by lower-case name."""
    elsewhere: Collection[str] = ()
    """Lower-case names that modules of other tasks declare: not known here, nor unknown."""
    _builtin: dict[str, Symbol | None] = field(default_factory=dict)
    _records: dict[object, dict[str, str | None]] = field(default_factory=dict)
    _busy: set[object] = field(default_factory=set)

    def find(self, key: str) -> Symbol | None:
        """A built-in or installed object by lower-case name."""
        symbol = self.installed.get(key)
        if symbol is not None:
            return symbol
        if key not in self._builtin:
            self._builtin[key] = _builtin(key)
        return self._builtin[key]

    def components(self, scope: Scope, type_name: str) -> Mapping[str, str | None] | None:
        """See `Scope.components`."""
        symbol = scope.find(type_name)
        if symbol is None or symbol.kind not in ("RECORD", "TYPE"):
            return None
        key: object = symbol
        found = self._records.get(key)
        if found is None:
            found = {}
            if isinstance(symbol.node, RecordDeclaration):
                inside = symbol.module or scope
                found = {c.name.lower(): inside.base(c.type) for c in symbol.node.components}
            else:
                record = signatures.record(type_name)
                if record is None:
                    return None
                found = {name.lower(): scope.base(of) for of, name in record.components}
            self._records[key] = found
        return found

    def type_class(self, scope: Scope, type_name: str) -> TypeClass | None:
        """See `Scope.type_class`."""
        symbol = scope.find(type_name)
        if symbol is None:
            return None
        if not isinstance(symbol.node, RecordDeclaration):
            return signatures.type_class(symbol.name)
        if symbol in self._busy:
            return None
        self._busy.add(symbol)
        try:
            inside = symbol.module or scope
            classes = {inside.type_class(c.type) for c in symbol.node.components}
        finally:
            self._busy.discard(symbol)
        return "nonvalue" if classes & {"nonvalue", "semivalue"} else "value"


def _builtin(key: str) -> Symbol | None:
    datum = signatures.constant(key)
    if datum is not None:
        return Symbol(datum.name, datum.kind, datum.type)
    base = signatures.alias(key)
    if base is not None:
        return Symbol(key, "ALIAS", base)
    if signatures.type_class(key) is not None or key in ("anytype", "switch"):
        return Symbol(key, "TYPE")
    routine = signatures.routine(key)
    if routine is not None:
        return Symbol(routine.name, routine.kind, routine.type, signature=routine)
    return None


def array(base: str, degree: int) -> str:
    """The type of an array of `base`."""
    return base + "{" + ",".join("*" * degree) + "}" if degree else base


def degree(type_name: str) -> int:
    """Dimensions of a type."""
    return type_name.count("*")


def element(type_name: str) -> str:
    """Type of an element of an array type, the type itself when it is no array."""
    return type_name.partition("{")[0]


def collect(module: Module, world: World) -> tuple[Scope, list[tuple[Symbol, Symbol]]]:
    """The module's scope, and pairs of objects of the same name (first, second) [K §2.12]."""
    scope = Scope(module, world)
    clashes: list[tuple[Symbol, Symbol]] = []
    for declaration in module.declarations:
        symbol: Symbol
        if isinstance(declaration, DataDeclaration):
            symbol = Symbol(
                declaration.name,
                declaration.kind,
                declaration.type,
                len(declaration.dimensions),
                declaration,
            )
        elif isinstance(declaration, RoutineDeclaration):
            symbol = Symbol(declaration.name, declaration.kind, declaration.type, 0, declaration)
        elif isinstance(declaration, RecordDeclaration):
            symbol = Symbol(declaration.name, "RECORD", None, 0, declaration)
        elif isinstance(declaration, AliasDeclaration):
            symbol = Symbol(declaration.name, "ALIAS", declaration.type, 0, declaration)
        else:
            continue
        symbol.module = scope
        symbol.local = declaration.scope == "LOCAL"
        key = declaration.name.lower()
        first = scope.own.get(key)
        if first is not None:
            clashes.append((first, symbol))
        elif key and key != "<id>":
            scope.own[key] = symbol
    return scope, clashes


def task_globals(scopes: Iterable[Scope]) -> tuple[dict[str, Symbol], list[tuple[Symbol, Symbol]]]:
    """Global names of all modules of a task, and pairs of the same name [K §2.12, 9.1]."""
    found: dict[str, Symbol] = {}
    clashes: list[tuple[Symbol, Symbol]] = []
    for scope in scopes:
        module = Symbol(scope.module.name, "MODULE", node=scope.module, module=scope)
        for key, symbol in [(module.name.lower(), module), *scope.own.items()]:
            if symbol.local or not key:
                continue
            first = found.get(key)
            if first is None:
                found[key] = symbol
            elif first.module is not scope or "MODULE" in (first.kind, symbol.kind):
                # Of a module that is there twice, the module's name says it all.
                again = first.module and first.module.module.name.lower() == module.name.lower()
                if symbol is module or first.kind == "MODULE" or not again:
                    clashes.append((first, symbol))
    return found, clashes
