"""References to data: reading them, and passing them by reference [K §5.1]."""

from dataclasses import dataclass

from rapidgen.rapid.binding.symbols import TypeSymbol
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk_own
from rapidgen.runtime.compiler.context import (
    CALLS,
    SHARED,
    CompiledExpression,
    Unit,
    failing,
    same_type,
)
from rapidgen.runtime.compiler.symbols import CannotCompile, Data, FormalParameter
from rapidgen.runtime.compiler.value_copies import by_value
from rapidgen.runtime.values import NUM, attribute


@dataclass(slots=True)
class DataReference:
    """A data reference: a whole datum, an element or a component."""

    data: Data
    e: CompiledExpression
    """Reads it, without the test of an optional parameter's presence."""
    holder: str
    """Container of the last element or component; empty for a whole datum."""
    key: str
    """Index code or attribute behind the container."""
    member: bool
    cell: str
    """Code of its cell (may be None at run time), or empty."""
    index_range: tuple[int, int] | None = None
    """Of the last index."""

    @property
    def atomic(self) -> bool:
        """A single num, dnum, bool or string."""
        return not self.e.dims and self.e.type.kind in ("num", "dnum", "bool", "string")


def read(unit: Unit, data: Data) -> CompiledExpression:
    """Read a whole datum."""
    code, effect, fails = _kept(data)
    kind, dims = data.type, data.dims
    if data.storage == "inline":
        value = data.value
        complete = isinstance(value, int) and not isinstance(value, bool)
        return CompiledExpression(
            repr(value),
            kind,
            whole=complete,
            exact=True,
            range=(value, value) if complete else None,
        )
    if data.storage in ("box", "ref", "cell"):
        code = f"{code}.v"
    if data.storage == "cell" and unit.options.switching:
        code = f"R.touch({data.code}.v)"
        effect = CALLS
    return CompiledExpression(
        code, kind, dims, effect=effect, fails=fails, exact=True, whole=data.whole, range=data.range
    )


def _kept(data: Data) -> tuple[str, int, bool]:
    """Code of what keeps a datum, its effect, and whether reaching it may fail."""
    effect = SHARED if data.storage in ("global", "cell") and data.kind != "CONST" else 0
    if data.storage in ("ref", "object"):
        effect = SHARED
    if data.optional:
        return f"PRESENT({data.code})", effect, True
    return data.code, effect, False


def undeclared(unit: Unit, node: n.Node) -> str:
    """The first name of a datum in an expression or statement that nothing declares, or "".

    Statements inside are left out: each finds its own.
    """
    for part in walk_own(node):
        if isinstance(part, n.Name):
            symbol = unit.names.find(part.name)
            # A signal that is not here may have the name of a predefined type.
            if symbol is None or (isinstance(symbol, TypeSymbol) and symbol.module is None):
                return part.name
    return ""


def unknown_type(unit: Unit, node: n.Node) -> str:
    """The first datum in a statement whose type nothing declares, as text, or ""."""
    for part in walk_own(node):
        data = unit.data(part.name) if isinstance(part, n.Name) else None
        if data is not None and data.type.name in unit.linker.shared.unknown:
            return f"{data.type.name}, which {data.name} needs"
    return ""


def place_of(unit: Unit, node: n.Expression) -> DataReference | None:
    """The data reference that `node` is; None for any other expression."""
    match node:
        case n.Parenthesis():
            return None
        case n.Name():
            data = unit.data(node.name)
            if data is None or data.storage == "inline":
                return None
            return DataReference(data, read(unit, data), "", "", False, _cell(data))
        case n.Index():
            base = place_of(unit, node.base)
            if base is None or len(base.e.dims) != len(node.indices):
                return None
            indices = [unit.value_of(i, NUM, (), "index") for i in node.indices]
            holder = base.e.code + "".join(f"[{i.code}]" for i in indices[:-1])
            key = indices[-1].code
            e = CompiledExpression(
                f"{holder}[{key}]", base.e.type, ops=len(indices), fails=True, exact=True
            )
            e.take(base.e, *indices)
            limits = indices[-1].range if indices[-1].whole else None
            return DataReference(base.data, e, holder, key, False, base.cell, limits)
        case n.Member():
            base = place_of(unit, node.base)
            kind = base.e.type.component(node.component.lower()) if base else None
            if base is None or kind is None or base.e.dims:
                return None
            key = attribute(node.component)
            e = CompiledExpression(f"{base.e.code}.{key}", kind, ops=1, exact=True).take(base.e)
            return DataReference(base.data, e, base.e.code, key, True, base.cell)
    return None


def _cell(data: Data) -> str:
    if data.storage == "cell":
        return data.code
    if data.storage == "ref" and data.mode in ("PERS", "INOUT"):
        return f"{data.code}.cell"
    return ""


def reference(
    unit: Unit, node: n.Expression, parameter: FormalParameter, *, builtin: bool
) -> CompiledExpression:
    """Pass `node` to a VAR, PERS, INOUT or REF parameter."""
    place = place_of(unit, node)
    mode = parameter.mode
    if place is None:
        if isinstance(node, n.Name | n.Index | n.Member) and (name := undeclared(unit, node)):
            return failing("ERR_REFUNKDAT", name, parameter.type or NUM, (0,) * parameter.dims)
        if mode in ("REF", ""):
            return _boxed(unit, node, parameter)
        raise CannotCompile(f"parameter {parameter.name} takes a datum, not an expression", node)
    data, kind = place.data, place.e.type
    if builtin and kind.name in unit.linker.shared.unknown:
        raise CannotCompile(f"{parameter.name} takes no {kind.name}", node)
    if parameter.type is not None:
        if not same_type(kind, parameter.type):
            raise CannotCompile(
                f"parameter {parameter.name} is {parameter.type_name}, not {kind.name}", node
            )
        if len(place.e.dims) != parameter.dims:
            raise CannotCompile(f"parameter {parameter.name} has {parameter.dims} dimensions", node)
    _check_mode(data, mode, node)
    code = _reference_code(unit, place, parameter, builtin=builtin)
    result = CompiledExpression(
        code, kind, place.e.dims, effect=place.e.effect, fails=place.e.fails
    )
    result.ops = place.e.ops
    return result


def _check_mode(data: Data, mode: n.Mode, node: n.Expression) -> None:
    """The table of K §5.1; what only run time knows is left to ASVAR and ASPERS."""
    if mode in ("REF", ""):
        return
    if data.readonly:
        raise CannotCompile(f"{data.name} cannot be changed", node)
    if mode == "VAR" and (data.kind == "PERS" or data.mode == "PERS"):
        raise CannotCompile(f"{data.name} is a persistent: a VAR parameter takes a variable", node)
    is_persistent = data.kind == "PERS" or data.mode in ("PERS", "INOUT")
    if mode == "PERS" and not is_persistent:
        raise CannotCompile(f"{data.name} is no persistent", node)


def _reference_code(
    unit: Unit, place: DataReference, parameter: FormalParameter, *, builtin: bool
) -> str:
    data, e, kind = place.data, place.e, place.e.type
    if kind.kind in ("nonvalue", "semivalue") and not e.dims:
        return e.code
    as_object = not builtin and parameter.mode == "VAR" and not place.atomic
    if as_object:
        return e.code
    t, cell = unit.linker.keep(kind), place.cell or "None"
    if place.holder:
        if not place.atomic:
            return f"PART({e.code}, {t}, {data.name!r}, {cell})"
        maker = "MEMBER" if place.member else "ITEM"
        key = repr(place.key) if place.member else place.key
        return f"{maker}({place.holder}, {key}, {t}, {data.name!r}, {cell})"
    if data.storage in ("box", "cell"):
        return data.code
    if data.storage == "ref":
        code = f"PRESENT({data.code})" if data.optional else data.code
        if data.mode == "INOUT" and parameter.mode == "VAR":
            return f"ASVAR({code})"
        if data.mode == "INOUT" and parameter.mode == "PERS":
            return f"ASPERS({code})"
        return code
    if data.storage == "global" and not data.readonly:
        return unit.linker.global_ref(data)
    return f"BOX({e.code}, {t}, {e.dims!r}, {data.name!r})"


def _boxed(unit: Unit, node: n.Expression, parameter: FormalParameter) -> CompiledExpression:
    """A value for a REF or anytype parameter that is no datum."""
    e = unit.expression(node, parameter.type)
    t = unit.linker.keep(e.type)
    name = node.name if isinstance(node, n.Name) else ""
    code = f"BOX({by_value(e, e.type)}, {t}, {e.dims!r}, {name!r})"
    return CompiledExpression(code, e.type, e.dims).take(e)
